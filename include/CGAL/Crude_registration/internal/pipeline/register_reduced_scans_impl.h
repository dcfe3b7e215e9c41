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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_PIPELINE_REGISTER_REDUCED_SCANS_IMPL_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_PIPELINE_REGISTER_REDUCED_SCANS_IMPL_H

// The steps of register_reduced_scans.h.

#include <CGAL/Crude_registration/Judgement_limits.h>
#include <CGAL/Crude_registration/internal/base/Counter_random.h>
#include <CGAL/Crude_registration/internal/judgement/Pose_judge.h>
#include <CGAL/Crude_registration/internal/judgement/agreement.h>
#include <CGAL/Crude_registration/internal/judgement/conclude.h>
#include <CGAL/Crude_registration/internal/judgement/free_motions.h>
#include <CGAL/Crude_registration/internal/motion/Nearest_surfel.h>
#include <CGAL/Crude_registration/internal/motion/point_to_plane.h>
#include <CGAL/Crude_registration/internal/pipeline/register_reduced_scans.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The square of the distance to the nearest surfel of a level; `nearest` is its index, or none. The field tells what is
// nearest to the middle of a voxel: those around know what is nearest to the place.
inline float nearest_surfel(const Surfel_level& level, const Vector_f& place, int& nearest)
{
  float least = (std::numeric_limits<float>::max)();
  nearest = Surfel_field::none;
  for (int k = 0; k < 27; ++k) {
    const int x = k % 3 - 1, y = k / 3 % 3 - 1, z = k / 9 - 1;
    const Vector_f step = Eigen::Vector3i(x, y, z).cast<float>();
    const int i = level.field.nearest(place + level.spacing * step);
    if (i < 0) continue;
    const float square = (place - level.surfels[std::size_t(i)].position).squaredNorm();
    if (square >= least) continue;
    least = square;
    nearest = i;
  }
  return least;
}

// The share of a scan's surface that has the other one close by, facing the same way. `pose`: target from source. Close
// by is within half the diagonal of a surfel's cell: the field alone reaches beyond the border of the surface by twice
// that.
inline double overlap(const Reduced_scan& source, const Reduced_scan& target, const Pose& pose)
{
  constexpr std::size_t most = 3000;
  constexpr float minimal_cosine = 0.7f, half_diagonal = 0.8660254f; // sqrt(3) / 2
  const std::size_t n = (std::min)(most, source.fine.surfels.size());
  const float reach = half_diagonal * (std::max)(source.fine.spacing, target.fine.spacing);
  const std::vector<std::int32_t> order = shuffled(source.fine.surfels.size(), 3);
  std::size_t close = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Surfel& s = source.fine.surfels[std::size_t(order[i])];
    int j;
    if (nearest_surfel(target.fine, pose(s.position), j) > reach * reach) continue;
    close += (pose.rotation * s.normal).dot(target.fine.surfels[std::size_t(j)].normal) >= minimal_cosine;
  }
  return n > 0 ? double(close) / double(n) : 0;
}

// Rounds of proposals, judged, until `are_enough` says of the judge that they are, there are no more, or the run is
// stopped.
template <class Predicate>
void propose_and_judge(Candidate_source& candidates, Pose_judge& judge, Stage_record& stage, Run_control& control,
                       const Predicate& are_enough)
{
  for (;;) {
    control.advance(candidates.progress());
    std::optional<Proposals> proposals = candidates.next(control);
    if (control.is_stopped()) return;
    if (!proposals) {
      judge.end_rounds();
      return;
    }
    const Stage_timer timer(stage);
    judge.add_round(std::move(*proposals));
    if (control.is_stopped()) return;
    stage.count = judge.number_of_judged();
    if (are_enough()) return;
  }
}

// The best pose, refined on the planes of the fine surfels.
inline Refinement refined(const Reduced_scan& source, const Reduced_scan& target, const Rigid_motion& motion,
                          Execution execution)
{
  std::vector<Vector> points, normals;
  for (const std::int32_t i : source.fine.probes) {
    const Surfel& s = source.fine.surfels[std::size_t(i)];
    points.push_back(s.position.cast<double>());
    normals.push_back(s.normal.cast<double>());
  }
  const Nearest_surfel surface{target.fine.surfels, target.fine.field, double(target.fine.spacing)};
  Refinement_options options{};
  options.sampling_distance = (std::max)(source.spacing, target.spacing);
  options.reach = Judgement_limits::residual_reach * options.sampling_distance;
  options.tolerance = 1e-2; // of a sampling distance: far below the noise
  return Point_to_plane<Nearest_surfel>(points, normals, surface, options, execution)(motion);
}

// What the refined motion says, in the frames of the input, and what is to be believed of it.
inline void conclude(const Reduced_scan& source, const Reduced_scan& target, const Pose_judge& judge, Judged_by by,
                     const Refinement& refinement, bool is_interrupted, Registration_outcome& outcome)
{
  const Rigid_motion& own = refinement.motion;
  outcome.motion = outcome.to_input(own);
  outcome.crude = outcome.to_input(to_rigid_motion(outcome.poses.front().proposed));
  for (const auto& [s, t] : outcome.poses.front().correspondence) {
    outcome.correspondence.emplace_back(outcome.source_frame.inverse()(s), outcome.target_frame.inverse()(t));
    if (outcome.is_swapped) std::swap(outcome.correspondence.back().first, outcome.correspondence.back().second);
  }
  outcome.residual = refinement.residual / (std::max)(source.spacing, target.spacing);
  outcome.agreement = judge.assess(to_pose(own));
  outcome.overlap =
      outcome.is_swapped ? overlap(target, source, to_pose(own.inverse())) : overlap(source, target, to_pose(own));
  const Matrix_6 target_to_input = adjoint(outcome.target_frame.inverse());
  // The deviation follows the motion; seen from the other side it goes through the inverse.
  const Matrix_6 to_input = outcome.is_swapped ? Matrix_6(adjoint(outcome.motion) * target_to_input) : target_to_input;
  const Matrix_6 covariance = to_input * refinement.covariance * to_input.transpose();
  outcome.covariance = 0.5 * (covariance + covariance.transpose()); // to the last bit

  const double radius = 0.25 * source.extent;
  std::vector<Vector_6> free;
  // What is not to be believed at all has no free motions.
  if (probability_of_any(outcome.poses) >= least_plausible(by))
    free = find_free_motions(judge, by, own, refinement.covariance, own.translation, radius,
                             double(source.coarse.spacing));
  for (Vector_6& m : free) m = to_input * m;
  const Vector centre = outcome.target_frame.inverse()(own.translation);
  const Free_motions named = name_free_motions(free, outcome.is_swapped ? outcome.motion(centre) : centre, radius);
  if (is_interrupted) outcome.interrupt();
  else outcome.verdict = judge_poses(outcome.poses, by, named);
}

// What is the same whatever is judged: `poses(judge, by)` gives the poses, the one that is concluded of first;
// `are_enough(judge)` ends the search.
template <class Poses, class Predicate>
Registration_outcome registration_of(const Reduced_scan& a, const Reduced_scan& b,
                                     const Candidate_factory& make_candidates, Execution execution,
                                     Run_control& control, const Poses& poses, const Predicate& are_enough)
{
  Registration_outcome outcome;
  outcome.source_has_free_space = a.depths.is_known();
  outcome.target_has_free_space = b.depths.is_known();
  outcome.is_swapped = are_swapped(a, b);
  const Reduced_scan &source = outcome.is_swapped ? b : a, &target = outcome.is_swapped ? a : b;
  outcome.source_frame = source.own_from_input;
  outcome.target_frame = target.own_from_input;
  outcome.stages = {{"reduce", a.number_of_samples + b.number_of_samples, a.seconds + b.seconds}};
  constexpr std::size_t fewest_surfels = 4;
  if (source.coarse.surfels.size() < fewest_surfels) {
    outcome.verdict.reason = std::string("too few vertices: the surface of the ") +
                             (outcome.is_swapped ? "target" : "source") + " is too small for its samples";
    return outcome;
  }
  Stage_record judging{"judge"}, refining{"refine"}, concluding{"conclude"};
  const std::unique_ptr<Candidate_source> candidates = make_candidates(source, target);
  Pose_judge judge(source, target, execution, control);
  propose_and_judge(*candidates, judge, judging, control, [&] { return are_enough(judge); });
  outcome.poses = poses(judge, Judged_by::PAIR);
  if (outcome.poses.empty()) {
    if (control.is_stopped()) outcome.interrupt();
    else outcome.verdict.reason = "no overlap found: no motion brings any part of the scans together";
  } else {
    Judged_by by = Judged_by::PAIR;
    const auto judge_again = [&](Judged_by other) {
      std::vector<Judged_pose> again = poses(judge, other);
      if (probability_of_any(again) < least_plausible(other)) return;
      outcome.poses = std::move(again);
      by = other;
    };
    if (!control.is_stopped() && judge.has_body() && outcome.poses.front().probability < believed) {
      judge_again(Judged_by::BODY);
      outcome.is_off_body = by != Judged_by::BODY;
    }
    if (!control.is_stopped() && probability_of_any(outcome.poses) < plausible) judge_again(Judged_by::USUAL);
    Refinement refinement;
    {
      const Stage_timer timer(refining);
      refinement = refined(source, target, to_rigid_motion(outcome.poses.front().pose), execution);
      refining.count = refinement.iterations;
    }
    const Stage_timer timer(concluding);
    conclude(source, target, judge, by, refinement, control.is_stopped(), outcome);
    concluding.count = outcome.poses.size();
  }
  for (const Stage_record& s : candidates->stages()) outcome.stages.push_back(s);
  outcome.stages.insert(outcome.stages.end(), {judging, refining, concluding});
  return outcome;
}

CGAL_CRUDE_REGISTRATION_INLINE Registration_outcome register_reduced_scans(const Reduced_scan& a, const Reduced_scan& b,
                                                                           const Candidate_factory& make_candidates,
                                                                           Execution execution, Run_control& control)
{
  return registration_of(
      a, b, make_candidates, execution, control,
      [](const Pose_judge& judge, Judged_by by) { return judge.distinct_poses(by); },
      [](const Pose_judge& judge) { return is_certain(judge.distinct_poses()); });
}

CGAL_CRUDE_REGISTRATION_INLINE Judgement_outcome judge_reduced_motion(const Reduced_scan& a, const Reduced_scan& b,
                                                                      const Rigid_motion& motion,
                                                                      const Candidate_factory& make_candidates,
                                                                      Execution execution, Run_control& control)
{
  const bool is_swapped = are_swapped(a, b);
  const Reduced_scan &source = is_swapped ? b : a, &target = is_swapped ? a : b;
  const Rigid_motion own =
      target.own_from_input * (is_swapped ? motion.inverse() : motion) * source.own_from_input.inverse();
  // The given one takes the place of what the search found of it.
  const auto poses = [&](const Pose_judge& judge, Judged_by by) {
    std::vector<Judged_pose> others = judge.distinct_poses(by);
    if (others.empty()) return others; // nothing is known of chance
    Judged_pose given = judge.weighed(judge.refined(to_pose(own)), by);
    given.proposed = to_pose(own);
    std::vector<Judged_pose> all = {given};
    for (const Judged_pose& p : others)
      if (!judge.are_same(p.pose, given.pose)) all.push_back(p);
    judge.share_probability(all, by);
    return all;
  };
  Judgement_outcome outcome;
  static_cast<Registration_outcome&>(outcome) =
      registration_of(a, b, make_candidates, execution, control, poses, [&](const Pose_judge& judge) {
        const std::vector<Judged_pose> all = poses(judge, Judged_by::PAIR);
        return is_certain(all) || (!all.empty() && all.front().by_law <= 1 - certain);
      });
  if (outcome.poses.empty()) return outcome;
  Verdict& verdict = outcome.verdict;
  double rival = 0;
  for (std::size_t i = 1; i < outcome.poses.size(); ++i) rival = (std::max)(rival, outcome.poses[i].probability);
  const double probability = outcome.poses.front().probability;
  if (verdict.status != NOT_REGISTERED && probability < 0.5 * rival) {
    verdict = Verdict();
    verdict.confidence = probability;
    verdict.reason = "another motion is far more probable";
  }
  const Rigid_motion refined = target.own_from_input * (is_swapped ? outcome.motion.inverse() : outcome.motion) *
                               source.own_from_input.inverse();
  double squared = 0;
  std::size_t n = 0;
  for (const std::int32_t i : source.fine.probes) {
    const Vector p = source.fine.surfels[std::size_t(i)].position.cast<double>(), q = refined(p);
    if (target.fine.field.nearest(q.cast<float>()) < 0) continue; // not where they overlap
    squared += (own(p) - q).squaredNorm();
    ++n;
  }
  if (n > 0) outcome.displacement = std::sqrt(squared / double(n)) / (std::max)(source.spacing, target.spacing);
  return outcome;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_PIPELINE_REGISTER_REDUCED_SCANS_IMPL_H
