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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_NORMAL_EQUATIONS_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_NORMAL_EQUATIONS_H

// Point-to-plane least squares: its weighted normal equations, in float and in double.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>

#include <Eigen/Core>

#include <cstddef>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Tukey's biweight of a residual, given the square of its ratio to the largest one that counts.
template <class T>
T biweight(T squared_ratio)
{
  const T v = 1 - squared_ratio;
  return v > 0 ? v * v : 0;
}

// The normal equations of sum w (m . a + n . t - residual)^2 -> min for a turn a and a displacement t (Chen and Medioni
// 1991): `moment` m and `normal` n say by how much a unit of each moves a correspondence along its normal.
template <class T>
struct Normal_equations
{
  Eigen::Matrix<T, 6, 6> left = Eigen::Matrix<T, 6, 6>::Zero(); // its lower half
  Eigen::Matrix<T, 6, 1> right = Eigen::Matrix<T, 6, 1>::Zero();

  void add(const Basic_vector<T>& moment, const Basic_vector<T>& normal, T residual, T weight)
  {
    const T v[6] = {moment[0], moment[1], moment[2], normal[0], normal[1], normal[2]};
    for (int i = 0; i < 6; ++i) {
      const T wi = weight * v[i];
      for (int j = i; j < 6; ++j) left(j, i) += wi * v[j];
      right[i] += wi * residual;
    }
  }

  // The solution, with `damping` times the identity added to the left side: what the correspondences do not determine
  // stays. By the Cholesky decomposition L D L^T of a matrix that is positive definite.
  Eigen::Matrix<T, 6, 1> solved(T damping) const
  {
    T l[6][6], d[6], x[6];
    for (int j = 0; j < 6; ++j) {
      d[j] = left(j, j) + damping;
      for (int k = 0; k < j; ++k) d[j] -= l[j][k] * l[j][k] * d[k];
      const T inverse = 1 / d[j];
      for (int i = j + 1; i < 6; ++i) {
        T s = left(i, j);
        for (int k = 0; k < j; ++k) s -= l[i][k] * l[j][k] * d[k];
        l[i][j] = s * inverse;
      }
    }
    for (int i = 0; i < 6; ++i) {
      x[i] = right[i];
      for (int k = 0; k < i; ++k) x[i] -= l[i][k] * x[k];
    }
    Eigen::Matrix<T, 6, 1> solution;
    for (int i = 5; i >= 0; --i) {
      x[i] /= d[i];
      for (int k = i + 1; k < 6; ++k) x[i] -= l[k][i] * x[k];
      solution[i] = x[i];
    }
    return solution;
  }
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_NORMAL_EQUATIONS_H
