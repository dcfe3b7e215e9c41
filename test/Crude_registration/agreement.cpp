// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// How a pose explains two scans, a row of probes at a time: against one probe after the other.

#define BOOST_TEST_MODULE agreement
#include <boost/test/unit_test.hpp>

#include "statue_views.h"

#include <CGAL/Crude_registration/internal/judgement/agreement.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

using namespace CGAL::Crude_registration::internal;

namespace {

struct Input
{
  const Reduced_scan &source, &target;
  Pose pose;
};

// The true pose of two views, moved by some spacings, and turned.
Input moved_views(unsigned seed, int degrees, generated::Random& random, double by)
{
  const View &source = view(seed, 0), &target = view(seed, degrees);
  const Rigid_motion truth = target.scan.reduced().own_from_input * true_motion(source, target) *
                             source.scan.reduced().own_from_input.inverse();
  Rigid_motion off;
  off.translation = by * double(source.scan.reduced().coarse.spacing) * random.vector();
  off.rotation = Eigen::AngleAxisd(0.1 * by, random.vector().normalized()).toRotationMatrix();
  return {source.scan.reduced(), target.scan.reduced(), to_pose(off * truth)};
}

// The same by one probe after the other.
Agreement agreement_one_by_one(const Input& in, const std::vector<Surfel>& of_source,
                               const std::vector<Surfel>& of_target, const Look& look)
{
  std::size_t agreeing = 0, before_target = 0, before_source = 0;
  for (const Surfel& s : of_source) {
    const Vector_f p = in.pose(s.position);
    const int j = in.target.coarse.field.nearest(p);
    bool agrees = false;
    if (j >= 0) {
      const Surfel& t = in.target.coarse.surfels[std::size_t(j)];
      agrees = std::abs(t.normal.dot(p - t.position)) <= look.distance &&
               (in.pose.rotation * s.normal).dot(t.normal) >= look.minimal_cosine;
    }
    agreeing += agrees;
    before_target += !agrees && in.target.depths.in_front(p) > look.free_depth;
  }
  for (const Surfel& t : of_target)
    before_source += in.source.depths.in_front(in.pose.inverse()(t.position)) > look.free_depth;
  Agreement a;
  a.overlap = float(agreeing) / float(of_source.size());
  a.violations = float(before_target) / float(of_source.size()) + float(before_source) / float(of_target.size());
  return a;
}

std::vector<Surfel> part(const Probes& probes, std::size_t from, std::size_t n)
{
  const auto first = probes.begin() + std::ptrdiff_t(from % (probes.size() - n + 1));
  return {first, first + std::ptrdiff_t(n)};
}

Look look_of(const Input& in)
{
  const float spacing = in.target.coarse.spacing;
  return {0.8f * spacing, 0.75f, 1.2f * spacing};
}

} // namespace

BOOST_AUTO_TEST_CASE(rows_of_probes_are_as_one_by_one)
{
  generated::Random random(1);
  float least = 1, greatest = 0, violations = 0;
  for (int i = 0; i < 40; ++i) {
    const Input in = moved_views(1 + unsigned(i % 2), 45, random, 0.2 * i);
    const Probes of_source = ordered_probes(in.source.coarse), of_target = ordered_probes(in.target.coarse);
    for (const std::size_t n : {1u, 7u, 8u, 12u, 40u, 100u}) {
      const std::size_t from = std::size_t(i) * 97;
      const Agreement rows = agreement(in.source, Some_probes(of_source, from, n), in.target,
                                       Some_probes(of_target, from, n), in.target.coarse, in.pose, look_of(in));
      const Agreement alone = agreement_one_by_one(in, part(of_source, from, n), part(of_target, from, n), look_of(in));
      BOOST_TEST(rows.overlap == alone.overlap);
      BOOST_TEST(rows.violations == alone.violations);
      if (n < 100) continue;
      least = (std::min)(least, rows.overlap);
      greatest = (std::max)(greatest, rows.overlap);
      violations = (std::max)(violations, rows.violations);
    }
  }
  // Of all kinds.
  BOOST_TEST(least < 0.3f);
  BOOST_TEST(greatest > 0.6f);
  BOOST_TEST(violations > 0.1f);
}

// What ends early is worse than what is asked for, and nothing else does.
BOOST_AUTO_TEST_CASE(only_worse_poses_end_early)
{
  generated::Random random(2);
  std::size_t worse = 0, better = 0;
  for (int i = 0; i < 40; ++i) {
    const Input in = moved_views(1, 45, random, 0.2 * i);
    const Probes of_source = ordered_probes(in.source.coarse), of_target = ordered_probes(in.target.coarse);
    const auto score = [&](float least) {
      return agreement(in.source, Some_probes(of_source, 0, 100), in.target, Some_probes(of_target, 0, 100),
                       in.target.coarse, in.pose, look_of(in), least)
          .score();
    };
    const float whole = score(std::numeric_limits<float>::lowest());
    BOOST_TEST(score(whole) == whole);
    for (float least = -1; least < 1; least += 0.0625f) {
      const float told = score(least);
      if (whole >= least) BOOST_TEST(told == whole);
      else BOOST_TEST(told < least);
      ++(whole >= least ? better : worse);
    }
  }
  BOOST_TEST(worse > 100u);
  BOOST_TEST(better > 100u);
}

// Of all probes, where there are fewer than are asked for.
BOOST_AUTO_TEST_CASE(some_probes_are_in_a_row)
{
  std::vector<Surfel> surfels(11);
  for (std::size_t i = 0; i < surfels.size(); ++i) surfels[i].position = {float(i), 0, 0};
  const Probes probes(surfels);
  for (const std::size_t n : {1u, 4u, 11u, 20u})
    for (std::size_t from = 0; from < 30; ++from) {
      const Some_probes some(probes, from, n);
      BOOST_TEST(some.number == (std::min)(n, surfels.size()));
      BOOST_TEST(some.first + some.number <= surfels.size());
      BOOST_TEST(probes.positions(some.first)[0][0] == float(some.first));
      if (n < surfels.size()) BOOST_TEST(some.first == from % (surfels.size() - n + 1));
    }
  BOOST_TEST(Some_probes(Probes({}), 3, 5).number == 0u);
}

BOOST_AUTO_TEST_CASE(what_is_nearest_to_a_row_of_places_is_nearest_to_each)
{
  const Surfel_level& level = view(1, 0).scan.reduced().coarse;
  generated::Random random(3);
  const float not_a_number = std::numeric_limits<float>::quiet_NaN(), huge = 1e30f;
  std::size_t found = 0;
  for (int i = 0; i < 2000; ++i) {
    std::array<Vector_f, row_size> places;
    for (Vector_f& p : places)
      p = level.surfels[std::size_t(i) % level.surfels.size()].position +
          2 * level.spacing * random.vector().cast<float>();
    places[std::size_t(i) % row_size][i % 3] = i % 2 == 0 ? not_a_number : huge;
    places[std::size_t(i + 1) % row_size][i % 3] = -huge;
    Rows rows;
    for (int k = 0; k < row_size; ++k)
      for (std::size_t axis = 0; axis < 3; ++axis) rows[axis][k] = places[std::size_t(k)][Eigen::Index(axis)];
    const Index_row nearest = level.field.nearest(rows);
    for (int k = 0; k < row_size; ++k) {
      BOOST_TEST_REQUIRE(nearest[k] == level.field.nearest(places[std::size_t(k)]));
      found += nearest[k] >= 0;
    }
  }
  BOOST_TEST(found > 1000u);
}
