// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_REGISTER_SCANS_H
#define CGAL_CRUDE_REGISTRATION_REGISTER_SCANS_H

#include <CGAL/Crude_registration/Registration_result.h>
#include <CGAL/Crude_registration/Scan.h>
#include <CGAL/Crude_registration/internal/pipeline/register_prepared_scans.h>
#include <CGAL/Crude_registration/named_parameters.h>

#include <string>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The search with the lengths of the trihedra's axes within f1 * M .. f2 * M (section 5).
inline Search_parameters parameters_within(double f1, double f2)
{
  Search_parameters parameters;
  for (Search_round& round : parameters.rounds) {
    std::vector<float> scales;
    for (float s : round.scales)
      if (double(s) >= f1 && double(s) <= f2) scales.push_back(s);
    if (scales.empty()) scales.push_back(float(f1 + 0.75 * ((std::min)(f2, 1.) - f1)));
    round.scales = scales;
  }
  return parameters;
}

// What the parameters `minimum_extent` and `maximum_extent` ask for.
template <class NamedParameters>
Search_parameters search_parameters(const NamedParameters& np, const std::string& function)
{
  const double f1 = non_negative_parameter(np, internal_np::minimum_extent, 0, function.c_str(), "minimum_extent");
  const double f2 = non_negative_parameter(np, internal_np::maximum_extent, 1, function.c_str(), "maximum_extent");
  if (!(f1 < f2)) throw std::invalid_argument(function + ": minimum_extent has to be less than maximum_extent");
  return parameters_within(f1, f2);
}

template <class Kernel>
Registration_result<Kernel> to_result(const Registration_outcome& outcome)
{
  typename Registration_result<Kernel>::Parts parts;
  parts.status = outcome.verdict.status;
  parts.reason = outcome.verdict.reason;
  parts.confidence = outcome.verdict.confidence;
  parts.free_motions = outcome.verdict.free_motions;
  if (parts.status != NOT_REGISTERED) {
    parts.transformation = to_aff_transformation<Kernel>(outcome.motion);
    parts.crude_transformation = to_aff_transformation<Kernel>(outcome.crude);
    parts.covariance = outcome.covariance;
  }
  parts.source_has_free_space = outcome.source_has_free_space;
  parts.target_has_free_space = outcome.target_has_free_space;
  parts.overlap = outcome.overlap;
  parts.residual = outcome.residual;
  if (!outcome.poses.empty()) {
    parts.score = double(outcome.poses.front().score());
    parts.free_space_violations = double(outcome.poses.front().violations);
  }
  for (std::size_t i = parts.status == NOT_REGISTERED ? 0 : 1; i < outcome.poses.size(); ++i)
    parts.runners_up.push_back({to_aff_transformation<Kernel>(outcome.to_input(to_rigid_motion(outcome.poses[i].pose))),
                                double(outcome.poses[i].score())});
  parts.statistics = {{"look", outcome.counts.looks, 0},
                      {"match", outcome.counts.hits, 0},
                      {"score", outcome.counts.candidates, 0},
                      {"refine", outcome.counts.refined, 0},
                      {"search", outcome.counts.judged, outcome.search_seconds},
                      {"finish", outcome.refinement.iterations, outcome.refine_seconds}};
  return Registration_result<Kernel>(std::move(parts));
}

} // namespace internal

/*!
\ingroup PkgCrudeRegistrationRef

\brief registers two prepared scans: finds the rigid motion that maps the source into the frame of the target, with no
knowledge of how they lie, and says whether it is to be believed.

\tparam ConcurrencyTag `CGAL::Sequential_tag` (default), `CGAL::Parallel_tag` or `CGAL::Parallel_if_available_tag`; the
        answer is the same, bit by bit, with any number of threads
\param source, target the scans; their sensors, where known, are part of them
\param np optional named parameters: `minimum_extent` and `maximum_extent`, \f$ f_1 \f$ and \f$ f_2 \f$ of the
       paper, as shares of the scan's size \f$ M \f$: the least and greatest length of the axes of trihedra (0 and 1
       if not given); `time_budget`, seconds after which the search ends; `visitor`, an object (or a
       `std::reference_wrapper` of one) with `void progress(double)`, told the share of the work that is done at most,
       and `bool go_further()`, which ends the search by `false`. They are called by the calling thread, about once a
       millisecond.

\return the answer; a failure is a status with its reason. `transformation()` maps the source to the target; source and
         target exchanged give the inverse.

\throws std::invalid_argument if `minimum_extent` or `maximum_extent` is negative or not finite, or the former is not
        less than the latter, or `time_budget` is not a finite number above zero.

A search that is ended by its budget or its visitor returns within some hundredths of a second. Its status is then not
`REGISTERED`: the best motion so far is `AMBIGUOUS`, if it is plausible, as its rivals have not been looked for; the
reason says so. What is thrown by the visitor is passed on.

Otherwise the result depends on nothing but the two scans. Complexity: bounded by the number of looks of the last round
of the search, whatever the size of the scans.
*/
template <class ConcurrencyTag = CGAL::Sequential_tag, class Kernel,
          class NamedParameters = parameters::Default_named_parameters>
Registration_result<Kernel> register_scans(const Scan<Kernel>& source, const Scan<Kernel>& target,
                                           const NamedParameters& np = parameters::default_values())
{
  const internal::Search_parameters parameters = internal::search_parameters(np, "register_scans");
  internal::Run_control control(internal::visitor_parameter(np), internal::time_budget_parameter(np, "register_scans"));
  return internal::to_result<Kernel>(
      internal::register_prepared_scans<ConcurrencyTag>(source.prepared(), target.prepared(), parameters, control));
}

/*!
\ingroup PkgCrudeRegistrationRef

\brief registers two triangle meshes: `register_scans()` of the two as `Scan`s.

\tparam ConcurrencyTag see `register_scans()`
\tparam Source, Target models of `FaceListGraph`, not necessarily the same
\param source, target the meshes, faces counterclockwise seen from outside (from the sensor)
\param np_source named parameters for the source (see `Scan`: `vertex_point_map`, `viewpoint`, `viewing_direction`;
       `geom_traits` sets the kernel of the result) and for the registration (see `register_scans()`)
\param np_target named parameters for the target

A time budget and a visitor are those of the whole run: where they end the preparation of the scans the answer is
`NOT_REGISTERED`, and the reason says so.

\throws std::invalid_argument as `Scan` and `register_scans()` do; the text names the argument.
*/
template <class ConcurrencyTag = CGAL::Sequential_tag, class Source, class Target,
          class Source_parameters = parameters::Default_named_parameters,
          class Target_parameters = parameters::Default_named_parameters>
auto register_meshes(const Source& source, const Target& target,
                     const Source_parameters& np_source = parameters::default_values(),
                     const Target_parameters& np_target = parameters::default_values())
{
  using Point =
      typename boost::property_traits<decltype(internal::const_vertex_point_map(source, np_source))>::value_type;
  using Default_kernel = typename Kernel_traits<Point>::Kernel;
  using Kernel = std::remove_cv_t<
      std::remove_reference_t<decltype(internal::parameter(np_source, internal_np::geom_traits, Default_kernel()))>>;
  const internal::Search_parameters parameters = internal::search_parameters(np_source, "register_meshes");
  internal::Run_control control(internal::visitor_parameter(np_source),
                                internal::time_budget_parameter(np_source, "register_meshes"));
  try {
    const Scan<Kernel> prepared_source(source, np_source, "register_meshes: source", control);
    const Scan<Kernel> prepared_target(target, np_target, "register_meshes: target", control);
    return internal::to_result<Kernel>(internal::register_prepared_scans<ConcurrencyTag>(
        prepared_source.prepared(), prepared_target.prepared(), parameters, control));
  } catch (const internal::Run_control::Stopped&) {
    typename Registration_result<Kernel>::Parts parts;
    parts.reason = Preparation_interrupted("the scans").what();
    return Registration_result<Kernel>(std::move(parts));
  }
}

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_REGISTER_SCANS_H
