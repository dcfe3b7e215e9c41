// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#define BOOST_TEST_MODULE triangulate_points
#include <boost/test/unit_test.hpp>

#include "generated_room.h"
#include "mesh_of.h"
#include "range_images.h"
#include "wrong_use.h"

#include <CGAL/Crude_registration/IO/read_scan.h>
#include <CGAL/Crude_registration/internal/mesh/flat_mesh_repair.h>
#include <CGAL/Crude_registration/sampling/join_points.h>
#include <CGAL/Crude_registration/sampling/triangulate_points.h>
#include <CGAL/Crude_registration/sampling/triangulate_range_image.h>

#include <CGAL/Advancing_front_surface_reconstruction.h>
#include <CGAL/Polygon_mesh_processing/manifoldness.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <memory>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace generated;
using Mesh = CGAL::Surface_mesh<Point>;
using CR::internal::Flat_sensor;
namespace parameters = CR::parameters;

namespace {

template <class Face_graph>
bool is_manifold(const Face_graph& mesh)
{
  std::vector<typename boost::graph_traits<Face_graph>::halfedge_descriptor> non_manifold;
  CGAL::Polygon_mesh_processing::non_manifold_vertices(mesh, std::back_inserter(non_manifold));
  return CGAL::is_valid_polygon_mesh(mesh) && CGAL::is_triangle_mesh(mesh) && non_manifold.empty();
}

template <class NamedParameters>
Mesh triangulated(const std::vector<Point>& points, const NamedParameters& np)
{
  Mesh mesh;
  CR::triangulate_points(points, mesh, np);
  BOOST_TEST(is_manifold(mesh));
  return mesh;
}

double area(const Mesh& mesh)
{
  double result = 0;
  for (Mesh::Face_index f : mesh.faces()) {
    std::vector<Vector> p;
    for (Mesh::Vertex_index v : CGAL::vertices_around_face(mesh.halfedge(f), mesh)) p.push_back(vector(mesh.point(v)));
    result += (p[1] - p[0]).cross(p[2] - p[0]).norm() / 2;
  }
  return result;
}

double longest_edge(const Mesh& mesh)
{
  double result = 0;
  for (Mesh::Edge_index e : mesh.edges())
    result = std::max(result,
                      std::sqrt(CGAL::squared_distance(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1)))));
  return result;
}

// sum over the faces of what a function gives for center and normal
template <class Function>
std::size_t count_faces(const Mesh& mesh, const Function& function)
{
  std::size_t count = 0;
  for (Mesh::Face_index f : mesh.faces()) {
    std::vector<Vector> p;
    for (Mesh::Vertex_index v : CGAL::vertices_around_face(mesh.halfedge(f), mesh)) p.push_back(vector(mesh.point(v)));
    if (function(Vector((p[0] + p[1] + p[2]) / 3), Vector((p[1] - p[0]).cross(p[2] - p[0])))) ++count;
  }
  return count;
}

std::vector<Point> shuffled(std::vector<Point> points)
{
  std::mt19937 random(1);
  for (std::size_t i = points.size(); i > 1; --i) std::swap(points[i - 1], points[random() % i]);
  return points;
}

// about n points of a sphere of radius 1, evenly spread
std::vector<Point> sphere(std::size_t n)
{
  std::vector<Point> points;
  for (std::size_t i = 0; i < n; ++i) {
    const double z = 1 - (2 * double(i) + 1) / double(n), phi = double(i) * pi * (3 - std::sqrt(5.));
    const double r = std::sqrt(1 - z * z);
    points.emplace_back(r * std::cos(phi), r * std::sin(phi), z);
  }
  return points;
}

Image terrain()
{
  Random random(3);
  return image_of(60, 50, [&](double c, double r) {
    const double x = 0.5 * (c + 0.2 * random.symmetric()), y = 0.7 * (r + 0.2 * random.symmetric());
    return Vector(x, y, std::sin(x / 4) + 0.1 * y + (x > 15 ? 20 : 0));
  });
}

const Kernel::Vector_3 down(0, 0, -1);

} // namespace

BOOST_AUTO_TEST_CASE(points_of_a_grid_give_the_surface_of_its_triangulation)
{
  Image image = terrain();
  image.set_sensor(Sensor::orthographic(down));
  Mesh grid;
  CR::triangulate_range_image(image, grid);
  const Mesh mesh = triangulated(shuffled(image.points()), parameters::viewing_direction(down));
  BOOST_TEST(mesh.number_of_vertices() > 0.99 * double(grid.number_of_vertices()));
  BOOST_TEST(area(mesh) == area(grid), boost::test_tools::tolerance(0.02));
  BOOST_TEST(longest_edge(mesh) < 5 * 0.8);
  BOOST_TEST(count_faces(mesh, [](const Vector&, const Vector& normal) { return normal.z() > 0; }) ==
             mesh.number_of_faces());
}

BOOST_AUTO_TEST_CASE(points_of_a_camera_are_joined_by_direction)
{
  // a wall behind a smaller one: the gap between them is open, although samples on the far one are three times as far
  // apart
  Image image = perspective_image(80, 60, 60,
                                  [](double a, double b) { return std::abs(a) < 0.3 && std::abs(b) < 0.2 ? 1. : 3.; });
  image.set_sensor(Sensor::perspective(Point(0, 0, 0)));
  Mesh grid;
  CR::triangulate_range_image(image, grid);
  const Mesh mesh = triangulated(shuffled(image.points()), parameters::viewpoint(Point(0, 0, 0)));
  BOOST_TEST(mesh.number_of_vertices() == image.points().size());
  BOOST_TEST(area(mesh) == area(grid), boost::test_tools::tolerance(0.02));
  BOOST_TEST(count_faces(mesh, [](const Vector& p, const Vector& normal) { return normal.dot(p) < 0; }) ==
             mesh.number_of_faces());
}

BOOST_AUTO_TEST_CASE(a_view_all_around_is_joined_all_around)
{
  // from inside a sphere, off its center
  const Point eye(0.3, 0.2, -0.1);
  const Mesh mesh = triangulated(shuffled(sphere(5000)), parameters::viewpoint(eye));
  BOOST_TEST(mesh.number_of_vertices() == 5000);
  BOOST_TEST(mesh.number_of_faces() >
             2 * 5000 - 100); // but for the neighbourhood of the direction opposite to the mean
  BOOST_TEST(count_faces(mesh, [&](const Vector& p, const Vector& normal) {
               return normal.dot(p - vector(eye)) < 0;
             }) == mesh.number_of_faces());
  // from its center, there is no mean direction
  BOOST_TEST(triangulated(sphere(5000), parameters::viewpoint(Point(0, 0, 0))).number_of_faces() > 2 * 5000 - 100);
}

BOOST_AUTO_TEST_CASE(of_points_on_one_line_of_sight_the_nearest_is_taken)
{
  const std::vector<Point> seen = terrain().points();
  std::vector<Point> points;
  for (const Point& p : seen) {
    points.push_back(p);
    points.emplace_back(p.x(), p.y(), p.z() - 1); // behind
    points.push_back(p);
  }
  const Mesh once = triangulated(seen, parameters::viewing_direction(down));
  const Mesh thrice = triangulated(shuffled(points), parameters::viewing_direction(down));
  BOOST_TEST(thrice.number_of_vertices() == once.number_of_vertices());
  BOOST_TEST(thrice.number_of_faces() == once.number_of_faces());
  BOOST_TEST(area(thrice) == area(once), boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(frame_unit_and_order_do_not_matter)
{
  const std::vector<Point> points = terrain().points();
  const double expected = area(triangulated(points, parameters::viewing_direction(down)));
  Random random(4);
  for (double unit : {1e-6, 0.3048, 1., 1e6}) {
    const Rigid_motion motion = random.motion(100);
    std::vector<Point> there;
    for (const Point& p : points) there.push_back(point(unit * motion(vector(p))));
    const Vector direction = motion.rotation * Vector(0, 0, -3);
    const Mesh mesh = triangulated(
        shuffled(there), parameters::viewing_direction(Kernel::Vector_3(direction.x(), direction.y(), direction.z())));
    BOOST_TEST(area(mesh) == unit * unit * expected, boost::test_tools::tolerance(1e-6));
  }
}

BOOST_AUTO_TEST_CASE(without_a_sensor_a_closed_surface_is_found_and_looks_outwards)
{
  Random random(5);
  for (double unit : {1e-6, 1., 1e6}) {
    const Rigid_motion motion = random.motion(100);
    std::vector<Point> points;
    for (const Point& p : sphere(3000)) points.push_back(point(unit * motion(vector(p))));
    const Mesh mesh = triangulated(points, parameters::default_values());
    BOOST_TEST(mesh.number_of_vertices() == 3000);
    BOOST_TEST(CGAL::is_closed(mesh));
    BOOST_TEST(area(mesh) == unit * unit * 4 * pi, boost::test_tools::tolerance(0.01));
    const Vector center = unit * motion.translation;
    BOOST_TEST(count_faces(mesh, [&](const Vector& p, const Vector& n) { return n.dot(p - center) > 0; }) ==
               mesh.number_of_faces());
  }
}

BOOST_AUTO_TEST_CASE(without_a_sensor_what_is_apart_stays_apart)
{
  std::vector<Point> points = sphere(2000);
  for (const Point& p : sphere(2000)) points.push_back(p + Kernel::Vector_3(3, 0, 0));
  const Mesh mesh = triangulated(points, parameters::default_values());
  BOOST_TEST(CGAL::is_closed(mesh));
  BOOST_TEST(mesh.number_of_faces() == 2 * (2 * 2000 - 4));
  BOOST_TEST(longest_edge(mesh) < 0.3);
}

BOOST_AUTO_TEST_CASE(copies_of_points_change_nothing)
{
  const std::vector<Point> points = shuffled(sphere(500));
  std::vector<Point> each; // as the corners of triangles are in an export: 12 times
  for (const Point& p : points) each.insert(each.end(), 12, p);
  std::vector<Point> all;
  for (int i = 0; i < 12; ++i) all.insert(all.end(), points.begin(), points.end());
  for (const bool has_sensor : {false, true}) {
    const auto mesh_of = [&](const std::vector<Point>& some) {
      return has_sensor ? triangulated(some, parameters::viewpoint(Point(0, 0, 9)))
                        : triangulated(some, parameters::default_values());
    };
    const Mesh wanted = mesh_of(points);
    BOOST_TEST(wanted.number_of_faces() > 100);
    for (const std::vector<Point>& some : {each, all}) {
      const Mesh mesh = mesh_of(some);
      BOOST_TEST(mesh.number_of_vertices() == wanted.number_of_vertices());
      BOOST_TEST(mesh.number_of_faces() == wanted.number_of_faces());
      BOOST_TEST(area(mesh) == area(wanted), boost::test_tools::tolerance(1e-12));
    }
  }
}

// The share of the area that looks at a place.
double looks_at(const Mesh& mesh, const Point& place)
{
  double there = 0, all = 0;
  for (const auto f : faces(mesh)) {
    const auto h = halfedge(f, mesh);
    const Vector a = vector(mesh.point(source(h, mesh))), b = vector(mesh.point(target(h, mesh))),
                 c = vector(mesh.point(target(next(h, mesh), mesh)));
    const Vector n = (b - a).cross(c - a);
    all += n.norm();
    if (n.dot(vector(place) - a) > 0) there += n.norm();
  }
  return there / all;
}

BOOST_AUTO_TEST_CASE(without_a_sensor_a_room_looks_inwards)
{
  const Point eye(0.6, 0.6, 1.5);
  Random random(8);
  for (const auto& targets :
       {std::vector<Point>{{3.5, 1, 0.5}, {3, 2.5, 0.6}}, std::vector<Point>{{2, 2.9, 1}, {3.5, 2.2, 1}},
        std::vector<Point>{{3.9, 0.6, 1}, {3.9, 2.5, 1}, {2, 2.8, 0.5}}}) {
    const Rigid_motion motion = random.motion(10);
    std::vector<Point> points;
    for (const Point& p : points_of_room(eye, targets)) points.push_back(point(motion(vector(p))));
    points = shuffled(points);
    BOOST_TEST(looks_at(triangulated(points, parameters::default_values()), point(motion(vector(eye)))) > 0.95);
    // A surface of fewer vertices than are looked at in turn.
    points.resize(500);
    BOOST_TEST(looks_at(triangulated(points, parameters::default_values()), point(motion(vector(eye)))) > 0.9);
  }
}

BOOST_AUTO_TEST_CASE(many_points_are_thinned_to_about_40000)
{
  Random random(6);
  const auto surface = [&](const Point& p) { return point(vector(p) * 7 + 0.01 * random.vector()); };
  std::vector<Point> points;
  for (const Point& p : sphere(200000)) points.push_back(surface(p));
  const Mesh mesh = triangulated(points, parameters::default_values());
  BOOST_TEST(mesh.number_of_vertices() > 36000);
  BOOST_TEST(mesh.number_of_vertices() < 44000);
  BOOST_TEST(area(mesh) == 4 * pi * 49, boost::test_tools::tolerance(0.03));
}

BOOST_AUTO_TEST_CASE(points_in_a_plane)
{
  std::vector<Point> points;
  for (int i = 0; i < 30; ++i)
    for (int j = 0; j < 20; ++j) points.emplace_back(i, j, 0);
  BOOST_TEST(area(triangulated(points, parameters::viewing_direction(down))) == 29 * 19,
             boost::test_tools::tolerance(1e-9));
  BOOST_TEST(area(triangulated(points, parameters::viewpoint(Point(15, 10, 30)))) == 29 * 19,
             boost::test_tools::tolerance(1e-9));
  BOOST_TEST(area(triangulated(points, parameters::default_values())) == 29 * 19, boost::test_tools::tolerance(0.02));
}

BOOST_AUTO_TEST_CASE(degenerate_points_give_no_triangle)
{
  const std::vector<std::vector<Point>> cases = {
      {},
      {Point(1, 2, 3)},
      {Point(1, 2, 3), Point(4, 5, 6)},
      {Point(1, 1, 1), Point(1, 1, 1), Point(1, 1, 1), Point(1, 1, 1)},
      {Point(0, 0, 0), Point(1, 1, 1), Point(2, 2, 2), Point(3, 3, 3), Point(4, 4, 4)},
      {Point(0, 0, 0), Point(0, 0, 1), Point(0, 0, 2), Point(0, 0, 3)}};
  for (const auto& points : cases) {
    BOOST_TEST(triangulated(points, parameters::viewing_direction(down)).number_of_faces() == 0);
    BOOST_TEST(triangulated(points, parameters::viewpoint(Point(1, 1, 1))).number_of_faces() == 0);
    BOOST_TEST(triangulated(points, parameters::default_values()).number_of_faces() == 0);
  }
  // three points are a triangle
  const std::vector<Point> three = {Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0)};
  BOOST_TEST(triangulated(three, parameters::viewing_direction(down)).number_of_faces() == 1);
}

BOOST_AUTO_TEST_CASE(any_range_and_mesh_will_do)
{
  const std::vector<Point> points = terrain().points();
  std::vector<std::pair<int, Point>> pairs;
  for (const Point& p : points) pairs.emplace_back(1, p);
  CGAL::Polyhedron_3<Kernel> polyhedron;
  CR::triangulate_points(pairs, polyhedron,
                         parameters::point_map(CGAL::Second_of_pair_property_map<std::pair<int, Point>>())
                             .viewing_direction(down)
                             .maximum_edge_ratio(5));
  const Mesh mesh = triangulated(points, parameters::viewing_direction(down));
  BOOST_TEST(polyhedron.size_of_vertices() == mesh.number_of_vertices());
  BOOST_TEST(polyhedron.size_of_facets() == mesh.number_of_faces());
  BOOST_TEST(is_manifold(polyhedron));
  const Mesh fewer = triangulated(points, parameters::viewing_direction(down).maximum_edge_ratio(1.2));
  BOOST_TEST(fewer.number_of_faces() < mesh.number_of_faces());
}

BOOST_AUTO_TEST_CASE(the_same_points_give_the_same_faces_whatever_was_allocated_before)
{
  // A heap with gaps: what is allocated next is here and there.
  std::mt19937 engine(1);
  std::vector<std::vector<char>> allocated;
  for (int i = 0; i < 20000; ++i) allocated.emplace_back(16 + engine() % 1500);
  std::vector<Point> points;
  for (const Vector& v : generated::bumps(40, 1, 0.005).points) points.push_back(point(v));
  std::vector<CR::internal::Flat_mesh> meshes;
  for (int i = 0; i < 4; ++i) {
    Mesh mesh;
    CR::triangulate_points(points, mesh);
    meshes.push_back(flat_mesh_of(mesh));
    for (int k = 0; k < 5000; ++k) allocated[engine() % allocated.size()] = std::vector<char>(16 + engine() % 1500);
  }
  for (const auto& mesh : meshes) {
    BOOST_TEST((mesh.faces == meshes.front().faces));
    BOOST_TEST((mesh.points == meshes.front().points));
  }
}

BOOST_AUTO_TEST_CASE(wrong_arguments_are_refused)
{
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<Point> points = {Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0)};
  const auto refuses = [](const std::vector<Point>& range, const auto& np, const std::string& text) {
    Mesh mesh;
    return is_refused([&] { CR::triangulate_points(range, mesh, np); }, "triangulate_points: " + text);
  };
  BOOST_TEST(refuses({Point(0, 0, 0), Point(0, no_depth, 0)}, parameters::default_values(), "point 1 of points"));
  BOOST_TEST(refuses({Point(-infinity, 0, 0)}, parameters::viewing_direction(down), "point 0 of points"));
  for (double size : {1e-200, 1e200})
    BOOST_TEST(
        refuses({Point(0, 0, 0), Point(size, 0, 0), Point(0, size, size)}, parameters::default_values(), "points has"));
  BOOST_TEST(refuses(points, parameters::viewpoint(Point(0, infinity, 0)), "viewpoint"));
  BOOST_TEST(refuses(points, parameters::viewing_direction(Kernel::Vector_3(0, 0, 0)), "viewing_direction"));
  BOOST_TEST(refuses(points, parameters::viewing_direction(Kernel::Vector_3(0, no_depth, 0)), "viewing_direction"));
  for (double ratio : {0., -1., no_depth, infinity})
    BOOST_TEST(refuses(points, parameters::maximum_edge_ratio(ratio), "maximum_edge_ratio"));
}

BOOST_AUTO_TEST_CASE(vertices_are_split_where_fans_meet)
{
  // a pyramid's four sides, of which opposite ones remain, and a closed one
  CR::internal::Flat_mesh mesh;
  for (int i = 0; i < 5; ++i) mesh.points.push_back(Vector::Constant(i));
  mesh.faces = {{0, 1, 2}, {0, 3, 4}};
  split_non_manifold_vertices(mesh);
  BOOST_TEST(mesh.points.size() == 6);
  BOOST_TEST((mesh.points[5] == mesh.points[0]));
  BOOST_TEST((mesh.faces[0] == std::array<std::int32_t, 3>{0, 1, 2}));
  BOOST_TEST((mesh.faces[1] == std::array<std::int32_t, 3>{5, 3, 4}));
  mesh.points.resize(5);
  for (const auto& order : {std::array{0, 1, 2, 3}, std::array{0, 2, 1, 3}, std::array{3, 1, 0, 2}}) {
    const std::array<std::array<std::int32_t, 3>, 4> sides = {{{0, 1, 2}, {2, 3, 0}, {4, 0, 3}, {1, 0, 4}}};
    mesh.faces.clear();
    for (int k : order) mesh.faces.push_back(sides[std::size_t(k)]);
    split_non_manifold_vertices(mesh);
    BOOST_TEST(mesh.points.size() == 5);
  }
}

BOOST_AUTO_TEST_CASE(real_points_with_and_without_their_sensor,
                     *boost::unit_test::label("real_scans") *
                         boost::unit_test::precondition(generated::real_scans_are_there))
{
  for (const auto& file : files(real_scans("uwa_trex"), ".txt")) {
    if (file.filename() == "poses.txt") continue;
    const std::vector<Point> points = CR::read_scan<Kernel>(file.string()).points;
    const Mesh mesh = triangulated(points, parameters::viewpoint(Point(0, 0, 0)));
    BOOST_TEST_CONTEXT(file)
    {
      BOOST_TEST(mesh.number_of_vertices() > 0.98 * double(points.size()));
      BOOST_TEST(mesh.number_of_faces() > 1.8 * double(points.size()));
      BOOST_TEST(count_faces(mesh, [](const Vector& p, const Vector& n) { return n.dot(p) < 0; }) ==
                 mesh.number_of_faces());
    }
  }
  const auto fragments = files(real_scans("3dmatch_kitchen"), ".ply");
  if (fragments.empty()) return;
  const Mesh mesh = triangulated(CR::read_scan<Kernel>(fragments[0].string()).points, parameters::default_values());
  BOOST_TEST(mesh.number_of_vertices() > 38000);
  BOOST_TEST(mesh.number_of_faces() > 70000);
  BOOST_TEST(looks_at(mesh, Point(0, 0, 0)) > 0.85); // where the camera's way began
}

// CGAL's own front is the reference: the same number of triangles but for edges that are equally good; and what lies in
// memory before does not matter.
BOOST_AUTO_TEST_CASE(joined_points_depend_on_the_points_alone)
{
  // Of a sphere, in a grid that has many equal edges.
  std::vector<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3> points;
  constexpr int rows = 24, columns = 48;
  for (int i = 1; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const double a = CGAL_PI * i / rows, b = 2 * CGAL_PI * j / columns;
      points.emplace_back(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a));
    }
  const auto faces = CR::join_points(points);
  std::vector<std::array<std::size_t, 3>> reference;
  CGAL::advancing_front_surface_reconstruction(points.begin(), points.end(), std::back_inserter(reference));
  BOOST_TEST(std::abs(double(faces.size()) - double(reference.size())) < 0.02 * double(reference.size()));
  BOOST_TEST(std::is_sorted(faces.begin(), faces.end()));
  for (std::size_t i = 1; i < 8; ++i) {
    std::vector<std::unique_ptr<char[]>> before;
    for (std::size_t k = 0; k < 100 * i; ++k) before.push_back(std::make_unique<char[]>(16 + 37 * k % 1000));
    BOOST_TEST((CR::join_points(points) == faces));
  }
}
