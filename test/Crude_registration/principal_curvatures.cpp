// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#define BOOST_TEST_MODULE principal_curvatures
#include <boost/test/unit_test.hpp>

#include "generated_surfaces.h"
#include "mesh_of.h"
#include "wrong_use.h"

#include <CGAL/Crude_registration/reduction/principal_curvatures.h>

#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polyhedron_items_with_id_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <boost/property_map/property_map.hpp>

#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>

namespace CR = CGAL::Crude_registration;
namespace parameters = CR::parameters;
using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Vector_3 = Kernel::Vector_3;
using Curvatures = CR::Principal_curvatures<Kernel>;
using Mesh = CGAL::Surface_mesh<Point>;
using generated::pi;
using generated::Vector;

namespace {

template <class Face_graph>
struct Result
{
  using Vertex = typename boost::graph_traits<Face_graph>::vertex_descriptor;

  std::map<Vertex, Curvatures> curvatures;

  template <class NP = CGAL::parameters::Default_named_parameters>
  explicit Result(const Face_graph& mesh, const NP& np = parameters::default_values())
  {
    CR::principal_curvatures(mesh, boost::make_assoc_property_map(curvatures), np);
  }
};

double length(const Vector_3& v)
{
  return std::sqrt(v.squared_length());
}

} // namespace

BOOST_AUTO_TEST_CASE(torus_curvatures_and_directions)
{
  const double R = 3, r = 1;
  const Mesh mesh = mesh_of<Mesh>(generated::torus(180, 60, R, r, 0));
  const Result<Mesh> result(mesh);
  BOOST_TEST(result.curvatures.size() == mesh.number_of_vertices());
  for (Mesh::Vertex_index v : mesh.vertices()) {
    const Curvatures& k = result.curvatures.at(v);
    const Point& p = mesh.point(v);
    const double rho = std::hypot(p.x(), p.y()), c = (rho - R) / r;
    BOOST_TEST(std::abs(k.maximum - 1 / r) < 0.01);
    BOOST_TEST(std::abs(k.minimum - c / (R + r * c)) < 0.01);
    // It bends least around the axis of the torus.
    const Vector_3 around(-p.y() / rho, p.x() / rho, 0);
    BOOST_TEST(std::abs(k.minimum_direction * around) > 0.99);
    BOOST_TEST(std::abs(length(k.minimum_direction) - 1) < 1e-12);
    BOOST_TEST(std::abs(length(k.maximum_direction) - 1) < 1e-12);
    BOOST_TEST(std::abs(k.minimum_direction * k.maximum_direction) < 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(every_face_graph_gives_the_same)
{
  const CR::internal::Flat_mesh flat = generated::bumps(12);
  const Mesh mesh = mesh_of<Mesh>(flat);
  const Result<Mesh> expected(mesh);

  using Polyhedron = CGAL::Polyhedron_3<Kernel>;
  using Polyhedron_with_id = CGAL::Polyhedron_3<Kernel, CGAL::Polyhedron_items_with_id_3>;
  using Float_mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<float>::Point_3>;
  const auto polyhedron = mesh_of<Polyhedron>(flat);
  const auto polyhedron_with_id = mesh_of<Polyhedron_with_id>(flat);
  const auto float_mesh = mesh_of<Float_mesh>(flat);

  const auto check = [&](const auto& other, double tolerance) {
    const Result<std::decay_t<decltype(other)>> result(other);
    auto v = mesh.vertices().begin();
    for (auto w : vertices(other)) {
      const Curvatures &k = expected.curvatures.at(*v++), &l = result.curvatures.at(w);
      // The faces of a Polyhedron_3 start with another corner: rounding.
      BOOST_TEST(std::abs(k.minimum - l.minimum) < tolerance);
      BOOST_TEST(std::abs(k.maximum - l.maximum) < tolerance);
    }
  };
  check(polyhedron, 1e-9);
  check(polyhedron_with_id, 1e-9);
  check(float_mesh, 1e-2);
}

BOOST_AUTO_TEST_CASE(the_vertex_point_map_is_read)
{
  Mesh mesh = mesh_of<Mesh>(generated::sphere(6, 1));
  auto map = mesh.add_property_map<Mesh::Vertex_index, Point>("v:larger").first;
  for (Mesh::Vertex_index v : mesh.vertices())
    map[v] = Point(4 * mesh.point(v).x(), 4 * mesh.point(v).y(), 4 * mesh.point(v).z());
  for (const auto& k : Result<Mesh>(mesh, parameters::vertex_point_map(map)).curvatures)
    BOOST_TEST(std::abs(k.second.maximum - 0.25) < 1e-9);
}

BOOST_AUTO_TEST_CASE(averages_over_a_radius_are_smoother)
{
  generated::Random random(4);
  const Mesh mesh = mesh_of<Mesh>(
      generated::grid(40, 40, [&](double u, double v) { return Vector(u, v, 0.001 * random.symmetric()); }));
  double plain = 0, averaged = 0;
  for (const auto& k : Result<Mesh>(mesh).curvatures) plain += std::abs(k.second.maximum);
  for (const auto& k : Result<Mesh>(mesh, CGAL::parameters::neighbor_radius(0.2)).curvatures)
    averaged += std::abs(k.second.maximum);
  BOOST_TEST(averaged < 0.1 * plain);
}

BOOST_AUTO_TEST_CASE(vertices_without_faces_have_none)
{
  Mesh mesh = mesh_of<Mesh>(generated::sphere(4, 1));
  const Mesh::Vertex_index isolated = mesh.add_vertex(Point(3, 3, 3));
  const Result<Mesh> result(mesh);
  BOOST_TEST(result.curvatures.at(isolated).maximum == 0);
  BOOST_TEST(result.curvatures.at(isolated).minimum == 0);
  BOOST_CHECK(result.curvatures.at(isolated).maximum_direction == CGAL::NULL_VECTOR);
  BOOST_TEST(Result<Mesh>(Mesh()).curvatures.empty());
}

BOOST_AUTO_TEST_CASE(wrong_use_is_named)
{
  Mesh quad;
  quad.add_face(quad.add_vertex(Point(0, 0, 0)), quad.add_vertex(Point(1, 0, 0)), quad.add_vertex(Point(1, 1, 0)),
                quad.add_vertex(Point(0, 1, 0)));
  BOOST_CHECK_EXCEPTION(Result<Mesh>{quad}, std::invalid_argument, names("principal_curvatures: ", "mesh"));
  const Mesh mesh = mesh_of<Mesh>(generated::sphere(4, 1));
  for (double bad : {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    BOOST_CHECK_EXCEPTION(Result<Mesh>(mesh, CGAL::parameters::neighbor_radius(bad)), std::invalid_argument,
                          names("principal_curvatures: ", "neighbor_radius"));
}
