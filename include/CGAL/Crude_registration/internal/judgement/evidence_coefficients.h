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
// 60 settings, seeds 101 to 102, 5940 rounds of 1980 searches. In cross-validation by setting
// the answers at the end of the searches have the Brier score 0.044 and the expected calibration error 0.0222, and
// of 665 that were believed 2 were wrong.

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
  double right[4] = {0.77828, 0.1763, 0.00068252, 0.044729};
  // Their shares of all probes under the candidates of a pair.
  double wrong[4] = {0.18457, 0.059709, 0.015706, 0.045744};
  // Of the probes that agree where the pose is right, by residual (up to 1/8, 1/4, 1/2, 1 of the tolerance),
  // and for each of these by the angle between the normals (up to 1/3, 2/3, 1 of the tolerance).
  double right_fit[12] = {0.29022, 0.14704,  0.051786, 0.11726,  0.092492, 0.039068,
                          0.06658, 0.077925, 0.044625, 0.019058, 0.028556, 0.025392};
  // The same under the candidates of a pair.
  double wrong_fit[12] = {0.21247,  0.10647,  0.040088, 0.12144,  0.082321, 0.034579,
                          0.098564, 0.094854, 0.048514, 0.050366, 0.065622, 0.044706};
  // The root is of n / (n + surfels) evidence a probe; n: of the scan with fewer.
  double surfels = 25;
  // The logarithms of the weights of distinct poses, if one is right.
  Evidence_law share = {20.835, -13.552, -20.462, 0, 0, 0, 0.0025442};
  // The log-odds that one of them is right, and the same as chance is between any two scans.
  Evidence_law any = {6.9617, -8.217, -19.527, 9.1813, 1.5968, -7.5111, 0.0067554};
  Evidence_law usual_any = {6.0505, -9.6643, -15.283, 0, 3.9992, -7.1965, 0.0048082};
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_EVIDENCE_COEFFICIENTS_H
