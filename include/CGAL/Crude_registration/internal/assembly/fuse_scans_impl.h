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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_FUSE_SCANS_IMPL_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_FUSE_SCANS_IMPL_H

// The steps of fuse_scans.h.

#include <CGAL/Crude_registration/internal/assembly/fuse_scans.h>
#include <CGAL/Crude_registration/internal/reduction/describe_surfels.h>
#include <CGAL/Crude_registration/internal/reduction/group_samples.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

CGAL_CRUDE_REGISTRATION_INLINE Reduced_scan fuse_scans(const Placed_scans& placed,
                                                       const std::vector<std::size_t>& scans,
                                                       const std::vector<Rigid_motion>& poses, Run_control& control)
{
  const auto median = [&](const auto& value) {
    std::vector<double> values;
    values.reserve(scans.size());
    for (const std::size_t i : scans) values.push_back(double(value(placed.scan(i))));
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
    return values[values.size() / 2];
  };
  Reduced_scan fused;
  std::vector<Vector_f> points, normals;
  std::vector<float> weights;
  Vector_f low = Vector_f::Zero(), high = Vector_f::Zero();
  for (const std::size_t i : scans) {
    const Reduced_scan& scan = placed.scan(i);
    const Pose pose = to_pose(poses[i]);
    fused.number_of_samples += scan.number_of_samples;
    for (std::size_t k = 0; k < scan.fine.surfels.size(); ++k) {
      points.push_back(pose(scan.fine.surfels[k].position));
      normals.push_back(pose.rotation * scan.fine.surfels[k].normal);
      weights.push_back(scan.fine.weights[k]);
      low = points.size() == 1 ? points.back() : Vector_f(low.cwiseMin(points.back()));
      high = points.size() == 1 ? points.back() : Vector_f(high.cwiseMax(points.back()));
    }
  }
  fused.extent = double((high - low).sum()) / 3;
  fused.spacing = median([](const Reduced_scan& s) { return s.spacing; });
  const auto grouped = [&](const std::vector<Vector_f>& p, const std::vector<Vector_f>& n, const std::vector<float>& w,
                           float cell) {
    Surfel_level level = group_samples(p, n, w, cell, control);
    while (level.surfels.size() > Surfel_field::maximum_size) level = group_samples(p, n, w, cell *= 1.5f, control);
    return level;
  };
  fused.fine = grouped(points, normals, weights, float(median([](const Reduced_scan& s) { return s.fine.spacing; })));
  points.clear();
  normals.clear();
  for (const Surfel& s : fused.fine.surfels) {
    points.push_back(s.position);
    normals.push_back(s.normal);
  }
  fused.coarse = grouped(points, normals, fused.fine.weights,
                         float(median([](const Reduced_scan& s) { return s.coarse.spacing; })));
  describe_surfels(fused.coarse);
  // The reaches and numbers of the reduction of a scan.
  fused.fine.field = Surfel_field(fused.fine.surfels, fused.fine.spacing, 1.6f * fused.fine.spacing);
  fused.coarse.field = Surfel_field(fused.coarse.surfels, 0.7f * fused.coarse.spacing, 2.f * fused.coarse.spacing);
  fused.fine.probes = choose_probes(fused.fine.surfels, 4000);
  fused.coarse.probes = choose_probes(fused.coarse.surfels, 600);
  measure_noise(fused.fine);
  measure_noise(fused.coarse);
  return fused;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_FUSE_SCANS_IMPL_H
