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
// score is 0.0481, the expected calibration error 0.0178, and of 1738 answers that were believed
// 15 were wrong.

namespace CGAL {
namespace Crude_registration {
namespace internal {

struct Evidence_coefficients
{
  // The shares of the outcomes, of the probes that have one, where the pose is right: agrees, disagrees, in
  // free space, missing.
  double right[4] = {0.77829, 0.1763, 0.00068252, 0.044729};
  // Their shares of all probes under the candidates of a pair.
  double wrong[4] = {0.18457, 0.059707, 0.015706, 0.04574};
  // Of the probes that agree where the pose is right, by residual (up to 1/8, 1/4, 1/2, 1 of the tolerance),
  // and for each of these by the angle between the normals (up to 1/3, 2/3, 1 of the tolerance).
  double right_fit[12] = {0.29023,  0.14704,  0.051782, 0.11726,  0.092486, 0.039071,
                          0.066583, 0.077928, 0.044625, 0.019058, 0.028552, 0.025392};
  // The same under the candidates of a pair.
  double wrong_fit[12] = {0.21247,  0.10648,  0.04009,  0.12144,  0.08232,  0.034577,
                          0.098567, 0.094855, 0.048513, 0.050364, 0.065619, 0.044704};
  // log( P(right) / P(none) ) = slope sqrt(n / (n + surfels) evidence a probe) + residual (RMS of the probes that
  // agree, in tolerances) + violations sqrt(probes in free space a probe that agrees) + lead (root of the usual
  // evidence, less that of the best candidate elsewhere) + offset; n: of the scan with fewer.
  double surfels = 200;
  double slope = 18.665;
  double residual = -9.375;
  double violations = -19.02;
  double lead = 4.228;
  double offset = -8.5118;
  // Of the answers that obey no such law.
  double lapse = 0.0055685;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_EVIDENCE_COEFFICIENTS_H
