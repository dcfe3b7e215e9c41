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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_SIMULATION_STATUE_MESH_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_SIMULATION_STATUE_MESH_H

// The door to the bodies of the simulation.

#include <CGAL/Crude_registration/internal/base/compiled.h>
#include <CGAL/Crude_registration/internal/mesh/Flat_mesh.h>

#include <cstdint>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// As make_statue() describes it.
Flat_mesh statue_mesh(std::uint64_t seed, int resolution);

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#ifndef CGAL_CRUDE_REGISTRATION_COMPILED
#include <CGAL/Crude_registration/internal/simulation/statue_mesh_impl.h>
#endif

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_SIMULATION_STATUE_MESH_H
