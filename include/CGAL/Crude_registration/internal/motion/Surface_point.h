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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_SURFACE_POINT_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_SURFACE_POINT_H

// What a surface answers to the question for its point closest to a query.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// A target of Point_to_plane is any object with
//   bool closest(const Vector& query, double reach, Surface_point& answer) const
// which returns false where nothing is within reach; it is asked by several threads at once under Parallel_tag.
struct Surface_point
{
  Vector point;
  Vector normal; // unit; zero where the surface has none
  bool is_on_border;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_SURFACE_POINT_H
