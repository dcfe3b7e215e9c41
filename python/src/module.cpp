// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// The Python module: its parts, and how errors of the package become those of Python.

#include "types.h"

#include <CGAL/Crude_registration/IO/IO_error.h>

#include <exception>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace {

// Names of files need not be UTF-8.
void set_error(PyObject* type, const char* text)
{
  const py::object message = py::reinterpret_steal<py::object>(PyUnicode_DecodeFSDefault(text));
  if (message) PyErr_SetObject(type, message.ptr());
}

} // namespace

PYBIND11_MODULE(_core, module)
{
  py::options options;
  options.disable_function_signatures();
  module.doc() = "The part of crude_registration that is written in C++.";

  static const py::object interrupted = py::module_::import("crude_registration._types").attr("PreparationInterrupted");
  py::register_exception_translator([](std::exception_ptr exception) {
    try {
      if (exception) std::rethrow_exception(exception);
    } catch (const CR::Preparation_interrupted& e) {
      set_error(interrupted.ptr(), e.what());
    } catch (const CR::IO_error& e) {
      std::error_code error;
      const bool is_missing = std::filesystem::status(e.file(), error).type() == std::filesystem::file_type::not_found;
      set_error(is_missing ? PyExc_FileNotFoundError : PyExc_OSError, e.what());
    } catch (const std::invalid_argument& e) {
      set_error(PyExc_ValueError, e.what());
    }
  });

  bind_scans(module);
  bind_registration(module);
  bind_assembly(module);
  bind_judgement(module);
  bind_tools(module);
  bind_simulation(module);
}
