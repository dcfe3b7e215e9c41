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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_SYMMETRIC_EIGEN_IMPL_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_SYMMETRIC_EIGEN_IMPL_H

// The decompositions of symmetric_eigen.h.

#include <CGAL/Crude_registration/internal/base/symmetric_eigen.h>

#include <Eigen/Cholesky>
#include <Eigen/SVD>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// By Jacobi's rotations, which are exact for the small ones, too.
CGAL_CRUDE_REGISTRATION_INLINE Symmetric_eigen<Eigen::MatrixXd> symmetric_eigen_of(const Eigen::MatrixXd& matrix)
{
  const Eigen::MatrixXd full = matrix.selfadjointView<Eigen::Lower>();
  const Eigen::JacobiSVD<Eigen::MatrixXd, Eigen::NoQRPreconditioner> svd(full, Eigen::ComputeFullV);
  return {svd.singularValues().reverse(), svd.matrixV().rowwise().reverse()};
}

CGAL_CRUDE_REGISTRATION_INLINE Symmetric_eigen<Eigen::MatrixXd> symmetric_eigen_of(const Eigen::MatrixXd& a,
                                                                                   const Eigen::MatrixXd& n)
{
  // N = L L^T, w = L^T v: L^-1 A L^-T w = mu w
  const Eigen::LLT<Eigen::MatrixXd> cholesky(n);
  const Eigen::MatrixXd half = cholesky.matrixL().solve(a), c = cholesky.matrixL().solve(half.transpose());
  Symmetric_eigen<Eigen::MatrixXd> eigen = symmetric_eigen_of(c);
  eigen.vectors = cholesky.matrixU().solve(eigen.vectors).eval();
  return eigen;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_SYMMETRIC_EIGEN_IMPL_H
