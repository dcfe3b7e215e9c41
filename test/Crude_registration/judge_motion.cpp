// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// A motion that somebody found: right, refinable or wrong, against the truth.

#define BOOST_TEST_MODULE judge_motion
#include <boost/test/unit_test.hpp>

#include "statue_views.h"

#include <CGAL/Crude_registration/judge_motion.h>
#include <CGAL/Crude_registration/motion/rigid_motion.h>

#include <Eigen/Geometry>

#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace {

using Transformation = CGAL::Aff_transformation_3<Kernel>;

Transformation aff(const Rigid_motion& m)
{
  return CR::internal::to_aff_transformation<Kernel>(m);
}

// A motion, followed by a turn of so many degrees about where it takes the middle of the source, and a shift.
Rigid_motion off(const Rigid_motion& motion, const Vector& source_centre, double degrees, const Vector& shift)
{
  const Vector centre = motion(source_centre);
  Rigid_motion by;
  by.rotation = Eigen::AngleAxisd(degrees * pi / 180, Vector(2, 1, -2).normalized()).toRotationMatrix();
  by.translation = centre - by.rotation * centre + shift;
  return by * motion;
}

} // namespace

BOOST_AUTO_TEST_CASE(true_motions_are_right)
{
  for (const int degrees : {30, 45, 60}) {
    const View &a = view(0, 0), &b = view(0, degrees);
    const auto judgement = CR::judge_motion(a.scan, b.scan, aff(true_motion(a, b)));
    BOOST_TEST(judgement.status() == CR::RIGHT_MOTION);
    BOOST_TEST(judgement.confidence() >= 0.9);
    BOOST_TEST(judgement.displacement() < 0.5);
    check_right(judgement.refined(), a, b);
    BOOST_TEST(judgement.refined().correspondence().empty()); // it was given, not found
  }
}

// Far more than the pose is known by, and not so far that refinement does not find back.
BOOST_AUTO_TEST_CASE(motions_that_are_off_are_refinable_and_by_how_much_is_said)
{
  const View &a = view(0, 0), &b = view(0, 45);
  const Rigid_motion truth = true_motion(a, b);
  const double spacing = (std::max)(a.scan.spacing(), b.scan.spacing());
  for (const double distance : {2., 4.}) {
    for (const Vector& direction : {Vector(1, 0, 0), Vector(0, 0, 1)}) {
      const auto judgement =
          CR::judge_motion(a.scan, b.scan, aff(off(truth, a.centre, 0, distance * spacing * direction)));
      BOOST_TEST(judgement.status() == CR::REFINABLE_MOTION);
      BOOST_TEST(std::abs(judgement.displacement() - distance) < 0.5);
      check_right(judgement.refined(), a, b);
    }
  }
  // A turn moves each place by its own distance from the axis.
  const Rigid_motion turned = off(truth, a.centre, 2, Vector::Zero());
  double squares = 0;
  for (const Point& p : a.image.points()) squares += (turned(to_vector(p)) - truth(to_vector(p))).squaredNorm();
  const double wanted = std::sqrt(squares / double(a.image.points().size())) / spacing;
  const auto judgement = CR::judge_motion(a.scan, b.scan, aff(turned));
  BOOST_TEST(judgement.status() == CR::REFINABLE_MOTION);
  BOOST_TEST(judgement.displacement() > 0.5 * wanted);
  BOOST_TEST(judgement.displacement() < 2 * wanted);
}

BOOST_AUTO_TEST_CASE(wrong_motions_are_wrong)
{
  const View &a = view(0, 0), &b = view(0, 45), &far = view(0, 180), &other = view(1, 0);
  const Rigid_motion truth = true_motion(a, b);
  for (const double degrees : {40., 90., 180.})
    BOOST_TEST(CR::judge_motion(a.scan, b.scan, aff(off(truth, a.centre, degrees, Vector::Zero()))).status() ==
               CR::WRONG_MOTION);
  BOOST_TEST(CR::judge_motion(a.scan, b.scan, aff(off(truth, a.centre, 0, Vector(0, 100, 0)))).status() ==
             CR::WRONG_MOTION);
  // Scans that share nothing, or are of two bodies: by the best that a registration would have.
  for (const View* target : {&far, &other}) {
    const auto judgement = CR::judge_motion(a.scan, target->scan, aff(true_motion(a, *target)));
    BOOST_TEST(judgement.status() == CR::WRONG_MOTION);
    BOOST_TEST(judgement.confidence() < 0.5);
  }
}

BOOST_AUTO_TEST_CASE(the_other_way_round_and_with_threads_it_is_the_same)
{
  const View &a = view(0, 0), &b = view(0, 60);
  const Rigid_motion motion = off(true_motion(a, b), a.centre, 1, Vector::Zero());
  const auto there = CR::judge_motion(a.scan, b.scan, aff(motion)),
             parallel = CR::judge_motion<CGAL::Parallel_if_available_tag>(a.scan, b.scan, aff(motion)),
             back = CR::judge_motion(b.scan, a.scan, aff(motion.inverse()));
  check_same_bits(there.refined(), parallel.refined());
  BOOST_TEST(there.displacement() == parallel.displacement());
  BOOST_TEST(there.status() == back.status());
  BOOST_TEST(std::abs(there.confidence() - back.confidence()) < 1e-6);
  BOOST_TEST(std::abs(there.displacement() - back.displacement()) < 1e-6);
}

BOOST_AUTO_TEST_CASE(what_is_not_a_rigid_motion_is_refused)
{
  const View &a = view(0, 0), &b = view(0, 45);
  const double infinite = (std::numeric_limits<double>::infinity)();
  for (const Transformation& m :
       {Transformation(CGAL::SCALING, 2.), Transformation(-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0),
        Transformation(1, 0, 0, infinite, 0, 1, 0, 0, 0, 0, 1, 0),
        Transformation(1, 0.1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0)})
    BOOST_CHECK_THROW(CR::judge_motion(a.scan, b.scan, m), std::invalid_argument);
}

// As it is found by a registration of both sides, it has to be right by a judgement, too.
BOOST_AUTO_TEST_CASE(points_from_either_side)
{
  const View &a = view(0, 0), &b = view(0, 45);
  const Scan a_points(a.image.points()), b_points(b.image.points());
  BOOST_TEST_REQUIRE((a_points.other_side() != nullptr && b_points.other_side() != nullptr));
  const Rigid_motion truth = true_motion(a, b);
  const Scan* const a_sides[] = {&a_points, a_points.other_side(), &a.scan};
  const Scan* const b_sides[] = {&b_points, b_points.other_side(), &b.scan};
  std::size_t right_sides = 0;
  for (const Scan* source : a_sides)
    for (const Scan* target : b_sides) {
      const auto judgement = CR::judge_motion(*source, *target, aff(truth));
      right_sides += judgement.status() == CR::RIGHT_MOTION;
      if (source->other_side() != nullptr && target->other_side() != nullptr) {
        BOOST_TEST(judgement.status() == CR::RIGHT_MOTION);
        BOOST_TEST(CR::judge_motion(*source, *target, aff(off(truth, a.centre, 120, Vector::Zero()))).status() ==
                   CR::WRONG_MOTION);
      }
    }
  // Each of either one's sides alone has a partner in two of three, at most.
  BOOST_TEST(right_sides < 9u);
}

BOOST_AUTO_TEST_CASE(statuses_are_written_as_words)
{
  std::ostringstream out;
  out << CR::RIGHT_MOTION << ' ' << CR::REFINABLE_MOTION << ' ' << CR::WRONG_MOTION;
  BOOST_TEST(out.str() == "right refinable wrong");
}

// Where one of two scans without a sensor has to be turned over, odds are a nineteenth of what they were: by the law,
// 19 to 1 become even. What obeys no law stays as it is.
BOOST_AUTO_TEST_CASE(turning_over_one_of_two_scans_costs_odds)
{
  using namespace CGAL::Crude_registration::internal;
  const auto turned = [](double by_law, double probability) {
    Registration_outcome outcome;
    outcome.poses.resize(1);
    outcome.poses.front().log_odds = std::log(by_law / (1 - by_law));
    outcome.poses.front().by_law = by_law;
    outcome.poses.front().probability = outcome.verdict.confidence = probability;
    outcome.verdict.status = CR::REGISTERED;
    turn_over_one_of_two(outcome);
    return outcome;
  };
  const Registration_outcome doubtful = turned(0.95, 0.94), sure = turned(1 - 1e-9, 0.993);
  BOOST_TEST(doubtful.poses.front().by_law == 0.5, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(doubtful.verdict.confidence == 0.94 * 0.5 / 0.95, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(std::abs(doubtful.poses.front().log_odds) < 1e-12);
  BOOST_TEST((doubtful.verdict.status == CR::AMBIGUOUS));
  BOOST_TEST(!doubtful.verdict.reason.empty());
  BOOST_TEST(sure.verdict.confidence == 0.993, boost::test_tools::tolerance(1e-6));
  BOOST_TEST((sure.verdict.status == CR::REGISTERED));
}
