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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_COMPARE_POINTS_IMPL_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_COMPARE_POINTS_IMPL_H

// The comparison of points with a scan of compare_points.h, by what the judge asks of its samples.

#include <CGAL/Crude_registration/Judgement_limits.h>
#include <CGAL/Crude_registration/internal/judgement/compare_points.h>
#include <CGAL/Crude_registration/internal/judgement/estimate_poses.h>
#include <CGAL/Crude_registration/internal/motion/Nearest_surfel.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

CGAL_CRUDE_REGISTRATION_INLINE std::vector<Met_surface> compare_points(const std::vector<Vector>& points,
                                                                       const Reduced_scan& from, const Reduced_scan& to,
                                                                       const Rigid_motion& motion)
{
  const Rigid_motion own = to.own_from_input * motion;
  const Matrix input_from_own = to.own_from_input.rotation.transpose();
  const Look look = fine_look(from, to);
  const Nearest_surfel surface{to.fine.surfels, to.fine.field, double(to.fine.spacing)};
  const double reach =
      (std::max)(double(to.fine.spacing), Judgement_limits::residual_reach * (std::max)(from.spacing, to.spacing));
  std::vector<Met_surface> met;
  met.reserve(points.size());
  for (const Vector& point : points) {
    Met_surface m;
    const Vector p = own(point);
    Surface_point closest;
    if (surface.closest(p, reach, closest)) {
      m.distance = closest.normal.dot(p - closest.point);
      m.normal = input_from_own * closest.normal.normalized();
    }
    if (to.depths.is_known() && !(std::abs(m.distance) <= double(look.distance)))
      m.is_in_free_space = to.depths.in_front(p.cast<float>()) > look.free_depth;
    met.push_back(m);
  }
  return met;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_COMPARE_POINTS_IMPL_H
