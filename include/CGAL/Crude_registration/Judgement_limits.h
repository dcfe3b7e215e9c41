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

#ifndef CGAL_CRUDE_REGISTRATION_JUDGEMENT_LIMITS_H
#define CGAL_CRUDE_REGISTRATION_JUDGEMENT_LIMITS_H

// The limits by which an answer is called what it is called.

namespace CGAL {
namespace Crude_registration {

/*!
\ingroup PkgCrudeRegistrationRef

The limits by which an answer is called what it is called, for programs that explain it. They are decisions, not
measurements.
*/
struct Judgement_limits
{
  /// The probability that any motion is right from which on one is worth an answer.
  static constexpr double plausible = 0.5;

  /// The confidence from which on a motion is believed: `REGISTERED`.
  static constexpr double believed = 0.9;

  /// The probability from which on, or from one less it on, nothing more is looked for. (The share of answers that obey
  /// no law of evidence is left out of it: it would not become less by that.)
  static constexpr double certain = 0.99;

  /// How far a motion that is given may be from what refinement makes of it to be called right, in sampling distances
  /// of the coarser scan: halfway between one, which samples of a surface cannot tell, and two.
  static constexpr double right_motion = 1.5;

  /// How near a surface is for the last refinement and the residual that it leaves, in sampling distances of the
  /// coarser scan.
  static constexpr double residual_reach = 2;

  /// How far in front of what was seen a sample is in free space, in sampling distances of the coarser scan.
  static constexpr double free_space_depth = 3;
};

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_JUDGEMENT_LIMITS_H
