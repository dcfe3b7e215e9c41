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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_WITNESS_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_WITNESS_H

// Whether surfels near a pair of the source have a counterpart where a pair of the target takes it.

#include <CGAL/Crude_registration/internal/base/Counter_random.h>
#include <CGAL/Crude_registration/internal/lookup/Point_grid.h>
#include <CGAL/Crude_registration/internal/lookup/Surfel_pair_index.h>
#include <CGAL/Crude_registration/internal/reduction/Reduced_scan.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// A surfel of the source in the frame of a pair: pair_frame() about the pair's middle.
struct Witness
{
  Vector_f position, normal;
};

// `number` surfels within `reach` of the middle of a pair, some of them more than once; in `grid` are all of the
// source's. The first two are v2 and v3: furthest from the line through V and v1, on either side. False where there are
// too few.
inline bool choose_witnesses(const Surfel_level& source, const Point_grid& grid, std::int32_t first,
                             std::int32_t second, float reach, int number, std::vector<Witness>& witnesses)
{
  const Surfel &a = source.surfels[std::size_t(first)], &b = source.surfels[std::size_t(second)];
  std::vector<std::int32_t> around;
  const Vector_f middle = 0.5f * (a.position + b.position);
  grid.for_each_within(middle.cast<double>(), double(reach), [&](std::int32_t j, double) {
    if (!source.borders[std::size_t(j)]) around.push_back(j);
  });
  if (around.size() < 10) return false;
  const std::uint64_t seed = std::uint64_t(first) << 32 | std::uint64_t(second) << 8;
  const Matrix_f to_pair = pair_frame(a, b).transpose();
  witnesses.clear();
  for (int w = 0; w < number; ++w) {
    const std::size_t r = Counter_random::mixed(seed + std::uint64_t(w)) % around.size();
    const Surfel& s = source.surfels[std::size_t(around[r])];
    witnesses.push_back({to_pair * (s.position - middle), to_pair * s.normal});
  }
  // The line is the first axis.
  const auto arm = [](const Witness& w) -> Vector_f { return {0, w.position[1], w.position[2]}; };
  std::iter_swap(witnesses.begin(),
                 std::max_element(witnesses.begin(), witnesses.end(), [&](const Witness& x, const Witness& y) {
                   return arm(x).squaredNorm() < arm(y).squaredNorm();
                 }));
  const Vector_f opposite = -arm(witnesses.front());
  std::iter_swap(witnesses.begin() + 1,
                 std::max_element(witnesses.begin() + 1, witnesses.end(), [&](const Witness& x, const Witness& y) {
                   return arm(x).dot(opposite) < arm(y).dot(opposite);
                 }));
  return true;
}

// How close a counterpart has to be: to the plane of a surfel of the target, and its normal to that of the surfel.
struct Witness_tolerance
{
  float distance, minimal_cosine;
};

// `frame`, `middle`: of the target's pair.
inline bool has_counterpart(const Witness& w, const Matrix_f& frame, const Vector_f& middle, const Surfel_level& target,
                            const Witness_tolerance& tolerance)
{
  const Vector_f p = frame * w.position + middle;
  const int j = target.field.nearest(p);
  if (j < 0) return false;
  const Surfel& t = target.surfels[std::size_t(j)];
  return std::abs(t.normal.dot(p - t.position)) <= tolerance.distance &&
         (frame * w.normal).dot(t.normal) >= tolerance.minimal_cosine;
}

// The same for some pairs of the target at a time: nine in ten have none for the first witness, and where many are
// looked at, most of the time goes into their frames. So these are computed in arrays, several by one instruction.
class Pairs_with_counterpart
{
public:
  using Entry = Surfel_pair_index::Entry;
  static constexpr std::size_t most = 64;

  Pairs_with_counterpart(const Witness& witness, const Surfel_level& target, const Witness_tolerance& tolerance)
      : m_witness(witness), m_target(target), m_tolerance(tolerance)
  {}

  // Leaves of the pairs those that have one, in their order, and returns how many.
  // \pre n <= most
  std::size_t filter(std::array<Entry, most>& pairs, std::size_t n)
  {
    for (Rows* rows : {&m_a, &m_b, &m_n, &m_m})
      for (Row& r : *rows) r.resize(Eigen::Index(n));
    for (std::size_t i = 0; i < n; ++i) {
      const Surfel &a = m_target.surfels[pairs[i].first], &b = m_target.surfels[pairs[i].second];
      const auto row = Eigen::Index(i);
      for (std::size_t k = 0; k < 3; ++k) {
        const auto axis = Eigen::Index(k);
        m_a[k][row] = a.position[axis];
        m_b[k][row] = b.position[axis];
        m_n[k][row] = a.normal[axis];
        m_m[k][row] = b.normal[axis];
      }
    }
    move_witness();
    std::size_t left = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const auto row = Eigen::Index(i);
      if (m_height2[row] < opposite_normals) { // another frame
        const Surfel &a = m_target.surfels[pairs[i].first], &b = m_target.surfels[pairs[i].second];
        pairs[left] = pairs[i];
        left += has_counterpart(m_witness, pair_frame(a, b), 0.5f * (a.position + b.position), m_target, m_tolerance);
        continue;
      }
      const Vector_f p(m_position[0][row], m_position[1][row], m_position[2][row]),
          normal(m_normal[0][row], m_normal[1][row], m_normal[2][row]);
      const int j = m_target.field.nearest(p);
      const Surfel& t = m_target.surfels[std::size_t(j < 0 ? 0 : j)];
      const bool is_found = int(j >= 0) & int(std::abs(t.normal.dot(p - t.position)) <= m_tolerance.distance) &
                            int(normal.dot(t.normal) >= m_tolerance.minimal_cosine);
      pairs[left] = pairs[i];
      left += is_found;
    }
    return left;
  }

private:
  // Of as many as there are, without an allocation.
  using Row = Eigen::Array<float, Eigen::Dynamic, 1, Eigen::ColMajor, int(most), 1>;
  using Rows = std::array<Row, 3>;

  // Exactly rounded, as Eigen's for arrays need not be: it differs from processor to processor.
  static Row root(const Row& x)
  {
    return x.unaryExpr([](float value) { return std::sqrt(value); });
  }
  static Row dot(const Rows& a, const Rows& b) { return a[0] * b[0] + (a[1] * b[1] + a[2] * b[2]); }

  // The witness's place and normal in the frames of the pairs, pair_frame().
  void move_witness()
  {
    Rows x, y, z;
    for (std::size_t k = 0; k < 3; ++k) x[k] = m_b[k] - m_a[k];
    const Row length = 1 / root(dot(x, x));
    for (Row& r : x) r *= length;
    for (std::size_t k = 0; k < 3; ++k) z[k] = m_n[k] + m_m[k];
    const Row zx = dot(z, x);
    for (std::size_t k = 0; k < 3; ++k) z[k] -= zx * x[k];
    m_height2 = dot(z, z);
    const Row height = 1 / root(m_height2);
    for (Row& r : z) r *= height;
    y = {z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]};
    const Vector_f &p = m_witness.position, &n = m_witness.normal;
    for (std::size_t k = 0; k < 3; ++k) {
      m_position[k] = (x[k] * p[0] + (y[k] * p[1] + z[k] * p[2])) + 0.5f * (m_a[k] + m_b[k]);
      m_normal[k] = x[k] * n[0] + (y[k] * n[1] + z[k] * n[2]);
    }
  }

  const Witness m_witness;
  const Surfel_level& m_target;
  const Witness_tolerance m_tolerance;
  Rows m_a, m_b, m_n, m_m;   // places and normals of the pairs
  Rows m_position, m_normal; // of the witness
  Row m_height2;             // squared, of the sum of the normals over the line
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_WITNESS_H
