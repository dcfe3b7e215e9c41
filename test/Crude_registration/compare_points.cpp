// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// What points of one scan meet in another: distances and free space that are known beforehand.

#define BOOST_TEST_MODULE compare_points
#include <boost/test/unit_test.hpp>

#include "statue_views.h"

#include <CGAL/Crude_registration/compare_points.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace {

using Transformation = CGAL::Aff_transformation_3<Kernel>;
namespace parameters = CR::parameters;

constexpr int columns = 60;

// Samples of a square of a plane, one apart.
std::vector<Point> square()
{
  std::vector<Point> points;
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < columns; ++j) points.emplace_back(i, j, 0);
  return points;
}

std::vector<CR::Compared_point<Kernel>> compared(const std::vector<Point>& points, const CR::Scan<Kernel>& scan)
{
  return CR::compare_points(points, scan, scan, Transformation(CGAL::IDENTITY));
}

} // namespace

BOOST_AUTO_TEST_CASE(distances_from_a_plane_are_its_heights)
{
  const CR::Scan<Kernel> scan(square(), parameters::viewpoint(Point(30, 30, 200)));
  const double spacing = scan.spacing();
  for (const double height : {-1.5, -0.25, 0., 0.25, 1.5}) {
    std::vector<Point> points;
    for (int i = 10; i < columns - 10; ++i) points.emplace_back(i, 0.4 * i + 10, height * spacing);
    for (const auto& met : compared(points, scan)) {
      BOOST_TEST(std::abs(met.distance - height * spacing) < 1e-4);
      BOOST_TEST(met.normal.z() > 0.9999);
      BOOST_TEST(!met.is_in_free_space);
    }
  }
}

BOOST_AUTO_TEST_CASE(no_surface_is_near_beside_and_far_above_a_plane)
{
  const CR::Scan<Kernel> scan(square(), parameters::viewpoint(Point(30, 30, 200)));
  const std::vector<Point> points = {Point(-20, 30, 0), Point(30, 90, 0), Point(30, 30, 25), Point(30, 30, -25)};
  for (const auto& met : compared(points, scan)) {
    BOOST_TEST(std::isinf(met.distance));
    BOOST_TEST(met.normal == Kernel::Vector_3(CGAL::NULL_VECTOR));
  }
}

// Before the plane, as its sensor saw it, there is nothing; behind it and beside it nothing is known.
BOOST_AUTO_TEST_CASE(free_space_is_between_the_sensor_and_what_it_saw)
{
  const std::vector<Point> points = {Point(30, 30, 25), Point(20, 40, 6), Point(30, 30, 2), Point(30, 30, -25),
                                     Point(-40, 30, 25)};
  const CR::Scan<Kernel> above(square(), parameters::viewpoint(Point(30, 30, 200))),
      below(square(), parameters::viewpoint(Point(30, 30, -200)));
  const auto from_above = compared(points, above), from_below = compared(points, below);
  const std::vector<bool> wanted_above = {true, true, false, false, false},
                          wanted_below = {false, false, false, true, false};
  for (std::size_t i = 0; i < points.size(); ++i) {
    BOOST_TEST(from_above[i].is_in_free_space == wanted_above[i]);
    BOOST_TEST(from_below[i].is_in_free_space == wanted_below[i]);
  }
  // The sensor tells the side of the surface, and with it the sign.
  BOOST_TEST(from_above[2].distance > 0);
  BOOST_TEST(from_below[2].distance < 0);
}

// Two views of one body under the true motion: where they overlap they are no further apart than noise and sampling
// make them, and next to nothing is in free space; under a motion that is off by some sampling distances both tell.
BOOST_AUTO_TEST_CASE(views_of_a_body_lie_on_each_other_under_the_true_motion_only)
{
  const View &a = view(0, 0), &b = view(0, 30);
  const Rigid_motion truth = true_motion(a, b);
  const double spacing = (std::max)(a.scan.spacing(), b.scan.spacing());
  const auto share = [&](const Rigid_motion& motion, bool of_free_space) {
    const auto met =
        CR::compare_points(a.image.points(), a.scan, b.scan, CR::internal::to_aff_transformation<Kernel>(motion));
    BOOST_TEST(met.size() == a.image.points().size());
    std::size_t n = 0;
    for (const auto& m : met) n += of_free_space ? m.is_in_free_space : std::abs(m.distance) < 0.5 * spacing;
    return double(n) / double(met.size());
  };
  BOOST_TEST(share(truth, false) > 0.6);
  BOOST_TEST(share(truth, true) < 0.001);
  Rigid_motion off = truth;
  off.translation += 8 * spacing * Vector(1, 2, -2).normalized();
  BOOST_TEST(share(off, false) < 0.4);
  BOOST_TEST(share(off, true) > 0.005);
}

// Whether the points are moved before or by the motion makes no difference.
BOOST_AUTO_TEST_CASE(the_motion_moves_the_points)
{
  const View &a = view(0, 0), &b = view(0, 30);
  const Transformation motion = CR::internal::to_aff_transformation<Kernel>(true_motion(a, b));
  std::vector<Point> moved;
  for (const Point& p : a.image.points()) moved.push_back(motion.transform(p));
  const auto by_motion = CR::compare_points(a.image.points(), a.scan, b.scan, motion);
  const auto before = CR::compare_points(moved, a.scan, b.scan, Transformation(CGAL::IDENTITY));
  std::size_t differing = 0; // by rounding, at the edges of what is near
  for (std::size_t i = 0; i < moved.size(); ++i)
    differing += std::isfinite(before[i].distance) != std::isfinite(by_motion[i].distance) ||
                 (std::isfinite(before[i].distance) &&
                  !(std::abs(before[i].distance - by_motion[i].distance) < 1e-5 * b.scan.spacing()));
  BOOST_TEST(differing <= moved.size() / 100);
}
