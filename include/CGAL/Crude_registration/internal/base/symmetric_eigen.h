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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_SYMMETRIC_EIGEN_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_SYMMETRIC_EIGEN_H

// Eigenvalues and eigenvectors of small symmetric matrices.

#include <CGAL/Crude_registration/internal/base/compiled.h>

#include <Eigen/Core>

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

// Of matrices of any size: the decompositions of Eigen take long to compile, and one serves all.
Symmetric_eigen<Eigen::MatrixXd> symmetric_eigen_of(const Eigen::MatrixXd& matrix);
Symmetric_eigen<Eigen::MatrixXd> symmetric_eigen_of(const Eigen::MatrixXd& a, const Eigen::MatrixXd& n);

// Of a symmetric matrix, of which the lower triangle is read, without negative eigenvalues: its singular values then.
template <class Derived>
auto symmetric_eigen(const Eigen::MatrixBase<Derived>& matrix)
{
  constexpr int rows = Derived::RowsAtCompileTime, most = Derived::MaxRowsAtCompileTime;
  const Symmetric_eigen<Eigen::MatrixXd> eigen = symmetric_eigen_of(matrix);
  return Symmetric_eigen<Eigen::Matrix<double, rows, rows, 0, most, most>>{eigen.values, eigen.vectors};
}

// Of A v = mu N v with N positive definite; the vectors are such that v^T N v = 1.
template <class Matrix_type>
Symmetric_eigen<Matrix_type> symmetric_eigen(const Matrix_type& a, const Matrix_type& n)
{
  const Symmetric_eigen<Eigen::MatrixXd> eigen = symmetric_eigen_of(a, n);
  return {eigen.values, eigen.vectors};
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#ifndef CGAL_CRUDE_REGISTRATION_COMPILED
#include <CGAL/Crude_registration/internal/base/symmetric_eigen_impl.h>
#endif

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_SYMMETRIC_EIGEN_H
