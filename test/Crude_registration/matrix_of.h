// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_TEST_MATRIX_OF_H
#define CGAL_CRUDE_REGISTRATION_TEST_MATRIX_OF_H

// The covariance of a motion, which public types tell by rows, as a matrix.

#include <CGAL/Crude_registration/internal/motion/twist.h>

#include <array>
#include <cstddef>

using CGAL::Crude_registration::internal::Matrix_6;

inline Matrix_6 matrix_of(const std::array<std::array<double, 6>, 6>& rows)
{
  Matrix_6 matrix;
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j) matrix(Eigen::Index(i), Eigen::Index(j)) = rows[i][j];
  return matrix;
}

#endif // CGAL_CRUDE_REGISTRATION_TEST_MATRIX_OF_H
