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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_SIDES_OF_POINTS_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_SIDES_OF_POINTS_H

// Normals made to look to the same side of the surface, neighbour by neighbour.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/internal/base/Run_control.h>
#include <CGAL/Crude_registration/internal/lookup/Point_grid.h>

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

// How the sides of samples of a surface hang together: the spanning forest of neighbours of Hoppe et al. 1992. A normal
// n at p tells that of a neighbour q by reflection in the bisecting plane of p and q, which is exact on circular arcs
// and at folds of any angle: s = n_p . (n_q - 2 (n_q . d) d) with the unit vector d of q - p is the cosine of what is
// left to explain, and its sign tells whether the two look to the same side. Neighbours that lie across each other's
// planes, as two sheets do, say least: the weight of a pair is |s| (1 - |n_p . d| |n_q . d|).
class Sides_of_points
{
public:
  // `reaches`: within which the neighbours of each sample are; `cell`: about the least of them. `is_sure`: whose
  // normals are known to look to the same side, of which the first stands for all. \throws Run_control::Stopped
  Sides_of_points(const std::vector<Vector>& points, const std::vector<Vector>& normals,
                  const std::vector<double>& reaches, double cell, const std::vector<std::uint8_t>& is_sure,
                  Run_control& control)
      : m_parent(points.size()), m_is_opposite(points.size(), 0)
  {
    for (std::size_t i = points.size(); i-- > 0;)
      if (is_sure[i]) m_first_sure = std::uint32_t(i);
    for (std::size_t i = 0; i < points.size(); ++i) m_parent[i] = is_sure[i] ? m_first_sure : std::uint32_t(i);
    std::vector<Pair> pairs;
    control.check();
    const Point_grid grid(points, cell);
    for (std::size_t i = 0; i < points.size(); ++i) {
      control.check(i);
      if (is_sure[i]) continue;
      grid.for_each_within(points[i], reaches[i], [&](std::int32_t other, double squared_distance) {
        const std::size_t j = std::size_t(other);
        // Once, where both reach each other.
        if (!(squared_distance > 0) || (j < i && !is_sure[j] && squared_distance <= reaches[j] * reaches[j])) return;
        const Vector d = (points[j] - points[i]) / std::sqrt(squared_distance);
        const double a = normals[i].dot(d), b = normals[j].dot(d);
        const double s = normals[i].dot(normals[j]) - 2 * a * b;
        const double weight = std::abs(s) * (1 - std::abs(a * b));
        pairs.push_back({std::uint32_t(i), std::uint32_t(j), std::uint8_t((1 - weight) * (number_of_classes - 0.01)),
                         std::uint8_t(s < 0)});
      });
    }
    // In the order of their classes, within them in that of the samples.
    std::array<std::size_t, number_of_classes + 1> begin{};
    for (const Pair& p : pairs) ++begin[p.rank + std::size_t(1)];
    for (std::size_t c = 0; c < number_of_classes; ++c) begin[c + 1] += begin[c];
    std::vector<std::uint32_t> order(pairs.size());
    control.check();
    for (std::size_t k = 0; k < pairs.size(); ++k) order[begin[pairs[k].rank]++] = std::uint32_t(k);
    for (std::size_t k = 0; k < order.size(); ++k) {
      control.check(k);
      join(pairs[order[k]]);
    }
  }

  // The sample that stands for all that hang together with sample i, and whether i looks to its other side.
  std::pair<std::size_t, bool> side(std::size_t i)
  {
    const std::uint32_t r = root(std::uint32_t(i));
    return {r, m_is_opposite[i] != 0 && r != i};
  }

private:
  static constexpr std::size_t number_of_classes = 128;

  struct Pair
  {
    std::uint32_t a, b;
    std::uint8_t rank, is_opposite;
  };

  // Leaves i next to its root.
  std::uint32_t root(std::uint32_t i)
  {
    std::uint32_t r = i;
    std::uint8_t opposite = 0;
    while (m_parent[r] != r) {
      opposite ^= m_is_opposite[r];
      r = m_parent[r];
    }
    while (m_parent[i] != i && m_parent[i] != r) {
      const std::uint32_t next = m_parent[i];
      const std::uint8_t own = m_is_opposite[i];
      m_is_opposite[i] = opposite;
      m_parent[i] = r;
      opposite ^= own;
      i = next;
    }
    return r;
  }

  void join(const Pair& p)
  {
    const std::uint32_t a = root(p.a), b = root(p.b);
    if (a == b) return;
    const std::uint8_t of_a = a == p.a ? 0 : m_is_opposite[p.a], of_b = b == p.b ? 0 : m_is_opposite[p.b];
    const std::uint32_t high = m_first_sure == (std::max)(a, b) ? (std::min)(a, b) : (std::max)(a, b);
    m_parent[high] = high == a ? b : a;
    m_is_opposite[high] = std::uint8_t(of_a ^ of_b ^ p.is_opposite);
  }

  std::uint32_t m_first_sure = ~std::uint32_t(0); // remains a root
  std::vector<std::uint32_t> m_parent;
  std::vector<std::uint8_t> m_is_opposite; // to the parent
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_SIDES_OF_POINTS_H
