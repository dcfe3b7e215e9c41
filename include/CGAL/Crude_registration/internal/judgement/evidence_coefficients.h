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
// 60 settings, seeds 101 to 102, 5940 answers; in cross-validation by setting the Brier
// score is 0.0394, the expected calibration error 0.0105, and of 1863 answers that were believed
// 16 were wrong.

namespace CGAL {
namespace Crude_registration {
namespace internal {

struct Evidence_coefficients
{
  // The shares of the outcomes, of the probes that have one, where the pose is right: agrees, disagrees, in
  // free space, missing.
  double right[4] = {0.77828, 0.1763, 0.00068252, 0.044729};
  // Their shares of all probes under the candidates of a pair.
  double wrong[4] = {0.14032, 0.074004, 0.033125, 0.049664};
  // Of the probes that agree where the pose is right, by residual (up to 1/8, 1/4, 1/2, 1 of the tolerance),
  // and for each of these by the angle between the normals (up to 1/3, 2/3, 1 of the tolerance).
  double right_fit[12] = {0.29022, 0.14704,  0.051786, 0.11726,  0.092492, 0.039068,
                          0.06658, 0.077925, 0.044625, 0.019058, 0.028556, 0.025392};
  // The same under the candidates of a pair.
  double wrong_fit[12] = {0.1452,  0.091217, 0.038255, 0.098141, 0.076046, 0.034566,
                          0.10795, 0.10336,  0.053368, 0.091149, 0.10069,  0.060056};
  // log( P(right) / P(none) ) = slope sqrt(n / (n + surfels) evidence a probe) + residual (RMS of the probes that
  // agree, in tolerances) + violations sqrt(probes in free space a probe that agrees) + lead (the root, less the mean
  // of those of the other poses) + offset; n: of the scan with fewer.
  double surfels = 100;
  double slope = 9.8628;
  double residual = -5.2511;
  double violations = -20.092;
  double lead = 12.784;
  double offset = -9.1262;
  // The same by the usual evidence, whatever the other poses are.
  double usual_slope = 9.641;
  double usual_residual = -3.6961;
  double usual_violations = -25.152;
  double usual_offset = -6.2708;
  // Of the answers that obey no such law.
  double lapse = 0.0034971;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_EVIDENCE_COEFFICIENTS_H
