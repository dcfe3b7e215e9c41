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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_LEAST_SQUARES_MOTION_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_LEAST_SQUARES_MOTION_H

// The rigid motion of corresponding points.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/internal/base/compiled.h>

#include <cstddef>
#include <optional>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The motion that minimises sum_i weights[i] |motion(source[i]) - target[i]|^2 over i < n, all weights 1 where
// `weights` is null: Kabsch 1976, with the sign of Umeyama 1991 (eq. 40-43, scale 1) that keeps the rotation proper.
// Empty where the pairs do not determine it; see rigid_motion().
std::optional<Rigid_motion> least_squares_motion(const Vector* source, const Vector* target, const double* weights,
                                                 std::size_t n);

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#ifndef CGAL_CRUDE_REGISTRATION_COMPILED
#include <CGAL/Crude_registration/internal/motion/least_squares_motion_impl.h>
#endif

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_LEAST_SQUARES_MOTION_H
