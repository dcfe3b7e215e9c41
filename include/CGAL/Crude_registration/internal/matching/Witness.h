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
#include <CGAL/Crude_registration/internal/base/Rows.h>
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
  thread_local std::vector<std::int32_t> around;
  const Vector_f middle = 0.5f * (a.position + b.position);
  const std::size_t all = grid.indices_within(middle.cast<double>(), double(reach), around);
  // Those that are not on the border, without a branch.
  std::size_t n = 0;
  for (std::size_t i = 0; i < all; ++i) {
    around[n] = around[i];
    n += source.borders[std::size_t(around[i])] == 0;
  }
  if (n < 10) return false;
  const std::uint64_t seed = std::uint64_t(first) << 32 | std::uint64_t(second) << 8;
  const Matrix_f to_pair = pair_frame(a, b).transpose();
  witnesses.clear();
  for (int w = 0; w < number; ++w) {
    const std::size_t r = Counter_random::mixed(seed + std::uint64_t(w)) % n;
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

// `there`: the frame and the middle of the target's pair.
inline bool has_counterpart(const Witness& w, const Pose& there, const Surfel_level& target,
                            const Witness_tolerance& tolerance)
{
  const Vector_f p = there(w.position);
  const int j = target.field.nearest(p);
  return j >= 0 && is_like(target.surfels[std::size_t(j)], p, there.rotation * w.normal, tolerance.distance,
                           tolerance.minimal_cosine);
}

// Witnesses of one pair, a row of them at a time.
class Witness_rows
{
public:
  // From the one numbered `first` on. \pre first < witnesses.size()
  Witness_rows(const std::vector<Witness>& witnesses, std::size_t first) : m_size(witnesses.size() - first)
  {
    const std::size_t rows = (m_size + std::size_t(row_size) - 1) / std::size_t(row_size);
    const Rows zero{Row::Zero(), Row::Zero(), Row::Zero()};
    m_positions.assign(rows, zero);
    m_normals.assign(rows, zero);
    for (std::size_t w = 0; w < m_size; ++w)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t row = w / std::size_t(row_size);
        const auto i = Eigen::Index(w % std::size_t(row_size)), axis = Eigen::Index(k);
        m_positions[row][k][i] = witnesses[first + w].position[axis];
        m_normals[row][k][i] = witnesses[first + w].normal[axis];
      }
  }

  // Whether at least `needed` of them have a counterpart. `there`: the frame and the middle of the target's pair.
  bool have_counterparts(int needed, const Pose& there, const Surfel_level& target,
                         const Witness_tolerance& tolerance) const
  {
    int found = 0, open = int(m_size);
    for (std::size_t r = 0; r < m_positions.size(); ++r) {
      if (found + open < needed) return false;
      const int in_row = (std::min)(open, row_size);
      open -= in_row;
      const Rows places = moved(there, m_positions[r]), normals = rotated(there.rotation, m_normals[r]);
      const Index_row nearest = target.field.nearest(places);
      for (int i = 0; i < in_row; ++i) {
        if (nearest[i] < 0) continue;
        found += int(is_like(target.surfels[std::size_t(nearest[i])], column(places, i), column(normals, i),
                             tolerance.distance, tolerance.minimal_cosine));
      }
    }
    return found >= needed;
  }

private:
  std::size_t m_size;
  std::vector<Rows> m_positions, m_normals;
};

// One witness of some pairs of the target at a time: nine in ten have none for the first witness, and where many are
// looked at, most of the time goes into their frames. So these are computed in arrays, several by one instruction.
class Pairs_with_counterpart
{
public:
  using Entry = Surfel_pair_index::Entry;
  static constexpr std::size_t most = 64;

  // One that has a counterpart, with its frame.
  struct Found_pair
  {
    Entry pair;
    Pose place; // the axes and the middle of the pair
  };

  Pairs_with_counterpart(const Witness& witness, const Surfel_level& target, const Witness_tolerance& tolerance)
      : m_witness(witness), m_target(target), m_tolerance(tolerance)
  {}

  // Those of the first `n` pairs that have one, in their order, to `found`; returns how many.
  // \pre n <= most
  std::size_t find(const std::array<Entry, most>& pairs, std::size_t n, std::array<Found_pair, most>& found)
  {
    // Of whole rows: the last pair once more and again.
    constexpr auto size = std::size_t(row_size);
    static_assert(most % size == 0, "rows have to fill the arrays");
    const std::size_t rounded = (n + size - 1) / size * size;
    for (Pair_rows* rows : {&m_a, &m_b, &m_n, &m_m})
      for (Pair_row& r : *rows) r.resize(Eigen::Index(rounded));
    for (std::size_t i = 0; i < rounded; ++i) {
      const Entry& pair = pairs[(std::min)(i, n - 1)];
      const Surfel &a = m_target.surfels[pair.first], &b = m_target.surfels[pair.second];
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
    std::size_t number = 0;
    for (std::size_t from = 0; from < n; from += size) {
      Rows places;
      for (std::size_t k = 0; k < 3; ++k) places[k] = m_position[k].segment<row_size>(Eigen::Index(from));
      const Index_row nearest = m_target.field.nearest(places);
      for (std::size_t i = from; i < (std::min)(from + size, n); ++i) {
        const auto row = Eigen::Index(i);
        if (m_height2[row] < opposite_normals) { // another frame
          const Surfel &a = m_target.surfels[pairs[i].first], &b = m_target.surfels[pairs[i].second];
          const Pose place{pair_frame(a, b), 0.5f * (a.position + b.position)};
          if (has_counterpart(m_witness, place, m_target, m_tolerance)) found[number++] = {pairs[i], place};
          continue;
        }
        const int j = nearest[Eigen::Index(i - from)];
        const Vector_f p(m_position[0][row], m_position[1][row], m_position[2][row]),
            normal(m_normal[0][row], m_normal[1][row], m_normal[2][row]);
        const int is_found = int(j >= 0) & int(is_like(m_target.surfels[std::size_t((std::max)(j, 0))], p, normal,
                                                       m_tolerance.distance, m_tolerance.minimal_cosine));
        if (is_found == 0) continue;
        Found_pair& f = found[number++];
        f.pair = pairs[i];
        for (std::size_t k = 0; k < 3; ++k) {
          const auto axis = Eigen::Index(k);
          f.place.rotation.row(axis) << m_x[k][row], m_y[k][row], m_z[k][row];
          f.place.translation[axis] = m_middle[k][row];
        }
      }
    }
    return number;
  }

private:
  // Of as many as there are, without an allocation.
  using Pair_row = Eigen::Array<float, Eigen::Dynamic, 1, Eigen::ColMajor, int(most), 1>;
  using Pair_rows = std::array<Pair_row, 3>;

  static Pair_row dot(const Pair_rows& a, const Pair_rows& b) { return a[0] * b[0] + (a[1] * b[1] + a[2] * b[2]); }

  // The witness's place and normal in the frames of the pairs, pair_frame().
  void move_witness()
  {
    Pair_rows &x = m_x, &y = m_y, &z = m_z;
    for (std::size_t k = 0; k < 3; ++k) x[k] = m_b[k] - m_a[k];
    const Pair_row length = 1 / root(dot(x, x));
    for (Pair_row& r : x) r *= length;
    for (std::size_t k = 0; k < 3; ++k) z[k] = m_n[k] + m_m[k];
    const Pair_row zx = dot(z, x);
    for (std::size_t k = 0; k < 3; ++k) z[k] -= zx * x[k];
    m_height2 = dot(z, z);
    const Pair_row height = 1 / root(m_height2);
    for (Pair_row& r : z) r *= height;
    y = {z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]};
    const Vector_f &p = m_witness.position, &n = m_witness.normal;
    for (std::size_t k = 0; k < 3; ++k) {
      m_middle[k] = 0.5f * (m_a[k] + m_b[k]);
      m_position[k] = (x[k] * p[0] + (y[k] * p[1] + z[k] * p[2])) + m_middle[k];
      m_normal[k] = x[k] * n[0] + (y[k] * n[1] + z[k] * n[2]);
    }
  }

  const Witness m_witness;
  const Surfel_level& m_target;
  const Witness_tolerance m_tolerance;
  Pair_rows m_a, m_b, m_n, m_m; // places and normals of the pairs
  Pair_rows m_x, m_y, m_z;      // the axes of their frames
  Pair_rows m_middle;
  Pair_rows m_position, m_normal; // of the witness
  Pair_row m_height2;             // squared, of the sum of the normals over the line
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_WITNESS_H
