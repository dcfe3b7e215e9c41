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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_REFINE_SIMILARITY_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_REFINE_SIMILARITY_H

// A motion and a scale refined together, on the planes of surfels.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/internal/base/compiled.h>
#include <CGAL/Crude_registration/internal/lookup/Surfel_field.h>

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

struct Nearest_surfel;

struct Similarity_refinement
{
  Rigid_motion motion;          // behind the scaling
  double scale = 1;             // x -> motion(scale x)
  std::size_t matches = 0;      // points that have a correspondence
  double deviation = 0;         // standard, of the scale, as a share of it
  double median = 0;            // of the distances of the matches along their normals
  bool is_scale_free = false;   // the surfaces agree as well at other scales, see refined_similarity()
  double radius = 0;            // root mean square, of the matches about their mean
  double sampling_distance = 0; // the larger of the two scans'
};

// Point-to-plane least squares with seven unknowns: a turn a, a displacement t and a growth g about the mean m of the
// matches, sum w ((x - m) x n . a + n . t + (x - m) . n g - (q - x) . n)^2 -> min (Chen and Medioni 1991, with the
// scale as Du et al. 2010 have it), weighed by Tukey's biweight. Turn and growth are measured by the displacement at
// the distance `radius`, so that the unknowns have one unit. `s`: the sampling distance, the larger of the two scans'.
class Similarity_refiner
{
public:
  Similarity_refiner(const std::vector<Surfel>& surfels, const std::vector<std::int32_t>& probes,
                     const Nearest_surfel& target, double s)
      : m_surfels(surfels), m_probes(probes), m_target(target), m_s(s)
  {}

  Similarity_refinement operator()(const Rigid_motion& initial) { return refined(initial, 1, false); }

  // At a scale that stays as it is.
  Similarity_refinement at_scale(const Rigid_motion& initial, double scale) { return refined(initial, scale, true); }

private:
  Similarity_refinement refined(const Rigid_motion& initial, double scale, bool scale_stays);

  using Matrix_7 = Eigen::Matrix<double, 7, 7>;
  using Vector_7 = Eigen::Matrix<double, 7, 1>;

  static constexpr std::size_t fewest_matches = 50;
  // Those of Point_to_plane: normals within 45 degrees, 95 % efficiency, and what counts as no residual.
  static constexpr double smallest_normal_cosine = 0.70710678118654752, biweight_reach = 4.685, smallest_sigma = 1e-3;

  struct Match
  {
    Vector source, normal;
    double height; // of the target's plane above the source
  };

  void find_matches(const Similarity_refinement& r, double reach);

  double median_height();

  // A step; returns how far it moves the matches, about.
  double move(Similarity_refinement& r, bool scale_stays);

  // Whatever the residuals are, a surfel, which is the mean of a cell, is off the surface by about so much of s.
  double deviation_of_scale(Matrix_7 left, double variance) const;

  const std::vector<Surfel>& m_surfels;
  const std::vector<std::int32_t>& m_probes;
  const Nearest_surfel& m_target;
  double m_s;
  std::vector<Match> m_matches;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#ifndef CGAL_CRUDE_REGISTRATION_COMPILED
#include <CGAL/Crude_registration/internal/motion/refine_similarity_impl.h>
#endif

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_REFINE_SIMILARITY_H
