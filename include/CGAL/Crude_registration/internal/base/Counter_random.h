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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_COUNTER_RANDOM_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_COUNTER_RANDOM_H

// Random numbers by counting: the same, whatever the order in which they are asked for.

#include <bitset>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Random numbers that are a function of a seed and a counter: the order in which they are asked for does not matter,
// and the bits are the same with every compiler and standard library (std::normal_distribution and std::log promise
// neither).
class Counter_random
{
  std::uint64_t m_seed;

  // The finaliser of SplitMix64 (Steele, Lea, Flood, OOPSLA 2014).
  static std::uint64_t mix(std::uint64_t z)
  {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

public:
  // One number for another.
  static std::uint64_t mixed(std::uint64_t x) { return mix(x + 0x9e3779b97f4a7c15u); }

  explicit Counter_random(std::uint64_t seed) : m_seed(mixed(seed)) {}

  // Independent numbers for every sub-stream of the same seed.
  Counter_random stream(std::uint64_t i) const { return Counter_random(bits(i)); }

  std::uint64_t bits(std::uint64_t counter) const { return mix(m_seed + (counter + 1) * 0x9e3779b97f4a7c15u); }

  // In [0, 1).
  double uniform(std::uint64_t counter) const { return static_cast<double>(bits(counter) >> 11) * 0x1p-53; }

  // Standard normal: the ones among 256 random bits, a binomial distribution of variance 64, made continuous by a
  // uniform number of variance 1/12. Excess kurtosis -0.008; only additions and one square root, hence the same bits
  // everywhere.
  double normal(std::uint64_t counter) const
  {
    const Counter_random words(bits(counter));
    std::size_t ones = 0;
    for (std::uint64_t i = 0; i < 4; ++i) ones += std::bitset<64>(words.bits(i)).count();
    return (static_cast<double>(ones) - 128.5 + words.uniform(4)) / std::sqrt(64. + 1. / 12.);
  }
};

// 0 .. n-1 in a fixed order without pattern.
inline std::vector<std::int32_t> shuffled(std::size_t n, std::uint64_t seed)
{
  std::vector<std::int32_t> order(n);
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t i = n; i > 1; --i) std::swap(order[i - 1], order[Counter_random::mixed(seed + i) % i]);
  return order;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_COUNTER_RANDOM_H
