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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_SIMPLIFY_FLAT_SCAN_IMPL_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_SIMPLIFY_FLAT_SCAN_IMPL_H

// The simplification of simplify_flat_scan.h, on CGAL's edge collapse, and the description of the vertices left.

#include <CGAL/Crude_registration/internal/mesh/add_flat_mesh.h>
#include <CGAL/Crude_registration/internal/mesh/fill_small_holes.h>
#include <CGAL/Crude_registration/internal/mesh/mesh_geometry.h>
#include <CGAL/Crude_registration/internal/mesh/to_flat_mesh.h>
#include <CGAL/Crude_registration/internal/reduction/Matching_vertices.h>
#include <CGAL/Crude_registration/internal/reduction/measure_scan.h>
#include <CGAL/Crude_registration/internal/reduction/collapse_edges.h>
#include <CGAL/Crude_registration/internal/reduction/simplify_flat_scan.h>
#include <CGAL/Crude_registration/internal/sampling/flat_image_triangulation.h>
#include <CGAL/Crude_registration/reduction/simplify_scan.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// As of simplify_scan(), in coordinates of which rounding takes nothing. Each sample that the sensor lost leaves a
// hole, no wider than `largest_hole`, that no collapse closes: three vertices at least stay on its border. Where most
// of the vertices would, the holes are closed first. \throws Run_control::Stopped
inline Flat_mesh simplified(const Flat_mesh& dense, double cell, double largest_hole,
                            const Simplification_limits& limits)
{
  using Point = CGAL::Simple_cartesian<double>::Point_3;
  using Mesh = CGAL::Surface_mesh<Point>;
  const Vector centre = centre_of_box(dense.points);
  Flat_mesh centred = dense;
  for (Vector& p : centred.points) p -= centre;
  const auto simplify = [&](Mesh mesh) {
    if (cell > 0)
      return simplify_by_groups(to_flat_mesh(mesh, parameters::default_values(), "simplified", "mesh"), cell, limits);
    const Mean_squared_distance_policies<Mesh, CGAL::Simple_cartesian<double>> policies(mesh);
    collapse_edges(mesh, mesh.points(), mesh.number_of_vertices(), limits, policies);
    return to_flat_mesh(mesh, parameters::default_values(), "simplified", "mesh");
  };
  Mesh mesh;
  add_flat_mesh(centred, mesh, parameters::default_values());
  Flat_mesh simple = simplify(mesh);
  const auto holes = small_holes(mesh, mesh.points(), largest_hole);
  constexpr std::size_t least_on_border = 3;
  if (2 * least_on_border * holes.size() > simple.points.size()) {
    fill_holes(mesh, mesh.points(), holes);
    simple = simplify(std::move(mesh));
  }
  for (Vector& p : simple.points) p += centre;
  return simple;
}

CGAL_CRUDE_REGISTRATION_INLINE std::shared_ptr<const Simplified_scan>
simplify_flat_scan(const Flat_mesh& dense, const Flat_sensor& sensor, const Flat_range_image* image,
                   const Reduced_scan& scan, const Simplification_options& options, Run_control& control)
{
  control.check();
  const double s = image ? sampling(*image, control).distance : median_edge_length(dense);
  const Vector extent = image ? extent_of_image(*image, dense) : extent_of_mesh(dense, sensor);
  Simplification_limits limits;
  limits.control = &control;
  limits.number_of_vertices = options.number_of_vertices.value_or(0);
  limits.mean_squared_distance = (std::numeric_limits<double>::max)();
  if (options.approximation_error) limits.mean_squared_distance = *options.approximation_error;
  else if (!options.number_of_vertices)
    limits.mean_squared_distance = approximation_error(s, (std::max)(extent.x(), extent.y()), percent_smooth(dense));
  // What is no further apart than samples are joined.
  const Flat_mesh simple = simplified(dense, options.cell_size, default_maximum_edge_ratio * s, limits);
  control.check();

  auto result = std::make_shared<Simplified_scan>();
  // The neighbourhood that describes a vertex: what is left of the noise of a scan in a fit over some hundred samples
  // does not hide the shape.
  result->description_radius = 10 * scan.spacing;
  result->vertices = matching_vertices(simple, dense, vertex_normals(dense), result->description_radius);
  for (Vector& p : result->vertices.points) p = scan.own_from_input(p);
  for (Vector& n : result->vertices.normals) n = scan.own_from_input.rotation * n;
  result->spacing = median_edge_length(simple);
  result->extent = extent.sum() / 3;
  return result;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_SIMPLIFY_FLAT_SCAN_IMPL_H
