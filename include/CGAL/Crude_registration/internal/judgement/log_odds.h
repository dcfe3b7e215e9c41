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

// The logarithm of the odds that a pose is right, against none being right: evidence, that grows with the area that
// agrees as the square of how many standard deviations it is from chance, and the share that goes missing, which says
// more than its probes, as what is missing is missing together.
inline double log_odds(double nats, double missing, const Evidence_coefficients& c = {})
{
  return c.slope * std::sqrt((std::max)(nats, 0.)) + c.missing * missing + c.offset;
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
