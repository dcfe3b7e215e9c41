// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// How poses are judged: by what agrees and by free space.

#define BOOST_TEST_MODULE pose_judge
#include <boost/test/unit_test.hpp>

#include "statue_views.h"

#include <CGAL/Crude_registration/internal/judgement/Pose_judge.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

using CR::internal::Agreement;
using CR::internal::Pose;
using CR::internal::Pose_judge;
using CR::internal::Reduced_scan;
using CR::internal::to_pose;

namespace {

const View& a()
{
  return view(0, 0);
}
const View& b()
{
  return view(0, 45);
}

// Between the own frames of the two scans.
Rigid_motion own(const Rigid_motion& input)
{
  return b().scan.reduced().own_from_input * input * a().scan.reduced().own_from_input.inverse();
}

Rigid_motion turned(const Rigid_motion& m, double angle, const Vector& shift)
{
  Rigid_motion by;
  by.rotation = Eigen::AngleAxisd(angle, Vector(1, -2, 2).normalized()).toRotationMatrix();
  by.translation = shift;
  return by * m;
}

Pose_judge judge_of(const Reduced_scan& source, const Reduced_scan& target)
{
  return Pose_judge(source, target, CR::internal::Execution::SEQUENTIAL, CR::internal::to_the_end());
}

// As of a search that has estimated nothing.
CR::internal::Proposals proposals_of(const std::vector<Pose>& poses)
{
  CR::internal::Proposals proposals;
  proposals.poses = poses;
  proposals.judged = 8;
  return proposals;
}

// The share of the probes of a scan, moved to the frame of a view, that are nearer to its sensor by `depth` than all
// samples whose lines of sight pass within `reach` of them, and, where `surrounded` says so, all around: by all pairs.
double share_before(const Reduced_scan& scan, const Rigid_motion& view_from_own, const View& view, double depth,
                    double reach, bool surrounded)
{
  const std::size_t n = (std::min)(std::size_t(2500), scan.fine.probes.size());
  std::size_t before = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vector p = view_from_own(scan.fine.surfels[std::size_t(scan.fine.probes[i])].position.cast<double>());
    double least = (std::numeric_limits<double>::max)();
    Vector sum = Vector::Zero();
    int count = 0;
    for (const Point& q : view.image.points()) {
      const Vector v = to_vector(q), beside = v * (p.squaredNorm() / v.dot(p)) - p;
      if (!(v.dot(p) > 0) || beside.norm() > reach) continue;
      least = (std::min)(least, v.norm());
      sum += beside;
      ++count;
    }
    before += count > 0 && (!surrounded || sum.norm() < 0.25 * reach * count) && p.norm() < least - depth;
  }
  return double(before) / double(n);
}

} // namespace

BOOST_AUTO_TEST_CASE(the_true_motion_scores_best)
{
  const Pose_judge judge = judge_of(a().scan.reduced(), b().scan.reduced());
  const Rigid_motion wanted = own(true_motion(a(), b()));
  const Agreement best = judge.assess(to_pose(wanted));
  BOOST_TEST(best.overlap > 0.3f);
  BOOST_TEST(best.violations < 0.02f);
  BOOST_TEST(best.score() == best.overlap - 2 * best.violations);
  for (const double angle : {0.02, 0.1, 0.3, 1.0, 3.0})
    BOOST_TEST(judge.assess(to_pose(turned(wanted, angle, 0.1 * angle * Vector(1, 1, 1)))).score() < best.score());
  // Far away nothing agrees.
  BOOST_TEST(judge.assess(to_pose(turned(wanted, 0, Vector(50, 40, 0)))).overlap == 0.f);
}

// What is counted is in front of all that was seen nearby, and all that is so by far is counted: free space is kept in
// cells, so that it depends on the place by a cell or two what is near.
BOOST_AUTO_TEST_CASE(violations_are_what_lies_in_front_of_either_scan)
{
  const Reduced_scan &source = a().scan.reduced(), &target = b().scan.reduced();
  const Pose_judge judge = judge_of(source, target), back = judge_of(target, source);
  const Rigid_motion truth = true_motion(a(), b());
  const double spacing = (std::max)(a().scan.spacing(), b().scan.spacing());
  float largest = 0;
  // The sensors look along -z: the source comes nearer to the sensor of the target.
  for (const double shift : {0., 0.2, 0.5})
    for (const double angle : {0., 0.5, 2.}) {
      Rigid_motion motion;
      const Vector centre = truth(a().centre);
      motion.rotation = Eigen::AngleAxisd(angle, Vector::UnitY()).toRotationMatrix();
      motion.translation = centre - motion.rotation * centre + Vector(0, 0, shift);
      motion = motion * truth;
      const Agreement agreement = judge.assess(to_pose(own(motion)));
      const auto expected = [&](double depth, double reach, bool surrounded) {
        return share_before(source, motion * source.own_from_input.inverse(), b(), depth, reach, surrounded) +
               share_before(target, motion.inverse() * target.own_from_input.inverse(), a(), depth, reach, surrounded);
      };
      const double most = expected(2.5 * spacing, 1.5 * spacing, false),
                   least = expected(4 * spacing, 8 * spacing, true);
      BOOST_TEST_CONTEXT("shift " << shift << ", angle " << angle)
      {
        BOOST_TEST_MESSAGE(least << " <= " << agreement.violations << " <= " << most);
        BOOST_TEST(double(agreement.violations) >= least - 0.02);
        BOOST_TEST(double(agreement.violations) <= most + 0.02);
        // Seen from the other side it is the same.
        BOOST_TEST(std::abs(back.assess(to_pose(own(motion)).inverse()).violations - agreement.violations) < 1e-3f);
        BOOST_TEST(agreement.violations >= 0.f);
        BOOST_TEST(agreement.violations <= 2.f);
      }
      largest = (std::max)(largest, agreement.violations);
    }
  BOOST_TEST(largest > 0.5f);
}

BOOST_AUTO_TEST_CASE(poses_are_refined)
{
  const Pose_judge judge = judge_of(a().scan.reduced(), b().scan.reduced());
  const Rigid_motion wanted = own(true_motion(a(), b()));
  const double spacing = a().scan.spacing();
  const Vector middle = Vector::Zero(); // of the source in its own frame
  const Rigid_motion crude = turned(wanted, 0.02, 1.5 * spacing * Vector(1, -1, 1));
  const Pose refined = judge.refined(to_pose(crude));
  const double off = difference(crude, wanted, middle);
  BOOST_TEST(difference(CR::internal::to_rigid_motion(refined), wanted, middle) < 0.3 * off);
  BOOST_TEST(judge.assess(refined).score() > judge.assess(to_pose(crude)).score());
}

BOOST_AUTO_TEST_CASE(the_right_one_of_many_poses_is_most_probable)
{
  const Rigid_motion wanted = own(true_motion(a(), b()));
  const double spacing = a().scan.spacing();
  const Vector middle = Vector::Zero();
  std::vector<Pose> proposed;
  for (int i = 0; i < 40; ++i) proposed.push_back(to_pose(turned(wanted, 0.02 + 0.15 * i, Vector(0, 0, 0.01 * i))));
  std::rotate(proposed.begin(), proposed.begin() + 7, proposed.end());
  Pose_judge judge = judge_of(a().scan.reduced(), b().scan.reduced());
  BOOST_TEST(judge.distinct_poses().empty());
  judge.add_round(proposals_of(proposed));
  BOOST_TEST(judge.number_of_judged() <= 8u);
  const auto poses = judge.distinct_poses();
  BOOST_TEST_REQUIRE(!poses.empty());
  BOOST_TEST(difference(CR::internal::to_rigid_motion(poses.front().pose), wanted, middle) < 2 * spacing);
  BOOST_TEST(poses.front().probability > 0.9);
  double sum = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    BOOST_TEST(std::any_of(proposed.begin(), proposed.end(), [&](const Pose& p) {
      return p.rotation == poses[i].proposed.rotation && p.translation == poses[i].proposed.translation;
    }));
    BOOST_TEST(poses[i].probability >= 0);
    sum += poses[i].probability;
    if (i > 0) BOOST_TEST(poses[i].log_odds <= poses[i - 1].log_odds);
    for (std::size_t j = 0; j < i; ++j)
      BOOST_TEST(!CR::internal::are_one(poses[i].pose, poses[j].pose, float(a().scan.extent())));
  }
  BOOST_TEST(sum <= 1 + 1e-12);
  // What is known of chance changes with the next round, not what was judged.
  const std::size_t before = judge.number_of_judged();
  judge.add_round(proposals_of({proposed.begin(), proposed.begin() + 3}));
  BOOST_TEST(judge.number_of_judged() > before);
  BOOST_TEST(difference(CR::internal::to_rigid_motion(judge.distinct_poses().front().pose), wanted, middle) <
             2 * spacing);
}

BOOST_AUTO_TEST_CASE(a_pose_in_doubt_is_refined_from_all_around_it)
{
  const Rigid_motion wanted = own(true_motion(a(), b()));
  const Reduced_scan &source = a().scan.reduced(), &target = b().scan.reduced();
  // By the residual alone; all poses are in doubt, or all are certain.
  const auto judge_by_residual = [&](double offset) {
    CR::internal::Evidence_coefficients coefficients;
    coefficients.slope = coefficients.lead = coefficients.violations = 0;
    coefficients.residual = -1;
    coefficients.offset = offset;
    return Pose_judge(source, target, CR::internal::Execution::SEQUENTIAL, CR::internal::to_the_end(), coefficients);
  };
  CR::internal::Proposals proposals;
  proposals.are_estimated = true;
  proposals.judged = 1;
  for (const double angle : {-0.13, 0., 0.13})
    proposals.tried.push_back(to_pose(turned(wanted, angle, Vector::Zero())));
  Pose_judge judge = judge_by_residual(0);
  // The one that is proposed ends in the worst place.
  proposals.poses = {proposals.tried.front()};
  judge.add_round(proposals);
  std::vector<double> ends;
  for (const Pose& p : proposals.tried) {
    BOOST_TEST(judge.are_same(p, judge.refined(p)));
    ends.push_back(judge.weighed(judge.refined(p)).log_odds);
  }
  const auto worst = std::size_t(std::min_element(ends.begin(), ends.end()) - ends.begin());
  const double greatest = *std::max_element(ends.begin(), ends.end());
  BOOST_TEST(ends[worst] < greatest);
  proposals.poses = {proposals.tried[worst]};
  for (const double offset : {0., 20.}) {
    Pose_judge again = judge_by_residual(offset);
    again.add_round(proposals);
    BOOST_TEST_REQUIRE(again.distinct_poses().size() == 1u);
    const auto best = again.distinct_poses().front();
    const double log_odds = best.log_odds - offset, wanted_odds = offset > 0 ? ends[worst] : greatest;
    BOOST_TEST(std::abs(log_odds - wanted_odds) < 1e-12);
    BOOST_TEST((best.proposed.rotation == proposals.poses.front().rotation));
  }
}

BOOST_AUTO_TEST_CASE(the_rival_is_the_best_candidate_elsewhere)
{
  const Rigid_motion wanted = own(true_motion(a(), b()));
  std::vector<Pose> proposed;
  for (int i = 0; i < 12; ++i) proposed.push_back(to_pose(turned(wanted, 0.5 * i, Vector(0.02 * i, 0, 0))));
  Pose_judge judge = judge_of(a().scan.reduced(), b().scan.reduced());
  CR::internal::Proposals proposals = proposals_of(proposed);
  proposals.tried = proposed;
  judge.add_round(proposals);
  BOOST_TEST_REQUIRE(judge.candidates().size() > 2u);
  const auto extent = float((std::min)(a().scan.reduced().extent, b().scan.reduced().extent));
  const CR::internal::Evidence_coefficients c;
  const auto usual = [&](const Pose& pose) {
    const std::vector<std::uint8_t> outcomes = judge.outcomes(pose);
    double sum = 0;
    for (const std::uint8_t o : outcomes) {
      if (o == CR::internal::Outcome::UNKNOWN) continue;
      const int kind = o <= 12 ? 0 : o - 12;
      const double log_ratio = std::log(c.right[kind] / c.wrong[kind]);
      sum += kind > 0 ? (std::min)(log_ratio, 0.) : log_ratio + std::log(c.right_fit[o - 1] / c.wrong_fit[o - 1]);
    }
    return sum / double(outcomes.size());
  };
  for (const CR::internal::Judged_pose& p : judge.distinct_poses()) {
    double rival = 0;
    for (const Pose& candidate : judge.candidates())
      if (!CR::internal::are_one(candidate, p.pose, extent)) rival = (std::max)(rival, usual(candidate));
    BOOST_TEST(p.evidence.rival == rival, boost::test_tools::tolerance(1e-12));
    BOOST_TEST(p.evidence.usual == usual(p.pose), boost::test_tools::tolerance(1e-12));
  }
}

BOOST_AUTO_TEST_CASE(odds_rise_with_what_speaks_for_a_pose)
{
  const CR::internal::Pose_evidence evidence{0.5, 0.4, 0.3, 0.01, 0.2, 10000};
  const auto odds = [&](double CR::internal::Pose_evidence::*member, double change) {
    CR::internal::Pose_evidence changed = evidence;
    changed.*member += change;
    return CR::internal::log_odds(changed);
  };
  using Evidence = CR::internal::Pose_evidence;
  const double here = CR::internal::log_odds(evidence);
  BOOST_TEST(odds(&Evidence::nats, 0.1) > here);
  BOOST_TEST(odds(&Evidence::usual, 0.1) > here);
  BOOST_TEST(odds(&Evidence::residual, 0.1) < here);
  BOOST_TEST(odds(&Evidence::violations, 0.1) < here);
  BOOST_TEST(odds(&Evidence::rival, 0.1) < here);
  BOOST_TEST(odds(&Evidence::surfels, -9900) < here);
}

BOOST_AUTO_TEST_CASE(probabilities_of_poses_and_of_none_add_up_to_one)
{
  CR::internal::Evidence_coefficients c;
  c.lapse = 0.03;
  for (const double x : {-800., -3., 0., 5., 800.}) {
    std::vector<CR::internal::Judged_pose> poses(2);
    poses[0].log_odds = x;
    poses[1].log_odds = 1;
    CR::internal::share_probability(poses, c);
    // By way of the one that is greatest.
    const double greatest = (std::max)(x, 1.),
                 all = std::exp(-greatest) + std::exp(x - greatest) + std::exp(1 - greatest);
    BOOST_TEST(poses[0].probability == 0.97 * std::exp(x - greatest) / all + 0.01, boost::test_tools::tolerance(1e-12));
    const double none = 0.97 * std::exp(-greatest) / all + 0.01;
    BOOST_TEST(poses[0].probability + poses[1].probability + none == 1, boost::test_tools::tolerance(1e-12));
  }
}

BOOST_AUTO_TEST_CASE(without_free_space_nothing_is_violated)
{
  Mesh statue;
  CR::make_statue(statue, 48);
  const Scan closed(statue);
  BOOST_TEST_REQUIRE(!closed.has_free_space());
  const Pose_judge judge = judge_of(closed.reduced(), closed.reduced());
  for (const double angle : {0., 1., 3.})
    for (const double shift : {0., 0.5, 5.})
      BOOST_TEST(judge.assess(to_pose(turned(Rigid_motion(), angle, Vector(shift, 0, 0)))).violations == 0.f);
  // One that knows it, against one that does not.
  const Pose_judge one = judge_of(a().scan.reduced(), closed.reduced());
  float largest = 0;
  for (const double shift : {-1., -0.5, 0.5, 1.})
    largest = (std::max)(largest, one.assess(to_pose(turned(Rigid_motion(), 1, Vector(0, 0, shift)))).violations);
  BOOST_TEST(largest > 0.f);
  BOOST_TEST(largest <= 1.f);
}
