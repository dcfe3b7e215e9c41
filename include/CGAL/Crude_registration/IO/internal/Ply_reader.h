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

#ifndef CGAL_CRUDE_REGISTRATION_IO_INTERNAL_PLY_READER_H
#define CGAL_CRUDE_REGISTRATION_IO_INTERNAL_PLY_READER_H

// Reads PLY, with a range grid, faces or points alone.

#include <CGAL/Crude_registration/IO/IO_error.h>
#include <CGAL/Crude_registration/IO/internal/Flat_scan_file.h>
#include <CGAL/Crude_registration/IO/internal/Ply_elements.h>
#include <CGAL/Crude_registration/IO/internal/Text_cursor.h>
#include <CGAL/Crude_registration/IO/internal/binary_numbers.h>

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

// What this package takes from a PLY file; all else in it is passed over.
struct Ply_contents
{
  std::vector<std::array<double, 3>> points;  // may be NaN or infinite
  std::vector<std::array<double, 3>> normals; // one a point, or none
  std::vector<Color> colors;                  // one a point, or none
  bool has_grid = false;                      // is there an `element range_grid`?
  std::size_t columns = 0, rows = 0;
  std::vector<std::int32_t> grid; // row by row; -1 where there is no sample
  bool has_viewpoint = false,
       has_viewing_direction = false; // `obj_info viewpoint x y z`, as write_range_image() writes
  std::array<double, 3> viewpoint = {0, 0, 0}, viewing_direction = {0, 0, 0};
  std::vector<std::vector<std::size_t>> faces;
};

// The reader reads as the file: header, then element by element, each property by its role.
class Ply_reader
{
public:
  // `file` is only named in errors
  Ply_reader(std::string_view data, const std::string& file) : m_data(data), m_file(file) {}

  Ply_contents read()
  {
    read_header();
    if (m_format == ASCII) {
      Ply_ascii source(m_data.substr(m_body), m_file, m_body_line);
      read_body(source);
    } else if ((m_format == BINARY_LITTLE_ENDIAN) == is_little_endian()) {
      Ply_binary<false> source(m_data, m_body, m_file);
      read_body(source);
    } else {
      Ply_binary<true> source(m_data, m_body, m_file);
      read_body(source);
    }
    check_grid();
    return std::move(m_contents);
  }

  // --- for what writes the file anew ---------------------------------------------------------------------------------

  // Before what follows here.
  void read_head() { read_header(); }

  // What the head says of a sensor: a place or a direction.
  struct Sensor_words
  {
    bool is_direction;
    std::array<std::string_view, 3> words;
    std::array<double, 3> values;
  };
  const std::vector<Sensor_words>& sensor_words() const { return m_sensor_words; }
  const std::vector<Ply_element>& elements() const { return m_elements; }
  bool is_text() const { return m_format == ASCII; }
  bool is_big_endian() const { return m_format == BINARY_BIG_ENDIAN; }
  std::size_t body() const { return m_body; }
  std::size_t body_line() const { return m_body_line; }

private:
  enum Format
  {
    NO_FORMAT,
    ASCII,
    BINARY_LITTLE_ENDIAN,
    BINARY_BIG_ENDIAN
  };

  // --- header -------------------------------------------------------------------------------------------------------

  void read_header()
  {
    Text_cursor cursor(m_data, m_file);
    if (!cursor.next_line() || cursor.word() != "ply") cursor.fail("not a PLY file: its first line is not 'ply'");
    for (;;) {
      if (!cursor.next_line()) cursor.fail("the file ends before 'end_header'");
      const std::string_view keyword = cursor.word();
      if (keyword == "format") read_format(cursor);
      else if (keyword == "element") read_element(cursor);
      else if (keyword == "property") read_property(cursor);
      else if (keyword == "obj_info") read_obj_info(cursor);
      else if (keyword == "end_header") break;
      else if (keyword != "comment") cursor.fail("unknown word in the header: '" + shown(keyword) + "'");
    }
    m_body = static_cast<std::size_t>(cursor.next_line_begin() - m_data.data());
    m_body_line = cursor.next_line_number();
    if (m_format == NO_FORMAT) cursor.fail("the header has no 'format'");
    assign_roles(cursor);
  }

  void read_format(Text_cursor& cursor)
  {
    const std::string_view format = cursor.word();
    if (format == "ascii") m_format = ASCII;
    else if (format == "binary_little_endian") m_format = BINARY_LITTLE_ENDIAN;
    else if (format == "binary_big_endian") m_format = BINARY_BIG_ENDIAN;
    else cursor.fail("unknown format: '" + shown(format) + "'");
  }

  void read_element(Text_cursor& cursor)
  {
    Ply_element e;
    e.name = std::string(cursor.word());
    if (e.name.empty()) cursor.fail("the element has no name");
    for (const Ply_element& other : m_elements)
      if (other.name == e.name) cursor.fail("the element '" + shown(e.name) + "' is declared twice");
    const long long count = cursor.integer("the number of elements");
    if (count < 0) cursor.fail("the number of elements is negative");
    e.count = static_cast<std::uint64_t>(count);
    e.line = cursor.line();
    m_elements.push_back(e);
  }

  void read_property(Text_cursor& cursor)
  {
    if (m_elements.empty()) cursor.fail("a property before the first element");
    Ply_property p;
    std::string_view type = cursor.word();
    p.is_list = type == "list";
    p.count_type = Ply_type::UINT8;
    if (p.is_list) {
      p.count_type = read_type(cursor, cursor.word());
      if (p.count_type == Ply_type::FLOAT32 || p.count_type == Ply_type::FLOAT64)
        cursor.fail("the length of a list is not an integer type");
      type = cursor.word();
    }
    p.type = read_type(cursor, type);
    p.name = std::string(cursor.word());
    if (p.name.empty()) cursor.fail("the property has no name");
    p.role = Ply_role::SKIP;
    m_elements.back().properties.push_back(p);
  }

  static Ply_type read_type(const Text_cursor& cursor, std::string_view name)
  {
    if (name == "char" || name == "int8") return Ply_type::INT8;
    if (name == "uchar" || name == "uint8") return Ply_type::UINT8;
    if (name == "short" || name == "int16") return Ply_type::INT16;
    if (name == "ushort" || name == "uint16") return Ply_type::UINT16;
    if (name == "int" || name == "int32") return Ply_type::INT32;
    if (name == "uint" || name == "uint32") return Ply_type::UINT32;
    if (name == "float" || name == "float32") return Ply_type::FLOAT32;
    if (name == "double" || name == "float64") return Ply_type::FLOAT64;
    cursor.fail("unknown type: '" + shown(name) + "'");
  }

  void read_obj_info(Text_cursor& cursor)
  {
    const std::string_view key = cursor.word();
    if (key == "num_cols") m_contents.columns = read_size(cursor, "num_cols");
    if (key == "num_rows") m_contents.rows = read_size(cursor, "num_rows");
    if (key == "viewpoint") m_contents.has_viewpoint = read_vector(cursor, m_contents.viewpoint, "viewpoint");
    if (key == "viewing_direction")
      m_contents.has_viewing_direction = read_vector(cursor, m_contents.viewing_direction, "viewing_direction");
    if (m_contents.has_viewing_direction && m_contents.viewing_direction == std::array<double, 3>{0, 0, 0})
      cursor.fail("viewing_direction is null");
  }

  static std::size_t read_size(Text_cursor& cursor, const char* key)
  {
    const long long n = cursor.integer(key);
    if (n <= 0) cursor.fail(std::string(key) + " is not positive");
    return static_cast<std::size_t>(n);
  }

  bool read_vector(Text_cursor& cursor, std::array<double, 3>& v, const char* key)
  {
    Text_cursor words = cursor;
    for (double& coordinate : v) {
      coordinate = cursor.number(key);
      if (!std::isfinite(coordinate)) cursor.fail(std::string(key) + " is not finite");
    }
    Sensor_words found = {std::string_view(key) == "viewing_direction", {}, v};
    for (std::string_view& word : found.words) word = words.word();
    m_sensor_words.push_back(found);
    return true;
  }

  // which properties are read as what
  void assign_roles(const Text_cursor& cursor)
  {
    bool has_vertices = false;
    for (Ply_element& e : m_elements) {
      if (e.name == "vertex") {
        has_vertices = true;
        m_vertex_count = e.count;
        const std::pair<const char*, Ply_role> coordinates[] = {
            {"x", Ply_role::X}, {"y", Ply_role::Y}, {"z", Ply_role::Z}};
        for (const auto& [name, role] : coordinates) {
          Ply_property* p = e.find(name);
          if (p == nullptr || p->is_list)
            throw IO_error(m_file, e.line, std::string("the vertices have no property '") + name + "'");
          p->role = role;
        }
        m_has_normals = assign(e, {"nx", "ny", "nz"}, Ply_role::NX);
        m_has_colors = assign(e, {"red", "green", "blue"}, Ply_role::RED);
      } else if (e.name == "range_grid" || e.name == "face") {
        Ply_property* p = e.find("vertex_indices");
        if (p == nullptr) p = e.find("vertex_index");
        if (p == nullptr && e.name == "face" && e.count == 0) continue; // as PCL's tools write points
        if (p == nullptr || !p->is_list || p->type == Ply_type::FLOAT32 || p->type == Ply_type::FLOAT64)
          throw IO_error(m_file, e.line, "the element '" + e.name + "' has no list of integers 'vertex_indices'");
        p->role = Ply_role::INDICES;
      }
      if (e.name == "range_grid") {
        m_contents.has_grid = true;
        const std::size_t columns = m_contents.columns, rows = m_contents.rows;
        if (columns == 0) cursor.fail("the header has a range_grid, but no 'obj_info num_cols'");
        if (rows == 0) cursor.fail("the header has a range_grid, but no 'obj_info num_rows'");
        if (e.count / columns != rows || e.count % columns != 0)
          throw IO_error(m_file, e.line,
                         "the range_grid has " + std::to_string(e.count) + " cells, but num_cols times num_rows is " +
                             std::to_string(columns) + " times " + std::to_string(rows));
      }
      if (e.count > static_cast<std::uint64_t>((std::numeric_limits<std::int32_t>::max)()))
        throw IO_error(m_file, e.line, "more than 2^31 - 1 elements");
    }
    if (!has_vertices) cursor.fail("the header has no 'element vertex'");
  }

  // Gives three properties roles that follow each other, if they are all there.
  static bool assign(Ply_element& e, const std::array<const char*, 3>& names, Ply_role first)
  {
    std::array<Ply_property*, 3> found;
    for (std::size_t i = 0; i < 3; ++i) found[i] = e.find(names[i]);
    if (!std::all_of(found.begin(), found.end(), [](auto* p) { return p != nullptr && !p->is_list; })) return false;
    for (std::size_t i = 0; i < 3; ++i) found[i]->role = static_cast<Ply_role>(static_cast<std::size_t>(first) + i);
    return true;
  }

  // Of a part of a colour: floats are shares.
  static double largest_color(Ply_type type)
  {
    return type == Ply_type::FLOAT32 || type == Ply_type::FLOAT64 ? 1 : type == Ply_type::UINT16 ? 65535 : 255;
  }

  // --- body ---------------------------------------------------------------------------------------------------------

  template <class Source>
  void read_body(Source& source)
  {
    std::array<double, 9> xyz{}; // and the normal, and the colour in shares of the largest
    std::vector<long long> indices;
    for (const Ply_element& e : m_elements) {
      if (e.properties.empty()) continue;
      const bool is_vertex = e.name == "vertex", is_grid = e.name == "range_grid", is_face = e.name == "face";
      // a count that the file cannot hold must not make us ask for the memory
      const std::size_t expected = static_cast<std::size_t>(std::min<std::uint64_t>(e.count, m_data.size()));
      if (is_vertex) m_contents.points.reserve(expected);
      if (is_vertex && m_has_normals) m_contents.normals.reserve(expected);
      if (is_vertex && m_has_colors) m_contents.colors.reserve(expected);
      if (is_grid) m_contents.grid.reserve(expected);
      if (is_face) m_contents.faces.reserve(expected);
      for (std::uint64_t i = 0; i < e.count; ++i) {
        source.begin_element(e, i);
        for (const Ply_property& p : e.properties) {
          if (p.role >= Ply_role::X && p.role <= Ply_role::BLUE)
            xyz[static_cast<std::size_t>(p.role) - static_cast<std::size_t>(Ply_role::X)] =
                source.number(p) / (p.role >= Ply_role::RED ? largest_color(p.type) : 1);
          else if (p.is_list) read_list(source, p, indices);
          else source.skip(p);
        }
        source.end_element();
        if (is_vertex) {
          m_contents.points.push_back({xyz[0], xyz[1], xyz[2]});
          if (m_has_normals) m_contents.normals.push_back({xyz[3], xyz[4], xyz[5]});
          if (m_has_colors)
            m_contents.colors.push_back({part_of_color(xyz[6], 1), part_of_color(xyz[7], 1), part_of_color(xyz[8], 1)});
        } else if (is_grid) {
          if (indices.size() > 1) source.fail("a cell of the range_grid holds more than one vertex");
          m_contents.grid.push_back(indices.empty() ? -1 : static_cast<std::int32_t>(indices[0]));
        } else if (is_face) {
          m_contents.faces.emplace_back(indices.begin(), indices.end());
        }
      }
    }
  }

  // The list is kept if its role is Ply_role::INDICES: indices of vertices then.
  template <class Source>
  void read_list(Source& source, const Ply_property& p, std::vector<long long>& indices) const
  {
    const long long length = source.count(p);
    if (length < 0) source.fail("the length of a list is negative");
    if (p.role == Ply_role::SKIP) {
      for (long long k = 0; k < length; ++k) source.skip(p);
      return;
    }
    indices.clear();
    for (long long k = 0; k < length; ++k) {
      const long long index = source.index(p);
      if (index < 0 || static_cast<std::uint64_t>(index) >= m_vertex_count)
        source.fail("the vertex index " + std::to_string(index) + " is outside the " + std::to_string(m_vertex_count) +
                    " vertices");
      indices.push_back(index);
    }
  }

  void check_grid() const
  {
    std::vector<bool> used(m_contents.points.size(), false);
    for (std::size_t cell = 0; cell < m_contents.grid.size(); ++cell) {
      if (m_contents.grid[cell] < 0) continue;
      const std::size_t vertex = static_cast<std::size_t>(m_contents.grid[cell]);
      if (used[vertex])
        throw IO_error(m_file, "vertex " + std::to_string(vertex) +
                                   " is in two cells of the range_grid, the second in column " +
                                   std::to_string(cell % m_contents.columns) + ", row " +
                                   std::to_string(cell / m_contents.columns));
      used[vertex] = true;
    }
  }

  static std::string shown(std::string_view word) { return std::string(word.substr(0, 40)); }

  std::string_view m_data;
  const std::string& m_file;
  Format m_format = NO_FORMAT;
  std::vector<Ply_element> m_elements;
  std::vector<Sensor_words> m_sensor_words;
  std::uint64_t m_vertex_count = 0;
  bool m_has_normals = false, m_has_colors = false;
  std::size_t m_body = 0;      // where the body starts, in bytes
  std::size_t m_body_line = 0; // and in lines
  Ply_contents m_contents;
};

// `file` is only named in errors.
inline Ply_contents read_ply(std::string_view data, const std::string& file)
{
  return Ply_reader(data, file).read();
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_INTERNAL_PLY_READER_H
