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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_MATCHING_VERTICES_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_MATCHING_VERTICES_H

// Describes the vertices of a simplified mesh by the dense mesh around them.

#include <CGAL/Crude_registration/internal/lookup/Point_grid.h>
#include <CGAL/Crude_registration/internal/mesh/mesh_geometry.h>
#include <CGAL/Crude_registration/internal/reduction/Curvature_tensors.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// What the search knows of the vertices of a simplified mesh. `normals` are unit, or zero where the surface around a
// vertex says nothing (such a vertex takes no part); `inside` is 1 for a described vertex off the border.
struct Matching_vertices
{
  std::vector<Vector> points;
  std::vector<Vector> normals;
  std::vector<double> minimum_curvatures;
  std::vector<double> maximum_curvatures;
  std::vector<std::uint8_t> inside;
};

// Describes the vertices of a simplified mesh by the dense mesh it came from, within `radius` of each: the mean normal,
// and the curvatures of the one second fundamental form that explains the differences of all normals in the
// neighbourhood best in the least squares sense. That is equation 6 of Rusinkiewicz (3DPVT 2004) over a neighbourhood
// in place of a face: at scan resolution the curvature of a face is mostly noise, and an average of noisy tensors is
// pulled by those at the border, which one fit is not. Time proportional to the samples in all neighbourhoods.
inline Matching_vertices matching_vertices(const Flat_mesh& simplified, const Flat_mesh& dense,
                                           const std::vector<Vector>& dense_normals, double radius)
{
  const std::size_t n = simplified.points.size();
  Matching_vertices result;
  result.points = simplified.points;
  result.normals.assign(n, Vector::Zero());
  result.minimum_curvatures.assign(n, 0);
  result.maximum_curvatures.assign(n, 0);
  result.inside.assign(n, 0);

  const std::vector<std::uint8_t> borders = border_flags(simplified);
  const Point_grid grid(dense.points, radius / 2);
  std::vector<std::int32_t> found;
  for (std::size_t i = 0; i < n; ++i) {
    const Vector& centre = simplified.points[i];
    found.clear();
    std::int32_t nearest = -1;
    double least = (std::numeric_limits<double>::infinity)();
    grid.for_each_within(centre, radius, [&](std::int32_t j, double d) {
      if (dense_normals[std::size_t(j)].isZero(0)) return;
      found.push_back(j);
      if (d < least || (d == least && j < nearest)) {
        least = d;
        nearest = j;
      }
    });
    if (nearest < 0) continue;
    // The other side of a thin part is not the neighbourhood.
    const Vector& near_normal = dense_normals[std::size_t(nearest)];
    Vector mean_point = Vector::Zero(), mean_normal = Vector::Zero();
    double count = 0;
    for (std::int32_t j : found) {
      if (!(dense_normals[std::size_t(j)].dot(near_normal) > 0)) continue;
      mean_point += dense.points[std::size_t(j)] - centre;
      mean_normal += dense_normals[std::size_t(j)];
      ++count;
    }
    mean_point /= count;
    mean_normal /= count;
    const Vector normal = unit_or_zero(mean_normal);
    if (normal.isZero(0)) continue;
    const Vector u = normal.unitOrthogonal(), v = normal.cross(u);
    Second_fundamental_form_fit fit;
    for (std::int32_t j : found) {
      if (!(dense_normals[std::size_t(j)].dot(near_normal) > 0)) continue;
      const Vector x = dense.points[std::size_t(j)] - centre - mean_point;
      const Vector y = dense_normals[std::size_t(j)] - mean_normal;
      fit.add(x.dot(u), x.dot(v), y.dot(u), y.dot(v));
    }
    // A neighbourhood on one line determines no form.
    if (!(fit.minor() > 1e-6 * fit.trace() * fit.trace())) continue;
    const Curvature_tensor form = fit.solved(fit.minor());
    result.normals[i] = normal;
    result.minimum_curvatures[i] = form.minimum();
    result.maximum_curvatures[i] = form.maximum();
    result.inside[i] = !borders[i];
  }
  return result;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_MATCHING_VERTICES_H
