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

#ifndef CGAL_CRUDE_REGISTRATION_IO_INTERNAL_POLYGON_SOUP_READERS_H
#define CGAL_CRUDE_REGISTRATION_IO_INTERNAL_POLYGON_SOUP_READERS_H

// Reads polygons: OFF, OBJ and STL.

#include <CGAL/Crude_registration/IO/IO_error.h>
#include <CGAL/Crude_registration/IO/internal/Flat_scan_file.h>
#include <CGAL/Crude_registration/IO/internal/Text_cursor.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <string_view>
#include <vector>

// Readers for the common formats of polygon meshes. CGAL's readers of OFF, OBJ and STL say neither what is wrong nor
// where, read by the program's locale, and believe counts and indices that a broken file gives.

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Points may be NaN or infinite.
struct Polygon_soup
{
  std::vector<std::array<double, 3>> points;
  std::vector<std::vector<std::size_t>> polygons;
  std::vector<std::array<double, 3>> normals; // of the points, one each, or none
  std::vector<Color> colors;                  // the same
  std::size_t missing = 0;                    // points that are left out
};

// Three or more words behind the coordinates of a vertex as its colour: shares where one of them is no whole number, or
// all are 0 or 1; else up to 255.
inline void read_color(Text_cursor& cursor, Polygon_soup& soup)
{
  std::array<double, 3> parts{};
  bool are_shares = false, are_small = true;
  for (double& part : parts) {
    if (!cursor.has_word()) return;
    const std::string_view rest = cursor.rest();
    are_shares = are_shares || rest.substr(0, rest.find_first_of(" \t")).find('.') != std::string_view::npos;
    part = cursor.number("a part of the colour");
    are_small = are_small && part <= 1;
  }
  const double largest = are_shares || are_small ? 1 : 255;
  soup.colors.push_back(
      {part_of_color(parts[0], largest), part_of_color(parts[1], largest), part_of_color(parts[2], largest)});
}

// Colours are of all vertices, or of none.
inline void drop_partial_colors(Polygon_soup& soup)
{
  if (soup.colors.size() != soup.points.size()) soup.colors.clear();
}

// OFF, with the optional prefixes of its keyword for what else stands in a vertex's line (which is passed over).
inline Polygon_soup read_off(std::string_view text, const std::string& file)
{
  Text_cursor cursor(text, file);
  const auto next_data_line = [&] {
    while (cursor.next_line())
      if (cursor.rest()[0] != '#') return true;
    return false;
  };
  if (!next_data_line()) cursor.fail("the file is empty");
  std::string_view keyword = cursor.word();
  const std::string shown(keyword.substr(0, 40));
  if (keyword.substr(0, 2) == "ST") keyword.remove_prefix(2);
  const bool has_colors = keyword.substr(0, 1) == "C";
  if (has_colors) keyword.remove_prefix(1);
  const bool has_normals = keyword.substr(0, 1) == "N";
  if (has_normals) keyword.remove_prefix(1);
  if (keyword != "OFF") cursor.fail("not an OFF file of points in space: '" + shown + "'");
  if (cursor.has_word() && cursor.rest().substr(0, 6) == "BINARY") cursor.fail("binary OFF is not read");
  if (!cursor.has_word() && !next_data_line()) cursor.fail("the file ends before the numbers of vertices and faces");
  const long long vertices = cursor.integer("the number of vertices"), faces = cursor.integer("the number of faces");
  if (vertices < 0 || faces < 0) cursor.fail("the number of vertices or faces is negative");

  Polygon_soup soup;
  for (long long i = 0; i < vertices; ++i) {
    if (!next_data_line())
      cursor.fail("the file ends after " + std::to_string(i) + " of " + std::to_string(vertices) + " vertices");
    soup.points.push_back(read_coordinates(cursor));
    if (has_normals) read_coordinates(cursor);
    if (has_colors) read_color(cursor, soup);
  }
  drop_partial_colors(soup);
  for (long long i = 0; i < faces; ++i) {
    if (!next_data_line())
      cursor.fail("the file ends after " + std::to_string(i) + " of " + std::to_string(faces) + " faces");
    const long long n = cursor.integer("the number of vertices of the face");
    if (n < 0) cursor.fail("the number of vertices of the face is negative");
    soup.polygons.emplace_back();
    for (long long k = 0; k < n; ++k) {
      const long long v = cursor.integer("a vertex of the face");
      if (v < 0 || v >= vertices)
        cursor.fail("the vertex index " + std::to_string(v) + " is outside the " + std::to_string(vertices) +
                    " vertices");
      soup.polygons.back().push_back(static_cast<std::size_t>(v));
    }
  }
  return soup;
}

// OBJ: the vertices and faces; all other lines are passed over.
inline Polygon_soup read_obj(std::string_view text, const std::string& file)
{
  Text_cursor cursor(text, file);
  Polygon_soup soup;
  while (cursor.next_line()) {
    const std::string_view keyword = cursor.word();
    if (keyword == "v") {
      soup.points.push_back(read_coordinates(cursor));
      read_color(cursor, soup);
    } else if (keyword == "f") {
      soup.polygons.emplace_back();
      while (cursor.has_word()) {
        const std::string_view word = cursor.word(); // vertex, vertex/texture, vertex//normal, ...
        long long v = 0;
        const char* last = word.data() + word.size();
        const auto r = std::from_chars(word.data(), last, v);
        if (r.ec != std::errc() || (r.ptr != last && *r.ptr != '/'))
          cursor.fail("a vertex of the face is not an integer: '" + std::string(word.substr(0, 40)) + "'");
        const long long count = static_cast<long long>(soup.points.size());
        if (v == 0 || v > count || v < -count)
          cursor.fail("the vertex index " + std::to_string(v) + " is outside the " + std::to_string(count) +
                      " vertices so far");
        soup.polygons.back().push_back(static_cast<std::size_t>(v > 0 ? v - 1 : count + v));
      }
    }
  }
  drop_partial_colors(soup);
  return soup;
}

// STL repeats a point for each of its triangles: equal points become one, in the order in which they first stand.
class Stl_reader
{
public:
  Stl_reader(std::string_view data, const std::string& file) : m_data(data), m_file(file) {}

  Polygon_soup read()
  {
    // binary files may start with "solid", too: but only in them the size fits the count
    if (is_binary()) read_binary();
    else read_ascii();
    return m_soup;
  }

  static constexpr std::size_t header = 84, record = 50;

  // of the triangles of a binary file
  std::uint32_t count() const
  {
    std::uint32_t n = 0;
    for (std::size_t i = 0; i < 4; ++i)
      n |= static_cast<std::uint32_t>(static_cast<unsigned char>(m_data[header - 4 + i])) << 8 * i;
    return n;
  }

  bool is_binary() const
  {
    if (m_data.size() < header) return false;
    return m_data.size() - header == record * std::size_t(count()) || m_data.substr(0, 5) != "solid";
  }

private:
  void read_binary()
  {
    const std::size_t n = count();
    if ((m_data.size() - header) / record < n)
      throw IO_error(m_file, "byte " + std::to_string(m_data.size()) + ": the file ends after " +
                                 std::to_string((m_data.size() - header) / record) + " of " + std::to_string(n) +
                                 " triangles");
    for (std::size_t i = 0; i < n; ++i) {
      std::vector<std::array<double, 3>> triangle;
      for (std::size_t k = 0; k < 3; ++k) {
        std::array<double, 3> p;
        for (std::size_t j = 0; j < 3; ++j) {
          const std::size_t at = header + record * i + 12 + 12 * k + 4 * j; // behind the normal
          std::uint32_t bits = 0;
          for (std::size_t b = 0; b < 4; ++b)
            bits |= static_cast<std::uint32_t>(static_cast<unsigned char>(m_data[at + b])) << 8 * b;
          float coordinate;
          std::memcpy(&coordinate, &bits, sizeof coordinate);
          p[j] = static_cast<double>(coordinate);
        }
        triangle.push_back(p);
      }
      add(triangle);
    }
  }

  void read_ascii()
  {
    Text_cursor cursor(m_data, m_file);
    if (!cursor.next_line() || cursor.word() != "solid") cursor.fail("not an STL file: it does not start with 'solid'");
    std::vector<std::array<double, 3>> triangle;
    while (cursor.next_line()) {
      const std::string_view keyword = cursor.word();
      if (keyword == "vertex") triangle.push_back(read_coordinates(cursor));
      else if (keyword == "endloop") {
        if (triangle.size() != 3) cursor.fail("the loop has " + std::to_string(triangle.size()) + " vertices, not 3");
        add(triangle);
        triangle.clear();
      } else if (keyword != "facet" && keyword != "outer" && keyword != "endfacet" && keyword != "endsolid" &&
                 keyword != "solid")
        cursor.fail("unknown word: '" + std::string(keyword.substr(0, 40)) + "'");
    }
    if (!triangle.empty()) cursor.fail("the file ends within a facet");
  }

  // Corners that are NaN or infinite are counted, and have no place in an order.
  void add(const std::vector<std::array<double, 3>>& triangle)
  {
    std::size_t missing = 0;
    for (const auto& p : triangle)
      if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2])) ++missing;
    m_soup.missing += missing;
    if (missing > 0) return;
    m_soup.polygons.emplace_back();
    for (const auto& p : triangle) m_soup.polygons.back().push_back(vertex(p));
  }

  std::size_t vertex(const std::array<double, 3>& p)
  {
    const auto found = m_vertices.emplace(p, m_soup.points.size());
    if (found.second) m_soup.points.push_back(p);
    return found.first->second;
  }

  std::string_view m_data;
  const std::string& m_file;
  Polygon_soup m_soup;
  std::map<std::array<double, 3>, std::size_t> m_vertices;
};

inline Polygon_soup read_stl(std::string_view data, const std::string& file)
{
  return Stl_reader(data, file).read();
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_INTERNAL_POLYGON_SOUP_READERS_H
