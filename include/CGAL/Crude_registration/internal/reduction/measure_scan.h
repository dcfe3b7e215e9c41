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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_MEASURE_SCAN_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_MEASURE_SCAN_H

// The measures of a scan that section 4 of the paper builds on: its extent, and the error that is allowed.

#include <CGAL/Crude_registration/internal/base/Flat_sensor.h>
#include <CGAL/Crude_registration/internal/base/compiled.h>
#include <CGAL/Crude_registration/internal/mesh/Flat_mesh.h>
#include <CGAL/Crude_registration/internal/sampling/Flat_range_image.h>

#include <algorithm>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// A range image of known or estimated sensor with its triangulation.
struct Flat_range_mesh
{
  Flat_range_image image;
  Sampling samples;
  Flat_mesh mesh;

  explicit Flat_range_mesh(Flat_range_image image);
};

// The edge lengths of the box that contains a scan: horizontal and vertical in the image plane, and in depth.
Vector extent_of_mesh(const Flat_mesh& mesh, const Flat_sensor& sensor);
Vector extent_of_image(const Flat_range_image& image, const Flat_mesh& mesh);

// The share of the vertices that are not hyperbolic, in percent.
double percent_smooth(const Flat_mesh& mesh);

// The sampling distance, the surface types and the extent put together: section 4 of the paper. A scan without any
// smooth vertex would have no finite error; below one per cent the share of smooth vertices counts as one per cent.
inline double approximation_error(double sampling_distance, double image_size, double percent_smooth)
{
  return 0.15 * sampling_distance * image_size / (std::max)(percent_smooth, 1.0);
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#ifndef CGAL_CRUDE_REGISTRATION_COMPILED
#include <CGAL/Crude_registration/internal/reduction/measure_scan_impl.h>
#endif

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_MEASURE_SCAN_H
