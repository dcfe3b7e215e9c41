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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_EVENED_POINTS_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_EVENED_POINTS_H

// Points without copies and of even density, at several resolutions.

#include <CGAL/Crude_registration/internal/base/Counter_random.h>
#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/internal/base/Run_control.h>
#include <CGAL/Crude_registration/internal/base/symmetric_eigen.h>
#include <CGAL/Crude_registration/internal/lookup/cell_items.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The first of all points that are the same, for each point: its index. \throws Run_control::Stopped
inline std::vector<std::uint32_t> first_of_copies(const std::vector<Vector>& points, Run_control& control)
{
  std::size_t size = 16;
  while (size < 2 * points.size()) size *= 2;
  constexpr std::uint32_t none = ~std::uint32_t(0);
  std::vector<std::uint32_t> table(size, none), result(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    control.check(i);
    std::uint64_t hash = 0;
    for (int k = 0; k < 3; ++k) {
      const double x = points[i][k] + 0.; // no negative zero
      std::uint64_t bits;
      std::memcpy(&bits, &x, sizeof(bits));
      hash = Counter_random::mixed(hash + bits);
    }
    std::size_t at = std::size_t(hash) & (size - 1);
    while (table[at] != none && points[table[at]] != points[i]) at = (at + 1) & (size - 1);
    if (table[at] == none) table[at] = std::uint32_t(i);
    result[i] = table[at];
  }
  return result;
}

// Points without copies and of even density: the means of the cells of nested grids, of which each has cells twice as
// wide as the one before. The grids are laid along the points' own axes, so that they move with them.
class Evened_points
{
public:
  struct Level
  {
    std::vector<Vector> points;         // in the frame of the points' own
    std::vector<std::uint64_t> cells;   // Morton codes, increasing
    std::vector<std::uint32_t> parents; // in the next level
  };

  static constexpr std::size_t number_of_levels = 6;

  // About `most` points are left at most. \throws Run_control::Stopped
  Evened_points(const std::vector<Vector>& points, std::size_t most, Run_control& control) : m_control(control)
  {
    if (points.size() < 3) return;
    m_first = first_of_copies(points, control);
    to_own_frame(points);
    if (m_is_line) return;
    find_cell(most);
    build();
  }

  // Is there no surface: no three points that are not on a line?
  bool is_empty() const { return m_levels[0].points.empty(); }

  const Level& level(std::size_t i) const { return m_levels[i]; }
  double cell(std::size_t level) const { return std::ldexp(m_cell, int(level)); }
  const Vector& corner() const { return m_corner; } // of a cell of each level

  // The root of the area per point, of the points as they were and as they are left.
  double spacing() const { return m_spacing; }

  // In the frame of the input.
  Vector to_input(const Vector& local) const { return m_centroid + m_axes * local; }
  Vector to_local(const Vector& p) const { return m_axes.transpose() * (p - m_centroid); }
  const Matrix& axes() const { return m_axes; }

  // For each point of the input that was not left out, which of level 0 it is in: f(index in the input, index in level
  // 0).
  template <class Function>
  void for_each_member(const Function& f) const
  {
    for (std::size_t i = 0; i < m_first.size(); ++i)
      if (m_member[m_first[i]] != none) f(i, std::size_t(m_member[m_first[i]]));
  }

private:
  void to_own_frame(const std::vector<Vector>& points)
  {
    Vector sum = Vector::Zero();
    std::size_t n = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      m_control.check(i);
      if (m_first[i] != i) continue;
      sum += points[i] - points.front();
      ++n;
    }
    m_centroid = points.front() + sum / double(n);
    Matrix covariance = Matrix::Zero();
    for (std::size_t i = 0; i < points.size(); ++i) {
      m_control.check(i);
      if (m_first[i] != i) continue;
      const Vector d = points[i] - m_centroid;
      covariance += d * d.transpose();
    }
    const Symmetric_eigen<Matrix> eigen = symmetric_eigen(covariance);
    m_axes = eigen.vectors;
    m_is_line = !(eigen.values[1] > 1e-14 * eigen.values[2]); // or one point
    if (m_is_line) return;
    m_local.reserve(n);
    m_index.reserve(n);
    Vector third = Vector::Zero();
    for (std::size_t i = 0; i < points.size(); ++i) {
      m_control.check(i);
      if (m_first[i] != i) continue;
      m_local.push_back(to_local(points[i]));
      m_index.push_back(std::uint32_t(i));
      third += m_local.back().cwiseProduct(m_local.back()).cwiseProduct(m_local.back());
    }
    // An axis points to the side where the points reach farther.
    const Vector sign = third.unaryExpr([](double x) { return x < 0 ? -1. : 1.; });
    m_axes = m_axes * sign.asDiagonal();
    m_low = m_local.front().cwiseProduct(sign);
    m_high = m_low;
    for (Vector& p : m_local) {
      p = p.cwiseProduct(sign);
      m_low = m_low.cwiseMin(p);
      m_high = m_high.cwiseMax(p);
    }
  }

  // Every third bit, of 21.
  static std::uint64_t spread(std::uint64_t x)
  {
    x = (x | x << 32) & 0x1f00000000ffffu;
    x = (x | x << 16) & 0x1f0000ff0000ffu;
    x = (x | x << 8) & 0x100f00f00f00f00fu;
    x = (x | x << 4) & 0x10c30c30c30c30c3u;
    return (x | x << 2) & 0x1249249249249249u;
  }

  // The points by the cells of a grid.
  std::vector<Cell_item> items(const Vector& corner, double cell) const
  {
    std::vector<Cell_item> result;
    result.reserve(m_local.size());
    constexpr double limit = double((1 << 21) - 1);
    for (const Vector& p : m_local) {
      m_control.check(result.size());
      const Vector q = ((p - corner) / cell).cwiseMax(0.).cwiseMin(limit);
      result.push_back(
          {spread(std::uint64_t(q[0])) | spread(std::uint64_t(q[1])) << 1 | spread(std::uint64_t(q[2])) << 2,
           std::uint32_t(result.size())});
    }
    sort_cell_items(result, m_control);
    return result;
  }

  // How many cells the points are in, by the size of the cells: that of a level is half of the next one's.
  static constexpr std::size_t depth = 20;
  std::array<double, depth + 1> count_cells(double finest) const
  {
    std::array<double, depth + 1> count;
    count.fill(1);
    const Vector middle = Vector::Constant(std::ldexp(finest, int(depth) - 1));
    const std::vector<Cell_item> sorted = items(m_low.cwiseMax(-middle) - Vector::Constant(finest / 3), finest);
    for (std::size_t i = 1; i < sorted.size(); ++i) {
      m_control.check(i);
      std::uint64_t different = sorted[i].key ^ sorted[i - 1].key;
      for (std::size_t l = 0; l <= depth && different != 0; ++l, different >>= 3) ++count[l];
    }
    return count;
  }

  // A surface of area A that is sampled densely is met by 1.5 A / h^2 cells of edge length h, in the mean over all
  // directions, a curve of length L by 1.5 L / h. The points are samples of a surface from the scale on at which the
  // count falls more like the one than like the other. (A spinning scanner's rings are curves to the scale of their
  // distance.)
  void find_cell(std::size_t most)
  {
    // What is very far from most others does not matter here.
    std::vector<double> distances;
    distances.reserve(m_local.size());
    for (const Vector& p : m_local) distances.push_back(p.cwiseAbs().maxCoeff());
    m_control.check();
    const auto median = distances.begin() + std::ptrdiff_t(distances.size() / 2);
    std::nth_element(distances.begin(), median, distances.end());
    const double finest = (std::min)((m_high - m_low).maxCoeff(), 32 * *median) / double(1 << depth);
    const std::array<double, depth + 1> count = count_cells(finest);
    // Points closer than eight of the finest cells, some 1e-5 of the size, are copies that were rounded.
    constexpr std::size_t same = 3;
    const double n = count[same];
    constexpr double between = 2.8284271247461903; // 2^1.5
    std::size_t surface = same;
    while (surface + 1 < depth && count[surface] < between * count[surface + 1]) ++surface;
    if (surface + 1 < depth) ++surface; // well within
    const double h = std::ldexp(finest, int(surface));
    m_spacing = h * std::sqrt(count[surface] / (1.5 * n));
    m_cell = m_spacing / std::sqrt(2.);
    // How many cells of this size?
    for (std::size_t l = same; l < depth; ++l) {
      if (count[l] < double(most)) break;
      const double edge = std::ldexp(finest, int(l));
      if (count[l + 1] >= double(most)) continue;
      const double wanted = edge * std::exp2(std::log(count[l] / double(most)) / std::log(count[l] / count[l + 1]));
      if (wanted > m_cell) {
        m_cell = wanted;
        m_spacing = (std::max)(m_spacing, m_cell / std::sqrt(1.5));
      }
    }
  }

  void build()
  {
    // What lies at the border of the box is not at the border of a cell: rounding has no say.
    m_corner = m_low - Vector::Constant(m_cell / 3);
    const std::vector<Cell_item> sorted = items(m_corner, m_cell);
    m_member.assign(m_first.size(), none);
    Level& finest = m_levels[0];
    for (std::size_t i = 0; i < sorted.size();) {
      m_control.check(finest.points.size());
      const Cell_item& first = sorted[i];
      Vector sum = Vector::Zero();
      double count = 0;
      for (; i < sorted.size() && sorted[i].key == first.key; ++i) {
        sum += m_local[sorted[i].index];
        ++count;
        m_member[m_index[sorted[i].index]] = std::uint32_t(finest.points.size());
      }
      finest.points.push_back(sum / count);
      finest.cells.push_back(first.key);
    }
    leave_out_dust();
    for (std::size_t l = 1; l < number_of_levels; ++l) {
      Level &fine = m_levels[l - 1], &coarse = m_levels[l];
      fine.parents.resize(fine.points.size());
      for (std::size_t i = 0; i < fine.points.size();) {
        m_control.check(coarse.points.size());
        const std::uint64_t key = fine.cells[i] >> 3;
        Vector sum = Vector::Zero();
        double count = 0;
        for (; i < fine.points.size() && fine.cells[i] >> 3 == key; ++i) {
          sum += fine.points[i];
          ++count;
          fine.parents[i] = std::uint32_t(coarse.points.size());
        }
        coarse.points.push_back(sum / count);
        coarse.cells.push_back(key);
      }
    }
    m_local = {};
    m_index = {};
  }

  // Leaves out what is nearly alone in a cell of the coarsest level, as a wrong sample far away.
  void leave_out_dust()
  {
    Level& finest = m_levels[0];
    constexpr std::size_t fewest = 3, shift = 3 * (number_of_levels - 1);
    std::vector<std::uint32_t> new_index(finest.points.size(), none);
    std::size_t kept = 0;
    for (std::size_t i = 0, end = 0; i < finest.points.size(); i = end) {
      while (end < finest.points.size() && finest.cells[end] >> shift == finest.cells[i] >> shift) ++end;
      for (std::size_t k = i; k < end && end - i >= fewest; ++k) {
        finest.points[kept] = Vector(finest.points[k]);
        finest.cells[kept] = finest.cells[k];
        new_index[k] = std::uint32_t(kept++);
      }
    }
    finest.points.resize(kept);
    finest.cells.resize(kept);
    for (std::uint32_t& m : m_member)
      if (m != none) m = new_index[m];
  }

  static constexpr std::uint32_t none = ~std::uint32_t(0);

  Run_control& m_control;
  std::vector<std::uint32_t> m_first;  // for each point of the input
  std::vector<std::uint32_t> m_member; // for each point of the input that is the first of its copies: in level 0
  std::vector<std::uint32_t> m_index;  // of the local points, in the input
  std::vector<Vector> m_local;         // without copies
  Vector m_centroid = Vector::Zero(), m_low = Vector::Zero(), m_high = Vector::Zero(), m_corner = Vector::Zero();
  Matrix m_axes = Matrix::Identity();
  bool m_is_line = false;
  double m_cell = 0, m_spacing = 0;
  std::array<Level, number_of_levels> m_levels;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_EVENED_POINTS_H
