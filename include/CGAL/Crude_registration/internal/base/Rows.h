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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_ROWS_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_ROWS_H

// Some vectors at a time, coordinate by coordinate: loops that are compiled to instructions for several of them.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace CGAL {
namespace Crude_registration {
namespace internal {

constexpr int row_size = 8;
using Row = Eigen::Array<float, row_size, 1>;
using Rows = std::array<Row, 3>;
using Index_row = Eigen::Array<int, row_size, 1>;

// rotation * v, in the order of the sum in which Eigen computes it for one vector.
inline Rows rotated(const Matrix_f& rotation, const Rows& v)
{
  Rows r;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = Eigen::Index(i);
    r[i] = rotation(row, 0) * v[0] + (rotation(row, 1) * v[1] + rotation(row, 2) * v[2]);
  }
  return r;
}

inline Rows moved(const Pose& pose, const Rows& p)
{
  Rows r = rotated(pose.rotation, p);
  for (std::size_t i = 0; i < 3; ++i) r[i] += pose.translation[Eigen::Index(i)];
  return r;
}

// Exactly rounded, as Eigen's for arrays need not be: it differs from processor to processor.
template <class Numbers>
Numbers root(const Numbers& x)
{
  Numbers r(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) r[i] = std::sqrt(x[i]);
  return r;
}

// The `i`-th vector.
inline Vector_f column(const Rows& v, int i)
{
  return {v[0][i], v[1][i], v[2][i]};
}

// Whole numbers from 0 to `last`; 0 for what is not a number, as of two that cannot be compared the first counts.
inline int clamped(float x, float last)
{
  return int((std::min)((std::max)(0.f, x), last));
}
inline Index_row clamped(const Row& x, float last)
{
  return Row(Row::Zero()).max(x).min(last).cast<int>();
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_ROWS_H
