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

#ifndef CGAL_CRUDE_REGISTRATION_IO_INTERNAL_COLUMN_NORMALS_H
#define CGAL_CRUDE_REGISTRATION_IO_INTERNAL_COLUMN_NORMALS_H

// Tells whether three columns behind those of points are normals.

#include <CGAL/Crude_registration/IO/internal/Flat_scan_file.h>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Takes three columns as normals, one a point, if all of them that are there are unit vectors: colours are not, nor are
// other values.
inline void take_unit_columns(std::vector<Vector>&& columns, Flat_scan_file& scan)
{
  constexpr double rounding = 0.01; // of a unit vector that is written with two decimals
  bool any = false;
  for (Vector& v : columns) {
    if (v.allFinite() && !v.isZero(0)) {
      if (!(std::abs(v.norm() - 1) <= rounding)) return;
      any = true;
    }
    v = unit_normal(v);
  }
  if (!any) return;
  scan.normals = std::move(columns);
  scan.notes.push_back("The three columns behind the points are unit vectors, and read as normals.");
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_INTERNAL_COLUMN_NORMALS_H
