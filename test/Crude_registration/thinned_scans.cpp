// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// Points that were thinned to a few hundred are still registered: the program thinned_scans on a few pairs.

#define BOOST_TEST_MODULE thinned_scans
#include <boost/test/unit_test.hpp>

#include "../../benchmark/Crude_registration/thinned_points.h"
#include "statue_views.h"

#include <cmath>
#include <cstddef>
#include <vector>

namespace {

std::vector<Point> thinned(const View& view, double voxels)
{
  return benchmark_tools::thinned_points(view.image.points(), benchmark_tools::diagonal(view.image.points()) / voxels);
}

Scan prepared(const std::vector<Point>& points, bool with_sensor)
{
  return with_sensor ? Scan(points, p::viewpoint(origin)) : Scan(points);
}

} // namespace

BOOST_AUTO_TEST_CASE(a_voxel_leaves_the_mean_of_its_points)
{
  const std::vector<Point> points = {{-0.5, 0.5, 0.5}, {0.2, 0.2, 0.2}, {0.4, 0.8, 0.6}, {2.5, 0.1, 0.1}};
  const std::vector<Point> means = benchmark_tools::thinned_points(points, 1);
  BOOST_TEST_REQUIRE(means.size() == 3u);
  BOOST_TEST((means[0] == points[0] && means[2] == points[3]));
  BOOST_TEST(CGAL::squared_distance(means[1], Point(0.3, 0.5, 0.4)) < 1e-24);
  BOOST_TEST(std::abs(benchmark_tools::diagonal(points) - std::hypot(3., 0.7, 0.5)) < 1e-12);
}

// At a fiftieth of the size always; at a thirtieth, which leaves some 460 points, for four pairs of five, and what is
// registered is right.
BOOST_AUTO_TEST_CASE(the_right_motion_is_the_first_one)
{
  std::size_t pairs = 0, right_first = 0;
  for (const double voxels : {50., 30.})
    for (const unsigned seed : {1u, 2u, 3u})
      for (const int degrees : {0, 90})
        for (const bool with_sensor : {true, false}) {
          BOOST_TEST_CONTEXT("size / " << voxels << ", statue " << seed << " from " << degrees << " degrees, "
                                       << (with_sensor ? "with" : "without") << " sensor")
          {
            const View &source = view(seed, degrees), &target = view(seed, degrees + 45);
            const std::vector<Point> from = thinned(source, voxels), to = thinned(target, voxels);
            BOOST_TEST(from.size() < source.image.points().size() / 4);
            const Result result = CR::register_scans(prepared(from, with_sensor), prepared(to, with_sensor));
            check_proper(result);
            const Rigid_motion motion = to_rigid_motion(result.transformation()), truth = true_motion(source, target);
            const bool is_right =
                angle_between(motion, truth) < 5 && (motion(source.centre) - truth(source.centre)).norm() <
                                                        0.05 * benchmark_tools::diagonal(source.image.points());
            if (voxels == 50) {
              BOOST_TEST(result.status() != CR::NOT_REGISTERED);
              BOOST_TEST(is_right);
            } else {
              BOOST_TEST((is_right || result.status() != CR::REGISTERED));
              ++pairs;
              right_first += is_right;
            }
          }
        }
  BOOST_TEST_MESSAGE(right_first << " of " << pairs << " right first at a thirtieth");
  BOOST_TEST(5 * right_first >= 4 * pairs);
}
