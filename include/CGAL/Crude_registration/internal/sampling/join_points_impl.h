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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_JOIN_POINTS_IMPL_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_JOIN_POINTS_IMPL_H

// The surface through points of join_points.h, by CGAL's advancing front.

#include <CGAL/Crude_registration/internal/base/Run_control.h>
#include <CGAL/Crude_registration/internal/sampling/advancing_front.h>
#include <CGAL/Crude_registration/sampling/join_points.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// What CGAL's front prefers where nobody tells it what: small circles.
struct Smallest_circle_first
{
  template <class Front, class Cell_handle>
  double operator()(const Front& front, Cell_handle& cell, int facet) const
  {
    return front.smallest_radius_delaunay_sphere(cell, facet);
  }
};

} // namespace internal

CGAL_CRUDE_REGISTRATION_INLINE std::vector<std::array<std::size_t, 3>>
join_points(const std::vector<Exact_predicates_inexact_constructions_kernel::Point_3>& points)
{
  std::vector<std::array<std::size_t, 3>> faces =
      internal::advancing_front(points, internal::Smallest_circle_first(), internal::to_the_end());
  for (auto& f : faces) std::rotate(f.begin(), std::min_element(f.begin(), f.end()), f.end());
  std::sort(faces.begin(), faces.end());
  return faces;
}

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_JOIN_POINTS_IMPL_H
