// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CRUDE_REGISTER_REPORT_ASSEMBLY_H
#define CRUDE_REGISTER_REPORT_ASSEMBLY_H

// The report of an assembly of many scans.

#include "assembly_files.h"
#include "surfaces.h"

#include <CGAL/Crude_registration/Scan.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

// `surface(i)`: what a picture shows of a scan. `points(i)`: its samples.
void write_assembly_report(const std::string& file, const Assembly& result, const std::vector<CR::Scan<Kernel>>& scans,
                           const std::vector<std::string>& names,
                           const std::function<std::vector<Point>(std::size_t)>& points,
                           const std::function<Surface(std::size_t)>& surface);

#endif // CRUDE_REGISTER_REPORT_ASSEMBLY_H
