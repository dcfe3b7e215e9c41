// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_BENCHMARK_CPU_TIME_H
#define CGAL_CRUDE_REGISTRATION_BENCHMARK_CPU_TIME_H

#include <algorithm>
#include <cstddef>
#include <ctime>
#include <vector>

namespace benchmark_tools {

// The time that this process has computed for: others on the machine do not count.
inline double cpu_seconds()
{
  return double(std::clock()) / CLOCKS_PER_SEC;
}

// The upper one of two middle values. \pre There is a value.
inline double median(std::vector<double> values)
{
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

} // namespace benchmark_tools

#endif // CGAL_CRUDE_REGISTRATION_BENCHMARK_CPU_TIME_H
