// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_CALIBRATION_OTHER_JUDGEMENT_H
#define CGAL_CRUDE_REGISTRATION_CALIBRATION_OTHER_JUDGEMENT_H

// The answer of a registration by the same candidates, judged otherwise.

#include <CGAL/Crude_registration/internal/judgement/Pose_judge.h>
#include <CGAL/Crude_registration/internal/matching/Candidate_source.h>
#include <CGAL/Crude_registration/internal/pipeline/register_reduced_scans.h>
#include <CGAL/Crude_registration/Registration_status.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <optional>
#include <vector>

namespace benchmark_tools {

namespace CRI = CGAL::Crude_registration::internal;

enum class Judgement
{
  DEFAULT,   // that of register_scans()
  EVIDENCE,  // the same evidence and the same limits, but the surface is not asked whether it leaves motions free
  UNREFINED, // the same of the proposed motions as they are; the answer is refined
  AREA       // after refinement, the largest share of the source that agrees: always an answer
};

struct Other_answer
{
  CGAL::Crude_registration::Registration_status status = CGAL::Crude_registration::NOT_REGISTERED;
  CRI::Rigid_motion crude, motion; // target from source, in the frames of the input
};

// The distinct ones of weighed poses, most probable first, as Pose_judge::distinct_poses() has them.
inline std::vector<CRI::Judged_pose> distinct(const CRI::Pose_judge& judge, std::vector<CRI::Judged_pose> poses)
{
  std::stable_sort(poses.begin(), poses.end(),
                   [](const auto& a, const auto& b) { return a.log_weight > b.log_weight; });
  std::vector<CRI::Judged_pose> result;
  for (const CRI::Judged_pose& p : poses)
    if (std::none_of(result.begin(), result.end(), [&](const auto& d) { return judge.are_same(p.pose, d.pose); }))
      result.push_back(p);
  judge.share_probability(result, CRI::Judged_by::PAIR);
  return result;
}

// `a`, `b`: source and target.
template <class Generator>
Other_answer register_otherwise(const CRI::Reduced_scan& a, const CRI::Reduced_scan& b, const Generator& generator,
                                Judgement judgement)
{
  constexpr auto execution = CRI::Execution::SEQUENTIAL;
  const bool is_swapped = CRI::are_swapped(a, b);
  const CRI::Reduced_scan &source = is_swapped ? b : a, &target = is_swapped ? a : b;
  const std::unique_ptr<CRI::Candidate_source> candidates = generator.candidates(source, target, execution);
  CRI::Pose_judge judge(source, target, execution, CRI::to_the_end());
  std::vector<CRI::Pose> unrefined;
  std::vector<CRI::Judged_pose> poses;
  float most = -1; // of the shares
  while (const std::optional<CRI::Proposals> round = candidates->next(CRI::to_the_end())) {
    const CRI::Proposals& proposals = *round;
    if (judgement == Judgement::EVIDENCE) {
      judge.add_round(proposals);
      poses = judge.distinct_poses();
    } else {
      std::vector<CRI::Pose> tried = proposals.tried;
      std::vector<CRI::Estimated_pose> best;
      if (proposals.are_estimated)
        for (std::size_t i = 0; i < (std::min)(proposals.poses.size(), proposals.judged); ++i)
          best.push_back({proposals.poses[i], 0, i});
      else
        best = CRI::estimated_again(source, target, proposals.poses, proposals.judged, execution, CRI::to_the_end(),
                                    tried);
      if (judgement == Judgement::AREA) {
        for (const CRI::Estimated_pose& e : best) {
          CRI::Judged_pose pose;
          pose.pose = judge.refined(e.pose);
          pose.proposed = proposals.poses[e.index];
          pose.probability = 1; // it is believed
          const float share = judge.assess(pose.pose).overlap;
          if (share <= most) continue;
          most = share;
          poses = {pose};
        }
      } else {
        judge.add_round(proposals);
        for (const CRI::Estimated_pose& e : best) unrefined.push_back(proposals.poses[e.index]);
        poses.clear();
        for (const CRI::Pose& p : unrefined) {
          poses.push_back(judge.weighed(p));
          poses.back().proposed = p;
        }
        poses = distinct(judge, std::move(poses));
      }
    }
    if (judgement != Judgement::AREA && CRI::is_certain(poses)) break;
  }
  Other_answer answer;
  if (poses.empty()) return answer;
  const auto to_input = [&](const CRI::Pose& pose) {
    const CRI::Rigid_motion motion =
        target.own_from_input.inverse() * CRI::to_rigid_motion(pose) * source.own_from_input;
    return is_swapped ? motion.inverse() : motion;
  };
  answer.crude = to_input(poses.front().proposed);
  answer.motion = to_input(judge.refined(poses.front().pose));
  if (poses.front().probability >= CRI::believed) answer.status = CGAL::Crude_registration::REGISTERED;
  else if (CRI::probability_of_any(poses) >= CRI::plausible) answer.status = CGAL::Crude_registration::AMBIGUOUS;
  return answer;
}

} // namespace benchmark_tools

#endif // CGAL_CRUDE_REGISTRATION_CALIBRATION_OTHER_JUDGEMENT_H
