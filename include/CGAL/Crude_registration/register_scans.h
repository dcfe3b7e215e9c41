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

#ifndef CGAL_CRUDE_REGISTRATION_REGISTER_SCANS_H
#define CGAL_CRUDE_REGISTRATION_REGISTER_SCANS_H

// Registers two prepared scans.

#include <CGAL/Crude_registration/Registration_result.h>
#include <CGAL/Crude_registration/Scan.h>
#include <CGAL/Crude_registration/internal/base/for_each_index.h>
#include <CGAL/Crude_registration/internal/judgement/Verdict.h>
#include <CGAL/Crude_registration/internal/motion/Refinement.h>
#include <CGAL/Crude_registration/internal/pipeline/User_candidates.h>
#include <CGAL/Crude_registration/internal/pipeline/register_reduced_scans.h>
#include <CGAL/Crude_registration/matching/Oriented_pair_candidates.h>
#include <CGAL/Crude_registration/named_parameters.h>

#include <CGAL/tags.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

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
    for (const auto& [s, t] : outcome.correspondence)
      parts.correspondence.emplace_back(Point_3<Kernel>(s[0], s[1], s[2]), Point_3<Kernel>(t[0], t[1], t[2]));
    parts.covariance = rows_of(outcome.covariance);
  }
  parts.source_has_free_space = outcome.source_has_free_space;
  parts.target_has_free_space = outcome.target_has_free_space;
  parts.overlap = outcome.overlap;
  parts.residual = outcome.residual;
  parts.score = outcome.poses.empty() ? 0 : outcome.poses.front().log_odds;
  parts.free_space_violations = double(outcome.agreement.violations);
  for (std::size_t i = parts.status == NOT_REGISTERED ? 0 : 1; i < outcome.poses.size(); ++i)
    parts.runners_up.push_back({to_aff_transformation<Kernel>(outcome.to_input(to_rigid_motion(outcome.poses[i].pose))),
                                outcome.poses[i].log_odds, outcome.poses[i].probability});
  for (const Stage_record& s : outcome.stages) parts.statistics.push_back({s.name, s.count, s.seconds});
  return Registration_result<Kernel>(std::move(parts));
}

// The generator's own source of candidates, where it has one, or its rounds.
template <class ConcurrencyTag, class Generator, class Kernel>
auto candidates_of(const Generator& generator, const Scan<Kernel>& source, const Scan<Kernel>& target, int)
    -> decltype(generator.candidates(source.reduced(), target.reduced(), Execution::SEQUENTIAL))
{
  return generator.candidates(source.reduced(), target.reduced(), execution<ConcurrencyTag>());
}

template <class ConcurrencyTag, class Generator, class Kernel>
std::unique_ptr<Candidate_source> candidates_of(const Generator& generator, const Scan<Kernel>& source,
                                                const Scan<Kernel>& target, long)
{
  auto rounds = generator.template rounds<ConcurrencyTag>(source, target);
  return std::make_unique<User_candidates<decltype(rounds)>>(std::move(rounds), source.reduced(), target.reduced());
}

// The generator that the parameters give, with what they say of it; of one that has no parameters, itself.
template <class Generator, class NamedParameters>
auto with_parameters(const Generator& generator, const NamedParameters& np, const std::string& function, int)
    -> decltype(generator.with(np, function))
{
  return generator.with(np, function);
}

template <class Generator, class NamedParameters>
const Generator& with_parameters(const Generator& generator, const NamedParameters&, const std::string&, long)
{
  return generator;
}

template <class NamedParameters>
auto candidate_generator(const NamedParameters& np, const std::string& function)
{
  return with_parameters(parameter(np, internal_np::candidates, Oriented_pair_candidates()), np, function, 0);
}

// What the pipeline, which may exchange the two, makes the candidates with. All is kept by reference.
template <class ConcurrencyTag, class Kernel, class Generator>
Candidate_factory candidate_factory(const Generator& generator, const Scan<Kernel>& source, const Scan<Kernel>& target)
{
  return [&](const Reduced_scan& a, const Reduced_scan&) {
    return &a == &source.reduced() ? candidates_of<ConcurrencyTag>(generator, source, target, 0)
                                   : candidates_of<ConcurrencyTag>(generator, target, source, 0);
  };
}

// Where nothing tells from which side a scan was seen, both are tried, until a motion is certain. The most probable one
// counts, by how often the sides of two scans are found that go together; what other sides bring are its rivals. `run`:
// of a source and a target, a Registration_outcome or what derives from it.
template <class Kernel, class Run>
auto best_of_sides(const Scan<Kernel>& source, const Scan<Kernel>& target, Run_control& control, const Run& run)
{
  std::vector<std::pair<const Scan<Kernel>*, const Scan<Kernel>*>> sides = {{&source, &target}};
  const Scan<Kernel>*other_source = source.other_side(), *other_target = target.other_side();
  if (other_target) sides.push_back({&source, other_target});
  if (other_source) sides.push_back({other_source, &target});
  // The same for source and target exchanged.
  if (sides.size() == 3 && are_swapped(source.reduced(), target.reduced())) std::swap(sides[1], sides[2]);
  if (other_source && other_target) sides.push_back({other_source, other_target});
  const double extent = (std::min)(source.extent(), target.extent());
  std::vector<decltype(run(source, target))> outcomes; // the best one first
  for (std::size_t i = 0; i < sides.size(); ++i) {
    control.set_part(i, sides.size());
    outcomes.push_back(run(*sides[i].first, *sides[i].second));
    const bool is_of_source = sides[i].first == other_source, is_of_target = sides[i].second == other_target;
    if (other_source && other_target && is_of_source != is_of_target) turn_over_one_of_two(outcomes.back());
    if (is_better(outcomes.back(), outcomes.front())) std::swap(outcomes.back(), outcomes.front());
    if (control.is_stopped() || is_certain(outcomes.front())) break;
  }
  for (std::size_t i = 1; i < outcomes.size(); ++i) {
    add_rival(outcomes[i], extent, outcomes.front());
    add_stages(outcomes[i], outcomes.front());
  }
  if (control.is_stopped() && outcomes.size() > 1) outcomes.front().interrupt();
  return outcomes.front();
}

template <class ConcurrencyTag, class Kernel, class Generator>
Registration_result<Kernel> register_scans(const Scan<Kernel>& source, const Scan<Kernel>& target,
                                           const Generator& generator, Run_control& control)
{
  return to_result<Kernel>(best_of_sides(source, target, control, [&](const Scan<Kernel>& a, const Scan<Kernel>& b) {
    return register_reduced_scans(a.reduced(), b.reduced(), candidate_factory<ConcurrencyTag>(generator, a, b),
                                  execution<ConcurrencyTag>(), control);
  }));
}

#ifdef CGAL_CRUDE_REGISTRATION_COMPILED
// With the kernel that most programs use, and the default generator, it is compiled with the core, as the preparation
// of scans without named parameters is below.
extern template Registration_result<Scan<>::Kernel>
register_scans<CGAL::Sequential_tag>(const Scan<>&, const Scan<>&, const Oriented_pair_candidates&, Run_control&);
#ifdef CGAL_LINKED_WITH_TBB
extern template Registration_result<Scan<>::Kernel>
register_scans<CGAL::Parallel_tag>(const Scan<>&, const Scan<>&, const Oriented_pair_candidates&, Run_control&);
#endif
#endif

} // namespace internal

#ifdef CGAL_CRUDE_REGISTRATION_COMPILED
extern template void Scan<>::prepare_image(const Range_image<Scan<>::Kernel>&,
                                           const parameters::Default_named_parameters&, const std::string&,
                                           internal::Run_control&);
extern template void Scan<>::prepare_points(const std::vector<Scan<>::Point_3>&, const std::vector<Scan<>::Vector_3>&,
                                            const Sensor<Scan<>::Kernel>&, const parameters::Default_named_parameters&,
                                            const std::string&, internal::Run_control&);
extern template void Scan<>::prepare(const internal::Flat_mesh&, const internal::Flat_sensor&,
                                     const internal::Flat_range_image*, const parameters::Default_named_parameters&,
                                     const int&, const std::string&, internal::Run_control&);
#endif

/*!
\ingroup PkgCrudeRegistrationRef

\brief registers two prepared scans: finds the rigid motion that maps the source into the frame of the target, with no
knowledge of how they lie, and says whether it is to be believed.

\tparam ConcurrencyTag `CGAL::Sequential_tag` (default), `CGAL::Parallel_tag` or `CGAL::Parallel_if_available_tag`; the
        answer is the same, bit by bit, with any number of threads
\tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"

\param source, target the scans; their sensors, where known, are part of them
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below

\cgalNamedParamsBegin
  \cgalParamNBegin{candidates}
    \cgalParamDescription{the way to propose motions: `Oriented_pair_candidates`, `Trihedron_candidates` (the method of
                          the paper), or a generator of your own}
    \cgalParamType{a model of `CandidateGenerator`}
    \cgalParamDefault{`Oriented_pair_candidates()`}
    \cgalParamExtra{The parameters of its constructor are read, too: `minimum_extent` and `maximum_extent`, of
                    `Trihedron_candidates` `tolerance` and `use_normals`.}
  \cgalParamNEnd
  \cgalParamNBegin{minimum_extent}
    \cgalParamDescription{\f$ f_1 \f$ of the paper: what is matched lies no closer to each other than this share of the
                          scan's mean extent \f$ M \f$}
    \cgalParamType{`double`, zero or above}
    \cgalParamDefault{`0`}
  \cgalParamNEnd
  \cgalParamNBegin{maximum_extent}
    \cgalParamDescription{\f$ f_2 \f$ of the paper: and no further away from each other than this share}
    \cgalParamType{`double`, above `minimum_extent`}
    \cgalParamDefault{`0.3`}
  \cgalParamNEnd
  \cgalParamNBegin{time_budget}
    \cgalParamDescription{seconds after which the run ends}
    \cgalParamType{`double`, above zero}
    \cgalParamDefault{none}
  \cgalParamNEnd
  \cgalParamNBegin{visitor}
    \cgalParamDescription{is told how far the run is, and may end it}
    \cgalParamType{a model of `RegistrationVisitor`, or a `std::reference_wrapper` of one}
    \cgalParamDefault{none}
    \cgalParamExtra{It is called by the calling thread, about once a millisecond.}
  \cgalParamNEnd
\cgalNamedParamsEnd

\return the answer; a failure is a status with its reason. `transformation()` maps the source to the target; source and
         target exchanged give the inverse.

\throws std::invalid_argument if a parameter is out of its range, or a scan was not made for the generator

A run that is ended by its budget or its visitor returns within some hundredths of a second. Its status is then not
`REGISTERED`: the best motion so far is `AMBIGUOUS`, if it is plausible, as its rivals have not been looked for; the
reason says so. What is thrown by the visitor is passed on.

Otherwise the result depends on nothing but the two scans and the parameters. Complexity: bounded by the number of looks
of the last round of the search, whatever the size of the scans.
*/
template <class ConcurrencyTag = CGAL::Sequential_tag, class Kernel,
          class NamedParameters = parameters::Default_named_parameters>
Registration_result<Kernel> register_scans(const Scan<Kernel>& source, const Scan<Kernel>& target,
                                           const NamedParameters& np = parameters::default_values())
{
  const auto generator = internal::candidate_generator(np, "register_scans");
  internal::Run_control control(internal::visitor_parameter(np), internal::time_budget_parameter(np, "register_scans"));
  return internal::register_scans<ConcurrencyTag>(source, target, generator, control);
}

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_REGISTER_SCANS_H
