// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_SURFEL_PAIR_INDEX_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_SURFEL_PAIR_INDEX_H

#include <CGAL/Crude_registration/internal/Surfel_field.h>
#include <CGAL/Crude_registration/internal/Point_grid.h>
#include <CGAL/Crude_registration/internal/fast_angles.h>

#include <Eigen/Geometry>

#include <array>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Two surfels as seen from each other: the angles between their normals and the line from the first to the second, and
// the signed turn about that line from the first normal to the second. With the length of the line all that a rigid
// motion leaves of two points with normals.
struct Pair_angles
{
  float first, second, turn; // radians: [0, pi], [0, pi], [-pi, pi]
};

// False where a normal is so close to the line that the turn means nothing, or there is no line.
inline bool pair_angles(const Surfel& a, const Surfel& b, Pair_angles& angles)
{
  Vector_f d = b.position - a.position;
  const float length = d.norm();
  if (!(length > 0)) return false;
  d /= length;
  const float ca = a.normal.dot(d), cb = b.normal.dot(d);
  constexpr float most = 0.98f;
  if (!(std::abs(ca) < most && std::abs(cb) < most)) return false;
  const Vector_f x = a.normal - ca * d, y = b.normal - cb * d;
  angles.first = float(fast_acos(double(ca)));
  angles.second = float(fast_acos(double(cb)));
  angles.turn = float(fast_atan2(double(d.dot(x.cross(y))), double(x.dot(y))));
  return true;
}

// The axes that two surfels span: the line between them, and the mean of their normals as far as it is perpendicular.
// Maps equal pairs onto each other: rotation = pair_frame(target pair) * pair_frame(source pair)^T.
inline Matrix_f pair_frame(const Surfel& a, const Surfel& b)
{
  Vector_f x = b.position - a.position;
  x /= x.norm();
  Vector_f z = a.normal + b.normal;
  z -= z.dot(x) * x;
  float length2 = z.squaredNorm();
  if (length2 < 0.09f) {
    z = a.normal - a.normal.dot(x) * x;
    length2 = z.squaredNorm();
  }
  z /= std::sqrt(length2);
  Matrix_f f;
  f.col(0) = x;
  f.col(1) = z.cross(x);
  f.col(2) = z;
  return f;
}

// The curvatures of a pair, in bytes; agreement is a difference of at most a tolerance in each.
struct Pair_curvatures
{
  std::array<std::uint8_t, 4> values;

  static std::uint8_t quantise(float k) { return std::uint8_t((std::min)((std::max)(k * 128 + 128.5f, 0.f), 255.f)); }

  static Pair_curvatures of(const Surfel& a, const Surfel& b)
  {
    return {{quantise(a.minimal_curvature), quantise(a.maximal_curvature), quantise(b.minimal_curvature),
             quantise(b.maximal_curvature)}};
  }

  bool agrees(const Pair_curvatures& o, int tolerance) const
  {
    int worst = 0;
    for (std::size_t i = 0; i < 4; ++i) worst = (std::max)(worst, std::abs(int(values[i]) - int(o.values[i])));
    return worst <= tolerance;
  }
};

// All ordered pairs of surfels of a scan whose distance is within `half_width` of `length`, by their angles: one
// look-up finds the pairs (C, c1) that may correspond to a pair (V, v1), the sphere of the paper's section 6 with the
// signed angles of the spatial descriptor.
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
    std::vector<std::array<std::uint8_t, 2>> curvatures;
    points.reserve(surfels.size());
    curvatures.reserve(surfels.size());
    for (const Surfel& s : surfels) {
      points.push_back(s.position.cast<double>());
      curvatures.push_back(
          {Pair_curvatures::quantise(s.minimal_curvature), Pair_curvatures::quantise(s.maximal_curvature)});
    }
    const Point_grid grid(points, double(length + half_width) / 2);
    const double least = double(length - half_width) * double(length - half_width);
    struct Item
    {
      Entry entry;
      std::uint16_t bin;
    };
    // Surfels within a length of each other are some hundred thousand pairs; that of another scan, of which this one is
    // but a speck, does not find them all.
    constexpr std::size_t most = 2000000;
    std::vector<Item> items;
    m_offsets.assign(bins + 1, 0);
    for (std::size_t i = 0; i < surfels.size() && items.size() < most; ++i)
      grid.for_each_within(points[i], double(length + half_width), [&](std::int32_t j, double d2) {
        Pair_angles a;
        if (d2 < least || std::size_t(j) <= i || !pair_angles(surfels[i], surfels[std::size_t(j)], a)) return;
        const auto add = [&](std::size_t from, std::size_t to, const Pair_angles& angles) {
          const std::size_t b = bin(angles);
          ++m_offsets[b + 1];
          const auto &k = curvatures[from], &l = curvatures[to];
          items.push_back({{{{k[0], k[1], l[0], l[1]}}, std::uint16_t(from), std::uint16_t(to)}, std::uint16_t(b)});
        };
        add(i, std::size_t(j), a);
        // Seen from the other end the angles are supplements and the turn is the same.
        add(std::size_t(j), i, {pi - a.second, pi - a.first, a.turn});
      });
    for (std::size_t b = 0; b < bins; ++b) m_offsets[b + 1] += m_offsets[b];
    m_entries.resize(items.size());
    std::vector<std::uint32_t> next(m_offsets.begin(), m_offsets.end() - 1);
    for (const Item& item : items) m_entries[next[item.bin]++] = item.entry;
  }

  std::size_t size() const { return m_entries.size(); }

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
          f(m_entries.data() + m_offsets[c], m_entries.data() + m_offsets[c + 1]);
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
  static std::size_t bin(const Pair_angles& a)
  {
    return bin((std::min)(int(a.first * (float(angle_bins) / pi)), angle_bins - 1),
               (std::min)(int(a.second * (float(angle_bins) / pi)), angle_bins - 1),
               (std::max)(0, int((a.turn + pi) * (float(turn_bins) / (2 * pi)))) % turn_bins);
  }

  std::vector<std::uint32_t> m_offsets;
  std::vector<Entry> m_entries;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_SURFEL_PAIR_INDEX_H
