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

#ifndef CGAL_CRUDE_REGISTRATION_IO_INTERNAL_PCD_READER_H
#define CGAL_CRUDE_REGISTRATION_IO_INTERNAL_PCD_READER_H

// Reads PCD, the format of the Point Cloud Library.

#include <CGAL/Crude_registration/IO/IO_error.h>
#include <CGAL/Crude_registration/IO/internal/Flat_scan_file.h>
#include <CGAL/Crude_registration/IO/internal/Text_cursor.h>
#include <CGAL/Crude_registration/IO/internal/binary_numbers.h>
#include <CGAL/Crude_registration/IO/internal/lzf.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The header says which fields a point has, and how the points are written: as text, one after the other as bytes, or
// field after field as bytes that LZF has packed. Points are left as they are, NaN included.
class Pcd_reader
{
public:
  Pcd_reader(std::string_view data, const std::string& file) : m_data(data), m_file(file), m_cursor(data, file) {}

  // A range image where the points are organised. The sensor is the file's viewpoint, if that is not the one that is
  // written where there is none: `viewpoint_is_default` says so.
  Flat_scan_file read(bool& viewpoint_is_default)
  {
    read_header();
    Flat_scan_file scan;
    if (m_format == "ascii") read_ascii(scan);
    else if (m_format == "binary") read_binary(m_data.substr(m_body), scan);
    else read_binary(unpacked_body(), scan);
    if (m_columns > 1 && m_rows > 1) {
      scan.kind = Flat_scan_file::RANGE_IMAGE;
      scan.columns = m_columns;
      scan.rows = m_rows;
      scan.grid.resize(scan.points.size());
      std::iota(scan.grid.begin(), scan.grid.end(), 0);
    }
    viewpoint_is_default = m_viewpoint == std::array<double, 7>{0, 0, 0, 1, 0, 0, 0};
    if (!viewpoint_is_default)
      scan.sensor = {Flat_sensor::PERSPECTIVE, Vector(m_viewpoint[0], m_viewpoint[1], m_viewpoint[2])};
    return scan;
  }

  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  struct Field
  {
    std::string name;
    std::size_t size = 0;
    char type = 'F';
    std::size_t count = 1;
    std::size_t offset = 0;  // in a point, in bytes
    std::size_t role = none; // x, y, z, and those of the normal
  };

  // --- for what writes the file anew ---------------------------------------------------------------------------------

  // Before what follows here.
  void read_head() { read_header(); }

  const std::vector<Field>& fields() const { return m_fields; }
  bool has_normals() const { return m_has_normals; }
  bool is_text() const { return m_format == "ascii"; }
  bool is_packed() const { return m_format == "binary_compressed"; }
  std::size_t points() const { return m_points; }
  std::size_t body() const { return m_body; }
  const std::array<double, 7>& viewpoint() const { return m_viewpoint; }
  const std::array<std::string_view, 7>& viewpoint_words() const { return m_viewpoint_words; } // empty if there is none

  // Where a field of a point stands in the body, if it is no text: unpacked, field after field.
  std::size_t place(std::size_t point, const Field& f) const
  {
    return is_packed() ? f.offset * m_points + point * f.size : point * m_point_size + f.offset;
  }

  std::string unpacked_body() const
  {
    std::string unpacked;
    unpack(unpacked);
    return unpacked;
  }

private:
  using Values = std::array<double, 6>; // of a point and its normal

  // The four bytes of `rgb` or `rgba` as a number, as it is packed: blue is the least.
  struct Packed_color
  {
    std::uint32_t bits = 0;
    Color color() const
    {
      return {std::uint8_t(bits >> 16 & 255), std::uint8_t(bits >> 8 & 255), std::uint8_t(bits & 255)};
    }
  };

  // --- header -------------------------------------------------------------------------------------------------------

  void read_header()
  {
    while (m_format.empty()) {
      if (!m_cursor.next_line()) m_cursor.fail("the file ends before 'DATA'");
      if (m_cursor.rest()[0] == '#') continue;
      const std::string keyword(m_cursor.word());
      if (keyword == "FIELDS" || keyword == "COLUMNS") read_fields();
      else if (keyword == "SIZE") read_each(keyword, [&](Field& f) { f.size = read_count("a size"); });
      else if (keyword == "TYPE") read_each(keyword, [&](Field& f) { read_type(f); });
      else if (keyword == "COUNT") read_each(keyword, [&](Field& f) { f.count = read_count("a count"); });
      else if (keyword == "WIDTH") m_columns = read_count("WIDTH");
      else if (keyword == "HEIGHT") m_rows = read_count("HEIGHT");
      else if (keyword == "POINTS") m_points = read_count("POINTS");
      else if (keyword == "VIEWPOINT") read_viewpoint();
      else if (keyword == "DATA") m_format = std::string(m_cursor.word());
      else if (keyword != "VERSION") m_cursor.fail("unknown word in the header: '" + keyword.substr(0, 40) + "'");
    }
    if (m_format != "ascii" && m_format != "binary" && m_format != "binary_compressed")
      m_cursor.fail("unknown format of the data: '" + m_format.substr(0, 40) + "'");
    m_body = static_cast<std::size_t>(m_cursor.next_line_begin() - m_data.data());
    check_header();
  }

  void read_fields()
  {
    if (!m_fields.empty()) m_cursor.fail("FIELDS stands twice");
    static const std::array<std::string_view, 6> names = {"x", "y", "z", "normal_x", "normal_y", "normal_z"};
    while (m_cursor.has_word()) {
      Field f;
      f.name = std::string(m_cursor.word());
      for (std::size_t i = 0; i < names.size(); ++i)
        if (names[i] == f.name) f.role = i;
      if (f.name == "rgb" || f.name == "rgba") m_color = m_fields.size();
      m_fields.push_back(f);
    }
  }

  template <class Read>
  void read_each(const std::string& keyword, const Read& read)
  {
    for (Field& f : m_fields) {
      if (!m_cursor.has_word()) m_cursor.fail(keyword + " has fewer words than FIELDS");
      read(f);
    }
    if (m_cursor.has_word()) m_cursor.fail(keyword + " has more words than FIELDS");
  }

  std::size_t read_count(const char* what)
  {
    const long long n = m_cursor.integer(what);
    if (n < 0 || n > (std::numeric_limits<std::int32_t>::max)())
      m_cursor.fail(std::string(what) + " is negative or above 2^31 - 1");
    return static_cast<std::size_t>(n);
  }

  void read_type(Field& f)
  {
    const std::string_view type = m_cursor.word();
    if (type != "F" && type != "I" && type != "U")
      m_cursor.fail("unknown type: '" + std::string(type.substr(0, 40)) + "'");
    f.type = type[0];
  }

  void read_viewpoint()
  {
    Text_cursor words = m_cursor;
    for (std::string_view& word : m_viewpoint_words) word = words.word();
    for (double& x : m_viewpoint) {
      x = m_cursor.number("a number of the viewpoint");
      if (!std::isfinite(x)) m_cursor.fail("the viewpoint is not finite");
    }
  }

  void check_header()
  {
    std::array<const Field*, 6> found{};
    for (Field& f : m_fields) {
      const bool fits =
          f.type == 'F' ? f.size == 4 || f.size == 8 : f.size == 1 || f.size == 2 || f.size == 4 || f.size == 8;
      if (!fits)
        m_cursor.fail("the field '" + f.name.substr(0, 40) +
                      "' has no size that its type can have: " + std::to_string(f.size));
      f.offset = m_point_size;
      m_point_size += f.size * f.count;
      if (f.role == none) continue;
      if (found[f.role] != nullptr) m_cursor.fail("the field '" + f.name + "' stands twice");
      if (f.count != 1) m_cursor.fail("the field '" + f.name + "' is not one number");
      found[f.role] = &f;
    }
    if (!found[0] || !found[1] || !found[2]) m_cursor.fail("the points have no fields x, y and z");
    m_has_normals = found[3] && found[4] && found[5];
    if (m_color != none && (m_fields[m_color].size != 4 || m_fields[m_color].count != 1)) m_color = none;
    if (m_columns == none) m_columns = m_points;
    if (m_columns == none) m_cursor.fail("the header has neither WIDTH nor POINTS");
    if (m_rows > 0 && m_columns > std::size_t((std::numeric_limits<std::int32_t>::max)()) / m_rows)
      m_cursor.fail("WIDTH times HEIGHT is above 2^31 - 1");
    const std::size_t points = m_columns * m_rows;
    if (m_points != none && m_points != points)
      m_cursor.fail("POINTS is " + std::to_string(m_points) + ", but WIDTH times HEIGHT is " + std::to_string(points));
    m_points = points;
  }

  // --- data ---------------------------------------------------------------------------------------------------------

  void read_ascii(Flat_scan_file& scan)
  {
    for (std::size_t i = 0; i < m_points; ++i) {
      if (!m_cursor.next_line()) throw IO_error(m_file, m_cursor.next_line_number(), ends_after(i));
      Values values{};
      Packed_color color;
      for (const Field& f : m_fields)
        if (f.role != none) values[f.role] = m_cursor.number(f.name.c_str());
        else if (is_color(f)) color = packed_color(m_cursor.number(f.name.c_str()), f);
        else
          for (std::size_t k = 0; k < f.count; ++k)
            if (m_cursor.word().empty()) m_cursor.fail("fewer values than the header declares");
      if (m_cursor.has_word()) m_cursor.fail("more values than the header declares");
      add(values, color, scan);
    }
  }

  bool is_color(const Field& f) const { return m_color != none && &f == &m_fields[m_color]; }

  static Packed_color packed_color(double number, const Field& f)
  {
    Packed_color color;
    if (f.type == 'F') {
      const float as_float = static_cast<float>(number);
      std::memcpy(&color.bits, &as_float, sizeof color.bits);
    } else if (number >= -2147483648. && number < 4294967296.) {
      color.bits = static_cast<std::uint32_t>(static_cast<std::int64_t>(number));
    }
    return color;
  }

  std::string ends_after(std::size_t i) const
  {
    return "the file ends after " + std::to_string(i) + " of " + std::to_string(m_points) + " points";
  }

  void read_binary(std::string_view body, Flat_scan_file& scan) const
  {
    if (m_points > 0 && body.size() / m_points < m_point_size)
      throw IO_error(m_file, "byte " + std::to_string(m_data.size()) + ": " + ends_after(body.size() / m_point_size));
    scan.points.reserve(m_points);
    if (m_has_normals) scan.normals.reserve(m_points);
    for (std::size_t i = 0; i < m_points; ++i) {
      Values values{};
      Packed_color color;
      for (const Field& f : m_fields)
        if (f.role != none) values[f.role] = value_at(body, place(i, f), f);
      if (m_color != none) color.bits = number_at<std::uint32_t>(body, place(i, m_fields[m_color]));
      add(values, color, scan);
    }
  }

  void unpack(std::string& unpacked) const
  {
    const std::size_t head = 8;
    const auto fail = [&](std::size_t byte, const std::string& what) {
      throw IO_error(m_file, "byte " + std::to_string(byte) + ": " + what);
    };
    if (m_data.size() - m_body < head) fail(m_data.size(), "the file ends before the sizes of the packed data");
    const std::size_t packed = number_at<std::uint32_t>(m_data, m_body),
                      size = number_at<std::uint32_t>(m_data, m_body + 4);
    if (m_data.size() - m_body - head < packed)
      fail(m_data.size(), "the file ends within the packed data of " + std::to_string(packed) + " bytes");
    if (m_points > 0 ? size / m_points != m_point_size || size % m_points != 0 : size != 0)
      fail(m_body + 4, "the packed data has " + std::to_string(size) + " bytes, but the header declares " +
                           std::to_string(m_points) + " points of " + std::to_string(m_point_size));
    if (!unpack_lzf(m_data.substr(m_body + head, packed), size, unpacked))
      fail(m_body + head, "the packed data is damaged");
  }

  static double value_at(std::string_view body, std::size_t at, const Field& f)
  {
    if (f.type == 'F')
      return f.size == 4 ? static_cast<double>(number_at<float>(body, at)) : number_at<double>(body, at);
    const bool is_signed = f.type == 'I';
    switch (f.size) {
    case 1:
      return is_signed ? double(number_at<std::int8_t>(body, at)) : double(number_at<std::uint8_t>(body, at));
    case 2:
      return is_signed ? double(number_at<std::int16_t>(body, at)) : double(number_at<std::uint16_t>(body, at));
    case 4:
      return is_signed ? double(number_at<std::int32_t>(body, at)) : double(number_at<std::uint32_t>(body, at));
    default:
      return is_signed ? double(number_at<std::int64_t>(body, at)) : double(number_at<std::uint64_t>(body, at));
    }
  }

  void add(const Values& v, const Packed_color& color, Flat_scan_file& scan) const
  {
    if (m_color != none) scan.colors.push_back(color.color());
    scan.points.emplace_back(v[0], v[1], v[2]);
    if (m_has_normals) scan.normals.push_back(unit_normal(Vector(v[3], v[4], v[5])));
  }

  std::string_view m_data;
  const std::string& m_file;
  Text_cursor m_cursor;
  std::vector<Field> m_fields;
  std::size_t m_columns = none, m_rows = 1, m_points = none, m_point_size = 0;
  std::size_t m_body = 0;     // where the data starts, in bytes
  std::size_t m_color = none; // the field of the colour
  bool m_has_normals = false;
  std::array<std::string_view, 7> m_viewpoint_words;
  std::array<double, 7> m_viewpoint = {0, 0, 0, 1, 0, 0, 0}; // place, and turn as a quaternion
  std::string m_format;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_INTERNAL_PCD_READER_H
