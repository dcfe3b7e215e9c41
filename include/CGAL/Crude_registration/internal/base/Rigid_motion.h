// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_RIGID_MOTION_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_RIGID_MOTION_H

#include <CGAL/Aff_transformation_3.h>
#include <CGAL/number_utils.h>

#include <Eigen/Core>

namespace CGAL {
namespace Crude_registration {
namespace internal {

using Vector = Eigen::Vector3d;
using Matrix = Eigen::Matrix3d;

// The bounds of the coordinates and of the size of a scan: products of four lengths have to be numbers.
inline constexpr double largest_coordinate = 1e75, smallest_size = 1e-75;

// x -> rotation * x + translation. A motion called `a_from_b` maps coordinates of frame b to frame a.
struct Rigid_motion
{
  Matrix rotation = Matrix::Identity();
  Vector translation = Vector::Zero();

  Vector operator()(const Vector& p) const { return rotation * p + translation; }

  Rigid_motion inverse() const
  {
    Rigid_motion m;
    m.rotation = rotation.transpose();
    m.translation = -(m.rotation * translation);
    return m;
  }

  // (a * b)(x) = a(b(x))
  friend Rigid_motion operator*(const Rigid_motion& a, const Rigid_motion& b)
  {
    Rigid_motion m;
    m.rotation = a.rotation * b.rotation;
    m.translation = a.rotation * b.translation + a.translation;
    return m;
  }
};

template <class Kernel>
Aff_transformation_3<Kernel> to_aff_transformation(const Rigid_motion& m)
{
  using RT = typename Kernel::RT;
  const auto r = [&m](int i, int j) { return RT(m.rotation(i, j)); };
  const auto t = [&m](int i) { return RT(m.translation(i)); };
  return Aff_transformation_3<Kernel>(r(0, 0), r(0, 1), r(0, 2), t(0), r(1, 0), r(1, 1), r(1, 2), t(1), r(2, 0),
                                      r(2, 1), r(2, 2), t(2));
}

template <class Kernel>
Rigid_motion to_rigid_motion(const Aff_transformation_3<Kernel>& a)
{
  Rigid_motion m;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) m.rotation(i, j) = CGAL::to_double(a.m(i, j));
    m.translation(i) = CGAL::to_double(a.m(i, 3));
  }
  return m;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_RIGID_MOTION_H
