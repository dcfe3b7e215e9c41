// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_POINT_GRID_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_POINT_GRID_H

#include <CGAL/Crude_registration/internal/Rigid_motion.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Points in the cells of a uniform grid (counting sort, flat arrays): everything within a distance of a place. Cells
// get larger than asked for where they would outnumber the points 64 to one, so memory stays linear.
class Point_grid
{
public:
  Point_grid() = default;

  Point_grid(const std::vector<Vector>& points, double cell_size)
  {
    if (points.empty()) return;
    m_low = points.front();
    Vector high = m_low;
    for (const Vector& p : points) {
      m_low = m_low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    const Vector size = high - m_low;
    // Points all in one place leave the size of a cell open.
    cell_size = (std::max)(cell_size, 1e-9 * size.maxCoeff());
    if (!(cell_size > 0)) cell_size = 1;
    while (((size / cell_size).array().floor() + 1).prod() > 64. * double(points.size())) cell_size *= 1.25;
    m_scale = 1 / cell_size;
    for (std::size_t i = 0; i < 3; ++i) m_cells[i] = std::int32_t(size[Eigen::Index(i)] * m_scale) + 1;

    m_begin.assign(std::size_t(m_cells[0]) * std::size_t(m_cells[1]) * std::size_t(m_cells[2]) + 1, 0);
    std::vector<std::size_t> cell_of(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      cell_of[i] = cell(coordinate(0, points[i]), coordinate(1, points[i]), coordinate(2, points[i]));
      ++m_begin[cell_of[i] + 1];
    }
    for (std::size_t i = 1; i < m_begin.size(); ++i) m_begin[i] += m_begin[i - 1];
    m_entries.resize(points.size());
    std::vector<std::int32_t> next(m_begin.begin(), m_begin.end() - 1);
    for (std::size_t i = 0; i < points.size(); ++i)
      m_entries[std::size_t(next[cell_of[i]]++)] = {points[i], std::int32_t(i)};
  }

  // f(index, squared distance) for every point within `radius` of p, in an order fixed by the points alone.
  template <class Function>
  void for_each_within(const Vector& p, double radius, Function&& f) const
  {
    std::array<std::int32_t, 3> from, to;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto k = Eigen::Index(i);
      const double low = (p[k] - radius - m_low[k]) * m_scale, high = (p[k] + radius - m_low[k]) * m_scale;
      if (!(high >= 0) || !(low < m_cells[i])) return;
      from[i] = low > 0 ? std::int32_t(low) : 0;
      to[i] = high < m_cells[i] ? std::int32_t(high) : m_cells[i] - 1;
    }
    const double most = radius * radius;
    for (std::int32_t z = from[2]; z <= to[2]; ++z)
      for (std::int32_t y = from[1]; y <= to[1]; ++y) {
        // The cells of a row follow each other, and so do their entries.
        const auto end = std::size_t(m_begin[cell(to[0], y, z) + 1]);
        for (auto e = std::size_t(m_begin[cell(from[0], y, z)]); e < end; ++e) {
          const double d = (m_entries[e].point - p).squaredNorm();
          if (d <= most) f(m_entries[e].index, d);
        }
      }
  }

private:
  struct Entry
  {
    Vector point;
    std::int32_t index;
  };

  std::int32_t coordinate(std::size_t i, const Vector& p) const
  {
    return (std::min)(std::int32_t((p[Eigen::Index(i)] - m_low[Eigen::Index(i)]) * m_scale), m_cells[i] - 1);
  }

  std::size_t cell(std::int32_t x, std::int32_t y, std::int32_t z) const
  {
    return (std::size_t(z) * std::size_t(m_cells[1]) + std::size_t(y)) * std::size_t(m_cells[0]) + std::size_t(x);
  }

  Vector m_low = Vector::Zero();
  double m_scale = 1;
  std::array<std::int32_t, 3> m_cells{};
  std::vector<std::int32_t> m_begin;
  std::vector<Entry> m_entries;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_POINT_GRID_H
