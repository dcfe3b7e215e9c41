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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MESH_FLAT_MESH_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MESH_FLAT_MESH_H

// A triangle mesh as two flat arrays.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>

#include <array>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The triangle mesh of a stage's inside: what a FaceGraph is turned into at the door. Faces are counterclockwise seen
// from outside (from the sensor).
struct Flat_mesh
{
  std::vector<Vector> points;
  std::vector<std::array<std::int32_t, 3>> faces;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MESH_FLAT_MESH_H
