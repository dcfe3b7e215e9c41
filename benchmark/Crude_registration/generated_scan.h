// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_BENCHMARK_GENERATED_SCAN_H
#define CGAL_CRUDE_REGISTRATION_BENCHMARK_GENERATED_SCAN_H

// Scans of a generated body with as many samples as are wanted.

#include <CGAL/Crude_registration/simulation/make_statue.h>
#include <CGAL/Crude_registration/simulation/simulate_range_image.h>

#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace benchmark_tools {

constexpr int scene_resolution = 200;

class Generated_scene
{
public:
  using Kernel = CGAL::Simple_cartesian<double>;
  using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
  using Simulated_scan = CGAL::Crude_registration::Simulated_range_image<Kernel>;

  explicit Generated_scene(int resolution)
  {
    CGAL::Crude_registration::make_statue(m_mesh, resolution, CGAL::Crude_registration::parameters::random_seed(1));
    m_scene.emplace(m_mesh);
    m_box = CGAL::Polygon_mesh_processing::bbox(m_mesh);
  }

  // About that many samples, seen from the direction at `angle` radians around the upright axis; some noise.
  Simulated_scan scan(std::size_t samples, double angle, std::uint64_t seed) const
  {
    using Camera = CGAL::Crude_registration::Range_camera<Kernel>;
    constexpr std::size_t few = 200;
    Camera camera = Camera::framing(m_box, Kernel::Vector_3(std::cos(angle), std::sin(angle), -0.2), few);
    const Simulated_scan sketch = m_scene->range_image(camera);
    camera.spacing *= std::sqrt(double(sketch.image.points().size()) / double(samples));
    // No more cells than the body needs: its image is about the middle.
    double x = 0, y = 0;
    for (const auto& p : sketch.image.points()) {
      x = (std::max)(x, std::abs(p.x()));
      y = (std::max)(y, std::abs(p.y()));
    }
    camera.columns = 2 * std::size_t(std::ceil(x / camera.spacing)) + 2;
    camera.rows = 2 * std::size_t(std::ceil(y / camera.spacing)) + 2;
    camera.noise = 0.2;
    camera.drop_out = 0.01;
    camera.seed = seed;
    return m_scene->range_image(camera);
  }

private:
  Mesh m_mesh;
  std::optional<CGAL::Crude_registration::Simulated_scene> m_scene;
  CGAL::Bbox_3 m_box;
};

} // namespace benchmark_tools

#endif // CGAL_CRUDE_REGISTRATION_BENCHMARK_GENERATED_SCAN_H
