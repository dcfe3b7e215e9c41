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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_LOOKUP_SURFEL_PAIR_INDEX_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_LOOKUP_SURFEL_PAIR_INDEX_H

// Pairs of surfels of one length by their angles and curvatures: for the search for pairs of oriented points.

#include <CGAL/Crude_registration/internal/lookup/Bins.h>
#include <CGAL/Crude_registration/internal/lookup/Packed_ranges.h>
#include <CGAL/Crude_registration/internal/lookup/Point_grid.h>
#include <CGAL/Crude_registration/internal/lookup/Surfel_field.h>
#include <CGAL/Crude_registration/internal/lookup/pair_angles.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The angles of two surfels as cosines. False where a normal is so close to the line that the turn means nothing, or
// there is no line.
inline bool pair_cosines(const Surfel& a, const Surfel& b, Pair_cosines<float>& cosines)
{
  Vector_f d = b.position - a.position;
  const float length = d.norm();
  if (!(length > 0)) return false;
  d *= 1 / length;
  cosines = pair_cosines(d, a.normal, b.normal);
  constexpr float most = 0.98f;
  return std::abs(cosines.first) < most && std::abs(cosines.second) < most;
}

inline bool pair_angles(const Surfel& a, const Surfel& b, Pair_angles& angles)
{
  Pair_cosines<float> c;
  if (!pair_cosines(a, b, c)) return false;
  angles = c.angles();
  return true;
}

// Normals are opposite about a line if their sum, as far as it is perpendicular, is shorter than the root of this, 0.3:
// those of surfels side by side differ by about as much, so that the direction of a shorter sum is noise.
constexpr float opposite_normals = 0.09f;

// The axes that two surfels span: the line between them, and the mean of their normals as far as it is perpendicular.
// Maps equal pairs onto each other: rotation = pair_frame(target pair) * pair_frame(source pair)^T.
inline Matrix_f pair_frame(const Surfel& a, const Surfel& b)
{
  Vector_f x = b.position - a.position;
  x *= 1 / x.norm();
  Vector_f z = a.normal + b.normal;
  z -= z.dot(x) * x;
  float length2 = z.squaredNorm();
  if (length2 < opposite_normals) {
    z = a.normal - a.normal.dot(x) * x;
    length2 = z.squaredNorm();
  }
  z *= 1 / std::sqrt(length2);
  Matrix_f f;
  f.col(0) = x;
  f.col(1) = z.cross(x);
  f.col(2) = z;
  return f;
}

// The curvatures of a pair, in bytes.
struct Pair_curvatures
{
  std::array<std::uint8_t, 4> values;

  static std::uint8_t quantise(float k) { return std::uint8_t((std::min)((std::max)(k * 128 + 128.5f, 0.f), 255.f)); }

  static Pair_curvatures of(const Surfel& a, const Surfel& b)
  {
    return {{quantise(a.minimal_curvature), quantise(a.maximal_curvature), quantise(b.minimal_curvature),
             quantise(b.maximal_curvature)}};
  }
};

// The curvatures that differ by at most a tolerance from some.
class Curvature_window
{
public:
  Curvature_window(const Pair_curvatures& middle, int tolerance)
  {
    std::array<std::uint8_t, 4> low, high;
    for (std::size_t i = 0; i < 4; ++i) {
      low[i] = std::uint8_t((std::max)(int(middle.values[i]) - tolerance, 0));
      high[i] = std::uint8_t((std::min)(int(middle.values[i]) + tolerance, 255));
    }
    m_ranges = {spread(low), spread(high) - spread(low)};
  }

  bool contains(const Pair_curvatures& curvatures) const { return m_ranges.contains(spread(curvatures.values)); }

private:
  // Each byte in 16 bits of its own, in whichever order.
  static std::uint64_t spread(const std::array<std::uint8_t, 4>& bytes)
  {
    std::uint32_t all;
    std::memcpy(&all, bytes.data(), sizeof all);
    return (all & 0x00ff00ffu) | std::uint64_t(all & 0xff00ff00u) << 24;
  }

  Packed_ranges<16> m_ranges{0, 0};
};

// All ordered pairs of surfels of a scan whose distance is within `half_width` of `length`, by their angles: one
// look-up finds the pairs (C, c1) that may correspond to a pair (V, v1), the sphere of the paper's section 6 with the
// signed angles of the spatial descriptor.
//
// A Vertex_pair_index does the same for all lengths of a range, with tolerances of its own for each question. To build
// it for the pairs of one length takes 1.36 times as long (5.42 ms against 3.99 ms for 110,000 pairs, kernels.cpp), and
// each of its entries is three times as large, of which a search looks at more than a million.
class Surfel_pair_index
{
public:
  struct Entry
  {
    Pair_curvatures curvatures;
    std::uint16_t first, second;
  };

  Surfel_pair_index() = default;

  Surfel_pair_index(const std::vector<Surfel>& surfels, float length, float half_width)
  {
    std::vector<Vector> points;
    points.reserve(surfels.size());
    for (const Surfel& s : surfels) points.push_back(s.position.cast<double>());
    const Point_grid grid(points, double(length + half_width) / 2);
    struct Found_pair
    {
      std::uint16_t first, second, bin, reversed_bin;
    };
    // Surfels within a length of each other are some ten thousand pairs; that of another scan, of which this one is but
    // a speck, does not find them all.
    constexpr std::size_t most = 1000000;
    std::vector<Found_pair> pairs;
    const auto least = double((std::max)(length - half_width, 0.f)), most_apart = double(length + half_width);
    grid.for_each_pair_between(least, most_apart, [&](std::int32_t i, std::int32_t j, double) {
      Pair_cosines<float> c;
      if (!pair_cosines(surfels[std::size_t(i)], surfels[std::size_t(j)], c)) return true;
      pairs.push_back({std::uint16_t(i), std::uint16_t(j), std::uint16_t(bin(c)), std::uint16_t(bin(c.reversed()))});
      return pairs.size() < most;
    });
    std::vector<std::array<std::uint8_t, 2>> curvatures;
    curvatures.reserve(surfels.size());
    for (const Surfel& s : surfels)
      curvatures.push_back(
          {Pair_curvatures::quantise(s.minimal_curvature), Pair_curvatures::quantise(s.maximal_curvature)});
    m_entries = Bins<Entry>(bins, [&](const auto& add) {
      for (const Found_pair& p : pairs) {
        const auto &k = curvatures[p.first], &l = curvatures[p.second];
        add(p.bin, Entry{{{k[0], k[1], l[0], l[1]}}, p.first, p.second});
        add(p.reversed_bin, Entry{{{l[0], l[1], k[0], k[1]}}, p.second, p.first});
      }
    });
  }

  std::size_t size() const { return m_entries.items().size(); }

  // f(begin, end) for the runs of entries whose angles are close to `angles`: in each of the three the bin it is in and
  // the nearer neighbour.
  template <class Function>
  void for_each_run(const Pair_angles& angles, Function&& f) const
  {
    for (const int i : two_bins(angles.first * (float(angle_bins) / pi))) {
      if (i < 0 || i >= angle_bins) continue;
      for (const int j : two_bins(angles.second * (float(angle_bins) / pi))) {
        if (j < 0 || j >= angle_bins) continue;
        for (const int k : two_bins((angles.turn + pi) * (float(turn_bins) / (2 * pi)))) {
          const std::size_t c = bin(i, j, (k + turn_bins) % turn_bins);
          const Entry* const entries = m_entries.items().data();
          f(entries + m_entries.begin(c), entries + m_entries.end(c));
        }
      }
    }
  }

  std::size_t count(const Pair_angles& angles) const
  {
    std::size_t n = 0;
    for_each_run(angles, [&](const Entry* from, const Entry* to) { n += std::size_t(to - from); });
    return n;
  }

private:
  static constexpr float pi = 3.14159265f;
  static constexpr int angle_bins = 15, turn_bins = 20; // 12 and 18 degrees
  static constexpr std::size_t bins = std::size_t(angle_bins) * angle_bins * turn_bins;

  static std::array<int, 2> two_bins(float x)
  {
    const int b = int(std::floor(x - 0.5f));
    return {b, b + 1};
  }
  static std::size_t bin(int i, int j, int k)
  {
    return (std::size_t(i) * angle_bins + std::size_t(j)) * turn_bins + std::size_t(k);
  }
  // The bins by comparison with the cosines of their limits: no angle is computed.
  static int angle_bin(float cosine)
  {
    // cos 12, 24, ..., 84 degrees
    constexpr float limits[] = {0.97814760f, 0.91354546f, 0.80901699f, 0.66913061f, 0.5f, 0.30901699f, 0.10452846f};
    int b = 0;
    for (const float limit : limits) b += std::abs(cosine) < limit;
    return cosine < 0 ? angle_bins - 1 - b : b;
  }
  static int turn_bin(float cosine, float sine)
  {
    constexpr float tan_18 = 0.32491970f, tan_36 = 0.72654253f;
    const float x = std::abs(cosine), y = std::abs(sine), low = (std::min)(x, y), high = (std::max)(x, y);
    int b = (low >= tan_18 * high) + (low >= tan_36 * high);
    if (y > x) b = turn_bins / 4 - 1 - b;
    if (cosine < 0) b = turn_bins / 2 - 1 - b;
    return sine < 0 ? turn_bins / 2 - 1 - b : turn_bins / 2 + b;
  }
  static std::size_t bin(const Pair_cosines<float>& c)
  {
    return bin(angle_bin(c.first), angle_bin(c.second), turn_bin(c.turn, c.sine_of_turn));
  }

  Bins<Entry> m_entries;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_LOOKUP_SURFEL_PAIR_INDEX_H
