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

#ifndef CGAL_CRUDE_REGISTRATION_IO_INTERNAL_POINT_READERS_H
#define CGAL_CRUDE_REGISTRATION_IO_INTERNAL_POINT_READERS_H

// Reads points as text, and the scans of PTX files.

#include <CGAL/Crude_registration/IO/IO_error.h>
#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/IO/internal/Text_cursor.h>
#include <CGAL/Crude_registration/IO/internal/Flat_scan_file.h>

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The next three words of the line as coordinates.
inline std::array<double, 3> read_coordinates(Text_cursor& cursor)
{
  std::array<double, 3> p;
  static constexpr const char* names[3] = {"x", "y", "z"};
  for (std::size_t i = 0; i < 3; ++i) {
    p[i] = cursor.number(names[i]);
    if (!std::isfinite(p[i])) cursor.fail(std::string(names[i]) + " is NaN or infinite");
  }
  return p;
}

// Points as plain text, one a line.
class Text_point_reader
{
public:
  Text_point_reader(std::string_view text, const std::string& file) : m_cursor(text, file) {}

  std::vector<std::array<double, 3>> read()
  {
    std::vector<std::array<double, 3>> points;
    if (!next_data_line()) throw IO_error(m_cursor.file(), "the file has no points");
    set_separator();
    bool more = true;
    if (is_header()) {
      read_header();
      more = next_data_line();
    }
    long long declared = -1;
    if (more && is_count()) {
      declared = m_cursor.integer("the number of points");
      more = next_data_line();
      if (more) set_separator();
    }
    for (; more; more = next_data_line())
      points.push_back(m_columns[0] < 0 ? read_coordinates(m_cursor) : read_columns());
    if (points.empty()) throw IO_error(m_cursor.file(), "the file has no points");
    if (declared >= 0 && static_cast<std::size_t>(declared) != points.size())
      throw IO_error(m_cursor.file(), "the file has " + std::to_string(points.size()) +
                                          " points, but its first line says " + std::to_string(declared));
    return points;
  }

private:
  // past empty lines and comments
  bool next_data_line()
  {
    while (m_cursor.next_line()) {
      const std::string_view line = m_cursor.rest();
      if (line[0] != '#' && line.substr(0, 2) != "//") return true;
    }
    return false;
  }

  // One separator for the whole file, so that a decimal comma is an error and not two numbers.
  void set_separator()
  {
    const std::string_view line = m_cursor.rest();
    for (char separator : {';', ','})
      if (line.find(separator) != std::string_view::npos) {
        m_cursor.set_separator(separator);
        return;
      }
  }

  bool is_header() const
  {
    Text_cursor words = m_cursor;
    const std::string_view word = words.word();
    const char* next = nullptr;
    parse_double(word.data(), word.data() + word.size(), next);
    return next == nullptr;
  }

  // a line of names: those of the coordinates are x, y and z
  void read_header()
  {
    for (int column = 0; m_cursor.has_word(); ++column) {
      std::string name(m_cursor.word());
      name.erase(std::remove(name.begin(), name.end(), '"'), name.end());
      if (name == "x" || name == "X") m_columns[0] = column;
      if (name == "y" || name == "Y") m_columns[1] = column;
      if (name == "z" || name == "Z") m_columns[2] = column;
    }
    if (m_columns[0] < 0 || m_columns[1] < 0 || m_columns[2] < 0)
      m_cursor.fail("the line has neither numbers nor the names x, y and z of columns");
  }

  // a line of one integer
  bool is_count() const
  {
    Text_cursor words = m_cursor;
    const std::string_view word = words.word();
    return !words.has_word() && word.find_first_not_of("0123456789") == std::string_view::npos;
  }

  std::array<double, 3> read_columns()
  {
    std::array<double, 3> p = {0, 0, 0};
    const int last = (std::max)({m_columns[0], m_columns[1], m_columns[2]});
    for (int column = 0; column <= last; ++column) {
      const auto it = std::find(m_columns.begin(), m_columns.end(), column);
      if (it == m_columns.end()) m_cursor.word();
      else {
        double& coordinate = p[static_cast<std::size_t>(it - m_columns.begin())];
        coordinate = m_cursor.number("a coordinate");
        if (!std::isfinite(coordinate)) m_cursor.fail("a coordinate is NaN or infinite");
      }
    }
    return p;
  }

  Text_cursor m_cursor;
  std::array<int, 3> m_columns = {-1, -1, -1}; // where x, y and z stand; -1: at the start of the line
};

// A PTX file of one scan: columns, rows, the scanner's position and axes, the motion to the world as a matrix for row
// vectors, then the samples in the scanner's frame, column by column, 0 0 0 where there is none. The image is in the
// world's frame, its sensor at the scanner's place there.
inline Flat_scan_file read_ptx(std::string_view text, const std::string& file)
{
  Text_cursor cursor(text, file);
  const auto next_line = [&](const char* what) {
    if (!cursor.next_line()) cursor.fail(std::string("the file ends before ") + what);
  };
  std::array<std::size_t, 2> size; // columns, rows
  for (std::size_t i = 0; i < 2; ++i) {
    const char* name = i == 0 ? "the number of columns" : "the number of rows";
    next_line(name);
    const long long n = cursor.integer(name);
    if (n <= 0) cursor.fail(std::string(name) + " is not positive");
    if (cursor.has_word()) cursor.fail(std::string("more than ") + name + " in the line");
    size[i] = static_cast<std::size_t>(n);
  }
  const std::size_t columns = size[0], rows = size[1];
  // each sample takes a byte or more: counts that the file cannot hold must not make us ask for the memory
  if (columns > text.size() / rows) cursor.fail("the file is too short for its number of columns times rows");

  for (int i = 0; i < 4; ++i) {
    next_line("the scanner's position and axes");
    read_coordinates(cursor);
  }
  Rigid_motion world_from_scanner;
  for (int i = 0; i < 4; ++i) {
    next_line("the motion of the scanner");
    const auto row = read_coordinates(cursor);
    for (int j = 0; j < 3; ++j)
      (i < 3 ? world_from_scanner.rotation(j, i) : world_from_scanner.translation(j)) =
          row[static_cast<std::size_t>(j)];
    const double last = cursor.number("the last column of the motion");
    if (last != (i < 3 ? 0 : 1)) cursor.fail("the last column of the motion is not 0 0 0 1");
  }
  const Matrix& r = world_from_scanner.rotation;
  if (!((r * r.transpose()).isIdentity(1e-3) && r.determinant() > 0))
    cursor.fail("the motion of the scanner is not rigid");

  if (columns > std::size_t((std::numeric_limits<std::int32_t>::max)()) / rows)
    cursor.fail("columns times rows is above 2^31 - 1");
  Flat_scan_file scan;
  scan.kind = Flat_scan_file::RANGE_IMAGE;
  scan.columns = columns;
  scan.rows = rows;
  scan.grid.assign(columns * rows, -1);
  for (std::size_t column = 0; column < columns; ++column) {
    for (std::size_t row = 0; row < rows; ++row) {
      if (!cursor.next_line())
        cursor.fail("the file ends after " + std::to_string(column * rows + row) + " of " +
                    std::to_string(columns * rows) + " samples");
      const auto p = read_coordinates(cursor);
      if (p == std::array<double, 3>{0, 0, 0}) continue;
      const Vector q = world_from_scanner(Vector(p[0], p[1], p[2]));
      scan.grid[row * columns + column] = static_cast<std::int32_t>(scan.points.size());
      scan.points.push_back(q);
    }
  }
  if (cursor.next_line())
    cursor.fail("more samples than columns times rows; a PTX file of several scans has to be split");
  if (scan.points.empty()) throw IO_error(file, "the range image has no samples");

  scan.sensor = {Flat_sensor::PERSPECTIVE, world_from_scanner.translation};
  return scan;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_INTERNAL_POINT_READERS_H
