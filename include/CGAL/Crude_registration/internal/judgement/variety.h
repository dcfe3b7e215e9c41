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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_VARIETY_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_VARIETY_H

// In how many planes lies what agrees: any three planes at right angles fit any other three, and a face only itself.

#include <CGAL/Crude_registration/internal/judgement/probe_outcomes.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The probability that two of a scan's probes that agree lie in one plane: Simpson's index (1949), one over which is
// the number of planes, each weighed by its share. Two lie in one plane whose normals agree and who lie in each other's
// plane to within four tolerances: each of the two places may be off by one, and what either normal is off moves its
// plane, far from it, by as much again. (Of two and four, four make what is right more likely; see doc/design.md.)
template <class Probe_range>
double probability_of_one_plane(const Probe_range& probes, const std::uint8_t* outcomes,
                                const Probe_tolerance& tolerance)
{
  constexpr std::size_t most = 150; // of the probes: 11,000 pairs
  std::vector<Surfel> agreeing;
  for (const Surfel& s : probes) {
    const std::uint8_t o = *outcomes++;
    if (o != Outcome::UNKNOWN && o <= Outcome::fits) agreeing.push_back(s);
  }
  const std::size_t step = agreeing.size() / most + 1;
  const float distance = 4 * tolerance.distance, cosine = std::cos(tolerance.angle);
  std::size_t together = 1, pairs = 1; // as if one more pair were in one plane
  for (std::size_t i = 0; i < agreeing.size(); i += step) {
    const Surfel& a = agreeing[i];
    for (std::size_t j = i + step; j < agreeing.size(); j += step) {
      const Surfel& b = agreeing[j];
      const Vector_f d = b.position - a.position;
      ++pairs;
      together += std::abs(d.dot(a.normal)) <= distance && std::abs(d.dot(b.normal)) <= distance &&
                  a.normal.dot(b.normal) >= cosine;
    }
  }
  return double(together) / double(pairs);
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_VARIETY_H
