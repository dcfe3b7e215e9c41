// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#define BOOST_TEST_MODULE mesh_geometry
#include <boost/test/unit_test.hpp>

#include "generated_surfaces.h"
#include "wrong_use.h"

#include <CGAL/Crude_registration/internal/mesh/to_flat_mesh.h>
#include <CGAL/Crude_registration/internal/mesh/add_flat_mesh.h>
#include <CGAL/Crude_registration/internal/mesh/mesh_geometry.h>

#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace CGAL::Crude_registration::internal;
using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Polyhedron = CGAL::Polyhedron_3<Kernel>;
namespace parameters = CGAL::Crude_registration::parameters;

BOOST_AUTO_TEST_CASE(vertex_normals_of_a_sphere_are_exact_however_it_is_triangulated)
{
  const Flat_mesh mesh = generated::sphere(8, 2.5);
  const std::vector<Vector> normals = vertex_normals(mesh);
  for (std::size_t i = 0; i < normals.size(); ++i) BOOST_TEST((normals[i] - mesh.points[i] / 2.5).norm() < 1e-12);
}

BOOST_AUTO_TEST_CASE(vertex_normals_do_not_depend_on_the_unit)
{
  const Flat_mesh mesh = generated::bumps(12);
  const std::vector<Vector> expected = vertex_normals(mesh);
  for (double scale : {1e-72, 1e-30, 1e-3, 1e3, 1e30, 1e72}) {
    const std::vector<Vector> normals = vertex_normals(generated::moved(mesh, Rigid_motion(), scale));
    for (std::size_t i = 0; i < normals.size(); ++i) BOOST_TEST((normals[i] - expected[i]).norm() < 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(vertices_without_area_have_the_zero_normal)
{
  Flat_mesh mesh;
  mesh.points = {Vector(0, 0, 0), Vector(1, 0, 0), Vector(2, 0, 0), Vector(0, 1, 0), Vector(5, 5, 5)};
  mesh.faces = {{0, 1, 2}, {0, 1, 3}, {1, 1, 3}};
  const std::vector<Vector> normals = vertex_normals(mesh);
  BOOST_TEST(normals[0] == Vector(0, 0, 1));
  BOOST_TEST(normals[2] == Vector(0, 0, 0));
  BOOST_TEST(normals[4] == Vector(0, 0, 0));
}

BOOST_AUTO_TEST_CASE(border_flags_are_those_of_edges_with_one_face)
{
  Flat_mesh mesh = generated::torus(20, 12, 3, 1);
  const std::vector<std::uint8_t> closed = border_flags(mesh);
  BOOST_TEST(std::count(closed.begin(), closed.end(), 1) == 0);

  // Holes of all kinds.
  generated::Random random(3);
  for (double share : {0.02, 0.2, 0.6, 0.95}) {
    Flat_mesh part = mesh;
    part.faces.clear();
    for (const auto& f : mesh.faces)
      if (std::abs(random.symmetric()) > share) part.faces.push_back(f);
    std::map<std::pair<int, int>, int> edges;
    for (const auto& f : part.faces)
      for (std::size_t k = 0; k < 3; ++k) ++edges[std::minmax(f[k], f[(k + 1) % 3])];
    std::vector<std::uint8_t> expected(part.points.size(), 0);
    for (const auto& e : edges)
      if (e.second != 2) expected[std::size_t(e.first.first)] = expected[std::size_t(e.first.second)] = 1;
    BOOST_TEST(border_flags(part) == expected, boost::test_tools::per_element());
  }
}

BOOST_AUTO_TEST_CASE(non_manifold_edges_and_inconsistent_faces_are_border)
{
  Flat_mesh mesh;
  mesh.points.resize(6, Vector::Zero());
  mesh.faces = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
  const std::vector<std::uint8_t> fan = border_flags(mesh);
  BOOST_TEST(int(fan[0]) == 1);
  BOOST_TEST(int(fan[1]) == 1);
  BOOST_TEST(int(fan[5]) == 0);
  // A tetrahedron with one face turned.
  mesh.faces = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 0, 3}};
  const std::vector<std::uint8_t> turned = border_flags(mesh);
  BOOST_TEST(int(turned[0]) + int(turned[2]) + int(turned[3]) == 3);
}

BOOST_AUTO_TEST_CASE(adjacency_is_that_of_the_faces)
{
  Flat_mesh mesh = generated::bumps(7);
  mesh.points.push_back(Vector::Zero()); // isolated
  const Index_lists faces = faces_of_vertices(mesh), neighbours = neighbours_of_vertices(mesh);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    std::vector<std::int32_t> expected_faces;
    std::set<std::int32_t> expected_neighbours;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      const auto& face = mesh.faces[f];
      if (std::find(face.begin(), face.end(), std::int32_t(i)) == face.end()) continue;
      expected_faces.push_back(std::int32_t(f));
      expected_neighbours.insert(face.begin(), face.end());
    }
    expected_neighbours.erase(std::int32_t(i));
    BOOST_TEST(std::vector<std::int32_t>(faces.begin(i), faces.end(i)) == expected_faces,
               boost::test_tools::per_element());
    std::vector<std::int32_t> found(neighbours.begin(i), neighbours.end(i));
    std::sort(found.begin(), found.end());
    BOOST_TEST(found == std::vector<std::int32_t>(expected_neighbours.begin(), expected_neighbours.end()),
               boost::test_tools::per_element());
  }
}

BOOST_AUTO_TEST_CASE(face_graphs_become_flat_in_the_order_of_their_elements)
{
  const Flat_mesh expected = generated::bumps(5);
  Mesh mesh;
  add_flat_mesh(expected, mesh, parameters::default_values());
  Polyhedron polyhedron;
  add_flat_mesh(expected, polyhedron, parameters::default_values());
  for (const Flat_mesh& flat : {to_flat_mesh(mesh, parameters::default_values(), "test", "mesh"),
                                to_flat_mesh(polyhedron, parameters::default_values(), "test", "mesh")}) {
    BOOST_TEST((flat.points == expected.points));
    BOOST_TEST_REQUIRE(flat.faces.size() == expected.faces.size());
    for (std::size_t i = 0; i < flat.faces.size(); ++i) {
      // The same corners in the same sense, from whichever the first.
      auto f = flat.faces[i];
      while (f[0] != expected.faces[i][0]) std::rotate(f.begin(), f.begin() + 1, f.end());
      BOOST_TEST((f == expected.faces[i]));
    }
  }
}

BOOST_AUTO_TEST_CASE(removed_elements_are_left_out)
{
  Mesh mesh;
  add_flat_mesh(generated::bumps(4), mesh, parameters::default_values());
  CGAL::Euler::remove_face(halfedge(*faces(mesh).begin(), mesh), mesh);
  mesh.remove_vertex(add_vertex(mesh));
  const Mesh::Vertex_index isolated = mesh.add_vertex(Point(9, 9, 9));
  BOOST_TEST(mesh.has_garbage());
  const Flat_mesh flat = to_flat_mesh(mesh, parameters::default_values(), "test", "mesh");
  BOOST_TEST(flat.points.size() == mesh.number_of_vertices());
  BOOST_TEST(flat.faces.size() == mesh.number_of_faces());
  BOOST_TEST(flat.points.back() == Vector(9, 9, 9));
  double area = 0, expected = 0;
  for (const auto& f : flat.faces) area += area_vector(flat, f).norm();
  mesh.remove_vertex(isolated);
  mesh.collect_garbage();
  const Flat_mesh collected = to_flat_mesh(mesh, parameters::default_values(), "test", "mesh");
  for (const auto& f : collected.faces) expected += area_vector(collected, f).norm();
  BOOST_TEST(area == expected, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(the_vertex_point_map_is_read)
{
  Mesh mesh;
  add_flat_mesh(generated::bumps(3), mesh, parameters::default_values());
  auto map = mesh.add_property_map<Mesh::Vertex_index, Point>("v:elsewhere", Point(1, 2, 3)).first;
  const Flat_mesh flat = to_flat_mesh(mesh, parameters::vertex_point_map(map), "test", "mesh");
  for (const Vector& p : flat.points) BOOST_TEST(p == Vector(1, 2, 3));
}

BOOST_AUTO_TEST_CASE(what_is_wrong_with_a_mesh_is_named)
{
  Mesh quad;
  quad.add_face(quad.add_vertex(Point(0, 0, 0)), quad.add_vertex(Point(1, 0, 0)), quad.add_vertex(Point(1, 1, 0)),
                quad.add_vertex(Point(0, 1, 0)));
  BOOST_CHECK_EXCEPTION(to_flat_mesh(quad, parameters::default_values(), "some_function", "source"),
                        std::invalid_argument, names("some_function: face 0 of source", "triangle"));
  for (double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Mesh mesh;
    add_flat_mesh(generated::bumps(3), mesh, parameters::default_values());
    mesh.point(Mesh::Vertex_index(5)) = Point(0, bad, 0);
    BOOST_CHECK_EXCEPTION(to_flat_mesh(mesh, parameters::default_values(), "some_function", "target"),
                          std::invalid_argument, names("some_function: vertex 5 of target", "finite"));
  }
}
