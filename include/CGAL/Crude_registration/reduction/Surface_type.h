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

#ifndef CGAL_CRUDE_REGISTRATION_REDUCTION_SURFACE_TYPE_H
#define CGAL_CRUDE_REGISTRATION_REDUCTION_SURFACE_TYPE_H

// The types of a surface by the signs of its principal curvatures.

#include <cstddef>

namespace CGAL {
namespace Crude_registration {

/// \ingroup PkgCrudeRegistrationRef
/// the type of a surface at a point by its principal curvatures.
enum Surface_type
{
  PLANAR,    ///< both are zero
  PARABOLIC, ///< one is zero
  ELLIPTIC,  ///< they have the same sign
  HYPERBOLIC ///< they have opposite signs
};

/*!
 * \ingroup PkgCrudeRegistrationRef
 *
 * \brief the type of a surface with the given principal curvatures.
 *
 * A curvature of absolute value at most `tolerance` (in 1/length) counts as zero. With a tolerance of 0 the type is
 * that of the sign of the Gaussian curvature, and on measured data, where no curvature is ever exactly zero, elliptic
 * or hyperbolic.
 */
template <class FT>
Surface_type surface_type(const FT& minimum, const FT& maximum, const FT& tolerance = FT(0))
{
  const int signs[] = {minimum > tolerance ? 1 : (minimum < -tolerance ? -1 : 0),
                       maximum > tolerance ? 1 : (maximum < -tolerance ? -1 : 0)};
  if (signs[0] == 0 && signs[1] == 0) return PLANAR;
  if (signs[0] == 0 || signs[1] == 0) return PARABOLIC;
  return signs[0] == signs[1] ? ELLIPTIC : HYPERBOLIC;
}

/*!
 * \ingroup PkgCrudeRegistrationRef
 *
 * \brief how many vertices of a mesh are of which type.
 */
struct Surface_type_counts
{
  std::size_t planar = 0, parabolic = 0, elliptic = 0, hyperbolic = 0;

  void add(Surface_type type)
  {
    switch (type) {
    case PLANAR:
      ++planar;
      break;
    case PARABOLIC:
      ++parabolic;
      break;
    case ELLIPTIC:
      ++elliptic;
      break;
    case HYPERBOLIC:
      ++hyperbolic;
      break;
    }
  }

  /// the paper's smoothness: the share of the vertices that are not hyperbolic, in percent; 100 without any vertex.
  double percent_smooth() const
  {
    const std::size_t smooth = planar + parabolic + elliptic, all = smooth + hyperbolic;
    return all == 0 ? 100.0 : 100.0 * double(smooth) / double(all);
  }
};

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_REDUCTION_SURFACE_TYPE_H
