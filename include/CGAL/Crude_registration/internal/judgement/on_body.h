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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_ON_BODY_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_ON_BODY_H

// What only the whole surface of a body can tell: all that was seen of the body has to lie on it.

#include <CGAL/Crude_registration/internal/judgement/body_coefficients.h>
#include <CGAL/Crude_registration/internal/judgement/log_odds.h>
#include <CGAL/Crude_registration/internal/judgement/probe_outcomes.h>
#include <CGAL/Crude_registration/internal/reduction/Reduced_scan.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// How far a surfel may lie from the surface, as that bends within it. Where two planes meet at right angles, the mean
// of samples that fill a cell on either side is a quarter of the cell away from both; across such an edge the standard
// deviation is 0.14 a = 0.107 of the cell (variance_of_place(), which knows it to a tenth).
inline float distance_by_bend(const Surfel& s)
{
  return 0.25f / 0.107f * std::sqrt(s.variance);
}

// Whether a place is on the surface of a body to within `distance`, and to within how far the body's surfels are off as
// they bend. A surfel stands for what is around it to within half a diagonal of the spacing, and a little more; which
// one is the nearest, the field does not tell exactly: those of the voxels around are looked at, too.
inline bool is_on(const Surfel_level& body, const Vector_f& place, float distance)
{
  constexpr float reach = 0.75f; // in spacings
  const auto is_near = [&](const Vector_f& at) {
    const int i = body.field.nearest(at);
    if (i < 0) return false;
    const Surfel& s = body.surfels[std::size_t(i)];
    const Vector_f d = place - s.position;
    const float height = s.normal.dot(d), aside = (d - height * s.normal).norm(),
                beyond = (std::max)(aside - reach * body.spacing, 0.f), most = distance + distance_by_bend(s);
    return height * height + beyond * beyond <= most * most;
  };
  if (is_near(place)) return true;
  constexpr int here = 13; // of the 27 voxels
  for (int k = 0; k < 27; ++k)
    if (k != here && is_near(place + body.spacing * Eigen::Vector3i(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1).cast<float>()))
      return true;
  return false;
}

// The share of a view's probes that are not on the body under `pose`, body from view. The surfels of either may be off
// by the tolerance, and by how they bend. On which side the surface is does not matter: of points without a sensor, a
// part may be turned over.
template <class Probe_range>
double share_off_body(const Probe_range& probes, const Surfel_level& body, const Pose& pose,
                      const Probe_tolerance& tolerance)
{
  std::size_t off = 0;
  for (const Surfel& s : probes)
    off += std::size_t(!is_on(body, pose(s.position), 2 * tolerance.distance + distance_by_bend(s)));
  return probes.size() > 0 ? double(off) / double(probes.size()) : 0;
}

// The evidence as the laws of a view and a body read it: what is off the body, as a share of the view's probes, is
// added to what is in free space.
inline Pose_evidence with_share_off(Pose_evidence evidence, double share_off)
{
  evidence.violations += share_off;
  return evidence;
}

// The coefficients for a view and a body, as chance is between any two scans: as the pair's own candidates have it, it
// explains away what all of these have in common, which are planes between machined parts. Poses share the probability
// by the law of all scans, as what is off the body weighs there what is in free space does (fitted to views of bodies,
// it was -25 for -24); whether one is right is told by a law of its own.
inline Evidence_coefficients coefficients_of_body(Evidence_coefficients c)
{
  c.usual_any = Body_coefficients().any;
  return c;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_ON_BODY_H
