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

// Of the probes of a scan those that agree.
struct Agreeing_probes
{
  double share = 0;    // of all of them
  double variance = 0; // of their places: the mean of the squared distances from the mean
};

// One more probe is counted as agreeing, so that there is always one; `floor`: its squared distance from the mean.
template <class Probe_range>
Agreeing_probes agreeing_probes(const Probe_range& probes, const std::uint8_t* outcomes, double floor)
{
  std::size_t n = 0, all = 0;
  Vector sum = Vector::Zero();
  double squares = 0;
  for (const Surfel& s : probes) {
    const std::uint8_t o = outcomes[all++];
    if (o == Outcome::UNKNOWN || o > Outcome::fits) continue;
    const Vector p = s.position.template cast<double>();
    sum += p;
    squares += p.squaredNorm();
    ++n;
  }
  const double within = n > 0 ? (std::max)(0., squares - sum.squaredNorm() / double(n)) : 0;
  return {double(n + 1) / double(all + 1), (within + floor) / double(n + 1)};
}

// The logarithm of the variance of what agrees, in squares of the extent of the scans, over its share of both scans. It
// does not tell large overlaps from small ones, but patches from what is scattered over the scans.
inline double spread(const Agreeing_probes& source, const Agreeing_probes& target, double extent)
{
  return std::log((source.variance + target.variance) / (extent * extent * (source.share + target.share)));
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_SPREAD_H
