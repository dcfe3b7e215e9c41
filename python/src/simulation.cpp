// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// make_statue and simulate: scans whose motions are known.

#include "arrays.h"
#include "input.h"

#include <CGAL/Crude_registration/simulation/make_statue.h>
#include <CGAL/Crude_registration/simulation/simulate_range_image.h>

#include <CGAL/Polygon_mesh_processing/bbox.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

namespace {

const char* const statue_doc = R"(make_statue(resolution=96, seed=0)
--

Makes a body without any symmetry, about 2 units tall, as the object of simulated scans. Returns a Mesh, closed and
oriented outwards.

resolution: the number of lattice cells along the longest side, from 8 to 1000; the number of faces grows as its square:
    about 95,000 for 96.
seed: which of the bodies.
)";

const char* const simulate_doc =
    R"(simulate(scene, direction, *, samples=400, perspective=False, noise=0.0, quantization=0.0, drop_out=0.0, grazing_drop_out=0.0, seed=0)
--

Takes a range image of a scene, as a scanner would whose view frames it. Returns a ScanFile in the sensor's own frame
(x along the columns, y along the rows, looking along -z), and a matrix of shape (4, 4) that maps from there to the
frame of the scene.

scene: what Scan() takes as points, most often a Mesh.
direction: three numbers, from the sensor into the scene, of any length.
samples: columns, and rows, of the grid.
perspective: whether the lines of sight start at one point; else they are parallel.
noise: the standard deviation of the depths, in distances of samples.
quantization: the step of the depths, in distances of samples.
drop_out: the share of samples that is lost where the surface faces the sensor; grazing_drop_out: where it is seen from
    the side.
seed: of the noise and the losses. The same arguments give the same samples, bit by bit.
)";

Surface statue(int resolution, unsigned seed)
{
  Surface body;
  CR::make_statue(body, resolution, p::random_seed(seed));
  return body;
}

py::tuple simulate(const py::object& scene, const py::object& direction, long long samples, bool perspective,
                   double noise, double quantization, double drop_out, double grazing_drop_out, std::uint64_t seed)
{
  if (samples < 2 || samples > 20000) throw py::value_error("simulate: samples has to be from 2 to 20000");
  const auto view = to_vector(direction, "simulate: direction");
  if (!view) throw py::type_error("simulate: direction: three numbers are needed");
  const CR::internal::Vector unit = CR::internal::unit_or_zero(CR::internal::to_vector(*view));
  if (!unit.allFinite() || unit.isZero()) throw py::value_error("simulate: direction is null or not finite");
  const Surface body = to_surface(scene, "simulate: scene");
  auto file = std::make_shared<Scan_file>();
  Motion scene_from_scan;
  {
    py::gil_scoped_release unlocked;
    auto camera = CR::Range_camera<Kernel>::framing(CGAL::Polygon_mesh_processing::bbox(body), *view,
                                                    std::size_t(samples), perspective);
    camera.noise = noise;
    camera.quantization = quantization;
    camera.drop_out = drop_out;
    camera.grazing_drop_out = grazing_drop_out;
    camera.seed = seed;
    auto simulated = CR::simulate_range_image(body, camera);
    file->kind = Scan_file::RANGE_IMAGE;
    file->image = std::move(simulated.image);
    scene_from_scan = simulated.scene_from_scan;
  }
  return py::make_tuple(file, to_matrix(scene_from_scan));
}

} // namespace

void bind_simulation(py::module_& module)
{
  module.def(
      "make_statue",
      [](int resolution, unsigned seed) {
        Surface body;
        {
          py::gil_scoped_release unlocked;
          body = statue(resolution, seed);
        }
        return to_mesh(body);
      },
      py::arg("resolution") = 96, py::arg("seed") = 0, statue_doc);
  module.def("simulate", &simulate, py::arg("scene"), py::arg("direction"), py::kw_only(), py::arg("samples") = 400,
             py::arg("perspective") = false, py::arg("noise") = 0., py::arg("quantization") = 0.,
             py::arg("drop_out") = 0., py::arg("grazing_drop_out") = 0., py::arg("seed") = 0, simulate_doc);
}
