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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_LOOKUP_PAIR_ANGLES_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_LOOKUP_PAIR_ANGLES_H

// What a rigid motion leaves of two points with normals, beside their distance.

#include <CGAL/Crude_registration/internal/base/fast_angles.h>

#include <Eigen/Geometry>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Two oriented points as seen from each other: the angles between their normals and the line from the first to the
// second, and the signed turn about that line from the first normal to the second. With the length of the line all that
// a rigid motion leaves of them; a mirror image has the opposite turn.
struct Pair_angles
{
  float first, second, turn; // radians: [0, pi], [0, pi], [-pi, pi]
};

// The cosines of those angles; that of the turn and its sine have a common factor, the product of the sines of the two
// angles.
template <class Number>
struct Pair_cosines
{
  Number first, second, turn, sine_of_turn;

  // Seen from the other end the angles are supplements and the turn is the same.
  Pair_cosines reversed() const { return {-second, -first, turn, sine_of_turn}; }

  // To some 4e-8 and what float leaves of it.
  Pair_angles angles() const
  {
    return {float(fast_acos(double(first))), float(fast_acos(double(second))),
            float(fast_atan2(double(sine_of_turn), double(turn)))};
  }
};

// Of unit normals n and m; u: the unit vector from the first point to the second.
template <class Vector_type>
Pair_cosines<typename Vector_type::Scalar> pair_cosines(const Vector_type& u, const Vector_type& n,
                                                        const Vector_type& m)
{
  const auto first = n.dot(u), second = m.dot(u);
  // Of the parts of the normals that are perpendicular to the line.
  return {first, second, n.dot(m) - first * second, u.dot(n.cross(m))};
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_LOOKUP_PAIR_ANGLES_H
