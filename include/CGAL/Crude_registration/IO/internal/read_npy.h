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

#ifndef CGAL_CRUDE_REGISTRATION_IO_INTERNAL_READ_NPY_H
#define CGAL_CRUDE_REGISTRATION_IO_INTERNAL_READ_NPY_H

// Reads arrays of points that NumPy wrote.

#include <CGAL/Crude_registration/IO/IO_error.h>
#include <CGAL/Crude_registration/IO/internal/Flat_scan_file.h>
#include <CGAL/Crude_registration/IO/internal/binary_numbers.h>
#include <CGAL/Crude_registration/IO/internal/column_roles.h>

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// An array of n x 3 or more floating-point numbers: points, and where it is n x 6 or n x 9, their normals if these are
// unit vectors, and their colours if they are whole numbers from 0 to 255; or of rows x columns x 3: a range image. NaN
// is left.
class Npy_reader
{
public:
  Npy_reader(std::string_view data, const std::string& file) : m_data(data), m_file(file) {}

  Flat_scan_file read()
  {
    read_header();
    const bool is_image = m_shape.size() == 3;
    if ((m_shape.size() != 2 && !is_image) || m_shape.back() < 3 || (is_image && m_shape.back() != 3))
      fail("the array is neither of n x 3 or more numbers, nor of rows x columns x 3");
    const std::size_t n = is_image ? m_shape[0] * m_shape[1] : m_shape[0], width = m_shape.back();
    Flat_scan_file scan;
    scan.points.reserve(n);
    for (std::size_t i = 0; i < n; ++i) scan.points.emplace_back(at(i, 0), at(i, 1), at(i, 2));
    if (!is_image && (width == 6 || width == 9))
      for (std::size_t column = 3; column < width; column += 3) {
        std::vector<Vector> columns;
        columns.reserve(n);
        for (std::size_t i = 0; i < n; ++i) columns.emplace_back(at(i, column), at(i, column + 1), at(i, column + 2));
        if (take_columns(std::move(columns), scan) == NORMAL_COLUMNS) m_normals_at = column;
      }
    if (is_image) {
      scan.kind = Flat_scan_file::RANGE_IMAGE;
      scan.rows = m_shape[0];
      scan.columns = m_shape[1];
      scan.grid.resize(n);
      std::iota(scan.grid.begin(), scan.grid.end(), 0);
    }
    return scan;
  }

  // After read(), for what writes the file anew: where a number of a point stands, and how; and the first column of its
  // normal, where it has one.
  std::size_t place(std::size_t i, std::size_t k) const
  {
    const std::size_t width = m_shape.back();
    std::size_t at = i * width + k;
    if (m_fortran) {
      const std::size_t points = m_shape.size() == 3 ? m_shape[0] * m_shape[1] : m_shape[0];
      if (m_shape.size() == 3) i = i / m_shape[1] + i % m_shape[1] * m_shape[0]; // row and column
      at = k * points + i;
    }
    return m_body + at * m_size;
  }
  std::size_t normals_at() const { return m_normals_at; }
  std::size_t size_of_number() const { return m_size; }
  bool is_big_endian() const { return m_big_endian; }

private:
  [[noreturn]] void fail(const std::string& what, std::size_t byte = 0) const
  {
    throw IO_error(m_file, "byte " + std::to_string(byte) + ": " + what);
  }

  void read_header()
  {
    const std::size_t version_at = 6, sizes_at = 8;
    if (m_data.size() < 12) fail("the file ends within the header", m_data.size());
    const bool is_first = m_data[version_at] == 1; // then two bytes have the length, else four
    const std::size_t start = sizes_at + (is_first ? 2 : 4);
    const std::size_t length =
        is_first ? number_at<std::uint16_t>(m_data, sizes_at) : number_at<std::uint32_t>(m_data, sizes_at);
    if (m_data.size() - start < length) fail("the file ends within the header", m_data.size());
    const std::string_view header = m_data.substr(start, length);
    m_body = start + length;

    const std::string_view type = value_of(header, "'descr':");
    if (type.size() < 5 ||
        (type.substr(1, 3) != "<f4" && type.substr(1, 3) != "<f8" && type.substr(1, 3) != ">f4" &&
         type.substr(1, 3) != ">f8") ||
        type[4] != type[0])
      fail("the numbers of the array are not f4 or f8: " + std::string(type.substr(0, 20)), start);
    m_big_endian = type[1] == '>';
    m_size = type[3] == '4' ? 4 : 8;
    const std::string_view order = value_of(header, "'fortran_order':");
    m_fortran = order.substr(0, 4) == "True";
    if (!m_fortran && order.substr(0, 5) != "False") fail("'fortran_order' is neither True nor False", start);
    read_shape(value_of(header, "'shape':"), start);
  }

  std::string_view value_of(std::string_view header, std::string_view key) const
  {
    const std::size_t found = header.find(key);
    if (found == std::string_view::npos) fail("the header has no " + std::string(key.substr(0, key.size() - 1)));
    std::string_view value = header.substr(found + key.size());
    value.remove_prefix((std::min)(value.find_first_not_of(' '), value.size()));
    return value;
  }

  void read_shape(std::string_view text, std::size_t start)
  {
    const std::size_t end = text.find(')');
    if (text.empty() || text[0] != '(' || end == std::string_view::npos) fail("'shape' is no list", start);
    const char *p = text.data() + 1, *const last = text.data() + end;
    std::size_t total = 1;
    while (p != last) {
      if (*p == ' ' || *p == ',') {
        ++p;
        continue;
      }
      std::size_t n = 0;
      const auto r = std::from_chars(p, last, n);
      if (r.ec != std::errc()) fail("'shape' holds what is no size", start);
      p = r.ptr;
      // what the file cannot hold must not make us ask for the memory
      if (n > 0 && total > (m_data.size() - m_body) / m_size / n)
        fail("the file is too short for the shape of its array", m_data.size());
      total *= n;
      m_shape.push_back(n);
    }
    if (total > static_cast<std::size_t>((std::numeric_limits<std::int32_t>::max)()))
      fail("the array has 2^31 numbers or more", start);
  }

  double at(std::size_t i, std::size_t k) const
  {
    const std::size_t byte = place(i, k);
    return m_size == 4 ? static_cast<double>(number_at<float>(m_data, byte, m_big_endian))
                       : number_at<double>(m_data, byte, m_big_endian);
  }

  std::string_view m_data;
  const std::string& m_file;
  std::size_t m_body = 0, m_size = 0, m_normals_at = 3;
  bool m_big_endian = false, m_fortran = false;
  std::vector<std::size_t> m_shape;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_INTERNAL_READ_NPY_H
