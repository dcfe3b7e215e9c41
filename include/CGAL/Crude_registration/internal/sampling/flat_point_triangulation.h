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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_FLAT_POINT_TRIANGULATION_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_FLAT_POINT_TRIANGULATION_H

// The door to the triangulation of points without a grid.

#include <CGAL/Crude_registration/internal/base/Flat_sensor.h>
#include <CGAL/Crude_registration/internal/base/Run_control.h>
#include <CGAL/Crude_registration/internal/base/compiled.h>
#include <CGAL/Crude_registration/internal/mesh/Flat_mesh.h>

#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// As triangulate_points() describes it. \throws Run_control::Stopped
Flat_mesh flat_triangulation(const std::vector<Vector>& points, const Flat_sensor& sensor, double maximum_edge_ratio,
                             Run_control& control = to_the_end());

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#ifndef CGAL_CRUDE_REGISTRATION_COMPILED
#include <CGAL/Crude_registration/internal/sampling/flat_point_triangulation_impl.h>
#endif

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_FLAT_POINT_TRIANGULATION_H
