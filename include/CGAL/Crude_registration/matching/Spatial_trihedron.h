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

#ifndef CGAL_CRUDE_REGISTRATION_MATCHING_SPATIAL_TRIHEDRON_H
#define CGAL_CRUDE_REGISTRATION_MATCHING_SPATIAL_TRIHEDRON_H

#include <CGAL/Crude_registration/internal/reduction/measure_scan.h>
#include <CGAL/Crude_registration/internal/lookup/Point_grid.h>
#include <CGAL/Crude_registration/internal/matching/extents.h>
#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/internal/mesh/to_flat_mesh.h>
#include <CGAL/Crude_registration/named_parameters.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace CGAL {
namespace Crude_registration {

/*!
 * \ingroup PkgCrudeRegistrationRef
 *
 * \brief the shape descriptor of section 5 of the paper: a vertex \f$ V \f$ of a simplified mesh and three more, at the
 * ends of three linearly independent, preferably orthogonal axes.
 *
 * Vertices are given by their positions in `vertices(mesh)`. What is compared of a trihedron, besides its edge lengths
 * and its handedness, belongs to its vertices: curvatures and normals.
 */
struct Spatial_trihedron
{
  std::int32_t origin;              ///< \f$ V \f$
  std::array<std::int32_t, 3> ends; ///< \f$ v_1, v_2, v_3 \f$

  friend bool operator==(const Spatial_trihedron& a, const Spatial_trihedron& b)
  {
    return a.origin == b.origin && a.ends == b.ends;
  }
  friend bool operator!=(const Spatial_trihedron& a, const Spatial_trihedron& b) { return !(a == b); }
};

namespace internal {

// Predicates are exact on the coordinates given, which are double.
using Exact_predicates = Exact_predicates_inexact_constructions_kernel;

inline Exact_predicates::Point_3 exact_point(const Vector& p)
{
  return Exact_predicates::Point_3(p.x(), p.y(), p.z());
}

// The handedness of a trihedron, exactly; COPLANAR where it is degenerate.
inline Orientation handedness(const std::array<Vector, 4>& p)
{
  return CGAL::orientation(exact_point(p[0]), exact_point(p[1]), exact_point(p[2]), exact_point(p[3]));
}

struct Trihedron_options
{
  double minimum_length = 0; // f1 M
  double maximum_length = 0; // f2 M
  // At each scale the arms are limited to minimum_length + scale (maximum_length - minimum_length), 0 < scale <= 1.
  std::vector<double> scales = {1};
  int trihedra_per_scale = 1; // for each vertex
};

// The trihedra of the vertices with `inside` set, their ends among these vertices. Long arms carry less of the
// vertices' uncertainty into a rotation, orthogonal ones spread it evenly; both ask for volume, which is built up end
// by end: the first is the furthest, the second makes the largest triangle, the third the largest volume. Every other
// trihedron of a vertex starts from the end that is furthest from the lines of the first arms so far. Equal ends are
// told apart by their index.
//
// Lengths are compared with the squares of the limits exactly, and a trihedron whose vertices are exactly collinear or
// coplanar is left out: a vertex without another one in reach has none. The cost is proportional to the number of
// vertices in reach of each other. The result is sorted by scale, then by vertex.
class Trihedron_choice
{
public:
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
    const double low2 = low * low, high2 = high * high;
    if (squared_length > (1 + slack) * low2 && squared_length < (1 - slack) * high2) return true;
    const auto p = exact_point(m_points[v]), q = exact_point(m_points[std::size_t(w)]);
    return CGAL::compare_squared_distance(p, q, low2) != SMALLER &&
           CGAL::compare_squared_distance(p, q, high2) != LARGER;
  }

  // The arm of the largest positive value; null if there is none.
  template <class Value>
  const Arm* best(const Value& value) const
  {
    const Arm* result = nullptr;
    double largest = 0;
    for (const Arm& a : m_arms) {
      const double x = value(a);
      if (x > largest || (result && x == largest && a.end < result->end)) {
        largest = x;
        result = &a;
      }
    }
    return result;
  }

  void add_trihedra(std::size_t v, std::vector<Spatial_trihedron>& result)
  {
    m_directions.clear();
    for (int k = 0; k < m_options.trihedra_per_scale; ++k) {
      const Arm* const first = best([&](const Arm& a) {
        double distance = a.vector.squaredNorm();
        for (const Vector& u : m_directions) distance = (std::min)(distance, u.cross(a.vector).squaredNorm());
        return distance;
      });
      if (!first) return;
      m_directions.push_back(first->vector.normalized());
      const Arm* const second = best([&](const Arm& a) { return first->vector.cross(a.vector).squaredNorm(); });
      if (!second) continue;
      const Vector n = first->vector.cross(second->vector);
      const Arm* const third = best([&](const Arm& a) { return std::abs(n.dot(a.vector)); });
      if (!third) continue;
      // Four points in no plane are no three on a line. What is exactly in a plane has a volume of rounding only, and
      // no other end here has more.
      if (handedness({m_points[v], m_points[std::size_t(first->end)], m_points[std::size_t(second->end)],
                      m_points[std::size_t(third->end)]}) == COPLANAR)
        continue;
      result.push_back({std::int32_t(v), {first->end, second->end, third->end}});
    }
  }

  const std::vector<Vector>& m_points;
  const std::vector<std::uint8_t>& m_inside;
  Trihedron_options m_options;
  std::vector<Arm> m_arms;
  std::vector<Vector> m_directions;
};

inline std::vector<Spatial_trihedron> spatial_trihedra(const std::vector<Vector>& points,
                                                       const std::vector<std::uint8_t>& inside,
                                                       const Trihedron_options& options)
{
  return Trihedron_choice(points, inside, options)();
}

// One trihedron a vertex, with arms from f1 M to f2 M.
inline Trihedron_options trihedron_options(const std::array<double, 2>& shares, double extent)
{
  Trihedron_options options;
  options.minimum_length = shares[0] * extent;
  options.maximum_length = shares[1] * extent;
  return options;
}

} // namespace internal

/*!
 * \ingroup PkgCrudeRegistrationRef
 *
 * \brief chooses one spatial trihedron for each vertex of a simplified mesh, where there is one.
 *
 * The arms have lengths between \f$ f_1 M \f$ and \f$ f_2 M \f$, \f$ M \f$ being the mean extent of the mesh
 * (`scan_extent()`); within these limits they are chosen long and as near to orthogonal as the surface allows. All four
 * vertices lie inside the mesh, none on its border. Trihedra are never degenerate: CGAL's exact predicates decide.
 *
 * \tparam FaceGraph a model of `FaceListGraph`
 * \tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"
 *
 * \param mesh a triangle mesh, usually the result of `simplify_scan()`
 * \param np an optional sequence of named parameters among the ones listed below:
 *   - `minimum_extent`: \f$ f_1 \f$, default 0
 *   - `maximum_extent`: \f$ f_2 \f$, default 0.3: about the share of the scan that the other one is expected to show
 *   - `vertex_point_map`: default `get(CGAL::vertex_point, mesh)`
 *   - `viewing_direction`, `viewpoint`: as for `scan_extent()`
 *
 * \return the trihedra, sorted by their origin
 *
 * \throws std::invalid_argument if a face of `mesh` is not a triangle, a coordinate is not finite, or not
 * \f$ 0 \le f_1 < f_2 \f$.
 *
 * The time is proportional to the number of vertices in reach of each other.
 */
template <class FaceGraph, class NamedParameters = parameters::Default_named_parameters>
std::vector<Spatial_trihedron> spatial_trihedra(const FaceGraph& mesh,
                                                const NamedParameters& np = parameters::default_values())
{
  const std::array<double, 2> shares = internal::extent_parameters(np, "spatial_trihedra");
  const internal::Flat_mesh flat = internal::to_flat_mesh(mesh, np, "spatial_trihedra", "mesh");
  const double extent = internal::extent_of_mesh(flat, internal::sensor_parameter(np, "spatial_trihedra")).sum() / 3;
  const std::vector<std::uint8_t> borders = internal::border_flags(flat);
  std::vector<std::uint8_t> inside(flat.points.size(), 0);
  for (const auto& f : flat.faces)
    for (std::int32_t v : f) inside[std::size_t(v)] = !borders[std::size_t(v)];
  return internal::spatial_trihedra(flat.points, inside, internal::trihedron_options(shares, extent));
}

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_MATCHING_SPATIAL_TRIHEDRON_H
