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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_LINES_OF_SIGHT_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_LINES_OF_SIGHT_H

// What is visible from where, among samples of a surface that stand for discs.

#include <CGAL/Crude_registration/internal/base/Flat_sensor.h>
#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/internal/base/Run_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// A disc about each sample, at most one in each cell of a grid, and the lines that they block.
class Lines_of_sight
{
public:
  // `corner`: of the grid, below all points. Where the cells would be more than some million there is no grid.
  Lines_of_sight(std::vector<Vector> points, std::vector<Vector> normals, const Vector& corner, double cell)
      : m_points(std::move(points)), m_normals(std::move(normals)), m_corner(corner), m_cell(cell)
  {
    Vector high = corner;
    for (const Vector& p : m_points) high = high.cwiseMax(p);
    const Vector size = ((high - corner) / cell).array().floor() + 1;
    if (!(size.prod() <= double(1 << 21))) return;
    for (std::size_t k = 0; k < 3; ++k) m_cells[k] = std::int32_t(size[Eigen::Index(k)]);
    m_strides = {1, m_cells[0] + 2, (m_cells[0] + 2) * (m_cells[1] + 2)};
    m_grid.assign(std::size_t(m_strides[2]) * std::size_t(m_cells[2] + 2), outside);
    for (std::int32_t z = 0; z < m_cells[2]; ++z)
      for (std::int32_t y = 0; y < m_cells[1]; ++y) std::fill_n(m_grid.begin() + index({0, y, z}), m_cells[0], empty);
    for (std::size_t i = 0; i < m_points.size(); ++i) m_grid[std::size_t(index(cell_of(i)))] = std::int32_t(i);
  }

  bool has_grid() const { return !m_grid.empty(); }
  std::size_t size() const { return m_points.size(); }
  double cell() const { return m_cell; }
  const Vector& point(std::size_t i) const { return m_points[i]; }
  const Vector& normal(std::size_t i) const { return m_normals[i]; }

  // Lines nearer than this to a disc's own plane say nothing of it: it is not as flat as that.
  static constexpr double grazing = 0.2;

  // What the line from the place to sample i says: 1 if nothing is in between, -1 if something is, 0 if it is grazing.
  int visibility(std::size_t i, const Vector& place) const
  {
    const Vector d = place - m_points[i];
    const double length = d.norm();
    if (!(std::abs(d.dot(m_normals[i])) > grazing * length)) return 0;
    return is_free(m_points[i], d / length, length) ? 1 : -1;
  }

  // Is there no disc on the line from `from` in the unit direction `d`, from a cell's width on?
  bool is_free(const Vector& from, const Vector& d, double length) const
  {
    constexpr double infinite = (std::numeric_limits<double>::max)();
    const double start = m_cell;
    // The part of the line in the grid.
    double enter = start, leave = length;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto e = Eigen::Index(k);
      const double low = m_corner[e] - from[e], high = low + m_cells[k] * m_cell;
      if (d[e] == 0) {
        if (low > 0 || high < 0) return true;
        continue;
      }
      enter = (std::max)(enter, (std::min)(low / d[e], high / d[e]));
      leave = (std::min)(leave, (std::max)(low / d[e], high / d[e]));
    }
    if (!(enter < leave)) return true;
    // From cell to cell (Amanatides and Woo 1987), to which one without a branch: nobody can foretell it.
    std::array<std::int32_t, 3> c{}, step{};
    std::array<double, 3> next{}, width{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto e = Eigen::Index(k);
      const double x = (from[e] + enter * d[e] - m_corner[e]) / m_cell;
      c[k] = (std::min)((std::max)(std::int32_t(std::floor(x)), 0), m_cells[k] - 1);
      step[k] = d[e] > 0 ? m_strides[k] : -m_strides[k];
      width[k] = d[e] != 0 ? m_cell / std::abs(d[e]) : infinite;
      next[k] = d[e] != 0 ? (m_corner[e] + (c[k] + (d[e] > 0 ? 1 : 0)) * m_cell - from[e]) / d[e] : infinite;
    }
    std::int32_t at = index(c);
    double x = next[0], y = next[1], z = next[2];
    for (;;) {
      const std::int32_t i = m_grid[std::size_t(at)];
      if (i == outside || (i != empty && is_blocked(std::size_t(i), from, d, start, length))) return i == outside;
      const bool is_x = (x < y) & (x < z), is_y = !(x < y) & (y < z), is_z = !(is_x | is_y);
      if ((is_x ? x : is_y ? y : z) > leave) return true;
      at += is_x ? step[0] : is_y ? step[1] : step[2];
      x += is_x ? width[0] : 0;
      y += is_y ? width[1] : 0;
      z += is_z ? width[2] : 0;
    }
  }

  // f(i, j) for every two samples whose cells touch, once. \pre has_grid()
  template <class Function>
  void for_each_pair_of_neighbours(const Function& f) const
  {
    for (std::size_t i = 0; i < m_points.size(); ++i) {
      const std::int32_t at = index(cell_of(i));
      if (m_grid[std::size_t(at)] != std::int32_t(i)) continue; // another one is in its cell
      constexpr std::int32_t cells_around = 27;
      for (std::int32_t k = cells_around / 2 + 1; k < cells_around; ++k) {
        const std::int32_t beside =
            at + (k % 3 - 1) * m_strides[0] + (k / 3 % 3 - 1) * m_strides[1] + (k / 9 - 1) * m_strides[2];
        const std::int32_t j = m_grid[std::size_t(beside)];
        if (j >= 0) f(i, std::size_t(j));
      }
    }
  }

private:
  std::array<std::int32_t, 3> cell_of(std::size_t i) const
  {
    const Vector q = (m_points[i] - m_corner) / m_cell;
    std::array<std::int32_t, 3> c{};
    for (std::size_t k = 0; k < 3; ++k) c[k] = (std::min)(std::int32_t(q[Eigen::Index(k)]), m_cells[k] - 1);
    return c;
  }

  bool is_blocked(std::size_t i, const Vector& from, const Vector& d, double start, double length) const
  {
    const double cosine = m_normals[i].dot(d);
    const Vector to = m_points[i] - from;
    if (!(std::abs(cosine) > grazing)) return false;
    const double t = to.dot(m_normals[i]) / cosine;
    constexpr double radius = 0.75; // of a cell: a disc of a cell's share of a surface has 0.7 and less
    return t > start && t < length && (t * d - to).squaredNorm() < radius * radius * m_cell * m_cell;
  }

  // Around the grid there is a layer of cells that are outside.
  static constexpr std::int32_t empty = -1, outside = -2;

  std::int32_t index(const std::array<std::int32_t, 3>& c) const
  {
    return (c[2] + 1) * m_strides[2] + (c[1] + 1) * m_strides[1] + c[0] + 1;
  }

  std::vector<Vector> m_points, m_normals;
  Vector m_corner;
  double m_cell;
  std::array<std::int32_t, 3> m_cells{}, m_strides{};
  std::vector<std::int32_t> m_grid;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_LINES_OF_SIGHT_H
