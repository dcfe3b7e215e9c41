// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#define BOOST_TEST_MODULE make_statue
#include <boost/test/unit_test.hpp>

#include "mesh_of.h"

#include <CGAL/Crude_registration/internal/base/symmetric_eigen.h>
#include <CGAL/Crude_registration/internal/simulation/Statue.h>
#include <CGAL/Crude_registration/internal/simulation/marching_tetrahedra.h>
#include <CGAL/Crude_registration/simulation/make_statue.h>
#include <CGAL/Crude_registration/internal/mesh/mesh_geometry.h>

#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <Eigen/Core>

#include <cmath>
#include <map>

namespace CR = CGAL::Crude_registration;
using CR::internal::Flat_mesh;
using CR::internal::Matrix;
using CR::internal::Vector;

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

namespace {

Mesh statue(int resolution, unsigned int seed)
{
  Mesh mesh;
  CR::make_statue(mesh, resolution, CR::parameters::random_seed(seed));
  return mesh;
}

} // namespace

BOOST_AUTO_TEST_CASE(is_closed_connected_and_oriented_outwards)
{
  for (unsigned int seed = 0; seed < 12; ++seed) {
    BOOST_TEST_CONTEXT("seed " << seed)
    {
      const Mesh mesh = statue(32, seed);
      BOOST_TEST(CGAL::is_triangle_mesh(mesh));
      BOOST_TEST(CGAL::is_closed(mesh));
      BOOST_TEST(mesh.is_valid());
      const Flat_mesh f = flat_mesh_of(mesh);
      BOOST_TEST(CR::internal::largest_component(f).points.size() == f.points.size());
      double volume = 0;
      for (const auto& t : f.faces) volume += f.points[std::size_t(t[0])].dot(CR::internal::area_vector(f, t)) / 6;
      BOOST_TEST(volume > 0.3);
      BOOST_TEST(volume < 3);
      Vector low = f.points[0], high = low;
      for (const Vector& p : f.points) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
      }
      BOOST_TEST(high.z() - low.z() > 1.4);
      BOOST_TEST(high.z() - low.z() < 2.6);
      BOOST_TEST(low.cwiseAbs().cwiseMax(high.cwiseAbs()).maxCoeff() < 1.5);
    }
  }
}

// A rigid symmetry maps every axis of inertia to itself if the three moments differ, so it is a half turn or a
// reflection; each of these turns at least one axis around, which changes the sign of the third moment along it.
BOOST_AUTO_TEST_CASE(has_no_symmetry)
{
  for (unsigned int seed = 0; seed < 12; ++seed) {
    BOOST_TEST_CONTEXT("seed " << seed)
    {
      const Flat_mesh f = flat_mesh_of(statue(32, seed));
      double area = 0;
      Vector center = Vector::Zero();
      std::vector<std::pair<Vector, double>> pieces;
      for (const auto& t : f.faces) {
        const Vector c = (f.points[std::size_t(t[0])] + f.points[std::size_t(t[1])] + f.points[std::size_t(t[2])]) / 3;
        pieces.emplace_back(c, CR::internal::area_vector(f, t).norm() / 2);
        area += pieces.back().second;
        center += pieces.back().second * c;
      }
      center /= area;
      Matrix second = Matrix::Zero();
      for (const auto& [p, a] : pieces) second += a / area * (p - center) * (p - center).transpose();
      const auto axes = CR::internal::symmetric_eigen(second);
      BOOST_TEST(axes.values[1] > 1.03 * axes.values[0]);
      BOOST_TEST(axes.values[2] > 1.03 * axes.values[1]);
      int skew_axes = 0;
      for (int i = 0; i < 3; ++i) {
        double third = 0;
        for (const auto& [p, a] : pieces) third += a / area * std::pow(axes.vectors.col(i).dot(p - center), 3);
        skew_axes += std::abs(third) > 0.05 * std::pow(axes.values[i], 1.5);
      }
      // A reflection turns one axis around: all three have to be skew to rule out each of them; two skew axes rule out
      // every rotation.
      BOOST_TEST(skew_axes >= 2);
    }
  }
}

BOOST_AUTO_TEST_CASE(is_reproducible_and_differs_between_seeds)
{
  const Mesh a = statue(24, 3), b = statue(24, 3), c = statue(24, 4);
  BOOST_TEST(flat_mesh_of(a).points == flat_mesh_of(b).points);
  BOOST_TEST((flat_mesh_of(a).faces == flat_mesh_of(b).faces));
  BOOST_TEST(flat_mesh_of(a).points != flat_mesh_of(c).points);
}

BOOST_AUTO_TEST_CASE(refines_the_same_body)
{
  const Mesh coarse = statue(48, 5), fine = statue(96, 5);
  BOOST_TEST(static_cast<double>(fine.number_of_faces()) > 3 * static_cast<double>(coarse.number_of_faces()));
  // The vertices of both lie on the body: its function is 1 well inside and changes by about 1 within a bone's radius.
  const CR::internal::Statue body(5);
  for (const auto& [mesh, share] : {std::pair(&coarse, 0.05), std::pair(&fine, 0.01)}) {
    int off = 0;
    for (const Vector& p : flat_mesh_of(*mesh).points) off += std::abs(body(p)) > 0.01;
    BOOST_TEST(off < share * static_cast<double>(mesh->number_of_vertices()));
  }
}

BOOST_AUTO_TEST_CASE(fills_any_face_graph_and_point_map)
{
  const Mesh reference = statue(16, 1);
  CGAL::Polyhedron_3<Kernel> polyhedron;
  CR::make_statue(polyhedron, 16, CGAL::parameters::random_seed(1u));
  BOOST_TEST(polyhedron.size_of_facets() == reference.number_of_faces());
  BOOST_TEST(polyhedron.is_closed());

  Mesh mesh;
  mesh.add_vertex(Kernel::Point_3(0, 0, 0));
  auto points = mesh.add_property_map<Mesh::Vertex_index, Kernel::Point_3>("v:other").first;
  CR::make_statue(mesh, 16, CR::parameters::vertex_point_map(points).random_seed(1));
  BOOST_TEST(mesh.number_of_vertices() == reference.number_of_vertices() + 1);
  using V = Mesh::Vertex_index;
  for (Mesh::Vertex_index v : reference.vertices())
    BOOST_REQUIRE(points[V(Mesh::size_type(v) + 1)] == reference.point(v));
}

BOOST_AUTO_TEST_CASE(rejects_a_resolution_out_of_range)
{
  Mesh mesh;
  for (int resolution : {-1, 0, 7, 1001}) BOOST_CHECK_THROW(CR::make_statue(mesh, resolution), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(a_pedestal_is_a_closed_box)
{
  Mesh box;
  CR::make_pedestal(box, 2, -1.5, 0.5);
  BOOST_TEST(CGAL::is_closed(box));
  BOOST_TEST(CGAL::Polygon_mesh_processing::is_outward_oriented(box));
  BOOST_TEST(std::abs(CGAL::Polygon_mesh_processing::volume(box) - 8) < 1e-12);
  BOOST_TEST((CGAL::Polygon_mesh_processing::bbox(box) == CGAL::Bbox_3(-1, -1, -1.5, 1, 1, 0.5)));
  BOOST_CHECK_THROW(CR::make_pedestal(box, 0, 0, 1), std::invalid_argument);
  BOOST_CHECK_THROW(CR::make_pedestal(box, 1, 1, 1), std::invalid_argument);
}
