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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_CONCLUDE_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_CONCLUDE_H

// The last step of a registration: what is to be believed of the poses that were found.

#include <CGAL/Crude_registration/internal/judgement/Judged_pose.h>
#include <CGAL/Crude_registration/internal/judgement/Verdict.h>
#include <CGAL/Crude_registration/internal/judgement/evidence_coefficients.h>
#include <CGAL/Crude_registration/internal/judgement/free_motions.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// How probable it has to be that one of the poses is right. As chance is between any two scans, a plane that fits as
// well as can be is as probable as not, to within the error of the probabilities: it is told, and so are its free
// motions.
inline double least_plausible(Judged_by by)
{
  return by == Judged_by::USUAL ? plausible - Evidence_coefficients().calibration_error : plausible;
}

// `poses`: distinct, most probable first, judged by chance between any two scans only where the scans fit each other in
// many ways. \pre There is a pose.
inline Verdict judge_poses(const std::vector<Judged_pose>& poses, Judged_by by, const Free_motions& free)
{
  Verdict verdict;
  const double any = probability_of_any(poses);
  verdict.confidence = poses.front().probability;
  if (by == Judged_by::USUAL) verdict.confidence = (std::min)(verdict.confidence, 0.5); // another one is as good
  if (any < least_plausible(by)) {
    verdict.reason = "no overlap found that cannot be by chance";
  } else if (!free.motions.empty()) {
    verdict.status = AMBIGUOUS;
    verdict.confidence = (std::min)(verdict.confidence, 0.5); // any other pose along the free motions is as good
    verdict.free_motions = free.motions;
    verdict.reason = free.surface.empty() ? "the overlap leaves motions free" : "the overlap is " + free.surface;
  } else if (verdict.confidence >= believed) {
    verdict.status = REGISTERED;
  } else {
    verdict.status = AMBIGUOUS;
    const double rivals = any - verdict.confidence, none = 1 - any;
    verdict.reason = rivals > none ? "several distinct motions bring the scans together equally well"
                                   : "the best motion may be by chance";
  }
  return verdict;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_CONCLUDE_H
