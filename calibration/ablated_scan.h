// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_CALIBRATION_ABLATED_SCAN_H
#define CGAL_CRUDE_REGISTRATION_CALIBRATION_ABLATED_SCAN_H

// Scans that lack a part of what is prepared of them, for the programs that ask what that part is worth.

#include <CGAL/Crude_registration/internal/base/Counter_random.h>
#include <CGAL/Crude_registration/internal/mesh/mesh_geometry.h>
#include <CGAL/Crude_registration/internal/mesh/to_flat_mesh.h>
#include <CGAL/Crude_registration/internal/reduction/Matching_vertices.h>
#include <CGAL/Crude_registration/internal/reduction/Reduced_scan.h>
#include <CGAL/Crude_registration/named_parameters.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace benchmark_tools {

namespace CRI = CGAL::Crude_registration::internal;

// All curvatures are the same: nothing is told apart by them.
inline void take_curvatures(CRI::Reduced_scan& scan)
{
  for (CRI::Surfel& s : scan.coarse.surfels) s.minimal_curvature = s.maximal_curvature = 0;
  if (!scan.simplified) return;
  CRI::Simplified_scan simplified = *scan.simplified;
  std::fill(simplified.vertices.minimum_curvatures.begin(), simplified.vertices.minimum_curvatures.end(), 0.);
  std::fill(simplified.vertices.maximum_curvatures.begin(), simplified.vertices.maximum_curvatures.end(), 0.);
  scan.simplified = std::make_shared<const CRI::Simplified_scan>(std::move(simplified));
}

// Nothing is known to be in front of what the sensor saw.
inline void take_free_space(CRI::Reduced_scan& scan)
{
  CRI::Depth_buffer::for_each_part(scan.depths, [](auto& part) {
    if constexpr (std::is_same_v<std::decay_t<decltype(part)>, std::vector<float>>)
      std::fill(part.begin(), part.end(), -(std::numeric_limits<float>::max)());
  });
}

// Nothing would have been seen where the sensor saw nothing.
inline void take_visibility(CRI::Reduced_scan& scan)
{
  CRI::Depth_buffer::for_each_part(scan.depths, [](auto& part) {
    if constexpr (std::is_same_v<std::decay_t<decltype(part)>, std::vector<std::uint8_t>>)
      std::fill(part.begin(), part.end(), std::uint8_t(0));
  });
}

// The vertices of the simplified mesh are as many random ones of the dense mesh, off its border. They are described as
// those of the simplified mesh are, and the tolerances stay its own.
template <class Mesh>
void take_random_vertices(const Mesh& dense, CRI::Reduced_scan& scan)
{
  if (!scan.simplified) return;
  const CRI::Flat_mesh flat =
      CRI::to_flat_mesh(dense, CGAL::Crude_registration::parameters::default_values(), "take_random_vertices", "dense");
  const std::vector<std::uint8_t> borders = CRI::border_flags(flat);
  std::vector<std::size_t> inside;
  for (std::size_t i = 0; i < borders.size(); ++i)
    if (borders[i] == 0) inside.push_back(i);
  const CRI::Counter_random random(1);
  CRI::Simplified_scan simplified = *scan.simplified;
  const std::size_t wanted = (std::min)(simplified.vertices.points.size(), inside.size());
  CRI::Flat_mesh chosen; // without faces
  for (std::size_t i = 0; i < wanted; ++i) {
    std::swap(inside[i], inside[i + std::size_t(random.uniform(i) * double(inside.size() - i))]);
    chosen.points.push_back(flat.points[inside[i]]);
  }
  simplified.vertices = CRI::matching_vertices(chosen, flat, CRI::vertex_normals(flat), simplified.description_radius);
  for (CRI::Vector& p : simplified.vertices.points) p = scan.own_from_input(p);
  for (CRI::Vector& n : simplified.vertices.normals) n = scan.own_from_input.rotation * n;
  scan.simplified = std::make_shared<const CRI::Simplified_scan>(std::move(simplified));
}

} // namespace benchmark_tools

#endif // CGAL_CRUDE_REGISTRATION_CALIBRATION_ABLATED_SCAN_H
