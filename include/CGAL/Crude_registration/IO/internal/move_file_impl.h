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

#ifndef CGAL_CRUDE_REGISTRATION_IO_INTERNAL_MOVE_FILE_IMPL_H
#define CGAL_CRUDE_REGISTRATION_IO_INTERNAL_MOVE_FILE_IMPL_H

// Moves what is in a file of a scan.

#include <CGAL/Crude_registration/IO/internal/Pcd_reader.h>
#include <CGAL/Crude_registration/IO/internal/Ply_reader.h>
#include <CGAL/Crude_registration/IO/internal/lzf.h>
#include <CGAL/Crude_registration/IO/internal/missing_samples.h>
#include <CGAL/Crude_registration/IO/internal/move_file.h>
#include <CGAL/Crude_registration/IO/internal/move_text_files.h>
#include <CGAL/Crude_registration/IO/internal/read_flat_scan.h>
#include <CGAL/Crude_registration/IO/internal/read_npy.h>
#include <CGAL/Crude_registration/IO/internal/scan_format.h>
#include <CGAL/Crude_registration/internal/base/Flat_sensor.h>

#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <ios>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// --- PLY ------------------------------------------------------------------------------------------------------------

inline bool is_float(Ply_type type)
{
  return type == Ply_type::FLOAT32 || type == Ply_type::FLOAT64;
}

inline bool is_number_of_point(const Ply_property& p)
{
  return p.role >= Ply_role::X && p.role <= Ply_role::NZ;
}

[[noreturn]] inline void fail_for_whole_numbers(const std::string& file, const std::string& name)
{
  throw IO_error(file, "the file cannot be written moved: its numbers " + name +
                           " are whole ones; convert it to floating-point numbers first");
}

inline void check_head(const Ply_reader& reader, const std::string& file)
{
  for (const Ply_element& e : reader.elements())
    for (const Ply_property& p : e.properties)
      if (is_number_of_point(p) && !is_float(p.type)) fail_for_whole_numbers(file, p.name);
}

template <class Source>
void move_ply_body(const Ply_reader& reader, Source& source, Moved_numbers& moved)
{
  Number_form form;
  form.is_text = reader.is_text();
  form.is_big_endian = reader.is_big_endian();
  for (const Ply_element& e : reader.elements()) {
    if (e.properties.empty()) continue;
    for (std::uint64_t i = 0; i < e.count; ++i) {
      source.begin_element(e, i);
      for (const Ply_property& p : e.properties) {
        if (p.is_list) {
          const long long length = source.count(p);
          for (long long k = 0; k < length; ++k) source.skip(p);
        } else if (is_number_of_point(p)) {
          const std::string_view place = source.place(p);
          form.is_double = p.type == Ply_type::FLOAT64;
          moved.number(static_cast<std::size_t>(p.role) - static_cast<std::size_t>(Ply_role::X), place,
                       source.number(p), form);
        } else {
          source.skip(p);
        }
      }
      source.end_element();
      moved.end_of_point();
    }
  }
}

inline void move_ply_head(const Ply_reader& reader, const Similarity& motion, Moved_numbers& moved)
{
  for (const auto& sensor : reader.sensor_words()) {
    const Vector v(sensor.values[0], sensor.values[1], sensor.values[2]);
    const Vector by = sensor.is_direction ? Vector(motion.motion.rotation * v) : motion(v);
    for (std::size_t i = 0; i < 3; ++i) moved.replace(sensor.words[i], by(static_cast<int>(i)) + 0.);
  }
}

inline Moved_file moved_ply(const std::string& data, const Similarity& motion, const std::string& file)
{
  bool missing = false;
  {
    const Ply_contents ply = read_ply(data, file);
    if (!ply.has_grid) missing = origin_is_missing(Polygon_soup{ply.points, ply.faces, {}, {}});
  }
  Ply_reader reader(data, file);
  reader.read_head();
  check_head(reader, file);
  const std::string_view all(data), head = all.substr(0, reader.body()), body = all.substr(reader.body());
  Moved_numbers moved_head(head, motion, file), moved(body, motion, file);
  moved.set_origin_is_missing(missing);
  move_ply_head(reader, motion, moved_head);
  if (reader.is_text()) {
    Ply_ascii source(body, file, reader.body_line());
    move_ply_body(reader, source, moved);
  } else if (reader.is_big_endian() == is_little_endian()) {
    Ply_binary<true> source(body, 0, file);
    move_ply_body(reader, source, moved);
  } else {
    Ply_binary<false> source(body, 0, file);
    move_ply_body(reader, source, moved);
  }
  return {moved_head.take() + moved.take(), moved.rounding()};
}

// --- PCD ------------------------------------------------------------------------------------------------------------

inline void check_head(const Pcd_reader& reader, const std::string& file)
{
  for (const auto& f : reader.fields())
    if (f.role != Pcd_reader::none && f.type != 'F') fail_for_whole_numbers(file, f.name);
}

// The viewpoint: the place of the sensor, and its turn as a quaternion (w, x, y, z), which is that of the points'
// frame.
inline void move_viewpoint(const Pcd_reader& reader, const Similarity& motion, Moved_numbers& moved)
{
  const auto& v = reader.viewpoint();
  const auto& words = reader.viewpoint_words();
  if (words[0].empty()) return;
  const Vector place = motion(Vector(v[0], v[1], v[2]));
  const Eigen::Quaterniond turn =
      (Eigen::Quaterniond(motion.motion.rotation) * Eigen::Quaterniond(v[3], v[4], v[5], v[6])).normalized();
  for (std::size_t i = 0; i < 3; ++i) moved.replace(words[i], place(static_cast<int>(i)) + 0.);
  const std::array<double, 4> q = {turn.w(), turn.x(), turn.y(), turn.z()};
  for (std::size_t i = 0; i < 4; ++i) moved.replace(words[3 + i], q[i] + 0.);
}

inline void move_pcd_text(const Pcd_reader& reader, std::string_view body, const std::string& file,
                          Moved_numbers& moved)
{
  Text_cursor cursor(body, file);
  Number_form form;
  for (std::size_t i = 0; i < reader.points(); ++i) {
    cursor.next_line();
    for (const auto& f : reader.fields())
      for (std::size_t k = 0; k < f.count; ++k) {
        double value = 0;
        if (f.role != Pcd_reader::none) value = Text_cursor(cursor).number(f.name.c_str());
        const std::string_view word = cursor.word();
        form.is_double = f.size == 8;
        if (f.role != Pcd_reader::none) moved.number(f.role, word, value, form);
      }
    moved.end_of_point();
  }
}

inline void move_pcd_bytes(const Pcd_reader& reader, std::string_view body, Moved_numbers& moved)
{
  Number_form form;
  form.is_text = false;
  for (std::size_t i = 0; i < reader.points(); ++i) {
    for (const auto& f : reader.fields()) {
      if (f.role == Pcd_reader::none) continue;
      const std::size_t at = reader.place(i, f);
      form.is_double = f.size == 8;
      moved.number(f.role, body.substr(at, f.size),
                   form.is_double ? number_at<double>(body, at) : static_cast<double>(number_at<float>(body, at)),
                   form);
    }
    moved.end_of_point();
  }
}

inline Moved_file moved_pcd(const std::string& data, const Similarity& motion, const std::string& file)
{
  bool missing = false, viewpoint_is_default = false;
  {
    const Flat_scan_file raw = Pcd_reader(data, file).read(viewpoint_is_default);
    missing = raw.kind == Flat_scan_file::RANGE_IMAGE || origin_is_missing(raw.points);
  }
  if (viewpoint_is_default) { // is it that of the sensor?
    const Flat_sensor sensor = read_flat_scan(file, Depth_camera()).sensor;
    viewpoint_is_default = !(sensor.kind == Flat_sensor::PERSPECTIVE && sensor.vector.isZero(0));
  }
  Pcd_reader reader(data, file);
  reader.read_head();
  check_head(reader, file);
  const std::string_view all(data), head = all.substr(0, reader.body());
  Moved_numbers moved_head(head, motion, file);
  if (!viewpoint_is_default) move_viewpoint(reader, motion, moved_head);
  const std::string unpacked = reader.is_packed() ? reader.unpacked_body() : std::string();
  const std::string_view body = reader.is_packed() ? std::string_view(unpacked) : all.substr(reader.body());
  Moved_numbers moved(body, motion, file);
  moved.set_origin_is_missing(missing);
  if (reader.is_text()) move_pcd_text(reader, body, file, moved);
  else move_pcd_bytes(reader, body, moved);
  Moved_file result = {moved_head.take(), moved.rounding()};
  if (!reader.is_packed()) {
    result.data += moved.take();
    return result;
  }
  const std::string packed = pack_lzf(moved.take());
  const std::size_t sizes = result.data.size(), size_of_a_size = sizeof(std::uint32_t);
  result.data.resize(sizes + 2 * size_of_a_size);
  put_number(result.data, sizes, static_cast<std::uint32_t>(packed.size()));
  put_number(result.data, sizes + size_of_a_size, static_cast<std::uint32_t>(unpacked.size()));
  result.data += packed;
  return result;
}

// --- NPY ------------------------------------------------------------------------------------------------------------

inline Moved_file moved_npy(const std::string& data, const Similarity& motion, const std::string& file)
{
  Npy_reader reader(data, file);
  const Flat_scan_file raw = reader.read();
  Moved_numbers moved(data, motion, file);
  moved.set_origin_is_missing(raw.kind == Flat_scan_file::RANGE_IMAGE || origin_is_missing(raw.points));
  const std::size_t size = reader.size_of_number(), columns = raw.normals.empty() ? 3 : Moved_numbers::roles;
  Number_form form;
  form.is_text = false;
  form.is_double = size == sizeof(double);
  form.is_big_endian = reader.is_big_endian();
  for (std::size_t i = 0; i < raw.points.size(); ++i) {
    for (std::size_t k = 0; k < columns; ++k) {
      const std::size_t at = reader.place(i, k < 3 ? k : reader.normals_at() + k - 3);
      const double value = form.is_double ? number_at<double>(data, at, form.is_big_endian)
                                          : static_cast<double>(number_at<float>(data, at, form.is_big_endian));
      moved.number(k, std::string_view(data).substr(at, size), value, form);
    }
    moved.end_of_point();
  }
  std::string result = moved.take();
  return {std::move(result), moved.rounding()};
}

// --- all ------------------------------------------------------------------------------------------------------------

inline Moved_file moved_contents(const Named_contents& contents, std::size_t number, const Similarity& motion,
                                 const std::string& file)
{
  const Scan_format format = format_of(contents);
  switch (format) {
  case Scan_format::PLY:
    return moved_ply(contents.data, motion, file);
  case Scan_format::PCD:
    return moved_pcd(contents.data, motion, file);
  case Scan_format::NPY:
    return moved_npy(contents.data, motion, file);
  default:
    break;
  }
  const std::string_view all(contents.data);
  const std::string_view data = format == Scan_format::PTX ? Ptx_reader(all, file).text_of(number) : all;
  Moved_numbers moved(data, motion, file);
  switch (format) {
  case Scan_format::PTX:
    move_ptx(data, file, motion, moved);
    break;
  case Scan_format::OFF:
    move_off(data, file, moved);
    break;
  case Scan_format::OBJ:
    move_obj(data, file, moved);
    break;
  case Scan_format::STL:
    move_stl(data, file, moved);
    break;
  default:
    move_text(data, file, moved);
  }
  std::string result = moved.take();
  return {std::move(result), moved.rounding()};
}

inline void check_format(Scan_format format, const std::string& file)
{
  const char* what = nullptr;
  if (format == Scan_format::PNG) what = "a depth image has no coordinates of points";
  if (format == Scan_format::LAS) what = "LAS keeps whole numbers in a grid along the axes";
  if (format == Scan_format::E57 || format == Scan_format::GOCAD || format == Scan_format::VTP ||
      format == Scan_format::GLTF)
    what = "this format is not written";
  if (what != nullptr)
    throw IO_error(file, std::string("the file cannot be written moved: ") + what + "; convert it to PLY first");
}

inline void check_contents(const Named_contents& contents, const std::string& file)
{
  const Scan_format format = format_of(contents);
  check_format(format, file);
  if (format == Scan_format::PLY) {
    Ply_reader reader(contents.data, file);
    reader.read_head();
    check_head(reader, file);
  }
  if (format == Scan_format::PCD) {
    Pcd_reader reader(contents.data, file);
    reader.read_head();
    check_head(reader, file);
  }
}

// Of a large file its beginning is enough, if that holds its head.
CGAL_CRUDE_REGISTRATION_INLINE void check_file_can_be_moved(const std::string& name)
{
  std::string file = name;
  take_off_number(file);
  constexpr std::size_t enough = std::size_t(1) << 20;
  Named_contents beginning;
  beginning.data.resize(enough);
  std::ifstream in(file, std::ios::binary);
  in.read(beginning.data.data(), static_cast<std::streamsize>(enough));
  if (in && beginning.data.compare(0, 2, "\x1f\x8b") != 0) {
    beginning.extension = lower_case_extension(file);
    try {
      check_contents(beginning, file);
      return;
    } catch (const IO_error&) {
    }
  }
  check_contents(contents_of(file), file);
}

CGAL_CRUDE_REGISTRATION_INLINE Moved_file moved_file(const std::string& name, const Similarity& motion, bool packed)
{
  std::string file = name;
  const std::size_t number = take_off_number(file);
  const Named_contents contents = contents_of(file);
  check_format(format_of(contents), file);
  Moved_file moved = moved_contents(contents, number, motion, file);
  if (contents.has_mark) moved.data.insert(0, utf8_mark);
  if (packed) moved.data = pack_gzip(moved.data, file);
  return moved;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_INTERNAL_MOVE_FILE_IMPL_H
