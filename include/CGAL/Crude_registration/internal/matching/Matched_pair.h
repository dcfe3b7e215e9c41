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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_MATCHED_PAIR_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_MATCHED_PAIR_H

// A pair of oriented points of one reduced scan, and the one of the other that it was matched with.

#include <CGAL/Crude_registration/internal/base/Correspondence.h>
#include <CGAL/Crude_registration/internal/reduction/Reduced_scan.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// (V, v1) of the source and (C, c1) of the target, as indices of surfels: there are no more than 16 bits tell apart.
struct Matched_pair
{
  std::array<std::uint16_t, 2> source, target;
};

// The places of the surfels.
inline Correspondence correspondence(const Matched_pair& pair, const Surfel_level& source, const Surfel_level& target)
{
  Correspondence result;
  for (std::size_t i = 0; i < 2; ++i)
    result.emplace_back(source.surfels[pair.source[i]].position.cast<double>(),
                        target.surfels[pair.target[i]].position.cast<double>());
  return result;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_MATCHED_PAIR_H
