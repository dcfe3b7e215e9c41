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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_JUDGED_POSE_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_JUDGED_POSE_H

// A pose and how it explains the scans.

#include <CGAL/Crude_registration/internal/base/Correspondence.h>
#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>

namespace CGAL {
namespace Crude_registration {
namespace internal {

struct Agreement
{
  float overlap = 0;    // share of the source's probes with a piece of the target near that faces their way
  float violations = 0; // of either scan's probes those in the other one's free space, as a share of theirs, summed

  float score() const { return overlap - 2 * violations; }
};

// What the outcomes of the probes say for a pose.
struct Pose_evidence
{
  // A probe, of log( P(outcome | right) / P(outcome | chance) ): as chance is among the candidates that the search has
  // tried, among these and some that it has dropped, and between any two scans.
  double tried = 0, fuller = 0, usual = 0;
  double residual = 0;   // root mean square of the probes that agree, in tolerances
  double violations = 0; // probes in free space, for each that agrees
  double surfels = 0;    // of the scan with fewer
  // Of a leading pose alone: the logarithm of the number of planes in which lies what agrees, and spread().
  double variety = 0, spread = 0;
};

// By what poses are judged: by chance among the pair's own candidates, by chance between any two scans, or, of a view
// and the whole surface of a body, by how much of the view is on that.
enum class Judged_by
{
  PAIR,
  USUAL,
  BODY
};

// A pose after refinement, looked at closely.
struct Judged_pose
{
  Pose pose;
  Pose proposed;                 // before the refinement
  Correspondence correspondence; // that has given `proposed`, where it is known
  Pose_evidence evidence;
  double log_weight = 0;  // by which it shares the probability that one of the distinct poses is right
  double log_odds = 0;    // of being right, against there being no right one
  double probability = 0; // of being right, among all distinct poses and none of them
  double by_law = 0;      // the same if the answer is none of those that obey no law
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_JUDGED_POSE_H
