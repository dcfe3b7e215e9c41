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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_ASSEMBLY_COEFFICIENTS_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_ASSEMBLY_COEFFICIENTS_H

// How far what pairs say is to be believed: measured on generated scenes by calibration/fit_assembly.

namespace CGAL {
namespace Crude_registration {
namespace internal {

// 40 scenes of 6 scans, seeds 201 to 202. The ranges are those in which a coefficient does not change how the scenes
// are put together, found with .02, .05 and .02 for the first three.
struct Assembly_coefficients
{
  double agreeing = 0.05; // of motions of two pairs that are both wrong, the share that agrees: .0502 (.0025 to .04 the
                          // same, .08 one scan of 313 otherwise)
  double closing = 0.11;  // of ways by a third scan, the share that closes a loop with a wrong motion: .114 (.05 to .2)
  double wrong = 0.0174; // of pairs that are certain alone, the share that is wrong, with 95 %: 1 of 267 (.0025 to .02)
  // What the share of a scan in free space takes from the logarithm of the odds (22.5 to 360), from this share on,
  // which is there at the rims of what was seen (.00375 to .06).
  double free_space = 45, at_the_rims = 0.03;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_ASSEMBLY_COEFFICIENTS_H
