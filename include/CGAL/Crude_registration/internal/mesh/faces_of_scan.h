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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MESH_FACES_OF_SCAN_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MESH_FACES_OF_SCAN_H

// The door for meshes that are to be scans, and the sizes of scans that can be computed with.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/internal/base/Run_control.h>
#include <CGAL/Crude_registration/internal/mesh/Flat_mesh.h>
#include <CGAL/Crude_registration/internal/mesh/to_flat_mesh.h>
#include <CGAL/Crude_registration/internal/mesh/to_flat_points.h>

#include <CGAL/property_map.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Squares of lengths are computed in float. `name`: of the scan. \throws std::invalid_argument
inline void check_scan_size(const std::vector<Vector>& points, const std::string& name)
{
  constexpr double smallest = 1e-12, largest = 1e12;
  double size = 0;
  for (const Vector& p : points) size = (std::max)(size, (p - points.front()).norm());
  if (size > 0 && !(size > smallest && size < largest))
    throw std::invalid_argument(name + ": its size is not between 1e-12 and 1e12: another unit of length is needed");
}

// Readers of meshes pass over what is no face, and return what is left without a word.
template <class FaceGraph, class NamedParameters>
Flat_mesh faces_of_scan(const FaceGraph& mesh, const NamedParameters& np, const std::string& name, Run_control& control)
{
  Flat_mesh flat = to_flat_mesh(mesh, np, name, "it", control);
  if (flat.faces.empty())
    throw std::invalid_argument(name + " has no faces: a PLY file with a range grid, or with points alone, has none " +
                                "where CGAL::IO reads it as a mesh; read the file with read_scan(), and make the " +
                                "Scan of what it finds");
  return flat;
}

// The same of a polygon soup.
template <class Point>
Flat_mesh faces_of_scan(const std::vector<Point>& points, const std::vector<std::array<std::size_t, 3>>& triangles,
                        const std::string& name, Run_control& control)
{
  if (triangles.size() > static_cast<std::size_t>((std::numeric_limits<std::int32_t>::max)()))
    throw std::invalid_argument(name + ": it has more than 2^31 - 1 triangles");
  Flat_mesh flat;
  flat.points = to_flat_points(points, CGAL::Identity_property_map<Point>(), name, "it", control);
  flat.faces.reserve(triangles.size());
  for (const auto& t : triangles) {
    control.check(flat.faces.size());
    if (!((std::max)({t[0], t[1], t[2]}) < points.size()))
      throw std::invalid_argument(name + ": triangle " + std::to_string(flat.faces.size()) + " of it has the index " +
                                  std::to_string((std::max)({t[0], t[1], t[2]})) + ", but there are " +
                                  std::to_string(points.size()) + " points");
    flat.faces.push_back({std::int32_t(t[0]), std::int32_t(t[1]), std::int32_t(t[2])});
  }
  return flat;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MESH_FACES_OF_SCAN_H
