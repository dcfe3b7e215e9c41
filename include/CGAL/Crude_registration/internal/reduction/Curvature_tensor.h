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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_CURVATURE_TENSOR_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_CURVATURE_TENSOR_H

// The curvature tensor of a surface at a place, and the frame that it is written in.

#include <CGAL/Crude_registration/internal/mesh/Flat_mesh.h>

#include <array>
#include <cmath>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Two unit vectors u, v with u x v = n for a unit vector n (Duff et al., "Building an orthonormal basis, revisited",
// 2017): the frame in which a Curvature_tensor at a vertex of normal n is written.
struct Tangent_frame
{
  Vector u, v;

  explicit Tangent_frame(const Vector& n)
  {
    const double sign = std::copysign(1.0, n.z());
    const double a = -1.0 / (sign + n.z());
    const double b = n.x() * n.y() * a;
    u = Vector(1.0 + sign * n.x() * n.x() * a, sign * b, -sign * n.x());
    v = Vector(b, sign + n.y() * n.y() * a, -n.y());
  }
};

// A second fundamental form in a tangent frame (u, v): a unit tangent vector x u + y v bends the surface by
// uu x^2 + 2 uv x y + vv y^2, in 1/length, positive where the surface is convex seen from outside.
struct Curvature_tensor
{
  double uu = 0, uv = 0, vv = 0;

  double mean() const { return 0.5 * (uu + vv); }
  double gaussian() const { return uu * vv - uv * uv; }
  double deviation() const { return std::hypot(0.5 * (uu - vv), uv); }
  double minimum() const { return mean() - deviation(); }
  double maximum() const { return mean() + deviation(); }

  // The direction of the maximal curvature as its components along u and v; that of the minimal one is (-y, x).
  std::array<double, 2> direction_of_maximum() const
  {
    const double angle = 0.5 * std::atan2(2 * uv, uu - vv);
    return {std::cos(angle), std::sin(angle)};
  }

  Curvature_tensor& operator+=(const Curvature_tensor& t)
  {
    uu += t.uu;
    uv += t.uv;
    vv += t.vv;
    return *this;
  }
  friend Curvature_tensor operator*(double w, const Curvature_tensor& t)
  {
    Curvature_tensor r;
    r.uu = w * t.uu;
    r.uv = w * t.uv;
    r.vv = w * t.vv;
    return r;
  }
  friend Curvature_tensor operator/(const Curvature_tensor& t, double w)
  {
    Curvature_tensor r;
    r.uu = t.uu / w;
    r.uv = t.uv / w;
    r.vv = t.vv / w;
    return r;
  }
};

// The second fundamental form W that explains best, in the least squares sense, how normals differ from place to place,
// y = W x: a place x = (xu, xv) further in a tangent frame the normal is y = (yu, yv) more. Equation 6 of Rusinkiewicz
// 2004, over the edges of a face or any neighbourhood. Its normal equations have the matrix [a b 0; b a+c b; 0 b c].
struct Second_fundamental_form_fit
{
  double a = 0, b = 0, c = 0, r0 = 0, r1 = 0, r2 = 0;

  void add(double xu, double xv, double yu, double yv)
  {
    a += xu * xu;
    b += xu * xv;
    c += xv * xv;
    r0 += xu * yu;
    r1 += xu * yv + xv * yu;
    r2 += xv * yv;
  }

  // The square of an area: zero where all places lie on a line, and determine no form.
  double minor() const { return a * c - b * b; }
  double trace() const { return a + c; }

  // `minor`: that of above, or what it is known to be with more digits; above zero.
  Curvature_tensor solved(double minor) const
  {
    const double scale = 1 / (trace() * minor);
    Curvature_tensor form;
    form.uu = ((minor + c * c) * r0 - b * c * r1 + b * b * r2) * scale;
    form.uv = (a * c * r1 - b * (c * r0 + a * r2)) * scale;
    form.vv = ((minor + a * a) * r2 - a * b * r1 + b * b * r0) * scale;
    return form;
  }
};

// One curvature tensor a vertex. `areas` are the parts of the faces that are nearest to each vertex (Voronoi areas, cut
// off at obtuse angles): what the tensors are to be weighted with. 0 where no face of positive area is incident.
struct Curvature_field
{
  std::vector<Vector> normals;
  std::vector<Curvature_tensor> tensors;
  std::vector<double> areas;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_CURVATURE_TENSOR_H
