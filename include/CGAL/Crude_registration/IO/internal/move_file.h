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

#ifndef CGAL_CRUDE_REGISTRATION_IO_INTERNAL_MOVE_FILE_H
#define CGAL_CRUDE_REGISTRATION_IO_INTERNAL_MOVE_FILE_H

// The door to moving what is in a file of a scan.

#include <CGAL/Crude_registration/IO/internal/Moved_numbers.h>
#include <CGAL/Crude_registration/internal/base/compiled.h>

#include <string>

namespace CGAL {
namespace Crude_registration {
namespace internal {

struct Moved_file
{
  std::string data;
  double rounding = 0; // of a coordinate, at most
};

// The contents of a file, moved, as apply_motion() describes it. `packed`: by gzip. \throws IO_error
Moved_file moved_file(const std::string& name, const Similarity& motion, bool packed);

// \throws IO_error where the file cannot be moved, as far as its head says.
void check_file_can_be_moved(const std::string& name);

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#ifndef CGAL_CRUDE_REGISTRATION_COMPILED
#include <CGAL/Crude_registration/IO/internal/move_file_impl.h>
#endif

#endif // CGAL_CRUDE_REGISTRATION_IO_INTERNAL_MOVE_FILE_H
