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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_CURVATURE_TENSORS_IMPL_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_CURVATURE_TENSORS_IMPL_H

// The curvature tensors of a mesh, as of Rusinkiewicz 2004.

#include <CGAL/Crude_registration/internal/mesh/mesh_geometry.h>
#include <CGAL/Crude_registration/internal/reduction/Curvature_average.h>
#include <CGAL/Crude_registration/internal/reduction/Curvature_tensors.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The parts of a face that are nearest to each of its corners: from the barycentric coordinates of the circumcentre,
// cut off where that is outside (Meyer et al., "Discrete differential-geometry operators for triangulated 2-manifolds",
// 2003). Edge i is opposite to corner i, none is null.
inline std::array<double, 3> nearest_parts(const std::array<Vector, 3>& edge, double area)
{
  std::array<double, 3> length2, dot, part; // dot: of the two edges at a corner, away from it
  for (std::size_t i = 0; i < 3; ++i) {
    length2[i] = edge[i].squaredNorm();
    dot[i] = -edge[(i + 1) % 3].dot(edge[(i + 2) % 3]);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (dot[i] > 0) continue;
    // dot[j] = length2[k] - dot[i], a sum of positive numbers: the dot product itself can be rounded to 0 on a needle.
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    part[j] = 0.25 * area * length2[k] / (length2[k] - dot[i]);
    part[k] = 0.25 * area * length2[j] / (length2[j] - dot[i]);
    part[i] = area - part[j] - part[k];
    return part;
  }
  const std::array<double, 3> b = {length2[0] * dot[0], length2[1] * dot[1], length2[2] * dot[2]};
  const double scale = 0.5 * area / (b[0] + b[1] + b[2]);
  return {scale * (b[1] + b[2]), scale * (b[2] + b[0]), scale * (b[0] + b[1])};
}

CGAL_CRUDE_REGISTRATION_INLINE Curvature_field curvature_tensors(const Flat_mesh& mesh, std::vector<Vector> normals)
{
  Curvature_field field;
  field.tensors.resize(mesh.points.size());
  field.areas.assign(mesh.points.size(), 0.0);

  for (const auto& f : mesh.faces) {
    const std::array<std::size_t, 3> corner = {std::size_t(f[0]), std::size_t(f[1]), std::size_t(f[2])};
    // A normal is zero where faces cancel.
    if (normals[corner[0]].isZero(0) || normals[corner[1]].isZero(0) || normals[corner[2]].isZero(0)) continue;
    // Edge i is opposite to corner i.
    std::array<Vector, 3> edge = {mesh.points[corner[2]] - mesh.points[corner[1]],
                                  mesh.points[corner[0]] - mesh.points[corner[2]],
                                  mesh.points[corner[1]] - mesh.points[corner[0]]};
    // In units of the longest edge, as products of six lengths follow; along it, as least cancels there on a needle.
    const double length = (std::max)({edge[0].norm(), edge[1].norm(), edge[2].norm()});
    if (!(length > 0) || !std::isfinite(length)) continue;
    for (Vector& e : edge) e /= length;
    const Vector cross = edge[0].cross(edge[1]);
    const double double_area = cross.norm();
    if (!(double_area > 0)) continue;
    const Vector n = cross / double_area;
    const Vector u = std::max_element(edge.begin(), edge.end(), [](const Vector& e, const Vector& g) {
                       return e.squaredNorm() < g.squaredNorm();
                     })->normalized();
    const Vector v = n.cross(u);

    Second_fundamental_form_fit fit;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector dn = normals[corner[(i + 2) % 3]] - normals[corner[(i + 1) % 3]];
      fit.add(edge[i].dot(u), edge[i].dot(v), dn.dot(u), dn.dot(v));
    }
    // As the edges sum to zero, written so nothing cancels.
    const double minor = 3 * double_area * double_area;
    if (!std::isfinite(1 / (fit.trace() * minor))) continue;
    const Curvature_tensor form = fit.solved(minor) / length;

    const std::array<double, 3> part = nearest_parts(edge, 0.5 * double_area * length * length);
    for (std::size_t i = 0; i < 3; ++i) {
      Curvature_tensor rotated;
      if (!rotate_tensor(form, u, n, normals[corner[i]], rotated)) continue;
      field.tensors[corner[i]] += part[i] * rotated;
      field.areas[corner[i]] += part[i];
    }
  }
  for (std::size_t i = 0; i < field.tensors.size(); ++i)
    if (field.areas[i] > 0) field.tensors[i] = field.tensors[i] / field.areas[i];
  field.normals = std::move(normals);
  return field;
}

CGAL_CRUDE_REGISTRATION_INLINE Curvature_field curvature_tensors(const Flat_mesh& mesh)
{
  return curvature_tensors(mesh, vertex_normals(mesh));
}

CGAL_CRUDE_REGISTRATION_INLINE std::vector<Curvature_tensor>
average_tensors(const Flat_mesh& mesh, const Curvature_field& field, double radius)
{
  const Index_lists neighbours = neighbours_of_vertices(mesh);
  const std::vector<std::uint8_t> borders = border_flags(mesh);
  Curvature_average average(mesh, neighbours, field, borders);
  std::vector<Curvature_tensor> tensors(mesh.points.size());
  for (std::size_t i = 0; i < tensors.size(); ++i) tensors[i] = average(i, radius).tensor;
  return tensors;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_CURVATURE_TENSORS_IMPL_H
