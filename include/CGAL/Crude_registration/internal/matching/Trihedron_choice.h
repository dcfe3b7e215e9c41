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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_TRIHEDRON_CHOICE_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_TRIHEDRON_CHOICE_H

// Chooses spatial trihedra, section 5 of the paper, among points.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/internal/lookup/Point_grid.h>
#include <CGAL/Crude_registration/internal/matching/exact_rigidity.h>
#include <CGAL/Crude_registration/internal/matching/trihedron_options.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The trihedra of the vertices with `inside` set, their ends among these vertices. Long arms carry less of the
// vertices' uncertainty into a rotation, orthogonal ones spread it evenly; both ask for volume, which is built up end
// by end: the first is the furthest, the second makes the largest triangle, the third the largest volume. Every other
// trihedron of a vertex starts from the end that is furthest from the lines of the first arms so far. Equal ends are
// told apart by their index.
//
// Lengths are compared with the limits exactly, and exact predicates say what is collinear and what is coplanar: a
// vertex that lies with all others in reach in a plane has no trihedron, every other one has. The cost is proportional
// to the number of vertices in reach of each other. The result is sorted by scale, then by vertex.
class Trihedron_choice
{
public:
  // The points are kept by reference.
  Trihedron_choice(const std::vector<Vector>& points, const std::vector<std::uint8_t>& inside,
                   const Trihedron_options& options)
      : m_points(points), m_inside(inside), m_options(options)
  {}

  std::vector<Spatial_trihedron> operator()()
  {
    std::vector<Spatial_trihedron> result;
    if (m_points.empty() || !(m_options.maximum_length > 0)) return result;
    const Point_grid grid(m_points, m_options.maximum_length / 2);
    for (double scale : m_options.scales) {
      const double longest = m_options.minimum_length + scale * (m_options.maximum_length - m_options.minimum_length);
      for (std::size_t v = 0; v < m_points.size(); ++v) {
        if (!m_inside[v]) continue;
        m_arms.clear();
        grid.for_each_within(m_points[v], (1 + slack) * longest, [&](std::int32_t w, double squared_length) {
          if (m_inside[std::size_t(w)] && std::size_t(w) != v &&
              is_between(v, w, squared_length, m_options.minimum_length, longest))
            m_arms.push_back({m_points[std::size_t(w)] - m_points[v], w});
        });
        add_trihedra(v, result);
      }
    }
    return result;
  }

private:
  struct Arm
  {
    Vector vector;
    std::int32_t end;
  };

  static constexpr double slack = 1e-12; // far above the rounding of a squared length

  bool is_between(std::size_t v, std::int32_t w, double squared_length, double low, double high) const
  {
    if (squared_length > (1 + slack) * (low * low) && squared_length < (1 - slack) * (high * high)) return true;
    const Vector &p = m_points[v], &q = m_points[std::size_t(w)];
    return compare_distance(p, q, low) != SMALLER && compare_distance(p, q, high) != LARGER;
  }

  // The arm of the largest value, among equal ones that of the least index; null if none of zero or above is admitted.
  template <class Value, class Is_admitted>
  const Arm* best(const Value& value, const Is_admitted& is_admitted) const
  {
    const Arm* result = nullptr;
    double largest = 0;
    for (const Arm& a : m_arms) {
      const double x = value(a);
      if ((x > largest || (x == largest && (!result || a.end < result->end))) && is_admitted(a)) {
        largest = x;
        result = &a;
      }
    }
    return result;
  }

  // The same among the arms that are not degenerate, which is seldom to be asked: the values are rounded, and where the
  // best one is degenerate for all that the others are asked.
  template <class Value, class Is_degenerate>
  const Arm* best_proper(const Value& value, const Is_degenerate& is_degenerate) const
  {
    const Arm* const result = best(value, [](const Arm&) { return true; });
    if (!result || !is_degenerate(*result)) return result;
    return best(value, [&](const Arm& a) { return !is_degenerate(a); });
  }

  void add_trihedra(std::size_t v, std::vector<Spatial_trihedron>& result)
  {
    m_directions.clear();
    const auto end = [this](const Arm& a) -> const Vector& { return m_points[std::size_t(a.end)]; };
    for (int k = 0; k < m_options.trihedra_per_scale; ++k) {
      // An arm along an earlier first one starts no other trihedron.
      const auto distance = [&](const Arm& a) {
        double least = a.vector.squaredNorm();
        for (const Vector& u : m_directions) least = (std::min)(least, u.cross(a.vector).squaredNorm());
        return least;
      };
      const Arm* const first = best(distance, [&](const Arm& a) { return distance(a) > 0; });
      if (!first) return;
      m_directions.push_back(first->vector.normalized());
      const Arm* const second =
          best_proper([&](const Arm& a) { return first->vector.cross(a.vector).squaredNorm(); },
                      [&](const Arm& a) { return are_collinear(m_points[v], end(*first), end(a)); });
      if (!second) continue;
      const Vector n = first->vector.cross(second->vector);
      const Arm* const third =
          best_proper([&](const Arm& a) { return std::abs(n.dot(a.vector)); },
                      [&](const Arm& a) {
                        return handedness({m_points[v], end(*first), end(*second), end(a)}) == COPLANAR;
                      });
      if (third) result.push_back({std::int32_t(v), {first->end, second->end, third->end}});
    }
  }

  const std::vector<Vector>& m_points;
  const std::vector<std::uint8_t>& m_inside;
  Trihedron_options m_options;
  std::vector<Arm> m_arms;
  std::vector<Vector> m_directions;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_TRIHEDRON_CHOICE_H
