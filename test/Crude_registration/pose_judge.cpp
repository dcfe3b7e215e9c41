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
#include <CGAL/Crude_registration/internal/matching/Candidate_source.h>
#include <CGAL/Crude_registration/internal/pipeline/register_reduced_scans.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
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
struct Range_of_depths
{
  double depth, reach;
  bool surrounded;
};

// For two such ranges at once. A line of sight in the direction u passes beside p by sqrt((p p / (u p))^2 - p p), in
// the plane through p that p is normal to.
std::array<double, 2> shares_before(const Reduced_scan& scan, const Rigid_motion& view_from_own, const View& view,
                                    const std::array<Range_of_depths, 2>& ranges)
{
  std::vector<Vector> directions;
  for (const Point& q : view.image.points()) directions.push_back(to_vector(q).normalized());
  const std::size_t n = (std::min)(std::size_t(2500), scan.fine.probes.size());
  std::array<std::size_t, 2> before{};
  for (std::size_t i = 0; i < n; ++i) {
    const Vector p = view_from_own(scan.fine.surfels[std::size_t(scan.fine.probes[i])].position.cast<double>());
    std::array<double, 2> least, least_cosine;
    least.fill((std::numeric_limits<double>::max)());
    const double square = p.squaredNorm();
    for (std::size_t k = 0; k < 2; ++k)
      least_cosine[k] = square / std::sqrt(square + ranges[k].reach * ranges[k].reach);
    const double smallest = (std::min)(least_cosine[0], least_cosine[1]);
    std::array<Vector, 2> sum = {Vector::Zero(), Vector::Zero()};
    std::array<int, 2> count{};
    for (std::size_t j = 0; j < directions.size(); ++j) {
      const double along = directions[j].dot(p);
      if (!(along >= smallest && along > 0)) continue;
      for (std::size_t k = 0; k < 2; ++k) {
        if (along < least_cosine[k]) continue;
        least[k] = (std::min)(least[k], to_vector(view.image.points()[j]).norm());
        sum[k] += directions[j] * (square / along) - p;
        ++count[k];
      }
    }
    for (std::size_t k = 0; k < 2; ++k)
      before[k] += count[k] > 0 && (!ranges[k].surrounded || sum[k].norm() < 0.25 * ranges[k].reach * count[k]) &&
                   p.norm() < least[k] - ranges[k].depth;
  }
  return {double(before[0]) / double(n), double(before[1]) / double(n)};
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
      const std::array<Range_of_depths, 2> ranges = {
          {{2.5 * spacing, 1.5 * spacing, false}, {4 * spacing, 8 * spacing, true}}};
      const auto of_source = shares_before(source, motion * source.own_from_input.inverse(), b(), ranges),
                 of_target = shares_before(target, motion.inverse() * target.own_from_input.inverse(), a(), ranges);
      const double most = of_source[0] + of_target[0], least = of_source[1] + of_target[1];
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
    if (i > 0) BOOST_TEST(poses[i].log_weight <= poses[i - 1].log_weight);
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
    coefficients.share = {};
    coefficients.share.residual = -1;
    coefficients.any = {};
    coefficients.any.fit = 1;
    coefficients.any.offset = offset;
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
    ends.push_back(judge.weighed(judge.refined(p)).log_weight);
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
    const double wanted_weight = offset > 0 ? ends[worst] : greatest;
    BOOST_TEST(best.log_weight == wanted_weight);
    // The root of the evidence, and how far the residual is from that of probes that are anywhere in the tolerance.
    const auto& e = best.evidence;
    const double root = std::sqrt((std::max)(e.fuller, 0.) /
                                  (1 + CR::internal::Evidence_coefficients().surfels / e.surfels)),
                 fit = (std::max)(1 - std::sqrt(3.) * e.residual, 0.);
    BOOST_TEST(root * fit > 0);
    BOOST_TEST(std::abs(best.log_odds - offset - root * fit) < 1e-12);
    BOOST_TEST((best.proposed.rotation == proposals.poses.front().rotation));
  }
}

// Chance from few candidates that were tried, and filled up by others that were dropped: by a judge of which all that
// is in question was tried.
BOOST_AUTO_TEST_CASE(few_candidates_are_filled_up_by_dropped_ones)
{
  const Rigid_motion wanted = own(true_motion(a(), b()));
  const Reduced_scan &source = a().scan.reduced(), &target = b().scan.reduced();
  const auto pose = [&](int i) { return to_pose(turned(wanted, 0.5 * i, Vector(0.02 * i, 0.3 * (i / 12), 0))); };
  std::vector<Pose> few, others;
  for (int i = 0; i < 4; ++i) few.push_back(pose(i));
  for (int i = 2; i < 48; ++i) others.push_back(pose(i)); // two of them were tried
  const auto judged = [&](const std::vector<Pose>& tried, const std::vector<Pose>& dropped) {
    Pose_judge judge = judge_of(source, target);
    CR::internal::Proposals proposals;
    proposals.poses = few;
    proposals.judged = few.size();
    proposals.are_estimated = true;
    proposals.tried = tried;
    proposals.dropped = dropped;
    judge.add_round(proposals);
    return judge;
  };
  const Pose_judge filled = judged(few, others), only_few = judged(few, {});
  BOOST_TEST_REQUIRE(only_few.candidates().size() == 4u);
  BOOST_TEST_REQUIRE(filled.candidates().size() == 32u);
  BOOST_TEST(filled.tried_candidates().size() == 4u);
  const Pose_judge all_tried = judged(filled.candidates(), {});
  BOOST_TEST_REQUIRE(all_tried.candidates().size() == 32u);
  for (const Pose& p : few) {
    const auto f = filled.weighed(p).evidence, o = only_few.weighed(p).evidence, t = all_tried.weighed(p).evidence;
    BOOST_TEST(f.tried == o.tried);
    BOOST_TEST(o.fuller == o.tried);
    BOOST_TEST(f.fuller == t.tried);
    BOOST_TEST(f.fuller != f.tried);
    BOOST_TEST(f.usual == o.usual);
  }
  // One that was dropped, and is tried in a later round, counts as tried, and once.
  Pose_judge later = judged(few, others);
  CR::internal::Proposals second;
  second.poses = {others[7]};
  second.judged = 1;
  second.are_estimated = true;
  second.tried = {others[7]};
  later.add_round(second);
  BOOST_TEST(later.candidates().size() == 32u);
  BOOST_TEST(later.tried_candidates().size() == 5u);
}

BOOST_AUTO_TEST_CASE(usual_evidence_is_that_of_its_outcomes)
{
  const Rigid_motion wanted = own(true_motion(a(), b()));
  Pose_judge judge = judge_of(a().scan.reduced(), b().scan.reduced());
  judge.add_round(proposals_of({to_pose(wanted)}));
  const CR::internal::Evidence_coefficients c;
  for (const double angle : {0., 0.1, 1.}) {
    const Pose pose = to_pose(turned(wanted, angle, Vector::Zero()));
    const std::vector<std::uint8_t> outcomes = judge.outcomes(pose);
    double sum = 0;
    for (const std::uint8_t o : outcomes) {
      if (o == CR::internal::Outcome::UNKNOWN) continue;
      const int kind = o <= 12 ? 0 : o - 12;
      const double log_ratio = std::log(c.right[kind] / c.wrong[kind]);
      sum += kind > 0 ? (std::min)(log_ratio, 0.) : log_ratio + std::log(c.right_fit[o - 1] / c.wrong_fit[o - 1]);
    }
    BOOST_TEST(judge.weighed(pose).evidence.usual == sum / double(outcomes.size()),
               boost::test_tools::tolerance(1e-12));
  }
}

// Of n planes with as many probes on each, two probes lie in one plane as often as two of n kinds are of one kind.
BOOST_AUTO_TEST_CASE(planes_are_told_apart_by_height_and_direction)
{
  using CR::internal::Outcome;
  using CR::internal::Surfel;
  using CR::internal::Vector_f;
  const CR::internal::Probe_tolerance tolerance{0.1f, 0.3f, 1.f};
  constexpr std::size_t each = 20;
  const std::vector<std::pair<Vector_f, float>> planes = {{Vector_f(0, 0, 1), 0.f},  {Vector_f(0, 0, 1), 2.f},
                                                          {Vector_f(0, 0, -1), 0.f}, {Vector_f(0, 1, 0), 0.f},
                                                          {Vector_f(1, 0, 0), 0.f},  {Vector_f(0, 0.6f, 0.8f), 0.f}};
  std::vector<Surfel> probes;
  std::vector<std::uint8_t> outcomes;
  for (std::size_t n = 1; n <= planes.size(); ++n) {
    const auto& [normal, height] = planes[n - 1];
    const Vector_f along = normal.unitOrthogonal(), across = normal.cross(along);
    for (std::size_t k = 0; k < each; ++k) {
      Surfel s{};
      // In a spiral, up and down by what a probe of the plane may be off.
      const float angle = 2.4f * float(k), radius = 0.3f * std::sqrt(float(k) + 1);
      s.position = (height + (k % 2 == 0 ? 0.09f : -0.09f)) * normal +
                   radius * (std::cos(angle) * along + std::sin(angle) * across);
      s.normal = normal;
      probes.push_back(s);
      outcomes.push_back(std::uint8_t(1 + k % Outcome::fits));
      // What does not agree is not looked at.
      probes.push_back(s);
      outcomes.push_back(k % 2 == 0 ? std::uint8_t(Outcome::UNKNOWN) : std::uint8_t(Outcome::DISAGREES));
    }
    const double in_one = double(n * each * (each - 1)) / 2, all = double(n * each * (n * each - 1)) / 2;
    BOOST_TEST(CR::internal::probability_of_one_plane(probes, outcomes.data(), tolerance) == (in_one + 1) / (all + 1),
               boost::test_tools::tolerance(1e-12));
  }
}

// The variance of the places by all pairs: half of the mean squared distance of two.
BOOST_AUTO_TEST_CASE(spread_is_the_variance_of_what_agrees)
{
  using CR::internal::Outcome;
  using CR::internal::Surfel;
  using CR::internal::Vector_f;
  std::vector<Surfel> probes;
  std::vector<std::uint8_t> outcomes;
  std::vector<Vector> agreeing;
  for (int i = 0; i < 60; ++i) {
    Surfel s{};
    s.position = Vector_f(100 + std::cos(float(i)), std::sin(3.f * float(i)), 0.1f * float(i));
    s.normal = Vector_f(0, 0, 1);
    probes.push_back(s);
    constexpr std::array<std::uint8_t, 5> others = {Outcome::UNKNOWN, Outcome::DISAGREES, Outcome::IN_FREE_SPACE,
                                                    Outcome::MISSING, Outcome::DISAGREES};
    const bool agrees = i % 3 == 0;
    outcomes.push_back(agrees ? std::uint8_t(1 + i % Outcome::fits) : others[std::size_t(i % 5)]);
    if (agrees) agreeing.push_back(s.position.cast<double>());
  }
  double squares = 0;
  for (const Vector& p : agreeing)
    for (const Vector& q : agreeing) squares += (p - q).squaredNorm();
  const auto n = double(agreeing.size());
  constexpr double floor = 0.25;
  using CR::internal::variance_of_agreeing;
  BOOST_TEST(variance_of_agreeing(probes, outcomes.data(), floor) == (squares / (2 * n) + floor) / (n + 1),
             boost::test_tools::tolerance(1e-6));

  // Nothing agrees, and there is nothing at all.
  std::fill(outcomes.begin(), outcomes.end(), std::uint8_t(Outcome::MISSING));
  BOOST_TEST(variance_of_agreeing(probes, outcomes.data(), floor) == floor);
  BOOST_TEST(variance_of_agreeing(std::vector<Surfel>(), outcomes.data(), floor) == floor);

  // Other units, and the other order of the scans.
  using CR::internal::spread;
  const double here = spread(4, 5, 10);
  BOOST_TEST(here == std::log(9. / 200), boost::test_tools::tolerance(1e-12));
  BOOST_TEST(spread(5e6, 4e6, 1e4) == here, boost::test_tools::tolerance(1e-12));
}

// A box has six planes and its edges, and a statue more than that.
BOOST_AUTO_TEST_CASE(a_statue_has_more_planes_than_a_box)
{
  Mesh box, statue;
  CR::make_pedestal(box, 2, 0, 2);
  CR::make_statue(statue, 48);
  const Scan of_box(box), of_statue(statue);
  const auto planes = [](const Scan& scan) {
    CR::internal::Judged_pose at_itself;
    judge_of(scan.reduced(), scan.reduced()).add_variety_and_spread(at_itself);
    return std::exp(at_itself.evidence.variety);
  };
  // Two probes on the same of the faces lie in one plane. Those at the edges, whose normals are between, may not.
  std::size_t flat = 0;
  const auto probes = CR::internal::neighbouring_probes(of_box.reduced().fine, 1500);
  for (const CR::internal::Surfel& s : probes) flat += s.normal.cwiseAbs().maxCoeff() > 0.999f;
  const double share = double(flat) / double(probes.size());
  BOOST_TEST(planes(of_box) > 5);
  BOOST_TEST(planes(of_box) < 7 / (share * share));
  BOOST_TEST(planes(of_statue) > 2 * planes(of_box));
}

using CR::internal::Judged_pose;
using CR::internal::Pose_evidence;

namespace {

// Of n poses the first is better than the others, that are all alike.
std::vector<Judged_pose> some_poses(std::size_t n, const Pose_evidence& first, const Pose_evidence& others)
{
  std::vector<Judged_pose> poses(n);
  for (std::size_t i = 0; i < n; ++i) {
    poses[i].evidence = i == 0 ? first : others;
    poses[i].log_weight = CR::internal::log_weight(poses[i].evidence, poses[i].evidence.tried);
  }
  CR::internal::share_probability(poses, false, false);
  return poses;
}

const Pose_evidence good{0.5, 0.6, 0.4, 0.2, 0.01, 10000, 2.5}, poor{0.1, 0.15, 0.1, 0.3, 0.02, 10000, 2.5};

} // namespace

BOOST_AUTO_TEST_CASE(odds_rise_with_what_speaks_for_a_pose)
{
  using Evidence = Pose_evidence;
  const auto odds = [](double Evidence::*member, double of_first, double of_others) {
    Evidence first = good, others = poor;
    first.*member += of_first;
    others.*member += of_others;
    return some_poses(4, first, others).front().log_odds;
  };
  const double here = odds(&Evidence::tried, 0, 0);
  BOOST_TEST(odds(&Evidence::tried, 0.1, 0) > here);
  BOOST_TEST(odds(&Evidence::fuller, 0.1, 0) > here);
  BOOST_TEST(odds(&Evidence::usual, 0.1, 0.1) == here);
  BOOST_TEST(odds(&Evidence::residual, 0.1, 0) < here);
  BOOST_TEST(odds(&Evidence::violations, 0.1, 0) < here);
  BOOST_TEST(odds(&Evidence::surfels, -9900, 0) < here);
  BOOST_TEST(odds(&Evidence::variety, 1, 0) > here);
  BOOST_TEST(odds(&Evidence::spread, 1, 0) > here);
  // The others as rivals, and as what tells of chance.
  BOOST_TEST(odds(&Evidence::tried, 0, 0.1) < here);
  BOOST_TEST(odds(&Evidence::fuller, 0, 0.1) < here);
}

// The share of answers that obey no law is in the probabilities, and in nothing that more rounds could change.
BOOST_AUTO_TEST_CASE(no_share_of_answers_without_law_keeps_the_search_going)
{
  using CR::internal::is_certain;
  Pose_evidence best = good;
  best.fuller = best.tried = 2;
  for (const double lapse : {0., 0.01, 0.1}) {
    CR::internal::Evidence_coefficients c;
    c.any.lapse = c.share.lapse = lapse;
    std::vector<Judged_pose> sure = some_poses(4, best, poor), doubtful = some_poses(4, good, good);
    CR::internal::share_probability(sure, false, false, c);
    CR::internal::share_probability(doubtful, false, false, c);
    BOOST_TEST(is_certain(sure));
    BOOST_TEST(!is_certain(doubtful));
    // At least half of one answer and three quarters of the other that obey no law are something else.
    BOOST_TEST(sure.front().probability <= (1 - lapse / 2) * (1 - lapse * 3 / 4) + 1e-9);
    BOOST_TEST(sure.front().by_law > 0.99);
    for (const Judged_pose& p : doubtful) BOOST_TEST(p.by_law <= 0.25 + 1e-9);
  }
  BOOST_TEST(!is_certain(std::vector<Judged_pose>()));
}

namespace {

// One round of wrong poses; what comes after it, a function says.
class One_round : public CR::internal::Candidate_source
{
public:
  explicit One_round(std::function<void(CR::internal::Run_control&)> then) : m_then(std::move(then)) {}
  static CR::internal::Proposals round()
  {
    std::vector<Pose> poses;
    for (const double angle : {0.8, 1.6, 2.4, 3.2})
      poses.push_back(to_pose(turned(own(true_motion(a(), b())), angle, Vector::Zero())));
    return proposals_of(poses);
  }
  std::optional<CR::internal::Proposals> next(CR::internal::Run_control& control) override
  {
    if (m_is_first) {
      m_is_first = false;
      return round();
    }
    m_then(control);
    return std::nullopt;
  }

private:
  std::function<void(CR::internal::Run_control&)> m_then;
  bool m_is_first = true;
};

} // namespace

// What leads at the end is more probable than what leads before, by the same for all; a run that is stopped has no end.
BOOST_AUTO_TEST_CASE(the_end_of_the_rounds_counts)
{
  const Reduced_scan &source = a().scan.reduced(), &target = b().scan.reduced();
  Pose_judge judge = judge_of(source, target);
  judge.add_round(One_round::round());
  const std::vector<Judged_pose> before = judge.distinct_poses();
  judge.end_rounds();
  const std::vector<Judged_pose> after = judge.distinct_poses();
  BOOST_TEST_REQUIRE(!before.empty());
  BOOST_TEST_REQUIRE(after.size() == before.size());
  const double by = CR::internal::Evidence_coefficients().any.tried_all;
  BOOST_TEST(by > 0);
  for (std::size_t i = 0; i < after.size(); ++i) {
    BOOST_TEST(after[i].log_odds == before[i].log_odds + by, boost::test_tools::tolerance(1e-9));
    BOOST_TEST(after[i].probability > before[i].probability);
  }

  BOOST_TEST_REQUIRE(!CR::internal::are_swapped(source, target));
  bool is_to_stop = false;
  CR::internal::Run_control control([&](double) { return !is_to_stop; }, std::numeric_limits<double>::infinity());
  const auto leading_log_odds = [&](const std::function<void(CR::internal::Run_control&)>& then) {
    return CR::internal::register_reduced_scans(
               source, target,
               [&](const Reduced_scan&, const Reduced_scan&) { return std::make_unique<One_round>(then); },
               CR::internal::Execution::SEQUENTIAL, control)
        .poses.front()
        .log_odds;
  };
  BOOST_TEST(leading_log_odds([](CR::internal::Run_control&) {}) == after.front().log_odds);
  BOOST_TEST(leading_log_odds([&](CR::internal::Run_control& c) {
               is_to_stop = true;
               while (c.go_on()) {
               }
             }) == before.front().log_odds);
}

BOOST_AUTO_TEST_CASE(poses_that_are_alike_share_what_one_of_them_would_have)
{
  const double alone = some_poses(1, good, poor).front().probability;
  BOOST_TEST(alone > 0.9);
  const auto two = some_poses(2, good, good);
  BOOST_TEST(two[0].probability == two[1].probability, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(two[0].probability < 0.5);
  for (std::size_t n : {2u, 3u, 10u}) {
    const auto poses = some_poses(n, good, poor);
    BOOST_TEST(poses.front().log_odds > poses.back().log_odds);
    for (std::size_t i = 2; i < n; ++i) BOOST_TEST(poses[i].probability == poses[1].probability);
  }
}

// Without evidence, among few planes, and at the residual of what is anywhere in the tolerance there is nothing that
// makes a pose probable.
BOOST_AUTO_TEST_CASE(what_comes_by_chance_counts_nothing)
{
  std::vector<Judged_pose> poses(2);
  CR::internal::Pose_evidence& e = poses[0].evidence;
  const auto features = [&] {
    return CR::internal::Lead_features(CR::internal::leading_pose(poses, false, {}), false);
  };
  poses[0].log_weight = 5;
  e = {3, 2, 1, 0.1, 0.25, 1000, 1.5};
  BOOST_TEST(features().fit > 0);
  BOOST_TEST(features().violations == 0.5);
  BOOST_TEST(features().lead > 0);
  BOOST_TEST(features().distinction > 0);
  e.residual = 1 / std::sqrt(3.);
  BOOST_TEST(std::abs(features().fit) < 1e-12);
  e.residual = 0.9;
  BOOST_TEST(features().fit == 0);
  e.variety = 0; // all in one plane
  BOOST_TEST(features().lead == 0);
  BOOST_TEST(features().distinction == 0);
  e = {};
  e.surfels = 1000;
  e.variety = 5;
  BOOST_TEST(features().fit == 0);
  BOOST_TEST(features().lead == 0);
}

BOOST_AUTO_TEST_CASE(probabilities_of_poses_and_of_none_add_up_to_one)
{
  CR::internal::Evidence_coefficients c;
  c.share.lapse = 0.03;
  // The log-odds that one of two poses is right, whatever the evidence is.
  for (const double odds : {-800., -3., 0., 5., 800.})
    for (const double second : {-800., 0., 3.})
      for (const bool is_usual : {false, true}) {
        c.any = {0, 0, 0, 0, 0, 0, is_usual ? 77 : odds, 0.04};
        c.usual_any = {0, 0, 0, 0, is_usual ? odds : 77, 0.04};
        std::vector<Judged_pose> poses(2);
        poses[1].log_weight = second;
        CR::internal::share_probability(poses, is_usual, false, c);
        const double any = 0.96 * (odds < 0 ? std::exp(odds) / (1 + std::exp(odds)) : 1 / (1 + std::exp(-odds))) + 0.02,
                     share = std::exp(second) / (1 + std::exp(second));
        BOOST_TEST(poses[1].probability == any * (0.97 * share + 0.015), boost::test_tools::tolerance(1e-12));
        BOOST_TEST(poses[0].probability + poses[1].probability == any, boost::test_tools::tolerance(1e-12));
        BOOST_TEST(poses[1].log_odds - poses[0].log_odds == second, boost::test_tools::tolerance(1e-9));
        BOOST_TEST(CR::internal::probability_of_any(poses) == any, boost::test_tools::tolerance(1e-12));
      }
  std::vector<Judged_pose> none;
  CR::internal::share_probability(none, false, false, c);
  BOOST_TEST(none.empty());
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
