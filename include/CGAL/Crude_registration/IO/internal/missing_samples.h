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

#ifndef CGAL_CRUDE_REGISTRATION_IO_INTERNAL_MISSING_SAMPLES_H
#define CGAL_CRUDE_REGISTRATION_IO_INTERNAL_MISSING_SAMPLES_H

// Takes out what files write where the sensor saw nothing: points that are NaN, infinite or at range zero.

#include <CGAL/Crude_registration/IO/IO_error.h>
#include <CGAL/Crude_registration/IO/internal/Flat_scan_file.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Does the point (0, 0, 0) stand for samples that are missing? Where the sensor is the origin, its distance is the
// least range, so no sample is there: it lies outside the box of the others. A point of a surface in another frame may
// be the origin, too; but then it stands there once, or as a copy of a point within the box.
inline bool origin_is_missing(const std::vector<Vector>& points)
{
  std::size_t origins = 0;
  Eigen::AlignedBox3d box;
  for (const Vector& p : points)
    if (p.isZero(0)) ++origins;
    else if (p.allFinite()) box.extend(p);
  return origins > 1 && !box.contains(Vector(Vector::Zero()));
}

// Takes points that are no samples out of points or of a range image, and counts them; `origin` says whether (0, 0, 0)
// is none. \throws IO_error where no sample is left
inline void take_out_missing(Flat_scan_file& scan, bool origin, const std::string& file)
{
  const std::size_t n = scan.points.size();
  std::vector<std::int32_t> new_index(scan.kind == Flat_scan_file::RANGE_IMAGE ? n : 0, -1);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vector p = scan.points[i];
    if (!p.allFinite() || (origin && p.isZero(0))) continue;
    if (!new_index.empty()) new_index[i] = static_cast<std::int32_t>(kept);
    scan.points[kept] = p;
    if (!scan.normals.empty()) scan.normals[kept] = scan.normals[i];
    if (!scan.colors.empty()) scan.colors[kept] = scan.colors[i];
    ++kept;
  }
  if (kept == 0)
    throw IO_error(file, n + scan.missing == 0 ? std::string("the file has no points")
                                               : "none of the " + std::to_string(n + scan.missing) +
                                                     " points is a sample: they are NaN, infinite or at range zero");
  scan.missing += n - kept;
  scan.points.resize(kept);
  if (!scan.normals.empty()) scan.normals.resize(kept);
  if (!scan.colors.empty()) scan.colors.resize(kept);
  for (std::int32_t& cell : scan.grid)
    if (cell >= 0) cell = new_index[static_cast<std::size_t>(cell)];
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_INTERNAL_MISSING_SAMPLES_H
