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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MESH_TO_FLAT_POINTS_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MESH_TO_FLAT_POINTS_H

// The door from ranges of points to flat arrays.

#include <CGAL/Crude_registration/internal/base/Run_control.h>
#include <CGAL/Crude_registration/internal/mesh/to_flat_mesh.h>

#include <CGAL/property_map.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// `function` and `argument` name the caller and its argument in the text of what is thrown: std::invalid_argument for a
// coordinate that is not finite, a size that cannot be computed with, more than 2^31 - 1 points; Run_control::Stopped.
template <class PointRange, class PointMap>
std::vector<Vector> to_flat_points(const PointRange& points, const PointMap& point_map, const std::string& function,
                                   const std::string& argument, Run_control& control = to_the_end())
{
  std::vector<Vector> result;
  for (const auto& element : points) {
    control.check(result.size());
    result.push_back(to_vector(get(point_map, element)));
    if (!result.back().allFinite())
      throw std::invalid_argument(function + ": point " + std::to_string(result.size() - 1) + " of " + argument +
                                  " has a coordinate that is not finite");
    if (result.size() > static_cast<std::size_t>((std::numeric_limits<std::int32_t>::max)()))
      throw std::invalid_argument(function + ": " + argument + " has more than 2^31 - 1 points");
  }
  check_size(result, function, argument);
  return result;
}

// The same of the normals of `n` points, or of none: an empty range.
template <class NormalRange>
std::vector<Vector> to_flat_normals(const NormalRange& normals, std::size_t n, const std::string& function,
                                    const std::string& argument, Run_control& control = to_the_end())
{
  std::vector<Vector> result;
  for (const auto& normal : normals) {
    control.check(result.size());
    result.push_back(to_vector(normal));
    if (!result.back().allFinite())
      throw std::invalid_argument(function + ": normal " + std::to_string(result.size() - 1) + " of " + argument +
                                  " has a coordinate that is not finite");
  }
  if (!result.empty() && result.size() != n)
    throw std::invalid_argument(function + ": " + argument + " has " + std::to_string(n) + " points, but " +
                                std::to_string(result.size()) + " normals");
  return result;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MESH_TO_FLAT_POINTS_H
