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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_SIMPLIFY_BY_GROUPS_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_SIMPLIFY_BY_GROUPS_H

// The simplification of a mesh as arrays by grouping and edge collapse.

#include <CGAL/Crude_registration/internal/base/compiled.h>
#include <CGAL/Crude_registration/internal/mesh/Flat_mesh.h>
#include <CGAL/Crude_registration/internal/reduction/Simplification_limits.h>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Simplifies by grouping and collapse, whatever the type of the mesh that comes and goes. The grid of cells lies in the
// scan's own frame, with which it moves. \throws Run_control::Stopped
Flat_mesh simplify_by_groups(Flat_mesh mesh, double cell, const Simplification_limits& limits);

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#ifndef CGAL_CRUDE_REGISTRATION_COMPILED
#include <CGAL/Crude_registration/internal/reduction/simplify_by_groups_impl.h>
#endif

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_SIMPLIFY_BY_GROUPS_H
