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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_TRIHEDRON_OPTIONS_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_TRIHEDRON_OPTIONS_H

// Which spatial trihedra are chosen, and what is a match of one: the vocabulary of the search of the paper.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/matching/Spatial_trihedron.h>

#include <array>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// A trihedron of vertices that are given by their positions in a range of points.
using Spatial_trihedron = Crude_registration::Spatial_trihedron<std::int32_t>;

struct Trihedron_options
{
  double minimum_length = 0; // f1 M
  double maximum_length = 0; // f2 M
  // At each scale the arms are limited to minimum_length + scale (maximum_length - minimum_length), 0 < scale <= 1.
  std::vector<double> scales = {1};
  int trihedra_per_scale = 1; // for each vertex
};

// How far vertices that correspond may differ.
struct Match_tolerances
{
  double length = 0;       // of a vertex's place: about the distance of neighbouring vertices
  double angle = 0;        // of a normal, radians
  double curvature = 0;    // of either curvature, 1/length
  bool use_normals = true; // false: the paper's descriptor, curvatures alone
};

// A trihedron of S and the vertices C, c1, c2, c3 of D that may correspond to its V, v1, v2, v3. `motion` maps S to D
// in the least squares sense over the four pairs, with the root mean square distance `residual`.
struct Candidate_motion
{
  Rigid_motion motion;
  std::int32_t trihedron; // position in the range of trihedra
  std::array<std::int32_t, 4> vertices;
  double residual;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_TRIHEDRON_OPTIONS_H
