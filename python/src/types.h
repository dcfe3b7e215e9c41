// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CRUDE_REGISTRATION_PYTHON_TYPES_H
#define CRUDE_REGISTRATION_PYTHON_TYPES_H

// The types of the package as the module instantiates them, and the parts that the module is made of.

#include <CGAL/Crude_registration/IO/read_scan.h>
#include <CGAL/Crude_registration/Registration_result.h>
#include <CGAL/Crude_registration/Scan.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <pybind11/pybind11.h>

namespace py = pybind11;
namespace CR = CGAL::Crude_registration;
namespace p = CR::parameters;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;
using Motion = Kernel::Aff_transformation_3;
using Surface = CGAL::Surface_mesh<Point>;
using Scan = CR::Scan<Kernel>;
using Scan_file = CR::Scan_file<Kernel>;
using Result = CR::Registration_result<Kernel>;

void bind_scans(py::module_& module);
void bind_registration(py::module_& module);
void bind_assembly(py::module_& module);
void bind_judgement(py::module_& module);
void bind_tools(py::module_& module);
void bind_simulation(py::module_& module);

#endif // CRUDE_REGISTRATION_PYTHON_TYPES_H
