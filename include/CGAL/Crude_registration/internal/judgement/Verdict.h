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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_VERDICT_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_VERDICT_H

// What is to be believed of the poses that were found.

#include <CGAL/Crude_registration/Judgement_limits.h>
#include <CGAL/Crude_registration/Registration_status.h>

#include <algorithm>
#include <string>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

constexpr double plausible = Judgement_limits::plausible, believed = Judgement_limits::believed,
                 certain = Judgement_limits::certain;

struct Verdict
{
  Registration_status status = NOT_REGISTERED;
  std::string reason;
  double confidence = 0;
  std::vector<std::string> free_motions;
};

// What is to be believed of a motion whose rivals have not all been looked for; `probability`: 0 where there is none.
inline Verdict interrupted(double probability)
{
  Verdict verdict;
  const bool is_plausible = probability >= plausible;
  verdict.confidence = (std::min)(0.5, probability); // a rival may be as good
  verdict.status = is_plausible ? AMBIGUOUS : NOT_REGISTERED;
  verdict.reason = is_plausible ? "interrupted: the best motion so far" : "interrupted: no overlap found so far";
  return verdict;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_VERDICT_H
