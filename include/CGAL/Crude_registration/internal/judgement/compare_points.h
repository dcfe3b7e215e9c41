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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_COMPARE_POINTS_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_COMPARE_POINTS_H

// What points of one reduced scan meet where another one lies.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/internal/base/compiled.h>
#include <CGAL/Crude_registration/internal/reduction/Reduced_scan.h>

#include <limits>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// As Compared_point describes it.
struct Met_surface
{
  double distance = (std::numeric_limits<double>::infinity)();
  Vector normal = Vector::Zero();
  bool is_in_free_space = false;
};

// `motion` maps from the frame of the input of `from`, that of the points, to that of `to`.
std::vector<Met_surface> compare_points(const std::vector<Vector>& points, const Reduced_scan& from,
                                        const Reduced_scan& to, const Rigid_motion& motion);

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#ifndef CGAL_CRUDE_REGISTRATION_COMPILED
#include <CGAL/Crude_registration/internal/judgement/compare_points_impl.h>
#endif

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_COMPARE_POINTS_H
