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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_CLASSIFY_VERTICES_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_CLASSIFY_VERTICES_H

// How many vertices of a mesh are of each surface type.

#include <CGAL/Crude_registration/internal/mesh/Flat_mesh.h>
#include <CGAL/Crude_registration/internal/reduction/Curvature_tensors.h>
#include <CGAL/Crude_registration/reduction/Surface_type.h>

#include <cmath>
#include <cstddef>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Above this radius of curvature, as a multiple of the mesh's size, a surface counts as flat: far above the curvatures
// that the rounding of double gives the vertices of a plane, far below what noise gives those of a scan.
constexpr double flat_radius = 1e6;

// The curvature at most which a surface of this mesh counts as flat. The size is twice the root mean square distance of
// the vertices from their centroid: it does not depend on the frame.
inline double flat_curvature(const Flat_mesh& mesh)
{
  if (mesh.points.empty()) return 0;
  const auto n = double(mesh.points.size());
  const Vector& reference = mesh.points.front();
  Vector mean = Vector::Zero();
  for (const Vector& p : mesh.points) mean += p - reference;
  mean /= n;
  double squares = 0;
  for (const Vector& p : mesh.points) squares += (p - reference - mean).squaredNorm();
  return squares > 0 ? 1 / (flat_radius * 2 * std::sqrt(squares / n)) : 0;
}

// Vertices without a face of positive area do not count.
inline Surface_type_counts count_surface_types(const Curvature_field& field, double tolerance)
{
  Surface_type_counts counts;
  for (std::size_t i = 0; i < field.tensors.size(); ++i)
    if (field.areas[i] > 0) counts.add(surface_type(field.tensors[i].minimum(), field.tensors[i].maximum(), tolerance));
  return counts;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_CLASSIFY_VERTICES_H
