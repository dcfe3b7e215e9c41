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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_LOOKUP_POINT_GRID_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_LOOKUP_POINT_GRID_H

// Points in the cells of a grid: those within a radius, and the pairs of them.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/internal/lookup/Bins.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The cells of a uniform grid. They get larger than asked for where they would outnumber the points 64 to one, so that
// memory stays linear.
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

    m_entries =
        Bins<Entry>(std::size_t(m_cells[0]) * std::size_t(m_cells[1]) * std::size_t(m_cells[2]), [&](const auto& add) {
          for (std::size_t i = 0; i < points.size(); ++i)
            add(cell(coordinate(0, points[i]), coordinate(1, points[i]), coordinate(2, points[i])),
                Entry{points[i], std::int32_t(i)});
        });
  }

  // f(index, squared distance) for every point within `radius` of p, in an order fixed by the points alone.
  template <class Function>
  void for_each_within(const Vector& p, double radius, Function&& f) const
  {
    for_each_row(p, radius, [&](std::size_t from, std::size_t to) { for_each_of(p, 0, radius, from, to, f); });
  }

  // The points within `radius` of p, in the order of for_each_within(): to `indices`, which are as many as is needed
  // and more. Returns how many there are.
  std::size_t indices_within(const Vector& p, double radius, std::vector<std::int32_t>& indices) const
  {
    return collect_within(p, radius, indices, [&](const Entry& e, std::int32_t& index) {
      index = e.index;
      return (e.point - p).squaredNorm();
    });
  }

  // The same of their differences to p.
  std::size_t differences_within(const Vector& p, double radius, std::vector<Vector>& differences) const
  {
    const double u = p[0], v = p[1], w = p[2]; // that no difference is written to
    return collect_within(p, radius, differences, [u, v, w](const Entry& e, Vector& difference) {
      const double x = e.point[0] - u, y = e.point[1] - v, z = e.point[2] - w;
      difference = Vector(x, y, z);
      return x * x + y * y + z * z;
    });
  }

  // f(index, other index, squared distance) for every pair of points that are between `least` and `radius` apart, once,
  // in an order fixed by the points alone, as long as f returns true.
  template <class Function>
  void for_each_pair_between(double least, double radius, Function&& f) const
  {
    bool go_on = true;
    const std::vector<Entry>& entries = m_entries.items();
    for (std::size_t e = 0; e < entries.size() && go_on; ++e) {
      const Entry& first = entries[e];
      for_each_row(first.point, radius, [&](std::size_t from, std::size_t to) {
        for_each_of(first.point, least, radius, (std::max)(from, e + 1), to,
                    [&](std::int32_t j, double d) { go_on = go_on && f(first.index, j, d); });
      });
    }
  }

private:
  struct Entry
  {
    Vector point;
    std::int32_t index;
  };

  // What `describe(entry, item)` makes of the entries for which it returns the square of at most `radius`, without a
  // branch: to the beginning of `items`. Returns how many there are.
  template <class Item, class Describe>
  std::size_t collect_within(const Vector& p, double radius, std::vector<Item>& items, const Describe& describe) const
  {
    std::size_t n = 0;
    for_each_row(p, radius, [&](std::size_t from, std::size_t to) {
      if (items.size() < n + (to - from)) items.resize(2 * (n + (to - from)));
      Item* next = items.data() + n;
      const Entry* const entries = m_entries.items().data();
      for (std::size_t e = from; e < to; ++e) next += describe(entries[e], *next) <= radius * radius;
      n = std::size_t(next - items.data());
    });
    return n;
  }

  // f(from, to) for the entries of each row of cells that `radius` around p meets.
  template <class Function>
  void for_each_row(const Vector& p, double radius, Function&& f) const
  {
    std::array<std::int32_t, 3> from, to;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto k = Eigen::Index(i);
      const double low = (p[k] - radius - m_low[k]) * m_scale, high = (p[k] + radius - m_low[k]) * m_scale;
      if (!(high >= 0) || !(low < m_cells[i])) return;
      from[i] = low > 0 ? std::int32_t(low) : 0;
      to[i] = high < m_cells[i] ? std::int32_t(high) : m_cells[i] - 1;
    }
    // The cells of a row follow each other, and so do their entries.
    for (std::int32_t z = from[2]; z <= to[2]; ++z)
      for (std::int32_t y = from[1]; y <= to[1]; ++y)
        f(m_entries.begin(cell(from[0], y, z)), m_entries.end(cell(to[0], y, z)));
  }

  // f(index, squared distance) for those of the entries that are between `least` and `radius` away from p. Which are
  // cannot be foretold: they are first collected, without a branch, some at a time.
  template <class Function>
  void for_each_of(const Vector& p, double least, double radius, std::size_t from, std::size_t to, Function&& f) const
  {
    constexpr std::size_t most = 32;
    std::array<std::int32_t, most> indices;
    std::array<double, most> distances;
    while (from < to) {
      const std::size_t end = (std::min)(to, from + most);
      std::size_t n = 0;
      for (; from < end; ++from) {
        indices[n] = m_entries.items()[from].index;
        distances[n] = (m_entries.items()[from].point - p).squaredNorm();
        n += std::size_t(distances[n] >= least * least) & std::size_t(distances[n] <= radius * radius);
      }
      for (std::size_t k = 0; k < n; ++k) f(indices[k], distances[k]);
    }
  }

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
  Bins<Entry> m_entries;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_LOOKUP_POINT_GRID_H
