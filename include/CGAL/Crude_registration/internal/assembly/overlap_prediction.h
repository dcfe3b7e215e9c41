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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_OVERLAP_PREDICTION_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_OVERLAP_PREDICTION_H

// Tells which scans are likely to overlap, at the cost of a scalar product a pair.

#include <CGAL/Crude_registration/internal/base/Counter_random.h>
#include <CGAL/Crude_registration/internal/lookup/Surfel_pair_index.h>
#include <CGAL/Crude_registration/internal/reduction/Reduced_scan.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// How often pairs of oriented points of some length occur in a scan, by their length and angles: what a rigid motion
// leaves of them. Scans share the pairs that lie where they overlap (Wahl, Hillenbrand, Hirzinger,
// "Surflet-pair-relation histograms", 2003, for whole objects).
class Pair_histogram
{
public:
  static constexpr std::size_t lengths = 3, angles = 6, turns = 8, size = lengths * angles * angles * turns;

  // `unit`: the length that pairs are measured by, the same for all scans.
  Pair_histogram(const Reduced_scan& scan, double unit)
  {
    m_bins.fill(0);
    const std::vector<Surfel>& surfels = scan.coarse.surfels;
    if (surfels.size() < 2) return;
    constexpr std::uint64_t draws = 1 << 16;
    constexpr float shortest = 0.1f, longest = 0.4f;
    const auto scale = float(1 / unit);
    for (std::uint64_t k = 0; k < draws; ++k) {
      const std::uint64_t r = Counter_random::mixed(k);
      const Surfel &a = surfels[std::size_t(r & 0xffffffffu) % surfels.size()],
                   &b = surfels[std::size_t(r >> 32) % surfels.size()];
      const float length = (b.position - a.position).norm() * scale;
      Pair_cosines<float> c;
      if (length < shortest || length >= longest || !pair_cosines(a, b, c)) continue;
      const auto l = std::size_t((length - shortest) / (longest - shortest) * float(lengths));
      add((std::min)(l, lengths - 1), c.angles());
      add((std::min)(l, lengths - 1), c.reversed().angles());
    }
    double sum = 0;
    for (const float n : m_bins) sum += double(n);
    for (float& n : m_bins) n = sum > 0 ? float(std::sqrt(double(n) / sum)) : 0;
  }

  // The square roots of the shares.
  const std::array<float, size>& bins() const { return m_bins; }

  // Bhattacharyya's measure of what two distributions share.
  float similarity(const Pair_histogram& other) const
  {
    float sum = 0;
    for (std::size_t i = 0; i < size; ++i) sum += m_bins[i] * other.m_bins[i];
    return sum;
  }

private:
  void add(std::size_t length, const Pair_angles& a)
  {
    constexpr float pi = 3.14159265f;
    const auto bin = [](float share, std::size_t n) {
      return (std::min)(std::size_t((std::max)(share, 0.f) * float(n)), n - 1);
    };
    m_bins[((length * angles + bin(a.first / pi, angles)) * angles + bin(a.second / pi, angles)) * turns +
           bin((a.turn + pi) / (2 * pi), turns)] += 1;
  }

  std::array<float, size> m_bins;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_OVERLAP_PREDICTION_H
