// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CRUDE_REGISTRATION_PYTHON_ARRAYS_H
#define CRUDE_REGISTRATION_PYTHON_ARRAYS_H

// Arrays of numpy, to what the package takes and from what it returns. All is copied: what is passed may change later.

#include "types.h"

#include <pybind11/numpy.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

// Of an array whose elements follow each other and lie where the processor reads them, or a copy that is so.
constexpr int plain = py::array::c_style | py::array::forcecast | py::detail::npy_api::NPY_ARRAY_ALIGNED_;

// What numpy makes of an object, if that is an array of numbers of the kinds, 'f' for floats of 32 or 64 bits, 'i' for
// integers. `argument`: how errors call it. \throws py::type_error
py::array to_array(const py::handle& object, const std::string& argument, const std::string& kinds);

// The shape as Python writes it.
std::string shape_of(const py::array& array);

// The coordinates of an array of shape (n, 3), or (rows, columns, 3), whatever its strides and the order of its bytes.
py::array_t<double> to_coordinates(const py::array& array, const std::string& argument);

std::vector<Point> to_points(const py::array_t<double>& coordinates);

// Three finite or other numbers, integers included.
std::optional<Point> to_point(const py::handle& object, const std::string& argument);
std::optional<Vector> to_vector(const py::handle& object, const std::string& argument);

// A 4 x 4 matrix, or its first three rows.
Motion to_motion(const py::handle& object, const std::string& argument);

py::array_t<double> to_matrix(const Motion& motion);
py::array_t<double> to_matrix(const std::array<std::array<double, 6>, 6>& rows);
py::array_t<double> to_array(const std::vector<Point>& points);
py::array_t<double> to_array(const std::vector<Vector>& vectors);

#endif // CRUDE_REGISTRATION_PYTHON_ARRAYS_H
