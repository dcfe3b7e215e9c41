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

// Pairs of vertices of a range of lengths by what a rigid motion leaves of them and by their vertices' classes: for the
// search for spatial trihedra.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/internal/lookup/Bins.h>
#include <CGAL/Crude_registration/internal/lookup/Packed_ranges.h>
#include <CGAL/Crude_registration/internal/lookup/Point_grid.h>
#include <CGAL/Crude_registration/internal/lookup/pair_angles.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// What a rigid motion leaves of an ordered pair of points with normals.
struct Vertex_pair_descriptor
{
  float length;
  Pair_angles angles;
};

// How far two pairs may differ and still correspond.
struct Vertex_pair_tolerance
{
  float length;
  float angle; // of each normal with the line
  float turn;
};

// Two numbers from 0 to 127 that tell a vertex from others by whatever a pair's own numbers do not say, such as its
// curvatures in steps.
using Vertex_classes = std::array<std::uint8_t, 2>;

// The classes, from `low` to `high`, that the two vertices of a pair may have. By default all.
struct Vertex_class_limits
{
  Vertex_classes first_low{{0, 0}};
  Vertex_classes first_high{{127, 127}};
  Vertex_classes second_low{{0, 0}};
  Vertex_classes second_high{{127, 127}};
};

// All ordered pairs of vertices whose distance is in a range, so that those similar to a given pair are found without
// looking at the others.
//
// The pairs lie in the cells of a grid over their four numbers. Memory and the time to build it are linear in the
// number of pairs; a query looks at the pairs in the cells it overlaps, at all eight numbers of each (four of the pair
// and two of either vertex) at once, in one word. It only finds what may correspond: the numbers are float, and a
// little more than the tolerance is let through, so that rounding leaves out nothing.
class Vertex_pair_index
{
public:
  // A pair of vertices, given by their positions in the range of points.
  struct Pair
  {
    Vertex_pair_descriptor descriptor;
    std::int32_t first;
    std::int32_t second;
  };

  // The descriptor of the pair (p, q) with unit normals np and nq. \pre p != q
  static Vertex_pair_descriptor describe(const Vector& p, const Vector& np, const Vector& q, const Vector& nq)
  {
    CGAL_precondition(p != q);
    const Vector d = q - p;
    const double length = d.norm();
    return {float(length), pair_cosines(Vector(d / length), np, nq).angles()};
  }

  // Whether two pairs agree within a tolerance; turns are compared on the circle.
  static bool agree(const Vertex_pair_descriptor& a, const Vertex_pair_descriptor& b, const Vertex_pair_tolerance& t)
  {
    const float turn = std::abs(a.angles.turn - b.angles.turn);
    return std::abs(a.length - b.length) <= t.length && std::abs(a.angles.first - b.angles.first) <= t.angle &&
           std::abs(a.angles.second - b.angles.second) <= t.angle && (std::min)(turn, two_pi - turn) <= t.turn;
  }

  Vertex_pair_index() = default;

  // Collects the pairs of `points` at distances in [minimum_length, maximum_length].
  //
  // `normals`: unit normals of the points; those with a null normal take no part. Empty: pairs are described by their
  // distance alone, the angles are 0. `length_cell`, `angle_cell`: the size of the grid's cells, best about half the
  // tolerances of the queries; they get larger than that where they would outnumber the pairs. `classes`: of the
  // vertices. Empty: all are 0.
  //
  // \throws std::invalid_argument if the ranges differ in length, a class is above 127, or a number is not finite,
  // negative, or, for the cells, zero.
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
      const Point_grid grid(points, maximum_length / 2);
      const auto add = [&](std::int32_t first, std::int32_t second, double squared_length) {
        if (!(squared_length > 0)) return true;
        const auto i = std::size_t(first), j = std::size_t(second);
        if (normals.empty()) pairs.push_back({{float(std::sqrt(squared_length)), {0, 0, 0}}, first, second});
        else if (!normals[i].isZero(0) && !normals[j].isZero(0))
          pairs.push_back({describe(points[i], normals[i], points[j], normals[j]), first, second});
        return true;
      };
      grid.for_each_pair_between(minimum_length, maximum_length, add);
    }
    // No more cells than there are pairs, so that memory stays linear.
    std::size_t cells = 0;
    do {
      m_angle_cells = normals.empty() ? 1 : (std::max)(int((std::min)(pi / float(angle_cell), 1e3f)), 1);
      m_turn_cells = normals.empty() ? 1 : 2 * m_angle_cells;
      m_length_cells = int((std::min)((maximum_length - minimum_length) / length_cell, 1e3)) + 1;
      m_length_scale = float(1 / length_cell);
      cells = row_of(m_length_cells, 0, 0);
      length_cell *= 1.25;
      angle_cell *= 1.25;
    } while (cells > 2 * pairs.size() + 1 && (m_length_cells > 1 || m_angle_cells > 1));
    m_angle_scale = float(m_angle_cells) / pi;
    m_turn_scale = float(m_turn_cells) / two_pi;

    m_pairs = Bins<Pair>(cells, [&](const auto& add) {
      for (const Pair& p : pairs) {
        const Pair r = reversed(p, normals.empty());
        add(cell(p.descriptor), p);
        add(cell(r.descriptor), r);
      }
    });
    m_length_level_scale = maximum_length > minimum_length ? float(128 / (maximum_length - minimum_length)) : 0;
    m_keys.reserve(size());
    for (const Pair& p : m_pairs.items()) m_keys.push_back(key(p, classes));
  }

  // The number of ordered pairs.
  std::size_t size() const { return m_pairs.items().size(); }

  // f(pair) for each pair that agrees with `d` within `t` and whose vertices' classes are within `limits`, and for some
  // that differ by a hundred-thousandth more, in an order that depends on nothing else.
  template <class Function>
  void for_each_match(const Vertex_pair_descriptor& d, const Vertex_pair_tolerance& t,
                      const Vertex_class_limits& limits, Function&& f) const
  {
    const Vertex_pair_tolerance wide = widened(d, t);
    const Ranges ranges = key_ranges(d, wide, limits);
    for_each_run(d, wide, [&](std::size_t i, std::size_t end) {
      for (; i != end; ++i)
        if (ranges.contains(m_keys[i]) && agree(d, m_pairs.items()[i].descriptor, wide)) f(m_pairs.items()[i]);
    });
  }

  // The same, for vertices of all classes.
  template <class Function>
  void for_each_match(const Vertex_pair_descriptor& d, const Vertex_pair_tolerance& t, Function&& f) const
  {
    for_each_match(d, t, Vertex_class_limits(), f);
  }

  // The number of pairs that a query would look at, found without looking at them.
  std::size_t number_of_looks(const Vertex_pair_descriptor& d, const Vertex_pair_tolerance& t) const
  {
    std::size_t n = 0;
    for_each_run(d, widened(d, t), [&](std::size_t i, std::size_t end) { n += end - i; });
    return n;
  }

private:
  static constexpr float pi = 3.14159265f;
  static constexpr float two_pi = 6.28318531f;
  static constexpr float slack = 1.00001f;

  // Eight numbers from 0 to 127, one a byte.
  using Ranges = Packed_ranges<8>;
  using Key = Ranges::Word;

  Key key(const Pair& p, const std::vector<Vertex_classes>& classes) const
  {
    const Vertex_pair_descriptor& d = p.descriptor;
    Key k = Ranges::field(0, length_level(d.length)) | Ranges::field(1, angle_level(d.angles.first)) |
            Ranges::field(2, angle_level(d.angles.second)) |
            Ranges::field(3, (std::min)((std::max)(turn_level(d.angles.turn), 0), 127));
    if (!classes.empty()) {
      const Vertex_classes &a = classes[std::size_t(p.first)], &b = classes[std::size_t(p.second)];
      for (std::size_t i = 0; i < 2; ++i) k |= Ranges::field(int(4 + i), a[i]) | Ranges::field(int(6 + i), b[i]);
    }
    return k;
  }

  // The keys of what agrees with `d` within `t`, and others near.
  Ranges key_ranges(const Vertex_pair_descriptor& d, const Vertex_pair_tolerance& t, const Vertex_class_limits& c) const
  {
    Key low = 0, width = 0;
    const auto limit = [&](int field, int least, int greatest) {
      low |= Ranges::field(field, least & 127);
      width |= Ranges::field(field, (std::min)(greatest - least, 127));
    };
    limit(0, length_level(d.length - t.length), length_level(d.length + t.length));
    limit(1, angle_level(d.angles.first - t.angle), angle_level(d.angles.first + t.angle));
    limit(2, angle_level(d.angles.second - t.angle), angle_level(d.angles.second + t.angle));
    if (t.turn < pi) limit(3, turn_level(d.angles.turn - t.turn), turn_level(d.angles.turn + t.turn));
    else limit(3, 0, 127);
    for (std::size_t i = 0; i < 2; ++i) {
      limit(int(4 + i), c.first_low[i], c.first_high[i]);
      limit(int(6 + i), c.second_low[i], c.second_high[i]);
    }
    return {low, width};
  }

  int length_level(float x) const { return clamped((x - m_minimum_length) * m_length_level_scale, 128); }
  static int angle_level(float x) { return clamped(x * (128 / pi), 128); }
  static int turn_level(float x) { return int(std::floor((x + pi) * (128 / two_pi))); }

  // More than the tolerance by far more than float and the angles are off.
  static Vertex_pair_tolerance widened(const Vertex_pair_descriptor& d, const Vertex_pair_tolerance& t)
  {
    return {slack * t.length + (slack - 1) * d.length, slack * t.angle + (slack - 1), slack * t.turn + (slack - 1)};
  }

  // f(begin, end) for the runs of pairs in the cells within a tolerance of `d`.
  template <class Function>
  void for_each_run(const Vertex_pair_descriptor& d, const Vertex_pair_tolerance& t, Function&& f) const
  {
    if (m_pairs.items().empty()) return;
    const auto [length, angle, turn] = t;
    const int l0 = length_cell(d.length - length), l1 = length_cell(d.length + length);
    const int a0 = angle_cell(d.angles.first - angle), a1 = angle_cell(d.angles.first + angle);
    const int b0 = angle_cell(d.angles.second - angle), b1 = angle_cell(d.angles.second + angle);
    // Turns from t0 to t1, which may pass the end of the circle.
    int t0 = 0, t1 = m_turn_cells - 1;
    if (2 * turn * m_turn_scale < float(m_turn_cells - 2)) {
      t0 = int(std::floor((d.angles.turn - turn + pi) * m_turn_scale));
      t1 = int(std::floor((d.angles.turn + turn + pi) * m_turn_scale));
    }
    for (int l = l0; l <= l1; ++l)
      for (int a = a0; a <= a1; ++a)
        for (int b = b0; b <= b1; ++b) {
          const std::size_t row = row_of(l, a, b);
          const auto run = [&](int from, int to) {
            if (from <= to) f(m_pairs.begin(row + std::size_t(from)), m_pairs.end(row + std::size_t(to)));
          };
          // The run inside the array, and what passes its ends.
          run((std::max)(t0, 0), (std::min)(t1, m_turn_cells - 1));
          if (t0 < 0) run(t0 + m_turn_cells, m_turn_cells - 1);
          if (t1 >= m_turn_cells) run(0, t1 - m_turn_cells);
        }
  }

  static Pair reversed(const Pair& p, bool without_angles)
  {
    const Vertex_pair_descriptor& d = p.descriptor;
    if (without_angles) return {d, p.second, p.first};
    return {{d.length, {pi - d.angles.second, pi - d.angles.first, d.angles.turn}}, p.second, p.first};
  }

  static int clamped(float x, int n) { return x > 0 ? (x < float(n) ? int(x) : n - 1) : 0; }
  int length_cell(float x) const { return clamped((x - m_minimum_length) * m_length_scale, m_length_cells); }
  int angle_cell(float x) const { return clamped(x * m_angle_scale, m_angle_cells); }
  std::size_t row_of(int l, int a, int b) const
  {
    return ((std::size_t(l) * std::size_t(m_angle_cells) + std::size_t(a)) * std::size_t(m_angle_cells) +
            std::size_t(b)) *
           std::size_t(m_turn_cells);
  }
  std::size_t cell(const Vertex_pair_descriptor& d) const
  {
    return row_of(length_cell(d.length), angle_cell(d.angles.first), angle_cell(d.angles.second)) +
           std::size_t(clamped((d.angles.turn + pi) * m_turn_scale, m_turn_cells));
  }

  float m_minimum_length = 0, m_length_scale = 1, m_angle_scale = 1, m_turn_scale = 1, m_length_level_scale = 0;
  int m_length_cells = 1, m_angle_cells = 1, m_turn_cells = 1;
  Bins<Pair> m_pairs;
  std::vector<Key> m_keys; // of the pairs, in their order
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_LOOKUP_VERTEX_PAIR_INDEX_H
