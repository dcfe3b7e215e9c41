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

#ifndef CGAL_CRUDE_REGISTRATION_ASSEMBLE_BY_PROCESSES_H
#define CGAL_CRUDE_REGISTRATION_ASSEMBLE_BY_PROCESSES_H

// An assembly whose pairs are registered by other processes.

#include <CGAL/Crude_registration/IO/internal/Pair_store.h>
#include <CGAL/Crude_registration/assemble_scans.h>
#include <CGAL/Crude_registration/named_parameters.h>

#include <cstddef>
#include <functional>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

namespace CGAL {
namespace Crude_registration {

/*!
\ingroup PkgCrudeRegistrationRef

Two of many scans, by their places among them.
*/
struct Scan_places
{
  std::size_t source, target;
};

/*!
\ingroup PkgCrudeRegistrationRef

Registers pairs of scans, wherever that is done: called with some of them, it returns what `registered_pair()` says of
each, in their order. Its second argument is to be asked now and then: it says no from when on the run is to end, after
which there may be fewer answers.
*/
using Pair_executor =
    std::function<std::vector<std::string>(const std::vector<Scan_places>&, const std::function<bool()>&)>;

/*!
\ingroup PkgCrudeRegistrationRef

\brief registers two of many scans as a task of an assembly.

\tparam ScanRange a model of `RandomAccessRange` whose value type is `Scan`
\tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"

\param scans the scans of the assembly, in their order
\param pair the places of the two
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters": `candidates` and `store`, as of
       `assemble_scans()`

\return the answer as bytes, for `assemble_scans_by()`, of a program that was made of the same version

\throws std::out_of_range if there is no such scan
*/
template <class ScanRange, class NamedParameters = parameters::Default_named_parameters>
std::string registered_pair(const ScanRange& scans, const Scan_places& pair,
                            const NamedParameters& np = parameters::default_values())
{
  const auto n = static_cast<std::size_t>(std::distance(std::begin(scans), std::end(scans)));
  if (pair.source >= n || pair.target >= n) throw std::out_of_range("registered_pair: there is no such scan");
  std::string folder;
  if constexpr (internal::is_given<NamedParameters, internal_np::store_t>)
    folder = internal::parameter(np, internal_np::store, std::string());
  const auto& source = *std::next(std::begin(scans), std::ptrdiff_t(pair.source));
  const auto& target = *std::next(std::begin(scans), std::ptrdiff_t(pair.target));
  const auto registered = [&] {
    const auto generator = internal::candidate_generator(np, "registered_pair");
    return internal::to_pair_answer(
        register_scans<CGAL::Sequential_tag>(source, target, generator, internal::to_the_end()));
  };
  if (folder.empty()) return internal::to_bytes(registered());
  const internal::Pair_store store(folder);
  const std::string file = store.file(internal::content_hash(source), internal::content_hash(target));
  if (const auto answer = internal::Pair_store::read(file)) return internal::to_bytes(*answer);
  const internal::Pair_answer answer = registered();
  internal::Pair_store::write(file, answer);
  return internal::to_bytes(answer);
}

/*!
\ingroup PkgCrudeRegistrationRef

\brief puts many scans together as `assemble_scans()` does, with the same answer; the pairs of each round are registered
by what need not be this process.

\tparam ConcurrencyTag what this process does itself, as of `assemble_scans()`
\tparam ScanRange a model of `RandomAccessRange` whose value type is `Scan`
\tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"

\param executor registers the pairs; what it throws is passed on
\param scans the scans
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters": those of `assemble_scans()` but
       `candidates`, which is the matter of the executor

\return as `assemble_scans()`

\throws std::runtime_error if an answer is not what `registered_pair()` said
*/
template <class ConcurrencyTag = CGAL::Sequential_tag, class ScanRange,
          class NamedParameters = parameters::Default_named_parameters>
auto assemble_scans_by(const Pair_executor& executor, const ScanRange& scans,
                       const NamedParameters& np = parameters::default_values())
{
  const internal::Round_registration by_executor = [&executor](const std::vector<internal::Input_pair>& pairs,
                                                               internal::Run_control& control) {
    std::vector<Scan_places> places;
    places.reserve(pairs.size());
    for (const internal::Input_pair& p : pairs) places.push_back({p.source, p.target});
    std::vector<internal::Pair_answer> answers;
    answers.reserve(pairs.size());
    for (const std::string& bytes : executor(places, [&control] { return control.go_on(); }))
      answers.push_back(internal::answer_of_bytes(bytes));
    return answers;
  };
  return internal::assemble_scans_by<ConcurrencyTag>(by_executor, scans, np);
}

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_ASSEMBLE_BY_PROCESSES_H
