// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#define BOOST_TEST_MODULE simplify_scan
#include <boost/test/unit_test.hpp>

#include "range_images.h"

#include "generated_surfaces.h"
#include "mesh_of.h"
#include "wrong_use.h"

#include <CGAL/Crude_registration/IO/read_range_image.h>
#include <CGAL/Crude_registration/reduction/approximation_error.h>
#include <CGAL/Crude_registration/reduction/simplify_scan.h>
#include <CGAL/Crude_registration/reduction/surface_types.h>
#include <CGAL/Crude_registration/sampling/sampling_distance.h>
#include <CGAL/Crude_registration/sampling/triangulate_range_image.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/helpers.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

namespace CR = CGAL::Crude_registration;
namespace parameters = CR::parameters;
using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using generated::Vector;

BOOST_AUTO_TEST_CASE(stops_at_the_number_of_vertices)
{
  for (std::size_t n : {std::size_t(1000), std::size_t(300), std::size_t(50)}) {
    Mesh mesh = mesh_of<Mesh>(generated::bumps(40, 1, 0.002));
    BOOST_TEST(CR::simplify_scan(mesh, parameters::number_of_vertices(n)) == n);
    BOOST_TEST(mesh.number_of_vertices() == n);
    BOOST_TEST(CGAL::is_triangle_mesh(mesh));
    BOOST_TEST(CGAL::is_valid_polygon_mesh(mesh));
  }
  Mesh mesh = mesh_of<Mesh>(generated::bumps(10));
  BOOST_TEST(CR::simplify_scan(mesh, parameters::number_of_vertices(100000)) == 121);
}

BOOST_AUTO_TEST_CASE(the_error_is_a_mean_squared_distance)
{
  // What is collapsed to one vertex has the mean squared distance to its planes: measured here for a mesh collapsed by
  // the first stop that leaves a given number of vertices; the sum of the squares would stop a hundred times earlier.
  const auto dense = generated::bumps(50, 1, 0.003);
  std::size_t previous = dense.points.size() + 1;
  for (double error : {0.0, 1e-7, 1e-6, 1e-5, 1e-4}) {
    Mesh mesh = mesh_of<Mesh>(dense);
    const std::size_t n = CR::simplify_scan(mesh, parameters::approximation_error(error));
    BOOST_TEST(n < previous);
    previous = n;
    // The same with quadrics and a placement without a line of CGAL: no two vertices are in one cell.
    Mesh other = mesh_of<Mesh>(dense);
    const std::size_t m = CR::simplify_scan(other, parameters::approximation_error(error).cell_size(1e-6));
    if (error > 0) BOOST_TEST(std::abs(double(n) - double(m)) < 0.2 * double(n));
  }
}

BOOST_AUTO_TEST_CASE(both_stops_and_neither)
{
  const auto dense = generated::bumps(40, 1, 0.002);
  Mesh a = mesh_of<Mesh>(dense), b = a, c = a, d = a;
  const std::size_t by_error = CR::simplify_scan(a, parameters::approximation_error(1e-5));
  BOOST_TEST(by_error > 10);
  BOOST_TEST(CR::simplify_scan(b, parameters::approximation_error(1e-5).number_of_vertices(by_error + 50)) ==
             by_error + 50);
  BOOST_TEST(CR::simplify_scan(c, parameters::number_of_vertices(10).approximation_error(1e-5)) == by_error);
  Mesh e = d;
  BOOST_TEST(CR::simplify_scan(d) ==
             CR::simplify_scan(e, parameters::approximation_error(CR::approximation_error(mesh_of<Mesh>(dense)))));
}

BOOST_AUTO_TEST_CASE(units_and_frames_do_not_matter)
{
  const auto dense = generated::bumps(40, 1, 0.002);
  const double error = 1e-5;
  Mesh mesh = mesh_of<Mesh>(dense);
  const double expected = double(CR::simplify_scan(mesh, parameters::approximation_error(error)));
  generated::Random random(6);
  for (double scale : {1e-3, 0.3048, 1.0, 1e4})
    for (double distance : {0.0, 1.0, 1e4}) {
      Mesh other = mesh_of<Mesh>(generated::moved(dense, random.motion(distance * scale), scale));
      const double n = double(CR::simplify_scan(other, parameters::approximation_error(scale * scale * error)));
      // Rounding decides between equal costs, and which way flat regions go.
      BOOST_TEST(std::abs(n - expected) <= 0.03 * expected);
    }
}

BOOST_AUTO_TEST_CASE(vertices_without_collapse_keep_their_coordinates)
{
  const auto dense = generated::bumps(30, 1, 0.002);
  CR::internal::Rigid_motion motion;
  motion.translation = Vector(0.1, 1000.7, -3.3);
  Mesh mesh = mesh_of<Mesh>(generated::moved(dense, motion));
  std::set<Point> before;
  for (Mesh::Vertex_index v : mesh.vertices()) before.insert(mesh.point(v));
  CR::simplify_scan(mesh, parameters::number_of_vertices(900));
  std::size_t kept = 0;
  for (Mesh::Vertex_index v : mesh.vertices()) kept += before.count(mesh.point(v));
  BOOST_TEST(kept >= 900 - 61);
  BOOST_TEST(kept < 900);
}

BOOST_AUTO_TEST_CASE(every_kind_of_mesh)
{
  const auto dense = generated::bumps(25, 1, 0.002);
  Mesh mesh = mesh_of<Mesh>(dense);
  const std::size_t expected = CR::simplify_scan(mesh, parameters::approximation_error(1e-5));
  using Exact_kernel = CGAL::Exact_predicates_exact_constructions_kernel;
  auto polyhedron = mesh_of<CGAL::Polyhedron_3<Kernel>>(dense);
  auto exact = mesh_of<CGAL::Surface_mesh<Exact_kernel::Point_3>>(dense);
  BOOST_TEST(CR::simplify_scan(polyhedron, parameters::approximation_error(1e-5)) == expected);
  BOOST_TEST(polyhedron.size_of_vertices() == expected);
  BOOST_TEST(CR::simplify_scan(exact, parameters::approximation_error(1e-5)) == expected);
}

BOOST_AUTO_TEST_CASE(the_vertex_point_map_is_read_and_written)
{
  const auto dense = generated::bumps(25, 1, 0.002);
  Mesh expected = mesh_of<Mesh>(dense), mesh = expected;
  auto map = mesh.add_property_map<Mesh::Vertex_index, Point>("v:elsewhere").first;
  for (Mesh::Vertex_index v : mesh.vertices()) {
    map[v] = mesh.point(v);
    mesh.point(v) = Point(7, 7, 7);
  }
  CR::simplify_scan(expected, parameters::number_of_vertices(100));
  CR::simplify_scan(mesh, parameters::number_of_vertices(100).vertex_point_map(map));
  auto w = expected.vertices().begin();
  for (Mesh::Vertex_index v : mesh.vertices()) {
    BOOST_TEST(map[v] == expected.point(*w++));
    BOOST_TEST(mesh.point(v) == Point(7, 7, 7));
  }
}

BOOST_AUTO_TEST_CASE(closed_meshes_and_vertices_without_faces)
{
  Mesh mesh = mesh_of<Mesh>(generated::sphere(12, 1));
  mesh.add_vertex(Point(0, 0, 0));
  BOOST_TEST(CR::simplify_scan(mesh, parameters::number_of_vertices(50)) == 50);
  mesh.collect_garbage();
  BOOST_TEST(mesh.number_of_vertices() == 50);
  BOOST_TEST(CGAL::is_closed(mesh));
  for (Mesh::Vertex_index v : mesh.vertices())
    BOOST_TEST(std::abs(std::sqrt((mesh.point(v) - CGAL::ORIGIN).squared_length()) - 1) < 0.2);
  Mesh empty;
  BOOST_TEST(CR::simplify_scan(empty) == 0);
  Mesh triangle;
  triangle.add_face(triangle.add_vertex(Point(0, 0, 0)), triangle.add_vertex(Point(1, 0, 0)),
                    triangle.add_vertex(Point(0, 1, 0)));
  BOOST_TEST(CR::simplify_scan(triangle, parameters::number_of_vertices(0)) == 3);
}

BOOST_AUTO_TEST_CASE(degenerate_faces)
{
  // Vertices all of whose faces have no area, and edges of length 0.
  auto dense = generated::bumps(10);
  for (std::size_t i : {std::size_t(12), std::size_t(13), std::size_t(23), std::size_t(24), std::size_t(25)})
    dense.points[i] = dense.points[14];
  Mesh mesh = mesh_of<Mesh>(dense);
  const std::size_t n = CR::simplify_scan(mesh, parameters::number_of_vertices(40));
  BOOST_TEST(n == 40);
  for (Mesh::Vertex_index v : mesh.vertices()) BOOST_TEST(std::isfinite(mesh.point(v).x()));
}

BOOST_AUTO_TEST_CASE(wrong_use_is_named)
{
  Mesh quad;
  quad.add_face(quad.add_vertex(Point(0, 0, 0)), quad.add_vertex(Point(1, 0, 0)), quad.add_vertex(Point(1, 1, 0)),
                quad.add_vertex(Point(0, 1, 0)));
  BOOST_CHECK_EXCEPTION(CR::simplify_scan(quad), std::invalid_argument, names("simplify_scan: face 0 of mesh"));
  Mesh mesh = mesh_of<Mesh>(generated::bumps(5));
  for (double bad : {-1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    BOOST_CHECK_EXCEPTION(CR::simplify_scan(mesh, parameters::approximation_error(bad)), std::invalid_argument,
                          names("simplify_scan: approximation_error"));
  BOOST_CHECK_EXCEPTION(CR::simplify_scan(mesh, parameters::number_of_vertices(-1)), std::invalid_argument,
                        names("simplify_scan: number_of_vertices"));
  BOOST_TEST(mesh.number_of_vertices() == 36);
}

// Table 1 of the paper: 400 vertices on average, the four scans simplified to the approximation error.
BOOST_AUTO_TEST_CASE(real_scans_are_left_with_the_papers_number_of_vertices,
                     *boost::unit_test::label("real_scans") *
                         boost::unit_test::precondition(generated::real_scans_are_there))
{
  const std::filesystem::path folder = generated::real_scans("bunny");
  if (folder.empty()) return;
  double sum = 0;
  for (const std::string name : {"bun000", "bun090", "bun180", "bun270"}) {
    CR::Range_image<Kernel> image;
    CR::read_range_image((folder / (name + ".ply")).string(), image);
    Mesh mesh;
    CR::triangulate_range_image(image, mesh);
    auto types = mesh.add_property_map<Mesh::Vertex_index, CR::Surface_type>("v:type").first;
    const double smooth = CR::surface_types(mesh, types).percent_smooth();
    BOOST_TEST(smooth > 44);
    BOOST_TEST(smooth < 46.5);

    const double error = CR::approximation_error(image);
    Mesh copy = mesh;
    const double grouped = double(
        CR::simplify_scan(copy, parameters::approximation_error(error).cell_size(3.5 * CR::sampling_distance(image))));
    sum += grouped;
    if (name != "bun090") continue; // one is enough for the slow path
    const double plain = double(CR::simplify_scan(mesh, parameters::approximation_error(error)));
    BOOST_TEST(plain < 1.2 * 400);
    BOOST_TEST(std::abs(grouped - plain) < 0.2 * plain);
  }
  BOOST_TEST(std::abs(sum / 4 - 400) < 0.15 * 400);
}
