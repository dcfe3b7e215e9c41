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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_BODY_COEFFICIENTS_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_BODY_COEFFICIENTS_H

// The law of a view and the whole surface of a body: written by
// calibration/fit_body_confidence, and not by hand.
// 14 parts, 2 views of each from number 500 on, 434 searches. In cross-validation by part the 434
// answers have the Brier score 0.0101, and of 85 that were believed 4 were wrong.

#include <CGAL/Crude_registration/internal/judgement/evidence_coefficients.h>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// As chance is between any two scans; among the violations is what is off the body, as a share of the view's probes.
struct Body_coefficients
{
  // The log-odds that one of the distinct poses is right.
  Evidence_law any = {0, -42.671, -115.7, 7.2785, 5.3398, 0.004688};
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_BODY_COEFFICIENTS_H
