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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_KNOWN_POSES_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_KNOWN_POSES_H

// What is known of the poses of scans before they are put together.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// A hint says of a scan what the pairs say if it displaces it no farther than this share of the deviation of the scan's
// surface from its centre: turns of 36 degrees, for which the part (angle - sin(angle)) / pi of all turns is small
// enough, 0.013, that no more agree by chance than of motions.
constexpr double hint_tolerance = 0.5;

struct Known_pose
{
  std::size_t group = 0; // poses of one group are in one frame
  Rigid_motion motion;   // to that frame from the scan's
  // The same as it was given, where that is rigid but for rounding: what is fixed comes back to the last bit.
  std::optional<Rigid_motion> given{};
};

struct Known_poses
{
  std::vector<std::optional<Known_pose>> poses; // of all scans, or of none
  bool are_fixed = false;                       // else they are hints
  std::optional<std::size_t> reference;         // the scan whose frame is that of its component

  const Known_pose* of(std::size_t i) const { return i < poses.size() && poses[i] ? &*poses[i] : nullptr; }

  // Whether the motion between two scans is known, if need be but by a hint.
  bool are_related(std::size_t i, std::size_t j) const { return of(i) && of(j) && of(i)->group == of(j)->group; }

  // The scan that gives its part its frame: of those of `scans`, ascending, the first one that is fixed, or else the
  // reference, or else the first.
  std::size_t anchor(const std::vector<std::size_t>& scans) const
  {
    if (are_fixed)
      for (const std::size_t i : scans)
        if (of(i)) return i;
    for (const std::size_t i : scans)
      if (reference == i) return i;
    return scans.front();
  }
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_KNOWN_POSES_H
