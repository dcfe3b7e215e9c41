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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_NEAREST_SURFEL_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_NEAREST_SURFEL_H

// Surfels as a target of Point_to_plane: the plane of the nearest one.

#include <CGAL/Crude_registration/internal/lookup/Surfel_field.h>
#include <CGAL/Crude_registration/internal/motion/Surface_point.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

struct Nearest_surfel
{
  const std::vector<Surfel>& surfels;
  const Surfel_field& field;
  double spacing; // a surfel stands for the surface as far as `beyond` times this

  static constexpr double beyond = 1.2;

  bool closest(const Vector& query, double reach, Surface_point& answer) const
  {
    const int i = field.nearest(query.cast<float>());
    if (i < 0) return false;
    const Surfel& s = surfels[std::size_t(i)];
    const Vector n = s.normal.cast<double>(), d = query - s.position.cast<double>();
    const double height = n.dot(d);
    const double aside = (d - height * n).norm();
    if (std::abs(height) > reach || aside > beyond * spacing) return false;
    answer = {query - height * n, n, false};
    return true;
  }
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_NEAREST_SURFEL_H
