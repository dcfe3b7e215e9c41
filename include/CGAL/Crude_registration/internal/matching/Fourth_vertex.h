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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_FOURTH_VERTEX_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_FOURTH_VERTEX_H

// The fourth vertex of a trihedron: where section 6 of the paper expects it, seen from the first three.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/internal/matching/exact_rigidity.h>

#include <CGAL/Barycentric_coordinates_2/triangle_coordinates_2.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The barycentric coordinates of the projection of x[3] on the plane of the other three, not collinear in the
// arithmetic of K.
template <class K>
std::array<typename K::FT, 3> coordinates_of_projection(const std::array<Vector, 4>& x)
{
  using FT = typename K::FT;
  using Vector_3 = typename K::Vector_3;
  // From x[0], as far from the origin the digits of a difference would be lost later.
  const auto arm = [&](std::size_t i) -> Vector_3 {
    return Vector_3(FT(x[i].x()) - FT(x[0].x()), FT(x[i].y()) - FT(x[0].y()), FT(x[i].z()) - FT(x[0].z()));
  };
  const Vector_3 a = arm(1), b = arm(2), c = arm(3), n = CGAL::cross_product(a, b);
  const Vector_3 projected = c - n * ((c * n) / n.squared_length());
  // Seen along the axis that is nearest to the normal: affine maps leave barycentric coordinates as they are.
  int axis = 0;
  for (int i = 1; i < 3; ++i)
    if (CGAL::abs(n[i]) > CGAL::abs(n[axis])) axis = i;
  const auto flat = [axis](const Vector_3& v) { return typename K::Point_2(v[(axis + 1) % 3], v[(axis + 2) % 3]); };
  std::array<FT, 3> result;
  Barycentric_coordinates::triangle_coordinates_2(flat(NULL_VECTOR), flat(a), flat(b), flat(projected), result.begin(),
                                                  K());
  return result;
}

// The unit normal of a triangle; null where the vertices are exactly collinear.
struct Triangle_normal
{
  Triangle_normal(const Vector& p, const Vector& q, const Vector& r)
  {
    const Vector u = q - p, w = r - p, n = u.cross(w);
    const double squared_length = n.squaredNorm();
    is_thin = !(squared_length > thin * thin * u.squaredNorm() * w.squaredNorm());
    if (!is_thin) vector = n / std::sqrt(squared_length);
    else if (!are_collinear(p, q, r)) vector = exact(p, q, r);
  }

  // Below this sine of the angle at the first vertex a normal in double has less than nine digits, and what double
  // makes of a place in a triangle has lost as many: such triangles take exact arithmetic, and time.
  static constexpr double thin = 1e-6;

  bool is_thin;
  Vector vector = Vector::Zero();

private:
  static Vector exact(const Vector& p, const Vector& q, const Vector& r)
  {
    const Cartesian_converter<Exact_predicates, Exact_kernel> to_exact;
    const auto a = to_exact(exact_point(p)), b = to_exact(exact_point(q)), c = to_exact(exact_point(r));
    const Exact_kernel::Vector_3 n = CGAL::cross_product(b - a, c - a);
    const Exact_rational largest = (std::max)({CGAL::abs(n.x()), CGAL::abs(n.y()), CGAL::abs(n.z())});
    return Vector(CGAL::to_double(n.x() / largest), CGAL::to_double(n.y() / largest), CGAL::to_double(n.z() / largest))
        .normalized();
  }
};

// v3 relative to the triangle (V, v1, v2): the barycentric coordinates of its projection on the plane, its height over
// it, and on which side of the triangle it is: above or below, and on which side of each edge.
class Fourth_vertex
{
public:
  // \pre The vertices x of the trihedron are not coplanar.
  Fourth_vertex(const std::array<Vector, 4>& x, double tolerance)
      : m_x(x), m_normal(x[0], x[1], x[2]), m_height((x[3] - x[0]).dot(m_normal.vector)), m_hand(handedness(x))
  {
    CGAL_precondition(m_hand != COPLANAR);
    if (!m_normal.is_thin) m_coordinates = coordinates_of_projection<Simple_cartesian<double>>(x);
    // Within twice the tolerance of an edge, v3 and the edge being off by one each, a match may be on either side.
    for (std::size_t i = 0; i < 3; ++i)
      m_sides[i] = side_of_edge(x[i], x[(i + 1) % 3], x[(i + 2) % 3], x[3], 2 * tolerance);
  }

  const Vector& normal() const { return m_normal.vector; }

  // Where v3 is expected: the place p = x2 + n2 d of the paper with the same coordinates and height relative to the
  // first three of y. `normal`: of their triangle.
  Vector place(const std::array<Vector, 4>& y, const Triangle_normal& normal) const
  {
    const Vector above = m_height * normal.vector;
    if (m_normal.is_thin || normal.is_thin) return place_in_plane(y) + above;
    return y[0] + m_coordinates[1] * (y[1] - y[0]) + m_coordinates[2] * (y[2] - y[0]) + above;
  }

  // Whether y[3] is on the same side as v3, exactly: y is no mirror image.
  bool is_on_its_side(const std::array<Vector, 4>& y) const
  {
    if (handedness(y) != m_hand) return false;
    for (std::size_t i = 0; i < 3; ++i)
      if (m_sides[i] != ZERO && side_of_edge(y[i], y[(i + 1) % 3], y[(i + 2) % 3], y[3], 0) != m_sides[i]) return false;
    return true;
  }

private:
  // Rounded once, at the end: in thin triangles the coordinates are large, and their sum is not.
  Vector place_in_plane(const std::array<Vector, 4>& y) const
  {
    const std::array<Exact_rational, 3> c = coordinates_of_projection<Exact_kernel>(m_x);
    Vector place;
    for (int k = 0; k < 3; ++k)
      place[k] = CGAL::to_double(c[0] * Exact_rational(y[0][k]) + c[1] * Exact_rational(y[1][k]) +
                                 c[2] * Exact_rational(y[2][k]));
    return place;
  }

  std::array<Vector, 4> m_x;
  Triangle_normal m_normal;
  std::array<double, 3> m_coordinates{};
  double m_height;
  Orientation m_hand;
  std::array<Sign, 3> m_sides;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_FOURTH_VERTEX_H
