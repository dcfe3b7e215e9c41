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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_SIMPLIFICATION_LIMITS_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_SIMPLIFICATION_LIMITS_H

// How far a simplification goes.

#include <CGAL/Crude_registration/internal/base/Run_control.h>

#include <cstddef>

namespace CGAL {
namespace Crude_registration {
namespace internal {

struct Simplification_limits
{
  double mean_squared_distance;   // the largest of a collapse
  std::size_t number_of_vertices; // to stop at
  Run_control* control = &to_the_end();
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_SIMPLIFICATION_LIMITS_H
