// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CRUDE_REGISTRATION_PYTHON_PREPARE_H
#define CRUDE_REGISTRATION_PYTHON_PREPARE_H

// Makes scans ready for registration, for all that do so.

#include "Interruption.h"
#include "Method.h"
#include "input.h"

#include <CGAL/Crude_registration/Scan.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>

// Seconds that are left, of a budget that began when this was made.
class Time_budget
{
public:
  Time_budget(const std::optional<double>& seconds, const std::string& function)
      : m_seconds(seconds.value_or((std::numeric_limits<double>::max)()))
  {
    if (!(m_seconds > 0 && std::isfinite(m_seconds)))
      throw py::value_error(function + ": time_budget has to be a finite number above zero");
  }

  double left() const
  {
    const double spent = std::chrono::duration<double>(std::chrono::steady_clock::now() - m_begin).count();
    constexpr double shortest = 1e-9;
    return (std::max)(shortest, m_seconds - spent);
  }

private:
  std::chrono::steady_clock::time_point m_begin = std::chrono::steady_clock::now();
  double m_seconds;
};

// Without the lock. \throws CR::IO_error, std::invalid_argument, CR::Preparation_interrupted, what the visitor throws
template <class Visitor>
std::shared_ptr<const Scan> prepared(const Scan_input& input, const Sensor_arguments& sensor, const Method& method,
                                     const Time_budget& budget, Visitor& visitor)
{
  if (input.scan) return input.scan;
  const std::shared_ptr<const Scan_file> contents = input.contents();
  return sensor_of(*contents, sensor)
      .add_to(p::time_budget(budget.left()).candidates(method).visitor(std::ref(visitor)), input.name,
              [&](const auto& np) { return std::make_shared<const Scan>(*contents, np, input.name); });
}

#endif // CRUDE_REGISTRATION_PYTHON_PREPARE_H
