// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CRUDE_REGISTER_SCAN_ARGUMENTS_H
#define CRUDE_REGISTER_SCAN_ARGUMENTS_H

// Files, folders and patterns of names where scans are expected.

#include <string>
#include <vector>

// The scans that arguments stand for: files, folders, patterns.
std::vector<std::string> scans_of_arguments(const std::vector<std::string>& arguments);

// The one scan that an argument stands for.
std::string scan_of_argument(const std::string& argument);

#endif // CRUDE_REGISTER_SCAN_ARGUMENTS_H
