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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_FAST_ANGLES_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_FAST_ANGLES_H

// Angles from cosines and from tangents, the same bits with every library.

#include <CGAL/number_type_config.h>

#include <algorithm>
#include <cmath>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// acos and atan2 to 4e-8 radians (Abramowitz and Stegun, 4.4.46 and 4.4.49): a fifth of the time of the library's, and
// the same bits with every library.
inline double fast_acos(double x)
{
  const double a = (std::min)(std::abs(x), 1.);
  const double p = 1.5707963050 +
                   a * (-0.2145988016 +
                        a * (0.0889789874 +
                             a * (-0.0501743046 +
                                  a * (0.0308918810 + a * (-0.0170881256 + a * (0.0066700901 + a * -0.0012624911))))));
  const double angle = std::sqrt(1 - a) * p;
  return x < 0 ? CGAL_PI - angle : angle;
}

inline double fast_atan2(double y, double x)
{
  const double ax = std::abs(x), ay = std::abs(y), most = (std::max)(ax, ay);
  if (!(most > 0)) return 0;
  const double t = (std::min)(ax, ay) / most, s = t * t;
  double angle =
      t *
      (1 + s * (-0.3333314528 +
                s * (0.1999355085 +
                     s * (-0.1420889944 +
                          s * (0.1065626393 +
                               s * (-0.0752896400 + s * (0.0429096138 + s * (-0.0161657367 + s * 0.0028662257))))))));
  if (ay > ax) angle = CGAL_PI / 2 - angle;
  if (x < 0) angle = CGAL_PI - angle;
  return y < 0 ? -angle : angle;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_FAST_ANGLES_H
