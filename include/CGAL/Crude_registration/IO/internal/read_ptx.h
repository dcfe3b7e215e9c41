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

#ifndef CGAL_CRUDE_REGISTRATION_IO_INTERNAL_READ_PTX_H
#define CGAL_CRUDE_REGISTRATION_IO_INTERNAL_READ_PTX_H

// Reads the scans of PTX files.

#include <CGAL/Crude_registration/IO/IO_error.h>
#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/IO/internal/Text_cursor.h>
#include <CGAL/Crude_registration/IO/internal/Flat_scan_file.h>

#include <Eigen/LU>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The scans of a PTX file, one after the other: columns, rows, the scanner's position and axes, the motion to the world
// as a matrix for row vectors, then the samples in the scanner's frame, column by column, 0 0 0 where there is none.
class Ptx_reader
{
public:
  Ptx_reader(std::string_view text, const std::string& file) : m_cursor(text, file), m_size(text.size()) {}

  // The scan of this number, counted from 1, or the only one where it is 0. The image is in the world's frame, its
  // sensor at the scanner's place there.
  Flat_scan_file read(std::size_t number)
  {
    if (!m_cursor.next_line()) m_cursor.fail("the file ends before the number of columns");
    for (std::size_t i = 1; i < number; ++i) {
      read_header();
      if (!skip_samples())
        throw IO_error(m_cursor.file(),
                       "the file has " + std::to_string(i) + " scans: there is no number " + std::to_string(number));
    }
    read_header();
    Flat_scan_file scan = read_samples();
    if (number == 0 && m_cursor.next_line())
      m_cursor.fail("more samples than columns times rows: of several scans in a file, " + m_cursor.file() +
                    "#1 is the first");
    return scan;
  }

  // The text of the scan of this number, of which read() makes one.
  std::string_view text_of(std::size_t number)
  {
    const char* const begin = m_cursor.next_line_begin();
    if (number == 0) return std::string_view(begin, m_size);
    std::size_t from = 0;
    next_line("the number of columns");
    for (std::size_t i = 1;; ++i) {
      read_header();
      for (std::size_t k = 0; k < m_columns * m_rows; ++k) next_sample(k);
      const std::size_t end = static_cast<std::size_t>(m_cursor.next_line_begin() - begin);
      if (i == number) return std::string_view(begin + from, end - from);
      from = end;
      next_line("the number of columns");
    }
  }

  // How many scans the file has; their samples are not read.
  std::size_t count()
  {
    if (!m_cursor.next_line()) m_cursor.fail("the file ends before the number of columns");
    std::size_t n = 1;
    for (read_header(); skip_samples(); ++n) read_header();
    return n;
  }

private:
  void next_line(const char* what)
  {
    if (!m_cursor.next_line()) m_cursor.fail(std::string("the file ends before ") + what);
  }

  // from the line of the number of columns on
  void read_header()
  {
    const char* name = "the number of columns";
    for (std::size_t* size : {&m_columns, &m_rows}) {
      if (size == &m_rows) next_line(name = "the number of rows");
      const long long n = m_cursor.integer(name);
      if (n <= 0) m_cursor.fail(std::string(name) + " is not positive");
      if (m_cursor.has_word()) m_cursor.fail(std::string("more than ") + name + " in the line");
      *size = static_cast<std::size_t>(n);
    }
    // each sample takes a byte or more: counts that the file cannot hold must not make us ask for the memory
    if (m_columns > m_size / m_rows) m_cursor.fail("the file is too short for its number of columns times rows");
    if (m_columns > std::size_t((std::numeric_limits<std::int32_t>::max)()) / m_rows)
      m_cursor.fail("columns times rows is above 2^31 - 1");
    for (int i = 0; i < 4; ++i) {
      next_line("the scanner's position and axes");
      read_finite();
    }
    for (int i = 0; i < 4; ++i) {
      next_line("the motion of the scanner");
      const Vector row = read_finite();
      if (i < 3) m_world_from_scanner.rotation.col(i) = row;
      else m_world_from_scanner.translation = row;
      if (m_cursor.number("the last column of the motion") != (i < 3 ? 0 : 1))
        m_cursor.fail("the last column of the motion is not 0 0 0 1");
    }
    const Matrix& r = m_world_from_scanner.rotation;
    if (!((r * r.transpose()).isIdentity(1e-3) && r.determinant() > 0))
      m_cursor.fail("the motion of the scanner is not rigid");
  }

  Flat_scan_file read_samples()
  {
    Flat_scan_file scan;
    scan.kind = Flat_scan_file::RANGE_IMAGE;
    scan.columns = m_columns;
    scan.rows = m_rows;
    scan.grid.assign(m_columns * m_rows, -1);
    bool have_colors = true;
    for (std::size_t column = 0; column < m_columns; ++column)
      for (std::size_t row = 0; row < m_rows; ++row) {
        next_sample(column * m_rows + row);
        const auto c = read_coordinates(m_cursor);
        const Vector p(c[0], c[1], c[2]);
        if (!p.allFinite() || p.isZero(0)) {
          ++scan.missing;
          continue;
        }
        scan.grid[row * m_columns + column] = static_cast<std::int32_t>(scan.points.size());
        scan.points.push_back(m_world_from_scanner(p));
        Color color;
        if (have_colors && (have_colors = read_color(color))) scan.colors.push_back(color);
      }
    if (!have_colors) scan.colors.clear();
    if (scan.points.empty()) throw IO_error(m_cursor.file(), "the range image has no samples");
    scan.sensor = {Flat_sensor::PERSPECTIVE, m_world_from_scanner.translation};
    return scan;
  }

  // Behind the coordinates of a sample: the intensity, then red, green and blue up to 255, if they are there.
  bool read_color(Color& color)
  {
    if (!m_cursor.has_word()) return false;
    m_cursor.number("the intensity");
    for (std::uint8_t& part : color) {
      if (!m_cursor.has_word()) return false;
      part = part_of_color(m_cursor.number("a part of the colour"), 255);
    }
    return true;
  }

  // is there another scan? Its first line is the cursor's then.
  bool skip_samples()
  {
    for (std::size_t i = 0; i < m_columns * m_rows; ++i) next_sample(i);
    return m_cursor.next_line();
  }

  void next_sample(std::size_t i)
  {
    if (!m_cursor.next_line())
      m_cursor.fail("the file ends after " + std::to_string(i) + " of " + std::to_string(m_columns * m_rows) +
                    " samples");
  }

  Vector read_finite()
  {
    const auto c = read_coordinates(m_cursor);
    Vector v(c[0], c[1], c[2]);
    if (!v.allFinite()) m_cursor.fail("a number is NaN or infinite");
    return v;
  }

  Text_cursor m_cursor;
  std::size_t m_size;
  std::size_t m_columns = 0, m_rows = 0;
  Rigid_motion m_world_from_scanner;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_INTERNAL_READ_PTX_H
