// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CRUDE_REGISTER_KNOWN_POSES_H
#define CRUDE_REGISTER_KNOWN_POSES_H

// Poses of scans that are known before they are put together, from a file.

#include "files.h"
#include "options.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

struct Known
{
  std::vector<std::optional<Transformation>> poses; // of each scan
  std::vector<std::size_t> groups;
  std::optional<std::size_t> reference;
};

std::size_t place_of(const std::string& name, const std::vector<std::string>& names, const std::string& option);

// The form that write_lines() writes; scans that are not given are passed over. \throws IO_error
Known known_of(const std::optional<std::string>& file, const std::vector<std::string>& names);

#endif // CRUDE_REGISTER_KNOWN_POSES_H
