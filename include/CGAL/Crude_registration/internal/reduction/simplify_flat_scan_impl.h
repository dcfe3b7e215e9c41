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
#include <CGAL/Crude_registration/internal/mesh/mesh_geometry.h>
#include <CGAL/Crude_registration/internal/mesh/to_flat_mesh.h>
#include <CGAL/Crude_registration/internal/reduction/Matching_vertices.h>
#include <CGAL/Crude_registration/internal/reduction/measure_scan.h>
#include <CGAL/Crude_registration/internal/reduction/simplify_flat_scan.h>
#include <CGAL/Crude_registration/reduction/simplify_scan.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The paper's approximation error of a scan.
inline double error_of_scan(const Flat_mesh& dense, const Flat_sensor& sensor, const Flat_range_image* image)
{
  const double s = image ? sampling(*image).distance : median_edge_length(dense);
  const Vector extent = image ? extent_of_image(*image, dense) : extent_of_mesh(dense, sensor);
  return approximation_error(s, (std::max)(extent.x(), extent.y()), percent_smooth(dense));
}

CGAL_CRUDE_REGISTRATION_INLINE std::shared_ptr<const Simplified_scan>
simplify_flat_scan(const Flat_mesh& dense, const Flat_sensor& sensor, const Flat_range_image* image,
                   const Reduced_scan& scan, const Simplification_options& options, Run_control& control)
{
  control.check();
  CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3> mesh;
  add_flat_mesh(dense, mesh, parameters::default_values());
  const auto stop_at = [&](double error, std::size_t number) {
    simplify_scan(mesh, parameters::approximation_error(error).number_of_vertices(number));
  };
  const std::size_t number = options.number_of_vertices.value_or(0);
  if (options.approximation_error) stop_at(*options.approximation_error, number);
  else if (options.number_of_vertices) stop_at((std::numeric_limits<double>::max)(), number);
  else stop_at(error_of_scan(dense, sensor, image), 0);
  control.check();
  mesh.collect_garbage();
  const Flat_mesh simplified = to_flat_mesh(mesh, parameters::default_values(), "simplify_flat_scan", "mesh");

  auto result = std::make_shared<Simplified_scan>();
  // The neighbourhood that describes a vertex: what is left of the noise of a scan in a fit over some hundred samples
  // does not hide the shape.
  result->description_radius = 10 * scan.spacing;
  result->vertices = matching_vertices(simplified, dense, vertex_normals(dense), result->description_radius);
  for (Vector& p : result->vertices.points) p = scan.own_from_input(p);
  for (Vector& n : result->vertices.normals) n = scan.own_from_input.rotation * n;
  result->spacing = median_edge_length(simplified);
  return result;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_SIMPLIFY_FLAT_SCAN_IMPL_H
