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

// What was measured of right and wrong poses of generated scans, by which evidence is weighed.

namespace CGAL {
namespace Crude_registration {
namespace internal {

struct Evidence_coefficients
{
  // The shares of the outcomes, of the probes that have one, where the pose is right: agrees, disagrees, in free space,
  // missing.
  double right[4] = {0.85, 0.10, 0.005, 0.035};
  // Their shares of all probes under the candidates of a pair.
  double wrong[4] = {0.2, 0.2, 0.2, 0.2};
  // Of the probes that agree where the pose is right, by residual (up to 1/8, 1/4, 1/2, 1 of the tolerance), and for
  // each of these by the angle between the normals (up to 1/3, 2/3, 1 of the tolerance).
  double right_fit[12] = {0.3614, 0.1221, 0.0195, 0.1709, 0.0811, 0.0166,
                          0.0713, 0.0586, 0.0234, 0.0078, 0.0195, 0.0244};
  // The same under the candidates of a pair.
  double wrong_fit[12] = {0.08, 0.064, 0.033, 0.072, 0.062, 0.033, 0.099, 0.109, 0.059, 0.116, 0.159, 0.104};
  // log( P(right) / P(none) ) = slope sqrt(evidence a probe) + missing (share of the probes that go missing, of those
  // that agree or do) + offset.
  double slope = 28.5;
  double missing = -16.78;
  double offset = -13.08;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_EVIDENCE_COEFFICIENTS_H
