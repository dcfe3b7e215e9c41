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
// the answers at the end of the searches have the Brier score 0.0397 and the expected calibration error 0.0199, and
// of 706 that were believed 5 were wrong.

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
  double fit = 0, violations = 0, lead = 0, distinction = 0, offset = 0, lapse = 0;
};

struct Evidence_coefficients
{
  // The shares of the outcomes, of the probes that have one, where the pose is right: agrees, disagrees, in
  // free space, missing.
  double right[4] = {0.79041, 0.16409, 0.0015006, 0.043992};
  // Their shares of all probes under the candidates of a pair.
  double wrong[4] = {0.17283, 0.05165, 0.016731, 0.044027};
  // Of the probes that agree where the pose is right, by residual (up to 1/8, 1/4, 1/2, 1 of the tolerance),
  // and for each of these by the angle between the normals (up to 1/3, 2/3, 1 of the tolerance).
  double right_fit[12] = {0.29998,  0.162,    0.052774, 0.10925,  0.093979, 0.038768,
                          0.060302, 0.075845, 0.042873, 0.014173, 0.026145, 0.02392};
  // The same under the candidates of a pair.
  double wrong_fit[12] = {0.22365,  0.12302,  0.04506,  0.10723,  0.088086, 0.037119,
                          0.081447, 0.095248, 0.050406, 0.039505, 0.063316, 0.045918};
  // The root is of n / (n + surfels) evidence a probe; n: of the scan with fewer.
  double surfels = 25;
  // The logarithms of the weights of distinct poses, if one is right.
  Evidence_law share = {26.089, -28.631, -24.334, 0, 0, 0.0018999};
  // The log-odds that one of them is right, and the same as chance is between any two scans.
  Lead_law any = {9.1844, -17.885, 4.1733, 0.32139, -7.0295, 0.0098046};
  Evidence_law usual_any = {7.3729, -9.8943, -12.058, 4.7741, -9.0439, 0.012093};
  // By how much the probabilities are off: the expected calibration error, in cross-validation.
  double calibration_error = 0.0199;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_EVIDENCE_COEFFICIENTS_H
