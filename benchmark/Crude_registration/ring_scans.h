// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_BENCHMARK_RING_SCANS_H
#define CGAL_CRUDE_REGISTRATION_BENCHMARK_RING_SCANS_H

// Scans of a room by a spinning scanner: all around, in lines that are far denser along than across.

#include <CGAL/Crude_registration/simulation/make_statue.h>
#include <CGAL/Crude_registration/simulation/simulate_range_image.h>

#include <CGAL/Polygon_mesh_processing/transform.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/boost/graph/generators.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace benchmark_tools {

class Ring_scene
{
public:
  using Kernel = CGAL::Simple_cartesian<double>;
  using Point = Kernel::Point_3;

  // A room of 10 x 8 x 3 m with boxes along its walls and statues.
  Ring_scene() : m_scene(room()) {}

  // From 1.5 m above the floor, in the frame of the room: so many rings over 40 degrees, of about `around` samples
  // each.
  std::vector<Point> scan(double x, double y, std::size_t rings, std::size_t around, std::uint64_t seed) const
  {
    std::vector<Point> points;
    const std::size_t columns = around / 4;
    constexpr double tangent = 0.364; // of 20 degrees
    for (int k = 0; k < 4; ++k) {
      CGAL::Crude_registration::Range_camera<Kernel> camera;
      camera.viewpoint = Point(x, y, 1.5);
      const std::array<Kernel::Vector_3, 4> directions = {Kernel::Vector_3(1, 0, 0), Kernel::Vector_3(0, 1, 0),
                                                          Kernel::Vector_3(-1, 0, 0), Kernel::Vector_3(0, -1, 0)};
      camera.up = Kernel::Vector_3(0, 0, 1);
      camera.is_perspective = true;
      camera.columns = columns;
      camera.spacing = 2 / double(columns); // a quarter around, at a distance of 1
      camera.rows = 1;
      camera.noise = 0.5;
      camera.drop_out = 0.01;
      for (std::size_t ring = 0; ring < rings; ++ring) {
        // One row, with the camera turned up or down to it.
        const double rise = tangent * (2 * double(ring) / double((std::max)(rings, std::size_t(2)) - 1) - 1);
        camera.target = camera.viewpoint + directions[std::size_t(k)] + Kernel::Vector_3(0, 0, rise);
        camera.seed = (seed * 4 + std::uint64_t(k)) * rings + ring;
        const auto row = m_scene.range_image(camera);
        for (const Point& p : row.image.points()) points.push_back(p.transform(row.scene_from_scan));
      }
    }
    return points;
  }

private:
  using Mesh = CGAL::Surface_mesh<Point>;

  static void add_box(Mesh& mesh, double x, double y, double z, double dx, double dy, double dz)
  {
    const auto p = [&](int i, int j, int k) { return Point(x + i * dx, y + j * dy, z + k * dz); };
    Mesh box;
    CGAL::make_hexahedron(p(0, 0, 0), p(1, 0, 0), p(1, 1, 0), p(0, 1, 0), p(0, 1, 1), p(0, 0, 1), p(1, 0, 1),
                          p(1, 1, 1), box);
    CGAL::Polygon_mesh_processing::triangulate_faces(box);
    CGAL::copy_face_graph(box, mesh);
  }

  static Mesh room()
  {
    Mesh mesh;
    add_box(mesh, 0, 0, 0, 10, 8, 3);
    add_box(mesh, 0.01, 1, 0.01, 0.6, 2, 1.9);
    add_box(mesh, 4, 0.01, 0.01, 1.2, 0.5, 0.8);
    add_box(mesh, 7.5, 7.1, 0.01, 1.6, 0.8, 2.2);
    add_box(mesh, 9.2, 2, 0.01, 0.7, 1.1, 1.2);
    add_box(mesh, 2, 7.4, 0.8, 1.5, 0.5, 0.9);
    const std::array<std::array<double, 2>, 3> places = {{{2, 5.5}, {7, 1.8}, {8, 5}}};
    unsigned seed = 0;
    for (const auto& [x, y] : places) {
      Mesh statue;
      CGAL::Crude_registration::make_statue(statue, 60, CGAL::Crude_registration::parameters::random_seed(++seed));
      CGAL::Polygon_mesh_processing::transform(
          CGAL::Aff_transformation_3<Kernel>(CGAL::TRANSLATION, Kernel::Vector_3(x, y, 1)), statue);
      CGAL::copy_face_graph(statue, mesh);
    }
    return mesh;
  }

  CGAL::Crude_registration::Simulated_scene m_scene;
};

} // namespace benchmark_tools

#endif // CGAL_CRUDE_REGISTRATION_BENCHMARK_RING_SCANS_H
