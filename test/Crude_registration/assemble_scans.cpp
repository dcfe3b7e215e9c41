// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// Many scans are put together: generated views of which the truth is known, and pairs that say what they are told to.

#define BOOST_TEST_MODULE assemble_scans

#include "generated_surfaces.h"
#include "statue_views.h"

#include <CGAL/Crude_registration/assemble_scans.h>
#include <CGAL/Crude_registration/fused_points.h>
#include <CGAL/Crude_registration/internal/assembly/Pair_plan.h>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using Assembly = CR::Assembly_result<Kernel>;

namespace {

struct Set
{
  std::vector<const View*> views;
  std::vector<Scan> scans;

  void add(const View& v)
  {
    views.push_back(&v);
    scans.push_back(v.scan);
  }
};

const std::vector<int> around = {0, 45, 90, 135, 180, 225, 270, 315};

Set views_of(unsigned seed, const std::vector<int>& angles)
{
  Set set;
  for (const int a : angles) set.add(view(seed, a));
  return set;
}

// All scans of a component lie as in the scene, to so many degrees and sampling distances.
void check_poses(const Assembly& result, const Set& set, std::size_t component, double degrees = 0.3,
                 double distances = 0.6)
{
  std::size_t first = set.views.size();
  for (std::size_t i = 0; i < set.views.size(); ++i) {
    if (result.component(i) != component) continue;
    const Rigid_motion pose = to_rigid_motion(result.pose(i));
    if (first == set.views.size()) {
      first = i; // its frame is the component's
      BOOST_TEST((pose.rotation == Matrix::Identity()));
      BOOST_TEST(pose.translation.norm() == 0.);
      continue;
    }
    const Rigid_motion truth = true_motion(*set.views[i], *set.views[first]);
    BOOST_TEST(angle_between(pose, truth) < degrees);
    BOOST_TEST((pose(set.views[i]->centre) - truth(set.views[i]->centre)).norm() < distances * set.scans[i].spacing());
  }
}

void check_same_bits(const Assembly& a, const Assembly& b)
{
  BOOST_TEST_REQUIRE(a.number_of_scans() == b.number_of_scans());
  BOOST_TEST(a.number_of_components() == b.number_of_components());
  for (std::size_t i = 0; i < a.number_of_scans(); ++i) {
    BOOST_TEST(a.component(i) == b.component(i));
    const Rigid_motion m = to_rigid_motion(a.pose(i)), n = to_rigid_motion(b.pose(i));
    BOOST_TEST((m.rotation == n.rotation));
    BOOST_TEST((m.translation == n.translation));
    BOOST_TEST(a.scans()[i].residual == b.scans()[i].residual);
    BOOST_TEST((a.scans()[i].covariance == b.scans()[i].covariance));
  }
  BOOST_TEST_REQUIRE(a.edges().size() == b.edges().size());
  for (std::size_t i = 0; i < a.edges().size(); ++i) {
    BOOST_TEST(a.edges()[i].source == b.edges()[i].source);
    BOOST_TEST(a.edges()[i].target == b.edges()[i].target);
    BOOST_TEST(a.edges()[i].status == b.edges()[i].status);
    BOOST_TEST(a.edges()[i].reason == b.edges()[i].reason);
  }
}

} // namespace

BOOST_AUTO_TEST_CASE(views_around_a_body_are_one_model)
{
  const Set set = views_of(0, around);
  const Assembly result = CR::assemble_scans(set.scans);
  BOOST_TEST(result.number_of_components() == 1u);
  BOOST_TEST(!result.is_interrupted());
  check_poses(result, set, 0);
  // A tree takes seven edges; each edge is checked by a loop, and no more pairs were tried than six a scan.
  std::size_t used = 0;
  for (const auto& e : result.edges()) {
    BOOST_TEST(e.source < e.target);
    used += e.status == CR::USED;
    BOOST_TEST((e.status != CR::DROPPED || e.registration != CR::REGISTERED));
  }
  BOOST_TEST(used >= 8u);
  BOOST_TEST(result.edges().size() < 28u);
  for (std::size_t i = 0; i < set.scans.size(); ++i) {
    BOOST_TEST(result.scans()[i].reason.empty());
    BOOST_TEST(result.scans()[i].residual > 0);
    BOOST_TEST(result.scans()[i].residual < 1);
    for (std::size_t k = 0; k < 6; ++k) {
      BOOST_TEST((result.scans()[i].covariance[k][k] > 0) == (i > 0));
      for (std::size_t l = 0; l < k; ++l)
        BOOST_TEST(result.scans()[i].covariance[k][l] == result.scans()[i].covariance[l][k]);
    }
  }
  // Opposite views share nothing.
  for (const auto& o : result.overlaps()) {
    BOOST_TEST(o.overlap > 0);
    BOOST_TEST(o.overlap <= 1);
    BOOST_TEST((std::max(o.source, o.target) - std::min(o.source, o.target) != 4 || o.overlap < 0.1));
  }
}

BOOST_AUTO_TEST_CASE(fused_points_are_all_of_the_surfaces_and_nothing_else)
{
  const Set set = views_of(0, {0, 45, 90});
  const Assembly result = CR::assemble_scans(set.scans);
  BOOST_TEST_REQUIRE(result.number_of_components() == 1u);
  const auto fused = CR::fused_points(result, set.scans);
  std::vector<std::pair<Kernel::Point_3, Kernel::Vector_3>> all;
  double spacing = 0;
  for (std::size_t i = 0; i < set.scans.size(); ++i) {
    const std::vector<Kernel::Point_3> points = set.scans[i].points();
    const std::vector<Kernel::Vector_3> normals = set.scans[i].normals();
    for (std::size_t k = 0; k < points.size(); ++k)
      all.emplace_back(points[k].transform(result.pose(i)), normals[k].transform(result.pose(i)));
    spacing = (std::max)(spacing, 2 * set.scans[i].extent() / std::sqrt(double(points.size())));
  }
  const auto nearest = [](const auto& from, const auto& to, std::size_t step, auto check) {
    for (std::size_t i = 0; i < from.size(); i += step) {
      const auto* closest = &to.front();
      for (const auto& t : to)
        if (CGAL::squared_distance(t.first, from[i].first) < CGAL::squared_distance(closest->first, from[i].first))
          closest = &t;
      check(from[i], *closest);
    }
  };
  std::size_t looked_at = 0, near = 0, alike = 0;
  const auto count = [&](const auto& a, const auto& b) {
    ++looked_at;
    near += CGAL::squared_distance(a.first, b.first) < spacing * spacing;
    alike += a.second * b.second > 0.5;
    BOOST_TEST(std::abs(a.second.squared_length() - 1) < 1e-3);
  };
  nearest(fused, all, 7, count);
  nearest(all, fused, 7, count);
  BOOST_TEST(looked_at > 100u);
  BOOST_TEST(near == looked_at);
  BOOST_TEST(double(alike) > 0.95 * double(looked_at));
  BOOST_TEST(CR::fused_points(result, set.scans, 1).empty());
  BOOST_CHECK_THROW(CR::fused_points(result, {set.scans[0]}), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(the_order_of_the_scans_does_not_matter)
{
  const Set set = views_of(0, around);
  Set shuffled;
  for (const std::size_t i : {5u, 2u, 0u, 7u, 1u, 6u, 3u, 4u}) shuffled.add(*set.views[i]);
  const Assembly a = CR::assemble_scans(set.scans), b = CR::assemble_scans(shuffled.scans);
  BOOST_TEST(a.edges().size() == b.edges().size());
  BOOST_TEST(b.number_of_components() == 1u);
  const auto pose = [](const Assembly& result, const Set& s, const View* v) {
    const auto i = std::find(s.views.begin(), s.views.end(), v) - s.views.begin();
    return to_rigid_motion(result.pose(std::size_t(i)));
  };
  for (const View* v : set.views) {
    // Both relative to the same view.
    const Rigid_motion m = pose(a, set, set.views[0]).inverse() * pose(a, set, v),
                       n = pose(b, shuffled, set.views[0]).inverse() * pose(b, shuffled, v);
    BOOST_TEST(difference(m, n, v->centre) < 0.02 * v->scan.spacing());
  }
}

BOOST_AUTO_TEST_CASE(two_bodies_are_two_components_and_a_foreign_scan_is_alone)
{
  Set set;
  for (const int a : {0, 45, 90}) {
    set.add(view(0, a));
    set.add(view(1, a));
  }
  set.add(view(2, 45));
  const Assembly result = CR::assemble_scans(set.scans);
  BOOST_TEST(result.number_of_components() == 3u);
  for (std::size_t i = 0; i < 6; ++i) BOOST_TEST(result.component(i) == i % 2);
  BOOST_TEST(result.component(6) == 2u);
  // However often a scan was tried, alone and as part of a surface.
  std::set<std::size_t> tried;
  for (const auto& e : result.edges()) {
    if (e.source == 6) tried.insert(e.target);
    if (e.target == 6) tried.insert(e.source);
  }
  BOOST_TEST(result.scans()[6].reason ==
             "no overlap found with any of the " + std::to_string(tried.size()) + " scans tried");
  for (const std::size_t c : {0u, 1u}) check_poses(result, set, c, 0.5, 1);
}

BOOST_AUTO_TEST_CASE(the_same_bits_by_several_threads)
{
#ifdef CGAL_LINKED_WITH_TBB
  const Set set = views_of(0, {0, 45, 90, 135, 180});
  const Assembly alone = CR::assemble_scans(set.scans);
  for (const std::size_t threads : {1u, 3u}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    check_same_bits(alone, CR::assemble_scans<CGAL::Parallel_tag>(set.scans));
  }
#else
  std::cout << "TBB: not tested, it was not found\n";
#endif
}

BOOST_AUTO_TEST_CASE(few_scans)
{
  const Assembly none = CR::assemble_scans(std::vector<Scan>());
  BOOST_TEST(none.number_of_scans() == 0u);
  BOOST_TEST(none.number_of_components() == 0u);
  const Set one = views_of(0, {0});
  const Assembly single = CR::assemble_scans(one.scans);
  BOOST_TEST(single.number_of_components() == 1u);
  BOOST_TEST(single.scans()[0].reason == "there is no other scan");
  check_poses(single, one, 0);
  const Set two = views_of(0, {0, 45});
  const Assembly pair = CR::assemble_scans(two.scans);
  BOOST_TEST(pair.number_of_components() == 1u);
  check_poses(pair, two, 0);
  const Assembly same = CR::assemble_scans(std::vector<Scan>(3, one.scans[0])); // one scan three times
  BOOST_TEST(same.number_of_components() == 1u);
  for (std::size_t i = 0; i < 3; ++i)
    BOOST_TEST(difference(to_rigid_motion(same.pose(i)), Rigid_motion(), one.views[0]->centre) <
               0.02 * one.scans[0].spacing());
}

BOOST_AUTO_TEST_CASE(a_run_that_is_ended_says_so)
{
  const Set set = views_of(0, {0, 45, 90});
  Impatient visitor(1, 3);
  const Assembly result = CR::assemble_scans(set.scans, CR::parameters::visitor(std::ref(visitor)));
  BOOST_TEST(result.is_interrupted());
  BOOST_TEST(visitor.is_monotone);
  BOOST_TEST(visitor.is_share);
  BOOST_TEST(result.number_of_components() == 3u);
  for (const auto& s : result.scans()) BOOST_TEST(!s.reason.empty());
  BOOST_CHECK_THROW(CR::assemble_scans(set.scans, CR::parameters::time_budget(-1)), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(a_store_keeps_what_was_registered)
{
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / "test_assemble_scans_store";
  fs::remove_all(folder);
  const auto store = CR::parameters::store(folder.string());
  const Set few = views_of(0, {0, 45, 90}), set = views_of(0, {0, 45, 90, 135});
  const Assembly plain = CR::assemble_scans(set.scans);
  // A run that is ended keeps what it has done, whole.
  Impatient visitor(1, 10);
  BOOST_TEST(CR::assemble_scans(set.scans, store.visitor(std::ref(visitor))).is_interrupted());
  check_same_bits(plain, CR::assemble_scans(set.scans, store));
  std::map<std::string, fs::file_time_type> times;
  const auto files = [&] {
    std::vector<fs::path> paths;
    for (const auto& entry : fs::directory_iterator(folder)) paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    return paths;
  };
  const std::vector<fs::path> first = files();
  BOOST_TEST(first.size() == plain.edges().size());
  for (const fs::path& path : first) times[path.string()] = fs::last_write_time(path);
  // One is lost, one is cut short: these two are registered again, and no other.
  fs::remove(first[0]);
  fs::resize_file(first[1], fs::file_size(first[1]) / 2);
  check_same_bits(plain, CR::assemble_scans(set.scans, store));
  BOOST_TEST((files() == first));
  for (std::size_t k = 2; k < first.size(); ++k)
    BOOST_TEST((fs::last_write_time(first[k]) == times[first[k].string()]));
  BOOST_TEST((fs::last_write_time(first[1]) != times[first[1].string()]));
  // A run of some of the scans uses what is there.
  CR::assemble_scans(few.scans, store);
  BOOST_TEST((files() == first));
  fs::remove_all(folder);
  std::ofstream(folder) << "no folder";
  BOOST_CHECK_THROW(CR::assemble_scans(set.scans, store), CR::IO_error);
  fs::remove(folder);
}

// Pairs that say what they are told to, of scans in the frame of the scene.
namespace {

struct Told
{
  const Set& set;
  std::vector<Rigid_motion> scene_from_scan;
  std::map<std::pair<std::size_t, std::size_t>, CR::internal::Pair_answer> answers; // of the others: the truth
  std::set<std::pair<std::size_t, std::size_t>> asked;

  explicit Told(const Set& s) : set(s)
  {
    for (const View* v : s.views) scene_from_scan.push_back(v->scene_from_scan);
  }

  Rigid_motion truth(std::size_t i, std::size_t j) const { return scene_from_scan[j].inverse() * scene_from_scan[i]; }

  CR::internal::Pair_answer operator()(std::size_t i, std::size_t j)
  {
    asked.insert({std::min(i, j), std::max(i, j)});
    const auto told = answers.find({std::min(i, j), std::max(i, j)});
    if (told != answers.end()) {
      CR::internal::Pair_answer answer = told->second;
      if (i > j)
        for (auto& m : answer.motions) m.motion = m.motion.inverse();
      return answer;
    }
    CR::internal::Pair_answer answer;
    const double turn = angle_between(scene_from_scan[i], scene_from_scan[j]);
    if (turn > 100) return answer;
    answer.status = CR::REGISTERED;
    answer.overlap = 1 - turn / 120;
    answer.motions = {{truth(i, j), 0.97}};
    return answer;
  }

  CR::internal::Assembly_outcome assemble(const CR::internal::Known_poses& known = {})
  {
    std::vector<const CR::internal::Reduced_scan*> reduced;
    for (const Scan& s : set.scans) reduced.push_back(&s.reduced());
    CR::internal::Run_control control;
    return CR::internal::assemble_reduced_scans(
        reduced, [&](std::size_t i, std::size_t j, CR::internal::Run_control&) { return (*this)(i, j); }, {},
        CR::internal::Execution::SEQUENTIAL, control, known);
  }

  const CR::internal::Assembly_edge* edge(const CR::internal::Assembly_outcome& outcome, std::size_t i,
                                          std::size_t j) const
  {
    for (const auto& e : outcome.edges)
      if (e.source == i && e.target == j) return &e;
    return nullptr;
  }

  void check(const CR::internal::Assembly_outcome& outcome) const
  {
    BOOST_TEST_REQUIRE(outcome.number_of_components == 1u);
    for (std::size_t i = 1; i < set.scans.size(); ++i)
      BOOST_TEST(difference(outcome.poses[i], truth(i, 0), set.views[i]->centre) < 2 * set.scans[i].spacing());
  }
};

Rigid_motion turned(const Rigid_motion& motion, double degrees)
{
  Rigid_motion turn;
  turn.rotation = Eigen::AngleAxisd(degrees * pi / 180, Vector(0, 0, 1)).toRotationMatrix();
  return motion * turn;
}

} // namespace

BOOST_AUTO_TEST_CASE(a_wrong_pair_is_dropped_and_named)
{
  const Set set = views_of(0, around);
  for (const auto& [i, j] : {std::pair(0u, 1u), std::pair(2u, 4u)}) {
    Told told(set);
    CR::internal::Pair_answer& wrong = told.answers[{i, j}];
    wrong.status = CR::REGISTERED;
    wrong.overlap = 0.95; // what is joined first
    wrong.motions = {{turned(told.truth(i, j), 60), 0.98}};
    const auto outcome = told.assemble();
    told.check(outcome);
    const auto* edge = told.edge(outcome, i, j);
    if (edge) {
      BOOST_TEST(edge->status == CR::DROPPED);
      BOOST_TEST(!edge->reason.empty());
    }
  }
}

BOOST_AUTO_TEST_CASE(a_loop_decides_among_the_motions_of_an_ambiguous_pair)
{
  const Set set = views_of(0, {0, 45, 90});
  Told told(set);
  for (const auto& [i, j] : {std::pair(0u, 2u), std::pair(1u, 2u)}) {
    // Three motions, of which the wrong ones differ from pair to pair.
    CR::internal::Pair_answer& answer = told.answers[{i, j}];
    answer.status = CR::AMBIGUOUS;
    answer.overlap = 0.5;
    answer.motions = {{turned(told.truth(i, j), i == 0 ? 90 : 120), 0.33},
                      {told.truth(i, j), 0.32},
                      {turned(told.truth(i, j), 200), 0.3}};
  }
  const auto outcome = told.assemble();
  told.check(outcome);
  BOOST_TEST(told.edge(outcome, 0, 2)->status == CR::USED);
  BOOST_TEST(told.edge(outcome, 0, 2)->reason == "decided by the other scans");
}

BOOST_AUTO_TEST_CASE(what_nothing_decides_stays_apart)
{
  const Set set = views_of(0, {0, 45, 180});
  Told told(set);
  for (const std::size_t i : {0u, 1u}) {
    CR::internal::Pair_answer& answer = told.answers[{i, 2u}];
    answer = {};
    if (i == 1) {
      answer.status = CR::AMBIGUOUS;
      answer.reason = "several distinct motions";
      answer.motions = {{told.truth(i, 2), 0.3}, {turned(told.truth(i, 2), 20), 0.3}};
    }
  }
  const auto outcome = told.assemble();
  BOOST_TEST(outcome.number_of_components == 2u);
  BOOST_TEST(outcome.components[2] == 1u);
  BOOST_TEST(told.edge(outcome, 1, 2)->status == CR::NOT_CONNECTING);
  BOOST_TEST(!outcome.reasons[2].empty());
}

namespace {

// The poses of the scans in the scene, the z axis of each turned by so much.
CR::internal::Known_poses hints_of(const Told& told, double degrees)
{
  CR::internal::Known_poses known;
  for (std::size_t i = 0; i < told.scene_from_scan.size(); ++i)
    known.poses.push_back(
        CR::internal::Known_pose{0, turned(told.scene_from_scan[i], i % 2 == 0 ? degrees : -degrees)});
  return known;
}

// A third scan that no pair places: two motions are left open.
Told undecided(const Set& set)
{
  Told told(set);
  told.answers[{0, 2}] = {};
  CR::internal::Pair_answer& answer = told.answers[{1, 2}];
  answer.status = CR::AMBIGUOUS;
  answer.overlap = 0.5;
  answer.motions = {{turned(told.truth(1, 2), 90), 0.4}, {told.truth(1, 2), 0.35}};
  return told;
}

} // namespace

BOOST_AUTO_TEST_CASE(hints_decide_what_pairs_leave_open_and_nothing_else)
{
  const Set set = views_of(0, {0, 45, 90}), all = views_of(0, around);
  BOOST_TEST(undecided(set).assemble().number_of_components == 2u);
  Told told = undecided(set);
  told.check(told.assemble(hints_of(told, 5)));
  // By a hint alone nothing is placed.
  told.answers[{1, 2}] = {};
  BOOST_TEST(told.assemble(hints_of(told, 0)).number_of_components == 2u);
  // Hints that are wrong throughout change nothing.
  Told others(all);
  others.check(others.assemble(hints_of(others, 80)));
}

BOOST_AUTO_TEST_CASE(a_hint_that_is_wrong_is_dropped_and_named)
{
  const Set set = views_of(0, around);
  for (const std::size_t wrong : {0u, 5u}) {
    Told told(set);
    CR::internal::Known_poses known = hints_of(told, 5);
    known.poses[wrong]->motion = turned(known.poses[wrong]->motion, 100);
    known.poses[3].reset();
    const auto outcome = told.assemble(known);
    told.check(outcome);
    for (std::size_t i = 0; i < set.scans.size(); ++i) BOOST_TEST(outcome.lost_hints[i].empty() == (i != wrong));
  }
  // Of two that contradict each other nothing tells which is wrong; one alone says nothing; what is fixed is no hint.
  Told told(set);
  CR::internal::Known_poses known;
  known.poses.resize(set.scans.size());
  known.poses[1] = CR::internal::Known_pose{0, told.scene_from_scan[1]};
  known.poses[2] = CR::internal::Known_pose{0, turned(told.scene_from_scan[2], 100)};
  known.poses[6] = CR::internal::Known_pose{1, told.scene_from_scan[6]};
  const auto outcome = told.assemble(known);
  told.check(outcome);
  for (std::size_t i = 0; i < set.scans.size(); ++i) BOOST_TEST(outcome.lost_hints[i].empty() == (i != 1 && i != 2));
  known.are_fixed = true;
  for (const std::string& text : told.assemble(known).lost_hints) BOOST_TEST(text.empty());
}

BOOST_AUTO_TEST_CASE(fixed_poses_stay_and_give_the_frame)
{
  const Set set = views_of(0, around);
  Told told(set);
  CR::internal::Known_poses known = hints_of(told, 0.5);
  known.are_fixed = true;
  for (const std::size_t i : {0u, 3u, 6u}) known.poses[i].reset();
  for (const std::size_t i : {4u, 7u}) known.poses[i]->group = 1;
  const auto outcome = told.assemble(known);
  BOOST_TEST_REQUIRE(outcome.number_of_components == 1u);
  for (const std::size_t i : {1u, 2u, 5u}) {
    BOOST_TEST((outcome.poses[i].rotation == known.poses[i]->motion.rotation));
    BOOST_TEST((outcome.poses[i].translation == known.poses[i]->motion.translation));
    BOOST_TEST(outcome.covariances[i].isZero());
  }
  // The other group is moved as a whole.
  const Rigid_motion there = outcome.poses[4].inverse() * outcome.poses[7],
                     given = known.poses[4]->motion.inverse() * known.poses[7]->motion;
  BOOST_TEST(difference(there, given, set.views[7]->centre) < 1e-9);
  for (const std::size_t i : {0u, 3u, 4u, 6u, 7u})
    BOOST_TEST(difference(outcome.poses[i], told.scene_from_scan[i], set.views[i]->centre) <
               8 * set.scans[i].spacing());
  for (const auto& group : {std::vector<std::size_t>{1, 2, 5}, std::vector<std::size_t>{4, 7}})
    for (const std::size_t i : group)
      for (const std::size_t j : group) BOOST_TEST(told.asked.count({i, j}) == 0u);
}

BOOST_AUTO_TEST_CASE(known_poses_as_parameters)
{
  const Set set = views_of(0, {0, 45, 90});
  const Assembly result = CR::assemble_scans(set.scans, CR::parameters::reference_scan(1));
  BOOST_TEST(result.number_of_components() == 1u);
  BOOST_TEST((to_rigid_motion(result.pose(1)).rotation == Matrix::Identity()));
  for (const std::size_t i : {0u, 2u})
    BOOST_TEST(difference(to_rigid_motion(result.pose(i)), true_motion(*set.views[i], *set.views[1]),
                          set.views[i]->centre) < 2 * set.scans[i].spacing());
  std::vector<std::optional<Kernel::Aff_transformation_3>> known(3);
  known[2] = CR::internal::to_aff_transformation<Kernel>(set.views[2]->scene_from_scan);
  const Assembly placed = CR::assemble_scans(set.scans, CR::parameters::known_poses(known).known_poses_are_fixed(true));
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 4; ++c) BOOST_TEST(placed.pose(2).m(r, c) == known[2]->m(r, c));
  for (std::size_t i = 0; i < 3; ++i)
    BOOST_TEST(difference(to_rigid_motion(placed.pose(i)), set.views[i]->scene_from_scan, set.views[i]->centre) <
               2 * set.scans[i].spacing());
  BOOST_CHECK_THROW(CR::assemble_scans(set.scans, CR::parameters::reference_scan(3)), std::invalid_argument);
  known.pop_back();
  BOOST_CHECK_THROW(CR::assemble_scans(set.scans, CR::parameters::known_poses(known)), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(bridges_of_graphs)
{
  using CR::internal::Scan_pair;
  // By what is left when each edge is taken away.
  const auto parts = [](std::size_t n, const std::vector<Scan_pair>& edges, std::size_t without) {
    std::vector<std::size_t> part(n);
    for (std::size_t i = 0; i < n; ++i) part[i] = i;
    for (std::size_t round = 0; round < n; ++round)
      for (std::size_t e = 0; e < edges.size(); ++e)
        if (e != without)
          part[edges[e].first] = part[edges[e].second] = std::min(part[edges[e].first], part[edges[e].second]);
    return std::set<std::size_t>(part.begin(), part.end()).size();
  };
  generated::Random random(7);
  for (int k = 0; k < 200; ++k) {
    const std::size_t n = 2 + std::size_t(3.5 * (random.symmetric() + 1));
    std::vector<Scan_pair> edges;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 1; j < n; ++j)
        if (random.symmetric() < -0.3) edges.push_back({i, j});
    std::vector<std::size_t> expected;
    for (std::size_t e = 0; e < edges.size(); ++e)
      if (parts(n, edges, e) > parts(n, edges, edges.size())) expected.push_back(e);
    BOOST_TEST(CR::internal::bridges(n, edges) == expected, boost::test_tools::per_element());
  }
}
