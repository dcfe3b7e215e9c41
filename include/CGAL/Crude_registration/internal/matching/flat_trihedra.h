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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_FLAT_TRIHEDRA_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_FLAT_TRIHEDRA_H

// Spatial trihedra of points, and their matches among others: what is behind the public functions.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/internal/base/compiled.h>
#include <CGAL/Crude_registration/internal/matching/trihedron_options.h>
#include <CGAL/Crude_registration/internal/reduction/Matching_vertices.h>

#include <array>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The trihedra of the points with `inside` set: see Trihedron_choice.
std::vector<Spatial_trihedron> spatial_trihedra(const std::vector<Vector>& points,
                                                const std::vector<std::uint8_t>& inside,
                                                const Trihedron_options& options);

// The lengths of the shortest and of the longest first arm of some trihedra.
std::array<double, 2> range_of_arms(const std::vector<Vector>& points, const std::vector<Spatial_trihedron>& trihedra);

// The candidate of a correspondence; false where its points determine no motion.
bool candidate_motion(std::int32_t trihedron, const std::array<std::int32_t, 4>& vertices,
                      const std::array<Vector, 4>& x, const std::array<Vector, 4>& y, Candidate_motion& candidate);

// All candidates for some trihedra of S, in the order of the trihedra.
std::vector<Candidate_motion> match_trihedra(const Matching_vertices& s, const std::vector<Spatial_trihedron>& trihedra,
                                             const Matching_vertices& d, const Match_tolerances& tolerances);

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#ifndef CGAL_CRUDE_REGISTRATION_COMPILED
#include <CGAL/Crude_registration/internal/matching/flat_trihedra_impl.h>
#endif

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_FLAT_TRIHEDRA_H
