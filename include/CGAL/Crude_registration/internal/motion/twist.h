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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_TWIST_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_TWIST_H

// Small motions x -> x + w x x + v, as (w, v): in other frames, and followed for a time.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>

#include <Eigen/Geometry>

#include <cmath>

namespace CGAL {
namespace Crude_registration {
namespace internal {

using Matrix_6 = Eigen::Matrix<double, 6, 6>;
using Vector_6 = Eigen::Matrix<double, 6, 1>;

// The matrix of x -> t x x.
inline Matrix cross_matrix(const Vector& t)
{
  Matrix m;
  m << 0, -t.z(), t.y(), t.z(), 0, -t.x(), -t.y(), t.x(), 0;
  return m;
}

// How the small motion x -> x + w x x + v reads in the frame that `motion` maps to: of (w, v), in this order.
inline Matrix_6 adjoint(const Rigid_motion& motion)
{
  Matrix_6 a = Matrix_6::Zero();
  a.topLeftCorner<3, 3>() = a.bottomRightCorner<3, 3>() = motion.rotation;
  a.bottomLeftCorner<3, 3>() = cross_matrix(motion.translation) * motion.rotation;
  return a;
}

// The motion along `twist` = (w, v), x -> x + w x x + v, for the time `t`.
inline Rigid_motion exponential(const Vector_6& twist, double t)
{
  const Vector w = t * twist.head<3>(), v = t * twist.tail<3>();
  const double angle = w.norm();
  Rigid_motion m;
  m.translation = v;
  if (angle < 1e-12) return m;
  const Vector axis = w / angle;
  m.rotation = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  m.translation = std::sin(angle) / angle * v + (1 - std::cos(angle)) / angle * axis.cross(v) +
                  (1 - std::sin(angle) / angle) * axis.dot(v) * axis;
  return m;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_TWIST_H
