// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CRUDE_REGISTER_MODEL_SURFACE_H
#define CRUDE_REGISTER_MODEL_SURFACE_H

// The surface of an assembled model as one mesh.

#include "options.h"

#include <CGAL/Crude_registration/Assembly_result.h>
#include <CGAL/Crude_registration/Scan.h>

#include <string>
#include <vector>

constexpr const char* surface_methods = "advancing-front, scale-space or poisson";

// \throws Usage_error if there is no such method
void check_surface_method(const std::string& method);

// Writes the mesh (PLY) of the largest component, in its frame: of the points that its scans have together, one for
// each cell of about two sampling distances.
void write_model_surface(const std::string& file, const std::string& method, const CR::Assembly_result<Kernel>& result,
                         const std::vector<CR::Scan<Kernel>>& scans);

#endif // CRUDE_REGISTER_MODEL_SURFACE_H
