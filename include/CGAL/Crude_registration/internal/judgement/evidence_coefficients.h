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
// calibration/fit_confidence, and not by hand.
// 60 settings, seeds 101 to 102, 5940 rounds of 1980 searches. In cross-validation by setting
// the answers at the end of the searches have the Brier score 0.0418 and the expected calibration error 0.0186, and
// of 675 that were believed 3 were wrong.

namespace CGAL {
namespace Crude_registration {
namespace internal {

// A linear law: slope root(evidence) + residual (RMS of the probes that agree, in tolerances) + violations sqrt(probes
// in free space a probe that agrees) + lead (of the root over the mean of the others) + variety (logarithm of the
// number of planes that agree) + offset; lapse: the share of answers that obey no such law.
struct Evidence_law
{
  double slope, residual, violations, lead, variety, offset, lapse;
};

struct Evidence_coefficients
{
  // The shares of the outcomes, of the probes that have one, where the pose is right: agrees, disagrees, in
  // free space, missing.
  double right[4] = {0.77861, 0.17643, 0.000754, 0.0442};
  // Their shares of all probes under the candidates of a pair.
  double wrong[4] = {0.18376, 0.059851, 0.016285, 0.045894};
  // Of the probes that agree where the pose is right, by residual (up to 1/8, 1/4, 1/2, 1 of the tolerance),
  // and for each of these by the angle between the normals (up to 1/3, 2/3, 1 of the tolerance).
  double right_fit[12] = {0.29019,  0.14705,  0.051801, 0.11725,  0.092491, 0.039079,
                          0.066578, 0.077922, 0.044634, 0.019056, 0.028558, 0.025394};
  // The same under the candidates of a pair.
  double wrong_fit[12] = {0.21162,  0.1064,   0.040027, 0.12119,  0.082294, 0.03462,
                          0.098726, 0.095051, 0.048572, 0.050426, 0.066052, 0.045027};
  // The root is of n / (n + surfels) evidence a probe; n: of the scan with fewer.
  double surfels = 50;
  // The logarithms of the weights of distinct poses, if one is right.
  Evidence_law share = {22.328, -11.603, -24.036, 0, 0, 0, 0.0028421};
  // The log-odds that one of them is right, and the same as chance is between any two scans.
  Evidence_law any = {7.2245, -8.9238, -21.634, 10.038, 1.5958, -7.5861, 0.0068905};
  Evidence_law usual_any = {5.8533, -10.175, -17.561, 0, 4.0051, -6.8223, 0.0058386};
  // By how much the probabilities are off: the expected calibration error, in cross-validation.
  double calibration_error = 0.0186;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_EVIDENCE_COEFFICIENTS_H
