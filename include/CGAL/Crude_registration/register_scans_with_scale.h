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
#include <CGAL/Crude_registration/internal/pipeline/Scaled_outcome.h>
#include <CGAL/Crude_registration/internal/reduction/scale_scan.h>
#include <CGAL/Crude_registration/named_parameters.h>
#include <CGAL/Crude_registration/register_scans.h>

#include <CGAL/Aff_transformation_3.h>
#include <CGAL/tags.h>

#include <algorithm>
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

template <class Kernel>
Scan<Kernel> scaled_scan(const Scan<Kernel>& scan, double scale)
{
  std::shared_ptr<const Scan<Kernel>> other_side;
  if (scan.other_side()) other_side = std::make_shared<const Scan<Kernel>>(scaled(scan.other_side()->reduced(), scale));
  return Scan<Kernel>(scaled(scan.reduced(), scale), other_side);
}

template <class Kernel>
std::vector<const Reduced_scan*> reduced_sides(const Scan<Kernel>& scan)
{
  std::vector<const Reduced_scan*> sides = {&scan.reduced()};
  if (scan.other_side()) sides.push_back(&scan.other_side()->reduced());
  return sides;
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
    outcome.refinement = refined_similarity(reduced_sides(in_scale), reduced_sides(target), next.motion);
    if (outcome.refinement.matches == 0 || std::abs(outcome.refinement.scale - 1) < tolerance) break;
    scale *= outcome.refinement.scale;
  }
  return outcome;
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
    if (is_certain(outcomes[best])) break;
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
