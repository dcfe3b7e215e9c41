// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// What crude_registration.assemble() is made of: the plan and its end here, the pairs wherever the caller has them
// done. The answer of a pair goes from there to here as the text that the store keeps of it.

#include "arrays.h"
#include "prepare.h"

#include <CGAL/Crude_registration/assemble_scans.h>

#include <CGAL/tags.h>

#include <pybind11/stl.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace {

namespace CRI = CR::internal;

using Assembly = CR::Assembly_result<Kernel>;
using Scans = std::vector<std::shared_ptr<const Scan>>;

template <class Value>
std::string text_of(const Value& value)
{
  std::ostringstream text;
  text << value;
  return text.str();
}

std::string text_of_pair(const CRI::Pair_answer& answer)
{
  std::ostringstream text;
  CRI::Pair_store::write(text, answer);
  return text.str();
}

CRI::Pair_answer of_text(const std::string& text)
{
  std::istringstream in(text);
  const std::optional<CRI::Pair_answer> answer = CRI::Pair_store::read(in);
  if (!answer) throw py::value_error("assemble: a task has returned what is no answer of a pair");
  return *answer;
}

// \throws py::value_error
CRI::Content_hash hash_of_text(const std::string& text)
{
  const std::optional<CRI::Content_hash> hash = CRI::Content_hash::of_text(text);
  if (!hash) throw py::value_error("assemble: '" + text + "' is no hash of a scan");
  return *hash;
}

std::optional<std::string> stored_pair(const std::string& store, const std::string& source, const std::string& target)
{
  const std::string file = CRI::Pair_store(store).file(hash_of_text(source), hash_of_text(target));
  py::gil_scoped_release unlocked;
  const std::optional<CRI::Pair_answer> answer = CRI::Pair_store::read(file);
  if (!answer) return std::nullopt;
  return text_of_pair(*answer);
}

std::string register_pair(const Scan& source, const Scan& target, const std::optional<std::string>& store)
{
  Interruption interruption{py::none()};
  py::gil_scoped_release unlocked;
  const CRI::Pair_answer answer =
      CRI::to_pair_answer(CR::register_scans<CGAL::Sequential_tag>(source, target, p::visitor(std::ref(interruption))));
  if (store)
    CRI::Pair_store::write(CRI::Pair_store(*store).file(CRI::content_hash(source), CRI::content_hash(target)), answer);
  return text_of_pair(answer);
}

// The pairs of each round are given to a function of Python, with one that says whether the run is to go on: a list of
// what register_pair() says of them is to come back, or None where it was not.
CRI::Round_registration by_function(const py::object& function)
{
  return [&function](const std::vector<CRI::Input_pair>& pairs, CRI::Run_control& control) {
    std::vector<CRI::Pair_answer> answers;
    py::gil_scoped_acquire lock;
    py::list list;
    for (const CRI::Input_pair& pair : pairs) list.append(py::make_tuple(pair.source, pair.target));
    const py::object results = function(list, py::cpp_function([&control] { return control.go_on(); }));
    if (results.is_none()) {
      if (!control.is_stopped()) throw py::value_error("assemble: the pairs of a round were not registered");
      return answers;
    }
    for (const py::handle result : results) answers.push_back(of_text(result.cast<std::string>()));
    if (answers.size() != pairs.size()) throw py::value_error("assemble: a round has other pairs than were asked for");
    return answers;
  };
}

Assembly assemble(const Scans& shared, const py::object& register_pairs, const std::optional<std::string>& store,
                  const Time_budget& budget, Interruption& interruption, bool parallel)
{
  if (!register_pairs.is_none()) {
    std::vector<const CRI::Reduced_scan*> reduced;
    for (const auto& scan : shared) reduced.push_back(&scan->reduced());
    CRI::Run_control control(
        [&](double progress) {
          interruption.progress(progress);
          return interruption.go_further();
        },
        budget.left());
    const CRI::Round_registration registration = by_function(register_pairs);
    return parallel ? CRI::assemble<CGAL::Parallel_if_available_tag, Kernel>(reduced, registration, control)
                    : CRI::assemble<CGAL::Sequential_tag, Kernel>(reduced, registration, control);
  }
  std::vector<Scan> scans;
  for (const auto& scan : shared) scans.push_back(*scan);
  const auto np = p::time_budget(budget.left()).visitor(std::ref(interruption));
  const auto run = [&](const auto& parameters) {
    return parallel ? CR::assemble_scans<CGAL::Parallel_if_available_tag>(scans, parameters)
                    : CR::assemble_scans<CGAL::Sequential_tag>(scans, parameters);
  };
  return store ? run(np.store(*store)) : run(np);
}

py::object to_python(const Assembly& result)
{
  const py::module_ types = py::module_::import("crude_registration._types");
  py::list scans, edges, overlaps, statistics;
  for (const auto& s : result.scans())
    scans.append(
        types.attr("AssembledScan")(s.component, to_matrix(s.pose), s.reason, s.residual, to_matrix(s.covariance)));
  for (const auto& e : result.edges())
    edges.append(types.attr("AssemblyEdge")(e.source, e.target, types.attr("EdgeStatus")(text_of(e.status)), e.reason,
                                            types.attr("RegistrationStatus")(text_of(e.registration)), e.confidence,
                                            e.overlap, e.residual));
  for (const auto& o : result.overlaps())
    overlaps.append(types.attr("AssemblyOverlap")(o.source, o.target, o.overlap, o.residual));
  for (const auto& s : result.statistics()) statistics.append(types.attr("Stage")(s.name, s.count, s.seconds));
  return types.attr("AssemblyResult")(result.number_of_components(), scans, edges, overlaps, statistics,
                                      result.is_interrupted());
}

} // namespace

void bind_assembly(py::module_& module)
{
  module.def(
      "assemble_scans",
      [](const Scans& scans, const py::object& register_pairs, const std::optional<std::string>& store,
         const std::optional<double>& time_budget, bool parallel, const py::object& progress) {
        const Time_budget budget(time_budget, "assemble");
        Interruption interruption(progress);
        Assembly result;
        {
          py::gil_scoped_release unlocked;
          result = assemble(scans, register_pairs, store, budget, interruption, parallel);
        }
        return to_python(result);
      },
      py::arg("scans"), py::arg("register_pairs") = py::none(), py::arg("store") = py::none(),
      py::arg("time_budget") = py::none(), py::arg("parallel") = true, py::arg("progress") = py::none(),
      "assemble_scans(scans, register_pairs=None, store=None, time_budget=None, parallel=True, progress=None)\n--\n\n"
      "What assemble() does once all is prepared. register_pairs: a function of a list of pairs of places and of a "
      "function\nthat says whether the run is to go on, which returns a list of what register_pair() returns.");
  module.def(
      "register_pair", &register_pair, py::arg("source"), py::arg("target"), py::arg("store") = py::none(),
      "register_pair(source, target, store=None)\n--\n\n"
      "What the registration of two Scans by this processor alone says to an assembly, as text; it is kept in the "
      "folder\nstore, if that is given.");
  module.def("stored_pair", &stored_pair, py::arg("store"), py::arg("source"), py::arg("target"),
             "stored_pair(store, source, target)\n--\n\n"
             "What register_pair() has kept in the folder store of two scans by their scan_hash(), or None.");
  module.def(
      "scan_hash", [](const Scan& scan) { return CRI::content_hash(scan).text(); }, py::arg("scan"),
      "scan_hash(scan)\n--\n\nA text that tells the contents of a Scan from those of others.");
}
