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

#ifndef CGAL_CRUDE_REGISTRATION_IO_INTERNAL_SCAN_BYTES_H
#define CGAL_CRUDE_REGISTRATION_IO_INTERNAL_SCAN_BYTES_H

// The door to the bytes of prepared scans.

#include <CGAL/Crude_registration/IO/IO_error.h>
#include <CGAL/Crude_registration/internal/base/compiled.h>
#include <CGAL/Crude_registration/internal/reduction/Reduced_scan.h>

#include <string>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// As save_scan() describes them. `other_side`: of the surface, or null.
std::string scan_bytes(const Reduced_scan& scan, const Reduced_scan* other_side);

// The scan, and behind it its other side if it has one. `name`: of the bytes, in errors. \throws IO_error
std::vector<Reduced_scan> scan_of_bytes(const std::string& bytes, const std::string& name);

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#ifndef CGAL_CRUDE_REGISTRATION_COMPILED
#include <CGAL/Crude_registration/IO/internal/scan_bytes_impl.h>
#endif

#endif // CGAL_CRUDE_REGISTRATION_IO_INTERNAL_SCAN_BYTES_H
