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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_REFINE_STEP_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_REFINE_STEP_H

// One step of the refinement of a pose by surfels, in float: what the search spends much of its time on.

#include <CGAL/Crude_registration/internal/base/Rows.h>
#include <CGAL/Crude_registration/internal/lookup/Probes.h>
#include <CGAL/Crude_registration/internal/motion/Normal_equations.h>
#include <CGAL/Crude_registration/internal/reduction/Reduced_scan.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// One step of point-to-plane least squares (Chen and Medioni 1991) of some surfels of the source against the target's
// nearest ones. Returns the number of correspondences; the pose is left as it is where they are fewer than six.
struct Step
{
  float reach;          // largest distance to the plane
  float minimal_cosine; // of the normals
  // Of the heights of surfels that are flat: what bends within a surfel counts by how much more that one's height
  // varies. 0: all count the same.
  float variance = 0;
};

inline int refine_step(const Probes& source, const Surfel_level& target, const Step& step, Pose& pose)
{
  // The unknowns are a rotation about the middle of the correspondences, in units of their spread, and a translation.
  constexpr std::size_t most = 4096;
  thread_local std::vector<std::array<float, 8>> rows; // p, n, residual, weight
  rows.clear();
  Vector_f middle = Vector_f::Zero();
  for (std::size_t from = 0; from < source.size() && rows.size() < most; from += std::size_t(row_size)) {
    const Rows places = moved(pose, source.positions(from)), normals = rotated(pose.rotation, source.normals(from));
    const Index_row nearest = target.field.nearest(places);
    const int in_row = int((std::min)(source.size() - from, (std::min)(std::size_t(row_size), most - rows.size())));
    for (int i = 0; i < in_row; ++i) {
      if (nearest[i] < 0) continue;
      const Surfel& t = target.surfels[std::size_t(nearest[i])];
      const Vector_f p = column(places, i), e = p - t.position;
      const float r = t.normal.dot(e);
      if (std::abs(r) > step.reach || (e - r * t.normal).squaredNorm() > 4 * step.reach * step.reach) continue;
      if (column(normals, i).dot(t.normal) < step.minimal_cosine) continue;
      const float of_source = source[from + std::size_t(i)].variance,
                  weight = step.variance > 0 ? step.variance / (step.variance + of_source + t.variance) : 1.f;
      rows.push_back({p[0], p[1], p[2], t.normal[0], t.normal[1], t.normal[2], r, weight});
      middle += p;
    }
  }
  if (rows.size() < 6) return int(rows.size());
  middle /= float(rows.size());
  float spread = 0;
  for (const auto& r : rows) spread += (Vector_f(r[0], r[1], r[2]) - middle).squaredNorm();
  const float unit = std::sqrt(spread / float(rows.size()));
  if (!(unit > 0)) return 0;

  Normal_equations<float> equations;
  const float inverse_unit = 1 / unit, inverse_reach2 = 1 / (step.reach * step.reach);
  for (const auto& r : rows) {
    const Vector_f n(r[3], r[4], r[5]);
    equations.add(((Vector_f(r[0], r[1], r[2]) - middle) * inverse_unit).cross(n), n, -r[6],
                  r[7] * biweight(r[6] * r[6] * inverse_reach2));
  }
  // A little of the identity: a thousandth of what the correspondences make it in the mean.
  const Eigen::Matrix<float, 6, 1> x = equations.solved(1e-3f * float(rows.size()) / 6);
  const Vector_f w = x.head<3>() * inverse_unit, t = x.tail<3>();
  const float angle = w.norm();
  const Matrix_f r = angle > 1e-7f ? Eigen::AngleAxisf(angle, w / angle).toRotationMatrix() : Matrix_f::Identity();
  pose.translation = r * (pose.translation - middle) + middle + t;
  pose.rotation = r * pose.rotation;
  return int(rows.size());
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_REFINE_STEP_H
