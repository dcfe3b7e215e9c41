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
    m_spacing = (std::max)(source.coarse.spacing, target.coarse.spacing);
    m_extent = float((std::min)(source.extent, target.extent));
    // About the noise of the worst tenth of surfels; a floor, as sampling leaves something even of scans without noise.
    m_coarse_look = look(source.coarse, target.coarse, 2.7f, 1.75f, 1.2f * m_spacing);
    m_fine_look = look(source.fine, target.fine, 4.3f, 2.4f, 3 * float((std::max)(source.spacing, target.spacing)));
  }

  // The poses after refinement, looked at closely: of the best `number` of them, with no more than a few from around
  // each place. None if the run is stopped.
  std::vector<Judged_pose> operator()(const std::vector<Pose>& proposed, std::size_t number)
  {
    const std::vector<Refined> best = refined(proposed, number);
    std::vector<Judged_pose> poses(best.size());
    for_each_index(m_execution, best.size(), m_control, [&](std::size_t i) {
      poses[i] = judged(best[i].pose);
      poses[i].proposed = proposed[best[i].proposal];
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

  // Keeps `judged` sorted and its poses distinct: the best of each.
  void add_distinct(const Judged_pose& pose, std::vector<Judged_pose>& judged) const
  {
    const auto same = [&](const Judged_pose& other) { return are_one(pose.pose, other.pose, m_extent); };
    for (const Judged_pose& other : judged)
      if (other.score() >= pose.score() && same(other)) return;
    judged.erase(std::remove_if(judged.begin(), judged.end(), same), judged.end());
    judged.insert(std::find_if(judged.begin(), judged.end(),
                               [&](const Judged_pose& other) { return other.score() < pose.score(); }),
                  pose);
  }

  // Poses that refinement will most likely make one: within some spacings and degrees.
  static bool are_close(const Pose& a, const Pose& b, float spacing)
  {
    const float trace = (a.rotation.array() * b.rotation.array()).sum();
    return trace > 2.989f && (a.translation - b.translation).squaredNorm() < 2.25f * spacing * spacing;
  }

  // Poses that are no more than 10 degrees and a twentieth of the extent apart.
  static bool are_one(const Pose& a, const Pose& b, float extent)
  {
    const float trace = (a.rotation.array() * b.rotation.array()).sum();
    return trace > 1 + 2 * 0.985f && (a.translation - b.translation).norm() < 0.05f * extent;
  }

private:
  struct Refined
  {
    Pose pose;
    float score;
    std::size_t proposal;
  };

  static Look look(const Surfel_level& a, const Surfel_level& b, float times_height, float times_normal,
                   float free_depth)
  {
    const float height = times_height * (std::max)(a.height_noise, b.height_noise),
                turn = times_normal * (std::max)(a.normal_noise, b.normal_noise);
    return {(std::max)(a.spacing, b.spacing) * (std::min)((std::max)(height, 0.05f), 1.f),
            std::cos((std::min)((std::max)(turn, 0.2f), 0.7f)), free_depth};
  }

  // The poses after some steps of refinement on the coarse surfels, best first, no more than `number` of them.
  std::vector<Refined> refined(const std::vector<Pose>& proposed, std::size_t number)
  {
    std::vector<Refined> all(proposed.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = {proposed[i], 0, i};
    const Probes target_probes(m_target.coarse, 0, 200);
    const auto refine = [&](std::size_t number_of_probes, std::initializer_list<float> reaches) {
      const Probes source_probes(m_source.coarse, 0, number_of_probes);
      for_each_index(m_execution, all.size(), m_control, [&](std::size_t i) {
        Refined& r = all[i];
        for (float reach : reaches)
          if (refine_step(source_probes, m_target.coarse, {reach * m_spacing, 0.7f}, r.pose) < 6) break;
        r.score =
            agreement(m_source, source_probes, m_target, target_probes, m_target.coarse, r.pose, m_coarse_look).score();
      });
      std::stable_sort(all.begin(), all.end(), [](const Refined& a, const Refined& b) { return a.score > b.score; });
    };
    refine(200, {1.5f, 1.5f, 1.f});
    if (all.size() > 4 * number) all.resize(4 * number);
    refine(400, {1.f, 0.5f, 0.5f, 0.5f});
    // Some from around each pose, as not all end in it; not all from around the best one, as it needs rivals.
    constexpr auto most_of_one = 3;
    std::vector<Refined> best;
    for (const Refined& r : all) {
      if (best.size() == number) break;
      const auto count = [&](const auto& is_near) {
        return std::count_if(best.begin(), best.end(), [&](const Refined& k) { return is_near(r.pose, k.pose); });
      };
      if (count([&](const Pose& x, const Pose& y) { return are_close(x, y, m_spacing); }) == 0 &&
          count([&](const Pose& x, const Pose& y) { return are_one(x, y, m_extent); }) < most_of_one)
        best.push_back(r);
    }
    return best;
  }

  const Reduced_scan& m_source;
  const Reduced_scan& m_target;
  const Execution m_execution;
  Run_control& m_control;
  const Probes m_fine_source_probes, m_fine_target_probes;
  float m_spacing = 0, m_extent = 0;
  Look m_coarse_look, m_fine_look;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_POSE_JUDGE_H
