// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#define BOOST_TEST_MODULE surface_types
#include <boost/test/unit_test.hpp>

#include "generated_surfaces.h"
#include "mesh_of.h"
#include "wrong_use.h"

#include <CGAL/Crude_registration/reduction/surface_types.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace CR = CGAL::Crude_registration;
namespace parameters = CR::parameters;
using Point = CGAL::Simple_cartesian<double>::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using generated::Vector;

namespace {

template <class NP = CGAL::parameters::Default_named_parameters>
CR::Surface_type_counts count(const CR::internal::Flat_mesh& flat, const NP& np = parameters::default_values())
{
  Mesh mesh = mesh_of<Mesh>(flat);
  auto types = mesh.add_property_map<Mesh::Vertex_index, CR::Surface_type>("v:type").first;
  const CR::Surface_type_counts counts = CR::surface_types(mesh, types, np);
  CR::Surface_type_counts of_map;
  for (Mesh::Vertex_index v : mesh.vertices()) of_map.add(types[v]);
  BOOST_TEST(counts.planar == of_map.planar);
  BOOST_TEST(counts.parabolic == of_map.parabolic);
  BOOST_TEST(counts.elliptic == of_map.elliptic);
  BOOST_TEST(counts.hyperbolic == of_map.hyperbolic);
  return counts;
}

} // namespace

BOOST_AUTO_TEST_CASE(types_of_pairs_of_curvatures)
{
  BOOST_TEST(CR::surface_type(0.0, 0.0) == CR::PLANAR);
  BOOST_TEST(CR::surface_type(0.0, 1.0) == CR::PARABOLIC);
  BOOST_TEST(CR::surface_type(-1.0, 0.0) == CR::PARABOLIC);
  BOOST_TEST(CR::surface_type(1.0, 2.0) == CR::ELLIPTIC);
  BOOST_TEST(CR::surface_type(-2.0, -1.0) == CR::ELLIPTIC);
  BOOST_TEST(CR::surface_type(-1e-9, 2.0) == CR::HYPERBOLIC);
  BOOST_TEST(CR::surface_type(-1e-9, 2.0, 1e-8) == CR::PARABOLIC);
  BOOST_TEST(CR::surface_type(-1e-9, 1e-9, 1e-9) == CR::PLANAR);
}

BOOST_AUTO_TEST_CASE(percentage)
{
  CR::Surface_type_counts counts;
  BOOST_TEST(counts.percent_smooth() == 100);
  counts.planar = 1;
  counts.parabolic = 2;
  counts.elliptic = 3;
  counts.hyperbolic = 18;
  BOOST_TEST(counts.percent_smooth() == 25);
}

BOOST_AUTO_TEST_CASE(surfaces_of_one_type)
{
  generated::Random random(1);
  for (double scale : {1e-3, 1.0, 1e4}) {
    const CR::internal::Rigid_motion motion = random.motion(10 * scale);
    const auto all = [&](const CR::internal::Flat_mesh& mesh) { return generated::moved(mesh, motion, scale); };

    const auto plane = generated::grid(20, 20, [](double u, double v) { return Vector(u, v, 0.3 * u - v); });
    BOOST_TEST(count(all(plane)).planar == plane.points.size());

    const auto cylinder = generated::grid(
        20, 20, [](double u, double v) { return Vector(std::cos(u), std::sin(u), v); }, 0);
    BOOST_TEST(count(all(cylinder)).parabolic == cylinder.points.size());

    const auto sphere = generated::sphere(8, 1);
    BOOST_TEST(count(all(sphere)).elliptic == sphere.points.size());

    const auto saddle = generated::grid(20, 20, [](double u, double v) {
      return Vector(u - 0.5, v - 0.5, (u - 0.5) * (u - 0.5) - (v - 0.5) * (v - 0.5));
    });
    BOOST_TEST(count(all(saddle)).hyperbolic == saddle.points.size());
    BOOST_TEST(count(all(saddle)).percent_smooth() == 0);
  }
}

BOOST_AUTO_TEST_CASE(the_outer_half_of_a_torus_is_smooth)
{
  const CR::Surface_type_counts counts = count(generated::torus(120, 41, 3, 1, 0));
  BOOST_TEST(counts.planar + counts.parabolic == 0);
  BOOST_TEST(std::abs(counts.percent_smooth() - 50) < 3);
}

BOOST_AUTO_TEST_CASE(a_tolerance_and_a_radius_find_the_cylinder_in_noise)
{
  generated::Random random(9);
  const auto noisy = generated::grid(60, 60, [&](double u, double v) {
    const double r = 1 + 0.0005 * random.symmetric();
    return Vector(r * std::cos(u), r * std::sin(u), v);
  });
  const std::size_t n = noisy.points.size();
  BOOST_TEST(count(noisy).parabolic < n / 100);
  BOOST_TEST(count(noisy, CGAL::parameters::neighbor_radius(0.15)).parabolic < n / 100);
  BOOST_TEST(count(noisy, parameters::tolerance(0.3)).parabolic < n / 2);
  BOOST_TEST(count(noisy, parameters::tolerance(0.3).neighbor_radius(0.15)).parabolic > n * 9 / 10);
}

BOOST_AUTO_TEST_CASE(wrong_use_is_named)
{
  for (double bad : {-1.0, std::numeric_limits<double>::quiet_NaN()})
    BOOST_CHECK_EXCEPTION(count(generated::sphere(4, 1), parameters::tolerance(bad)), std::invalid_argument,
                          names("surface_types: tolerance"));
}
