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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_REDUCED_SCAN_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_REDUCED_SCAN_H

// What is computed once for a scan, and used by every pair that it takes part in.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/internal/lookup/Depth_buffer.h>
#include <CGAL/Crude_registration/internal/lookup/Surfel_field.h>
#include <CGAL/Crude_registration/internal/reduction/Simplified_scan.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The surface at one resolution.
struct Surfel_level
{
  float spacing = 0;
  std::vector<Surfel> surfels;
  std::vector<std::uint8_t> borders; // 1 where the surfels around do not surround it
  std::vector<float> weights;        // number of samples
  std::vector<std::int32_t> probes;  // surfels that stand for all, in an order such that each beginning does
  Surfel_field field;
  // How well the plane of one surfel tells the next one: three quarters of the neighbours are off by less. What noise
  // and curvature leave of a comparison of two scans at this resolution.
  float height_noise = 0; // in spacings
  float normal_noise = 0; // radians
};

// What is computed once per scan and used by every pair it takes part in, in a frame of the scan's own, so that nothing
// depends on the frame of the input or the order of its vertices but rounding.
struct Reduced_scan
{
  Rigid_motion own_from_input;
  std::size_t number_of_samples = 0;
  double spacing = 0;  // root of the area per sample
  double extent = 0;   // M = (Dx + Dy + Dz) / 3 in the own frame
  Surfel_level coarse; // a few thousand surfels: search
  Surfel_level fine;   // at most some ten thousand: judgement
  Depth_buffer depths;
  bool is_body = false; // the whole surface of one, and no sensor is known: see encloses_a_body()
  double seconds = 0;   // that the reduction took
  std::shared_ptr<const Simplified_scan> simplified; // where the method of the paper was asked for
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_REDUCED_SCAN_H
