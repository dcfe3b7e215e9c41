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

#ifndef CGAL_CRUDE_REGISTRATION_ASSEMBLE_SCANS_H
#define CGAL_CRUDE_REGISTRATION_ASSEMBLE_SCANS_H

// Puts many scans together: unordered scans to one pose each.

#include <CGAL/Crude_registration/Assembly_result.h>
#include <CGAL/Crude_registration/IO/internal/Pair_store.h>
#include <CGAL/Crude_registration/Scan.h>
#include <CGAL/Crude_registration/internal/assembly/assemble_reduced_scans.h>
#include <CGAL/Crude_registration/internal/motion/Nearest_surfel.h>
#include <CGAL/Crude_registration/internal/motion/Refinement.h>
#include <CGAL/Crude_registration/motion/refine_motion.h>
#include <CGAL/Crude_registration/named_parameters.h>
#include <CGAL/Crude_registration/register_scans.h>

#include <CGAL/tags.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// What an assembly takes from the registration of a pair: its distinct motions with their probabilities.
template <class Kernel>
Pair_answer to_pair_answer(const Registration_result<Kernel>& result)
{
  Pair_answer answer;
  answer.status = result.status();
  answer.reason = result.reason();
  answer.overlap = result.overlap();
  answer.residual = result.residual();
  if (result.status() != NOT_REGISTERED)
    answer.motions.push_back({to_rigid_motion(result.transformation()), result.confidence()});
  constexpr std::size_t most = 5;
  constexpr double least = 1e-3; // tells nothing
  for (const auto& r : result.runners_up())
    if (answer.motions.size() < most && r.probability >= least)
      answer.motions.push_back({to_rigid_motion(r.transformation), r.probability});
  return answer;
}

// Of all that the registration of a scan with others depends on: where nothing tells the side that was seen, both are
// tried.
template <class Kernel>
Content_hash content_hash(const Scan<Kernel>& scan)
{
  Content_hash hash = hash_of(scan.reduced());
  hash.add(int(scan.other_side() != nullptr));
  return hash;
}

template <class Kernel>
Assembly_result<Kernel> to_assembly_result(const Assembly_outcome& outcome)
{
  using Result = Assembly_result<Kernel>;
  typename Result::Parts parts;
  parts.number_of_components = outcome.number_of_components;
  parts.is_interrupted = outcome.is_interrupted;
  for (std::size_t i = 0; i < outcome.poses.size(); ++i)
    parts.scans.push_back({outcome.components[i], to_aff_transformation<Kernel>(outcome.poses[i]), outcome.reasons[i],
                           outcome.residuals[i], rows_of(outcome.covariances[i]), outcome.lost_hints[i]});
  for (const Assembly_edge& e : outcome.edges)
    parts.edges.push_back(
        {e.source, e.target, e.status, e.reason, e.registration, e.confidence, e.overlap, e.residual});
  for (const Assembled_pair& p : outcome.pairs) parts.overlaps.push_back({p.source, p.target, p.overlap, p.residual});
  for (const Stage_record& s : outcome.stages) parts.statistics.push_back({s.name, s.count, s.seconds});
  return Result(std::move(parts));
}

// What the parameters of that kind say of n scans. \throws std::invalid_argument
template <class NamedParameters>
Known_poses known_poses_parameters(const NamedParameters& np, std::size_t n)
{
  const auto fail = [](const std::string& text) { throw std::invalid_argument("assemble_scans: " + text); };
  Known_poses known;
  if constexpr (is_given<NamedParameters, internal_np::known_poses_t>) {
    for (const auto& pose : CGAL::parameters::get_parameter_reference(cgal_parameters(np), internal_np::known_poses)) {
      known.poses.emplace_back();
      if (pose)
        known.poses.back() =
            Known_pose{0, rigid_argument(*pose, "assemble_scans", "one of known_poses"), to_rigid_motion(*pose)};
    }
    if (known.poses.size() != n) fail("known_poses has to have an entry for each scan");
    known.are_fixed = parameter(np, internal_np::known_poses_are_fixed, false);
    if constexpr (is_given<NamedParameters, internal_np::known_groups_t>) {
      std::size_t i = 0;
      for (const auto group :
           CGAL::parameters::get_parameter_reference(cgal_parameters(np), internal_np::known_groups)) {
        if (i < n && known.poses[i]) known.poses[i]->group = std::size_t(group);
        ++i;
      }
      if (i != n) fail("known_groups has to have an entry for each scan");
    }
  }
  if constexpr (is_given<NamedParameters, internal_np::reference_scan_t>) {
    known.reference = std::size_t(parameter(np, internal_np::reference_scan, 0));
    if (*known.reference >= n) fail("there is no scan reference_scan");
  }
  return known;
}

// With the answers that are kept in a folder, and kept there where they are new. Without a folder, where its name is
// empty, as it was.
template <class Registration>
Registration kept_in(const std::string& folder, const Registration& registration)
{
  if (folder.empty()) return registration;
  return [store = Pair_store(folder), registration](const Reduced_scan& source, const Reduced_scan& target,
                                                    Run_control& task) {
    const std::string file = store.file(hash_of(source), hash_of(target));
    if (const auto answer = Pair_store::read(file)) return *answer;
    Pair_answer answer = registration(source, target, task);
    if (!task.is_stopped()) Pair_store::write(file, answer);
    return answer;
  };
}

// Registers the pairs of `scans`, which are referred to, by a generator; the answers are kept in `folder`, unless its
// name is empty.
template <class ScanRange, class Generator>
Pair_registration pair_registration(const ScanRange& scans, const Generator& generator, const std::string& folder)
{
  using Difference = typename std::iterator_traits<decltype(std::begin(scans))>::difference_type;
  const auto first = std::begin(scans);
  Pair_registration register_now = [first, generator](std::size_t i, std::size_t j, Run_control& task) {
    return to_pair_answer(
        register_scans<CGAL::Sequential_tag>(first[Difference(i)], first[Difference(j)], generator, task));
  };
  if (folder.empty()) return register_now;
  std::vector<Content_hash> hashes;
  for (const auto& scan : scans) hashes.push_back(content_hash(scan));
  return [store = Pair_store(folder), hashes, register_now](std::size_t i, std::size_t j, Run_control& task) {
    const std::string file = store.file(hashes[i], hashes[j]);
    if (const auto answer = Pair_store::read(file)) return *answer;
    Pair_answer answer = register_now(i, j, task);
    if (!task.is_stopped()) Pair_store::write(file, answer);
    return answer;
  };
}

// `registration`: a Pair_registration or a Round_registration. `folder`: keeps what is registered of several scans.
template <class ConcurrencyTag, class Kernel, class Registration>
Assembly_result<Kernel> assemble(const std::vector<const Reduced_scan*>& scans, const Registration& registration,
                                 Run_control& control, const Known_poses& known = {}, const std::string& folder = {})
{
  // What is fused of many scans is no Scan: it is registered by the default, whatever the generator.
  const Surface_registration register_now = [](const Reduced_scan& source, const Reduced_scan& target,
                                               Run_control& task) {
    const auto make_candidates = [](const Reduced_scan& a, const Reduced_scan& b) {
      return Oriented_pair_candidates().candidates(a, b, Execution::SEQUENTIAL);
    };
    return to_pair_answer(
        to_result<Kernel>(register_reduced_scans(source, target, make_candidates, Execution::SEQUENTIAL, task)));
  };
  return to_assembly_result<Kernel>(assemble_reduced_scans(scans, registration, kept_in(folder, register_now),
                                                           execution<ConcurrencyTag>(), control, known));
}

// assemble_scans(), with the pairs of each round registered by what need not be this process; where `registration` is
// empty it is.
template <class ConcurrencyTag, class ScanRange, class NamedParameters>
auto assemble_scans_by(const Round_registration& registration, const ScanRange& scans, const NamedParameters& np)
{
  using Kernel = typename std::iterator_traits<decltype(std::begin(scans))>::value_type::Kernel;
  const auto generator = candidate_generator(np, "assemble_scans");
  Run_control control(visitor_parameter(np), time_budget_parameter(np, "assemble_scans"));
  std::vector<const Reduced_scan*> reduced;
  for (const auto& scan : scans) reduced.push_back(&scan.reduced());
  const Known_poses known = known_poses_parameters(np, reduced.size());
  std::string folder;
  if constexpr (is_given<NamedParameters, internal_np::store_t>)
    folder = parameter(np, internal_np::store, std::string());
  if (registration) return assemble<ConcurrencyTag, Kernel>(reduced, registration, control, known, folder);
  return assemble<ConcurrencyTag, Kernel>(reduced, pair_registration(scans, generator, folder), control, known, folder);
}

// The points of one scan against the surfaces of others, in a frame of the assembly.
class Distances_to_scans
{
public:
  void add(const Reduced_scan& scan, const Rigid_motion& model_from_input)
  {
    m_scans.push_back({&scan, scan.own_from_input * model_from_input.inverse()});
  }

  // The least distance along a normal; infinite where no surface is near.
  double operator()(const Vector& p) const
  {
    double least = (std::numeric_limits<double>::infinity)();
    for (const auto& [scan, own_from_model] : m_scans) {
      const Nearest_surfel surface{scan->fine.surfels, scan->fine.field, double(scan->fine.spacing)};
      const Vector q = own_from_model(p);
      Surface_point closest;
      if (surface.closest(q, double(scan->fine.spacing), closest))
        least = (std::min)(least, (closest.point - q).norm());
    }
    return least;
  }

private:
  std::vector<std::pair<const Reduced_scan*, Rigid_motion>> m_scans;
};

} // namespace internal

/*!
\ingroup PkgCrudeRegistrationRef

\brief puts many scans together: finds a pose for each, from nothing but their surfaces, and says which of them do not
belong together.

Pairs that promise to overlap are registered (`register_scans()`), in rounds, until all scans are connected and each
connection is confirmed by others; no more than six a scan. Where pairs contradict each other, what most of them say and
the free space of all scans decide. All poses are then refined together. What cannot be connected with certainty comes
back as components of its own.

\tparam ConcurrencyTag `CGAL::Sequential_tag` (default), `CGAL::Parallel_tag` or `CGAL::Parallel_if_available_tag`; the
        answer is the same, bit by bit, with any number of threads
\tparam ScanRange a model of `RandomAccessRange` whose value type is `Scan`
\tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"

\param scans the scans, in any order; their sensors, where known, are part of them
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below

\cgalNamedParamsBegin
  \cgalParamNBegin{candidates}
    \cgalParamDescription{the way to propose motions of pairs, as of `register_scans()`, with its parameters}
    \cgalParamType{a model of `CandidateGenerator`}
    \cgalParamDefault{`Oriented_pair_candidates()`}
  \cgalParamNEnd
  \cgalParamNBegin{known_poses}
    \cgalParamDescription{poses that are known beforehand, of some scans or of all}
    \cgalParamType{a range with a `std::optional<Aff_transformation_3>` for each scan, rigid to within a thousandth}
    \cgalParamDefault{none is known}
    \cgalParamExtra{They are hints: pairs that overlap by them are registered first, and a hint decides between motions
                    that a pair leaves open. No scan is connected by a hint alone, and a wrong one does no harm but to
                    the time: it is dropped, and `Assembly_result::Placed_scan::lost_hint` says so.}
  \cgalParamNEnd
  \cgalParamNBegin{known_groups}
    \cgalParamDescription{what frame the known pose of each scan is in: those of one group are in one frame}
    \cgalParamType{a range with a `std::size_t` for each scan}
    \cgalParamDefault{all are in one frame}
  \cgalParamNEnd
  \cgalParamNBegin{known_poses_are_fixed}
    \cgalParamDescription{whether the known poses are no hints but stay as they are}
    \cgalParamType{`bool`}
    \cgalParamDefault{`false`}
    \cgalParamExtra{No pair of a group is registered. The frame of a component that has such scans is that of the known
                    pose of the first of them.}
  \cgalParamNEnd
  \cgalParamNBegin{reference_scan}
    \cgalParamDescription{the place of the scan whose frame is that of its component, unless a fixed pose gives it}
    \cgalParamType{`std::size_t`}
    \cgalParamDefault{the first scan of each component}
  \cgalParamNEnd
  \cgalParamNBegin{store}
    \cgalParamDescription{a folder, made if missing, that keeps a file for each pair that was registered: a run that was
                          ended, or has more scans, registers none of them again; none where it is empty}
    \cgalParamType{`std::string`}
    \cgalParamDefault{none}
    \cgalParamExtra{Files are found by the contents of the two scans, and written whole or not at all; several runs may
                    share a folder. It is to be used with one generator and its parameters.}
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
    \cgalParamExtra{It is called by the calling thread.}
  \cgalParamNEnd
\cgalNamedParamsEnd

\return the poses and what they rest on. A run that is ended by its budget or its visitor returns what it has found.

\throws std::invalid_argument if a parameter is out of its range, or a scan was not made for the generator
\throws IO_error if the folder `store`, or a file in it, cannot be written

The result depends on nothing but the scans and the parameters; the order of the scans matters only for the frame of
each component, and for rounding. Complexity: some registrations a scan.
*/
template <class ConcurrencyTag = CGAL::Sequential_tag, class ScanRange,
          class NamedParameters = parameters::Default_named_parameters>
auto assemble_scans(const ScanRange& scans, const NamedParameters& np = parameters::default_values())
{
  return internal::assemble_scans_by<ConcurrencyTag>({}, scans, np);
}

/*!
\ingroup PkgCrudeRegistrationRef

\brief measures how far points of one scan are from the other scans of its component.

\tparam ScanRange a model of `RandomAccessRange` whose value type is `Scan`
\tparam PointRange a model of `Range` whose value type is a `Point_3`

\param scans what was assembled
\param result the answer of `assemble_scans()`
\param scan the place of a scan among them
\param points points in the frame of that scan's input

\return for each point the distance to the nearest of the other scans' surfaces, along its normal; infinite where there
         is none near
*/
template <class ScanRange, class Kernel, class PointRange>
std::vector<double> distances_to_other_scans(const ScanRange& scans, const Assembly_result<Kernel>& result,
                                             std::size_t scan, const PointRange& points)
{
  internal::Distances_to_scans distance;
  std::size_t i = 0;
  for (const auto& other : scans) {
    if (i != scan && result.component(i) == result.component(scan))
      distance.add(other.reduced(), internal::to_rigid_motion(result.pose(i)));
    ++i;
  }
  const internal::Rigid_motion pose = internal::to_rigid_motion(result.pose(scan));
  std::vector<double> distances;
  for (const auto& p : points) distances.push_back(distance(pose(internal::to_vector(p))));
  return distances;
}

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_ASSEMBLE_SCANS_H
