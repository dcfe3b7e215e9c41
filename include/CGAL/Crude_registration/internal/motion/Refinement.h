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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_REFINEMENT_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_REFINEMENT_H

// How a motion is refined, and what comes of it.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/internal/motion/twist.h>

#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

struct Refinement_options
{
  double sampling_distance; // s, the larger of the two scans'
  double reach;             // how far correspondences may lie at the start
  double tolerance = 0.05;  // the RMS displacement of a step, in units of s, that ends the iteration
  std::size_t maximum_number_of_iterations = 50;
};

struct Refinement
{
  Rigid_motion motion; // maps the source to the target
  std::size_t iterations = 0;
  bool is_converged = false;
  std::size_t matches = 0; // source points that have a correspondence under `motion`
  double overlap = 0;      // share of the source's points within 2 s of the target, borders included
  double residual = 0;     // RMS distance of the matches along their normals

  // Small motions x -> x + w x x + v behind `motion`, as (w, v).
  Matrix_6 covariance = Matrix_6::Zero();
  // A base of those that the matches leave free, scaled to move the matched points by about 1.
  std::vector<Vector_6> free_motions;
};

inline std::array<std::array<double, 6>, 6> rows_of(const Matrix_6& m)
{
  std::array<std::array<double, 6>, 6> rows;
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j) rows[i][j] = m(Eigen::Index(i), Eigen::Index(j));
  return rows;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_REFINEMENT_H
