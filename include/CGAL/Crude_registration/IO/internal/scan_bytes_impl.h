// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Author(s)     : The Crude_registration authors

#ifndef CGAL_CRUDE_REGISTRATION_IO_INTERNAL_SCAN_BYTES_IMPL_H
#define CGAL_CRUDE_REGISTRATION_IO_INTERNAL_SCAN_BYTES_IMPL_H

// A prepared scan as bytes, with a version and a checksum.

#include <CGAL/Crude_registration/IO/internal/Byte_archive.h>
#include <CGAL/Crude_registration/IO/internal/scan_bytes.h>

#include <boost/crc.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// What a file begins with; the last bytes are no text, so that a program that changes ends of lines is found out.
inline constexpr char scan_magic[] = "CRScan\r\n";
inline constexpr std::size_t scan_magic_size = sizeof scan_magic - 1;

// To be raised whenever what is written changes, or what is made of a scan: a scan of another version is of no use.
inline constexpr std::uint32_t scan_version = 5;

inline std::uint32_t checksum(const char* data, std::size_t size)
{
  boost::crc_32_type crc;
  crc.process_bytes(data, size);
  return crc.checksum();
}

// The parts of a scan, in their order, for a writer and for a reader.
template <class Archive>
class Scan_parts
{
public:
  explicit Scan_parts(Archive& archive) : m_archive(archive) {}

  template <class T>
  std::enable_if_t<std::is_arithmetic<std::remove_const_t<T>>::value> operator()(T& value) const
  {
    m_archive(value);
  }

  void operator()(const Flat_sensor::Kind& kind) const { m_archive(std::uint8_t(kind)); }
  void operator()(Flat_sensor::Kind& kind) const
  {
    std::uint8_t number = 0;
    m_archive(number);
    if (number > Flat_sensor::PERSPECTIVE) m_archive.fail("the bytes are those of no scan");
    kind = Flat_sensor::Kind(number);
  }

  // Row by row.
  template <class T, int rows, int columns>
  void operator()(Eigen::Matrix<T, rows, columns>& m) const
  {
    for (int i = 0; i < rows; ++i)
      for (int j = 0; j < columns; ++j) m_archive(m(i, j));
  }
  template <class T, int rows, int columns>
  void operator()(const Eigen::Matrix<T, rows, columns>& m) const
  {
    for (int i = 0; i < rows; ++i)
      for (int j = 0; j < columns; ++j) m_archive(m(i, j));
  }

  template <class T>
  void operator()(std::vector<T>& items) const
  {
    list(items);
  }
  template <class T>
  void operator()(const std::vector<T>& items) const
  {
    list(items);
  }

  template <class Surfel_>
  std::enable_if_t<std::is_same<std::remove_const_t<Surfel_>, Surfel>::value> operator()(Surfel_& s) const
  {
    auto& [position, normal, minimal_curvature, maximal_curvature, variance] = s;
    (*this)(position);
    (*this)(normal);
    (*this)(minimal_curvature);
    (*this)(maximal_curvature);
    (*this)(variance);
  }

  // All members of a struct are named, so that a new one is not forgotten here: without it this does not compile.
  template <class Level>
  void level(Level& l) const
  {
    auto& [spacing, surfels, borders, weights, probes, field, height_noise, normal_noise] = l;
    (*this)(spacing);
    (*this)(surfels);
    (*this)(borders);
    (*this)(weights);
    (*this)(probes);
    field.for_each_part(field, *this);
    (*this)(height_noise);
    (*this)(normal_noise);
  }

  template <class Simplified>
  void simplified(Simplified& s) const
  {
    auto& [vertices, spacing, extent, description_radius] = s;
    auto& [points, normals, minimum_curvatures, maximum_curvatures, inside] = vertices;
    (*this)(points);
    (*this)(normals);
    (*this)(minimum_curvatures);
    (*this)(maximum_curvatures);
    (*this)(inside);
    (*this)(spacing);
    (*this)(extent);
    (*this)(description_radius);
  }

  // All but the simplified mesh, and the seconds, which are of the run that made it.
  template <class Reduced>
  void scan(Reduced& s) const
  {
    auto& [own_from_input, number_of_samples, spacing, extent, coarse, fine, depths, is_body, seconds, simplified] = s;
    (*this)(own_from_input.rotation);
    (*this)(own_from_input.translation);
    using Count = std::conditional_t<std::is_const<Reduced>::value, const std::uint64_t, std::uint64_t>;
    Count samples = number_of_samples;
    (*this)(samples);
    if constexpr (!std::is_const<Reduced>::value) number_of_samples = std::size_t(samples);
    (*this)(spacing);
    (*this)(extent);
    level(coarse);
    level(fine);
    depths.for_each_part(depths, *this);
    using Flag = std::conditional_t<std::is_const<Reduced>::value, const std::uint8_t, std::uint8_t>;
    Flag body = is_body;
    (*this)(body);
    if constexpr (!std::is_const<Reduced>::value) is_body = body != 0;
  }

private:
  template <class List>
  void list(List& items) const
  {
    m_archive.list(items, [this](Archive&, auto& item) { (*this)(item); });
  }

  Archive& m_archive;
};

// What all that looks at a level takes for granted.
inline bool is_consistent(const Surfel_level& l)
{
  const std::size_t n = l.surfels.size();
  const auto is_finite = [](const Surfel& s) {
    return s.position.allFinite() && s.normal.allFinite() && std::isfinite(s.minimal_curvature) &&
           std::isfinite(s.maximal_curvature) && s.variance >= 0;
  };
  const auto is_surfel = [n](std::int32_t i) { return i >= 0 && std::size_t(i) < n; };
  return n > 0 && n <= Surfel_field::maximum_size && (l.borders.empty() || l.borders.size() == n) &&
         (l.weights.empty() || l.weights.size() == n) && std::isfinite(l.spacing) && l.spacing > 0 &&
         std::all_of(l.surfels.begin(), l.surfels.end(), is_finite) &&
         std::all_of(l.probes.begin(), l.probes.end(), is_surfel) && l.field.is_consistent(n);
}

inline bool is_consistent(const Simplified_scan& s)
{
  const Matching_vertices& v = s.vertices;
  const std::size_t n = v.points.size();
  const auto is_finite = [](const Vector& x) { return x.allFinite(); };
  const auto is_number = [](double x) { return std::isfinite(x); };
  return v.normals.size() == n && v.minimum_curvatures.size() == n && v.maximum_curvatures.size() == n &&
         v.inside.size() == n && std::all_of(v.points.begin(), v.points.end(), is_finite) &&
         std::all_of(v.normals.begin(), v.normals.end(), is_finite) &&
         std::all_of(v.minimum_curvatures.begin(), v.minimum_curvatures.end(), is_number) &&
         std::all_of(v.maximum_curvatures.begin(), v.maximum_curvatures.end(), is_number) && std::isfinite(s.spacing) &&
         std::isfinite(s.extent) && std::isfinite(s.description_radius);
}

inline bool is_consistent(const Reduced_scan& s)
{
  return s.own_from_input.rotation.allFinite() && s.own_from_input.translation.allFinite() && s.number_of_samples > 0 &&
         std::isfinite(s.spacing) && s.spacing > 0 && std::isfinite(s.extent) &&
         s.coarse.borders.size() == s.coarse.surfels.size() && is_consistent(s.coarse) && is_consistent(s.fine) &&
         s.depths.is_consistent() && (!s.simplified || is_consistent(*s.simplified));
}

CGAL_CRUDE_REGISTRATION_INLINE std::string scan_bytes(const Reduced_scan& scan, const Reduced_scan* other_side)
{
  Byte_writer body;
  const Scan_parts<Byte_writer> parts(body);
  body(std::uint8_t(other_side ? 2 : 1));
  for (const Reduced_scan* side : {&scan, other_side}) {
    if (!side) continue;
    parts.scan(*side);
    body(std::uint8_t(side->simplified ? 1 : 0));
    if (side->simplified) parts.simplified(*side->simplified);
  }

  Byte_writer file;
  file.append(scan_magic, scan_magic_size);
  file(scan_version);
  file(std::uint64_t(body.bytes().size()));
  file.append(body.bytes().data(), body.bytes().size());
  file(checksum(file.bytes().data(), file.bytes().size()));
  return file.bytes();
}

CGAL_CRUDE_REGISTRATION_INLINE std::vector<Reduced_scan> scan_of_bytes(const std::string& bytes,
                                                                       const std::string& name)
{
  if (bytes.compare(0, scan_magic_size, scan_magic) != 0) throw IO_error(name, "no scan that save_scan() wrote");
  Byte_reader reader(bytes.data() + scan_magic_size, bytes.data() + bytes.size(), name);
  std::uint32_t version = 0, sum = 0;
  std::uint64_t size = 0;
  reader(version);
  if (version != scan_version)
    reader.fail("the scan was prepared by another version: the format is " + std::to_string(version) + ", not " +
                std::to_string(scan_version) + "; prepare it again");
  reader(size);
  if (reader.left() < sizeof sum || size != reader.left() - sizeof sum)
    reader.fail("the bytes are cut off, or others follow them");
  const std::size_t end = bytes.size() - sizeof sum;
  Byte_reader(bytes.data() + end, bytes.data() + bytes.size(), name)(sum);
  if (sum != checksum(bytes.data(), end)) reader.fail("the bytes are altered: the checksum is another one");

  Byte_reader body(bytes.data() + (end - std::size_t(size)), bytes.data() + end, name);
  const Scan_parts<Byte_reader> parts(body);
  std::uint8_t number_of_sides = 0;
  body(number_of_sides);
  if (number_of_sides != 1 && number_of_sides != 2) body.fail("the bytes are those of no scan");
  std::vector<Reduced_scan> sides(number_of_sides);
  for (Reduced_scan& scan : sides) {
    parts.scan(scan);
    std::uint8_t has_simplified = 0;
    body(has_simplified);
    if (has_simplified != 0) {
      Simplified_scan simplified;
      parts.simplified(simplified);
      scan.simplified = std::make_shared<const Simplified_scan>(std::move(simplified));
    }
    if (!is_consistent(scan)) body.fail("the bytes are those of no scan");
  }
  if (body.left() != 0) body.fail("the bytes are those of no scan");
  return sides;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_INTERNAL_SCAN_BYTES_IMPL_H
