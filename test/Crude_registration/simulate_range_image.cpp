// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#define BOOST_TEST_MODULE simulate_range_image
#include <boost/test/unit_test.hpp>

#include "mesh_of.h"

#include <CGAL/Crude_registration/internal/lookup/Triangle_tree.h>
#include <CGAL/Crude_registration/internal/simulation/marching_tetrahedra.h>
#include <CGAL/Crude_registration/simulation/make_statue.h>
#include <CGAL/Crude_registration/simulation/simulate_range_image.h>

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/generators.h>

#include <functional>
#include <limits>

namespace CR = CGAL::Crude_registration;
using CR::internal::Vector;

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Camera = CR::Range_camera<Kernel>;
using Scan = CR::Simulated_range_image<Kernel>;
using Mesh = CGAL::Surface_mesh<Point>;

namespace {

Vector vector(const Point& p)
{
  return Vector(p.x(), p.y(), p.z());
}

// A sphere of radius 1 around the origin, off by at most 3e-4.
const Mesh& sphere()
{
  static const Mesh mesh = [] {
    return mesh_of<Mesh>(CR::internal::marching_tetrahedra([](const Vector& p) { return 1 - p.norm(); },
                                                           Vector::Constant(-1.05), 2.1 / 80, {80, 80, 80}));
  }();
  return mesh;
}

const Mesh& statue()
{
  static const Mesh mesh = [] {
    Mesh m;
    CR::make_statue(m, 48, CR::parameters::random_seed(7));
    return m;
  }();
  return mesh;
}

CGAL::Bbox_3 bounding_box(const Mesh& mesh)
{
  CGAL::Bbox_3 box;
  for (Mesh::Vertex_index v : mesh.vertices()) box += mesh.point(v).bbox();
  return box;
}

// A camera at distance 4 from the center of the unit sphere, in no special position, that sees a square of side 2.2.
Camera sphere_camera(bool is_perspective)
{
  const Vector from = 4 * Vector(0.5, -0.7, 0.3).normalized();
  Camera camera;
  camera.viewpoint = Point(from.x(), from.y(), from.z());
  camera.target = Point(0, 0, 0);
  camera.up = Kernel::Vector_3(0.2, 0.1, 1);
  camera.columns = 120;
  camera.rows = 110;
  camera.spacing = 0.02;
  camera.is_perspective = is_perspective;
  return camera;
}

bool same_bits(const Scan& a, const Scan& b)
{
  return a.image.points() == b.image.points() && a.image.grid() == b.image.grid();
}

// Calls f(column, row, first point, second point) for every cell that has a sample in both images.
template <class Function>
void for_each_common_cell(const Scan& a, const Scan& b, const Function& f)
{
  for (std::size_t row = 0; row < a.image.rows(); ++row)
    for (std::size_t column = 0; column < a.image.columns(); ++column) {
      const auto i = a.image.index(column, row), j = b.image.index(column, row);
      if (i != a.image.no_sample && j != b.image.no_sample)
        f(column, row, vector(a.image.points()[std::size_t(i)]), vector(b.image.points()[std::size_t(j)]));
    }
}

} // namespace

BOOST_AUTO_TEST_CASE(orthographic_depth_of_a_sphere)
{
  const Camera camera = sphere_camera(false);
  const Scan scan = CR::simulate_range_image(sphere(), camera);
  BOOST_TEST(scan.image.columns() == 120u);
  BOOST_TEST(scan.image.rows() == 110u);
  BOOST_TEST(scan.image.sensor().is_orthographic());
  BOOST_TEST(scan.image.sensor().viewing_direction() == Kernel::Vector_3(0, 0, -1));
  for (std::size_t row = 0; row < 110; ++row)
    for (std::size_t column = 0; column < 120; ++column) {
      const double x = 0.02 * (double(column) - 59.5), y = 0.02 * (double(row) - 54.5), r2 = x * x + y * y;
      const auto i = scan.image.index(column, row);
      if (r2 > 1) BOOST_REQUIRE(i == scan.image.no_sample);
      else if (r2 < 0.99) {
        BOOST_REQUIRE(i != scan.image.no_sample);
        const Vector p = vector(scan.image.points()[std::size_t(i)]);
        BOOST_REQUIRE(std::abs(p.x() - x) < 1e-12);
        BOOST_REQUIRE(std::abs(p.y() - y) < 1e-12);
        BOOST_REQUIRE(std::abs(p.z() - (std::sqrt(1 - r2) - 4)) < 3e-4 / std::sqrt(1 - r2));
      }
    }
}

BOOST_AUTO_TEST_CASE(perspective_depth_of_a_sphere)
{
  const Camera camera = sphere_camera(true);
  const Scan scan = CR::simulate_range_image(sphere(), camera);
  BOOST_TEST(scan.image.sensor().is_perspective());
  BOOST_TEST(scan.image.sensor().viewpoint() == Point(0, 0, 0));
  const Vector center(0, 0, -4);
  for (std::size_t row = 0; row < 110; ++row)
    for (std::size_t column = 0; column < 120; ++column) {
      const Vector d = Vector(0.02 * (double(column) - 59.5), 0.02 * (double(row) - 54.5), -4).normalized();
      const double b = d.dot(center), discriminant = b * b - 15;
      const auto i = scan.image.index(column, row);
      if (discriminant < 0) BOOST_REQUIRE(i == scan.image.no_sample);
      else if (discriminant > 0.01) {
        BOOST_REQUIRE(i != scan.image.no_sample);
        const Vector expected = (b - std::sqrt(discriminant)) * d;
        BOOST_REQUIRE((vector(scan.image.points()[std::size_t(i)]) - expected).norm() < 3e-4 / std::sqrt(discriminant));
      }
    }
}

BOOST_AUTO_TEST_CASE(samples_lie_on_the_mesh_in_the_frame_of_the_scene)
{
  using Primitive = CGAL::AABB_face_graph_triangle_primitive<Mesh>;
#if CGAL_VERSION_NR >= CGAL_VERSION_NUMBER(6, 0, 0)
  using Traits = CGAL::AABB_traits_3<Kernel, Primitive>;
#else
  using Traits = CGAL::AABB_traits<Kernel, Primitive>;
#endif
  CGAL::AABB_tree<Traits> tree(faces(statue()).begin(), faces(statue()).end(), statue());
  const CR::Simulated_scene scene(statue());
  for (const bool is_perspective : {false, true})
    for (const Kernel::Vector_3& direction :
         {Kernel::Vector_3(1, 0.2, -0.3), Kernel::Vector_3(-0.1, 0.9, 0.4), Kernel::Vector_3(0.1, 0, -1)}) {
      Camera camera = Camera::framing(bounding_box(statue()), direction, 64, is_perspective);
      camera.noise = 0.2;
      const Scan noisy = scene.range_image(camera);
      camera.noise = 0;
      const Scan exact = scene.range_image(camera);
      BOOST_TEST(exact.image.points().size() > 300u);
      BOOST_TEST(noisy.image.points().size() == exact.image.points().size());
      for (const Point& p : exact.image.points())
        BOOST_REQUIRE(tree.squared_distance(p.transform(exact.scene_from_scan)) < 1e-24);
      double largest = 0;
      for (const Point& p : noisy.image.points())
        largest = (std::max)(largest, std::sqrt(tree.squared_distance(p.transform(noisy.scene_from_scan))));
      BOOST_TEST(largest < 6 * 0.2 * camera.spacing);
      BOOST_TEST(largest > 0.2 * camera.spacing);
      // Framed: nothing is cut off at the border of the image.
      for (std::size_t i = 0; i < 64; ++i)
        for (const auto index :
             {exact.image.index(i, 0), exact.image.index(i, 63), exact.image.index(0, i), exact.image.index(63, i)})
          BOOST_REQUIRE(index == exact.image.no_sample);
    }
}

BOOST_AUTO_TEST_CASE(only_the_nearest_surface_is_seen)
{
  // Two squares across the line of sight; the nearer one, turned away from the camera, covers the left half of the
  // image.
  Mesh mesh;
  CGAL::make_triangle(Point(-2, -2, -3), Point(2, -2, -3), Point(0, 6, -3), mesh);
  CGAL::make_triangle(Point(-9, -5, -2), Point(0, 5, -2), Point(0, -5, -2), mesh);
  Camera camera;
  camera.viewpoint = Point(0, 0, 0);
  camera.target = Point(0, 0, -1);
  camera.columns = camera.rows = 20;
  camera.spacing = 0.1;
  const Scan scan = CR::simulate_range_image(mesh, camera);
  BOOST_TEST(scan.image.points().size() == 400u);
  for (const Point& p : scan.image.points()) BOOST_TEST(p.z() == (p.x() < 0 ? -2 : -3));
  // Behind the camera there is nothing to see.
  camera.target = Point(0, 0, 1);
  BOOST_TEST(CR::simulate_range_image(mesh, camera).image.points().empty());
}

BOOST_AUTO_TEST_CASE(noise_is_gaussian_along_the_line_of_sight_and_independent)
{
  for (const bool is_perspective : {false, true}) {
    Camera camera = sphere_camera(is_perspective);
    camera.columns = 240;
    camera.rows = 220;
    camera.spacing = 0.01;
    const Scan exact = CR::simulate_range_image(sphere(), camera);
    camera.noise = 0.5;
    const Scan noisy = CR::simulate_range_image(sphere(), camera);
    double n = 0, sum = 0, squares = 0, fourth = 0, beyond = 0, products = 0, previous = 0;
    for_each_common_cell(exact, noisy, [&](std::size_t, std::size_t, const Vector& p, const Vector& q) {
      const Vector direction = is_perspective ? Vector(p.normalized()) : Vector(0, 0, -1);
      const double e = (q - p).dot(direction) / (0.5 * 0.01);
      BOOST_REQUIRE((q - p - (q - p).dot(direction) * direction).norm() < 1e-12);
      n += 1;
      sum += e;
      squares += e * e;
      fourth += e * e * e * e;
      beyond += std::abs(e) > 2;
      products += e * previous;
      previous = e;
    });
    BOOST_TEST(n > 29000);
    const double deviation = 1 / std::sqrt(n);
    BOOST_TEST(std::abs(sum / n) < 4 * deviation);
    BOOST_TEST(std::abs(squares / n - 1) < 4 * std::sqrt(2.) * deviation);
    BOOST_TEST(std::abs(fourth / n - 3) < 4 * std::sqrt(96.) * deviation);
    BOOST_TEST(std::abs(beyond / n - 0.0455) < 4 * 0.21 * deviation);
    BOOST_TEST(std::abs(products / n) < 4 * deviation);
  }
}

BOOST_AUTO_TEST_CASE(distances_are_rounded_to_the_quantization_step)
{
  for (const bool is_perspective : {false, true}) {
    Camera camera = sphere_camera(is_perspective);
    const Scan exact = CR::simulate_range_image(sphere(), camera);
    camera.quantization = 0.3;
    const Scan rounded = CR::simulate_range_image(sphere(), camera);
    BOOST_TEST(rounded.image.points().size() == exact.image.points().size());
    const double step = 0.3 * camera.spacing;
    for_each_common_cell(exact, rounded, [&](std::size_t, std::size_t, const Vector& p, const Vector& q) {
      const double distance = is_perspective ? q.norm() : -q.z();
      BOOST_REQUIRE(std::abs(distance / step - std::round(distance / step)) < 1e-9);
      BOOST_REQUIRE((q - p).norm() <= step / 2 * (1 + 1e-9));
    });
  }
}

BOOST_AUTO_TEST_CASE(drop_outs_grow_at_grazing_angles)
{
  Camera camera = sphere_camera(false);
  camera.columns = camera.rows = 400;
  camera.spacing = 2.1 / 400;
  camera.drop_out = 0.1;
  camera.grazing_drop_out = 0.9;
  const Scan scan = CR::simulate_range_image(sphere(), camera);
  constexpr int bins = 8;
  std::vector<double> seen(bins, 0), expected(bins, 0), variance(bins, 0);
  for (std::size_t row = 0; row < 400; ++row)
    for (std::size_t column = 0; column < 400; ++column) {
      const double x = camera.spacing * (double(column) - 199.5), y = camera.spacing * (double(row) - 199.5);
      if (x * x + y * y > 0.995) continue;
      const double cosine = std::sqrt(1 - x * x - y * y);
      const double kept = 0.9 - 0.8 * std::pow(1 - cosine, 4);
      const std::size_t bin = std::size_t(bins * cosine);
      if (bin >= bins) continue;
      seen[bin] += scan.image.index(column, row) != scan.image.no_sample;
      expected[bin] += kept;
      variance[bin] += kept * (1 - kept);
    }
  for (std::size_t bin = 0; bin < bins; ++bin)
    BOOST_TEST(std::abs(seen[bin] - expected[bin]) < 4 * std::sqrt(variance[bin]) + 0.005 * expected[bin]);
}

BOOST_AUTO_TEST_CASE(same_seed_same_bits_and_errors_do_not_depend_on_each_other)
{
  const CR::Simulated_scene scene(statue());
  Camera camera = Camera::framing(bounding_box(statue()), Kernel::Vector_3(1, 0.5, -0.2), 80);
  camera.noise = 0.1;
  camera.seed = 5;
  const Scan complete = scene.range_image(camera);
  camera.drop_out = 0.2;
  camera.grazing_drop_out = 1;
  const Scan a = scene.range_image(camera);
  BOOST_TEST(same_bits(a, CR::simulate_range_image(statue(), camera)));
  BOOST_TEST(a.image.points().size() < 0.85 * double(complete.image.points().size()));
  BOOST_TEST(a.image.points().size() > 0.5 * double(complete.image.points().size()));
  // What is left has the same noise as without drop-outs.
  for_each_common_cell(complete, a,
                       [](std::size_t, std::size_t, const Vector& p, const Vector& q) { BOOST_REQUIRE(p == q); });
  camera.seed = 6;
  BOOST_TEST(!same_bits(a, scene.range_image(camera)));
}

BOOST_AUTO_TEST_CASE(true_motion_aligns_two_views)
{
  const CR::Simulated_scene scene(statue());
  const CGAL::Bbox_3 box = bounding_box(statue());
  const Camera first = Camera::framing(box, Kernel::Vector_3(1, 0.3, -0.2), 128),
               second = Camera::framing(box, Kernel::Vector_3(0.8, 0.8, -0.1), 128);
  const Scan a = scene.range_image(first), b = scene.range_image(second);
  const Kernel::Aff_transformation_3 b_from_a = b.scene_from_scan.inverse() * a.scene_from_scan;
  const CR::internal::Matrix rotation = CR::internal::to_rigid_motion(b_from_a).rotation;
  BOOST_TEST((rotation * rotation.transpose() - CR::internal::Matrix::Identity()).norm() < 1e-14);
  BOOST_TEST(rotation.determinant() > 0);

  // A sample of a, moved into b's frame, is at the depth that b sees there, or behind; it is never in front of all that
  // b sees around.
  int same = 0, in_front = 0, all = 0;
  for (const Point& p : a.image.points()) {
    const Vector q = vector(p.transform(b_from_a));
    const auto column = std::lround(q.x() / second.spacing + 63.5), row = std::lround(q.y() / second.spacing + 63.5);
    double nearest = -std::numeric_limits<double>::infinity(), difference = -nearest;
    for (auto r = row - 1; r <= row + 1; ++r)
      for (auto c = column - 1; c <= column + 1; ++c) {
        BOOST_REQUIRE((c >= 0 && r >= 0 && c < 128 && r < 128));
        const auto i = b.image.index(std::size_t(c), std::size_t(r));
        if (i == b.image.no_sample) continue;
        const double z = b.image.points()[std::size_t(i)].z();
        nearest = (std::max)(nearest, z);
        difference = (std::min)(difference, std::abs(z - q.z()));
      }
    ++all;
    same += difference < second.spacing;
    in_front += std::isfinite(nearest) && q.z() > nearest + second.spacing;
  }
  BOOST_TEST(same > 0.5 * all);
  BOOST_TEST(in_front < 0.005 * all);
}

BOOST_AUTO_TEST_CASE(unit_and_position_of_the_scene_do_not_matter)
{
  const Camera camera = sphere_camera(true);
  const Scan scan = CR::simulate_range_image(sphere(), camera);
  for (const double unit : {1e-3, 1e6}) {
    Mesh mesh = sphere();
    const Kernel::Aff_transformation_3 scaling(CGAL::SCALING, unit);
    for (Mesh::Vertex_index v : mesh.vertices()) mesh.point(v) = mesh.point(v).transform(scaling);
    Camera scaled = camera;
    scaled.viewpoint = camera.viewpoint.transform(scaling);
    scaled.target = camera.target.transform(scaling);
    scaled.spacing *= unit;
    scaled.up = unit * camera.up;
    const Scan other = CR::simulate_range_image(mesh, scaled);
    BOOST_TEST(other.image.grid() == scan.image.grid());
    for (std::size_t i = 0; i < scan.image.points().size(); ++i)
      BOOST_REQUIRE((vector(other.image.points()[i]) / unit - vector(scan.image.points()[i])).norm() < 1e-11);
  }
}

BOOST_AUTO_TEST_CASE(any_face_graph_and_point_map)
{
  Camera camera = Camera::framing(CGAL::Bbox_3(0, 0, 0, 1, 1, 1), Kernel::Vector_3(1, 0.6, -0.7), 40);
  CGAL::Polyhedron_3<CGAL::Exact_predicates_inexact_constructions_kernel> polyhedron;
  using P = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
  CGAL::make_tetrahedron(P(0, 0, 0), P(1, 0, 0), P(0, 1, 0), P(0, 0, 1), polyhedron);
  Mesh mesh;
  CGAL::make_tetrahedron(Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(0, 0, 1), mesh);
  const Scan scan = CR::simulate_range_image(mesh, camera);
  BOOST_TEST(scan.image.points().size() > 50u);
  BOOST_TEST(same_bits(scan, CR::simulate_range_image(polyhedron, camera)));

  auto points = mesh.add_property_map<Mesh::Vertex_index, Point>("v:moved").first;
  for (Mesh::Vertex_index v : mesh.vertices()) points[v] = mesh.point(v) + Kernel::Vector_3(0, 0, 100);
  for (const auto& empty : {CR::simulate_range_image(mesh, camera, CR::parameters::vertex_point_map(points)),
                            CR::simulate_range_image(mesh, camera, CGAL::parameters::vertex_point_map(points))})
    BOOST_TEST(empty.image.points().empty());
}

BOOST_AUTO_TEST_CASE(faces_without_area_are_not_seen)
{
  Mesh mesh;
  CGAL::make_triangle(Point(-1, -1, -1), Point(1, -1, -1), Point(0, 1, -1), mesh);
  CGAL::make_triangle(Point(-1, 0, -0.5), Point(0, 0, -0.5), Point(1, 0, -0.5), mesh);
  Camera camera;
  camera.viewpoint = Point(0, 0, 0);
  camera.target = Point(0, 0, -1);
  camera.columns = camera.rows = 5;
  camera.spacing = 0.1;
  const Scan scan = CR::simulate_range_image(mesh, camera);
  BOOST_TEST(scan.image.points().size() == 25u);
  for (const Point& p : scan.image.points()) BOOST_TEST(p.z() == -1);
}

BOOST_AUTO_TEST_CASE(wrong_use_is_named)
{
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  const CR::Simulated_scene scene(statue());
  auto check = [&](const std::string& name, const std::function<void(Camera&)>& spoil) {
    Camera camera;
    spoil(camera);
    BOOST_CHECK_EXCEPTION(scene.range_image(camera), std::invalid_argument, [&](const std::exception& e) {
      return std::string(e.what()).find("Range_camera: " + name) == 0;
    });
  };
  check("viewpoint", [&](Camera& c) { c.viewpoint = Point(nan, 0, 0); });
  check("target", [&](Camera& c) { c.target = Point(0, infinity, 0); });
  check("target", [&](Camera& c) { c.target = c.viewpoint; });
  check("up", [&](Camera& c) { c.up = Kernel::Vector_3(0, 0, 3); });
  check("up", [&](Camera& c) { c.up = Kernel::Vector_3(0, 0, 0); });
  check("up", [&](Camera& c) { c.up = Kernel::Vector_3(0, nan, 0); });
  check("columns", [&](Camera& c) { c.columns = 0; });
  check("columns", [&](Camera& c) { c.rows = 0; });
  for (const double wrong : {0., -1., nan, infinity}) check("spacing", [&](Camera& c) { c.spacing = wrong; });
  for (const double wrong : {-1., nan, infinity}) {
    check("noise", [&](Camera& c) { c.noise = wrong; });
    check("quantization", [&](Camera& c) { c.quantization = wrong; });
  }
  for (const double wrong : {-0.1, 1.1, nan}) {
    check("drop_out", [&](Camera& c) { c.drop_out = wrong; });
    check("grazing_drop_out", [&](Camera& c) { c.grazing_drop_out = wrong; });
  }

  auto check_mesh = [&](const std::string& text, const Mesh& mesh) {
    BOOST_CHECK_EXCEPTION(CR::simulate_range_image(mesh, Camera()), std::invalid_argument,
                          [&](const std::exception& e) {
                            const std::string what = e.what();
                            return what.find("simulate_range_image: ") == 0 && what.find(text) != std::string::npos;
                          });
  };
  check_mesh("no face of positive area", Mesh());
  Mesh mesh;
  CGAL::make_quad(Point(0, 0, 0), Point(1, 0, 0), Point(1, 1, 0), Point(0, 1, 0), mesh);
  check_mesh("is not a triangle", mesh);
  mesh.clear();
  CGAL::make_triangle(Point(0, 0, 0), Point(1, 0, nan), Point(1, 1, 0), mesh);
  check_mesh("is not finite", mesh);
}
