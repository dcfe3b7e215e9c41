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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_EVIDENCE_COEFFICIENTS_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_EVIDENCE_COEFFICIENTS_H

// What was measured of right and wrong poses of generated scans, by which evidence is weighed: written by
// benchmark/Crude_registration/fit_confidence, and not by hand.
// 45 settings, seeds 101 to 102, 4428 answers; in cross-validation by setting the Brier
// score is 0.0453, the expected calibration error 0.0182, and of 1115 answers that were believed
// 3 were wrong.

namespace CGAL {
namespace Crude_registration {
namespace internal {

struct Evidence_coefficients
{
  // The shares of the outcomes, of the probes that have one, where the pose is right: agrees, disagrees, in
  // free space, missing.
  double right[4] = {0.75015, 0.19867, 0.00076275, 0.050414};
  // Their shares of all probes under the candidates of a pair.
  double wrong[4] = {0.19883, 0.069621, 0.019507, 0.048985};
  // Of the probes that agree where the pose is right, by residual (up to 1/8, 1/4, 1/2, 1 of the tolerance),
  // and for each of these by the angle between the normals (up to 1/3, 2/3, 1 of the tolerance).
  double right_fit[12] = {0.32564,  0.15589,  0.058663, 0.097113, 0.090777, 0.044371,
                          0.045877, 0.069443, 0.050426, 0.011335, 0.022715, 0.027748};
  // The same under the candidates of a pair.
  double wrong_fit[12] = {0.2339,   0.10161,  0.042419, 0.11514, 0.077224, 0.036675,
                          0.087991, 0.089417, 0.051877, 0.04779, 0.066165, 0.04979};
  // log( P(right) / P(none) ) = slope sqrt(n / (n + surfels) evidence a probe) + residual (RMS of the probes that
  // agree, in tolerances) + violations sqrt(probes in free space a probe that agrees) + offset; n: of the scan with
  // fewer.
  double surfels = 200;
  double slope = 17.258;
  double residual = -10.004;
  double violations = -17.641;
  double offset = -7.1918;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_EVIDENCE_COEFFICIENTS_H
