// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_SYMMETRIC_EIGEN_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_SYMMETRIC_EIGEN_H

// Eigenvalues and eigenvectors of small symmetric matrices.

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/SVD>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Eigenvalues, the least first, and eigenvectors, in columns.
template <class Matrix_type>
struct Symmetric_eigen
{
  Eigen::Matrix<double, Matrix_type::RowsAtCompileTime, 1, 0, Matrix_type::MaxRowsAtCompileTime, 1> values;
  Matrix_type vectors;
};

// Of a symmetric matrix, of which the lower triangle is read, without negative eigenvalues: its singular values then.
// (By Jacobi's rotations: exact for the small ones, too, and a sixth of the time to compile of
// Eigen::SelfAdjointEigenSolver.)
template <class Derived>
auto symmetric_eigen(const Eigen::MatrixBase<Derived>& matrix)
{
  constexpr int rows = Derived::RowsAtCompileTime, most = Derived::MaxRowsAtCompileTime;
  using Plain = Eigen::Matrix<double, rows, rows, 0, most, most>;
  const Plain full = Plain(matrix).template selfadjointView<Eigen::Lower>();
  const Eigen::JacobiSVD<Plain, Eigen::NoQRPreconditioner> svd(full, Eigen::ComputeFullV);
  return Symmetric_eigen<Plain>{svd.singularValues().reverse(), svd.matrixV().rowwise().reverse()};
}

// Of A v = mu N v with N positive definite; the vectors are such that v^T N v = 1.
template <class Matrix_type>
Symmetric_eigen<Matrix_type> symmetric_eigen(const Matrix_type& a, const Matrix_type& n)
{
  // N = L L^T, w = L^T v: L^-1 A L^-T w = mu w
  const Eigen::LLT<Matrix_type> cholesky(n);
  const Matrix_type half = cholesky.matrixL().solve(a), c = cholesky.matrixL().solve(half.transpose());
  Symmetric_eigen<Matrix_type> eigen = symmetric_eigen(c);
  eigen.vectors = cholesky.matrixU().solve(eigen.vectors).eval();
  return eigen;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_SYMMETRIC_EIGEN_H
