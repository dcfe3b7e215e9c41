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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_ESTIMATE_FLAT_SENSOR_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_ESTIMATE_FLAT_SENSOR_H

// The sensor of a range image, found from its grid.

#include <CGAL/Crude_registration/internal/base/Flat_sensor.h>
#include <CGAL/Crude_registration/internal/base/Run_control.h>
#include <CGAL/Crude_registration/internal/base/compiled.h>
#include <CGAL/Crude_registration/internal/sampling/Flat_range_image.h>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// As estimate_sensor() describes it. \throws Run_control::Stopped
Flat_sensor estimated_sensor(const Flat_range_image& image, Run_control& control = to_the_end());

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#ifndef CGAL_CRUDE_REGISTRATION_COMPILED
#include <CGAL/Crude_registration/internal/sampling/estimate_flat_sensor_impl.h>
#endif

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_ESTIMATE_FLAT_SENSOR_H
