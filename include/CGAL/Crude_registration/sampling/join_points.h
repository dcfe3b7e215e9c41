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

#ifndef CGAL_CRUDE_REGISTRATION_SAMPLING_JOIN_POINTS_H
#define CGAL_CRUDE_REGISTRATION_SAMPLING_JOIN_POINTS_H

// A surface through all points, of a scan or of an assembled model, that depends on the points alone.

#include <CGAL/Crude_registration/internal/base/compiled.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Crude_registration {
/*!
\ingroup PkgCrudeRegistrationRef

\brief joins points to a surface by the advancing front of `CGAL::Advancing_front_surface_reconstruction`, the same
triangles for the same points every time.

Where two edges of the front are equally good, CGAL takes the one that lies lower in memory, so that two runs of one
program may differ; here it is the one whose points come first. Faces are triples of indices of `points`; no side of the
surface is the outer one. Complexity: that of a Delaunay triangulation in space.

\param points finite; of equal points one is joined

\return the triangles, in ascending order, each from its least index on
*/
std::vector<std::array<std::size_t, 3>>
join_points(const std::vector<Exact_predicates_inexact_constructions_kernel::Point_3>& points);

} // namespace Crude_registration
} // namespace CGAL

#ifndef CGAL_CRUDE_REGISTRATION_COMPILED
#include <CGAL/Crude_registration/internal/sampling/join_points_impl.h>
#endif

#endif // CGAL_CRUDE_REGISTRATION_SAMPLING_JOIN_POINTS_H
