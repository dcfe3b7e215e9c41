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

#ifndef CGAL_CRUDE_REGISTRATION_REGISTER_SCANS_WITH_SCALE_H
#define CGAL_CRUDE_REGISTRATION_REGISTER_SCANS_WITH_SCALE_H

// Registers two prepared scans whose units of length may differ.

#include <CGAL/Crude_registration/Registration_result.h>
#include <CGAL/Crude_registration/Scan.h>
#include <CGAL/Crude_registration/internal/judgement/log_odds.h>
#include <CGAL/Crude_registration/internal/motion/refine_similarity.h>
#include <CGAL/Crude_registration/internal/reduction/scale_scan.h>
#include <CGAL/Crude_registration/named_parameters.h>
#include <CGAL/Crude_registration/register_scans.h>

#include <CGAL/Aff_transformation_3.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {

/*!
\ingroup PkgCrudeRegistrationRef

\brief what `register_scans_with_scale()` found: a factor, and the registration of the source whose coordinates are
multiplied by it.

\tparam Kernel_ the kernel of the transformations
*/
template <class Kernel_ = Exact_predicates_inexact_constructions_kernel>
struct Scaled_registration
{
  /// The kernel.
  typedef Kernel_ Kernel;

  /// the factor by which the coordinates of the source are multiplied, an estimate; 1 if the scans are not registered.
  double scale = 1;

  /// the standard deviation of `scale` by the scatter of the samples, as a share of it.
  double scale_deviation = 0;

  /// the answer for the source multiplied by `scale`: its transformations are rigid. Its confidence holds for the
  /// motion and the scale together.
  Registration_result<Kernel> registration;

  /// the similarity that maps the source, in its own unit, into the frame of the target.
  Aff_transformation_3<Kernel> similarity() const
  {
    return registration.transformation() * Aff_transformation_3<Kernel>(SCALING, typename Kernel::RT(scale));
  }
};

namespace internal {

// How far the surface is from its centre, as a root mean square: surfels are spread evenly over it, whatever its
// samples are.
inline double radius_of(const Reduced_scan& scan)
{
  Vector mean = Vector::Zero();
  for (const Surfel& s : scan.fine.surfels) mean += s.position.cast<double>() / double(scan.fine.surfels.size());
  double squares = 0;
  for (const Surfel& s : scan.fine.surfels) squares += (s.position.cast<double>() - mean).squaredNorm();
  return std::sqrt(squares / double((std::max)(scan.fine.surfels.size(), std::size_t(1))));
}

// The factors that are tried, in turn: the ratios of units of length, 1 among them, that make the sizes agree about,
// the nearest first; then those of a grid about the ratio of the sizes, from its middle on.
inline std::vector<double> scales_to_try(double ratio)
{
  // At a scale that is off by 3.5 %, half of this step, 35 of 36 motions are found, at 5 % 32, at 7 % 28
  // (benchmark/Crude_registration/scale_limits.cpp): there is hardly a gap. The sizes of two views of one body that
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

template <class Kernel>
Scan<Kernel> scaled_scan(const Scan<Kernel>& scan, double scale)
{
  std::shared_ptr<const Scan<Kernel>> other_side;
  if (scan.other_side()) other_side = std::make_shared<const Scan<Kernel>>(scaled(scan.other_side()->reduced(), scale));
  return Scan<Kernel>(scaled(scan.reduced(), scale), other_side);
}

// What the registration at one scale says, and what is made of its motion when the scale may move, too.
struct Scaled_outcome : Registration_outcome
{
  double scale = 1;
  Similarity_refinement refinement;
};

// How well the surfaces still agree when the source is larger, and when it is smaller, by so much that matches are
// moved by two sampling distances, the worse one of the two: as planes do. (Edges and borders, of which there are few,
// count for little then.)
struct Agreement_at_other_scales
{
  double matches = 1; // over those at the best scale
  double growth = 0;  // of the median of the distances

  Agreement_at_other_scales() = default;
  Agreement_at_other_scales(Similarity_refiner& refiner, const Rigid_motion& initial, const Similarity_refinement& best)
  {
    constexpr double displacement = 2, rounding = 0.02; // in sampling distances
    const double s = best.sampling_distance, change = displacement * s / best.radius;
    for (const double scale : {best.scale * (1 + change), best.scale / (1 + change)}) {
      const Similarity_refinement other = refiner.at_scale(initial, scale);
      matches = (std::min)(matches, double(other.matches) / double(best.matches));
      growth = (std::max)(growth, (other.median - rounding * s) / (best.median + smallest * s));
    }
  }

  bool is_as_good() const
  {
    // By benchmark/Crude_registration/scale_limits.cpp: none of 38 pairs whose scale is determined agrees so well
    // elsewhere (three do where the median may grow by a quarter), and 47 of 48 corners, whose scale is free, do.
    constexpr double fewest_matches = 0.9, largest_growth = 1.1;
    return matches >= fewest_matches && growth <= largest_growth;
  }

private:
  static constexpr double smallest = 1e-9;
};

// `motion`: of the source at its scale, in the frames of the inputs. Of the sides that a scan may have, the ones that
// match are taken.
template <class Kernel>
Similarity_refinement refined_similarity(const Scan<Kernel>& source, const Scan<Kernel>& target,
                                         const Rigid_motion& motion)
{
  Similarity_refinement best;
  for (const Scan<Kernel>* s : {&source, source.other_side()})
    for (const Scan<Kernel>* t : {&target, target.other_side()}) {
      if (!s || !t) continue;
      const Reduced_scan &a = s->reduced(), &b = t->reduced();
      const Nearest_surfel surface{b.fine.surfels, b.fine.field, double(b.fine.spacing)};
      const double sampling_distance = (std::max)(a.spacing, b.spacing);
      Similarity_refiner refiner(a.fine.surfels, a.fine.probes, surface, sampling_distance);
      const Rigid_motion initial = b.own_from_input * motion * a.own_from_input.inverse();
      Similarity_refinement refined = refiner(initial);
      if (refined.matches <= best.matches) continue;
      refined.is_scale_free = Agreement_at_other_scales(refiner, initial, refined).is_as_good();
      best = refined;
    }
  return best;
}

// Registers the source at a scale, and at what becomes of that when the motion is refined with the scale, until that
// stays.
template <class ConcurrencyTag, class Kernel, class Generator>
Scaled_outcome registered_at(double scale, const Scan<Kernel>& source, const Scan<Kernel>& target,
                             const Generator& generator, Run_control& control)
{
  constexpr int most_rounds = 4;
  constexpr double tolerance = 1e-3; // of the scale
  Scaled_outcome outcome;
  for (int round = 0; round < most_rounds; ++round) {
    const Scan<Kernel> in_scale = scaled_scan(source, scale);
    Scaled_outcome next;
    static_cast<Registration_outcome&>(next) =
        best_of_sides(in_scale, target, control, [&](const Scan<Kernel>& a, const Scan<Kernel>& b) {
          return register_reduced_scans(a.reduced(), b.reduced(), candidate_factory<ConcurrencyTag>(generator, a, b),
                                        execution<ConcurrencyTag>(), control);
        });
    next.scale = scale;
    if (round > 0) add_stages(outcome, next);
    // Confidences beyond doubt are equal but for chance.
    const bool is_worse =
        round > 0 && next.verdict.status != REGISTERED && next.verdict.confidence < outcome.verdict.confidence;
    if (!is_worse) outcome = next;
    if (is_worse || next.verdict.status == NOT_REGISTERED || control.is_stopped()) break;
    outcome.refinement = refined_similarity(in_scale, target, next.motion);
    if (outcome.refinement.matches == 0 || std::abs(outcome.refinement.scale - 1) < tolerance) break;
    scale *= outcome.refinement.scale;
  }
  return outcome;
}

// What is believed of the best of several scales, of which as many as `number` were to be tried: beforehand each was as
// probable as another, so that the odds of one are that share of what they are alone; what was found at other scales
// are its rivals.
inline Verdict verdict_of(const std::vector<Scaled_outcome>& outcomes, const Scaled_outcome& best, std::size_t number)
{
  // Nearer scales are one. By benchmark/Crude_registration/scale_limits.cpp those that were found from different scales
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

// The scales one after the other, until an answer is certain; the most probable one counts.
template <class ConcurrencyTag, class Kernel, class Generator>
Scaled_outcome register_scans_with_scale(const Scan<Kernel>& source, const Scan<Kernel>& target,
                                         const Generator& generator, Run_control& control, bool is_watched)
{
  const std::vector<double> scales = scales_to_try(radius_of(target.reduced()) / radius_of(source.reduced()));
  std::vector<Scaled_outcome> outcomes;
  std::size_t best = 0;
  double done = 0; // of a scale there may be several registrations: what is done does not become less
  for (std::size_t i = 0; i < scales.size() && !control.is_stopped(); ++i) {
    const auto go_further = [&](double share) {
      done = (std::max)(done, (double(i) + share) / double(scales.size()));
      control.advance(done);
      return control.go_on();
    };
    Run_control part(is_watched ? std::function<bool(double)>(go_further) : std::function<bool(double)>(),
                     (std::numeric_limits<double>::infinity)());
    outcomes.push_back(registered_at<ConcurrencyTag>(scales[i], source, target, generator, part));
    if (is_better(outcomes.back(), outcomes[best])) best = i;
    const Verdict& verdict = outcomes[best].verdict;
    if (verdict.status == REGISTERED && verdict.confidence >= certain) break;
  }
  Scaled_outcome outcome = outcomes[best];
  outcome.verdict = verdict_of(outcomes, outcome, scales.size());
  for (std::size_t i = 0; i < outcomes.size(); ++i)
    if (i != best) add_stages(outcomes[i], outcome);
  if (control.is_stopped()) outcome.interrupt();
  return outcome;
}

} // namespace internal

/*!
\ingroup PkgCrudeRegistrationRef

\brief registers two prepared scans whose units of length may differ, by a factor that nobody knows: finds the factor
and the rigid motion that together map the source into the frame of the target, and says whether they are to be
believed.

The sizes of the scans, which do not depend on their samples, suggest the factor, but not better than their overlap is
complete. The factors about it are tried in turn, those first that are ratios of units of length (1, 10, 25.4, 1000,
...): `register_scans()` at each, then the factor is refined together with the motion, and the scans are registered at
that once more. What is certain ends the search, else the most probable one of all is the answer. Its confidence takes
into account that so many scales were tried: what is registered by `register_scans()` at a known scale with little to
spare is `AMBIGUOUS` here. Where the overlap does not tell the factor, as that of planes or of a corner does not, the
answer is `AMBIGUOUS`, too.

Where the units are known, scale the coordinates before and call `register_scans()`, which is faster and surer.

\tparam ConcurrencyTag `CGAL::Sequential_tag` (default), `CGAL::Parallel_tag` or `CGAL::Parallel_if_available_tag`; the
        answer is the same, bit by bit, with any number of threads
\tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"

\param source, target the scans
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among those of `register_scans()`, with
       their meaning and their defaults: `candidates`, `minimum_extent`, `maximum_extent`, `time_budget` and `visitor`

\return the factor and the registration; a failure is a status with its reason. Scales are tried that make the sizes of
        the scans agree to within a third: it needs scans that show the same object, or about as much of it.

\throws std::invalid_argument if a parameter is out of its range, or a scan was not made for the generator

\sa `register_scans()`
*/
template <class ConcurrencyTag = CGAL::Sequential_tag, class Kernel,
          class NamedParameters = parameters::Default_named_parameters>
Scaled_registration<Kernel> register_scans_with_scale(const Scan<Kernel>& source, const Scan<Kernel>& target,
                                                      const NamedParameters& np = parameters::default_values())
{
  const char* const name = "register_scans_with_scale";
  const auto generator = internal::candidate_generator(np, name);
  const std::function<bool(double)> visitor = internal::visitor_parameter(np);
  const double seconds = internal::time_budget_parameter(np, name);
  const bool is_watched = bool(visitor) || std::isfinite(seconds);
  internal::Run_control control(visitor, seconds);
  const internal::Scaled_outcome outcome =
      internal::register_scans_with_scale<ConcurrencyTag>(source, target, generator, control, is_watched);
  Scaled_registration<Kernel> result;
  result.registration = internal::to_result<Kernel>(outcome);
  if (result.registration.status() != NOT_REGISTERED) {
    result.scale = outcome.scale;
    result.scale_deviation = outcome.refinement.deviation;
  }
  return result;
}

/// \cond SKIP_IN_MANUAL
// The scan as the preparation of its input, multiplied by a factor, would have made it, but for rounding.
template <class Kernel>
Scan<Kernel> scaled(const Scan<Kernel>& scan, double factor)
{
  return internal::scaled_scan(scan, factor);
}
/// \endcond

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_REGISTER_SCANS_WITH_SCALE_H
