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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_RUN_CONTROL_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_RUN_CONTROL_H

// Whether a run is to go on: its visitor and its time budget.

#include <CGAL/Crude_registration/named_parameters.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <exception>
#include <functional>
#include <limits>
#include <thread>
#include <utility>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Whether a run is to go on: asked often, by all of its threads. It ends for good when its time is over or its visitor
// says so; that is called by the thread alone that made the control, and no more than once a millisecond.
class Run_control
{
public:
  // Thrown by check().
  struct Stopped : std::exception
  {};

private:
  using Clock = std::chrono::steady_clock;

public:
  // Goes on to the end.
  Run_control() = default;

  // `go_further`: called with the share of the work that is done at most; may be empty. `seconds`: infinite for no end.
  Run_control(std::function<bool(double)> go_further, double seconds)
      : m_go_further(std::move(go_further)), m_is_limited(seconds < 1e9), m_is_watched(m_is_limited || m_go_further)
  {
    if (m_is_limited)
      m_end = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  }

  bool go_on()
  {
    if (!m_is_watched) return true;
    if (m_is_stopped.load(std::memory_order_relaxed)) return false;
    const Clock::time_point now = Clock::now();
    if (m_is_limited && now >= m_end) m_is_stopped = true;
    if (m_go_further && std::this_thread::get_id() == m_thread && now >= m_next_call) {
      if (!m_go_further(m_progress)) m_is_stopped = true;
      m_next_call = Clock::now() + std::chrono::milliseconds(1);
    }
    return !m_is_stopped;
  }

  bool is_stopped() const { return m_is_stopped; }

  // For what is of no use in parts: throws where go_on() says no.
  void check()
  {
    if (!go_on()) throw Stopped();
  }

  // The same within a loop, for its step `i`: now and then.
  void check(std::size_t i)
  {
    constexpr std::size_t every = 4096;
    if (i % every == 0) check();
  }

  // By the thread that made the control.
  void advance(double progress)
  {
    if (m_is_watched) m_progress = (double(m_part) + progress) / double(m_parts);
  }

  // What follows is one part of the work, of so many that take as long.
  void set_part(std::size_t part, std::size_t parts)
  {
    if (!m_is_watched) return; // the control of all that is not to be ended has no state
    m_part = part;
    m_parts = parts;
    advance(0);
  }

private:
  std::function<bool(double)> m_go_further;
  bool m_is_limited = false, m_is_watched = false;
  Clock::time_point m_end, m_next_call;
  std::thread::id m_thread = std::this_thread::get_id();
  std::size_t m_part = 0, m_parts = 1;
  double m_progress = 0;
  std::atomic<bool> m_is_stopped{false};
};

// The control of all that is not to be ended: nothing in it ever changes.
inline Run_control& to_the_end()
{
  static Run_control control;
  return control;
}

template <class Visitor>
Visitor& unwrapped(Visitor& visitor)
{
  return visitor;
}

template <class Visitor>
Visitor& unwrapped(std::reference_wrapper<Visitor>& visitor)
{
  return visitor.get();
}

// What the parameters `visitor` and `time_budget` ask for.
template <class NamedParameters>
std::function<bool(double)> visitor_parameter(const NamedParameters& np)
{
  if constexpr (is_given<NamedParameters, CGAL::internal_np::visitor_t>)
    return [visitor = parameter(np, CGAL::internal_np::visitor, 0)](double progress) mutable {
      unwrapped(visitor).progress(progress);
      return bool(unwrapped(visitor).go_further());
    };
  else return {};
}

template <class NamedParameters>
double time_budget_parameter(const NamedParameters& np, const char* function)
{
  if constexpr (is_given<NamedParameters, internal_np::time_budget_t>)
    return positive_parameter(np, internal_np::time_budget, 1, function, "time_budget");
  else return (std::numeric_limits<double>::infinity)();
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_RUN_CONTROL_H
