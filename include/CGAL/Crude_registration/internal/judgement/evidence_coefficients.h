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
// 60 settings, seeds 101 to 102, 7018 rounds of 2340 searches. In cross-validation by setting
// the answers at the end of the searches have the Brier score 0.0366 and the expected calibration error 0.00947, and
// of 759 that were believed 5 were wrong.

namespace CGAL {
namespace Crude_registration {
namespace internal {

// A linear law: slope root(evidence) + residual (RMS of the probes that agree, in tolerances) + violations sqrt(probes
// in free space a probe that agrees) + variety (logarithm of the number of planes that agree) + offset; lapse: the
// share of answers that obey no such law.
struct Evidence_law
{
  double slope = 0, residual = 0, violations = 0, variety = 0, offset = 0, lapse = 0;
};

// The same of Lead_features.
struct Lead_law
{
  double fit = 0, violations = 0, lead = 0, distinction = 0, spread = 0, tried_all = 0, offset = 0, lapse = 0;
};

struct Evidence_coefficients
{
  // The shares of the outcomes, of the probes that have one, where the pose is right: agrees, disagrees, in
  // free space, missing.
  double right[4] = {0.78717, 0.16681, 0.0015211, 0.044496};
  // Their shares of all probes under the candidates of a pair.
  double wrong[4] = {0.17088, 0.05217, 0.016789, 0.044242};
  // Of the probes that agree where the pose is right, by residual (up to 1/8, 1/4, 1/2, 1 of the tolerance),
  // and for each of these by the angle between the normals (up to 1/3, 2/3, 1 of the tolerance).
  double right_fit[12] = {0.29189,  0.16287,  0.053233, 0.1084,   0.094632, 0.039245,
                          0.061292, 0.077143, 0.043688, 0.015076, 0.027489, 0.025045};
  // The same under the candidates of a pair.
  double wrong_fit[12] = {0.21537,  0.12386,  0.04559,  0.10551,  0.088867, 0.037683,
                          0.082134, 0.096765, 0.051363, 0.040637, 0.065075, 0.047149};
  // The root is of n / (n + surfels) evidence a probe; n: of the scan with fewer.
  double surfels = 100;
  // The logarithms of the weights of distinct poses, if one is right.
  Evidence_law share = {21.986, -24.406, -20.761, 0, 0, 0.001878};
  // The log-odds that one of them is right, and the same as chance is between any two scans.
  Lead_law any = {9.5638, -16.446, 3.0978, 0.38317, 1.1943, 1.0686, -4.232, 0.012686};
  Evidence_law usual_any = {7.2558, -10.869, -12.2, 4.5631, -8.1827, 0.016812};
  // By how much the probabilities are off: the expected calibration error, in cross-validation.
  double calibration_error = 0.00947;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_EVIDENCE_COEFFICIENTS_H
