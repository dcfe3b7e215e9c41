// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CRUDE_REGISTER_APPLY_H
#define CRUDE_REGISTER_APPLY_H

// The option --apply: the user's own files, moved.

#include "files.h"
#include "options.h"

#include <optional>
#include <string>
#include <vector>

// Told before the work: where a scan is of a format that is not written.
void check_apply(const std::string& scan);

// Told before the work: where a scan cannot be written moved, to a file of this name.
void check_apply(const std::string& scan, const std::string& output);

// The value of --apply, for one scan: the name of the file, or of a folder that there is.
std::optional<std::string> apply_option(const po::variables_map& map, const std::string& scan);

constexpr const char* apply_help = "file, or folder that there is, for the file SOURCE as it is but moved to the "
                                   "target: in its own format, with all that "
                                   "is in it (colours, intensities, texture, faces, comments), normals turned";

// Writes a scan moved. Where floats lose more of it than a hundredth of its sampling distance, a sentence says so, else
// none.
std::string apply(const std::string& scan, const std::string& output, const Transformation& motion, double spacing);

// The files in a folder that scans are moved to: their own names.
std::vector<std::string> applied_names(const std::string& folder, const std::vector<std::string>& scans);

#endif // CRUDE_REGISTER_APPLY_H
