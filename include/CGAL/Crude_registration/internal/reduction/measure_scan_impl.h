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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_MEASURE_SCAN_IMPL_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_MEASURE_SCAN_IMPL_H

// The measures of measure_scan.h.

#include <CGAL/Crude_registration/internal/mesh/mesh_geometry.h>
#include <CGAL/Crude_registration/internal/reduction/Curvature_tensors.h>
#include <CGAL/Crude_registration/internal/reduction/classify_vertices.h>
#include <CGAL/Crude_registration/internal/reduction/measure_scan.h>
#include <CGAL/Crude_registration/internal/reduction/scan_frame.h>
#include <CGAL/Crude_registration/internal/sampling/flat_image_triangulation.h>
#include <CGAL/Crude_registration/internal/sampling/estimate_flat_sensor.h>

#include <cstddef>
#include <cstdint>
#include <utility>

namespace CGAL {
namespace Crude_registration {
namespace internal {

CGAL_CRUDE_REGISTRATION_INLINE Flat_range_mesh::Flat_range_mesh(Flat_range_image given) : image(std::move(given))
{
  if (image.sensor.kind == Flat_sensor::UNKNOWN) image.sensor = estimated_sensor(image);
  samples = sampling(image);
  mesh = flat_triangulation(image, samples);
}

// The direction from the sensor into the scene, at the centroid of the surface; null if it is not known, or the sensor
// is at the centroid.
inline Vector viewing_direction(const Flat_mesh& mesh, const Flat_sensor& sensor)
{
  if (sensor.kind == Flat_sensor::UNKNOWN) return Vector::Zero();
  // scan_frame() has its origin at the centroid.
  if (sensor.kind == Flat_sensor::ORTHOGRAPHIC) return sensor.vector;
  return unit_or_zero(sensor.towards(scan_frame(mesh).inverse().translation));
}

// The frame of the grid: z towards the sensor, x along the columns' mean direction in the image plane. `mesh`: the
// triangulation, whose own frame stands in for what the grid does not say.
inline Rigid_motion grid_frame(const Flat_range_image& image, const Flat_mesh& mesh)
{
  Rigid_motion own = scan_frame(mesh);
  const Vector centroid = own.inverse().translation;
  const Vector z = image.sensor.kind == Flat_sensor::UNKNOWN ? Vector(own.rotation.row(2))
                                                             : Vector(-unit_or_zero(image.sensor.towards(centroid)));
  if (z.isZero(0)) return own;
  Vector x = Vector::Zero();
  for (std::size_t row = 0; row < image.rows; ++row)
    for (std::size_t column = 0; column + 1 < image.columns; ++column) {
      const std::int32_t i = image.index(column, row), j = image.index(column + 1, row);
      if (i >= 0 && j >= 0) x += image.point(j) - image.point(i);
    }
  x = unit_or_zero(x - z * z.dot(x));
  return x.isZero(0) ? scan_frame(mesh, -z) : frame_of_axes(x, z, centroid);
}

CGAL_CRUDE_REGISTRATION_INLINE Vector extent_of_mesh(const Flat_mesh& mesh, const Flat_sensor& sensor)
{
  return extent_in_frame(mesh, scan_frame(mesh, viewing_direction(mesh, sensor)));
}

CGAL_CRUDE_REGISTRATION_INLINE Vector extent_of_image(const Flat_range_image& image, const Flat_mesh& mesh)
{
  return extent_in_frame(mesh, grid_frame(image, mesh));
}

CGAL_CRUDE_REGISTRATION_INLINE double percent_smooth(const Flat_mesh& mesh)
{
  return count_surface_types(curvature_tensors(mesh), flat_curvature(mesh)).percent_smooth();
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_MEASURE_SCAN_IMPL_H
