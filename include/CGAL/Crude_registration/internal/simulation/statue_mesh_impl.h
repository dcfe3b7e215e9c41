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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_SIMULATION_STATUE_MESH_IMPL_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_SIMULATION_STATUE_MESH_IMPL_H

// The bodies of the simulation, behind their door.

#include <CGAL/Crude_registration/internal/simulation/Statue.h>
#include <CGAL/Crude_registration/internal/simulation/statue_mesh.h>

#include <cstdint>

namespace CGAL {
namespace Crude_registration {
namespace internal {

CGAL_CRUDE_REGISTRATION_INLINE Flat_mesh statue_mesh(std::uint64_t seed, int resolution)
{
  return Statue(seed).surface(resolution);
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_SIMULATION_STATUE_MESH_IMPL_H
