// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// Arrays of numpy, to what the package takes and from what it returns.

#include "arrays.h"

#include <stdexcept>

namespace {

std::string text_of(const py::handle& object)
{
  return py::str(object).cast<std::string>();
}

std::string kinds_in_words(const std::string& kinds)
{
  return kinds == "f" ? "float32 or float64" : kinds == "i" ? "an integer type" : "a type of numbers";
}

template <class Items>
py::array_t<double> to_rows(const Items& items)
{
  py::array_t<double> array({py::ssize_t(items.size()), py::ssize_t(3)});
  auto rows = array.mutable_unchecked<2>();
  for (std::size_t i = 0; i < items.size(); ++i)
    for (int k = 0; k < 3; ++k) rows(py::ssize_t(i), k) = items[i][k];
  return array;
}

std::optional<std::array<double, 3>> to_three(const py::handle& object, const std::string& argument)
{
  if (object.is_none()) return std::nullopt;
  const py::array array = to_array(object, argument, "fi");
  if (array.ndim() != 1 || array.shape(0) != 3)
    throw py::value_error(argument + ": three numbers are needed, not an array of shape " + shape_of(array));
  const auto numbers = to_coordinates(array, argument);
  return std::array<double, 3>{numbers.at(0), numbers.at(1), numbers.at(2)};
}

} // namespace

std::string shape_of(const py::array& array)
{
  return text_of(array.attr("shape"));
}

py::array to_array(const py::handle& object, const std::string& argument, const std::string& kinds)
{
  const py::module_ numpy = py::module_::import("numpy");
  if (py::isinstance(object, numpy.attr("ma").attr("MaskedArray")))
    throw py::type_error(argument + ": a masked array is not taken, as its mask would be lost; fill it first");
  const py::array array = numpy.attr("asarray")(object);
  const char kind = array.dtype().kind();
  const py::ssize_t size = array.dtype().itemsize();
  const bool is_float = kind == 'f' && (size == 4 || size == 8), is_integer = kind == 'i' || kind == 'u';
  if ((is_float && kinds.find('f') != std::string::npos) || (is_integer && kinds.find('i') != std::string::npos))
    return array;
  // An empty list has no type of its own.
  if (array.size() == 0 && !py::isinstance<py::array>(object)) return array;
  throw py::type_error(argument + ": the type of an array has to be " + kinds_in_words(kinds) + ", not " +
                       text_of(array.dtype()));
}

py::array_t<double> to_coordinates(const py::array& array, const std::string& argument)
{
  auto coordinates = py::array_t<double, plain>::ensure(array);
  if (!coordinates) {
    PyErr_Clear();
    throw py::type_error(argument + ": the array cannot be converted to float64");
  }
  return std::move(coordinates);
}

std::vector<Point> to_points(const py::array_t<double>& coordinates)
{
  const double* const c = coordinates.data();
  const auto n = std::size_t(coordinates.size()) / 3;
  std::vector<Point> points;
  points.reserve(n);
  for (std::size_t i = 0; i < n; ++i) points.emplace_back(c[3 * i], c[3 * i + 1], c[3 * i + 2]);
  return points;
}

std::optional<Point> to_point(const py::handle& object, const std::string& argument)
{
  const auto three = to_three(object, argument);
  if (!three) return std::nullopt;
  return Point((*three)[0], (*three)[1], (*three)[2]);
}

std::optional<Vector> to_vector(const py::handle& object, const std::string& argument)
{
  const auto three = to_three(object, argument);
  if (!three) return std::nullopt;
  return Vector((*three)[0], (*three)[1], (*three)[2]);
}

Motion to_motion(const py::handle& object, const std::string& argument)
{
  const py::array array = to_array(object, argument, "fi");
  if (array.ndim() != 2 || (array.shape(0) != 3 && array.shape(0) != 4) || array.shape(1) != 4)
    throw py::value_error(argument + ": a matrix of shape (4, 4) or (3, 4) is needed, not " + shape_of(array));
  const auto numbers = to_coordinates(array, argument);
  const auto m = numbers.unchecked<2>();
  if (m.shape(0) == 4 && !(m(3, 0) == 0 && m(3, 1) == 0 && m(3, 2) == 0 && m(3, 3) == 1))
    throw py::value_error(argument + ": the last row of the matrix has to be 0 0 0 1");
  return Motion(m(0, 0), m(0, 1), m(0, 2), m(0, 3), m(1, 0), m(1, 1), m(1, 2), m(1, 3), m(2, 0), m(2, 1), m(2, 2),
                m(2, 3));
}

py::array_t<double> to_matrix(const Motion& motion)
{
  py::array_t<double> array({4, 4});
  auto m = array.mutable_unchecked<2>();
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) m(i, j) = i < 3 ? motion.m(i, j) : j < 3 ? 0. : 1.;
  return array;
}

py::array_t<double> to_matrix(const std::array<std::array<double, 6>, 6>& rows)
{
  py::array_t<double> array({6, 6});
  auto m = array.mutable_unchecked<2>();
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j) m(py::ssize_t(i), py::ssize_t(j)) = rows[i][j];
  return array;
}

py::array_t<double> to_array(const std::vector<Point>& points)
{
  return to_rows(points);
}

py::array_t<double> to_array(const std::vector<Vector>& vectors)
{
  return to_rows(vectors);
}
