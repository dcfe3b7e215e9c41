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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_NEAR_POSES_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_NEAR_POSES_H

// How near two poses are: whether they count as one.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Poses that refinement will most likely make one: within some spacings and degrees.
inline bool are_close(const Pose& a, const Pose& b, float spacing)
{
  const float trace = (a.rotation.array() * b.rotation.array()).sum();
  return trace > 2.989f && (a.translation - b.translation).squaredNorm() < 2.25f * spacing * spacing;
}

// Poses that are no more than 10 degrees and a twentieth of the extent apart.
inline bool are_one(const Pose& a, const Pose& b, float extent)
{
  const float trace = (a.rotation.array() * b.rotation.array()).sum();
  return trace > 1 + 2 * 0.985f && (a.translation - b.translation).norm() < 0.05f * extent;
}

// Which of two poses is nearer to a third one, turns being measured by what they move at half the extent.
inline bool is_nearer(const Pose& a, const Pose& b, const Pose& to, float extent)
{
  const auto distance = [&](const Pose& p) {
    const float r = 0.5f * extent;
    return r * r * (p.rotation - to.rotation).squaredNorm() + (p.translation - to.translation).squaredNorm();
  };
  return distance(a) < distance(b);
}

// The poses of the first `number` candidates of which no two count as one.
template <class Candidate>
std::vector<Pose> first_distinct(const std::vector<Candidate>& candidates, std::size_t number, float extent)
{
  std::vector<Pose> poses;
  for (const Candidate& c : candidates) {
    if (poses.size() == number) break;
    if (std::none_of(poses.begin(), poses.end(), [&](const Pose& p) { return are_one(c.pose, p, extent); }))
      poses.push_back(c.pose);
  }
  return poses;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_NEAR_POSES_H
