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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_FLAT_POINT_TRIANGULATION_IMPL_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_FLAT_POINT_TRIANGULATION_IMPL_H

// The triangulation of points without a grid, behind its door.

#include <CGAL/Crude_registration/internal/sampling/Evened_points.h>
#include <CGAL/Crude_registration/internal/sampling/Projected_triangulation.h>
#include <CGAL/Crude_registration/internal/sampling/Surface_from_points.h>
#include <CGAL/Crude_registration/internal/sampling/flat_point_triangulation.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Each point once, where it is first: the spacing of points that are there many times would be that of the copies,
// none.
inline std::vector<Vector> without_copies(const std::vector<Vector>& points, Run_control& control)
{
  const std::vector<std::uint32_t> first = first_of_copies(points, control);
  std::vector<Vector> result;
  result.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    if (first[i] == i) result.push_back(points[i]);
  return result;
}

CGAL_CRUDE_REGISTRATION_INLINE Flat_mesh flat_triangulation(const std::vector<Vector>& points,
                                                            const Flat_sensor& sensor, double maximum_edge_ratio,
                                                            Run_control& control)
{
  if (sensor.kind == Flat_sensor::UNKNOWN)
    return Surface_from_points(without_copies(points, control), maximum_edge_ratio, control)();
  return Projected_triangulation(points, sensor, maximum_edge_ratio, control)();
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_FLAT_POINT_TRIANGULATION_IMPL_H
