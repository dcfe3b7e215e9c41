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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_PIPELINE_REGISTER_REDUCED_SCANS_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_PIPELINE_REGISTER_REDUCED_SCANS_H

// The steps of a registration of scans that are reduced: propose, judge, refine, conclude.

#include <CGAL/Crude_registration/internal/base/Correspondence.h>
#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/internal/base/Run_control.h>
#include <CGAL/Crude_registration/internal/base/compiled.h>
#include <CGAL/Crude_registration/internal/base/for_each_index.h>
#include <CGAL/Crude_registration/internal/base/near_poses.h>
#include <CGAL/Crude_registration/internal/judgement/Judged_pose.h>
#include <CGAL/Crude_registration/internal/judgement/Verdict.h>
#include <CGAL/Crude_registration/internal/judgement/log_odds.h>
#include <CGAL/Crude_registration/internal/matching/Candidate_source.h>
#include <CGAL/Crude_registration/internal/motion/twist.h>
#include <CGAL/Crude_registration/internal/reduction/Reduced_scan.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

struct Registration_outcome
{
  std::vector<Judged_pose> poses;          // distinct, best first; in own frames, see to_input()
  bool is_swapped = false;                 // the poses map the target to the source
  Rigid_motion source_frame, target_frame; // own from input, of what the poses call source and target
  Rigid_motion crude, motion;              // target from source, in the frames of the input
  Correspondence correspondence;           // that has given `crude`, in the frames of the input, where it is known
  Agreement agreement;                     // of the refined motion
  double overlap = 0, residual = 0;
  bool source_has_free_space = false, target_has_free_space = false;
  bool is_off_body = false; // one scan is the whole surface of a body, and too much of the other one is not on it
  Matrix_6 covariance = Matrix_6::Zero(); // in the frames of the input
  Verdict verdict;
  std::vector<Stage_record> stages;

  // The run was stopped before all rivals were looked for.
  void interrupt() { verdict = interrupted(poses.empty() ? 0 : poses.front().probability); }

  Rigid_motion to_input(const Rigid_motion& own) const
  {
    const Rigid_motion in_input = target_frame.inverse() * own * source_frame;
    return is_swapped ? in_input.inverse() : in_input;
  }
};

// Is the one motion more probable than the other? What brings a view onto a body is, whatever else is found.
inline bool is_better(const Registration_outcome& a, const Registration_outcome& b)
{
  if (a.poses.empty() || b.poses.empty()) return !a.poses.empty() && b.poses.empty();
  if (a.is_off_body != b.is_off_body) return b.is_off_body;
  return a.poses.front().log_odds > b.poses.front().log_odds;
}

// Whether nothing more has to be looked for.
inline bool is_certain(const Registration_outcome& outcome)
{
  return outcome.verdict.status == REGISTERED && is_certain(outcome.poses);
}

// Of two scans whose sides nothing tells, one is turned over and the other one is not: as orient_points() turns both to
// where they bulge, this is needed the less often the more often their sides go together. By the mean of the kinds of
// scenes of calibration/sides_of_views. The share of answers that obey no law is as it is.
inline void turn_over_one_of_two(Registration_outcome& outcome)
{
  if (outcome.poses.empty()) return;
  constexpr double go_together = 0.95, times = (1 - go_together) / go_together; // of the odds
  const double before = outcome.poses.front().probability;
  for (Judged_pose& p : outcome.poses) {
    const double by_law = times * p.by_law / (1 - p.by_law + times * p.by_law);
    p.log_odds += std::log(times);
    p.probability *= p.by_law > 0 ? by_law / p.by_law : times;
    p.by_law = by_law;
  }
  if (before > 0) outcome.verdict.confidence *= outcome.poses.front().probability / before;
  Verdict& verdict = outcome.verdict;
  if (verdict.status != REGISTERED || verdict.confidence >= believed) return;
  verdict.status = AMBIGUOUS;
  verdict.reason = "the best motion may be by chance";
}

// The best motion of another run, with other sides of the same scans, is a rival, unless it is the same. `extent`: of
// the smaller scan. \pre `outcome` is the better one.
inline void add_rival(const Registration_outcome& other, double extent, Registration_outcome& outcome)
{
  if (other.poses.empty() || outcome.poses.empty() || other.is_off_body != outcome.is_off_body) return;
  const Rigid_motion motion = other.to_input(to_rigid_motion(other.poses.front().pose));
  const Rigid_motion own =
      outcome.target_frame * (outcome.is_swapped ? motion.inverse() : motion) * outcome.source_frame.inverse();
  if (are_one(to_pose(own), outcome.poses.front().pose, float(extent))) return;
  // Where p = 1 / (1 + all other odds over those of the motion), one more is in the sum.
  double& confidence = outcome.verdict.confidence;
  if (!(confidence > 0)) return;
  confidence = 1 / (1 / confidence + std::exp(other.poses.front().log_odds - outcome.poses.front().log_odds));
  if (outcome.verdict.status != REGISTERED || confidence >= believed) return;
  outcome.verdict.status = AMBIGUOUS;
  outcome.verdict.reason = "several distinct motions bring the scans together equally well";
}

// Adds what another run, of the same scans, did to the record of the stages. They are reduced once.
inline void add_stages(const Registration_outcome& other, Registration_outcome& outcome)
{
  for (std::size_t i = 1; i < other.stages.size() && i < outcome.stages.size(); ++i) {
    outcome.stages[i].count += other.stages[i].count;
    outcome.stages[i].seconds += other.stages[i].seconds;
  }
}

// The scan with fewer surfels is looked for in the other one; equal ones are told apart by size, so that swapping the
// arguments gives the inverse.
inline bool are_swapped(const Reduced_scan& source, const Reduced_scan& target)
{
  if (source.coarse.surfels.size() != target.coarse.surfels.size())
    return source.coarse.surfels.size() > target.coarse.surfels.size();
  return source.extent > target.extent;
}

// a and b are source and target; the smaller one of them is looked for in the other.
Registration_outcome register_reduced_scans(const Reduced_scan& a, const Reduced_scan& b,
                                            const Candidate_factory& make_candidates, Execution execution,
                                            Run_control& control);

// What is to be said of a motion that somebody found, a to b in the frames of the input: of what refinement makes of
// it, as of an answer of a registration; and how far that is from it, as a root mean square over the source's surface
// where the scans overlap, in sampling distances.
struct Judgement_outcome : Registration_outcome
{
  double displacement = 0;
};

// The candidates show what comes about by chance, and are rivals.
Judgement_outcome judge_reduced_motion(const Reduced_scan& a, const Reduced_scan& b, const Rigid_motion& motion,
                                       const Candidate_factory& make_candidates, Execution execution,
                                       Run_control& control);

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#ifndef CGAL_CRUDE_REGISTRATION_COMPILED
#include <CGAL/Crude_registration/internal/pipeline/register_reduced_scans_impl.h>
#endif

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_PIPELINE_REGISTER_REDUCED_SCANS_H
