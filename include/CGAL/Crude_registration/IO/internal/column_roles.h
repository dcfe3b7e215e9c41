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

#ifndef CGAL_CRUDE_REGISTRATION_IO_INTERNAL_COLUMN_ROLES_H
#define CGAL_CRUDE_REGISTRATION_IO_INTERNAL_COLUMN_ROLES_H

// Tells what three columns behind those of points are: normals, colours or neither.

#include <CGAL/Crude_registration/IO/internal/Flat_scan_file.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

enum Column_role
{
  OTHER_COLUMNS,
  NORMAL_COLUMNS,
  COLOR_COLUMNS
};

// Normals are unit vectors, or null where a point has none; colours whole numbers from 0 to 255.
inline Column_role role_of_columns(const std::vector<Vector>& columns)
{
  constexpr double rounding = 0.01; // of a unit vector that is written with two decimals
  bool are_units = true, are_colors = true, any = false;
  for (const Vector& v : columns) {
    const bool is_none = !v.allFinite() || v.isZero(0);
    are_units = are_units && (is_none || std::abs(v.norm() - 1) <= rounding);
    are_colors =
        are_colors && v.allFinite() && v.minCoeff() >= 0 && v.maxCoeff() <= 255 && v == Vector(v.array().floor());
    any = any || !is_none;
  }
  return !any ? OTHER_COLUMNS : are_units ? NORMAL_COLUMNS : are_colors ? COLOR_COLUMNS : OTHER_COLUMNS;
}

// Takes three columns, one row a point, for what all of them are, unless the scan has that already. Says what they are
// now.
inline Column_role take_columns(std::vector<Vector>&& columns, Flat_scan_file& scan)
{
  const Column_role role = role_of_columns(columns);
  if (role == NORMAL_COLUMNS && scan.normals.empty()) {
    for (Vector& v : columns) v = unit_normal(v);
    scan.normals = std::move(columns);
    scan.notes.push_back("Three columns behind the points are unit vectors, and read as normals.");
    return role;
  }
  if (role == COLOR_COLUMNS && scan.colors.empty()) {
    scan.colors.reserve(columns.size());
    for (const Vector& v : columns)
      scan.colors.push_back({part_of_color(v[0], 255), part_of_color(v[1], 255), part_of_color(v[2], 255)});
    scan.notes.push_back("Three columns behind the points are whole numbers from 0 to 255, and kept as colours.");
    return role;
  }
  return OTHER_COLUMNS;
}

// Takes what columns are named to be: shares, bytes or numbers of 16 bits, by the largest one. No colours where there
// are other values.
inline void take_named_colors(const std::vector<Vector>& parts, Flat_scan_file& scan)
{
  constexpr double byte = 255, word = 65535;
  double largest = 0;
  bool are_whole = true;
  for (const Vector& v : parts) {
    if (!v.allFinite() || v.minCoeff() < 0) return;
    largest = (std::max)(largest, v.maxCoeff());
    are_whole = are_whole && v == Vector(v.array().floor());
  }
  if (largest > word) return;
  const double white = largest > byte ? word : largest > 1 || are_whole ? byte : 1;
  scan.colors.reserve(parts.size());
  for (const Vector& v : parts)
    scan.colors.push_back({part_of_color(v[0], white), part_of_color(v[1], white), part_of_color(v[2], white)});
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_INTERNAL_COLUMN_ROLES_H
