// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_TEST_MATRIX_OF_H
#define CGAL_CRUDE_REGISTRATION_TEST_MATRIX_OF_H

// The covariance of a motion, which public types tell by rows, as a matrix, and what it makes of an error.

#include <CGAL/Crude_registration/internal/motion/twist.h>

#include <array>
#include <cmath>
#include <cstddef>

using CGAL::Crude_registration::internal::Matrix_6;
using CGAL::Crude_registration::internal::Vector_6;

inline Matrix_6 matrix_of(const std::array<std::array<double, 6>, 6>& rows)
{
  Matrix_6 matrix;
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j) matrix(Eigen::Index(i), Eigen::Index(j)) = rows[i][j];
  return matrix;
}

// L^-1 x, where L is Cholesky's root of the covariance: of unit covariance if x has that one. Not finite where the
// covariance is not positive definite. (Eigen's decompositions of six rows take longer to compile than a file of
// tests.)
inline Vector_6 whitened(const Matrix_6& covariance, Vector_6 x)
{
  Matrix_6 root = covariance;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j <= i; ++j) {
      for (int k = 0; k < j; ++k) root(i, j) -= root(i, k) * root(j, k);
      root(i, j) = i == j ? std::sqrt(root(i, i)) : root(i, j) / root(j, j);
    }
    for (int k = 0; k < i; ++k) x[i] -= root(i, k) * x[k];
    x[i] /= root(i, i);
  }
  return x;
}

#endif // CGAL_CRUDE_REGISTRATION_TEST_MATRIX_OF_H
