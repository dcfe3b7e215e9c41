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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_CONCLUDE_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_CONCLUDE_H

// The last step of a registration: what is to be believed of the poses that were found.

#include <CGAL/Crude_registration/internal/judgement/Judged_pose.h>
#include <CGAL/Crude_registration/internal/judgement/Verdict.h>
#include <CGAL/Crude_registration/internal/judgement/free_motions.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// How the scans fit in the best pose once it is refined.
struct Fit
{
  double surfels = 0;           // fine ones of the smaller scan
  double residual = 0;          // in sampling distances
  double misfit = 0;            // in units of the scans' own noise
  std::size_t weak_motions = 0; // that the correspondences hardly determine, as matches by chance are of smooth pieces
};

// The confidence from which on a motion is worth an answer.
constexpr double plausible = 0.5;

// The share of the best score from which on a distinct pose is as good as the best one.
constexpr double as_good = 0.85;

// How many distinct poses explain the scans as well as the best one, with it.
// \pre There is a pose.
inline std::size_t number_of_equals(const std::vector<Judged_pose>& poses)
{
  return std::size_t(1 + std::count_if(poses.begin() + 1, poses.end(), [&](const Judged_pose& p) {
                       return double(p.score()) >= as_good * double(poses.front().score());
                     }));
}

// The confidence in the best pose if it has no equals: a logistic function of the number of surfels that agree, not
// their share, as two small smooth pieces fit each other by chance; the surfels in free space for each of them; the
// lead over the next distinct pose; and the residuals. Wrong poses fill the reach of the refinement evenly, whatever
// the noise; right ones have misfits to about 2, whatever the overlap. The coefficients are those that separate right
// from wrong answers, in pairs of real and generated scans of a thousand to some hundred thousand samples, with free
// space and without.
inline double confidence_without_equals(const std::vector<Judged_pose>& poses, const Fit& fit)
{
  if (!(poses.front().score() > 0)) return 0;
  const double score = double(poses.front().score());
  const double lag = poses.size() > 1 ? (std::max)(0., double(poses[1].score())) / score : 0;
  const Agreement& best = poses.front().agreement;
  const double in_free_space = double(best.violations) / double(best.overlap);
  const double evidence = 4 * std::log(fit.surfels * score) - 45 * (std::min)(in_free_space, 0.4) - 3.5 * lag -
                          4.2 * (std::min)(fit.misfit, 4.) - 6 * fit.residual - double(fit.weak_motions) - 13;
  return 1 / (1 + std::exp(-evidence));
}

inline Verdict judge_poses(const std::vector<Judged_pose>& poses, const Fit& fit, const Free_motions& free)
{
  Verdict verdict;
  constexpr double believed = 0.9;
  const double confidence = confidence_without_equals(poses, fit);
  const std::size_t equals = number_of_equals(poses);
  verdict.confidence = confidence / double(equals);
  if (confidence < plausible) {
    verdict.reason = "no overlap found that cannot be by chance";
  } else if (!free.motions.empty()) {
    verdict.status = AMBIGUOUS;
    verdict.confidence = (std::min)(verdict.confidence, 0.5); // any other pose along the free motions is as good
    verdict.free_motions = free.motions;
    verdict.reason = free.surface.empty() ? "the overlap leaves motions free" : "the overlap is " + free.surface;
  } else if (verdict.confidence >= believed) {
    verdict.status = REGISTERED;
  } else {
    verdict.status = AMBIGUOUS;
    verdict.reason = equals > 1 ? "several distinct motions bring the scans together equally well"
                                : "the best motion may be by chance";
  }
  return verdict;
}

// What is to be believed of poses whose rivals have not all been looked for.
inline Verdict interrupted(const std::vector<Judged_pose>& poses, const Fit& fit)
{
  Verdict verdict;
  const double confidence = confidence_without_equals(poses, fit);
  const bool is_plausible = confidence >= plausible;
  verdict.confidence = (std::min)(0.5, confidence); // a rival may be as good
  verdict.status = is_plausible ? AMBIGUOUS : NOT_REGISTERED;
  verdict.reason = is_plausible ? "interrupted: the best motion so far" : "interrupted: no overlap found so far";
  return verdict;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_CONCLUDE_H
