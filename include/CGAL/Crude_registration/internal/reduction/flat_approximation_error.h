// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_FLAT_APPROXIMATION_ERROR_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_FLAT_APPROXIMATION_ERROR_H

// The paper's approximation error of a mesh, and the extent that it is made of.

#include <CGAL/Crude_registration/internal/mesh/mesh_geometry.h>
#include <CGAL/Crude_registration/internal/reduction/Curvature_tensors.h>
#include <CGAL/Crude_registration/internal/reduction/scan_frame.h>
#include <CGAL/Crude_registration/named_parameters.h>
#include <CGAL/Crude_registration/reduction/surface_types.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The sampling distance, the surface types and the extent put together: section 4 of the paper. A scan without any
// smooth vertex would have no finite error; below one per cent the share of smooth vertices counts as one per cent.
inline double approximation_error(double sampling_distance, double image_size, double percent_smooth)
{
  return 0.15 * sampling_distance * image_size / (std::max)(percent_smooth, 1.0);
}

// The direction from the sensor into the scene that the parameters give; null if none.
template <class NamedParameters>
Vector given_viewing_direction([[maybe_unused]] const Flat_mesh& mesh, [[maybe_unused]] const NamedParameters& np,
                               [[maybe_unused]] const std::string& function)
{
  Vector direction = Vector::Zero();
  if constexpr (is_given<NamedParameters, internal_np::viewing_direction_t>) {
    const auto d = parameter(np, internal_np::viewing_direction, 0);
    direction = unit_or_zero(Vector(to_double(d.x()), to_double(d.y()), to_double(d.z())));
    if (!direction.allFinite() || direction.isZero(0))
      throw std::invalid_argument(function + ": viewing_direction is null or not finite");
  } else if constexpr (is_given<NamedParameters, internal_np::viewpoint_t>) {
    const auto p = parameter(np, internal_np::viewpoint, 0);
    const Vector viewpoint(to_double(p.x()), to_double(p.y()), to_double(p.z()));
    if (!viewpoint.allFinite()) throw std::invalid_argument(function + ": viewpoint is not finite");
    // To the centroid of the surface, where scan_frame() has its origin. At the viewpoint: no direction.
    direction = unit_or_zero(scan_frame(mesh).inverse().translation - viewpoint);
  }
  return direction;
}

// The extent in the frame of the scan, along its axes x, y and z.
template <class NamedParameters>
Vector extent_in_own_frame(const Flat_mesh& mesh, const NamedParameters& np, const std::string& function)
{
  return extent_in_frame(mesh, scan_frame(mesh, given_viewing_direction(mesh, np, function)));
}

template <class NamedParameters>
double approximation_error(const Flat_mesh& mesh, const NamedParameters& np, const std::string& function)
{
  const double s = positive_parameter(np, internal_np::sampling_distance,
                                      // An empty or degenerate mesh has an error of 0.
                                      (std::max)(median_edge_length(mesh), (std::numeric_limits<double>::min)()),
                                      function.c_str(), "sampling_distance");
  const Vector extent = extent_in_own_frame(mesh, np, function);
  return approximation_error(s, (std::max)(extent.x(), extent.y()),
                             count_surface_types(curvature_tensors(mesh), flat_curvature(mesh)).percent_smooth());
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_FLAT_APPROXIMATION_ERROR_H
