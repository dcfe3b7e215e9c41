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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_CURVATURE_TENSORS_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_CURVATURE_TENSORS_H

// Curvature tensors at the vertices of a mesh.

#include <CGAL/Crude_registration/internal/base/compiled.h>
#include <CGAL/Crude_registration/internal/mesh/Flat_mesh.h>
#include <CGAL/Crude_registration/internal/reduction/Curvature_tensor.h>

#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The curvature tensors of a mesh whose vertices have the given unit normals.
// S. Rusinkiewicz, "Estimating curvatures and their derivatives on triangle meshes", 3DPVT 2004, section 3: on each
// face the second fundamental form that explains the differences of the normals along the three edges best (least
// squares, equation 6), rotated into the tangent plane of each corner and averaged there by corner areas. Linear time.
// Faces without area and corners without a normal do not count. On a border the normals are one-sided and the tensors
// unreliable.
Curvature_field curvature_tensors(const Flat_mesh& mesh, std::vector<Vector> normals);

// The same, with the normals of the mesh.
Curvature_field curvature_tensors(const Flat_mesh& mesh);

// The average of the tensors of a field at each vertex, over the neighbourhood of the given radius.
std::vector<Curvature_tensor> average_tensors(const Flat_mesh& mesh, const Curvature_field& field, double radius);

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#ifndef CGAL_CRUDE_REGISTRATION_COMPILED
#include <CGAL/Crude_registration/internal/reduction/Curvature_tensors_impl.h>
#endif

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_CURVATURE_TENSORS_H
