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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_EXACT_RIGIDITY_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_EXACT_RIGIDITY_H

// What is decided exactly about a trihedron and its match, on their coordinates, which are double.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>

#include <CGAL/Cartesian_converter.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Filtered_predicate.h>
#include <CGAL/Interval_nt.h>
#include <CGAL/Simple_cartesian.h>

#include <array>

namespace CGAL {
namespace Crude_registration {
namespace internal {

using Exact_predicates = Exact_predicates_inexact_constructions_kernel;
using Exact_kernel = Simple_cartesian<Exact_rational>;

inline Exact_predicates::Point_3 exact_point(const Vector& p)
{
  return Exact_predicates::Point_3(p.x(), p.y(), p.z());
}

// The handedness of a trihedron; COPLANAR where it is degenerate.
inline Orientation handedness(const std::array<Vector, 4>& p)
{
  return CGAL::orientation(exact_point(p[0]), exact_point(p[1]), exact_point(p[2]), exact_point(p[3]));
}

inline bool are_collinear(const Vector& p, const Vector& q, const Vector& r)
{
  return CGAL::collinear(exact_point(p), exact_point(q), exact_point(r));
}

// Predicates that CGAL's kernels do not have, for any kernel K.

// |p q| with a length.
template <class K>
struct Compare_with_length
{
  using result_type = typename K::Comparison_result;
  result_type operator()(const typename K::Point_3& p, const typename K::Point_3& q, const typename K::FT& length) const
  {
    return K().compare_squared_distance_3_object()(p, q, length * length);
  }
};

// The difference of |p q| and |r s|, whatever its sign, with a length d. With a and b the squares of the two,
// |sqrt(a) - sqrt(b)| <= d  <=>  a + b - d^2 <= 2 sqrt(a b)  <=>  a + b <= d^2  or  (a - b)^2 <= d^2 (2 (a + b) - d^2).
template <class K>
struct Compare_difference_of_lengths
{
  using result_type = typename K::Comparison_result;
  result_type operator()(const typename K::Point_3& p, const typename K::Point_3& q, const typename K::Point_3& r,
                         const typename K::Point_3& s, const typename K::FT& d) const
  {
    using FT = typename K::FT;
    const auto squared_distance = K().compute_squared_distance_3_object();
    const FT a = squared_distance(p, q), b = squared_distance(r, s), d2 = d * d;
    if (a + b < d2) return SMALLER;
    return CGAL::compare(CGAL::square(a - b), d2 * (2 * (a + b) - d2));
  }
};

// On which side of the edge p q of the triangle p q r the projection of s on the triangle's plane lies: POSITIVE on
// that of r. ZERO within a margin of the line. With u = q - p, w = r - p and n = u x w the vector (u u) w - (u w) u is
// perpendicular to the edge, in the plane, and of length |u| |n|.
template <class K>
struct Side_of_edge
{
  using result_type = typename K::Sign;
  result_type operator()(const typename K::Point_3& p, const typename K::Point_3& q, const typename K::Point_3& r,
                         const typename K::Point_3& s, const typename K::FT& margin) const
  {
    using FT = typename K::FT;
    const typename K::Vector_3 u = q - p, w = r - p, t = s - p;
    const FT uu = u * u, uw = u * w, d = uu * (w * t) - uw * (u * t);
    const FT n2 = CGAL::cross_product(u, w).squared_length();
    if (CGAL::square(d) <= CGAL::square(margin) * uu * n2) return ZERO;
    return CGAL::sign(d);
  }
};

// A predicate in interval arithmetic and, where that leaves it open, in exact arithmetic.
template <template <class> class Predicate>
using Exactly = Filtered_predicate<Predicate<Exact_kernel>, Predicate<Simple_cartesian<Interval_nt_advanced>>,
                                   Cartesian_converter<Exact_predicates, Exact_kernel>,
                                   Cartesian_converter<Exact_predicates, Simple_cartesian<Interval_nt_advanced>>>;

inline Comparison_result compare_distance(const Vector& p, const Vector& q, double length)
{
  return Exactly<Compare_with_length>()(exact_point(p), exact_point(q), length);
}

// Whether the lengths |p q| and |r s| differ by at most `tolerance`.
inline bool lengths_agree(const Vector& p, const Vector& q, const Vector& r, const Vector& s, double tolerance)
{
  return Exactly<Compare_difference_of_lengths>()(exact_point(p), exact_point(q), exact_point(r), exact_point(s),
                                                  tolerance) != LARGER;
}

inline Sign side_of_edge(const Vector& p, const Vector& q, const Vector& r, const Vector& s, double margin)
{
  return Exactly<Side_of_edge>()(exact_point(p), exact_point(q), exact_point(r), exact_point(s), margin);
}

// Whether y may be x after a rigid motion: all six lengths agree. Two vertices that are each off by the tolerance
// change a length by twice as much; for the first pair the search allows for one tolerance (the sphere of section 6).
inline bool are_rigid(const std::array<Vector, 4>& x, const std::array<Vector, 4>& y, double tolerance)
{
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j)
      if (!lengths_agree(x[i], x[j], y[i], y[j], j == 1 ? tolerance : 2 * tolerance)) return false;
  return true;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_EXACT_RIGIDITY_H
