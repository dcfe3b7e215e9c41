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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_SCAN_FRAME_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_SCAN_FRAME_H

// A frame of a scan's own, which moves with it.

#include <CGAL/Crude_registration/internal/reduction/Curvature_tensors.h>
#include <CGAL/Crude_registration/internal/base/Run_control.h>
#include <CGAL/Crude_registration/internal/mesh/mesh_geometry.h>
#include <CGAL/Crude_registration/internal/sampling/orient_points.h>
#include <CGAL/Crude_registration/internal/base/symmetric_eigen.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The motion into the frame of rows x, y = z x x, z and of the given origin. x and z: perpendicular unit vectors.
inline Rigid_motion frame_of_axes(const Vector& x, const Vector& z, const Vector& origin)
{
  Rigid_motion frame;
  frame.rotation.row(0) = x;
  frame.rotation.row(1) = z.cross(x);
  frame.rotation.row(2) = z;
  frame.translation = -(frame.rotation * origin);
  return frame;
}

// The frame of scan_frame() from the moments of a surface: its mean normal, its covariance, and the third moment along
// an axis.
template <class Skewness>
Rigid_motion frame_of_moments(const Vector& normal, double area, const Matrix& covariance, const Vector& origin,
                              const Skewness& skewness, const Vector& viewing_direction)
{
  Vector z = -unit_or_zero(viewing_direction);
  if (z.isZero()) {
    if (normal.norm() >= 0.1 * area) {
      z = normal.normalized();
    } else {
      z = symmetric_eigen(covariance).vectors.col(0);
      if (skewness(z) < 0) z = -z;
    }
  }
  const Tangent_frame plane(z);
  Curvature_tensor projected; // any symmetric form in a tangent frame
  projected.uu = plane.u.dot(covariance * plane.u);
  projected.uv = plane.u.dot(covariance * plane.v);
  projected.vv = plane.v.dot(covariance * plane.v);
  const std::array<double, 2> major = projected.direction_of_maximum();
  Vector x = major[0] * plane.u + major[1] * plane.v;
  if (skewness(x) < 0) x = -x;
  return frame_of_axes(x, z, origin);
}

// The motion from a scan's coordinates into a frame of the scan's own, which moves with the scan: computed from a moved
// scan it gives the same coordinates up to rounding, and every quantity that depends on axes is to be taken in it.
//
// The origin is the surface's centroid. z, the depth axis, points towards the viewer: against `viewing_direction` where
// that is not null, along the mean normal otherwise, and where the normals cancel (closed meshes: a mean of less than a
// tenth) along the axis of least variance. x is the direction of largest variance in the image plane perpendicular to
// z. Signs that the normals do not fix are such that the third moment is positive. All moments are integrals over the
// surface. On a surface of revolution seen along its axis, x has no meaning, on a symmetric one its sign has none.
// `areas`: of the faces. \throws Run_control::Stopped
inline Rigid_motion scan_frame(const Flat_mesh& mesh, const std::vector<double>& areas, const Vector& viewing_direction,
                               Run_control& control = to_the_end())
{
  const Vector centre = centre_of_box(mesh.points);
  double area = 0;
  Vector normal = Vector::Zero(), first = Vector::Zero();
  Matrix second = Matrix::Zero();
  const auto corner = [&](std::size_t face, std::size_t k) -> Vector {
    return mesh.points[std::size_t(mesh.faces[face][k])] - centre;
  };
  for (std::size_t i = 0; i < areas.size(); ++i) {
    control.check(i);
    const Vector a = corner(i, 0), b = corner(i, 1), c = corner(i, 2), sum = a + b + c;
    area += areas[i];
    normal += 0.5 * area_vector(a, b, c);
    first += (areas[i] / 3) * sum;
    second += (areas[i] / 12) * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  if (!(area > 0)) return frame_of_axes(Vector::UnitX(), Vector::UnitZ(), centre);
  const Vector centroid = first / area;
  const Matrix covariance = second / area - centroid * centroid.transpose();

  // The sign of the third moment along an axis, faces taken as points.
  const auto skewness = [&](const Vector& axis) {
    double moment = 0;
    for (std::size_t i = 0; i < areas.size(); ++i) {
      control.check(i);
      const double t = axis.dot((corner(i, 0) + corner(i, 1) + corner(i, 2)) / 3 - centroid);
      moment += areas[i] * t * t * t;
    }
    return moment;
  };

  return frame_of_moments(normal, area, covariance, centre + centroid, skewness, viewing_direction);
}

inline Rigid_motion scan_frame(const Flat_mesh& mesh, const Vector& viewing_direction = Vector::Zero())
{
  return scan_frame(mesh, face_areas(mesh), viewing_direction);
}

// The same of a surface that is given by samples of even density.
inline Rigid_motion scan_frame(const Oriented_points& samples, const Vector& viewing_direction,
                               Run_control& control = to_the_end())
{
  const std::vector<Vector>& points = samples.points;
  const Vector centre = centre_of_box(points);
  if (points.empty()) return frame_of_axes(Vector::UnitX(), Vector::UnitZ(), centre);
  const double weight = 1 / double(points.size());
  Vector normal = Vector::Zero(), centroid = Vector::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    control.check(i);
    normal += weight * samples.normals[i];
    centroid += weight * (points[i] - centre);
  }
  Matrix covariance = Matrix::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    control.check(i);
    const Vector d = points[i] - centre - centroid;
    covariance += weight * (d * d.transpose());
  }
  const auto skewness = [&](const Vector& axis) {
    double moment = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      control.check(i);
      const double t = axis.dot(points[i] - centre - centroid);
      moment += t * t * t;
    }
    return moment;
  };
  return frame_of_moments(normal, 1, covariance, centre + centroid, skewness, viewing_direction);
}

// The edge lengths, along the axes of `frame`, of the box that contains the vertices of the faces.
// \throws Run_control::Stopped
inline Vector extent_in_frame(const Flat_mesh& mesh, const Rigid_motion& frame, Run_control& control = to_the_end())
{
  std::vector<std::uint8_t> has_face(mesh.points.size(), 0);
  for (const auto& f : mesh.faces)
    for (std::int32_t v : f) has_face[std::size_t(v)] = 1;
  Vector low = Vector::Constant((std::numeric_limits<double>::max)()), high = -low;
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    control.check(i);
    if (!has_face[i]) continue;
    const Vector p = frame(mesh.points[i]);
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return mesh.faces.empty() ? Vector(Vector::Zero()) : Vector(high - low);
}

inline Vector extent_in_frame(const Oriented_points& samples, const Rigid_motion& frame, Run_control& control)
{
  Vector low = Vector::Constant((std::numeric_limits<double>::max)()), high = -low;
  for (std::size_t i = 0; i < samples.points.size(); ++i) {
    control.check(i);
    const Vector p = frame(samples.points[i]);
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return samples.points.empty() ? Vector(Vector::Zero()) : Vector(high - low);
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_SCAN_FRAME_H
