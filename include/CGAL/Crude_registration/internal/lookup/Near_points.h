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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_LOOKUP_NEAR_POINTS_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_LOOKUP_NEAR_POINTS_H

// The points near any place, for one distance, by one look-up: for the innermost loop of the search.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/internal/lookup/Bins.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Each cell of a grid lists the items whose points are within the reach of a place in it. Cells get larger than asked
// for where they would outnumber the points 512 to one.
//
// A Point_grid would do, but most places that the search for trihedra looks at are near nothing, which is told here by
// one bit: with a Point_grid the search takes 13, 22 and 11 % longer on the levels 3, 2 and 1 of Table 3 of the paper
// (bunny 0-90, in processor time). Pairs of points, and distances that differ from call to call, are a Point_grid's.
template <class Item>
class Near_points
{
public:
  Near_points() = default;

  // `items[i]` is listed where `points[i]` is near.
  Near_points(const std::vector<Vector>& points, const std::vector<Item>& items, double cell, double reach)
  {
    if (points.empty()) return;
    Vector low = points.front(), high = low;
    for (const Vector& p : points) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    m_low = low.array() - reach;
    const Vector size = high - low + Vector::Constant(2 * reach);
    while (((size / cell).array().floor() + 1).prod() > 512. * double(points.size())) cell *= 1.25;
    m_scale = 1 / cell;
    for (int i = 0; i < 3; ++i) m_cells[std::size_t(i)] = int(size[i] * m_scale) + 1;
    const std::size_t cells = std::size_t(m_cells[0]) * std::size_t(m_cells[1]) * std::size_t(m_cells[2]);
    m_is_near.assign(cells / 64 + 1, 0);
    // A little more than the reach, so that rounding leaves none out.
    const double most = 1.000002 * (reach * m_scale) * (reach * m_scale);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
    for (std::size_t j = 0; j < points.size(); ++j) {
      const Vector p = (points[j] - m_low) * m_scale;
      int first[3], last[3];
      for (int i = 0; i < 3; ++i) {
        first[i] = (std::max)(0, int(std::floor(p[i] - reach * m_scale)));
        last[i] = (std::min)(m_cells[std::size_t(i)] - 1, int(p[i] + reach * m_scale));
      }
      const auto off = [&](int i, int c) { return (std::max)({0., c - p[i], p[i] - (c + 1)}); };
      for (int z = first[2]; z <= last[2]; ++z) {
        const double dz = off(2, z);
        for (int y = first[1]; y <= last[1]; ++y) {
          const double dy = off(1, y);
          for (int x = first[0]; x <= last[0]; ++x) {
            const double dx = off(0, x);
            if (dx * dx + dy * dy + dz * dz > most) continue;
            const std::size_t c = cell_index(x, y, z);
            m_is_near[c >> 6] |= std::uint64_t(1) << (c & 63);
            found.push_back({std::uint32_t(c), std::uint32_t(j)});
          }
        }
      }
    }
    m_items = Bins<Item>(cells, [&](const auto& add) {
      for (const auto& [c, j] : found) add(c, items[j]);
    });
  }

  // f(item) for all points within the reach of p, and others near, in the order of the points.
  template <class Function>
  void for_each_near(const Vector& p, Function&& f) const
  {
    const double x = (p[0] - m_low[0]) * m_scale, y = (p[1] - m_low[1]) * m_scale, z = (p[2] - m_low[2]) * m_scale;
    if (!(x >= 0 && y >= 0 && z >= 0 && x < m_cells[0] && y < m_cells[1] && z < m_cells[2])) return;
    const std::size_t c = cell_index(int(x), int(y), int(z));
    // The bits of all cells are in the cache.
    if (!((m_is_near[c >> 6] >> (c & 63)) & 1)) return;
    for (std::size_t i = m_items.begin(c); i < m_items.end(c); ++i) f(m_items.items()[i]);
  }

private:
  std::size_t cell_index(int x, int y, int z) const
  {
    return (std::size_t(z) * std::size_t(m_cells[1]) + std::size_t(y)) * std::size_t(m_cells[0]) + std::size_t(x);
  }

  Vector m_low = Vector::Zero();
  double m_scale = 1;
  std::array<int, 3> m_cells{};
  std::vector<std::uint64_t> m_is_near; // a bit for each cell
  Bins<Item> m_items;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_LOOKUP_NEAR_POINTS_H
