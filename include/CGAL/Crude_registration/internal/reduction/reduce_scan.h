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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_REDUCE_SCAN_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_REDUCE_SCAN_H

// The first step of a registration: a scan is reduced to the surfels and the free space that all later steps look at.

#include <CGAL/Crude_registration/internal/base/Flat_sensor.h>
#include <CGAL/Crude_registration/internal/base/Run_control.h>
#include <CGAL/Crude_registration/internal/base/compiled.h>
#include <CGAL/Crude_registration/internal/mesh/Flat_mesh.h>
#include <CGAL/Crude_registration/internal/reduction/Reduced_scan.h>
#include <CGAL/Crude_registration/internal/sampling/orient_points.h>

namespace CGAL {
namespace Crude_registration {
namespace internal {

struct Reduction_parameters
{
  double fine_surfels = 15000;
  double coarse_surfels = 1800;
  // Of a scan of few samples:
  double fewest_fine_surfels = 1000;
  double fewest_coarse_surfels = 500;
};

// Reduces a scan. The sensor is in the frame of the mesh; `seen`: all that it saw, in the same frame, or null for what
// is in the mesh. At a grazing angle samples are too far apart for a surface, and were seen all the same.
// A scan of fewer than four surfels cannot be registered; what it holds is prepared all the same.
// \throws Run_control::Stopped
Reduced_scan reduce_scan(const Flat_mesh& mesh, const Flat_sensor& sensor, const Reduction_parameters& parameters = {},
                         Run_control& control = to_the_end(), const std::vector<Vector>* seen = nullptr);

// The same of samples that no mesh joins.
Reduced_scan reduce_scan(const Oriented_points& points, const Flat_sensor& sensor,
                         const Reduction_parameters& parameters = {}, Run_control& control = to_the_end());

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#ifndef CGAL_CRUDE_REGISTRATION_COMPILED
#include <CGAL/Crude_registration/internal/reduction/reduce_scan_impl.h>
#endif

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_REDUCE_SCAN_H
