// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CRUDE_REGISTRATION_PYTHON_TWO_SCANS_H
#define CRUDE_REGISTRATION_PYTHON_TWO_SCANS_H

// The source and the target of a function, prepared at the same time.

#include "Interruption.h"
#include "Method.h"
#include "input.h"
#include "prepare.h"

#include <array>
#include <memory>
#include <string>

// What a caller passes of the sensors, unchecked.
struct Sensor_objects
{
  py::object viewpoint, source_viewpoint, target_viewpoint, source_viewing_direction, target_viewing_direction;
};

struct Two_scans
{
  // `function`: in the text of errors. \throws py::type_error, py::value_error
  Two_scans(const py::object& source, const py::object& target, const Sensor_objects& sensors,
            const std::string& function);

  // Both, the one in a thread of its own, if there are two to prepare. Without the lock. Of the errors of both that of
  // the source is passed on, whichever comes first.
  std::array<std::shared_ptr<const Scan>, 2> prepared(const Method& method, const Time_budget& budget,
                                                      Interruption& interruption, bool parallel) const;

private:
  std::array<Scan_input, 2> m_inputs;
  std::array<Sensor_arguments, 2> m_sensors;
};

#endif // CRUDE_REGISTRATION_PYTHON_TWO_SCANS_H
