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

#include <CGAL/Crude_registration/internal/lookup/Point_grid.h>
#include <CGAL/Crude_registration/internal/mesh/mesh_geometry.h>

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
    double a = 0, b = 0, c = 0, r0 = 0, r1 = 0, r2 = 0;
    for (std::int32_t j : found) {
      if (!(dense_normals[std::size_t(j)].dot(near_normal) > 0)) continue;
      const Vector x = dense.points[std::size_t(j)] - centre - mean_point;
      const Vector y = dense_normals[std::size_t(j)] - mean_normal;
      const double xu = x.dot(u), xv = x.dot(v), yu = y.dot(u), yv = y.dot(v);
      a += xu * xu;
      b += xu * xv;
      c += xv * xv;
      r0 += xu * yu;
      r1 += xu * yv + xv * yu;
      r2 += xv * yv;
    }
    // [a b 0; b a+c b; 0 b c] (uu, uv, vv)^T = r; a neighbourhood on one line determines no form.
    const double minor = a * c - b * b, trace = a + c;
    if (!(minor > 1e-6 * trace * trace)) continue;
    const double scale = 1 / (trace * minor);
    const double uu = ((minor + c * c) * r0 - b * c * r1 + b * b * r2) * scale;
    const double uv = (a * c * r1 - b * (c * r0 + a * r2)) * scale;
    const double vv = ((minor + a * a) * r2 - a * b * r1 + b * b * r0) * scale;
    const double mean = (uu + vv) / 2, deviation = std::hypot((uu - vv) / 2, uv);
    result.normals[i] = normal;
    result.minimum_curvatures[i] = mean - deviation;
    result.maximum_curvatures[i] = mean + deviation;
    result.inside[i] = !borders[i];
  }
  return result;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_MATCHING_VERTICES_H
