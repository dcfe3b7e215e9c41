// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// register, register_with_scale, and their result.

#include "arrays.h"
#include "json.h"
#include "two_scans.h"

#include <CGAL/Crude_registration/register_scans.h>
#include <CGAL/Crude_registration/register_scans_with_scale.h>

#include <CGAL/tags.h>

#include <Eigen/Geometry>
#include <pybind11/stl.h>

#include <array>
#include <locale>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

namespace {

const char* const register_doc =
    R"(register(source, target, *, viewpoint=None, source_viewpoint=None, target_viewpoint=None, source_viewing_direction=None, target_viewing_direction=None, method='pairs', minimum_extent=0.0, maximum_extent=0.3, tolerance=None, use_normals=True, approximation_error=None, number_of_vertices=None, cell_size=0.0, time_budget=None, parallel=True, progress=None)
--

Finds the rigid motion that maps the source into the frame of the target, with no knowledge of how they lie, and says
whether it is to be believed. A failure is a status with its reason, no exception.

source, target: what Scan() takes as points: an array of shape (n, 3) or (rows, columns, 3), the path of a file, a
    ScanFile, a Mesh; or a Scan, which is prepared once for all pairs that it takes part in. Both are in one unit, each
    in a frame of its own.
viewpoint: three numbers, where the sensor stood, in the frame of either scan; or for each side apart:
source_viewpoint, target_viewpoint: of a Scan its own, which is not to be given again.
source_viewing_direction, target_viewing_direction: the direction of parallel lines of sight, instead.
method: how motions are proposed: 'pairs' of oriented points, or the 'trihedra' of the paper.
minimum_extent, maximum_extent: f1 and f2 of the paper: what is matched is no shorter and no longer than these shares
    of the scan's mean extent M. f2 is about the least share of the scan that overlaps.
tolerance: of trihedra: how far vertices that correspond may lie from the same place of the surface, a length; by
    default what the mesh says.
use_normals: of trihedra: whether normals are compared, beside curvatures.
approximation_error, number_of_vertices, cell_size: of trihedra: how far scans that are not prepared yet are
    simplified, see Scan().
time_budget: seconds after which the run ends, with the best motion so far, which is then not REGISTERED.
parallel: whether all processors are used; the answer is the same, bit by bit.
progress: a function that is called about every 50 milliseconds with the share of the work that is done at most, from
    0.0 to 1.0, and may end the run by returning False. What it raises is passed on.

Ctrl-C ends a run of the main thread within a tenth of a second. Other threads of Python go on meanwhile.

>>> import crude_registration as cr
>>> statue = cr.make_statue(resolution=48)
>>> source, T_scene_source = cr.simulate(statue, (-1, 0, -0.25), samples=150)
>>> target, T_scene_target = cr.simulate(statue, (-1, -0.7, -0.25), samples=150)
>>> result = cr.register(source, target)
>>> result.status
<RegistrationStatus.REGISTERED: 'registered'>
>>> moved = source.points @ result.T_target_source[:3, :3].T + result.T_target_source[:3, 3]
>>> import numpy
>>> truth = numpy.linalg.inv(T_scene_target) @ T_scene_source
>>> bool(abs(result.T_target_source - truth).max() < 0.02)
True
)";

const char* const register_with_scale_doc =
    R"(register_with_scale(source, target, *, viewpoint=None, source_viewpoint=None, target_viewpoint=None, source_viewing_direction=None, target_viewing_direction=None, method='pairs', minimum_extent=0.0, maximum_extent=0.3, tolerance=None, use_normals=True, approximation_error=None, number_of_vertices=None, cell_size=0.0, time_budget=None, parallel=True, progress=None)
--

Registers two scans whose units of length may differ, by a factor that nobody knows: finds the factor and the motion
that together map the source into the frame of the target. Returns a ScaledRegistration.

The arguments are those of register(). The scans show the same object, or about as much of it: factors are tried that
make their sizes agree to within a third, those first that are ratios of units of length. The confidence holds for
factor and motion together; where the overlap does not tell the factor, as that of planes, the answer is AMBIGUOUS.
Where the units are known, multiply the coordinates and call register(), which is faster and surer.

>>> import crude_registration as cr
>>> statue = cr.make_statue(resolution=48)
>>> source, _ = cr.simulate(statue, (-1, 0, -0.25), samples=150)
>>> target, _ = cr.simulate(statue, (-1, -0.7, -0.25), samples=150)
>>> answer = cr.register_with_scale(source.points / 25.4, target.points)
>>> answer.registration.status
<RegistrationStatus.REGISTERED: 'registered'>
>>> bool(abs(answer.scale / 25.4 - 1) < 0.01)
True
)";

Result interrupted_result(const std::string& reason)
{
  Result::Parts parts;
  parts.reason = reason;
  return Result(std::move(parts));
}

py::object type_named(const char* name)
{
  return py::module_::import("crude_registration._types").attr(name);
}

struct With_known_scale
{
  using Answer = Result;
  static constexpr const char* name = "register";

  static Answer of(const Result& result) { return result; }

  template <class ConcurrencyTag, class NamedParameters>
  static Answer find(const Scan& source, const Scan& target, const NamedParameters& np)
  {
    return CR::register_scans<ConcurrencyTag>(source, target, np);
  }

  static Result to_python(const Answer& answer) { return answer; }
};

struct With_any_scale
{
  using Answer = CR::Scaled_registration<Kernel>;
  static constexpr const char* name = "register_with_scale";

  static Answer of(const Result& result)
  {
    Answer answer;
    answer.registration = result;
    return answer;
  }

  template <class ConcurrencyTag, class NamedParameters>
  static Answer find(const Scan& source, const Scan& target, const NamedParameters& np)
  {
    return CR::register_scans_with_scale<ConcurrencyTag>(source, target, np);
  }

  static py::object to_python(const Answer& answer)
  {
    return type_named("ScaledRegistration")(answer.scale, answer.scale_deviation, answer.registration,
                                            to_matrix(answer.similarity()));
  }
};

template <class Function>
typename Function::Answer run(const Two_scans& both, const Method& method, const Time_budget& budget,
                              Interruption& interruption, bool parallel)
{
  std::array<std::shared_ptr<const Scan>, 2> scans;
  try {
    scans = both.prepared(method, budget, interruption, parallel);
  } catch (const CR::Preparation_interrupted& e) {
    return Function::of(interrupted_result(e.what()));
  }
  const auto np = p::time_budget(budget.left()).candidates(method).visitor(std::ref(interruption));
  return parallel ? Function::template find<CGAL::Parallel_if_available_tag>(*scans[0], *scans[1], np)
                  : Function::template find<CGAL::Sequential_tag>(*scans[0], *scans[1], np);
}

// Without the arguments' types, as errors of these have to name them.
template <class Function>
auto register_any(const py::object& source, const py::object& target, const py::object& viewpoint,
                  const py::object& source_viewpoint, const py::object& target_viewpoint,
                  const py::object& source_viewing_direction, const py::object& target_viewing_direction,
                  const std::string& method_name, double minimum_extent, double maximum_extent,
                  const std::optional<double>& tolerance, bool use_normals,
                  const std::optional<double>& approximation_error, const std::optional<long long>& number_of_vertices,
                  double cell_size, const std::optional<double>& time_budget, bool parallel, const py::object& progress)
{
  const Time_budget budget(time_budget, Function::name);
  const Two_scans both(
      source, target,
      {viewpoint, source_viewpoint, target_viewpoint, source_viewing_direction, target_viewing_direction},
      Function::name);
  const Method method({method_name,
                       minimum_extent,
                       maximum_extent,
                       tolerance,
                       use_normals,
                       {approximation_error, number_of_vertices, cell_size}},
                      Function::name);
  Interruption interruption(progress);
  const auto answer = [&] {
    const py::gil_scoped_release unlocked;
    return run<Function>(both, method, budget, interruption, parallel);
  }();
  return Function::to_python(answer);
}

template <class Function>
void bind_register(py::module_& module, const char* doc)
{
  module.def(Function::name, &register_any<Function>, py::arg("source"), py::arg("target"), py::kw_only(),
             py::arg("viewpoint") = py::none(), py::arg("source_viewpoint") = py::none(),
             py::arg("target_viewpoint") = py::none(), py::arg("source_viewing_direction") = py::none(),
             py::arg("target_viewing_direction") = py::none(), py::arg("method") = "pairs",
             py::arg("minimum_extent") = 0., py::arg("maximum_extent") = CR::internal::default_maximum_extent,
             py::arg("tolerance") = py::none(), py::arg("use_normals") = true,
             py::arg("approximation_error") = py::none(), py::arg("number_of_vertices") = py::none(),
             py::arg("cell_size") = 0., py::arg("time_budget") = py::none(), py::arg("parallel") = true,
             py::arg("progress") = py::none(), doc);
}

std::string status_name(const Result& result)
{
  std::ostringstream status;
  status << result.status();
  return status.str();
}

std::string text_of(const Result& result)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(3);
  text << "<RegistrationResult: " << status_name(result) << ", confidence " << result.confidence();
  if (result.status() != CR::NOT_REGISTERED) {
    const CR::internal::Rigid_motion m = CR::internal::to_rigid_motion(result.transformation());
    text << ", overlap " << result.overlap() << ", residual " << result.residual() << ", turned by "
         << Eigen::AngleAxisd(m.rotation).angle() * 180 / CGAL_PI << " degrees and moved by " << m.translation.norm();
  }
  if (!result.reason().empty()) text << ": " << result.reason();
  text << '>';
  return text.str();
}

py::list motions(const Result& result, bool with_answer)
{
  const py::object type = type_named("ScoredMotion");
  py::list list;
  if (with_answer && result.status() != CR::NOT_REGISTERED)
    list.append(type(to_matrix(result.transformation()), result.score(), result.confidence()));
  for (const auto& m : result.runners_up()) list.append(type(to_matrix(m.transformation), m.score, m.probability));
  return list;
}

py::list stages(const Result& result)
{
  const py::object type = type_named("Stage");
  py::list list;
  for (const auto& s : result.statistics()) list.append(type(s.name, s.count, s.seconds));
  return list;
}

// (n, 2, 3): of each correspondence the point of the source and that of the target.
py::array_t<double> correspondence_of(const Result& result)
{
  const auto& pairs = result.correspondence();
  py::array_t<double> array({py::ssize_t(pairs.size()), py::ssize_t(2), py::ssize_t(3)});
  auto places = array.mutable_unchecked<3>();
  for (std::size_t i = 0; i < pairs.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      places(py::ssize_t(i), 0, k) = pairs[i].first[k];
      places(py::ssize_t(i), 1, k) = pairs[i].second[k];
    }
  return array;
}

std::string json_of(const Result& result, bool times)
{
  Json json = Json::object();
  add_result(json, result, times);
  return to_text(json);
}

constexpr int result_version = 2; // of the state that is pickled

py::tuple state_of(const Result& r)
{
  py::list runners_up, statistics;
  for (const auto& m : r.runners_up())
    runners_up.append(py::make_tuple(to_matrix(m.transformation), m.score, m.probability));
  for (const auto& s : r.statistics()) statistics.append(py::make_tuple(s.name, s.count, s.seconds));
  return py::make_tuple(result_version, int(r.status()), r.reason(), to_matrix(r.transformation()),
                        to_matrix(r.crude_transformation()), r.confidence(), r.score(), r.overlap(), r.residual(),
                        r.free_space_violations(), r.source_has_free_space(), r.target_has_free_space(), r.covariance(),
                        r.free_motions(), runners_up, statistics, correspondence_of(r));
}

Result from_state(const py::tuple& state)
{
  if (state.size() != 17 || state[0].cast<int>() != result_version)
    throw py::value_error("RegistrationResult: it was pickled by another version of the module");
  Result::Parts parts;
  const int status = state[1].cast<int>();
  if (status < CR::REGISTERED || status > CR::NOT_REGISTERED)
    throw py::value_error("RegistrationResult: what was pickled has no status");
  parts.status = CR::Registration_status(status);
  parts.reason = state[2].cast<std::string>();
  parts.transformation = to_motion(state[3], "RegistrationResult: T_target_source");
  parts.crude_transformation = to_motion(state[4], "RegistrationResult: crude_T_target_source");
  parts.confidence = state[5].cast<double>();
  parts.score = state[6].cast<double>();
  parts.overlap = state[7].cast<double>();
  parts.residual = state[8].cast<double>();
  parts.free_space_violations = state[9].cast<double>();
  parts.source_has_free_space = state[10].cast<bool>();
  parts.target_has_free_space = state[11].cast<bool>();
  parts.covariance = state[12].cast<Result::Covariance>();
  parts.free_motions = state[13].cast<std::vector<std::string>>();
  for (const py::handle item : state[14]) {
    const auto motion = item.cast<py::tuple>();
    parts.runners_up.push_back(
        {to_motion(motion[0], "RegistrationResult: runners_up"), motion[1].cast<double>(), motion[2].cast<double>()});
  }
  for (const py::handle item : state[15]) {
    const auto stage = item.cast<py::tuple>();
    parts.statistics.push_back({stage[0].cast<std::string>(), stage[1].cast<std::size_t>(), stage[2].cast<double>()});
  }
  const auto points = state[16].cast<py::array_t<double>>();
  if (points.ndim() != 3 || points.shape(1) != 2 || points.shape(2) != 3)
    throw py::value_error("RegistrationResult: what was pickled has no correspondence");
  const auto places = points.unchecked<3>();
  for (py::ssize_t i = 0; i < points.shape(0); ++i)
    parts.correspondence.emplace_back(Point(places(i, 0, 0), places(i, 0, 1), places(i, 0, 2)),
                                      Point(places(i, 1, 0), places(i, 1, 1), places(i, 1, 2)));
  if (!(parts.confidence >= 0 && parts.confidence <= 1))
    throw py::value_error("RegistrationResult: what was pickled has no confidence");
  return Result(std::move(parts));
}

} // namespace

void bind_registration(py::module_& module)
{
  py::class_<Result> result(
      module, "RegistrationResult",
      "The answer of a registration: a value, which refers to neither scan. Every matrix is rigid "
      "and maps the\nsource into the frame of the target: p lies at R p + t there, with R = "
      "T_target_source[:3, :3] and\nt = T_target_source[:3, 3]. It can be pickled.");
  result.attr("__module__") = "crude_registration";
  const auto add = [&](const char* name, const auto& get, const char* doc) {
    result.def_property_readonly(name, get, doc);
  };
  add(
      "status", [](const Result& r) { return type_named("RegistrationStatus")(status_name(r)); },
      "Whether the scans are registered: a RegistrationStatus.");
  add("reason", &Result::reason, "Why the status is not REGISTERED, as a sentence; empty if it is.");
  add(
      "T_target_source", [](const Result& r) { return to_matrix(r.transformation()); },
      "(4, 4): maps the source into the frame of the target; the best of several if AMBIGUOUS, the identity if\n"
      "NOT_REGISTERED.");
  add(
      "crude_T_target_source", [](const Result& r) { return to_matrix(r.crude_transformation()); },
      "(4, 4): the motion before it was refined.");
  add("correspondence", &correspondence_of,
      "(n, 2, 3): the points that gave crude_T_target_source, each of the source with the one of the target that it "
      "was\nmatched with, in the frames of the scans: 2 of a pair of oriented points, 4 of a trihedron, 0 if none is "
      "known.");
  add("confidence", &Result::confidence, "How certain T_target_source is, from 0 to 1.");
  add("score", &Result::score,
      "The natural logarithm of the odds that T_target_source is right, against none of the distinct motions being "
      "right.");
  add("overlap", &Result::overlap, "The share of the source's surface that lies on the target's, from 0 to 1.");
  add("residual", &Result::residual,
      "RMS distance of the scans in their overlap, along normals, in sampling distances.");
  add("free_space_violations", &Result::free_space_violations,
      "The share of the source's surface that lies where the target's sensor saw that there is nothing, plus that of\n"
      "the target's surface: from 0 to 2.");
  add("source_has_free_space", &Result::source_has_free_space,
      "Whether what the source's sensor saw to be empty was judged.");
  add("target_has_free_space", &Result::target_has_free_space, "The same of the target.");
  add(
      "covariance", [](const Result& r) { return to_matrix(r.covariance()); },
      "(6, 6): of the small motion x -> x + w x x + v that follows T_target_source, in the order (w, v): radians "
      "about\n"
      "the axes of the target's frame, and the displacement in the unit of its coordinates.");
  add("free_motions", &Result::free_motions, "The names of the motions that the overlap leaves free.");
  add(
      "poses", [](const Result& r) { return motions(r, true); },
      "A list of ScoredMotion: T_target_source, unless NOT_REGISTERED, and then those that are distinct from it and\n"
      "from each other, best first.");
  add(
      "runners_up", [](const Result& r) { return motions(r, false); }, "The poses but T_target_source.");
  add("statistics", &stages, "A list of Stage: what each stage of the registration did, in their order.");
  result.def("to_json", &json_of, py::kw_only(), py::arg("times") = false,
             "to_json(self, *, times=False)\n--\n\nThe answer as JSON, as `crude_register register --json` prints "
             "it: the same bytes for the same scans, unless\nthe times of the stages are asked for.");
  result.def("__repr__", [](const Result& r) { return text_of(r); });
  result.def(py::pickle(&state_of, &from_state));

  bind_register<With_known_scale>(module, register_doc);
  bind_register<With_any_scale>(module, register_with_scale_doc);
}
