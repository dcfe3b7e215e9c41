// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// g++ takes the default value that CGAL gives a property of a type of Eigen's for a use of uninitialised memory.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#define BOOST_TEST_MODULE register_meshes
#include <boost/test/unit_test.hpp>

#include <CGAL/Crude_registration/make_statue.h>
#include <CGAL/Crude_registration/register_scans.h>
#include <CGAL/Crude_registration/simulate_range_image.h>
#include <CGAL/Crude_registration/triangulate_range_image.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/transform.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#ifdef CGAL_USE_OPENMESH
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

#include <CGAL/boost/graph/graph_traits_PolyMesh_ArrayKernelT.h>
#endif

#include <Eigen/Geometry>

#include <cmath>
#include <limits>
#include <string>

namespace CR = CGAL::Crude_registration;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Camera = CR::Range_camera<Kernel>;
using CR::internal::Rigid_motion;
using CR::internal::Vector;

namespace {

struct View
{
  Mesh mesh; // in the sensor's frame
  Rigid_motion scene_from_scan;
};

const CR::Simulated_scene& scene(unsigned seed, CGAL::Bbox_3& box)
{
  const auto make = [](unsigned s, CGAL::Bbox_3& b) {
    Mesh statue;
    CR::make_statue(statue, 64, CR::parameters::random_seed(s));
    b = CGAL::Polygon_mesh_processing::bbox(statue);
    return CR::Simulated_scene(statue);
  };
  static CGAL::Bbox_3 boxes[2];
  static const CR::Simulated_scene scenes[2] = {make(1, boxes[0]), make(2, boxes[1])};
  box = boxes[seed - 1];
  return scenes[seed - 1];
}

View view(double degrees, unsigned seed = 1)
{
  CGAL::Bbox_3 box;
  const CR::Simulated_scene& statue = scene(seed, box);
  const double a = degrees * CGAL_PI / 180;
  Camera camera = Camera::framing(box, Kernel::Vector_3(-std::cos(a), -std::sin(a), -0.2), 160);
  camera.noise = 0.1;
  camera.seed = unsigned(degrees) + 1;
  const auto simulated = statue.range_image(camera);
  View v;
  CR::triangulate_range_image(simulated.image, v.mesh);
  v.scene_from_scan = CR::internal::to_rigid_motion(simulated.scene_from_scan);
  return v;
}

double degrees_between(const Rigid_motion& a, const Rigid_motion& b)
{
  return 180 / CGAL_PI * Eigen::AngleAxisd(CR::internal::Matrix(a.rotation * b.rotation.transpose())).angle();
}

double size(const Mesh& mesh)
{
  const CGAL::Bbox_3 b = CGAL::Polygon_mesh_processing::bbox(mesh);
  return std::sqrt(CGAL::squared_distance(Kernel::Point_3(b.xmin(), b.ymin(), b.zmin()),
                                          Kernel::Point_3(b.xmax(), b.ymax(), b.zmax())));
}

// The largest distance that the two motions take a vertex apart.
double displacement(const Mesh& mesh, const Rigid_motion& a, const Rigid_motion& b)
{
  double largest = 0;
  for (const auto& p : mesh.points()) {
    const Vector x(p.x(), p.y(), p.z());
    largest = (std::max)(largest, (a(x) - b(x)).norm());
  }
  return largest;
}

template <class Result>
Rigid_motion motion(const Result& result)
{
  return CR::internal::to_rigid_motion(result.transformation());
}

template <class Place>
Mesh patch(int n, Place place)
{
  Mesh mesh;
  std::vector<Mesh::Vertex_index> v;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) v.push_back(mesh.add_vertex(place(double(i) / n, double(j) / n)));
  const auto at = [&](int i, int j) { return v[std::size_t(i * (n + 1) + j)]; };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      mesh.add_face(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      mesh.add_face(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  return mesh;
}

} // namespace

BOOST_AUTO_TEST_CASE(views_of_one_body_register_to_the_true_motion)
{
  const View source = view(0), target = view(40);
  const Rigid_motion truth = target.scene_from_scan.inverse() * source.scene_from_scan;
  const auto result = CR::register_meshes(source.mesh, target.mesh);
  BOOST_TEST_REQUIRE(result.status() == CR::REGISTERED, result.reason());
  BOOST_TEST(degrees_between(motion(result), truth) < 1);
  BOOST_TEST(displacement(source.mesh, motion(result), truth) < 0.01 * size(source.mesh));
  BOOST_TEST(result.confidence() >= 0.9);
  BOOST_TEST(result.overlap() > 0.3);

  // The other way round is the inverse.
  const auto back = CR::register_meshes(target.mesh, source.mesh);
  BOOST_TEST_REQUIRE(back.status() == CR::REGISTERED);
  BOOST_TEST(displacement(source.mesh, motion(result), motion(back).inverse()) < 1e-9 * size(source.mesh));

  // Other types of meshes, other orders of parameters.
  CGAL::Polyhedron_3<Kernel> polyhedron;
  CGAL::copy_face_graph(source.mesh, polyhedron);
  const auto from_polyhedron =
      CR::register_meshes(polyhedron, target.mesh, CR::parameters::maximum_extent(1.0).minimum_extent(0.0));
  BOOST_TEST_REQUIRE(from_polyhedron.status() == CR::REGISTERED);
  BOOST_TEST(displacement(source.mesh, motion(result), motion(from_polyhedron)) < 1e-3 * size(source.mesh));
#ifdef CGAL_USE_OPENMESH
  OpenMesh::PolyMesh_ArrayKernelT<> open_mesh; // of float
  CGAL::copy_face_graph(source.mesh, open_mesh);
  const auto from_open_mesh = CR::register_meshes(open_mesh, target.mesh, CR::parameters::geom_traits(Kernel()));
  BOOST_TEST_REQUIRE(from_open_mesh.status() == CR::REGISTERED);
  BOOST_TEST(displacement(source.mesh, motion(result), motion(from_open_mesh)) < 1e-3 * size(source.mesh));
#else
  BOOST_TEST_MESSAGE("OpenMesh is not installed: not tested with it");
#endif
}

BOOST_AUTO_TEST_CASE(frame_and_unit_do_not_matter)
{
  const View source = view(0), target = view(40);
  const auto result = CR::register_meshes(source.mesh, target.mesh);
  BOOST_TEST_REQUIRE(result.status() == CR::REGISTERED);
  Rigid_motion moved;
  moved.rotation = Eigen::Quaterniond(0.3, -0.5, 0.7, 0.2).normalized().toRotationMatrix();
  moved.translation = 10 * size(source.mesh) * Vector(1, -2, 0.5);
  for (double unit : {1e-3, 0.3048, 1e3}) {
    Mesh other = source.mesh, scaled_target = target.mesh;
    CGAL::Polygon_mesh_processing::transform(CR::internal::to_aff_transformation<Kernel>(moved), other);
    const Kernel::Aff_transformation_3 scale(CGAL::SCALING, unit);
    CGAL::Polygon_mesh_processing::transform(scale, other);
    CGAL::Polygon_mesh_processing::transform(scale, scaled_target);
    const auto again = CR::register_meshes(other, scaled_target);
    BOOST_TEST_REQUIRE(again.status() == CR::REGISTERED, "unit " << unit << ": " << again.reason());
    Rigid_motion in_first_unit = motion(again);
    in_first_unit.translation /= unit;
    BOOST_TEST(displacement(source.mesh, in_first_unit * moved, motion(result)) < 1e-3 * size(source.mesh),
               "unit " << unit);
  }
}

BOOST_AUTO_TEST_CASE(what_does_not_overlap_is_not_registered)
{
  BOOST_TEST(CR::register_meshes(view(0).mesh, view(180).mesh).status() != CR::REGISTERED);
  BOOST_TEST(CR::register_meshes(view(0).mesh, view(0, 2).mesh).status() != CR::REGISTERED);
}

BOOST_AUTO_TEST_CASE(a_mesh_registers_to_itself_by_the_identity)
{
  const View v = view(0);
  const auto result = CR::register_meshes(v.mesh, v.mesh);
  BOOST_TEST_REQUIRE(result.status() == CR::REGISTERED);
  BOOST_TEST(displacement(v.mesh, motion(result), Rigid_motion()) < 1e-3 * size(v.mesh));
}

BOOST_AUTO_TEST_CASE(what_moves_in_itself_is_ambiguous_and_says_why)
{
  using Point = Kernel::Point_3;
  const auto plane = [](double shift) {
    return [shift](double u, double v) { return Point(20 * u + shift, 16 * v, 0); };
  };
  const auto sphere = [](double shift) {
    return [shift](double u, double v) {
      const double a = 1.2 * (u - 0.5) + shift, b = 1.2 * (v - 0.5);
      return Point(10 * std::sin(a) * std::cos(b), 10 * std::sin(b), 10 * std::cos(a) * std::cos(b));
    };
  };
  const auto cylinder = [](double shift) {
    return [shift](double u, double v) {
      const double a = 2 * (u - 0.5) + shift;
      return Point(8 * std::sin(a), 20 * v, 8 * std::cos(a));
    };
  };
  const auto check = [](const auto& shape, const std::string& name, std::size_t motions) {
    const auto result = CR::register_meshes(patch(90, shape(0)), patch(100, shape(0.3)));
    BOOST_TEST(result.status() == CR::AMBIGUOUS, name << ": " << result.status());
    BOOST_TEST(result.reason().find(name) != std::string::npos, name << ": " << result.reason());
    BOOST_TEST(result.free_motions().size() == motions, name);
  };
  check(plane, "a plane", 3);
  check(sphere, "a sphere", 3);
  check(cylinder, "a cylinder", 2);
}

BOOST_AUTO_TEST_CASE(wrong_use_is_named)
{
  const auto says = [](const std::string& words) {
    return [words](const std::invalid_argument& e) {
      BOOST_TEST_MESSAGE(e.what());
      return std::string(e.what()).find(words) != std::string::npos;
    };
  };
  const Mesh good = patch(20, [](double u, double v) { return Kernel::Point_3(u, v, u * v); });
  BOOST_CHECK_EXCEPTION(CR::register_meshes(Mesh(), good), std::invalid_argument, says("source"));
  BOOST_CHECK_EXCEPTION(CR::register_meshes(good, Mesh()), std::invalid_argument, says("target"));
  Mesh bad = good;
  bad.point(Mesh::Vertex_index(7)) = Kernel::Point_3(0, std::numeric_limits<double>::quiet_NaN(), 0);
  BOOST_CHECK_EXCEPTION(CR::register_meshes(good, bad), std::invalid_argument, says("target"));
  Mesh quad;
  quad.add_face(quad.add_vertex(Kernel::Point_3(0, 0, 0)), quad.add_vertex(Kernel::Point_3(1, 0, 0)),
                quad.add_vertex(Kernel::Point_3(1, 1, 0)), quad.add_vertex(Kernel::Point_3(0, 1, 0)));
  BOOST_CHECK_EXCEPTION(CR::register_meshes(quad, good), std::invalid_argument, says("not a triangle"));
  BOOST_CHECK_EXCEPTION(CR::register_meshes(good, good, CR::parameters::minimum_extent(0.5).maximum_extent(0.5)),
                        std::invalid_argument, says("minimum_extent"));
  BOOST_CHECK_EXCEPTION(
      CR::register_meshes(
          good, good,
          CR::parameters::viewpoint(Kernel::Point_3(0, 0, 9)).viewing_direction(Kernel::Vector_3(0, 0, -1))),
      std::invalid_argument, says("viewpoint"));
  BOOST_CHECK_EXCEPTION(
      CR::register_meshes(patch(20, [](double u, double v) { return Kernel::Point_3(1e20 * u, 1e20 * v, 0); }), good),
      std::invalid_argument, says("source"));
  // Fewer than four usable vertices: a status, with its reason.
  Mesh triangle;
  triangle.add_face(triangle.add_vertex(Kernel::Point_3(0, 0, 0)), triangle.add_vertex(Kernel::Point_3(1, 0, 0)),
                    triangle.add_vertex(Kernel::Point_3(0, 1, 0)));
  const auto result =
      CR::register_meshes(triangle, good, CR::parameters::viewing_direction(Kernel::Vector_3(0, 0, -1)));
  BOOST_TEST(result.status() == CR::NOT_REGISTERED);
  BOOST_TEST(result.reason().find("too few vertices") != std::string::npos, result.reason());
}
