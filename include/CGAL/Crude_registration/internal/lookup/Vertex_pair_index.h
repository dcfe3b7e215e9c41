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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_LOOKUP_VERTEX_PAIR_INDEX_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_LOOKUP_VERTEX_PAIR_INDEX_H

#include <CGAL/Crude_registration/internal/base/fast_angles.h>
#include <CGAL/Crude_registration/internal/lookup/Point_grid.h>
#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace CGAL {
namespace Crude_registration {
/*!
 * \ingroup PkgCrudeRegistrationRef
 *
 * \brief what a rigid motion leaves of an ordered pair of points with normals: the distance, the angles between the two
 * normals and the line from the first point to the second, in \f$ [0, \pi] \f$, and the torsion, the signed turn about
 * that line from the first normal to the second, in \f$ [-\pi, \pi] \f$. A mirror image has the opposite torsion.
 */
struct Vertex_pair_descriptor
{
  float length;
  float first_angle;
  float second_angle;
  float torsion;
};

/*!
 * \ingroup PkgCrudeRegistrationRef
 *
 * \brief how far two pairs may differ and still correspond, in each of the numbers that describe them.
 */
struct Vertex_pair_tolerance
{
  float length;
  float angle;
  float torsion;
};

/*!
 * \ingroup PkgCrudeRegistrationRef
 *
 * \brief two numbers from 0 to 127 that tell a vertex from others by whatever a pair's own numbers do not say, such as
 * its curvatures in steps.
 */
using Vertex_classes = std::array<std::uint8_t, 2>;

/*!
 * \ingroup PkgCrudeRegistrationRef
 *
 * \brief the classes, from `low` to `high`, that the two vertices of a pair may have. By default all.
 */
struct Vertex_class_limits
{
  Vertex_classes first_low{{0, 0}};
  Vertex_classes first_high{{127, 127}};
  Vertex_classes second_low{{0, 0}};
  Vertex_classes second_high{{127, 127}};
};

/*!
 * \ingroup PkgCrudeRegistrationRef
 *
 * \brief all ordered pairs of vertices of a mesh whose distance is in a range, so that those similar to a given pair
 * are found without looking at the others.
 *
 * The pairs lie in the cells of a grid over their four descriptors, in one array sorted by counting. Memory and the
 * time to build it are linear in the number of pairs; a query looks at the pairs in the cells it overlaps, at all eight
 * numbers of each (four of the pair and two of either vertex) at once, in one word.
 */
class Vertex_pair_index
{
public:
  /// a point or vector, `Eigen::Vector3d`
  using Vector = internal::Vector;

  /// a pair of vertices, given by their positions in the range of points
  struct Pair
  {
    Vertex_pair_descriptor descriptor;
    std::int32_t first;
    std::int32_t second;
  };

  /// the descriptor of the pair (`p`, `q`) with unit normals `np` and `nq`. \pre `p != q`
  static Vertex_pair_descriptor describe(const Vector& p, const Vector& np, const Vector& q, const Vector& nq)
  {
    const Vector d = q - p;
    const double length = d.norm();
    const Vector u = d / length;
    const double cosine_p = np.dot(u), cosine_q = nq.dot(u);
    const Vector a = np - cosine_p * u, b = nq - cosine_q * u;
    return {float(length), float(internal::fast_acos(cosine_p)), float(internal::fast_acos(cosine_q)),
            float(internal::fast_atan2(u.dot(a.cross(b)), a.dot(b)))};
  }

  /// whether two pairs agree within a tolerance; torsions are compared on the circle.
  static bool agree(const Vertex_pair_descriptor& a, const Vertex_pair_descriptor& b, const Vertex_pair_tolerance& t)
  {
    const float turn = std::abs(a.torsion - b.torsion);
    return std::abs(a.length - b.length) <= t.length && std::abs(a.first_angle - b.first_angle) <= t.angle &&
           std::abs(a.second_angle - b.second_angle) <= t.angle && (std::min)(turn, two_pi - turn) <= t.torsion;
  }

  Vertex_pair_index() = default;

  /*!
   * collects the pairs of `points` at distances in [`minimum_length`, `maximum_length`].
   *
   * \param points the vertices
   * \param normals their unit normals; vertices with a null normal take no part. Empty: pairs are described by their
   * distance alone, the angles are 0
   * \param minimum_length,maximum_length the range of distances, in the unit of the points
   * \param length_cell,angle_cell the size of the grid's cells: best about half the tolerances of the queries.
   * Cells get larger than that where they would outnumber the pairs
   * \param classes the classes of the vertices. Empty: all are 0
   *
   * \throws std::invalid_argument if the ranges differ in length, a class is above 127, or a number is not finite,
   * negative, or, for the cells, zero.
   */
  Vertex_pair_index(const std::vector<Vector>& points, const std::vector<Vector>& normals, double minimum_length,
                    double maximum_length, double length_cell, double angle_cell,
                    const std::vector<Vertex_classes>& classes = {})
      : m_minimum_length(float(minimum_length))
  {
    if (!classes.empty() && classes.size() != points.size())
      throw std::invalid_argument("Vertex_pair_index: points and classes differ in length");
    for (const Vertex_classes& c : classes)
      if (c[0] > 127 || c[1] > 127) throw std::invalid_argument("Vertex_pair_index: classes has one above 127");
    if (!normals.empty() && normals.size() != points.size())
      throw std::invalid_argument("Vertex_pair_index: points and normals differ in length");
    if (!(minimum_length >= 0 && maximum_length >= minimum_length) || !std::isfinite(maximum_length))
      throw std::invalid_argument("Vertex_pair_index: minimum_length and maximum_length are no range of distances");
    if (!(length_cell > 0 && angle_cell > 0) || !std::isfinite(length_cell) || !std::isfinite(angle_cell))
      throw std::invalid_argument("Vertex_pair_index: length_cell and angle_cell have to be finite, above zero");

    // Each unordered pair is described once: seen from its other end the angles are supplements, exchanged, and the
    // torsion is the same.
    std::vector<Pair> pairs;
    if (!points.empty() && maximum_length > 0) {
      const internal::Point_grid grid(points, maximum_length / 2);
      const double least = minimum_length * minimum_length;
      grid.for_each_pair_within(maximum_length, [&](std::int32_t first, std::int32_t second, double squared_length) {
        if (squared_length < least || !(squared_length > 0)) return true;
        const auto i = std::size_t(first), j = std::size_t(second);
        if (normals.empty()) pairs.push_back({{float(std::sqrt(squared_length)), 0, 0, 0}, first, second});
        else if (!normals[i].isZero(0) && !normals[j].isZero(0))
          pairs.push_back({describe(points[i], normals[i], points[j], normals[j]), first, second});
        return true;
      });
    }
    // No more cells than there are pairs, so that memory stays linear.
    std::size_t cells = 0;
    do {
      m_angle_cells = normals.empty() ? 1 : (std::max)(int((std::min)(pi / float(angle_cell), 1e3f)), 1);
      m_torsion_cells = normals.empty() ? 1 : 2 * m_angle_cells;
      m_length_cells = int((std::min)((maximum_length - minimum_length) / length_cell, 1e3)) + 1;
      m_length_scale = float(1 / length_cell);
      cells = row_of(m_length_cells, 0, 0);
      length_cell *= 1.25;
      angle_cell *= 1.25;
    } while (cells > 2 * pairs.size() + 1 && (m_length_cells > 1 || m_angle_cells > 1));
    m_angle_scale = float(m_angle_cells) / pi;
    m_torsion_scale = float(m_torsion_cells) / two_pi;

    m_begin.assign(cells + 1, 0);
    for (const Pair& p : pairs) {
      ++m_begin[cell(p.descriptor) + 1];
      ++m_begin[cell(reversed(p, normals.empty()).descriptor) + 1];
    }
    for (std::size_t c = 1; c < m_begin.size(); ++c) m_begin[c] += m_begin[c - 1];
    std::vector<std::size_t> next(m_begin.begin(), m_begin.end() - 1);
    m_pairs.resize(2 * pairs.size());
    m_keys.resize(2 * pairs.size());
    m_length_level_scale = maximum_length > minimum_length ? float(128 / (maximum_length - minimum_length)) : 0;
    const auto add = [&](const Pair& p) {
      const std::size_t i = next[cell(p.descriptor)]++;
      m_pairs[i] = p;
      m_keys[i] = key(p, classes);
    };
    for (const Pair& p : pairs) {
      add(p);
      add(reversed(p, normals.empty()));
    }
  }

  /// the number of ordered pairs
  std::size_t size() const { return m_pairs.size(); }

  /// calls `f(pair)` for each pair that agrees with `d` within `t` and whose vertices' classes are within `limits`, in
  /// an order that depends on nothing else.
  template <class Function>
  void for_each_match(const Vertex_pair_descriptor& d, const Vertex_pair_tolerance& t,
                      const Vertex_class_limits& limits, Function&& f) const
  {
    const Key_range range = key_range(d, widened(d, t), limits);
    for_each_run(d, t, [&](std::size_t i, std::size_t end) {
      for (; i != end; ++i)
        if (range.contains(m_keys[i]) && agree(d, m_pairs[i].descriptor, t)) f(m_pairs[i]);
    });
  }

  /// the same, for vertices of all classes.
  template <class Function>
  void for_each_match(const Vertex_pair_descriptor& d, const Vertex_pair_tolerance& t, Function&& f) const
  {
    for_each_match(d, t, Vertex_class_limits(), f);
  }

  /// the number of pairs that a query would look at, found without looking at them
  std::size_t number_of_looks(const Vertex_pair_descriptor& d, const Vertex_pair_tolerance& t) const
  {
    std::size_t n = 0;
    for_each_run(d, t, [&](std::size_t i, std::size_t end) { n += end - i; });
    return n;
  }

private:
  static constexpr float pi = 3.14159265f;
  static constexpr float two_pi = 6.28318531f;
  static constexpr float slack = 1.00001f;

  // Eight numbers from 0 to 127, one a byte, whose highest bit is free: sums and differences of all eight at once.
  using Key = std::uint64_t;
  static constexpr Key tops = 0x8080808080808080u;

  // Ranges on a circle of 128 for each of the eight.
  struct Key_range
  {
    Key offset = 0, width = 0;

    // `low`: any; what is not on a circle is given from 0 to 127.
    void limit(int field, int low, int high)
    {
      offset |= Key((128 - (low & 127)) & 127) << (8 * field);
      width |= Key((std::min)(high - low, 127)) << (8 * field);
    }

    // Moved by the offset each range starts at 0; a number is inside unless the difference to the width needs the
    // highest bit.
    bool contains(Key k) const { return (((width | tops) - ((k + offset) & ~tops)) & tops) == tops; }
  };

  Key key(const Pair& p, const std::vector<Vertex_classes>& classes) const
  {
    const Vertex_pair_descriptor& d = p.descriptor;
    Key k = Key(length_level(d.length)) | Key(angle_level(d.first_angle)) << 8 |
            Key(angle_level(d.second_angle)) << 16 |
            Key((std::min)((std::max)(torsion_level(d.torsion), 0), 127)) << 24;
    if (!classes.empty()) {
      const Vertex_classes &a = classes[std::size_t(p.first)], &b = classes[std::size_t(p.second)];
      k |= Key(a[0]) << 32 | Key(a[1]) << 40 | Key(b[0]) << 48 | Key(b[1]) << 56;
    }
    return k;
  }

  // The keys of what agrees with `d` within `t`, and others near.
  Key_range key_range(const Vertex_pair_descriptor& d, const Vertex_pair_tolerance& t,
                      const Vertex_class_limits& c) const
  {
    Key_range r;
    r.limit(0, length_level(d.length - t.length), length_level(d.length + t.length));
    r.limit(1, angle_level(d.first_angle - t.angle), angle_level(d.first_angle + t.angle));
    r.limit(2, angle_level(d.second_angle - t.angle), angle_level(d.second_angle + t.angle));
    if (t.torsion < pi) r.limit(3, torsion_level(d.torsion - t.torsion), torsion_level(d.torsion + t.torsion));
    else r.limit(3, 0, 127);
    for (std::size_t i = 0; i < 2; ++i) {
      r.limit(int(4 + i), c.first_low[i], c.first_high[i]);
      r.limit(int(6 + i), c.second_low[i], c.second_high[i]);
    }
    return r;
  }

  int length_level(float x) const { return clamped((x - m_minimum_length) * m_length_level_scale, 128); }
  static int angle_level(float x) { return clamped(x * (128 / pi), 128); }
  static int torsion_level(float x) { return int(std::floor((x + pi) * (128 / two_pi))); }

  // A little more than the tolerance: the comparison itself rounds.
  static Vertex_pair_tolerance widened(const Vertex_pair_descriptor& d, const Vertex_pair_tolerance& t)
  {
    return {slack * t.length + (slack - 1) * d.length, slack * t.angle + (slack - 1), slack * t.torsion + (slack - 1)};
  }

  // f(begin, end) for the runs of pairs in the cells within a tolerance of `d`.
  template <class Function>
  void for_each_run(const Vertex_pair_descriptor& d, const Vertex_pair_tolerance& t, Function&& f) const
  {
    if (m_pairs.empty()) return;
    const auto [length, angle, torsion] = widened(d, t);
    const int l0 = length_cell(d.length - length), l1 = length_cell(d.length + length);
    const int a0 = angle_cell(d.first_angle - angle), a1 = angle_cell(d.first_angle + angle);
    const int b0 = angle_cell(d.second_angle - angle), b1 = angle_cell(d.second_angle + angle);
    // Torsions from t0 to t1, which may pass the end of the circle.
    int t0 = 0, t1 = m_torsion_cells - 1;
    if (2 * torsion * m_torsion_scale < float(m_torsion_cells - 2)) {
      t0 = int(std::floor((d.torsion - torsion + pi) * m_torsion_scale));
      t1 = int(std::floor((d.torsion + torsion + pi) * m_torsion_scale));
    }
    for (int l = l0; l <= l1; ++l)
      for (int a = a0; a <= a1; ++a)
        for (int b = b0; b <= b1; ++b) {
          const std::size_t row = row_of(l, a, b);
          const auto run = [&](int from, int to) {
            if (from <= to) f(m_begin[row + std::size_t(from)], m_begin[row + std::size_t(to) + 1]);
          };
          // The run inside the array, and what passes its ends.
          run((std::max)(t0, 0), (std::min)(t1, m_torsion_cells - 1));
          if (t0 < 0) run(t0 + m_torsion_cells, m_torsion_cells - 1);
          if (t1 >= m_torsion_cells) run(0, t1 - m_torsion_cells);
        }
  }

  static Pair reversed(const Pair& p, bool without_angles)
  {
    const Vertex_pair_descriptor& d = p.descriptor;
    if (without_angles) return {d, p.second, p.first};
    return {{d.length, pi - d.second_angle, pi - d.first_angle, d.torsion}, p.second, p.first};
  }

  static int clamped(float x, int n) { return x > 0 ? (x < float(n) ? int(x) : n - 1) : 0; }
  int length_cell(float x) const { return clamped((x - m_minimum_length) * m_length_scale, m_length_cells); }
  int angle_cell(float x) const { return clamped(x * m_angle_scale, m_angle_cells); }
  std::size_t row_of(int l, int a, int b) const
  {
    return ((std::size_t(l) * std::size_t(m_angle_cells) + std::size_t(a)) * std::size_t(m_angle_cells) +
            std::size_t(b)) *
           std::size_t(m_torsion_cells);
  }
  std::size_t cell(const Vertex_pair_descriptor& d) const
  {
    return row_of(length_cell(d.length), angle_cell(d.first_angle), angle_cell(d.second_angle)) +
           std::size_t(clamped((d.torsion + pi) * m_torsion_scale, m_torsion_cells));
  }

  float m_minimum_length = 0, m_length_scale = 1, m_angle_scale = 1, m_torsion_scale = 1, m_length_level_scale = 0;
  int m_length_cells = 1, m_angle_cells = 1, m_torsion_cells = 1;
  std::vector<std::size_t> m_begin; // of each cell in m_pairs
  std::vector<Pair> m_pairs;
  std::vector<Key> m_keys;
};

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_LOOKUP_VERTEX_PAIR_INDEX_H
