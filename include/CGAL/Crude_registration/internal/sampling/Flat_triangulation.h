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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_FLAT_TRIANGULATION_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_FLAT_TRIANGULATION_H

// The triangulation of a range image's grid.

#include <CGAL/Crude_registration/internal/mesh/Flat_mesh.h>
#include <CGAL/Crude_registration/internal/sampling/Flat_range_image.h>
#include <CGAL/Crude_registration/internal/base/Run_control.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The triangulation of a range image's grid: section 4 of the paper. Three passes over the grid:
// 1. every cell of four samples gets a code, the set of its triangles;
// 2. every sample with a triangle becomes a vertex, or several: where its triangles form fans that share no edge (a bow
//    tie, which no halfedge structure can hold), each fan gets a vertex of its own;
// 3. the triangles are written out.
//
// The samples of a cell, and the triangles it can have, which turn from columns to rows:
//    c - d     triangle 0: a b d    triangle 1: a d c    (diagonal a d)
//    |   |     triangle 2: a b c    triangle 3: b d c    (diagonal b c)
//    a - b     a is at (column, row), b at (column + 1, row), c at (column, row + 1)
class Flat_triangulation
{
public:
  // no edge is longer than `ratio` times the sampling distance, the one at the edge's nearer end under a perspective
  // sensor
  Flat_triangulation(const Flat_range_image& image, const Sampling& sampling, double ratio, Run_control& control)
      : m_image(image), m_control(control), m_has_extent(sampling.distance > 0)
  {
    const double factor = 1 + 1e-9; // an edge of just this length is not left to rounding
    const double distance = ratio * sampling.distance;
    m_squared_limits.assign(image.points.size(), factor * distance * distance);
    if (image.sensor.kind == Flat_sensor::PERSPECTIVE) {
      const double angle = ratio * sampling.angle;
      for (std::size_t i = 0; i < image.points.size(); ++i)
        m_squared_limits[i] = factor * angle * angle * (image.points[i] - image.sensor.vector).squaredNorm();
    }
    control.check();
  }

  // \throws Run_control::Stopped
  Flat_mesh operator()()
  {
    Flat_mesh mesh;
    if (!m_has_extent || m_image.columns < 2 || m_image.rows < 2) return mesh;
    code_cells();
    make_vertices(mesh);
    make_faces(mesh);
    return mesh;
  }

private:
  enum Corner
  {
    A,
    B,
    C,
    D
  };
  static constexpr std::array<std::array<Corner, 3>, 4> triangles = {{{A, B, D}, {A, D, C}, {A, B, C}, {B, D, C}}};

  // The surroundings of a sample are eight sectors of 45 degrees, counted from the direction of the columns towards
  // that of the rows. It is corner A of the cell that covers sectors 0 and 1, B of that with 2 and 3, D with 4 and 5, C
  // with 6 and 7. Which of the two (bit 0 the first) does a triangle cover at a corner?
  static constexpr std::array<unsigned, 4> first_sector = {0, 2, 6, 4};
  static constexpr std::array<std::array<unsigned, 4>, 4> sectors_at_corner = {
      {{1, 2, 3, 0}, {3, 0, 2, 1}, {0, 3, 1, 2}, {2, 1, 0, 3}}};

  // the same for all triangles of a cell
  static unsigned sectors(unsigned code, Corner corner)
  {
    unsigned result = 0;
    for (unsigned t = 0; t < 4; ++t)
      if (code >> t & 1u) result |= sectors_at_corner[corner][t];
    return result << first_sector[corner];
  }

  // the first sectors of the fans that the sectors form, around the circle
  static unsigned fan_starts(unsigned sectors) { return sectors & ~(sectors << 1 | sectors >> 7) & 0xFFu; }

  static unsigned count_bits(unsigned bits)
  {
    unsigned n = 0;
    for (; bits != 0; bits &= bits - 1) ++n;
    return n;
  }

  std::size_t sample(std::size_t cell) const { return static_cast<std::size_t>(m_image.grid[cell]); }
  const Vector& point(std::size_t cell) const { return m_image.points[sample(cell)]; }
  bool is_valid(std::size_t cell) const { return m_image.grid[cell] >= 0; }

  double squared_length(std::size_t p, std::size_t q) const { return (point(p) - point(q)).squaredNorm(); }

  double squared_limit(std::size_t p, std::size_t q) const
  {
    return (std::min)(m_squared_limits[sample(p)], m_squared_limits[sample(q)]);
  }

  bool is_short(std::size_t p, std::size_t q) const { return squared_length(p, q) <= squared_limit(p, q); }

  std::size_t cell_of_corner(std::size_t cell, Corner corner) const
  {
    return cell + (corner == B || corner == D ? 1 : 0) + (corner == C || corner == D ? m_image.columns : 0);
  }

  void code_cells()
  {
    m_codes.assign(m_image.columns * m_image.rows, 0);
    std::ptrdiff_t towards = 0; // faces turned to the sensor less those turned away
    for (std::size_t row = 0; row + 1 < m_image.rows; ++row) {
      m_control.check();
      for (std::size_t column = 0; column + 1 < m_image.columns; ++column) {
        const std::size_t cell = row * m_image.columns + column;
        const unsigned code = code_of_cell(cell);
        if (code == 0) continue;
        m_codes[cell] = static_cast<std::uint8_t>(code);
        for (unsigned t = 0; t < 4; ++t) {
          if ((code >> t & 1u) == 0) continue;
          ++m_number_of_faces;
          towards += side(cell, t);
        }
      }
    }
    m_is_reversed = towards < 0;
  }

  // the set of the cell's triangles
  unsigned code_of_cell(std::size_t a) const
  {
    const std::size_t b = a + 1, c = a + m_image.columns, d = c + 1;
    const int missing = (is_valid(a) ? 0 : 1) + (is_valid(b) ? 0 : 1) + (is_valid(c) ? 0 : 1) + (is_valid(d) ? 0 : 1);
    if (missing > 1) return 0;
    if (missing == 0) {
      const bool ab = is_short(a, b), ac = is_short(a, c), bd = is_short(b, d), cd = is_short(c, d);
      // the shorter diagonal; between equal ones rounding, and with it the frame, has no say
      const double ad2 = squared_length(a, d), bc2 = squared_length(b, c);
      if (ad2 <= bc2 * (1 + 1e-9)) return ad2 > squared_limit(a, d) ? 0u : (ab && bd ? 1u : 0u) | (cd && ac ? 2u : 0u);
      return bc2 > squared_limit(b, c) ? 0u : (ab && ac ? 4u : 0u) | (bd && cd ? 8u : 0u);
    }
    if (!is_valid(c)) return is_short(a, b) && is_short(b, d) && is_short(a, d) ? 1u : 0u;
    if (!is_valid(b)) return is_short(a, d) && is_short(c, d) && is_short(a, c) ? 2u : 0u;
    if (!is_valid(d)) return is_short(a, b) && is_short(b, c) && is_short(a, c) ? 4u : 0u;
    return is_short(b, d) && is_short(c, d) && is_short(b, c) ? 8u : 0u;
  }

  // 1 if the triangle, as it turns from columns to rows, is counterclockwise seen from the sensor, -1 if clockwise
  std::ptrdiff_t side(std::size_t cell, unsigned t) const
  {
    if (m_image.sensor.kind == Flat_sensor::UNKNOWN) return 1;
    const Vector& p = point(cell_of_corner(cell, triangles[t][0]));
    const Vector normal =
        (point(cell_of_corner(cell, triangles[t][1])) - p).cross(point(cell_of_corner(cell, triangles[t][2])) - p);
    const double along = normal.dot(m_image.sensor.towards(p));
    return along < 0 ? 1 : along > 0 ? -1 : 0;
  }

  void make_vertices(Flat_mesh& mesh)
  {
    std::array<std::array<unsigned, 16>, 4> table;
    for (unsigned corner = 0; corner < 4; ++corner)
      for (unsigned code = 0; code < 16; ++code) table[corner][code] = sectors(code, static_cast<Corner>(corner));
    const std::size_t columns = m_image.columns;
    m_vertices.assign(m_image.points.size(), -1);
    m_fan_starts.assign(m_image.points.size(), 0);
    mesh.points.reserve(m_image.points.size());
    for (std::size_t row = 0; row < m_image.rows; ++row) {
      m_control.check();
      for (std::size_t column = 0; column < columns; ++column) {
        const std::size_t cell = row * columns + column;
        if (!is_valid(cell)) continue;
        unsigned covered = table[A][m_codes[cell]];
        if (column > 0) covered |= table[B][m_codes[cell - 1]];
        if (row > 0) covered |= table[C][m_codes[cell - columns]];
        if (column > 0 && row > 0) covered |= table[D][m_codes[cell - columns - 1]];
        if (covered == 0) continue;
        const std::size_t i = sample(cell);
        m_vertices[i] = static_cast<std::int32_t>(mesh.points.size());
        const unsigned starts = fan_starts(covered);
        const unsigned fans = (std::max)(1u, count_bits(starts)); // a fan all around has no start
        if (fans > 1) m_fan_starts[i] = static_cast<std::uint8_t>(starts);
        mesh.points.insert(mesh.points.end(), fans, m_image.points[i]);
      }
    }
  }

  void make_faces(Flat_mesh& mesh) const
  {
    mesh.faces.reserve(m_number_of_faces);
    for (std::size_t cell = 0; cell < m_codes.size(); ++cell) {
      m_control.check(cell);
      if (m_codes[cell] == 0) continue;
      for (unsigned t = 0; t < 4; ++t) {
        if ((m_codes[cell] >> t & 1u) == 0) continue;
        std::array<std::int32_t, 3> face;
        for (std::size_t k = 0; k < 3; ++k) face[k] = vertex(cell, t, triangles[t][k]);
        if (m_is_reversed) std::swap(face[1], face[2]);
        mesh.faces.push_back(face);
      }
    }
  }

  // the vertex that stands for a corner of a triangle: that of the fan the triangle is in
  std::int32_t vertex(std::size_t cell, unsigned t, Corner corner) const
  {
    const std::size_t i = sample(cell_of_corner(cell, corner));
    const unsigned starts = m_fan_starts[i];
    if (starts == 0) return m_vertices[i];
    const unsigned sector = first_sector[corner] + (sectors_at_corner[corner][t] == 2 ? 1 : 0);
    const unsigned fans = count_bits(starts);
    const unsigned fan = (count_bits(starts & ((2u << sector) - 1)) + fans - 1) % fans; // before the first: the last
    return m_vertices[i] + static_cast<std::int32_t>(fan);
  }

  const Flat_range_image& m_image;
  Run_control& m_control;
  const bool m_has_extent;                // are there adjacent samples apart from each other?
  std::vector<double> m_squared_limits;   // per sample
  std::vector<std::uint8_t> m_codes;      // per cell: the set of its triangles, by its corner A
  std::vector<std::int32_t> m_vertices;   // per sample: its first vertex
  std::vector<std::uint8_t> m_fan_starts; // per sample: 0, or the first sectors of a bow tie's fans
  std::size_t m_number_of_faces = 0;
  bool m_is_reversed = false;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_FLAT_TRIANGULATION_H
