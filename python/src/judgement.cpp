// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// judge: of a motion that somebody found.

#include "arrays.h"
#include "two_scans.h"

#include <CGAL/Crude_registration/judge_motion.h>

#include <CGAL/tags.h>

#include <pybind11/stl.h>

#include <functional>
#include <optional>
#include <sstream>
#include <string>

namespace {

const char* const judge_doc =
    R"(judge(source, target, T_target_source, *, viewpoint=None, source_viewpoint=None, target_viewpoint=None, source_viewing_direction=None, target_viewing_direction=None, method='pairs', minimum_extent=0.0, maximum_extent=0.3, time_budget=None, parallel=True, progress=None)
--

Says of a motion that somebody found, by whatever tool, whether it maps the source to where it belongs in the frame of
the target, whether refinement would take it there, or whether it is wrong. Returns a MotionJudgement.

source, target: as of register(), as are all arguments but the next one. Where the sensors are known, what they saw to
    be empty is evidence, too.
T_target_source: (4, 4) or (3, 4): the motion, rigid to three digits.

>>> import crude_registration as cr, numpy
>>> statue = cr.make_statue(resolution=48)
>>> source, T_scene_source = cr.simulate(statue, (-1, 0, -0.25), samples=150)
>>> target, T_scene_target = cr.simulate(statue, (-1, -0.7, -0.25), samples=150)
>>> cr.judge(source, target, numpy.linalg.inv(T_scene_target) @ T_scene_source).status
<MotionStatus.RIGHT: 'right'>
>>> cr.judge(source, target, numpy.diag([-1, -1, 1, 1])).status  # upside down
<MotionStatus.WRONG: 'wrong'>
)";

py::object judge(const py::object& source, const py::object& target, const py::object& T_target_source,
                 const py::object& viewpoint, const py::object& source_viewpoint, const py::object& target_viewpoint,
                 const py::object& source_viewing_direction, const py::object& target_viewing_direction,
                 const std::string& method_name, double minimum_extent, double maximum_extent,
                 const std::optional<double>& time_budget, bool parallel, const py::object& progress)
{
  const Time_budget budget(time_budget, "judge");
  const Motion motion = to_motion(T_target_source, "judge: T_target_source");
  const Two_scans both(
      source, target,
      {viewpoint, source_viewpoint, target_viewpoint, source_viewing_direction, target_viewing_direction}, "judge");
  Method_parameters parameters;
  parameters.method = method_name;
  parameters.minimum_extent = minimum_extent;
  parameters.maximum_extent = maximum_extent;
  const Method method(parameters, "judge");
  Interruption interruption(progress);
  CR::Motion_judgement<Kernel> judgement;
  {
    py::gil_scoped_release unlocked;
    const auto scans = both.prepared(method, budget, interruption, parallel);
    const auto np = p::time_budget(budget.left()).candidates(method).visitor(std::ref(interruption));
    judgement = parallel ? CR::judge_motion<CGAL::Parallel_if_available_tag>(*scans[0], *scans[1], motion, np)
                         : CR::judge_motion<CGAL::Sequential_tag>(*scans[0], *scans[1], motion, np);
  }
  const py::module_ types = py::module_::import("crude_registration._types");
  std::ostringstream status;
  status << judgement.status();
  return types.attr("MotionJudgement")(types.attr("MotionStatus")(status.str()), judgement.confidence(),
                                       judgement.displacement(), judgement.refined());
}

} // namespace

void bind_judgement(py::module_& module)
{
  module.def("judge", &judge, py::arg("source"), py::arg("target"), py::arg("T_target_source"), py::kw_only(),
             py::arg("viewpoint") = py::none(), py::arg("source_viewpoint") = py::none(),
             py::arg("target_viewpoint") = py::none(), py::arg("source_viewing_direction") = py::none(),
             py::arg("target_viewing_direction") = py::none(), py::arg("method") = "pairs",
             py::arg("minimum_extent") = 0., py::arg("maximum_extent") = CR::internal::default_maximum_extent,
             py::arg("time_budget") = py::none(), py::arg("parallel") = true, py::arg("progress") = py::none(),
             judge_doc);
}
