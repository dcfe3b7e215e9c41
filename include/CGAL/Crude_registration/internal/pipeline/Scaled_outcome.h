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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_PIPELINE_SCALED_OUTCOME_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_PIPELINE_SCALED_OUTCOME_H

// Which scales are tried where nobody knows it, and what the registrations at them say together.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/internal/base/compiled.h>
#include <CGAL/Crude_registration/internal/judgement/Verdict.h>
#include <CGAL/Crude_registration/internal/motion/refine_similarity.h>
#include <CGAL/Crude_registration/internal/pipeline/register_reduced_scans.h>
#include <CGAL/Crude_registration/internal/reduction/Reduced_scan.h>

#include <cstddef>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// How far the surface is from its centre, as a root mean square: surfels are spread evenly over it, whatever its
// samples are.
double radius_of(const Reduced_scan& scan);

// The factors that are tried, in turn: the ratios of units of length, 1 among them, that make the sizes agree about,
// the nearest first; then those of a grid about the ratio of the sizes, from its middle on.
std::vector<double> scales_to_try(double ratio);

// What the registration at one scale says, and what is made of its motion when the scale may move, too.
struct Scaled_outcome : Registration_outcome
{
  double scale = 1;
  Similarity_refinement refinement;
};

// How well the surfaces still agree when the source is larger, and when it is smaller, by so much that matches are
// moved by two sampling distances, the worse one of the two: as planes do. (Edges and borders, of which there are few,
// count for little then.)
struct Agreement_at_other_scales
{
  double matches = 1; // over those at the best scale
  double growth = 0;  // of the median of the distances

  Agreement_at_other_scales() = default;
  Agreement_at_other_scales(Similarity_refiner& refiner, const Rigid_motion& initial,
                            const Similarity_refinement& best);

  bool is_as_good() const
  {
    // By calibration/scale_limits.cpp: none of 38 pairs whose scale is determined agrees so well
    // elsewhere (three do where the median may grow by a quarter), and 47 of 48 corners, whose scale is free, do.
    constexpr double fewest_matches = 0.9, largest_growth = 1.1;
    return matches >= fewest_matches && growth <= largest_growth;
  }

private:
  static constexpr double smallest = 1e-9;
};

// `motion`: of the source at its scale, in the frames of the inputs. Of the sides that a scan may have, the ones that
// match are taken.
Similarity_refinement refined_similarity(const std::vector<const Reduced_scan*>& sides_of_source,
                                         const std::vector<const Reduced_scan*>& sides_of_target,
                                         const Rigid_motion& motion);

// What is believed of the best of several scales, of which as many as `number` were to be tried: beforehand each was as
// probable as another, so that the odds of one are that share of what they are alone; what was found at other scales
// are its rivals.
Verdict verdict_of(const std::vector<Scaled_outcome>& outcomes, const Scaled_outcome& best, std::size_t number);

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#ifndef CGAL_CRUDE_REGISTRATION_COMPILED
#include <CGAL/Crude_registration/internal/pipeline/Scaled_outcome_impl.h>
#endif

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_PIPELINE_SCALED_OUTCOME_H
