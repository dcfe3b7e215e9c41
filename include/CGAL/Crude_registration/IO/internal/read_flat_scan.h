// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Author(s)     : The Crude_registration authors

#ifndef CGAL_CRUDE_REGISTRATION_IO_INTERNAL_READ_FLAT_SCAN_H
#define CGAL_CRUDE_REGISTRATION_IO_INTERNAL_READ_FLAT_SCAN_H

// The door to the readers: what is in a file, as flat arrays.

#include <CGAL/Crude_registration/IO/Depth_camera.h>
#include <CGAL/Crude_registration/IO/IO_error.h>
#include <CGAL/Crude_registration/IO/internal/Flat_scan_file.h>
#include <CGAL/Crude_registration/IO/internal/read_file.h>
#include <CGAL/Crude_registration/internal/base/compiled.h>

#include <string>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// As read_scan() describes it. \throws IO_error
Flat_scan_file read_flat_scan(const std::string& name, const Depth_camera& camera);

// The names by which read_flat_scan() reads the scans of a file, one after the other: its own, or with #1, #2, ...
// behind where it holds several. Only the heads of these are looked at. \throws IO_error
std::vector<std::string> names_of_scans(const std::string& filename);

// A PLY file that holds a range image; `name`: of the file, in errors. \throws IO_error
Flat_scan_file parse_flat_range_image(const std::string& data, const std::string& name);

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#ifndef CGAL_CRUDE_REGISTRATION_COMPILED
#include <CGAL/Crude_registration/IO/internal/read_flat_scan_impl.h>
#endif

#endif // CGAL_CRUDE_REGISTRATION_IO_INTERNAL_READ_FLAT_SCAN_H
