// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#define BOOST_TEST_MODULE estimate_sensor
#include <boost/test/unit_test.hpp>

#include "range_images.h"

#include <CGAL/Crude_registration/IO/read_range_image.h>
#include <CGAL/Crude_registration/sampling/estimate_sensor.h>
#include <CGAL/Crude_registration/simulation/make_statue.h>
#include <CGAL/Crude_registration/simulation/simulate_range_image.h>

#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>
#include <vector>

using namespace generated;

namespace {

// the angle between a sensor's viewing direction and the true one; 180 where it is not orthographic
double error(const Sensor& sensor, const Vector& direction)
{
  return sensor.is_orthographic() ? degrees(vector(sensor.viewing_direction()), direction) : 180;
}

// the distance of a sensor's viewpoint from the true one; infinite where it is not perspective
double distance(const Sensor& sensor, const Vector& viewpoint)
{
  return sensor.is_perspective() ? (vector(sensor.viewpoint()) - viewpoint).norm() : no_depth;
}

// a ball that ends in the image, in front of nothing, seen from above
double ball(double x, double y)
{
  const double square = 1 - (x - 1) * (x - 1) - (y - 1.1) * (y - 1.1);
  return square > 0 ? std::sqrt(square) + 0.05 * std::sin(9 * x + 2) * std::cos(5 * y) : no_depth;
}

Image ball_image()
{
  return orthographic_image(50, 40, 2. / 50, 2.2 / 40, ball);
}

// a surface that fills the image
double waves(double x, double y)
{
  return 0.5 * std::sin(2 * x + 1) + 0.4 * std::cos(3 * y) + 0.2 * std::sin(4 * x * y);
}

Image room_image()
{
  return perspective_image(64, 48, 55, [](double a, double b) { return 3 + waves(2 * a, 2 * b); });
}

// A laser stripe in the planes x = c dx, seen by a camera at the height `distance` above them: rows are lines through
// (0, distance) in the plane of y and z.
Image stripe_image(double distance, double sign)
{
  return image_of(60, 50, [&](double column, double row) {
    const double x = 0.04 * column - 1.2;
    const double slope = (row - 20) * 0.04 / distance;
    const double z = sign * waves(x, 2 * slope * distance);
    return Vector(x, slope * (distance - z), z);
  });
}

// the same image with its grid in all eight orders
std::vector<Image> all_orders(const Image& image)
{
  const auto upside_down = [](const Image& i) { return transposed(mirrored(transposed(i))); };
  std::vector<Image> result;
  for (const Image& i : {image, transposed(image)})
    for (const Image& j : {i, mirrored(i)}) {
      result.push_back(j);
      result.push_back(upside_down(j));
    }
  return result;
}

} // namespace

BOOST_AUTO_TEST_CASE(parallel_lines_of_sight)
{
  for (const Image& image : all_orders(ball_image()))
    BOOST_TEST(error(estimate_sensor(image), Vector(0, 0, -1)) < 1e-6);
}

BOOST_AUTO_TEST_CASE(a_camera)
{
  for (const Image& image : all_orders(room_image()))
    BOOST_TEST(distance(estimate_sensor(image), Vector::Zero()) < 1e-9);
}

BOOST_AUTO_TEST_CASE(a_moving_stripe_is_seen_from_where_its_rows_meet)
{
  // neither the shape of the surface nor the order of the grid says from where it is seen
  for (double sign : {-1., 1.})
    for (const Image& image : all_orders(stripe_image(30, sign)))
      BOOST_TEST(error(estimate_sensor(image), Vector(0, 0, -1)) < 1);
}

BOOST_AUTO_TEST_CASE(a_surface_that_fills_the_image_is_seen_from_the_side_of_columns_x_rows)
{
  const Image image = orthographic_image(40, 40, 0.05, 0.05, waves);
  BOOST_TEST(error(estimate_sensor(image), Vector(0, 0, -1)) < 1e-6);
  BOOST_TEST(error(estimate_sensor(mirrored(image)), Vector(0, 0, 1)) < 1e-6);
}

BOOST_AUTO_TEST_CASE(the_sensor_moves_and_scales_with_the_image)
{
  Random random(1);
  for (int i = 0; i < 10; ++i) {
    const Rigid_motion motion = random.motion(100);
    BOOST_TEST(error(estimate_sensor(moved(ball_image(), motion)), motion.rotation * Vector(0, 0, -1)) < 1e-5);
    BOOST_TEST(distance(estimate_sensor(moved(room_image(), motion)), motion.translation) < 1e-7);
    BOOST_TEST(error(estimate_sensor(moved(stripe_image(30, 1), motion)), motion.rotation * Vector(0, 0, -1)) < 1);
  }
  for (double unit : {1e-6, 1e-3, 0.3048, 1e3, 1e6}) {
    BOOST_TEST(error(estimate_sensor(scaled(ball_image(), unit)), Vector(0, 0, -1)) < 1e-6);
    BOOST_TEST(distance(estimate_sensor(scaled(room_image(), unit)), Vector::Zero()) < 1e-9 * unit);
  }
  const Vector far(3e4, -1e4, 2e4);
  BOOST_TEST(error(estimate_sensor(scaled(ball_image(), 1, far)), Vector(0, 0, -1)) < 1e-3);
  BOOST_TEST(distance(estimate_sensor(scaled(room_image(), 1, far)), far) < 1e-5);
}

BOOST_AUTO_TEST_CASE(noise_along_the_lines_of_sight_does_no_harm)
{
  Random random(2);
  const Image noisy_ball = orthographic_image(
      50, 40, 2. / 50, 2.2 / 40, [&](double x, double y) { return ball(x, y) + 0.03 * random.symmetric(); });
  BOOST_TEST(error(estimate_sensor(noisy_ball), Vector(0, 0, -1)) < 1e-6);
  const Image noisy_room = perspective_image(
      64, 48, 55, [&](double a, double b) { return (3 + waves(2 * a, 2 * b)) * (1 + 0.05 * random.symmetric()); });
  BOOST_TEST(distance(estimate_sensor(noisy_room), Vector::Zero()) < 1e-9);
}

BOOST_AUTO_TEST_CASE(coordinates_may_be_rounded)
{
  const auto rounded = [](const Image& image, double step) {
    std::vector<Point> points;
    for (const Point& p : image.points()) points.push_back(point((vector(p) / step).array().round().matrix() * step));
    return Image(image.columns(), image.rows(), points, image.grid());
  };
  BOOST_TEST(error(estimate_sensor(rounded(ball_image(), 0.002)), Vector(0, 0, -1)) < 0.2);
  BOOST_TEST(distance(estimate_sensor(rounded(room_image(), 0.002)), Vector::Zero()) < 0.02);
}

BOOST_AUTO_TEST_CASE(noise_in_all_directions_leaves_the_kind_of_sensor_and_its_side)
{
  Random random(3);
  const auto noisy = [&](const Image& image, double size) {
    std::vector<Point> points;
    for (const Point& p : image.points()) points.push_back(point(vector(p) + size * random.vector()));
    return Image(image.columns(), image.rows(), points, image.grid());
  };
  // half a cell
  for (const Image& image : all_orders(noisy(ball_image(), 0.02)))
    BOOST_TEST(error(estimate_sensor(image), Vector(0, 0, -1)) < 5);
  BOOST_TEST(distance(estimate_sensor(noisy(room_image(), 0.02)), Vector::Zero()) < 0.3);
}

BOOST_AUTO_TEST_CASE(what_does_not_say_from_where_it_was_seen_leaves_the_sensor_unknown)
{
  const auto is_unknown = [](const Image& image) {
    Random random(4);
    const Rigid_motion motion = random.motion(1);
    return !estimate_sensor(image).is_known() && !estimate_sensor(moved(image, motion)).is_known();
  };
  BOOST_TEST(is_unknown(Image()));
  BOOST_TEST(is_unknown(Image(100, 100)));
  BOOST_TEST(is_unknown(orthographic_image(4, 4, 1, 1, waves))); // too few samples
  BOOST_TEST(is_unknown(orthographic_image(50, 1, 0.1, 1, waves)));
  BOOST_TEST(is_unknown(orthographic_image(1, 50, 0.1, 0.1, waves)));
  BOOST_TEST(is_unknown(image_of(10, 10, [](double, double) { return Vector(1, 2, 3); })));
  BOOST_TEST(is_unknown(image_of(10, 10, [](double c, double) { return Vector(c, c, c); })));
  // planes
  BOOST_TEST(is_unknown(orthographic_image(50, 40, 0.1, 0.1, [](double, double) { return 1.; })));
  BOOST_TEST(is_unknown(orthographic_image(50, 40, 0.1, 0.1, [](double x, double y) { return x + 0.3 * y; })));
  BOOST_TEST(is_unknown(perspective_image(50, 40, 50, [](double, double) { return 2.; })));
  BOOST_TEST(is_unknown(perspective_image(50, 40, 50, [](double a, double b) { return 2 / (1 - 0.5 * a - 0.2 * b); })));
  // a full turn: columns are angles
  BOOST_TEST(is_unknown(image_of(120, 30, [](double c, double r) {
    const double radius = 1 + 0.1 * std::sin(c / 5) * std::cos(r / 4);
    return Vector(radius * std::cos(c * pi / 60), radius * std::sin(c * pi / 60), 0.05 * r);
  })));
  // no relation between grid and points
  Random random(5);
  BOOST_TEST(is_unknown(image_of(50, 40, [&](double, double) { return random.vector(); })));
}

BOOST_AUTO_TEST_CASE(simulated_scans)
{
  using Mesh = CGAL::Surface_mesh<Point>;
  Mesh statue;
  CR::make_statue(statue, 48, CR::parameters::random_seed(7));
  for (bool is_perspective : {false, true}) {
    for (int view = 0; view < 4; ++view) {
      CR::Range_camera<Kernel> camera;
      const Vector from(4 * std::cos(1.6 * view), 4 * std::sin(1.6 * view), 1.2 * (view - 1));
      camera.viewpoint = point(from);
      camera.target = Point(0, 0, 0);
      camera.up = Kernel::Vector_3(0, 0, 1);
      camera.columns = 160;
      camera.rows = 150;
      camera.spacing = 0.016;
      camera.is_perspective = is_perspective;
      camera.noise = 0.3;
      const Image image = CR::simulate_range_image(statue, camera).image;
      const Sensor sensor = estimate_sensor(image);
      if (is_perspective) BOOST_TEST(distance(sensor, vector(image.sensor().viewpoint())) < 0.02 * 4);
      else BOOST_TEST(error(sensor, vector(image.sensor().viewing_direction())) < 0.1);
    }
  }
}

BOOST_AUTO_TEST_CASE(real_scans_of_a_moving_stripe, *boost::unit_test::label("real_scans") *
                                                        boost::unit_test::precondition(generated::real_scans_are_there))
{
  // Both scanners look along -z, the dragon's turned by about 28 degrees about y; their lines of sight rise by 3
  // degrees.
  const auto check = [](const std::string& set, const Vector& direction, double tolerance) {
    Random random(6);
    for (const auto& file : files(real_scans(set), ".ply")) {
      Image image;
      CR::read_range_image(file.string(), image);
      BOOST_TEST_CONTEXT(file)
      {
        BOOST_TEST(error(image.sensor(), direction) < tolerance);
        const Rigid_motion motion = random.motion(1);
        const Sensor there = estimate_sensor(moved(image, motion));
        BOOST_TEST(error(there, motion.rotation * vector(image.sensor().viewing_direction())) < 1e-3);
        BOOST_TEST(error(estimate_sensor(mirrored(image)), direction) < tolerance);
      }
    }
  };
  check("bunny", Vector(0, -0.06, -1), 1);
  check("dragon_stand", Vector(-0.53, -0.05, -1), 2);
}

BOOST_AUTO_TEST_CASE(real_frames_of_a_depth_camera, *boost::unit_test::label("real_scans") *
                                                        boost::unit_test::precondition(generated::real_scans_are_there))
{
  for (const auto& file : files(real_scans("slambook2_rgbd"), ".ply")) {
    Image image;
    CR::read_range_image(file.string(), image);
    BOOST_TEST_CONTEXT(file)
    {
      BOOST_TEST(distance(image.sensor(), Vector::Zero()) < 1e-5);
    }
  }
}
