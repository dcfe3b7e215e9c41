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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_EXTENTS_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_EXTENTS_H

// The bounds f1 and f2 of section 5 of the paper: how far apart what is matched may lie, in shares of M.

#include <CGAL/Crude_registration/named_parameters.h>

#include <array>
#include <stdexcept>
#include <string>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// About the share of a scan that another one is expected to show: the value of the paper for the bunny (its Table 1).
constexpr double default_maximum_extent = 0.3;

// The shares f1 and f2 of M that the parameters give, or the given ones.
template <class NamedParameters>
std::array<double, 2> extent_parameters(const NamedParameters& np, const std::string& function,
                                        const std::array<double, 2>& defaults = {{0, default_maximum_extent}})
{
  const double f1 =
      non_negative_parameter(np, internal_np::minimum_extent, defaults[0], function.c_str(), "minimum_extent");
  const double f2 =
      positive_parameter(np, internal_np::maximum_extent, defaults[1], function.c_str(), "maximum_extent");
  if (!(f1 < f2)) throw std::invalid_argument(function + ": minimum_extent has to be below maximum_extent");
  return {f1, f2};
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_EXTENTS_H
