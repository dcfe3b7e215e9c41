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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_CORRESPONDENCE_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_CORRESPONDENCE_H

// Which points of two scans gave a motion.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>

#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Points of the source, each with the point of the target that it was matched with; each in the frame of its scan.
using Correspondence = std::vector<std::pair<Vector, Vector>>;

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_CORRESPONDENCE_H
