// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_BENCHMARK_VIEWS_OF_PARTS_H
#define CGAL_CRUDE_REGISTRATION_BENCHMARK_VIEWS_OF_PARTS_H

// Single views of machined parts, as points, points with normals and meshes, and models of the parts: of triangles as
// large as the faces, of small ones, of slivers, and as files have them that were never one surface.

#include "../../calibration/package_random.h"
#include "machined_parts.h"
#include "moved_scan.h"
#include "result_tools.h"
#include "rival_motions.h"

#include <CGAL/Crude_registration/register_scans.h>
#include <CGAL/Crude_registration/sampling/triangulate_range_image.h>
#include <CGAL/Crude_registration/simulation/simulate_range_image.h>

#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/compute_normal.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace benchmark_tools {

using Part_mesh = CGAL::Surface_mesh<Kernel::Point_3>;

inline const std::array<const char*, 3> input_names = {"points", "points with normals", "mesh"};
inline const std::array<const char*, 4> model_names = {"large triangles", "small triangles", "slivers", "loose pieces"};

struct Viewing
{
  double samples = 5000; // about
  double noise = 0.1;    // standard deviation along the line of sight, in sampling distances
};

// All pieces as one surface.
inline Part_mesh united(const Machined_part& part)
{
  Part_mesh mesh = Machined_part::solid(part.pieces.front());
  for (std::size_t i = 1; i < part.pieces.size(); ++i) {
    Part_mesh piece = Machined_part::solid(part.pieces[i]), both;
    if (!CGAL::Polygon_mesh_processing::corefine_and_compute_union(mesh, piece, both))
      throw std::runtime_error(part.name + ": the pieces have no common surface");
    mesh = std::move(both);
    mesh.collect_garbage();
  }
  return mesh;
}

using Triangle = std::array<Kernel::Point_3, 3>;

inline std::vector<Triangle> triangles(const Part_mesh& mesh)
{
  std::vector<Triangle> result;
  for (const auto f : mesh.faces()) {
    Triangle t;
    std::size_t k = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) t[k++] = mesh.point(v);
    result.push_back(t);
  }
  return result;
}

// Each triangle with corners of its own, or with common ones.
inline Part_mesh mesh_of(const std::vector<Triangle>& soup, bool is_joined)
{
  Part_mesh mesh;
  std::map<Kernel::Point_3, Part_mesh::Vertex_index> known;
  const auto vertex = [&](const Kernel::Point_3& p) {
    if (!is_joined) return mesh.add_vertex(p);
    const auto [at, is_new] = known.emplace(p, Part_mesh::Vertex_index());
    if (is_new) at->second = mesh.add_vertex(p);
    return at->second;
  };
  for (const Triangle& t : soup) {
    const auto a = vertex(t[0]), b = vertex(t[1]), c = vertex(t[2]);
    if (mesh.add_face(a, b, c) == Part_mesh::null_face())
      mesh.add_face(mesh.add_vertex(t[0]), mesh.add_vertex(t[1]), mesh.add_vertex(t[2]));
  }
  return mesh;
}

// Halved at their longest edge, until that is short; an edge is halved on both its sides.
inline std::vector<Triangle> small_triangles(std::vector<Triangle> open, double longest)
{
  std::vector<Triangle> done;
  while (!open.empty()) {
    Triangle t = open.back();
    open.pop_back();
    std::size_t k = 0;
    for (std::size_t i = 1; i < 3; ++i)
      if (CGAL::squared_distance(t[i], t[(i + 1) % 3]) > CGAL::squared_distance(t[k], t[(k + 1) % 3])) k = i;
    if (CGAL::squared_distance(t[k], t[(k + 1) % 3]) <= longest * longest) {
      done.push_back(t);
      continue;
    }
    const Kernel::Point_3 middle = CGAL::midpoint(t[k], t[(k + 1) % 3]);
    open.push_back({t[k], middle, t[(k + 2) % 3]});
    open.push_back({middle, t[(k + 1) % 3], t[(k + 2) % 3]});
  }
  return done;
}

// Each triangle four alike.
inline std::vector<Triangle> quartered(const std::vector<Triangle>& soup)
{
  std::vector<Triangle> result;
  for (const Triangle& t : soup) {
    const auto a = CGAL::midpoint(t[1], t[2]), b = CGAL::midpoint(t[2], t[0]), c = CGAL::midpoint(t[0], t[1]);
    for (const Triangle& q : {Triangle{t[0], c, b}, Triangle{c, t[1], a}, Triangle{b, a, t[2]}, Triangle{a, b, c}})
      result.push_back(q);
  }
  return result;
}

// The same surface of triangles with edges of at most that length.
inline Part_mesh finer(const Part_mesh& mesh, double longest)
{
  return mesh_of(small_triangles(triangles(mesh), longest), true);
}

// The models, in the order of their names.
inline std::vector<Part_mesh> models_of(const Machined_part& part, const Part_mesh& whole, double spacing)
{
  const std::vector<Triangle> large = triangles(whole);
  std::vector<Triangle> loose;
  const std::vector<Triangle> pieces = triangles(part.assembly());
  // One of three is halved, and its neighbours not: corners on their edges.
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Triangle& t = pieces[i];
    if (i % 3 != 0) {
      loose.push_back(t);
      continue;
    }
    const auto middle = CGAL::midpoint(t[0], t[1]);
    loose.push_back({t[0], middle, t[2]});
    loose.push_back({middle, t[1], t[2]});
  }
  return {whole, finer(whole, 2 * spacing), mesh_of(quartered(quartered(quartered(large))), true),
          mesh_of(loose, false)};
}

inline CR::Scan_file<Kernel> file_of(const Part_mesh& mesh)
{
  CR::Scan_file<Kernel> file;
  file.kind = CR::Scan_file<Kernel>::MESH;
  file.mesh = mesh;
  return file;
}

struct View
{
  std::array<CR::Scan_file<Kernel>, 3> files;
  Pose_of_view truth;                          // model from view
  std::vector<Eigen::Vector3d> points, joined; // all of them, and those that are corners of the mesh
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  double spacing = 0;
  CR::Sensor<Kernel> sensor; // which the files do not name
};

inline Pose_of_view to_pose(const Transformation& motion)
{
  return {rotation(motion), translation(motion)};
}

// From a direction drawn evenly from all.
inline View view_of(const CR::Simulated_scene& scene, const CGAL::Bbox_3& box, std::uint64_t seed,
                    const Viewing& options)
{
  const Package_random random(seed);
  Kernel::Vector_3 direction(random.normal(0), random.normal(1), random.normal(2));
  auto camera = CR::Range_camera<Kernel>::framing(box, direction, 200, true);
  const auto sketch = scene.range_image(camera);
  const double scale = std::sqrt(double(sketch.image.points().size()) / options.samples);
  camera.spacing *= scale;
  camera.columns = camera.rows = std::size_t(std::ceil(200 / scale));
  camera.noise = options.noise;
  camera.drop_out = 0.01;
  camera.grazing_drop_out = 0.5;
  camera.seed = seed;
  const auto image = scene.range_image(camera);
  View view;
  view.spacing = camera.spacing;
  view.sensor = image.image.sensor();
  view.truth = to_pose(image.scene_from_scan);
  for (const auto& p : image.image.points()) view.points.emplace_back(p.x(), p.y(), p.z());
  for (const auto& p : view.points) view.centroid += p / double(view.points.size());
  Part_mesh mesh;
  CR::triangulate_range_image(image.image, mesh);
  auto& [points, with_normals, as_mesh] = view.files;
  points.kind = with_normals.kind = CR::Scan_file<Kernel>::POINTS;
  points.points = image.image.points();
  for (const auto v : mesh.vertices()) {
    with_normals.points.push_back(mesh.point(v));
    with_normals.normals.push_back(CGAL::Polygon_mesh_processing::compute_vertex_normal(v, mesh));
    view.joined.emplace_back(mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z());
  }
  as_mesh = file_of(mesh);
  return view;
}

inline CR::Scan<Kernel> prepared(const CR::Scan_file<Kernel>& file, const std::string& name,
                                 Transformation& moved_from_file)
{
  Moved_file moved = moved_file(file, name);
  moved_from_file = moved.moved_from_file;
  return CR::Scan<Kernel>(moved.file, CR::parameters::default_values(), name);
}

struct Prepared
{
  Transformation moved_from_file = Transformation(CGAL::IDENTITY);
  CR::Scan<Kernel> scan;

  Prepared(const CR::Scan_file<Kernel>& file, const std::string& name) : scan(prepared(file, name, moved_from_file)) {}
};

// The part's mirror image, one that is a twenty-fifth longer, and one with a hole, a piece or a corner elsewhere.
inline std::vector<Part_mesh> similar_models(const Machined_part& part, const Part_mesh& whole)
{
  const auto stretched = [&](double x) {
    Part_mesh mesh = whole;
    for (const auto v : mesh.vertices()) {
      const Kernel::Point_3& p = mesh.point(v);
      mesh.point(v) = Kernel::Point_3(x * p.x(), p.y(), p.z());
    }
    if (x < 0) CGAL::Polygon_mesh_processing::reverse_face_orientations(mesh);
    return mesh;
  };
  constexpr double by = 0.06; // a twenty-fifth of a part
  Machined_part other = part;
  Extrusion& piece = other.pieces.back();
  if (other.pieces.size() > 1) {
    for (Loop& loop : piece.loops)
      for (auto& p : loop) p = {p[0] + by, p[1] + by / 3};
  } else if (piece.loops.size() > 1) {
    for (auto& p : piece.loops.back()) p = {p[0] + by, p[1] + by / 3};
  } else {
    piece.loops.front().front()[0] -= by;
  }
  return {stretched(-1), stretched(1.04), united(other)};
}

} // namespace benchmark_tools

#endif // CGAL_CRUDE_REGISTRATION_BENCHMARK_VIEWS_OF_PARTS_H
