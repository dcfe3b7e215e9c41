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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_REDUCE_SCAN_IMPL_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_REDUCE_SCAN_IMPL_H

// The reduction of a scan, step by step.

#include <CGAL/Crude_registration/internal/lookup/Depth_buffer.h>
#include <CGAL/Crude_registration/internal/mesh/encloses_a_body.h>
#include <CGAL/Crude_registration/internal/mesh/mesh_geometry.h>
#include <CGAL/Crude_registration/internal/reduction/describe_surfels.h>
#include <CGAL/Crude_registration/internal/reduction/group_samples.h>
#include <CGAL/Crude_registration/internal/reduction/reduce_scan.h>
#include <CGAL/Crude_registration/internal/reduction/sample_surface.h>
#include <CGAL/Crude_registration/internal/reduction/scan_frame.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The mean direction in which a sensor looks at points; null if it is not known.
inline Vector mean_direction(const Flat_sensor& sensor, const std::vector<Vector>& points)
{
  if (sensor.kind == Flat_sensor::ORTHOGRAPHIC) return sensor.vector;
  Vector direction = Vector::Zero();
  if (sensor.kind == Flat_sensor::PERSPECTIVE)
    for (const Vector& p : points) direction += unit_or_zero(p - sensor.vector);
  return unit_or_zero(direction);
}

// A surface cuts about 1.5 cells of a cubic grid for each area of the square of their edge length.
inline double cell_of_surfels(double area, double number)
{
  return std::sqrt(1.5 * area / number);
}

// All that follows the samples of a surface of the given area. `scan` has its frame and its extent; `seen`: all that
// the sensor saw, or null for the samples; `has_edges`: see group_samples().
inline void reduce_samples(const Oriented_samples& samples, double area, const Flat_sensor& sensor,
                           const Vector& direction, const std::vector<Vector>* seen, bool has_edges,
                           const Reduction_parameters& parameters, Run_control& control, Reduced_scan& scan)
{
  const Rigid_motion& own = scan.own_from_input;
  // What is not a surface but dust takes larger cells, until the surfels can be numbered.
  const auto grouped = [&](const std::vector<Vector_f>& p, const std::vector<Vector_f>& n, const std::vector<float>& w,
                           float cell) {
    Surfel_level level = group_samples(p, n, w, cell, control, has_edges);
    while (level.surfels.size() > Surfel_field::maximum_size)
      level = group_samples(p, n, w, cell *= 1.5f, control, has_edges);
    return level;
  };
  scan.number_of_samples = samples.points.size();
  if (samples.points.empty()) return;
  scan.spacing = std::sqrt(area / double(samples.points.size()));
  // Cells of so many spacings leave some samples to be averaged; narrower ones where hardly a surfel would be left.
  const auto cell_of_samples = [&](double spacings, double fewest) {
    return (std::max)((std::min)(spacings * scan.spacing, cell_of_surfels(area, fewest)), scan.spacing);
  };
  const double fine =
      (std::max)(cell_of_samples(2, parameters.fewest_fine_surfels), cell_of_surfels(area, parameters.fine_surfels));
  const double coarse = (std::max)(cell_of_samples(3.5, parameters.fewest_coarse_surfels),
                                   cell_of_surfels(area, parameters.coarse_surfels));

  scan.fine = grouped(samples.points, samples.normals, {}, float(fine));
  std::vector<Vector_f> points, normals;
  points.reserve(scan.fine.surfels.size());
  normals.reserve(scan.fine.surfels.size());
  for (const Surfel& s : scan.fine.surfels) {
    points.push_back(s.position);
    normals.push_back(s.normal);
  }
  scan.coarse = grouped(points, normals, scan.fine.weights, float(coarse));
  control.check();
  describe_surfels(scan.coarse);
  scan.fine.field = Surfel_field(scan.fine.surfels, scan.fine.spacing, 1.6f * scan.fine.spacing);
  scan.coarse.field = Surfel_field(scan.coarse.surfels, 0.7f * scan.coarse.spacing, 2.f * scan.coarse.spacing);
  scan.fine.probes = choose_probes(scan.fine.surfels, 4000);
  scan.coarse.probes = choose_probes(scan.coarse.surfels, 600);
  measure_noise(scan.fine);
  measure_noise(scan.coarse);
  control.check();

  const float cell = float(2.2 * scan.spacing);
  const Matrix_f rotation = own.rotation.cast<float>();
  // The mean normal of a surface is not where it was seen from: free space along it would speak against right poses.
  if (sensor.kind != Flat_sensor::UNKNOWN) {
    std::vector<Vector_f> ends; // of the lines of sight
    if (seen != nullptr) {
      ends.reserve(seen->size());
      for (const Vector& p : *seen) ends.push_back(own(p).cast<float>());
    }
    scan.depths = Depth_buffer(sensor.kind, own(sensor.vector).cast<float>(), rotation * direction.cast<float>(),
                               seen != nullptr ? ends : samples.points, cell, control);
  }
}

CGAL_CRUDE_REGISTRATION_INLINE Reduced_scan reduce_scan(const Flat_mesh& mesh, const Flat_sensor& sensor,
                                                        const Reduction_parameters& parameters, Run_control& control,
                                                        const std::vector<Vector>* seen)
{
  Reduced_scan scan;
  const Vector direction = mean_direction(sensor, mesh.points);
  control.check();
  const std::vector<double> areas = face_areas(mesh, control);
  scan.own_from_input = scan_frame(mesh, areas, direction, control);
  const Vector size = extent_in_frame(mesh, scan.own_from_input, control);
  scan.extent = size.sum() / 3;
  const double area = std::accumulate(areas.begin(), areas.end(), 0.);
  if (!(area > 0)) return scan;
  const double distance = 0.5 * cell_of_surfels(area, parameters.fine_surfels);
  scan.is_body = sensor.kind == Flat_sensor::UNKNOWN && encloses_a_body(mesh, scan.own_from_input.rotation, control);
  const Oriented_samples samples = samples_of_faces(mesh, areas, scan.own_from_input, sensor, distance, control);
  reduce_samples(samples, area, sensor, direction, seen, false, parameters, control, scan);
  return scan;
}

CGAL_CRUDE_REGISTRATION_INLINE Reduced_scan reduce_scan(const Oriented_points& points, const Flat_sensor& sensor,
                                                        const Reduction_parameters& parameters, Run_control& control)
{
  Reduced_scan scan;
  const Vector direction = mean_direction(sensor, points.points);
  scan.own_from_input = scan_frame(points, direction, control);
  const Vector size = extent_in_frame(points, scan.own_from_input, control);
  scan.extent = size.sum() / 3;
  if (!(points.area > 0)) return scan;
  reduce_samples(samples_of_points(points, scan.own_from_input, control), points.area, sensor, direction, nullptr, true,
                 parameters, control, scan);
  return scan;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_REDUCE_SCAN_IMPL_H
