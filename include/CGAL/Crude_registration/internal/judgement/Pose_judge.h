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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_POSE_JUDGE_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_POSE_JUDGE_H

// The third step of a registration: proposed poses are refined, looked at closely, and told apart.

#include <CGAL/Crude_registration/internal/base/for_each_index.h>
#include <CGAL/Crude_registration/internal/judgement/agreement.h>
#include <CGAL/Crude_registration/internal/judgement/estimate_poses.h>
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

class Pose_judge
{
public:
  // All kept by reference.
  Pose_judge(const Reduced_scan& source, const Reduced_scan& target, Execution execution, Run_control& control)
      : m_source(source), m_target(target), m_execution(execution), m_control(control),
        m_fine_source_probes(source.fine, 0, 2500), m_fine_target_probes(target.fine, 0, 2500)
  {
    m_extent = float((std::min)(source.extent, target.extent));
    m_fine_look = look_at(source.fine, target.fine, 4.3f, 2.4f, 3 * float((std::max)(source.spacing, target.spacing)));
  }

  // The poses after refinement, looked at closely: of the best `number` of them, with no more than a few from around
  // each place. `are_estimated`: by whoever proposed them, best first. None if the run is stopped.
  std::vector<Judged_pose> operator()(const std::vector<Pose>& proposed, bool are_estimated, std::size_t number)
  {
    std::vector<Estimated_pose> best;
    if (are_estimated)
      for (std::size_t i = 0; i < (std::min)(proposed.size(), number); ++i) best.push_back({proposed[i], 0, i});
    else best = estimated_again(m_source, m_target, proposed, number, m_execution, m_control);
    std::vector<Judged_pose> poses(best.size());
    for_each_index(m_execution, best.size(), m_control, [&](std::size_t i) {
      poses[i] = judged(best[i].pose);
      poses[i].proposed = proposed[best[i].index];
    });
    if (m_control.is_stopped()) return {};
    return poses;
  }

  // A pose as it is.
  Agreement assess(const Pose& pose) const
  {
    return agreement(m_source, m_fine_source_probes, m_target, m_fine_target_probes, m_target.fine, pose, m_fine_look);
  }

  // A pose after refinement on the fine surfels.
  Judged_pose judged(const Pose& proposed) const
  {
    Pose pose = proposed;
    const float spacing = (std::max)(m_source.fine.spacing, m_target.fine.spacing);
    // The first steps are the longest, and fewer probes tell them.
    const Probes some(m_source.fine, 0, 800);
    for (float reach : {2.f, 2.f, 2.f, 1.25f})
      if (refine_step(some, m_target.fine, {reach * spacing, 0.8f}, pose) < 6) break;
    for (float reach : {1.25f, 0.75f})
      if (refine_step(m_fine_source_probes, m_target.fine, {reach * spacing, 0.8f}, pose) < 6) break;
    return {pose, proposed, assess(pose)};
  }

  // Twice what any wrong pose was seen to reach, and far ahead of every other pose.
  static bool is_certain(const std::vector<Judged_pose>& judged)
  {
    if (judged.empty() || judged.front().score() < 0.2f) return false;
    return judged.size() == 1 || judged[1].score() < 0.4f * judged.front().score();
  }

  // Keeps `judged` sorted and its poses distinct: of each the best, with the proposal that is nearest to it of those
  // that have led there.
  void add_distinct(Judged_pose pose, std::vector<Judged_pose>& judged) const
  {
    const auto is_same = [&](const Judged_pose& other) { return are_one(pose.pose, other.pose, m_extent); };
    for (Judged_pose& other : judged) {
      if (!is_same(other)) continue;
      const Judged_pose& better = other.score() >= pose.score() ? other : pose;
      other.proposed = pose.proposed =
          is_nearer(pose.proposed, other.proposed, better.pose, m_extent) ? pose.proposed : other.proposed;
      if (&better == &other) return;
    }
    judged.erase(std::remove_if(judged.begin(), judged.end(), is_same), judged.end());
    judged.insert(std::find_if(judged.begin(), judged.end(),
                               [&](const Judged_pose& other) { return other.score() < pose.score(); }),
                  pose);
  }

private:
  const Reduced_scan& m_source;
  const Reduced_scan& m_target;
  const Execution m_execution;
  Run_control& m_control;
  const Probes m_fine_source_probes, m_fine_target_probes;
  float m_extent = 0;
  Look m_fine_look;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_POSE_JUDGE_H
