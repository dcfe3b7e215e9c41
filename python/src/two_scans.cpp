// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// The source and the target of a function, prepared at the same time.

#include "two_scans.h"

#include "arrays.h"

#include <atomic>
#include <chrono>
#include <cstddef>
#include <exception>
#include <future>
#include <optional>

namespace {

// What a program may do while another thread prepares a scan: end it.
struct Stop_flag
{
  std::atomic<bool> is_set{false};

  void progress(double) {}
  bool go_further() const { return !is_set; }
};

} // namespace

Two_scans::Two_scans(const py::object& source, const py::object& target, const Sensor_objects& sensors,
                     const std::string& function)
    : m_inputs{to_input(source, py::none(), py::none(), function + ": source"),
               to_input(target, py::none(), py::none(), function + ": target")}
{
  const auto viewpoint_of = [&](const py::object& object, const char* name) {
    return to_point(object, function + ": " + name);
  };
  const auto direction_of = [&](const py::object& object, const char* name) {
    return to_vector(object, function + ": " + name);
  };
  m_sensors = {Sensor_arguments{viewpoint_of(sensors.source_viewpoint, "source_viewpoint"),
                                direction_of(sensors.source_viewing_direction, "source_viewing_direction")},
               Sensor_arguments{viewpoint_of(sensors.target_viewpoint, "target_viewpoint"),
                                direction_of(sensors.target_viewing_direction, "target_viewing_direction")}};
  const std::optional<Point> both = viewpoint_of(sensors.viewpoint, "viewpoint");
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string side = i == 0 ? "source" : "target";
    if (both && m_sensors[i].is_given())
      throw py::value_error(function + ": viewpoint is that of both scans, but the one of the " + side +
                            " is given, too");
    if (both) m_sensors[i].viewpoint = both;
    if (m_inputs[i].scan && m_sensors[i].is_given())
      throw py::value_error(function + ": the " + side + " is a Scan, which knows its sensor; none is to be given");
  }
}

std::array<std::shared_ptr<const Scan>, 2> Two_scans::prepared(const Method& method, const Time_budget& budget,
                                                               Interruption& interruption, bool parallel) const
{
  if (!parallel || m_inputs[0].scan || m_inputs[1].scan)
    return {::prepared(m_inputs[0], m_sensors[0], method, budget, interruption),
            ::prepared(m_inputs[1], m_sensors[1], method, budget, interruption)};
  Stop_flag flag;
  std::future<std::shared_ptr<const Scan>> second =
      std::async(std::launch::async, [&] { return ::prepared(m_inputs[1], m_sensors[1], method, budget, flag); });
  std::shared_ptr<const Scan> first;
  try {
    first = ::prepared(m_inputs[0], m_sensors[0], method, budget, interruption);
    while (second.wait_for(std::chrono::milliseconds(10)) != std::future_status::ready)
      if (!interruption.go_further()) throw CR::Preparation_interrupted(m_inputs[1].name);
  } catch (...) {
    flag.is_set = true;
    second.wait();
    throw;
  }
  return {first, second.get()};
}
