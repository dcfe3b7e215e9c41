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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_PLANE_QUADRIC_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_PLANE_QUADRIC_H

// The sum of the squared distances of a point to planes, and the point where it is least.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>

#include <algorithm>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The sum of the squared distances of a point to a number of planes (Garland and Heckbert, "Surface simplification
// using quadric error metrics", 1997): x^T A x + 2 b^T x + c. Each plane counts once whatever the area of its face, as
// in CGAL's plane policies; then weight = trace(A) is the number of planes and value(x) / weight the mean squared
// distance.
struct Plane_quadric
{
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0; // A
  double x = 0, y = 0, z = 0;                            // b
  double c = 0;
  double weight = 0;

  Plane_quadric() = default;

  // The plane of unit normal n through p.
  Plane_quadric(const Vector& n, const Vector& p)
      : xx(n.x() * n.x()), xy(n.x() * n.y()), xz(n.x() * n.z()), yy(n.y() * n.y()), yz(n.y() * n.z()),
        zz(n.z() * n.z()), weight(1)
  {
    const double d = -n.dot(p);
    x = d * n.x();
    y = d * n.y();
    z = d * n.z();
    c = d * d;
  }

  void add(const Plane_quadric& q, double times = 1)
  {
    xx += times * q.xx;
    xy += times * q.xy;
    xz += times * q.xz;
    yy += times * q.yy;
    yz += times * q.yz;
    zz += times * q.zz;
    x += times * q.x;
    y += times * q.y;
    z += times * q.z;
    c += times * q.c;
    weight += times * q.weight;
  }

  // The minimiser p of value(p) + stiffness * weight * |p - anchor|^2: the point of least distance to the planes in the
  // directions that the planes determine, the anchor's in the others. Relative to the planes' own weight, so the unit
  // of length does not matter, and never further from the anchor than the anchor's own distance to the planes (root
  // mean square) over sqrt(stiffness).
  //
  // Below the square of the angles (in radians) by which the noise of a scan tilts faces, the planes of a smooth region
  // would move the point along the surface by their noise alone.
  static constexpr double least_stiffness = 1e-2;

  struct Optimum
  {
    Vector position;
    double mean_squared_distance;
  };

  Optimum optimum_near(const Vector& anchor, double stiffness = least_stiffness) const
  {
    if (!(weight > 0)) return {anchor, 0};
    const double inverse_weight = 1 / weight, s = stiffness * weight;
    // g = A anchor + b, half the gradient; then (A + s I) step = -g, by the adjugate: the condition is at most
    // 1 + 1 / stiffness.
    const Vector g(xx * anchor.x() + xy * anchor.y() + xz * anchor.z() + x,
                   xy * anchor.x() + yy * anchor.y() + yz * anchor.z() + y,
                   xz * anchor.x() + yz * anchor.y() + zz * anchor.z() + z);
    const double m00 = xx + s, m11 = yy + s, m22 = zz + s;
    const double a00 = m11 * m22 - yz * yz, a01 = xz * yz - xy * m22, a02 = xy * yz - xz * m11,
                 a11 = m00 * m22 - xz * xz, a12 = xy * xz - m00 * yz, a22 = m00 * m11 - xy * xy;
    const double scale = -1 / (m00 * a00 + xy * a01 + xz * a02);
    const Vector step = scale * Vector(a00 * g.x() + a01 * g.y() + a02 * g.z(), a01 * g.x() + a11 * g.y() + a12 * g.z(),
                                       a02 * g.x() + a12 * g.y() + a22 * g.z());
    // value(anchor + step) = value(anchor) + 2 g.step + step.A step, where A step = -g - s step.
    const double value = (g + Vector(x, y, z)).dot(anchor) + c + g.dot(step) - s * step.squaredNorm();
    return {anchor + step, (std::max)(value, 0.0) * inverse_weight};
  }
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_PLANE_QUADRIC_H
