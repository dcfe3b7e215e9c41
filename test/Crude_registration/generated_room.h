// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// A room seen from inside, for tests: walls, furniture and a statue.

#ifndef GENERATED_ROOM_H
#define GENERATED_ROOM_H

#include "range_images.h"

#include <CGAL/Crude_registration/simulation/make_statue.h>
#include <CGAL/Crude_registration/simulation/simulate_range_image.h>

#include <CGAL/Aff_transformation_3.h>
#include <CGAL/Polygon_mesh_processing/transform.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/boost/graph/generators.h>

#include <array>
#include <cmath>
#include <vector>

namespace generated {

// 4 x 3 x 2.5 units, from the origin.
inline const CR::Simulated_scene& room()
{
  using Mesh = CGAL::Surface_mesh<Point>;
  static const CR::Simulated_scene scene = [] {
    Mesh mesh;
    const auto add_box = [&](double x, double y, double z, double dx, double dy, double dz) {
      const auto p = [&](int i, int j, int k) { return Point(x + i * dx, y + j * dy, z + k * dz); };
      Mesh box;
      CGAL::make_hexahedron(p(0, 0, 0), p(1, 0, 0), p(1, 1, 0), p(0, 1, 0), p(0, 1, 1), p(0, 0, 1), p(1, 0, 1),
                            p(1, 1, 1), box);
      for (const auto f : std::vector<Mesh::Face_index>(box.faces().begin(), box.faces().end())) {
        const auto h = box.halfedge(f);
        CGAL::Euler::split_face(h, box.next(box.next(h)), box);
      }
      CGAL::copy_face_graph(box, mesh);
    };
    add_box(0, 0, 0, 4, 3, 2.5);
    add_box(3.3, 0.4, 0, 0.6, 1.3, 0.9); // a cupboard, a table with a box on it, shelves
    add_box(1.6, 2.2, 0.7, 1.1, 0.7, 0.06);
    add_box(1.7, 2.3, 0.76, 0.3, 0.4, 0.25);
    add_box(1.7, 2.3, 0, 0.08, 0.08, 0.7);
    add_box(2.5, 2.3, 0, 0.08, 0.08, 0.7);
    for (double z : {0.9, 1.3, 1.7}) add_box(3.75, 2, z, 0.25, 0.9, 0.04);
    add_box(3.8, 2.1, 0.94, 0.15, 0.2, 0.3);
    Mesh statue;
    CR::make_statue(statue, 40, CR::parameters::random_seed(3));
    const Motion to_corner(CGAL::TRANSLATION, Kernel::Vector_3(3, 1.9, 0.45)), smaller(CGAL::SCALING, 0.45);
    CGAL::Polygon_mesh_processing::transform(to_corner * smaller, statue);
    CGAL::copy_face_graph(statue, mesh);
    return CR::Simulated_scene(mesh);
  }();
  return scene;
}

// What a depth camera saw of the room while it turned and moved a little, from `eye` towards `targets`, fused: points
// in the frame of the room.
inline std::vector<Point> points_of_room(const Point& eye, const std::vector<Point>& targets)
{
  std::vector<Point> points;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    CR::Range_camera<Kernel> camera;
    camera.viewpoint = eye + Kernel::Vector_3(0.1 * double(i % 2), 0.07 * double(i), 0.05 * double(i));
    camera.target = targets[i];
    camera.up = Kernel::Vector_3(0, 0, 1);
    camera.is_perspective = true;
    camera.columns = 200;
    camera.rows = 150;
    camera.spacing = std::sqrt(CGAL::squared_distance(camera.viewpoint, camera.target)) * 1.2 / 200;
    camera.noise = 0.2;
    camera.grazing_drop_out = 0.8;
    camera.seed = i;
    const auto seen = room().range_image(camera);
    for (const Point& p : seen.image.points()) points.push_back(seen.scene_from_scan(p));
  }
  return points;
}

} // namespace generated

#endif
