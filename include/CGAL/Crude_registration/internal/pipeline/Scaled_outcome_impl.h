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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_PIPELINE_SCALED_OUTCOME_IMPL_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_PIPELINE_SCALED_OUTCOME_IMPL_H

// The scales that are tried, and what is believed of what they say, of Scaled_outcome.h.

#include <CGAL/Crude_registration/internal/judgement/log_odds.h>
#include <CGAL/Crude_registration/internal/motion/Nearest_surfel.h>
#include <CGAL/Crude_registration/internal/pipeline/Scaled_outcome.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

CGAL_CRUDE_REGISTRATION_INLINE double radius_of(const Reduced_scan& scan)
{
  Vector mean = Vector::Zero();
  for (const Surfel& s : scan.fine.surfels) mean += s.position.cast<double>() / double(scan.fine.surfels.size());
  double squares = 0;
  for (const Surfel& s : scan.fine.surfels) squares += (s.position.cast<double>() - mean).squaredNorm();
  return std::sqrt(squares / double((std::max)(scan.fine.surfels.size(), std::size_t(1))));
}

CGAL_CRUDE_REGISTRATION_INLINE std::vector<double> scales_to_try(double ratio)
{
  // At a scale that is off by 3.5 %, half of this step, 35 of 36 motions are found, at 5 % 32, at 7 % 28
  // (calibration/scale_limits.cpp): there is hardly a gap. The sizes of two views of one body that
  // overlap by 60 % differ by up to 15 %, and more the less they overlap.
  constexpr double step = 1.07;
  constexpr int most_steps = 4;
  constexpr std::array<double, 5> units = {0.001, 0.01, 0.0254, 0.3048, 1}; // in metres
  const double log_step = std::log(step), reach = (most_steps + 0.5) * log_step;
  const auto distance = [&](double scale) { return std::abs(std::log(scale / ratio)); };
  std::vector<double> scales;
  for (const double a : units)
    for (const double b : units)
      if (distance(a / b) < reach) scales.push_back(a / b);
  std::sort(scales.begin(), scales.end());
  scales.erase(std::unique(scales.begin(), scales.end(), [](double a, double b) { return b < a * (1 + 1e-9); }),
               scales.end());
  std::stable_sort(scales.begin(), scales.end(), [&](double a, double b) { return distance(a) < distance(b); });
  const std::size_t of_units = scales.size();
  for (int i = 0; i <= 2 * most_steps; ++i) {
    const double scale = ratio * std::pow(step, (i % 2 == 0 ? 1 : -1) * ((i + 1) / 2));
    const auto is_near = [&](double unit) { return std::abs(std::log(scale / unit)) < log_step / 4; };
    if (std::none_of(scales.begin(), scales.begin() + std::ptrdiff_t(of_units), is_near)) scales.push_back(scale);
  }
  return scales;
}

CGAL_CRUDE_REGISTRATION_INLINE Agreement_at_other_scales::Agreement_at_other_scales(Similarity_refiner& refiner,
                                                                                    const Rigid_motion& initial,
                                                                                    const Similarity_refinement& best)
{
  constexpr double displacement = 2, rounding = 0.02; // in sampling distances
  const double s = best.sampling_distance, change = displacement * s / best.radius;
  for (const double scale : {best.scale * (1 + change), best.scale / (1 + change)}) {
    const Similarity_refinement other = refiner.at_scale(initial, scale);
    matches = (std::min)(matches, double(other.matches) / double(best.matches));
    growth = (std::max)(growth, (other.median - rounding * s) / (best.median + smallest * s));
  }
}

CGAL_CRUDE_REGISTRATION_INLINE Similarity_refinement
refined_similarity(const std::vector<const Reduced_scan*>& sides_of_source,
                   const std::vector<const Reduced_scan*>& sides_of_target, const Rigid_motion& motion)
{
  Similarity_refinement best;
  for (const Reduced_scan* a : sides_of_source)
    for (const Reduced_scan* b : sides_of_target) {
      const Nearest_surfel surface{b->fine.surfels, b->fine.field, double(b->fine.spacing)};
      const double sampling_distance = (std::max)(a->spacing, b->spacing);
      Similarity_refiner refiner(a->fine.surfels, a->fine.probes, surface, sampling_distance);
      const Rigid_motion initial = b->own_from_input * motion * a->own_from_input.inverse();
      Similarity_refinement refined = refiner(initial);
      if (refined.matches <= best.matches) continue;
      refined.is_scale_free = Agreement_at_other_scales(refiner, initial, refined).is_as_good();
      best = refined;
    }
  return best;
}

CGAL_CRUDE_REGISTRATION_INLINE Verdict verdict_of(const std::vector<Scaled_outcome>& outcomes,
                                                  const Scaled_outcome& best, std::size_t number)
{
  // Nearer scales are one. By calibration/scale_limits.cpp those that were found from different scales
  // of one pair are within .001 of each other in 95 % of 155 cases, and the largest distance is that of a step of the
  // grid, .034: the limit lies between.
  constexpr double one = 0.02;
  const auto odds = [](double p) {
    constexpr double largest = 1 - 1e-12;
    return (std::min)(p, largest) / (1 - (std::min)(p, largest));
  };
  double others = 0;
  for (const Scaled_outcome& other : outcomes)
    if (std::abs(std::log(other.scale / best.scale)) > one) others += odds(other.verdict.confidence);
  const auto weighed = [&](double p) { return odds(p) / (double(number) + others + odds(p)); };
  Verdict verdict = best.verdict;
  verdict.confidence = weighed(verdict.confidence);
  if (verdict.status == NOT_REGISTERED) return verdict;
  const Similarity_refinement& r = best.refinement;
  if (weighed(probability_of_any(best.poses)) < plausible) {
    verdict.status = NOT_REGISTERED;
    verdict.free_motions.clear();
    verdict.reason = "no overlap found at any scale that cannot be by chance";
  } else if (r.is_scale_free || r.deviation * r.radius > r.sampling_distance) {
    verdict.status = AMBIGUOUS;
    verdict.confidence = (std::min)(verdict.confidence, 0.5);
    verdict.free_motions.push_back("a change of scale");
    verdict.reason = "the overlap leaves the scale free";
  } else if (verdict.status == REGISTERED && verdict.confidence < believed) {
    verdict.status = AMBIGUOUS;
    verdict.reason = others > double(number) ? "several distinct scales bring the scans together equally well"
                                             : "the best motion and scale may be by chance";
  }
  return verdict;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_PIPELINE_SCALED_OUTCOME_IMPL_H
