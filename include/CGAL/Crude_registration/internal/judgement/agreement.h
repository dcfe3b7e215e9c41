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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_AGREEMENT_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_AGREEMENT_H

// How a pose explains two scans: what agrees, and what lies where the other scan saw that there is nothing.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/internal/judgement/Judged_pose.h>
#include <CGAL/Crude_registration/internal/lookup/Probes.h>
#include <CGAL/Crude_registration/internal/reduction/Reduced_scan.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// How close is near, what faces the same way, and how far in front of what was seen is free space.
struct Look
{
  float distance;       // to the plane of the nearest surfel
  float minimal_cosine; // of the normals
  float free_depth;
};

// The first `n` probes of a level, in the order of its surfels: one after the other lies near the one before, and finds
// in the cache what that has looked at.
inline Probes neighbouring_probes(const Surfel_level& level, std::size_t n)
{
  std::vector<std::int32_t> indices(level.probes.begin(),
                                    level.probes.begin() + std::ptrdiff_t((std::min)(n, level.probes.size())));
  std::sort(indices.begin(), indices.end());
  std::vector<Surfel> probes;
  probes.reserve(indices.size());
  for (const std::int32_t i : indices) probes.push_back(level.surfels[std::size_t(i)]);
  return Probes(std::move(probes));
}

// All probes of a level, in an order such that each beginning stands for all.
inline Probes ordered_probes(const Surfel_level& level)
{
  std::vector<Surfel> probes;
  probes.reserve(level.probes.size());
  for (const std::int32_t i : level.probes) probes.push_back(level.surfels[std::size_t(i)]);
  return Probes(std::move(probes));
}

// The agreement under `pose`, target from source, of probes of either scan; those of the source are compared with the
// surfels of `level`. It ends where a score of `least` is out of reach: the score is then any below it.
inline Agreement agreement(const Reduced_scan& source, const Some_probes& source_probes, const Reduced_scan& target,
                           const Some_probes& target_probes, const Surfel_level& level, const Pose& pose,
                           const Look& look, float least = -(std::numeric_limits<float>::max)())
{
  const std::size_t n = source_probes.number, m = target_probes.number;
  std::size_t agreeing = 0, before_target = 0, before_source = 0;
  // With `open` probes of the source to come: no later score is above that with all of them agreeing.
  const auto result = [&](std::size_t open) {
    Agreement a;
    if (n > 0) a.overlap = float(agreeing + open) / float(n);
    if (n > 0) a.violations = float(before_target) / float(n);
    if (m > 0) a.violations += float(before_source) / float(m);
    return a;
  };
  constexpr auto size = std::size_t(row_size);
  const bool target_is_known = target.depths.is_known();
  for (std::size_t from = 0; from < n; from += size) {
    if (result(n - from).score() < least) return result(n - from);
    const int in_row = int((std::min)(size, n - from));
    const Rows places = moved(pose, source_probes.probes.positions(source_probes.first + from)),
               normals = rotated(pose.rotation, source_probes.probes.normals(source_probes.first + from));
    const Index_row nearest = level.field.nearest(places);
    Index_row agrees = Index_row::Zero();
    for (int i = 0; i < in_row; ++i) {
      if (nearest[i] < 0) continue;
      // What agrees is on the surface that was seen, though it may be before it along a grazing line of sight.
      agrees[i] = int(is_like(level.surfels[std::size_t(nearest[i])], column(places, i), column(normals, i),
                              look.distance, look.minimal_cosine));
    }
    agreeing += std::size_t(agrees.sum());
    if (!target_is_known) continue;
    const Row depths = target.depths.in_front(places);
    for (int i = 0; i < in_row; ++i) before_target += std::size_t(int(depths[i] > look.free_depth) & (1 - agrees[i]));
  }
  if (source.depths.is_known()) {
    const Pose back = pose.inverse();
    for (std::size_t from = 0; from < m; from += size) {
      if (result(0).score() < least) break;
      const Row depths =
          source.depths.in_front(moved(back, target_probes.probes.positions(target_probes.first + from)));
      const int in_row = int((std::min)(size, m - from));
      for (int i = 0; i < in_row; ++i) before_source += std::size_t(depths[i] > look.free_depth);
    }
  }
  return result(0);
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_AGREEMENT_H
