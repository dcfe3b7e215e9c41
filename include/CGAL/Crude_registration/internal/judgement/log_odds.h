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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_LOG_ODDS_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_LOG_ODDS_H

// From evidence to probability.

#include <CGAL/Crude_registration/internal/judgement/Judged_pose.h>
#include <CGAL/Crude_registration/internal/judgement/evidence_coefficients.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The logarithm of the odds that a pose is right, against none being right, as chance is between any two scans, but for
// the slope of what the probes say. What they say grows with the area that agrees, and so does its variance: the root
// tells how far it is from chance. Probes side by side say the same, so that it matters little how many there are,
// unless they are few. The residual tells wrong poses, which fill the tolerance evenly, and what is in free space is
// there together, and says more than its probes. `nats`: of the evidence.
inline double usual_log_odds(const Pose_evidence& evidence, double nats, const Evidence_coefficients& c = {})
{
  const double effective = evidence.surfels / (evidence.surfels + c.surfels);
  return c.slope * std::sqrt(effective * (std::max)(nats, 0.)) + c.residual * evidence.residual +
         c.violations * std::sqrt(evidence.violations) + c.offset;
}

// The same as chance is between the two scans: the evidence is weighed by it, and by how far the pose leads the best
// candidate elsewhere. Where the scans fit each other in part in many ways, chance explains a right pose away, but no
// other one comes near it.
inline double log_odds(const Pose_evidence& evidence, const Evidence_coefficients& c = {})
{
  const double lead = std::sqrt((std::max)(evidence.usual, 0.)) - std::sqrt(evidence.rival);
  return usual_log_odds(evidence, evidence.nats, c) + c.lead * lead;
}

// The probabilities of n distinct poses: P_k = (1 - l) exp(x_k) / (1 + sum_j exp(x_j)) + l / (n + 1), x the log-odds,
// the one being for none of them (conditional logit, McFadden 1974), l the share of answers that obey no such law.
inline void share_probability(std::vector<Judged_pose>& poses, const Evidence_coefficients& c = {})
{
  double greatest = 0;
  for (const Judged_pose& p : poses) greatest = (std::max)(greatest, p.log_odds);
  double sum = std::exp(-greatest);
  for (const Judged_pose& p : poses) sum += std::exp(p.log_odds - greatest);
  for (Judged_pose& p : poses)
    p.probability = (1 - c.lapse) * std::exp(p.log_odds - greatest) / sum + c.lapse / double(poses.size() + 1);
}

// The probability that any of some distinct poses is right.
inline double probability_of_any(const std::vector<Judged_pose>& poses)
{
  double sum = 0;
  for (const Judged_pose& p : poses) sum += p.probability;
  return sum;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_LOG_ODDS_H
