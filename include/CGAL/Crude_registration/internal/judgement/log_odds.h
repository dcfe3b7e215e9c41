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

// From evidence to probabilities.

#include <CGAL/Crude_registration/Judgement_limits.h>
#include <CGAL/Crude_registration/internal/judgement/Judged_pose.h>
#include <CGAL/Crude_registration/internal/judgement/evidence_coefficients.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The root of evidence, `nats` a probe. Evidence grows with the area that agrees, and so does its variance: the root
// tells how far it is from chance. Probes side by side say the same, so that it matters little how many there are,
// unless they are few.
inline double root_of_evidence(const Pose_evidence& evidence, double nats, const Evidence_coefficients& c)
{
  return std::sqrt(evidence.surfels / (evidence.surfels + c.surfels) * (std::max)(nats, 0.));
}

// The residual tells wrong poses, which fill the tolerance evenly; what is in free space is there together, and says
// more than its probes.
inline double law_of_evidence(const Evidence_law& law, double root, const Pose_evidence& evidence)
{
  return law.slope * root + law.residual * evidence.residual + law.violations * std::sqrt(evidence.violations) +
         law.variety * evidence.variety + law.offset;
}

// The logarithm of how probable a pose is beside others, if one of them is right; `nats`: of the evidence.
inline double log_weight(const Pose_evidence& evidence, double nats, const Evidence_coefficients& c = {})
{
  return law_of_evidence(c.share, root_of_evidence(evidence, nats, c), evidence);
}

// Of distinct poses that with the greatest weight.
inline std::vector<Judged_pose>::const_iterator leading(const std::vector<Judged_pose>& poses)
{
  return std::max_element(poses.begin(), poses.end(),
                          [](const Judged_pose& a, const Judged_pose& b) { return a.log_weight < b.log_weight; });
}

// The same, and what tells whether any of them is right, beside its evidence.
struct Leading_pose
{
  const Judged_pose* pose;
  double root;        // of its evidence
  double lead;        // of the root over the mean of those of all others and of one that has none
  double distinction; // log-odds that it is the right one, if one of them is, or one without evidence
};

// The residual of what agrees by chance, which fills the tolerance evenly.
inline double residual_of_chance()
{
  return 1 / std::sqrt(3.);
}

// `is_usual`: as chance is between any two scans.
// \pre There is a pose.
inline Leading_pose leading_pose(const std::vector<Judged_pose>& poses, bool is_usual, const Evidence_coefficients& c)
{
  const auto best = leading(poses);
  const auto root = [&](const Judged_pose& p) {
    return root_of_evidence(p.evidence, is_usual ? p.evidence.usual : p.evidence.fuller, c);
  };
  Pose_evidence none;
  none.residual = residual_of_chance();
  double roots = 0, weights = std::exp(log_weight(none, 0, c) - best->log_weight); // of all others
  for (auto p = poses.begin(); p != poses.end(); ++p) {
    if (p == best) continue;
    roots += root(*p);
    weights += std::exp(p->log_weight - best->log_weight);
  }
  const auto n = double(poses.size());
  const double lapse = c.share.lapse, share = 1 / (1 + weights);
  return {&*best, root(*best), root(*best) - roots / n,
          std::log(((1 - lapse) * share + lapse / (n + 1)) / ((1 - lapse) * (1 - share) + lapse * n / (n + 1)))};
}

// What tells whether the leading pose is right, by chance as the pair tells it. Evidence counts by how far the residual
// is from that of chance. How far others are behind counts by the variety of what agrees: where all lies in few planes,
// one pose leaves the others behind by chance. What agrees far apart agrees by chance less often than what agrees
// in a patch. And what leads when all was tried is right more often than what leads before: the right pose, if there is
// one, is among the candidates more often then.
struct Lead_features
{
  double fit, violations, lead, distinction, spread, tried_all;

  Lead_features(const Leading_pose& leading, bool all_were_tried)
      : fit(leading.root * (std::max)(0., 1 - leading.pose->evidence.residual / residual_of_chance())),
        violations(std::sqrt(leading.pose->evidence.violations)), lead(leading.lead * leading.pose->evidence.variety),
        distinction(leading.distinction * leading.pose->evidence.variety), spread(leading.pose->evidence.spread),
        tried_all(all_were_tried ? 1 : 0)
  {}
};

// The log-odds that any of them is right, by chance as the pair tells it.
inline double log_odds_of_any(const Lead_law& law, const Lead_features& f)
{
  return law.fit * f.fit + law.violations * f.violations + law.lead * f.lead + law.distinction * f.distinction +
         law.spread * f.spread + law.tried_all * f.tried_all + law.offset;
}

// Two questions, each with a law of its own: is one of the distinct poses right, and if so, which one? (A nested logit,
// McFadden 1978.) With x the log-odds of the first, w_k the weights of the second, and l and m the shares of answers
// that obey no such law,
//   P(any) = (1 - l) / (1 + exp(-x)) + l / 2,  P_k = P(any) ((1 - m) w_k / sum_j w_j + m / n).
// x is of the leading pose: all poses were refined until they fit as well as they can, so that its lead tells how much
// comes by chance between these two scans; what is found between scans that have no right pose is seldom one pose that
// leaves all others behind. `is_usual`: as chance is between any two scans, whatever the others are;
// `all_were_tried`: no more poses will come.
// \pre The variety and the spread of the leading pose are known.
inline void share_probability(std::vector<Judged_pose>& poses, bool is_usual, bool all_were_tried,
                              const Evidence_coefficients& c = {})
{
  if (poses.empty()) return;
  const Leading_pose first = leading_pose(poses, is_usual, c);
  const double log_odds = is_usual ? law_of_evidence(c.usual_any, first.root, first.pose->evidence)
                                   : log_odds_of_any(c.any, Lead_features(first, all_were_tried)),
               lapse = is_usual ? c.usual_any.lapse : c.any.lapse, any = 1 / (1 + std::exp(-log_odds)),
               greatest = first.pose->log_weight;
  double sum = 0;
  for (const Judged_pose& p : poses) sum += std::exp(p.log_weight - greatest);
  for (Judged_pose& p : poses) {
    const double share = std::exp(p.log_weight - greatest) / sum;
    p.log_odds = log_odds + p.log_weight - greatest - std::log(sum);
    p.by_law = any * share;
    p.probability =
        ((1 - lapse) * any + lapse / 2) * ((1 - c.share.lapse) * share + c.share.lapse / double(poses.size()));
  }
}

// Whether no more has to be looked for: what obeys no law is not made more certain by that.
inline bool is_certain(const std::vector<Judged_pose>& distinct)
{
  return !distinct.empty() && distinct.front().by_law >= Judgement_limits::certain;
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
