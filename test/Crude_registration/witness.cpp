// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// The witnesses of pairs of oriented points: which surfels they are, and what has a counterpart of them.

#define BOOST_TEST_MODULE witness
#include <boost/test/unit_test.hpp>

#include "statue_views.h"

#include <CGAL/Crude_registration/internal/matching/Witness.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

using namespace CGAL::Crude_registration::internal;

namespace {

Point_grid grid_of(const Surfel_level& level)
{
  std::vector<Vector> points;
  for (const Surfel& s : level.surfels) points.push_back(s.position.cast<double>());
  return Point_grid(points, 2 * double(level.spacing));
}

// Pairs of a level whose surfels are further apart than a spacing, with a line that is along neither normal.
std::vector<Surfel_pair_index::Entry> some_pairs(const Surfel_level& level, std::size_t n, unsigned seed)
{
  generated::Random random(seed);
  const auto n_surfels = double(level.surfels.size());
  const auto any = [&] {
    return (std::min)(level.surfels.size() - 1, std::size_t((random.symmetric() + 1) / 2 * n_surfels));
  };
  std::vector<Surfel_pair_index::Entry> pairs;
  while (pairs.size() < n) {
    const std::size_t i = any(), j = any();
    Pair_angles angles;
    if ((level.surfels[i].position - level.surfels[j].position).norm() > level.spacing &&
        pair_angles(level.surfels[i], level.surfels[j], angles))
      pairs.push_back({{}, std::uint16_t(i), std::uint16_t(j)});
  }
  return pairs;
}

} // namespace

BOOST_AUTO_TEST_CASE(witnesses_are_around_the_pair_and_on_either_side_of_its_line)
{
  const Surfel_level& level = view(1, 0).scan.reduced().coarse;
  const Point_grid grid = grid_of(level);
  std::size_t chosen = 0;
  for (const auto& p : some_pairs(level, 100, 1)) {
    const Surfel &a = level.surfels[p.first], &b = level.surfels[p.second];
    const float reach = 6 * level.spacing;
    std::vector<Witness> witnesses;
    if (!choose_witnesses(level, grid, p.first, p.second, reach, 16, witnesses)) continue;
    ++chosen;
    BOOST_TEST_REQUIRE(witnesses.size() == 16u);
    const Matrix frame = pair_frame(a, b).cast<double>();
    const Vector middle = (a.position.cast<double>() + b.position.cast<double>()) / 2, line = frame.col(0);
    const auto arm = [&](const Witness& w) {
      const Vector place = frame * w.position.cast<double>(); // from the middle
      return Vector(place - place.dot(line) * line);
    };
    double furthest = 0, opposite = std::numeric_limits<double>::lowest(); // of the others
    for (const Witness& w : witnesses) {
      const Vector place = frame * w.position.cast<double>() + middle, normal = frame * w.normal.cast<double>();
      BOOST_TEST((place - middle).norm() <= (1 + 1e-5) * double(reach));
      // A surfel of the scan, with its normal.
      BOOST_TEST(std::any_of(level.surfels.begin(), level.surfels.end(), [&](const Surfel& s) {
        return (s.position.cast<double>() - place).norm() < 1e-4 * double(level.spacing) &&
               (s.normal.cast<double>() - normal).norm() < 1e-4;
      }));
      furthest = (std::max)(furthest, arm(w).norm());
      if (&w != &witnesses.front()) opposite = (std::max)(opposite, -arm(w).dot(arm(witnesses[0]).normalized()));
    }
    BOOST_TEST(arm(witnesses[0]).norm() > (1 - 1e-5) * furthest);
    BOOST_TEST(-arm(witnesses[1]).dot(arm(witnesses[0]).normalized()) > opposite - 1e-5 * double(reach));
  }
  BOOST_TEST(chosen > 50u);
}

// A scan's pair in itself: each witness is where it is. In a frame that is turned about the line by half a turn hardly
// any has a counterpart.
BOOST_AUTO_TEST_CASE(a_scan_has_the_counterparts_of_its_own_witnesses)
{
  const Surfel_level& level = view(1, 0).scan.reduced().coarse;
  const Point_grid grid = grid_of(level);
  const Witness_tolerance tolerance{0.8f * level.spacing, 0.75f};
  std::size_t n = 0, found = 0, turned = 0;
  for (const auto& p : some_pairs(level, 100, 2)) {
    std::vector<Witness> witnesses;
    if (!choose_witnesses(level, grid, p.first, p.second, 6 * level.spacing, 16, witnesses)) continue;
    const Surfel &a = level.surfels[p.first], &b = level.surfels[p.second];
    const Vector_f middle = 0.5f * (a.position + b.position);
    const Matrix_f frame = pair_frame(a, b);
    Matrix_f half_turn = frame;
    half_turn.col(1) *= -1;
    half_turn.col(2) *= -1;
    for (const Witness& w : witnesses) {
      ++n;
      found += has_counterpart(w, {frame, middle}, level, tolerance);
      turned += has_counterpart(w, {half_turn, middle}, level, tolerance);
    }
  }
  BOOST_TEST(n > 800u);
  BOOST_TEST(found >= n - n / 100); // but for what is at the border of a voxel
  BOOST_TEST(turned < n / 20);
}

// Pairs at a time, whole blocks and parts of one, have the counterparts that each has alone; those with opposite
// normals, whose frames are others, too.
BOOST_AUTO_TEST_CASE(many_pairs_at_a_time_are_as_one_by_one)
{
  const Surfel_level& source = view(1, 0).scan.reduced().coarse;
  Surfel_level target = view(1, 45).scan.reduced().coarse;
  for (std::size_t i = 0; i < target.surfels.size(); i += 3) target.surfels[i].normal *= -1;
  const Point_grid grid = grid_of(source);
  const Witness_tolerance tolerance{0.8f * target.spacing, 0.75f};
  constexpr std::size_t most = Pairs_with_counterpart::most;
  std::array<Pairs_with_counterpart::Found_pair, most> found_pairs;
  std::size_t found = 0, opposite = 0;
  unsigned seed = 10;
  for (const auto& p : some_pairs(source, 60, 3)) {
    std::vector<Witness> witnesses;
    if (!choose_witnesses(source, grid, p.first, p.second, 6 * source.spacing, 16, witnesses)) continue;
    Pairs_with_counterpart together(witnesses.front(), target, tolerance);
    for (const std::size_t n : {most, std::size_t(17), std::size_t(1), std::size_t(0), most}) {
      const std::vector<Surfel_pair_index::Entry> pairs = some_pairs(target, n, ++seed);
      std::array<Surfel_pair_index::Entry, most> block{};
      std::copy(pairs.begin(), pairs.end(), block.begin());
      const std::size_t left = together.find(block, n, found_pairs);
      std::size_t next = 0;
      for (const auto& q : pairs) {
        const Surfel &a = target.surfels[q.first], &b = target.surfels[q.second];
        const Pose place{pair_frame(a, b), 0.5f * (a.position + b.position)};
        if (!has_counterpart(witnesses.front(), place, target, tolerance)) continue;
        BOOST_TEST_REQUIRE(next < left);
        const Pairs_with_counterpart::Found_pair& f = found_pairs[next];
        BOOST_TEST((f.pair.first == q.first && f.pair.second == q.second));
        BOOST_TEST((f.place.rotation - place.rotation).norm() < 1e-6);
        BOOST_TEST((f.place.translation - place.translation).norm() < 1e-6 * double(target.spacing));
        ++next;
        ++found;
        const Vector line = (b.position - a.position).cast<double>().normalized(),
                     sum = (a.normal + b.normal).cast<double>();
        opposite += (sum - sum.dot(line) * line).squaredNorm() < 0.99 * double(opposite_normals);
      }
      BOOST_TEST(next == left);
    }
  }
  BOOST_TEST(found > 100u);
  BOOST_TEST(opposite > 3u);
}

// So many of the witnesses of a pair have a counterpart as one by one, whatever their number, and whichever number is
// asked for.
BOOST_AUTO_TEST_CASE(rows_of_witnesses_are_as_one_by_one)
{
  const Surfel_level& source = view(1, 0).scan.reduced().coarse;
  const Surfel_level& target = view(1, 45).scan.reduced().coarse;
  const Point_grid grid = grid_of(source);
  const Witness_tolerance tolerance{0.8f * target.spacing, 0.75f};
  std::array<std::size_t, 2> answers{}; // no, yes
  unsigned seed = 100;
  for (const auto& p : some_pairs(source, 60, 4)) {
    std::vector<Witness> witnesses;
    const int number = 3 + int(seed % 20);
    if (!choose_witnesses(source, grid, p.first, p.second, 6 * source.spacing, number, witnesses)) continue;
    const Witness_rows rows(witnesses, 2);
    for (const auto& q : some_pairs(target, 20, ++seed)) {
      const Surfel &a = target.surfels[q.first], &b = target.surfels[q.second];
      const Pose place{pair_frame(a, b), 0.5f * (a.position + b.position)};
      const auto found = int(std::count_if(witnesses.begin() + 2, witnesses.end(), [&](const Witness& w) {
        return has_counterpart(w, place, target, tolerance);
      }));
      for (int needed = -1; needed < number; ++needed) {
        const bool is_so = rows.have_counterparts(needed, place, target, tolerance);
        BOOST_TEST_REQUIRE(is_so == (found >= needed));
        ++answers[std::size_t(is_so)];
      }
    }
  }
  BOOST_TEST(answers[0] > 100u);
  BOOST_TEST(answers[1] > 100u);
}
