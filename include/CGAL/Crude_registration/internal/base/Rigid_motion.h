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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_RIGID_MOTION_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_RIGID_MOTION_H

// Vectors, and rigid motions of them, in double and in float.

#include <CGAL/Aff_transformation_3.h>
#include <CGAL/number_utils.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace CGAL {
namespace Crude_registration {
namespace internal {

template <class T>
using Basic_vector = Eigen::Matrix<T, 3, 1>;
template <class T>
using Basic_matrix = Eigen::Matrix<T, 3, 3>;
using Vector = Basic_vector<double>;
using Matrix = Basic_matrix<double>;
using Vector_f = Basic_vector<float>;
using Matrix_f = Basic_matrix<float>;

// The bounds of the coordinates and of the size of a scan: products of four lengths have to be numbers.
inline constexpr double largest_coordinate = 1e75, smallest_size = 1e-75;

// x -> rotation * x + translation. A motion called `a_from_b` maps coordinates of frame b to frame a.
template <class T>
struct Basic_rigid_motion
{
  Basic_matrix<T> rotation = Basic_matrix<T>::Identity();
  Basic_vector<T> translation = Basic_vector<T>::Zero();

  Basic_vector<T> operator()(const Basic_vector<T>& p) const { return rotation * p + translation; }

  Basic_rigid_motion inverse() const
  {
    Basic_rigid_motion m;
    m.rotation = rotation.transpose();
    m.translation = -(m.rotation * translation);
    return m;
  }

  // (a * b)(x) = a(b(x))
  friend Basic_rigid_motion operator*(const Basic_rigid_motion& a, const Basic_rigid_motion& b)
  {
    Basic_rigid_motion m;
    m.rotation = a.rotation * b.rotation;
    m.translation = a.rotation * b.translation + a.translation;
    return m;
  }
};

using Rigid_motion = Basic_rigid_motion<double>;
using Pose = Basic_rigid_motion<float>; // target from source, in the own frames of two scans

inline Pose to_pose(const Rigid_motion& motion)
{
  return {motion.rotation.cast<float>(), motion.translation.cast<float>()};
}

inline Rigid_motion to_rigid_motion(const Pose& pose)
{
  // A float's rotation is orthogonal to seven digits only.
  return {Eigen::Quaterniond(Matrix(pose.rotation.cast<double>())).normalized().toRotationMatrix(),
          pose.translation.cast<double>()};
}

template <class Kernel>
Aff_transformation_3<Kernel> to_aff_transformation(const Rigid_motion& m)
{
  using RT = typename Kernel::RT;
  const auto r = [&m](int i, int j) { return RT(m.rotation(i, j)); };
  const auto t = [&m](int i) { return RT(m.translation(i)); };
  return Aff_transformation_3<Kernel>(r(0, 0), r(0, 1), r(0, 2), t(0), r(1, 0), r(1, 1), r(1, 2), t(1), r(2, 0),
                                      r(2, 1), r(2, 2), t(2));
}

template <class Point>
Vector to_vector(const Point& p)
{
  return Vector(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
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
