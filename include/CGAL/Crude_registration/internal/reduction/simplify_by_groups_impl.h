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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_SIMPLIFY_BY_GROUPS_IMPL_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_SIMPLIFY_BY_GROUPS_IMPL_H

// The grouping and the collapse of simplify_by_groups.h.

#include <CGAL/Crude_registration/internal/mesh/add_flat_mesh.h>
#include <CGAL/Crude_registration/internal/mesh/mesh_geometry.h>
#include <CGAL/Crude_registration/internal/mesh/to_flat_mesh.h>
#include <CGAL/Crude_registration/internal/reduction/collapse_edges.h>
#include <CGAL/Crude_registration/internal/reduction/group_by_cells.h>
#include <CGAL/Crude_registration/internal/reduction/scan_frame.h>
#include <CGAL/Crude_registration/internal/reduction/simplify_by_groups.h>
#include <CGAL/Crude_registration/named_parameters.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh/Surface_mesh.h>

#include <limits>

namespace CGAL {
namespace Crude_registration {
namespace internal {

CGAL_CRUDE_REGISTRATION_INLINE Flat_mesh simplify_by_groups(Flat_mesh mesh, double cell,
                                                            const Simplification_limits& limits)
{
  using Point = CGAL::Simple_cartesian<double>::Point_3;
  // Relative to the centre of the box first: far from the origin a rotation would cost digits.
  const Rigid_motion frame = scan_frame(mesh);
  const Vector centre = centre_of_box(mesh.points), new_centre = frame(centre);
  for (Vector& p : mesh.points) p = frame.rotation * (p - centre) + new_centre;

  // Half of the error that is allowed is left to the collapse, which then leaves as many vertices as from the smallest
  // groups. Where a number of vertices stops it, the error is not known before.
  const bool is_error_known =
      limits.number_of_vertices == 0 && limits.mean_squared_distance < (std::numeric_limits<double>::max)();
  const Grouped_mesh groups =
      group_by_cells(mesh, cell, is_error_known ? limits.mean_squared_distance / 2 : 0, *limits.control);
  CGAL::Surface_mesh<Point> surface;
  add_flat_mesh(groups.mesh, surface, parameters::default_values());
  const Given_quadrics_policies<CGAL::Surface_mesh<Point>, CGAL::Simple_cartesian<double>> policies(surface,
                                                                                                    groups.quadrics);
  collapse_edges(surface, surface.points(), groups.mesh.points.size(), limits, policies);
  mesh = to_flat_mesh(surface, parameters::default_values(), "simplify_scan", "mesh");
  for (Vector& p : mesh.points) p = frame.rotation.transpose() * (p - new_centre) + centre;
  return mesh;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_SIMPLIFY_BY_GROUPS_IMPL_H
