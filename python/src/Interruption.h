// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CRUDE_REGISTRATION_PYTHON_INTERRUPTION_H
#define CRUDE_REGISTRATION_PYTHON_INTERRUPTION_H

// What looks after Python while the package works without its lock: signals such as Ctrl-C, and the caller's progress.

#include "types.h"

#include <atomic>
#include <chrono>

// A model of RegistrationVisitor. Constructed under the lock.
class Interruption
{
public:
  // `progress`: a function of the share of the work that is done, whose False ends it; or None.
  explicit Interruption(const py::object& progress) : m_progress(progress)
  {
    if (!progress.is_none() && PyCallable_Check(progress.ptr()) == 0)
      throw py::type_error("progress: a function is needed, or None");
    if (!progress.is_none()) m_next = Clock::now(); // is called at least once
  }

  void progress(double share) { m_share = share; }

  bool go_further()
  {
    const auto now = Clock::now();
    if (m_has_ended || now < m_next) return !m_has_ended;
    {
      py::gil_scoped_acquire lock;
      // Signals are of the main thread: nothing happens in others.
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (!m_progress.is_none() && m_progress(m_share).is(py::bool_(false))) m_has_ended = true;
    }
    m_next = Clock::now() + interval();
    return !m_has_ended;
  }

private:
  using Clock = std::chrono::steady_clock;

  // Short enough for who waits, long enough that the lock, for which another thread of Python may make us wait some
  // milliseconds (sys.getswitchinterval() is 5), costs a tenth at most.
  static Clock::duration interval() { return std::chrono::milliseconds(50); }

  py::object m_progress;
  double m_share = 0;
  std::atomic<bool> m_has_ended{false};
  Clock::time_point m_next = Clock::now() + interval();
};

#endif // CRUDE_REGISTRATION_PYTHON_INTERRUPTION_H
