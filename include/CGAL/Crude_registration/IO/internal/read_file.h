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

#ifndef CGAL_CRUDE_REGISTRATION_IO_INTERNAL_READ_FILE_H
#define CGAL_CRUDE_REGISTRATION_IO_INTERNAL_READ_FILE_H

// The bytes of a file.

#include <string>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// \throws IO_error
std::string read_file(const std::string& filename);

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_INTERNAL_READ_FILE_H
