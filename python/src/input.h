// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CRUDE_REGISTRATION_PYTHON_INPUT_H
#define CRUDE_REGISTRATION_PYTHON_INPUT_H

// What a caller may pass as a scan or as a surface: a file, arrays, or what the module itself has made.

#include "types.h"

#include <memory>
#include <optional>
#include <string>

// Where the sensor stood, if the caller says it.
struct Sensor_arguments
{
  std::optional<Point> viewpoint;
  std::optional<Vector> viewing_direction;

  bool is_given() const { return viewpoint || viewing_direction; }

  // Calls f with the pack of named parameters `np` and what is given of the sensor.
  template <class Parameters, class Function>
  auto add_to(const Parameters& np, const std::string& name, const Function& f) const
  {
    if (viewpoint && viewing_direction)
      throw std::invalid_argument(name + ": both viewpoint and viewing_direction are given");
    if (viewpoint) return f(np.viewpoint(*viewpoint));
    if (viewing_direction) return f(np.viewing_direction(*viewing_direction));
    return f(np);
  }
};

// What the caller says of the sensor, or else the file; a range image has its own.
Sensor_arguments sensor_of(const Scan_file& file, const Sensor_arguments& given);

// The name of a file as the system takes it, or nothing if the object is no path. \throws py::value_error
std::optional<std::string> to_path(const py::handle& object);

// What there is to be prepared.
struct Scan_input
{
  std::shared_ptr<const Scan> scan;      // if it is prepared already
  std::shared_ptr<const Scan_file> file; // else, but for a file that is still to be read
  std::string name;                      // in the text of errors; of a file its path

  // What is in it: reads the file, if need be, for which no lock is held. \throws CR::IO_error
  std::shared_ptr<const Scan_file> contents() const
  {
    return file ? file : std::make_shared<const Scan_file>(CR::read_scan<Kernel>(name));
  }
};

// `object`: a path, an array of shape (n, 3) or (rows, columns, 3), a `Mesh`, a `ScanFile` or a `Scan`; `faces` or
// `normals`: of an array of shape (n, 3), or None. `argument`: how errors call it.
// \throws py::type_error, py::value_error
Scan_input to_input(const py::handle& object, const py::handle& faces, const py::handle& normals,
                    const std::string& argument);

// The surface of an input that is no `Scan`. \throws py::type_error, CR::IO_error, std::invalid_argument
Surface to_surface(const py::handle& object, const std::string& argument);

// The vertices and faces, as the `Mesh` of the module.
py::object to_mesh(const Surface& surface);

#endif // CRUDE_REGISTRATION_PYTHON_INPUT_H
