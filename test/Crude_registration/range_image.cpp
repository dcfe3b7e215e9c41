// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#define BOOST_TEST_MODULE range_image
#include <boost/test/unit_test.hpp>

#include "range_images.h"

#include <CGAL/Crude_registration/sampling/sampling_distance.h>
#include "wrong_use.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <limits>
#include <string>

using namespace generated;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

double bowl(double x, double y)
{
  return 0.3 * std::sin(x) + 0.2 * y * y;
}

} // namespace

BOOST_AUTO_TEST_CASE(the_sensor_of_no_argument_is_unknown)
{
  const Sensor sensor;
  BOOST_TEST(!sensor.is_known());
  BOOST_TEST(is_refused([&] { sensor.viewpoint(); }, "Sensor::", "viewpoint"));
  BOOST_TEST(is_refused([&] { sensor.viewing_direction(); }, "Sensor::", "viewing_direction"));
  BOOST_TEST(is_refused([&] { sensor.line_of_sight(Point(1, 2, 3)); }, "Sensor::", "unknown"));
  BOOST_TEST(!sensor.transformed(aff(Random(1).motion(1))).is_known());
}

BOOST_AUTO_TEST_CASE(lines_of_sight_have_length_1_whatever_the_unit)
{
  for (double unit : {1e-300, 1e-9, 1., 1e9, 1e300}) {
    const Sensor o = Sensor::orthographic(Kernel::Vector_3(3 * unit, 0, -4 * unit));
    BOOST_TEST(o.is_orthographic());
    BOOST_TEST((vector(o.viewing_direction()) - Vector(0.6, 0, -0.8)).norm() < 1e-15);
    BOOST_TEST((vector(o.line_of_sight(Point(7, 8, 9))) - Vector(0.6, 0, -0.8)).norm() < 1e-15);
    const Sensor p = Sensor::perspective(Point(unit, unit, unit));
    BOOST_TEST(p.is_perspective());
    BOOST_TEST((vector(p.line_of_sight(Point(unit, 4 * unit, 5 * unit))) - Vector(0, 0.6, 0.8)).norm() < 1e-15);
    BOOST_TEST(vector(p.line_of_sight(p.viewpoint())).norm() == 0);
  }
}

BOOST_AUTO_TEST_CASE(sensors_that_make_no_sense_are_refused)
{
  BOOST_TEST(is_refused([] { Sensor::orthographic(CGAL::NULL_VECTOR); }, "Sensor::", "viewing_direction"));
  BOOST_TEST(
      is_refused([] { Sensor::orthographic(Kernel::Vector_3(0, not_a_number, 1)); }, "Sensor::", "viewing_direction"));
  BOOST_TEST(
      is_refused([] { Sensor::orthographic(Kernel::Vector_3(0, infinity, 1)); }, "Sensor::", "viewing_direction"));
  BOOST_TEST(is_refused([] { Sensor::perspective(Point(0, not_a_number, 1)); }, "Sensor::", "viewpoint"));
  BOOST_TEST(is_refused([] { Sensor::perspective(Point(0, -infinity, 1)); }, "Sensor::", "viewpoint"));
}

BOOST_AUTO_TEST_CASE(a_sensor_moves_with_the_points)
{
  Random random(2);
  for (int i = 0; i < 20; ++i) {
    const Rigid_motion motion = random.motion(10);
    const Point p = point(random.vector());
    for (const Sensor& sensor :
         {Sensor::orthographic(Kernel::Vector_3(1, 2, 3)), Sensor::perspective(Point(4, 5, 6))}) {
      const Vector sight = vector(sensor.transformed(aff(motion)).line_of_sight(point(motion(vector(p)))));
      BOOST_TEST((sight - motion.rotation * vector(sensor.line_of_sight(p))).norm() < 1e-13);
    }
  }
}

BOOST_AUTO_TEST_CASE(cells_hold_what_was_set)
{
  Image image(3, 2);
  BOOST_TEST(image.columns() == 3);
  BOOST_TEST(image.rows() == 2);
  BOOST_TEST(image.points().empty());
  for (Image::Index i : image.grid()) BOOST_TEST(i == -1);

  image.set_sample(2, 0, Point(1, 0, 0));
  image.set_sample(0, 1, Point(2, 0, 0));
  image.set_sample(2, 0, Point(3, 0, 0)); // in place of the first
  BOOST_TEST(image.points().size() == 2);
  BOOST_TEST(image.points()[std::size_t(image.index(2, 0))].x() == 3);
  BOOST_TEST(image.points()[std::size_t(image.index(0, 1))].x() == 2);
  BOOST_TEST(image.index(1, 1) == -1);
  BOOST_TEST(image.grid()[2] == image.index(2, 0)); // row by row
  BOOST_TEST(image.grid()[3] == image.index(0, 1));
}

BOOST_AUTO_TEST_CASE(images_that_make_no_sense_are_refused)
{
  const std::vector<Point> points = {Point(0, 0, 0), Point(1, 0, 0)};
  BOOST_CHECK_NO_THROW(Image(2, 2, points, {0, 1, -1, -1}));
  BOOST_CHECK_NO_THROW(Image(0, 7, {}, {}));
  BOOST_TEST(is_refused([&] { Image(2, 2, points, {0, 1, -1}); }, "Range_image", "size of grid"));
  BOOST_TEST(is_refused([&] { Image(2, 2, points, {0, 1, -1, -1, -1}); }, "Range_image", "size of grid"));
  BOOST_TEST(is_refused([&] { Image(0, 2, points, {0}); }, "Range_image", "size of grid"));
  BOOST_TEST(is_refused([&] { Image(2, 2, points, {0, 2, -1, -1}); }, "Range_image", "index 2"));
  BOOST_TEST(is_refused([&] { Image(2, 2, points, {0, -2, -1, -1}); }, "Range_image", "index -2"));
  BOOST_TEST(is_refused([&] { Image(2, 2, points, {0, 1, 0, -1}); }, "Range_image", "index 0 twice"));
  BOOST_TEST(is_refused([&] { Image(1, 1, {Point(0, not_a_number, 0)}, {0}); }, "Range_image", "points"));
  BOOST_TEST(is_refused([&] { Image(1, 1, {Point(0, 0, -infinity)}, {0}); }, "Range_image", "points"));
  BOOST_TEST(is_refused([&] { Image(1u << 20, 1u << 20); }, "Range_image", "2^31"));
  BOOST_TEST(is_refused([&] { Image(std::numeric_limits<std::size_t>::max(), 2); }, "Range_image", "2^31"));
  BOOST_TEST(is_refused([&] { Image(2, 2).set_sample(2, 0, Point(0, 0, 0)); }, "Range_image", "set_sample"));
  BOOST_TEST(is_refused([&] { Image(2, 2).set_sample(0, 2, Point(0, 0, 0)); }, "Range_image", "set_sample"));
  BOOST_TEST(is_refused([&] { Image(2, 2).set_sample(0, 0, Point(not_a_number, 0, 0)); }, "Range_image", "NaN"));
}

BOOST_AUTO_TEST_CASE(an_image_moves_with_its_sensor)
{
  Random random(3);
  Image image = orthographic_image(5, 4, 1, 1, bowl);
  image.set_sensor(Sensor::perspective(Point(1, 2, 30)));
  const Rigid_motion motion = random.motion(5);
  const Image other = moved(image, motion);
  BOOST_TEST((other.grid() == image.grid()));
  for (std::size_t i = 0; i < image.points().size(); ++i)
    BOOST_TEST((vector(other.points()[i]) - motion(vector(image.points()[i]))).norm() < 1e-13);
  BOOST_TEST((vector(other.sensor().viewpoint()) - motion(Vector(1, 2, 30))).norm() < 1e-13);
}

BOOST_AUTO_TEST_CASE(the_sampling_distance_is_the_larger_spacing_in_the_image_plane)
{
  // the depth, steep as it may be, has no part in it, nor have jumps and holes
  const auto height = [](double x, double y) {
    if (std::abs(std::sin(7 * x + 3 * y)) < 0.1) return no_depth;
    return 5 * bowl(x, y) + (x > 3 ? 100 : 0);
  };
  Image image = orthographic_image(60, 50, 0.1, 0.07, height);
  image.set_sensor(Sensor::orthographic(Kernel::Vector_3(0, 0, -1)));
  BOOST_TEST(CR::sampling_distance(image) == 0.1, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(CR::sampling_distance(transposed(image)) == 0.1, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(CR::sampling_distance(mirrored(image)) == 0.1, boost::test_tools::tolerance(1e-12));

  Random random(4);
  for (int i = 0; i < 5; ++i)
    BOOST_TEST(CR::sampling_distance(moved(image, random.motion(10))) == 0.1, boost::test_tools::tolerance(1e-12));
  for (double factor : {1e-3, 0.3048, 1e3}) {
    Image other = scaled(image, factor);
    other.set_sensor(image.sensor());
    BOOST_TEST(CR::sampling_distance(other) == 0.1 * factor, boost::test_tools::tolerance(1e-12));
  }
}

BOOST_AUTO_TEST_CASE(the_sampling_distance_of_a_camera_is_that_at_the_median_range)
{
  // on a sphere around the viewpoint the range is the same everywhere; near the axis samples are range / focal apart
  const double focal = 1000, range = 3;
  Image image =
      perspective_image(40, 30, focal, [&](double a, double b) { return range / std::sqrt(1 + a * a + b * b); });
  image.set_sensor(Sensor::perspective(Point(0, 0, 0)));
  BOOST_TEST(CR::sampling_distance(image) == range / focal, boost::test_tools::tolerance(1e-3));

  // an inclined wall has the spacing of its median range, however long its edges are
  Image wall = perspective_image(40, 31, focal, [&](double a, double) { return range / (1 - 40 * a); });
  wall.set_sensor(Sensor::perspective(Point(0, 0, 0)));
  BOOST_TEST(CR::sampling_distance(wall) == range / focal, boost::test_tools::tolerance(0.05));
  Random random(5);
  BOOST_TEST(CR::sampling_distance(moved(wall, random.motion(3))) == CR::sampling_distance(wall),
             boost::test_tools::tolerance(1e-10));
}

BOOST_AUTO_TEST_CASE(without_a_sensor_distances_are_measured_in_space)
{
  const Image plane = orthographic_image(10, 10, 0.3, 0.1, [](double x, double) { return 4. / 3 * x; });
  BOOST_TEST(CR::sampling_distance(plane) == 0.5, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(images_without_adjacent_samples_have_no_sampling_distance)
{
  BOOST_TEST(CR::sampling_distance(Image()) == 0);
  BOOST_TEST(CR::sampling_distance(Image(0, 5)) == 0);
  BOOST_TEST(CR::sampling_distance(Image(5, 0)) == 0);
  BOOST_TEST(CR::sampling_distance(Image(5, 5)) == 0);
  Image image(5, 5);
  image.set_sample(0, 0, Point(1, 1, 1));
  image.set_sample(2, 0, Point(2, 1, 1));
  BOOST_TEST(CR::sampling_distance(image) == 0);
  image.set_sample(1, 0, Point(1, 1, 1)); // in the same place as its neighbour
  image.set_sensor(Sensor::perspective(Point(1, 1, 1)));
  BOOST_TEST(CR::sampling_distance(image) == 0);
}

BOOST_AUTO_TEST_CASE(a_kernel_of_exact_numbers_will_do)
{
  using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
  CR::Range_image<Exact> image(2, 2);
  for (std::size_t i = 0; i < 4; ++i) image.set_sample(i % 2, i / 2, Exact::Point_3(int(i % 2), int(2 * (i / 2)), 7));
  image.set_sensor(CR::Sensor<Exact>::orthographic(Exact::Vector_3(0, 0, -2)));
  transform(image, CGAL::Aff_transformation_3<Exact>(CGAL::TRANSLATION, Exact::Vector_3(1, 1, 1)));
  BOOST_TEST(CR::sampling_distance(image) == 2);
  BOOST_TEST(CGAL::to_double(image.sensor().viewing_direction().z()) == -1);
}
