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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_LEAST_SQUARES_MOTION_IMPL_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_LEAST_SQUARES_MOTION_IMPL_H

// Least squares by a singular value decomposition.

#include <CGAL/Crude_registration/internal/motion/least_squares_motion.h>

#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

namespace CGAL {
namespace Crude_registration {
namespace internal {

CGAL_CRUDE_REGISTRATION_INLINE std::optional<Rigid_motion>
least_squares_motion(const Vector* source, const Vector* target, const double* weights, std::size_t n)
{
  const auto weight = [weights](std::size_t i) { return weights ? weights[i] : 1.; };

  // Points are taken relative to a first one, which keeps the digits of points far from the origin, and in units of the
  // largest difference, which keeps squares from over- and underflowing.
  std::size_t first = 0;
  while (first < n && !(weight(first) > 0)) ++first;
  double total = 0, source_unit = 0, target_unit = 0, source_largest = 0, target_largest = 0;
  for (std::size_t i = first; i < n; ++i) {
    if (!(weight(i) > 0)) continue;
    total += weight(i);
    source_unit = (std::max)(source_unit, (source[i] - source[first]).cwiseAbs().maxCoeff());
    target_unit = (std::max)(target_unit, (target[i] - target[first]).cwiseAbs().maxCoeff());
    source_largest = (std::max)(source_largest, source[i].cwiseAbs().maxCoeff());
    target_largest = (std::max)(target_largest, target[i].cwiseAbs().maxCoeff());
  }
  if (!(source_unit > 0) || !(target_unit > 0)) return std::nullopt;
  const auto source_point = [&](std::size_t i) -> Vector { return (source[i] - source[first]) / source_unit; };
  const auto target_point = [&](std::size_t i) -> Vector { return (target[i] - target[first]) / target_unit; };

  Vector source_mean = Vector::Zero(), target_mean = Vector::Zero();
  for (std::size_t i = first; i < n; ++i) {
    source_mean += weight(i) / total * source_point(i);
    target_mean += weight(i) / total * target_point(i);
  }
  Matrix covariance = Matrix::Zero();
  for (std::size_t i = first; i < n; ++i)
    covariance += weight(i) / total * (target_point(i) - target_mean) * (source_point(i) - source_mean).transpose();
  if (!covariance.allFinite()) return std::nullopt;

  const Eigen::JacobiSVD<Matrix> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const auto& sigma = svd.singularValues();
  const double sign = svd.matrixU().determinant() * svd.matrixV().determinant() < 0 ? -1. : 1.;

  // The rotation turns by (change of the covariance) / (sigma_2 + sign sigma_3). It is not determined where the
  // rounding of the coordinates alone may turn it by more than 1e-5: coincident or collinear points, and point sets
  // that are mirror images of each other with two equal extents.
  constexpr double epsilon = (std::numeric_limits<double>::epsilon)();
  const double rounding = 4 * epsilon * (1 + source_largest / source_unit + target_largest / target_unit);
  if (!(1e-5 * (sigma[1] + sign * sigma[2]) > rounding)) return std::nullopt;

  Rigid_motion motion;
  motion.rotation = svd.matrixU() * Vector(1, 1, sign).asDiagonal() * svd.matrixV().transpose();
  motion.translation =
      target[first] + target_unit * target_mean - motion.rotation * (source[first] + source_unit * source_mean);
  return motion;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_LEAST_SQUARES_MOTION_IMPL_H
