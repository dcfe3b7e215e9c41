// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// refine and simplify: stages of the method on their own.

#include "Method.h"
#include "arrays.h"
#include "input.h"

#include <CGAL/Crude_registration/motion/refine_motion.h>
#include <CGAL/Crude_registration/reduction/simplify_scan.h>

#include <CGAL/tags.h>

#include <pybind11/stl.h>

#include <optional>
#include <utility>

namespace {

const char* const refine_doc =
    R"(refine(source, target, T_target_source, *, maximum_distance=None, sampling_distance=None, tolerance=0.05, number_of_iterations=50, parallel=True)
--

Refines a rigid motion that already maps the source close to the target, by robust point-to-plane registration. Returns
a RefinedMotion.

source, target: surfaces: the path of a file, an array of shape (n, 3) or (rows, columns, 3), a ScanFile or a Mesh.
T_target_source: (4, 4) or (3, 4), maps the source into the frame of the target, rigid to three digits.
maximum_distance: how far apart corresponding points may lie at the start, in the unit of the coordinates; by default a
    fifth of the RMS radius of the target.
sampling_distance: of the coarser surface; by default the larger one of the median edge lengths.
tolerance: the step, in sampling distances, that ends the iteration.
number_of_iterations: the largest number of them.
parallel: whether all processors are used; the answer is the same, bit by bit.

>>> import crude_registration as cr, numpy
>>> statue = cr.make_statue(resolution=32)
>>> shift = numpy.eye(4)
>>> shift[0, 3] = 0.02
>>> refined = cr.refine(statue, statue, shift)
>>> bool(abs(refined.T_target_source - numpy.eye(4)).max() < 1e-3)
True
)";

const char* const simplify_doc =
    R"(simplify(source, *, approximation_error=None, number_of_vertices=None, cell_size=0.0)
--

Simplifies the surface of a scan to the few vertices that registration by trihedra works with: edges are collapsed in
the order of the mean squared distance to the faces they stand for. Returns a Mesh.

source: a surface: the path of a file, an array of shape (n, 3) or (rows, columns, 3), a ScanFile or a Mesh.
approximation_error: the largest mean squared distance of a collapse, a squared length; by default that of the scan as
    the paper says, if number_of_vertices is not given either, else no limit.
number_of_vertices: the number of vertices to stop at.
cell_size: the edge length of cells in which vertices are grouped before, 0 for no grouping: three to four sampling
    distances leave about as many vertices in a fraction of the time.

>>> import crude_registration as cr
>>> statue = cr.make_statue(resolution=24)
>>> len(cr.simplify(statue, number_of_vertices=500).points)
500
)";

py::object refine(const py::object& source, const py::object& target, const py::object& T_target_source,
                  const std::optional<double>& maximum_distance, const std::optional<double>& sampling_distance,
                  double tolerance, long long number_of_iterations, bool parallel)
{
  const Motion initial = to_motion(T_target_source, "refine: T_target_source");
  const Surface s = to_surface(source, "refine: source"), t = to_surface(target, "refine: target");
  const auto refined = [&](const auto& np) {
    py::gil_scoped_release unlocked;
    return parallel ? CR::refine_motion<CGAL::Parallel_if_available_tag>(s, t, initial, np)
                    : CR::refine_motion<CGAL::Sequential_tag>(s, t, initial, np);
  };
  const auto np = p::tolerance(tolerance).number_of_iterations(number_of_iterations);
  const CR::Refined_motion<Kernel> r =
      maximum_distance && sampling_distance
          ? refined(np.maximum_distance(*maximum_distance).sampling_distance(*sampling_distance))
      : maximum_distance  ? refined(np.maximum_distance(*maximum_distance))
      : sampling_distance ? refined(np.sampling_distance(*sampling_distance))
                          : refined(np);
  return py::module_::import("crude_registration._types")
      .attr("RefinedMotion")(to_matrix(r.motion), r.iterations, r.is_converged, r.sampling_distance, r.residual,
                             r.overlap, r.number_of_free_motions, to_matrix(r.covariance));
}

py::object simplify(const py::object& source, const std::optional<double>& approximation_error,
                    const std::optional<long long>& number_of_vertices, double cell_size)
{
  Surface surface = to_surface(source, "simplify: source");
  const Simplification simplification{approximation_error, number_of_vertices, cell_size};
  {
    py::gil_scoped_release unlocked;
    simplification.apply([&](const auto& np) { CR::simplify_scan(surface, np); });
  }
  return to_mesh(surface);
}

} // namespace

void bind_tools(py::module_& module)
{
  module.def("refine", &refine, py::arg("source"), py::arg("target"), py::arg("T_target_source"), py::kw_only(),
             py::arg("maximum_distance") = py::none(), py::arg("sampling_distance") = py::none(),
             py::arg("tolerance") = 0.05, py::arg("number_of_iterations") = 50, py::arg("parallel") = true, refine_doc);
  module.def("simplify", &simplify, py::arg("source"), py::kw_only(), py::arg("approximation_error") = py::none(),
             py::arg("number_of_vertices") = py::none(), py::arg("cell_size") = 0., simplify_doc);
}
