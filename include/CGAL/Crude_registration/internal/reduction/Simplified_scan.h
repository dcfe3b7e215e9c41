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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_SIMPLIFIED_SCAN_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_SIMPLIFIED_SCAN_H

// The simplified mesh of a scan, the S- or D-mesh of the paper, as the search for trihedra sees it.

#include <CGAL/Crude_registration/internal/reduction/Matching_vertices.h>

namespace CGAL {
namespace Crude_registration {
namespace internal {

struct Simplified_scan
{
  Matching_vertices vertices; // in the own frame of the reduced scan
  double spacing = 0;         // the median distance of neighbours
  double extent = 0;          // M of the paper: of a range image along the axes of its grid
  double description_radius = 0;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_SIMPLIFIED_SCAN_H
