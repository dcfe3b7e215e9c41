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

// The logarithm of the odds that a pose is right, against none being right. What the probes say grows with the area
// that agrees, and so does its variance: the root tells how far it is from chance. Probes side by side say the same, so
// that it matters little how many there are, unless they are few. The residual tells wrong poses, which fill the
// tolerance evenly, and what is in free space is there together, and says more than its probes. `nats`: of the
// evidence, as chance is between the two scans or as it is between any.
inline double log_odds(const Pose_evidence& evidence, double nats, const Evidence_coefficients& c = {})
{
  const double effective = evidence.surfels / (evidence.surfels + c.surfels);
  return c.slope * std::sqrt(effective * (std::max)(nats, 0.)) + c.residual * evidence.residual +
         c.violations * std::sqrt(evidence.violations) + c.offset;
}

// The probabilities of distinct poses: P_k = exp(x_k) / (1 + sum_j exp(x_j)), x the log-odds `key`, the one being for
// none of them (conditional logit, McFadden 1974).
inline void share_probability(std::vector<Judged_pose>& poses, double Judged_pose::*key)
{
  double greatest = 0;
  for (const Judged_pose& p : poses) greatest = (std::max)(greatest, p.*key);
  double sum = std::exp(-greatest);
  for (const Judged_pose& p : poses) sum += std::exp(p.*key - greatest);
  for (Judged_pose& p : poses) p.probability = std::exp(p.*key - greatest) / sum;
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
