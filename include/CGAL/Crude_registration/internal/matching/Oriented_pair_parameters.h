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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_ORIENTED_PAIR_PARAMETERS_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_ORIENTED_PAIR_PARAMETERS_H

// How much each round of the search by pairs of oriented points looks at.

#include <CGAL/Crude_registration/internal/matching/extents.h>

#include <cstddef>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// How the witnesses of a pair are chosen, and how many of them have to have a counterpart.
struct Witness_rule
{
  float reach; // from the middle of the pair, in shares of M
  int needed;
};

// One round of the search.
struct Oriented_pair_round
{
  std::vector<double> scales; // lengths of the pairs, from 0, the least, to 1, the greatest; the longest first
  int origins;                // vertices V of the source
  int pairs;                  // vertices v1 for each of them and each scale
  std::size_t looks;          // at most that many pairs (C, c1) of the target are looked at
  double at_random;           // of these, the share for pairs (V, v1) at random; the others are for the rarest
  int curvature_tolerance;    // in 1/128 of the inverse spacing, for scans without noise
  std::size_t kept;           // distinct candidates that are proposed
  std::size_t judged;         // those of them that are worth a close look
};

struct Oriented_pair_parameters
{
  double minimum_extent = 0, maximum_extent = default_maximum_extent; // bounds of the lengths, in shares of M
  std::vector<Oriented_pair_round> rounds = {{{8. / 15}, 300, 5, 80000, 0, 14, 32, 8},
                                             {{8. / 15, 1. / 3}, 800, 5, 200000, 0, 14, 60, 8},
                                             {{5. / 6, 8. / 15, 1. / 3, 0.2}, 2000, 4, 1800000, 1. / 3, 20, 300, 16}};
  float source_half_width = 0.3f; // of the lengths, in spacings
  float target_half_width = 0.7f;
  float distance = 0.8f; // of a witness to the plane of its counterpart, in spacings
  float minimal_cosine = 0.75f;
  int witnesses = 16;
  // Nearer ones lie in a narrow overlap more often; but a small patch is more often like another by chance.
  // By the table in doc/design.md, of 316 generated pairs.
  Witness_rule of_rarest{0.22f, 9}, of_random{0.176f, 11};

  // The length of a scale, as a share of M.
  float length(double scale) const { return float(minimum_extent + scale * (maximum_extent - minimum_extent)); }
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_ORIENTED_PAIR_PARAMETERS_H
