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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_REFINE_FLAT_MOTION_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_REFINE_FLAT_MOTION_H

// The door to the refinement of a motion of one mesh to another.

#include <CGAL/Crude_registration/internal/base/compiled.h>
#include <CGAL/Crude_registration/internal/base/for_each_index.h>
#include <CGAL/Crude_registration/internal/mesh/Flat_mesh.h>
#include <CGAL/Crude_registration/internal/motion/Refinement.h>

#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// As refine_motion() describes it.
// \throws std::invalid_argument where a mesh has no face with an area
Refinement refine_flat_motion(const Flat_mesh& source, const Flat_mesh& target, const Rigid_motion& initial,
                              const Refinement_options& options, Execution execution);

// The rotation that is next to a matrix. \pre The determinant is above zero.
Matrix nearest_rotation(const Matrix& matrix);

// RMS distance of points from their mean.
double rms_radius(const std::vector<Vector>& points);

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#ifndef CGAL_CRUDE_REGISTRATION_COMPILED
#include <CGAL/Crude_registration/internal/motion/refine_flat_motion_impl.h>
#endif

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_REFINE_FLAT_MOTION_H
