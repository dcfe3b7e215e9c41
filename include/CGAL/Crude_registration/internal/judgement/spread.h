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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_SPREAD_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_SPREAD_H

// How far apart lies what agrees: a wrong pose that was refined fits in one patch, a right one all over the overlap.

#include <CGAL/Crude_registration/internal/judgement/probe_outcomes.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The variance of the places of a scan's probes that agree: the mean of their squared distances from their mean. One
// more probe is counted as agreeing, so that there is always one; `floor`: its squared distance from the mean.
template <class Probe_range>
double variance_of_agreeing(const Probe_range& probes, const std::uint8_t* outcomes, double floor)
{
  std::size_t n = 0;
  Vector sum = Vector::Zero();
  double squares = 0;
  for (const Surfel& s : probes) {
    const std::uint8_t o = *outcomes++;
    if (o == Outcome::UNKNOWN || o > Outcome::fits) continue;
    const Vector p = s.position.template cast<double>();
    sum += p;
    squares += p.squaredNorm();
    ++n;
  }
  const double within = n > 0 ? (std::max)(0., squares - sum.squaredNorm() / double(n)) : 0;
  return (within + floor) / double(n + 1);
}

// The logarithm of the variance of what agrees, the mean of that of either scan, in squares of the extent of the scans.
inline double spread(double of_source, double of_target, double extent)
{
  return std::log((of_source + of_target) / (2 * extent * extent));
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_SPREAD_H
