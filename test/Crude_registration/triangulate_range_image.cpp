// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#define BOOST_TEST_MODULE triangulate_range_image
#include <boost/test/unit_test.hpp>

#include "range_images.h"
#include "wrong_use.h"

#include <CGAL/Crude_registration/IO/read_range_image.h>
#include <CGAL/Crude_registration/sampling/sampling_distance.h>
#include <CGAL/Crude_registration/sampling/triangulate_range_image.h>

#include <CGAL/Polygon_mesh_processing/manifoldness.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using namespace generated;
using Mesh = CGAL::Surface_mesh<Point>;

namespace {

const Sensor from_above = Sensor::orthographic(Kernel::Vector_3(0, 0, -1));

Mesh triangulated(const Image& image)
{
  Mesh mesh;
  CR::triangulate_range_image(image, mesh);
  // The soup is the same, in the same order.
  std::vector<Point> points = {Point(9, 9, 9)};
  std::vector<std::array<std::size_t, 3>> soup = {{0, 0, 0}};
  CR::triangulate_range_image(image, points, soup);
  BOOST_TEST((points.size() == mesh.number_of_vertices() && soup.size() == mesh.number_of_faces()));
  for (Mesh::Face_index f : mesh.faces()) {
    std::multiset<std::size_t> corners;
    for (Mesh::Vertex_index v : CGAL::vertices_around_face(mesh.halfedge(f), mesh)) {
      corners.insert(std::size_t(v));
      BOOST_TEST((points.at(std::size_t(v)) == mesh.point(v)));
    }
    const auto& t = soup.at(std::size_t(f));
    BOOST_TEST((corners == std::multiset<std::size_t>(t.begin(), t.end())));
  }
  return mesh;
}

template <class Face_graph>
bool is_manifold(const Face_graph& mesh)
{
  std::vector<typename boost::graph_traits<Face_graph>::halfedge_descriptor> non_manifold;
  CGAL::Polygon_mesh_processing::non_manifold_vertices(mesh, std::back_inserter(non_manifold));
  return CGAL::is_valid_polygon_mesh(mesh) && CGAL::is_triangle_mesh(mesh) && non_manifold.empty();
}

using Triangle = std::array<Point, 3>;

// a triangle's corners, from the least on, in their order around it
Triangle normalised(Triangle t)
{
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

std::multiset<Triangle> triangles(const Mesh& mesh)
{
  std::multiset<Triangle> result;
  for (Mesh::Face_index f : mesh.faces()) {
    Triangle t;
    std::size_t k = 0;
    for (Mesh::Vertex_index v : CGAL::vertices_around_face(mesh.halfedge(f), mesh)) t[k++] = mesh.point(v);
    result.insert(normalised(t));
  }
  return result;
}

// Section 4 word by word: the triangles of each cell, seen from above, where columns x rows points upwards.
std::multiset<Triangle> expected_triangles(const Image& image, double longest)
{
  std::multiset<Triangle> result;
  const auto distance = [](const Point& p, const Point& q) { return std::sqrt(CGAL::squared_distance(p, q)); };
  const auto add = [&](const Point& p, const Point& q, const Point& r) {
    if (distance(p, q) <= longest && distance(q, r) <= longest && distance(r, p) <= longest)
      result.insert(normalised({p, q, r}));
  };
  for (std::size_t row = 0; row + 1 < image.rows(); ++row)
    for (std::size_t column = 0; column + 1 < image.columns(); ++column) {
      std::vector<Point> ring; // counterclockwise
      for (auto [c, r] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)}) {
        const auto i = image.index(column + std::size_t(c), row + std::size_t(r));
        if (i != image.no_sample) ring.push_back(image.points()[std::size_t(i)]);
      }
      if (ring.size() == 3) add(ring[0], ring[1], ring[2]);
      if (ring.size() < 4) continue;
      if (distance(ring[1], ring[3]) < distance(ring[0], ring[2]))
        std::rotate(ring.begin(), ring.begin() + 1, ring.end());
      add(ring[0], ring[1], ring[2]);
      add(ring[0], ring[2], ring[3]);
    }
  return result;
}

// The number of vertices a manifold of the triangles has: around each point, as many as there are groups of triangles
// that are linked by shared edges.
std::size_t expected_vertices(const std::multiset<Triangle>& triangles)
{
  std::map<Point, std::vector<std::set<Point>>> links; // the neighbours of a point, by group
  for (const Triangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      std::set<Point> group = {t[(k + 1) % 3], t[(k + 2) % 3]};
      auto& groups = links[t[k]];
      for (auto it = groups.begin(); it != groups.end();) {
        const bool shares = std::any_of(it->begin(), it->end(), [&](const Point& p) { return group.count(p) > 0; });
        if (shares) {
          group.insert(it->begin(), it->end());
          it = groups.erase(it);
        } else ++it;
      }
      groups.push_back(group);
    }
  std::size_t result = 0;
  for (const auto& link : links) result += link.second.size();
  return result;
}

Image four(double a, double b, double c, double d)
{
  const std::array<double, 4> heights = {a, b, c, d}; // of (0, 0), (1, 0), (0, 1), (1, 1)
  Image image = image_of(
      2, 2, [&](double column, double row) { return Vector(column, row, heights[std::size_t(column + 2 * row)]); });
  image.set_sensor(from_above);
  return image;
}

bool has_edge(const Mesh& mesh, const Point& p, const Point& q)
{
  for (Mesh::Halfedge_index h : mesh.halfedges())
    if (mesh.point(mesh.source(h)) == p && mesh.point(mesh.target(h)) == q) return true;
  return false;
}

// A random terrain, with holes and steps, for its sensor above.
Image random_terrain(unsigned seed, double holes)
{
  Random random(seed);
  Image image = image_of(13, 11, [&](double column, double row) {
    const double step = random.symmetric() > 0.6 ? 6 : 0;
    return random.symmetric() < 2 * holes - 1 ? Vector(Vector::Constant(no_depth))
                                              : Vector(column + 0.2 * random.symmetric(),
                                                       row + 0.2 * random.symmetric(), step + 0.5 * random.symmetric());
  });
  image.set_sensor(from_above);
  return image;
}

// how many faces are counterclockwise, seen from the sensor
std::size_t faces_towards(const Mesh& mesh, const Sensor& sensor)
{
  std::size_t count = 0;
  for (Mesh::Face_index f : mesh.faces()) {
    std::vector<Point> p;
    for (Mesh::Vertex_index v : CGAL::vertices_around_face(mesh.halfedge(f), mesh)) p.push_back(mesh.point(v));
    if (CGAL::cross_product(p[1] - p[0], p[2] - p[0]) * sensor.line_of_sight(p[0]) < 0) ++count;
  }
  return count;
}

} // namespace

BOOST_AUTO_TEST_CASE(four_samples_give_two_triangles_over_the_shorter_diagonal)
{
  const Mesh raised_a = triangulated(four(0.5, 0, 0, 0));
  BOOST_TEST(raised_a.number_of_faces() == 2);
  BOOST_TEST(has_edge(raised_a, Point(1, 0, 0), Point(0, 1, 0)));
  const Mesh raised_b = triangulated(four(0, 0.5, 0, 0));
  BOOST_TEST(raised_b.number_of_faces() == 2);
  BOOST_TEST(has_edge(raised_b, Point(0, 0, 0), Point(1, 1, 0)));
}

BOOST_AUTO_TEST_CASE(three_samples_give_one_triangle_and_two_none)
{
  for (int missing = 0; missing < 16; ++missing) {
    const auto height = [&](int i) { return (missing >> i & 1) != 0 ? no_depth : 0.1 * i; };
    const Image image = four(height(0), height(1), height(2), height(3));
    const Mesh mesh = triangulated(image);
    const std::size_t samples = image.points().size();
    BOOST_TEST(mesh.number_of_faces() == (samples == 4 ? 2u : samples == 3 ? 1u : 0u));
    BOOST_TEST(mesh.number_of_vertices() == (samples < 3 ? 0 : samples));
    BOOST_TEST(faces_towards(mesh, from_above) == mesh.number_of_faces());
  }
}

BOOST_AUTO_TEST_CASE(no_edge_is_longer_than_5_sampling_distances)
{
  // two levels; s is 1: over a step of 4.6 diagonals measure 4.81, over 4.8 they measure 5.003
  for (double step : {4.6, 4.8}) {
    Image image = orthographic_image(6, 5, 1, 1, [&](double x, double) { return x < 2.5 ? 0. : step; });
    image.set_sensor(from_above);
    BOOST_TEST(triangulated(image).number_of_faces() == (step == 4.6 ? 2u * 5 * 4 : 2u * 4 * 4));
    Mesh joined, parted;
    CR::triangulate_range_image(image, joined, CR::parameters::maximum_edge_ratio(6));
    BOOST_TEST(joined.number_of_faces() == 2u * 5 * 4);
    CR::triangulate_range_image(image, parted, CR::parameters::maximum_edge_ratio(2));
    BOOST_TEST(parted.number_of_faces() == 2u * 4 * 4);
  }
}

BOOST_AUTO_TEST_CASE(an_edge_of_just_the_longest_length_is_kept_in_every_frame)
{
  Image image = orthographic_image(30, 30, 1, 1, [](double, double) { return 0.; });
  image.set_sensor(from_above);
  Mesh diagonal;
  CR::triangulate_range_image(image, diagonal, CR::parameters::maximum_edge_ratio(std::sqrt(2.)));
  BOOST_TEST(diagonal.number_of_faces() == 2u * 29 * 29);
  Random random(1);
  for (int i = 0; i < 20; ++i) {
    Mesh there;
    CR::triangulate_range_image(moved(image, random.motion(100)), there,
                                CR::parameters::maximum_edge_ratio(std::sqrt(2.)));
    BOOST_TEST(there.number_of_faces() == 2u * 29 * 29);
  }
}

BOOST_AUTO_TEST_CASE(the_triangles_are_those_of_section_4_and_form_a_manifold)
{
  for (unsigned seed = 0; seed < 200; ++seed) {
    const Image image = random_terrain(seed, 0.02 * (seed % 30));
    const double s = CR::sampling_distance(image);
    const Mesh mesh = triangulated(image);
    BOOST_TEST_CONTEXT("seed " << seed)
    {
      const auto expected = expected_triangles(image, 5 * s);
      BOOST_TEST((triangles(mesh) == expected));
      BOOST_TEST(mesh.number_of_vertices() == expected_vertices(expected));
      BOOST_TEST(is_manifold(mesh));
    }
  }
}

BOOST_AUTO_TEST_CASE(triangles_that_meet_in_a_point_alone_get_a_vertex_each)
{
  const std::array<std::string, 3> grid = {"xx.", ".x.", ".xx"};
  Image image = image_of(3, 3, [&](double column, double row) {
    return grid[std::size_t(row)][std::size_t(column)] == 'x' ? Vector(column, row, 0)
                                                              : Vector(Vector::Constant(no_depth));
  });
  image.set_sensor(from_above);
  const Mesh mesh = triangulated(image);
  BOOST_TEST(mesh.number_of_faces() == 2);
  BOOST_TEST(mesh.number_of_vertices() == 6);
  BOOST_TEST(is_manifold(mesh));
  std::size_t middle = 0;
  for (Mesh::Vertex_index v : mesh.vertices()) middle += mesh.point(v) == Point(1, 1, 0) ? 1 : 0;
  BOOST_TEST(middle == 2);
}

BOOST_AUTO_TEST_CASE(faces_are_counterclockwise_seen_from_the_sensor)
{
  for (Image image : {random_terrain(3, 0.1), mirrored(random_terrain(3, 0.1)), transposed(random_terrain(4, 0.2))}) {
    const Mesh above = triangulated(image);
    BOOST_TEST(faces_towards(above, from_above) == above.number_of_faces());
    const Sensor from_below = Sensor::orthographic(Kernel::Vector_3(0, 0, 1));
    image.set_sensor(from_below);
    const Mesh below = triangulated(image);
    BOOST_TEST(below.number_of_faces() == above.number_of_faces());
    BOOST_TEST(faces_towards(below, from_below) == below.number_of_faces());
    const Sensor near = Sensor::perspective(Point(6, 5, 100));
    image.set_sensor(near);
    const Mesh seen = triangulated(image);
    BOOST_TEST(faces_towards(seen, near) == seen.number_of_faces());
  }
}

BOOST_AUTO_TEST_CASE(an_unknown_sensor_is_estimated)
{
  const auto ball = [](double x, double y) {
    const double square = 1 - (x - 1) * (x - 1) - (y - 1) * (y - 1);
    return square > 0 ? std::sqrt(square) : no_depth;
  };
  for (const Image& image :
       {orthographic_image(40, 40, 0.05, 0.05, ball), mirrored(orthographic_image(40, 40, 0.05, 0.05, ball))}) {
    const Mesh mesh = triangulated(image);
    BOOST_TEST(mesh.number_of_faces() > 2000);
    BOOST_TEST(faces_towards(mesh, from_above) == mesh.number_of_faces());
  }
  // a plane does not say from where it was seen: from the side of columns x rows
  const Image plane = orthographic_image(9, 9, 1, 1, [](double x, double) { return 0.2 * x; });
  BOOST_TEST(faces_towards(triangulated(plane), from_above) == 128);
  BOOST_TEST(faces_towards(triangulated(mirrored(plane)), from_above) == 0);
}

BOOST_AUTO_TEST_CASE(frame_and_unit_do_not_matter)
{
  Random random(5);
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Image image = random_terrain(seed, 0.2);
    const CR::internal::Flat_range_image flat(image);
    const auto faces = flat_triangulation(flat, CR::internal::sampling(flat)).faces;
    const Image other = moved(image, random.motion(1000));
    const CR::internal::Flat_range_image flat_other(other);
    BOOST_TEST((flat_triangulation(flat_other, CR::internal::sampling(flat_other)).faces == faces));
    for (double unit : {1e-6, 0.3048, 1e6}) {
      Image in_unit = scaled(image, unit);
      in_unit.set_sensor(image.sensor());
      const CR::internal::Flat_range_image flat_in_unit(in_unit);
      BOOST_TEST((flat_triangulation(flat_in_unit, CR::internal::sampling(flat_in_unit)).faces == faces));
    }
  }
  // equal diagonals everywhere: rounding has no say
  Image plane = orthographic_image(20, 20, 1, 1, [](double, double) { return 0.; });
  plane.set_sensor(from_above);
  const CR::internal::Flat_range_image flat(plane);
  const auto faces = flat_triangulation(flat, CR::internal::sampling(flat)).faces;
  for (int i = 0; i < 10; ++i) {
    const Image there = moved(plane, random.motion(1000));
    const CR::internal::Flat_range_image flat_there(there);
    BOOST_TEST((flat_triangulation(flat_there, CR::internal::sampling(flat_there)).faces == faces));
  }
}

BOOST_AUTO_TEST_CASE(the_longest_edge_of_a_camera_grows_with_the_range)
{
  // two walls, seen head on, at 1 and at 10: both are joined, although samples on the far one are 10 times as far
  // apart, and more than 5 sampling distances of the median range
  Image image = perspective_image(101, 40, 100, [](double a, double) { return a < 0.2 ? 1. : 10.; });
  image.set_sensor(Sensor::perspective(Point(0, 0, 0)));
  BOOST_TEST(CR::sampling_distance(image) < 10. / 100 / 5);
  const Mesh mesh = triangulated(image);
  BOOST_TEST(mesh.number_of_faces() == 2u * 39 * 99); // all but the column between the walls
}

BOOST_AUTO_TEST_CASE(any_mesh_will_do_and_is_added_to)
{
  const Image image = random_terrain(7, 0.2);
  const std::size_t vertices = triangulated(image).number_of_vertices(), faces = triangulated(image).number_of_faces();

  CGAL::Polyhedron_3<Kernel> polyhedron;
  CR::triangulate_range_image(image, polyhedron);
  BOOST_TEST(polyhedron.size_of_vertices() == vertices);
  BOOST_TEST(polyhedron.size_of_facets() == faces);
  BOOST_TEST(is_manifold(polyhedron));

  Mesh twice = triangulated(image);
  CR::triangulate_range_image(image, twice);
  BOOST_TEST(twice.number_of_vertices() == 2 * vertices);
  BOOST_TEST(twice.number_of_faces() == 2 * faces);

  Mesh mesh;
  auto map = mesh.add_property_map<Mesh::Vertex_index, Point>("v:elsewhere").first;
  CR::triangulate_range_image(image, mesh, CR::parameters::vertex_point_map(map).maximum_edge_ratio(5));
  BOOST_TEST(mesh.number_of_faces() == faces);
  const Mesh reference = triangulated(image);
  for (Mesh::Vertex_index v : mesh.vertices()) BOOST_TEST(map[v] == reference.point(v));
}

BOOST_AUTO_TEST_CASE(images_without_triangles_give_none)
{
  for (Image image : {Image(), Image(0, 9), Image(9, 0), Image(9, 9),
                      orthographic_image(1, 20, 1, 1, [](double, double) { return 0.; }),
                      orthographic_image(20, 1, 1, 1, [](double, double) { return 0.; }),
                      image_of(9, 9, [](double, double) { return Vector(1, 1, 1); })}) {
    BOOST_TEST(triangulated(image).is_empty());
    image.set_sensor(Sensor::perspective(Point(1, 1, 1)));
    BOOST_TEST(triangulated(image).is_empty());
  }
}

BOOST_AUTO_TEST_CASE(wrong_ratios_are_refused)
{
  Mesh mesh;
  for (double ratio : {0., -1., no_depth, std::numeric_limits<double>::infinity()})
    BOOST_CHECK_EXCEPTION(CR::triangulate_range_image(Image(3, 3), mesh, CR::parameters::maximum_edge_ratio(ratio)),
                          std::invalid_argument, names("triangulate_range_image: maximum_edge_ratio"));
}

BOOST_AUTO_TEST_CASE(real_range_images, *boost::unit_test::label("real_scans") *
                                            boost::unit_test::precondition(generated::real_scans_are_there))
{
  for (const std::string set : {"bunny", "dragon_stand", "slambook2_rgbd"}) {
    for (const auto& file : files(real_scans(set), ".ply")) {
      Image image;
      CR::read_range_image(file.string(), image);
      const CR::internal::Flat_range_image flat(image);
      const CR::internal::Flat_mesh mesh = flat_triangulation(flat, CR::internal::sampling(flat));
      BOOST_TEST_CONTEXT(file)
      {
        // nearly every sample has its place, and no face is turned away from the sensor
        BOOST_TEST(mesh.points.size() > 0.98 * double(image.points().size()));
        BOOST_TEST(mesh.faces.size() > 1.7 * double(image.points().size()));
        std::size_t away = 0;
        for (const auto& f : mesh.faces) {
          const Vector p = mesh.points[std::size_t(f[0])];
          const Vector normal = (mesh.points[std::size_t(f[1])] - p).cross(mesh.points[std::size_t(f[2])] - p);
          away += normal.dot(flat.sensor.towards(p)) >= 0 ? 1 : 0;
        }
        BOOST_TEST(away == 0);
      }
    }
  }
}
