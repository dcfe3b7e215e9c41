// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_BENCHMARK_REFERENCE_TIME_H
#define CGAL_CRUDE_REGISTRATION_BENCHMARK_REFERENCE_TIME_H

// The unit in which this project gives times: R, the time of CGAL's plain edge collapse of a scan's dense mesh.
// Machines differ and change their speed from hour to hour; R, measured in the same run, makes times comparable.

#include "cpu_time.h"
#include "generated_scan.h"

#include <CGAL/Crude_registration/IO/read_scan.h>
#include <CGAL/Crude_registration/reduction/simplify_scan.h>
#include <CGAL/Crude_registration/sampling/triangulate_range_image.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

namespace benchmark_tools {

class Reference_time
{
public:
  using Kernel = CGAL::Simple_cartesian<double>;
  using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

  static constexpr std::size_t default_vertices = 404;

  explicit Reference_time(Mesh dense, std::size_t vertices = default_vertices)
      : m_dense(std::move(dense)), m_vertices(vertices)
  {}

  // the dense mesh of the scan in a file
  explicit Reference_time(const std::string& file, std::size_t vertices = default_vertices) : m_vertices(vertices)
  {
    namespace CR = CGAL::Crude_registration;
    CR::Scan_file<Kernel> scan = CR::read_scan<Kernel>(file);
    if (scan.kind == CR::Scan_file<Kernel>::RANGE_IMAGE) CR::triangulate_range_image(scan.image, m_dense);
    if (scan.kind == CR::Scan_file<Kernel>::MESH) m_dense = std::move(scan.mesh);
    if (scan.kind == CR::Scan_file<Kernel>::POINTS)
      throw std::runtime_error(file + ": points without a grid or faces have no mesh to simplify");
  }

  const Mesh& dense_mesh() const { return m_dense; }

  struct Run
  {
    std::size_t vertices_left;
    double seconds; // of CPU
  };

  Run run() const
  {
    Mesh mesh = m_dense;
    const double start = cpu_seconds();
    const std::size_t left = CGAL::Crude_registration::simplify_scan(
        mesh, CGAL::Crude_registration::parameters::number_of_vertices(m_vertices));
    return {left, cpu_seconds() - start};
  }

private:
  Mesh m_dense;
  std::size_t m_vertices;
};

// R of the scan in a file; of a generated one where no file is named.
inline double reference_seconds(const std::string& file)
{
  if (!file.empty()) return Reference_time(file).run().seconds;
  Reference_time::Mesh mesh;
  CGAL::Crude_registration::triangulate_range_image(Generated_scene(scene_resolution).scan(40000, 0, 1).image, mesh);
  return Reference_time(mesh).run().seconds;
}

} // namespace benchmark_tools

#endif // CGAL_CRUDE_REGISTRATION_BENCHMARK_REFERENCE_TIME_H
