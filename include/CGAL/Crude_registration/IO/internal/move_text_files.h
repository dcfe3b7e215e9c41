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

#ifndef CGAL_CRUDE_REGISTRATION_IO_INTERNAL_MOVE_TEXT_FILES_H
#define CGAL_CRUDE_REGISTRATION_IO_INTERNAL_MOVE_TEXT_FILES_H

// Moves what is in files of text: points, PTX, OFF, OBJ, STL.

#include <CGAL/Crude_registration/IO/internal/Flat_scan_file.h>
#include <CGAL/Crude_registration/IO/internal/Moved_numbers.h>
#include <CGAL/Crude_registration/IO/internal/Text_cursor.h>
#include <CGAL/Crude_registration/IO/internal/Text_point_reader.h>
#include <CGAL/Crude_registration/IO/internal/missing_samples.h>
#include <CGAL/Crude_registration/IO/internal/polygon_soup_readers.h>
#include <CGAL/Crude_registration/IO/internal/read_ptx.h>

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

// Each file has been read before, and is what its reader takes.

namespace CGAL {
namespace Crude_registration {
namespace internal {

inline bool origin_is_missing(const Polygon_soup& soup)
{
  if (!soup.polygons.empty()) return false;
  std::vector<Vector> points;
  points.reserve(soup.points.size());
  for (const auto& p : soup.points) points.emplace_back(p[0], p[1], p[2]);
  return origin_is_missing(points);
}

// The next three words of the line as a point, or, from role 3 on, as a normal; nothing where they are no numbers.
inline void take_words(Text_cursor& cursor, std::size_t first_role, Moved_numbers& moved)
{
  for (std::size_t i = 0; i < 3; ++i) {
    double value = 0;
    if (!Text_cursor(cursor).try_number(value)) return;
    moved.number(first_role + i, cursor.word(), value, Number_form());
  }
}

inline void move_text(std::string_view data, const std::string& file, Moved_numbers& moved)
{
  Text_point_reader reader(data, file);
  moved.set_origin_is_missing(origin_is_missing(reader.read().points));
  Number_form form;
  if (reader.may_have_decimal_commas())
    reader.for_each_number([&](std::size_t, std::string_view word,
                               double) { form.has_comma = form.has_comma || word.find(',') != std::string_view::npos; },
                           [] {});
  reader.for_each_number(
      [&](std::size_t role, std::string_view word, double value) { moved.number(role, word, value, form); },
      [&] { moved.end_of_point(); });
}

inline void move_off(std::string_view data, const std::string& file, Moved_numbers& moved)
{
  moved.set_origin_is_missing(origin_is_missing(read_off(data, file)));
  Text_cursor cursor(data, file);
  const auto next_data_line = [&] {
    while (cursor.next_line())
      if (cursor.rest()[0] != '#') return true;
    return false;
  };
  next_data_line();
  const std::string_view keyword = cursor.word();
  const bool has_normals = keyword.find('N') != std::string_view::npos;
  if (!cursor.has_word()) next_data_line();
  const long long vertices = cursor.integer("the number of vertices");
  for (long long i = 0; i < vertices; ++i) {
    next_data_line();
    take_words(cursor, 0, moved);
    if (has_normals) take_words(cursor, 3, moved);
    moved.end_of_point();
  }
}

inline void move_obj(std::string_view data, const std::string& file, Moved_numbers& moved)
{
  moved.set_origin_is_missing(origin_is_missing(read_obj(data, file)));
  Text_cursor cursor(data, file);
  while (cursor.next_line()) {
    const std::string_view keyword = cursor.word();
    if (keyword != "v" && keyword != "vn") continue;
    take_words(cursor, keyword == "v" ? 0 : 3, moved);
    moved.end_of_point();
  }
}

inline void move_stl_text(std::string_view data, const std::string& file, Moved_numbers& moved)
{
  Text_cursor cursor(data, file);
  while (cursor.next_line()) {
    const std::string_view keyword = cursor.word();
    if (keyword == "vertex") take_words(cursor, 0, moved);
    else if (keyword == "facet" && cursor.word() == "normal") take_words(cursor, 3, moved);
    else continue;
    moved.end_of_point();
  }
}

inline void move_stl(std::string_view data, const std::string& file, Moved_numbers& moved)
{
  Stl_reader reader(data, file);
  reader.read();
  if (!reader.is_binary()) {
    move_stl_text(data, file, moved);
    return;
  }
  Number_form form;
  form.is_text = form.is_double = false;
  constexpr std::size_t size = sizeof(float);
  for (std::size_t i = 0; i < reader.count(); ++i)
    for (std::size_t k = 0; k < 4; ++k) { // the normal and three corners
      for (std::size_t j = 0; j < 3; ++j) {
        const std::size_t at = Stl_reader::header + Stl_reader::record * i + size * (3 * k + j);
        moved.number(k == 0 ? 3 + j : j, data.substr(at, size), static_cast<double>(number_at<float>(data, at)), form);
      }
      moved.end_of_point();
    }
}

// A PTX file says where its scanner stood: that is moved, the samples stay as they are, but for their unit.
inline void move_ptx(std::string_view data, const std::string& file, const Similarity& motion, Moved_numbers& moved)
{
  Text_cursor cursor(data, file);
  const auto vector = [&](std::array<std::string_view, 3>& words) {
    Vector v;
    for (int i = 0; i < 3; ++i) {
      v(i) = Text_cursor(cursor).number("a number");
      words[static_cast<std::size_t>(i)] = cursor.word();
    }
    return v;
  };
  while (cursor.next_line()) {
    const long long columns = cursor.integer("the number of columns");
    cursor.next_line();
    const long long samples = columns * cursor.integer("the number of rows");
    // the scanner's place, its axes, and the motion to the world, of which a row is what an axis becomes
    for (int line = 0; line < 8; ++line) {
      cursor.next_line();
      std::array<std::string_view, 3> words;
      const Vector v = vector(words);
      const Vector by = line == 0 || line == 7 ? motion(v) : Vector(motion.motion.rotation * v);
      for (int i = 0; i < 3; ++i) moved.replace(words[static_cast<std::size_t>(i)], by(i) + 0.);
    }
    for (long long i = 0; i < samples; ++i) {
      cursor.next_line();
      if (motion.scale == 1) continue;
      std::array<std::string_view, 3> words;
      const Vector p = vector(words);
      if (!p.allFinite() || p.isZero(0)) continue;
      for (int k = 0; k < 3; ++k) moved.replace(words[static_cast<std::size_t>(k)], motion.scale * p(k));
    }
  }
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_INTERNAL_MOVE_TEXT_FILES_H
