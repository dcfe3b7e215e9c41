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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_FLAT_TRIHEDRA_IMPL_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_FLAT_TRIHEDRA_IMPL_H

// The choice of spatial trihedra and the search for their matches.

#include <CGAL/Crude_registration/internal/matching/Trihedron_choice.h>
#include <CGAL/Crude_registration/internal/matching/Trihedron_matching.h>
#include <CGAL/Crude_registration/internal/matching/flat_trihedra.h>
#include <CGAL/Crude_registration/internal/motion/least_squares_motion.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

CGAL_CRUDE_REGISTRATION_INLINE std::vector<Spatial_trihedron> spatial_trihedra(const std::vector<Vector>& points,
                                                                               const std::vector<std::uint8_t>& inside,
                                                                               const Trihedron_options& options)
{
  return Trihedron_choice(points, inside, options)();
}

CGAL_CRUDE_REGISTRATION_INLINE std::array<double, 2> range_of_arms(const std::vector<Vector>& points,
                                                                   const std::vector<Spatial_trihedron>& trihedra)
{
  double least = (std::numeric_limits<double>::max)(), most = 0;
  for (const Spatial_trihedron& t : trihedra) {
    const double squared = (points[std::size_t(t.ends[0])] - points[std::size_t(t.origin)]).squaredNorm();
    least = (std::min)(least, squared);
    most = (std::max)(most, squared);
  }
  return {std::sqrt((std::min)(least, most)), std::sqrt(most)};
}

CGAL_CRUDE_REGISTRATION_INLINE bool candidate_motion(std::int32_t trihedron,
                                                     const std::array<std::int32_t, 4>& vertices,
                                                     const std::array<Vector, 4>& x, const std::array<Vector, 4>& y,
                                                     Candidate_motion& candidate)
{
  const auto motion = least_squares_motion(x.data(), y.data(), nullptr, 4);
  if (!motion) return false;
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) sum += ((*motion)(x[i]) - y[i]).squaredNorm();
  candidate = {*motion, trihedron, vertices, std::sqrt(sum / 4)};
  return true;
}

CGAL_CRUDE_REGISTRATION_INLINE std::vector<Candidate_motion>
match_trihedra(const Matching_vertices& s, const std::vector<Spatial_trihedron>& trihedra, const Matching_vertices& d,
               const Match_tolerances& tolerances)
{
  std::vector<Candidate_motion> candidates;
  const std::array<double, 2> arms = range_of_arms(s.points, trihedra);
  const Trihedron_matching matching(s, d, arms[0], arms[1], tolerances);
  Trihedron_matching::Workspace work;
  for (std::size_t i = 0; i < trihedra.size(); ++i)
    matching(trihedra[i], work, [&](const auto& vertices, const auto& x, const auto& y) {
      Candidate_motion candidate;
      if (candidate_motion(std::int32_t(i), vertices, x, y, candidate)) candidates.push_back(candidate);
    });
  return candidates;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_FLAT_TRIHEDRA_IMPL_H
