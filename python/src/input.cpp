// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// What a caller may pass as a scan or as a surface.

#include "input.h"

#include "arrays.h"

#include <CGAL/Crude_registration/IO/internal/to_kernel.h>
#include <CGAL/Crude_registration/IO/triangulate_scan.h>

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/manifoldness.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <stdexcept>
#include <utility>
#include <vector>

namespace {

using Polygons = std::vector<std::vector<std::size_t>>;

// The faces of an array of shape (m, 3), whose indices are below n.
Polygons to_polygons(const py::handle& object, std::size_t n, const std::string& argument)
{
  const py::array array = to_array(object, argument, "i");
  if (array.size() > 0 && (array.ndim() != 2 || array.shape(1) != 3))
    throw py::value_error(argument + ": an array of shape (m, 3) is needed, not " + shape_of(array));
  const auto indices = py::array_t<std::int64_t, plain>::ensure(array);
  if (!indices) throw py::error_already_set();
  Polygons polygons;
  const std::int64_t* const v = indices.data();
  for (std::size_t i = 0; i < std::size_t(indices.size()) / 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k)
      if (v[3 * i + k] < 0 || std::size_t(v[3 * i + k]) >= n)
        throw py::value_error(argument + ": row " + std::to_string(i) + " holds the index " +
                              std::to_string(v[3 * i + k]) + ", but there are " + std::to_string(n) + " points");
    polygons.push_back({std::size_t(v[3 * i]), std::size_t(v[3 * i + 1]), std::size_t(v[3 * i + 2])});
  }
  return polygons;
}

// The normals of an array of shape (n, 3), of any length.
std::vector<Vector> to_normals(const py::handle& object, std::size_t n, const std::string& argument)
{
  const py::array array = to_array(object, argument, "f");
  if (array.ndim() != 2 || std::size_t(array.shape(0)) != n || array.shape(1) != 3)
    throw py::value_error(argument + ": an array of shape (" + std::to_string(n) +
                          ", 3) is needed, as of the points, not " + shape_of(array));
  std::vector<Vector> normals;
  normals.reserve(n);
  for (const Point& q : to_points(to_coordinates(array, argument))) normals.emplace_back(q.x(), q.y(), q.z());
  return normals;
}

// As read_scan() does with the faces of a file: those that name a vertex twice and points without a face are left out;
// where the others are no manifold with consistent faces, they are turned and vertices are split until they are.
Surface to_manifold(const std::vector<Point>& all_points, Polygons polygons)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  polygons.erase(std::remove_if(polygons.begin(), polygons.end(),
                                [](const auto& f) { return f[0] == f[1] || f[1] == f[2] || f[2] == f[0]; }),
                 polygons.end());
  std::vector<std::size_t> new_index(all_points.size(), 0);
  for (const auto& f : polygons)
    for (const std::size_t v : f) new_index[v] = 1;
  std::vector<Point> points;
  for (std::size_t v = 0; v < all_points.size(); ++v) {
    if (new_index[v] == 0) continue;
    new_index[v] = points.size();
    points.push_back(all_points[v]);
  }
  for (auto& f : polygons)
    for (std::size_t& v : f) v = new_index[v];
  const auto to_mesh = [&] {
    CR::internal::Flat_scan_file flat;
    for (const Point& q : points) flat.points.push_back(CR::internal::to_vector(q));
    flat.polygons = polygons;
    Surface mesh;
    CR::internal::add_polygons(flat, mesh);
    return mesh;
  };
  // (Quicker than PMP::is_polygon_soup_a_polygon_mesh(), where it is one.)
  Surface mesh = to_mesh();
  std::vector<Surface::Halfedge_index> halfedges;
  PMP::non_manifold_vertices(mesh, std::back_inserter(halfedges));
  if (mesh.number_of_faces() == polygons.size() && halfedges.empty()) return mesh;
  PMP::orient_polygon_soup(points, polygons);
  return to_mesh();
}

// The grid of an array of shape (rows, columns, 3): where a coordinate is NaN there is no sample.
CR::Range_image<Kernel> to_image(const py::array_t<double>& grid)
{
  CR::Range_image<Kernel> image(std::size_t(grid.shape(1)), std::size_t(grid.shape(0)));
  const auto c = grid.unchecked<3>();
  for (py::ssize_t row = 0; row < c.shape(0); ++row)
    for (py::ssize_t column = 0; column < c.shape(1); ++column) {
      const double x = c(row, column, 0), y = c(row, column, 1), z = c(row, column, 2);
      if (std::isnan(x) || std::isnan(y) || std::isnan(z)) continue;
      image.set_sample(std::size_t(column), std::size_t(row), Point(x, y, z));
    }
  return image;
}

} // namespace

Sensor_arguments sensor_of(const Scan_file& file, const Sensor_arguments& given)
{
  Sensor_arguments sensor = given;
  if (!given.is_given() && file.sensor.is_perspective()) sensor.viewpoint = file.sensor.viewpoint();
  if (!given.is_given() && file.sensor.is_orthographic()) sensor.viewing_direction = file.sensor.viewing_direction();
  return sensor;
}

std::optional<std::string> to_path(const py::handle& object)
{
  if (!py::isinstance<py::str>(object) && !py::isinstance<py::bytes>(object) && !py::hasattr(object, "__fspath__"))
    return std::nullopt;
  const py::bytes bytes = py::module_::import("os").attr("fsencode")(object);
  std::string path = bytes;
  if (path.find('\0') != std::string::npos) throw py::value_error("the name of a file holds a null character");
  return path;
}

Scan_input to_input(const py::handle& object, const py::handle& faces, const py::handle& normals,
                    const std::string& argument)
{
  Scan_input input;
  input.name = argument;
  const bool is_mesh = py::isinstance(object, py::module_::import("crude_registration._types").attr("Mesh"));
  const std::optional<std::string> path = to_path(object);
  const bool is_scan = py::isinstance<Scan>(object), is_file = py::isinstance<Scan_file>(object);
  if (!faces.is_none() && (is_mesh || path || is_scan || is_file))
    throw py::value_error(argument + ": faces are given with what has its own; they go with an array of points");
  if (!normals.is_none() && (is_mesh || path || is_scan || is_file || !faces.is_none()))
    throw py::value_error(argument + ": normals go with an array of points that has no faces");
  if (is_scan) input.scan = object.cast<std::shared_ptr<Scan>>();
  else if (is_file) input.file = object.cast<std::shared_ptr<Scan_file>>();
  else if (path) input.name = *path;
  else if (is_mesh) return to_input(object.attr("points"), object.attr("faces"), normals, argument);
  else {
    if (object.is_none()) throw py::type_error(argument + ": it is None");
    const py::array array = to_array(object, argument, "f");
    const bool is_list = array.ndim() == 2 && array.shape(1) == 3, is_grid = array.ndim() == 3 && array.shape(2) == 3;
    const bool is_alone = faces.is_none() && normals.is_none();
    if (!is_list && !(is_grid && is_alone))
      throw py::value_error(argument + ": an array of shape (n, 3)" + (is_alone ? " or (rows, columns, 3)" : "") +
                            " is needed, not " + shape_of(array));
    auto file = std::make_shared<Scan_file>();
    const auto coordinates = to_coordinates(array, argument);
    if (is_grid) {
      file->kind = Scan_file::RANGE_IMAGE;
      file->image = to_image(coordinates);
    } else if (!faces.is_none()) {
      file->kind = Scan_file::MESH;
      const std::vector<Point> points = to_points(coordinates);
      file->mesh = to_manifold(points, to_polygons(faces, points.size(), argument + ": faces"));
    } else {
      file->points = to_points(coordinates);
      if (!normals.is_none()) file->normals = to_normals(normals, file->points.size(), argument + ": normals");
    }
    input.file = std::move(file);
  }
  return input;
}

Surface to_surface(const py::handle& object, const std::string& argument)
{
  const Scan_input input = to_input(object, py::none(), py::none(), argument);
  if (input.scan) throw py::type_error(argument + ": a Scan has no mesh any more; give what it was made of");
  py::gil_scoped_release unlocked;
  const std::shared_ptr<const Scan_file> contents = input.contents();
  return sensor_of(*contents, {})
      .add_to(p::maximum_edge_ratio(CR::internal::default_maximum_edge_ratio), input.name,
              [&](const auto& np) { return CR::triangulate_scan(*contents, np); });
}

py::object to_mesh(const Surface& surface)
{
  std::vector<Point> points;
  std::vector<py::ssize_t> index(surface.num_vertices(), 0); // elements may have been removed
  for (const auto v : surface.vertices()) {
    index[std::size_t(v)] = py::ssize_t(points.size());
    points.push_back(surface.point(v));
  }
  py::array_t<std::int32_t> faces({py::ssize_t(surface.number_of_faces()), py::ssize_t(3)});
  auto rows = faces.mutable_unchecked<2>();
  py::ssize_t i = 0;
  for (const auto f : surface.faces()) {
    py::ssize_t k = 0;
    for (const auto v : CGAL::vertices_around_face(surface.halfedge(f), surface)) {
      if (k < 3) rows(i, k) = std::int32_t(index[std::size_t(v)]);
      ++k;
    }
    if (k != 3) throw std::invalid_argument("the mesh has a face that is not a triangle");
    ++i;
  }
  return py::module_::import("crude_registration._types").attr("Mesh")(to_array(points), faces);
}
