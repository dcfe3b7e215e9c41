// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_CALIBRATION_PACKAGE_RANDOM_H
#define CGAL_CRUDE_REGISTRATION_CALIBRATION_PACKAGE_RANDOM_H

// The random numbers of the package, of which scenes are made that are the same on every machine.

#include <CGAL/Crude_registration/internal/base/Counter_random.h>

namespace benchmark_tools {

using Package_random = CGAL::Crude_registration::internal::Counter_random;

} // namespace benchmark_tools

#endif // CGAL_CRUDE_REGISTRATION_CALIBRATION_PACKAGE_RANDOM_H
