// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#define BOOST_TEST_MODULE approximation_error
#include <boost/test/unit_test.hpp>

#include "generated_surfaces.h"
#include "mesh_of.h"
#include "wrong_use.h"

#include <CGAL/Crude_registration/reduction/approximation_error.h>
#include <CGAL/Crude_registration/reduction/scan_extent.h>
#include <CGAL/Crude_registration/reduction/surface_types.h>
#include <CGAL/Crude_registration/sampling/triangulate_range_image.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace CR = CGAL::Crude_registration;
namespace parameters = CR::parameters;
using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Vector_3 = Kernel::Vector_3;
using Mesh = CGAL::Surface_mesh<Point>;
using generated::Vector;

namespace {

Vector_3 to_vector_3(const Vector& v)
{
  return Vector_3(v.x(), v.y(), v.z());
}

// 4 x 2, bulging by 1 towards the viewer at z = +infinity.
CR::internal::Flat_mesh bulge()
{
  return generated::grid(40, 20, [](double u, double v) {
    return Vector(4 * u, 2 * v, std::sin(generated::pi * u) * std::sin(generated::pi * v));
  });
}

// The bulge as a range image: columns along x, rows along y, 0.1 apart.
CR::Range_image<Kernel> bulge_image(const CR::internal::Rigid_motion& motion)
{
  CR::Range_image<Kernel> image(41, 21);
  for (std::size_t row = 0; row < 21; ++row)
    for (std::size_t column = 0; column < 41; ++column) {
      const double u = double(column) / 40, v = double(row) / 20;
      const Vector p = motion(Vector(4 * u, 2 * v, std::sin(generated::pi * u) * std::sin(generated::pi * v)));
      image.set_sample(column, row, Point(p.x(), p.y(), p.z()));
    }
  return image;
}

} // namespace

BOOST_AUTO_TEST_CASE(extent_of_a_bulge_in_any_pose)
{
  generated::Random random(1);
  for (int i = 0; i < 5; ++i) {
    const auto motion = i == 0 ? CR::internal::Rigid_motion() : random.motion(50);
    const Mesh mesh = mesh_of<Mesh>(generated::moved(bulge(), motion));
    for (const CR::Scan_extent& e :
         {CR::scan_extent(mesh),
          CR::scan_extent(mesh, parameters::viewing_direction(to_vector_3(motion.rotation * Vector(0, 0, -2))))}) {
      BOOST_TEST(e.horizontal == 4, boost::test_tools::tolerance(1e-3));
      BOOST_TEST(e.vertical == 2, boost::test_tools::tolerance(1e-3));
      BOOST_TEST(e.depth == 1, boost::test_tools::tolerance(1e-2));
      BOOST_TEST(e.image_size() == e.horizontal);
      BOOST_TEST(e.mean() == (e.horizontal + e.vertical + e.depth) / 3, boost::test_tools::tolerance(1e-12));
    }
    // Far above the centre, the viewpoint is as good as a direction.
    const Vector p = motion(Vector(2, 1, 1e6));
    BOOST_TEST(CR::scan_extent(mesh, parameters::viewpoint(Point(p.x(), p.y(), p.z()))).horizontal == 4,
               boost::test_tools::tolerance(1e-3));
  }
}

BOOST_AUTO_TEST_CASE(extent_of_a_range_image_in_any_pose)
{
  generated::Random random(1);
  for (int i = 0; i < 5; ++i) {
    const auto motion = i == 0 ? CR::internal::Rigid_motion() : random.motion(50);
    CR::Range_image<Kernel> image = bulge_image(motion);
    CR::Scan_extent e = CR::scan_extent(image); // the sensor estimated
    BOOST_TEST(e.horizontal == 4, boost::test_tools::tolerance(1e-6));
    BOOST_TEST(e.vertical == 2, boost::test_tools::tolerance(1e-6));
    BOOST_TEST(e.depth == 1, boost::test_tools::tolerance(1e-2));
    Mesh mesh;
    CR::triangulate_range_image(image, mesh);
    auto types = mesh.add_property_map<Mesh::Vertex_index, CR::Surface_type>("v:type").first;
    BOOST_TEST(CR::approximation_error(image) == 0.15 * 0.1 * 4 / CR::surface_types(mesh, types).percent_smooth(),
               boost::test_tools::tolerance(1e-6));
    // A sensor that is known counts, not the grid alone: looking along (1, 0, -1) the bulge is shorter.
    image.set_sensor(CR::Sensor<Kernel>::orthographic(to_vector_3(motion.rotation * Vector(1, 0, -1))));
    BOOST_TEST(CR::scan_extent(image).vertical == 2, boost::test_tools::tolerance(1e-6));
    BOOST_TEST(CR::scan_extent(image).horizontal < 3.5);
    // From far above it is as from straight above.
    const Vector p = motion(Vector(2, 1, 1e6));
    image.set_sensor(CR::Sensor<Kernel>::perspective(Point(p.x(), p.y(), p.z())));
    BOOST_TEST(CR::scan_extent(image).horizontal == 4, boost::test_tools::tolerance(1e-3));
  }
}

BOOST_AUTO_TEST_CASE(range_images_that_say_little)
{
  // No sample, one, a line, a plane (whose sensor cannot be estimated: the mean normal is the depth axis).
  CR::Range_image<Kernel> image(10, 10);
  BOOST_TEST(CR::scan_extent(image).mean() == 0);
  BOOST_TEST(CR::approximation_error(image) == 0);
  image.set_sample(3, 3, Point(1, 2, 3));
  BOOST_TEST(CR::scan_extent(image).mean() == 0);
  for (std::size_t i = 0; i < 10; ++i) image.set_sample(i, 0, Point(double(i), 0, 0));
  BOOST_TEST(CR::scan_extent(image).mean() == 0);
  for (std::size_t i = 0; i < 100; ++i) image.set_sample(i % 10, i / 10, Point(double(i % 10), 0, double(i / 10)));
  const CR::Scan_extent e = CR::scan_extent(image);
  BOOST_TEST(e.horizontal == 9, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(e.vertical == 9, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(e.depth < 1e-9);
  BOOST_TEST(CR::approximation_error(image) == 0.15 * 9 / 100, boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(seen_from_the_side)
{
  const CR::Scan_extent e = CR::scan_extent(mesh_of<Mesh>(bulge()), parameters::viewing_direction(Vector_3(1, 0, 0)));
  BOOST_TEST(e.depth == 4, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(e.image_size() == 2, boost::test_tools::tolerance(1e-2));
}

BOOST_AUTO_TEST_CASE(vertices_without_faces_do_not_count)
{
  Mesh mesh = mesh_of<Mesh>(bulge());
  mesh.add_vertex(Point(100, 100, 100));
  BOOST_TEST(CR::scan_extent(mesh).image_size() == 4, boost::test_tools::tolerance(1e-3));
}

BOOST_AUTO_TEST_CASE(the_formula)
{
  const auto flat = bulge();
  const Mesh mesh = mesh_of<Mesh>(flat);
  Mesh copy = mesh;
  auto types = copy.add_property_map<Mesh::Vertex_index, CR::Surface_type>("v:type").first;
  const double smooth = CR::surface_types(copy, types).percent_smooth();
  BOOST_TEST(CR::approximation_error(mesh, parameters::sampling_distance(0.1)) ==
                 0.15 * 0.1 * CR::scan_extent(mesh).image_size() / smooth,
             boost::test_tools::tolerance(1e-12));
  BOOST_TEST(CR::approximation_error(mesh) ==
                 0.15 * CR::internal::median_edge_length(flat) * CR::scan_extent(mesh).image_size() / smooth,
             boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(it_moves_with_the_scan_and_is_a_length_squared)
{
  generated::Random random(2);
  const auto flat = generated::bumps(30, 1, 0.001);
  const double expected = CR::approximation_error(mesh_of<Mesh>(flat));
  BOOST_TEST(expected > 0);
  for (double scale : {1e-3, 0.3048, 1.0, 1e3})
    BOOST_TEST(CR::approximation_error(mesh_of<Mesh>(generated::moved(flat, random.motion(10 * scale), scale))) ==
                   scale * scale * expected,
               boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(a_saddle_has_a_finite_error)
{
  const auto saddle = generated::grid(
      20, 20, [](double u, double v) { return Vector(u, v, (u - 0.5) * (u - 0.5) - (v - 0.5) * (v - 0.5)); });
  const double error = CR::approximation_error(mesh_of<Mesh>(saddle), parameters::sampling_distance(0.05));
  BOOST_TEST(error == 0.15 * 0.05 * CR::scan_extent(mesh_of<Mesh>(saddle)).image_size(),
             boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(empty_and_wrong)
{
  BOOST_TEST(CR::scan_extent(Mesh()).mean() == 0);
  BOOST_TEST(CR::approximation_error(Mesh()) == 0);
  const Mesh mesh = mesh_of<Mesh>(bulge());
  for (double bad : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    BOOST_CHECK_EXCEPTION(CR::approximation_error(mesh, parameters::sampling_distance(bad)), std::invalid_argument,
                          names("approximation_error: sampling_distance"));
  BOOST_CHECK_EXCEPTION(CR::scan_extent(mesh, parameters::viewing_direction(Vector_3(0, 0, 0))), std::invalid_argument,
                        names("scan_extent: viewing_direction"));
  BOOST_CHECK_EXCEPTION(
      CR::scan_extent(mesh, parameters::viewpoint(Point(0, std::numeric_limits<double>::quiet_NaN(), 0))),
      std::invalid_argument, names("scan_extent: viewpoint"));
}
