// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CRUDE_REGISTER_RUN_LIMITS_H
#define CRUDE_REGISTER_RUN_LIMITS_H

// The limits of a run, threads and time, which register and assemble take.

#include "options.h"

#include <CGAL/tags.h>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#endif

#include <chrono>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

using Clock = std::chrono::steady_clock;

inline double seconds_since(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Holds the number of threads to that of the option --threads, to the end of the program.
inline void limit_threads(const po::variables_map& map)
{
  const std::optional<int> threads = value_of<int>(map, "threads");
  if (threads && *threads < 1) throw Usage_error("--threads takes a number above zero");
#ifdef CGAL_LINKED_WITH_TBB
  // Never destroyed: where the limit is lifted, TBB starts a thread, which fails where memory has run out.
  [[maybe_unused]] static const tbb::global_control* limit = nullptr;
  if (threads) limit = new tbb::global_control(tbb::global_control::max_allowed_parallelism, std::size_t(*threads));
#endif
}

// The seconds of the option --time-budget; the largest number there is if it is not given.
inline double time_budget_of(const po::variables_map& map)
{
  const double budget = value_of<double>(map, "time-budget").value_or((std::numeric_limits<double>::max)());
  if (!(budget > 0 && std::isfinite(budget))) throw Usage_error("--time-budget takes seconds, above zero");
  return budget;
}

#endif // CRUDE_REGISTER_RUN_LIMITS_H
