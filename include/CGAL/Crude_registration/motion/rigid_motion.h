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

#ifndef CGAL_CRUDE_REGISTRATION_MOTION_RIGID_MOTION_H
#define CGAL_CRUDE_REGISTRATION_MOTION_RIGID_MOTION_H

// The rigid motion of corresponding points, in the least squares sense.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/internal/motion/least_squares_motion.h>

#include <CGAL/Kernel_traits.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

template <class Point_range>
std::vector<Vector> to_vectors(const Point_range& range, const char* error)
{
  std::vector<Vector> vectors;
  for (const auto& p : range) {
    vectors.emplace_back(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
    if (!vectors.back().allFinite()) throw std::invalid_argument(error);
  }
  return vectors;
}

template <class Point_range>
using Kernel_of_range =
    typename Kernel_traits<typename std::iterator_traits<typename Point_range::const_iterator>::value_type>::Kernel;

} // namespace internal

/*!
\ingroup PkgCrudeRegistrationRef

Computes the rigid motion that maps `source` onto `target` in the least squares sense: the \f$ (R, t) \f$, with
\f$ R \f$ a proper rotation, that minimises \f$ \sum_i w_i \, | R s_i + t - t_i |^2 \f$ over corresponding points
\f$ s_i \f$ of `source` and \f$ t_i \f$ of `target`.

The rotation comes from a singular value decomposition (Kabsch 1976, Umeyama 1991 without scale). Point sets that are
mirror images of each other give the best proper rotation, never a reflection.

\tparam PointRange a range with `const_iterator`, its value type a CGAL `Point_3`
\tparam WeightRange a range of numbers

\param source the points to be moved
\param target their correspondences, in the same order, in the frame and the unit of the result
\param weights one non-negative weight a pair, of any scale

\return the motion, which maps the frame of `source` to the frame of `target`; `std::nullopt` where the pairs do not
determine it: fewer than three pairs of positive weight, coincident or collinear points on either side, or mirror
images whose best rotation is not unique. A motion is held to be determined when the rounding of the coordinates
turns it by less than 1e-5; no other tolerance is involved, so that the unit does not matter.

\throws std::invalid_argument if the ranges differ in length, or hold a coordinate that is not finite or a weight
that is not finite or negative

Linear in the number of pairs.
*/
template <class PointRange, class WeightRange>
std::optional<Aff_transformation_3<internal::Kernel_of_range<PointRange>>>
rigid_motion(const PointRange& source, const PointRange& target, const WeightRange& weights)
{
  const auto s = internal::to_vectors(source, "rigid_motion: source has a coordinate that is not finite");
  const auto t = internal::to_vectors(target, "rigid_motion: target has a coordinate that is not finite");
  std::vector<double> w;
  for (const auto& weight : weights) {
    w.push_back(CGAL::to_double(weight));
    if (!std::isfinite(w.back()) || w.back() < 0)
      throw std::invalid_argument("rigid_motion: weights has a weight that is negative or not finite");
  }
  if (s.size() != t.size()) throw std::invalid_argument("rigid_motion: source and target differ in length");
  if (s.size() != w.size()) throw std::invalid_argument("rigid_motion: weights and source differ in length");

  const auto motion = internal::least_squares_motion(s.data(), t.data(), w.data(), s.size());
  if (!motion) return std::nullopt;
  return internal::to_aff_transformation<internal::Kernel_of_range<PointRange>>(*motion);
}

/*!
\ingroup PkgCrudeRegistrationRef

The same, with all weights equal.
*/
template <class PointRange>
std::optional<Aff_transformation_3<internal::Kernel_of_range<PointRange>>> rigid_motion(const PointRange& source,
                                                                                        const PointRange& target)
{
  return rigid_motion(source, target,
                      std::vector<double>(std::size_t(std::distance(source.begin(), source.end())), 1.));
}

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_MOTION_RIGID_MOTION_H
