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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_ESTIMATE_POSES_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_ESTIMATE_POSES_H

// Poses estimated again from the reduced surfaces, by some steps of refinement on the coarse surfels.

#include <CGAL/Crude_registration/Judgement_limits.h>
#include <CGAL/Crude_registration/internal/base/for_each_index.h>
#include <CGAL/Crude_registration/internal/base/near_poses.h>
#include <CGAL/Crude_registration/internal/judgement/agreement.h>
#include <CGAL/Crude_registration/internal/motion/refine_step.h>
#include <CGAL/Crude_registration/internal/reduction/Reduced_scan.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

struct Estimated_pose
{
  Pose pose;
  float score;
  std::size_t index; // of what was proposed
};

// How closely two levels are compared: `times_height` and `times_normal` of their noise, with a floor, as sampling
// leaves something even of scans without noise.
inline Look look_at(const Surfel_level& a, const Surfel_level& b, float times_height, float times_normal,
                    float free_depth)
{
  const float height = times_height * (std::max)(a.height_noise, b.height_noise),
              turn = times_normal * (std::max)(a.normal_noise, b.normal_noise);
  return {(std::max)(a.spacing, b.spacing) * (std::min)((std::max)(height, 0.05f), 1.f),
          std::cos((std::min)((std::max)(turn, 0.2f), 0.7f)), free_depth};
}

// How the judge looks at fine surfels: as much as all but a few of their own neighbours are off is near.
inline Look fine_look(const Reduced_scan& a, const Reduced_scan& b)
{
  return look_at(a.fine, b.fine, 4.3f, 2.4f,
                 float(Judgement_limits::free_space_depth) * float((std::max)(a.spacing, b.spacing)));
}

// Each pose after a step from each of the reaches, in spacings of the coarse surfels, by some of the source's; scored
// by the same ones, and the best first.
inline void estimate_poses(const Reduced_scan& source, const Reduced_scan& target, std::size_t number_of_probes,
                           std::initializer_list<float> reaches, Execution execution, Run_control& control,
                           std::vector<Estimated_pose>& poses)
{
  const float spacing = (std::max)(source.coarse.spacing, target.coarse.spacing);
  // About the noise of the worst tenth of surfels.
  const Look look = look_at(source.coarse, target.coarse, 2.7f, 1.75f, 1.2f * spacing);
  const Probes source_probes = neighbouring_probes(source.coarse, number_of_probes),
               target_probes = neighbouring_probes(target.coarse, 200);
  for_each_index(execution, poses.size(), control, [&](std::size_t i) {
    Estimated_pose& p = poses[i];
    for (float reach : reaches)
      if (refine_step(source_probes, target.coarse, {reach * spacing, 0.7f}, p.pose) < 6) break;
    p.score = agreement(source, source_probes, target, target_probes, target.coarse, p.pose, look).score();
  });
  std::stable_sort(poses.begin(), poses.end(),
                   [](const Estimated_pose& a, const Estimated_pose& b) { return a.score > b.score; });
}

// Poses that a few correspondences have given, estimated again from all of the coarse surfels that agree under them:
// the best `number` of them, with no more than a few from around each place. All are added to `tried`.
inline std::vector<Estimated_pose> estimated_again(const Reduced_scan& source, const Reduced_scan& target,
                                                   const std::vector<Pose>& proposed, std::size_t number,
                                                   Execution execution, Run_control& control, std::vector<Pose>& tried)
{
  std::vector<Estimated_pose> all(proposed.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = {proposed[i], 0, i};
  estimate_poses(source, target, 200, {1.5f, 1.5f, 1.f}, execution, control, all);
  for (std::size_t i = 4 * number; i < all.size(); ++i) tried.push_back(all[i].pose);
  if (all.size() > 4 * number) all.resize(4 * number);
  estimate_poses(source, target, 400, {1.f, 0.5f, 0.5f, 0.5f}, execution, control, all);
  for (const Estimated_pose& p : all) tried.push_back(p.pose);
  // Some from around each pose, as not all end in it; not all from around the best one, as it needs rivals.
  constexpr auto most_of_one = 3;
  const float spacing = (std::max)(source.coarse.spacing, target.coarse.spacing);
  const auto extent = float((std::min)(source.extent, target.extent));
  std::vector<Estimated_pose> best;
  for (const Estimated_pose& p : all) {
    if (best.size() == number) break;
    const auto count = [&](const auto& is_near) {
      return std::count_if(best.begin(), best.end(), [&](const Estimated_pose& k) { return is_near(p.pose, k.pose); });
    };
    if (count([&](const Pose& x, const Pose& y) { return are_close(x, y, spacing); }) == 0 &&
        count([&](const Pose& x, const Pose& y) { return are_one(x, y, extent); }) < most_of_one)
      best.push_back(p);
  }
  // Where several have led to one place, the nearest is what has been proposed.
  for (Estimated_pose& k : best)
    for (const Estimated_pose& p : all)
      if (are_one(p.pose, k.pose, extent) && is_nearer(proposed[p.index], proposed[k.index], k.pose, extent))
        k.index = p.index;
  return best;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_ESTIMATE_POSES_H
