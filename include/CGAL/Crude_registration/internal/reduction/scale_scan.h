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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_SCALE_SCAN_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_SCALE_SCAN_H

// A reduced scan in another unit of length.

#include <CGAL/Crude_registration/internal/reduction/Reduced_scan.h>

#include <memory>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Curvatures of surfels are in spacings, as are the noises: they stay.
inline void scale_level(float factor, Surfel_level& level)
{
  level.spacing *= factor;
  for (Surfel& s : level.surfels) {
    s.position *= factor;
    s.variance *= factor * factor;
  }
  level.field.scale(factor);
}

// What the reduction makes of the scan whose coordinates are multiplied by the factor, but for rounding.
inline Reduced_scan scaled(const Reduced_scan& scan, double factor)
{
  Reduced_scan result = scan;
  const float in_float = static_cast<float>(factor);
  result.own_from_input.translation *= factor;
  result.spacing *= factor;
  result.extent *= factor;
  scale_level(in_float, result.coarse);
  scale_level(in_float, result.fine);
  result.depths.scale(in_float);
  if (scan.simplified) {
    Simplified_scan simplified = *scan.simplified;
    for (Vector& p : simplified.vertices.points) p *= factor;
    for (double& c : simplified.vertices.minimum_curvatures) c /= factor;
    for (double& c : simplified.vertices.maximum_curvatures) c /= factor;
    simplified.spacing *= factor;
    simplified.extent *= factor;
    simplified.description_radius *= factor;
    result.simplified = std::make_shared<const Simplified_scan>(simplified);
  }
  return result;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_SCALE_SCAN_H
