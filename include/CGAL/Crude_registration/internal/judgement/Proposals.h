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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_PROPOSALS_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_PROPOSALS_H

// What a round of the search proposes to the judge.

#include <CGAL/Crude_registration/internal/base/Correspondence.h>
#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>

#include <cstddef>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Poses that may be right, best first.
struct Proposals
{
  std::vector<Pose> poses;
  std::size_t judged = 0;     // so many of them, after refinement, are worth a close look
  bool are_estimated = false; // from all of the surface that agrees under them, not from a few correspondences
  std::vector<Pose> tried;    // where they are, all that were
  std::vector<Pose> dropped;  // distinct ones that were not worth a try, best first; or none at all
  std::vector<Correspondence> correspondences; // that have given the poses, in the own frames; or none at all
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_PROPOSALS_H
