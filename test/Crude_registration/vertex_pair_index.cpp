// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#define BOOST_TEST_MODULE vertex_pair_index
#include <boost/test/unit_test.hpp>

#include <CGAL/Crude_registration/internal/lookup/Near_points.h>
#include <CGAL/Crude_registration/internal/lookup/Packed_ranges.h>
#include <CGAL/Crude_registration/internal/lookup/Point_grid.h>
#include <CGAL/Crude_registration/internal/lookup/Vertex_pair_index.h>

#include "generated_surfaces.h"
#include "wrong_use.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace CR = CGAL::Crude_registration;
using CR::internal::Vector;
using CR::internal::Vertex_pair_descriptor;
using CR::internal::Vertex_pair_index;
using CR::internal::Vertex_pair_tolerance;
using generated::pi;

namespace {

using Pair = std::pair<std::int32_t, std::int32_t>;

struct Cloud
{
  std::vector<Vector> points, normals;
};

Cloud random_cloud(std::size_t n, unsigned seed)
{
  generated::Random random(seed);
  Cloud cloud;
  while (cloud.points.size() < n) {
    const Vector normal = random.vector();
    if (normal.norm() < 0.1) continue;
    cloud.points.push_back(random.vector());
    cloud.normals.push_back(normal.normalized());
  }
  return cloud;
}

std::set<Pair> found(const Vertex_pair_index& index, const Vertex_pair_descriptor& d, const Vertex_pair_tolerance& t)
{
  std::set<Pair> result;
  std::size_t count = 0;
  index.for_each_match(d, t, [&](const Vertex_pair_index::Pair& p) {
    result.insert({p.first, p.second});
    ++count;
  });
  BOOST_TEST(count == result.size()); // none twice
  BOOST_TEST(index.number_of_looks(d, t) >= count);
  return result;
}

// A tolerance and a share of it, and of what is measured, more.
Vertex_pair_tolerance changed(const Vertex_pair_descriptor& d, const Vertex_pair_tolerance& t, float by)
{
  return {t.length + by * (t.length + d.length), t.angle + by * (t.angle + 1), t.turn + by * (t.turn + 1)};
}

// All pairs, one by one.
std::set<Pair> expected(const Cloud& cloud, double least, double most, const Vertex_pair_descriptor& d,
                        const Vertex_pair_tolerance& t)
{
  std::set<Pair> result;
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
    for (std::size_t j = 0; j < cloud.points.size(); ++j) {
      if (i == j || cloud.normals[i].isZero() || cloud.normals[j].isZero()) continue;
      const double length = (cloud.points[i] - cloud.points[j]).norm();
      if (length < least || length > most) continue;
      if (Vertex_pair_index::agree(
              d, Vertex_pair_index::describe(cloud.points[i], cloud.normals[i], cloud.points[j], cloud.normals[j]), t))
        result.insert({std::int32_t(i), std::int32_t(j)});
    }
  return result;
}

Vertex_pair_descriptor of_pair(const Cloud& c, std::size_t i, std::size_t j)
{
  return Vertex_pair_index::describe(c.points[i], c.normals[i], c.points[j], c.normals[j]);
}

template <class... Arguments>
bool refuses(const std::string& word, const Arguments&... arguments)
{
  return is_refused([&] { Vertex_pair_index(arguments...); }, "Vertex_pair_index", word);
}

} // namespace

BOOST_AUTO_TEST_CASE(descriptors_are_the_distance_and_the_signed_angles)
{
  const Vector p(1, 2, 3), u(0, 0, 1);
  const auto normal = [](double angle_with_line, double around) {
    return Vector(std::sin(angle_with_line) * std::cos(around), std::sin(angle_with_line) * std::sin(around),
                  std::cos(angle_with_line));
  };
  for (double a : {0.3, 1.2, 2.9})
    for (double b : {0.1, 1.6})
      for (double turn : {-3.0, -1.0, 0.0, 0.5, 3.1}) {
        const auto d = Vertex_pair_index::describe(p, normal(a, 0.4), p + 2.5 * u, normal(b, 0.4 + turn));
        BOOST_TEST(std::abs(d.length - 2.5) < 1e-6);
        BOOST_TEST(std::abs(d.angles.first - a) < 1e-6);
        BOOST_TEST(std::abs(d.angles.second - b) < 1e-6);
        BOOST_TEST(std::abs(d.angles.turn - turn) < 1e-5);
      }
}

BOOST_AUTO_TEST_CASE(descriptors_survive_motions_but_no_mirror)
{
  const Cloud cloud = random_cloud(40, 1);
  generated::Random random(2);
  const auto motion = random.motion(10);
  for (std::size_t i = 1; i < cloud.points.size(); ++i) {
    const auto d = of_pair(cloud, 0, i);
    const auto e = Vertex_pair_index::describe(motion(cloud.points[0]), motion.rotation * cloud.normals[0],
                                               motion(cloud.points[i]), motion.rotation * cloud.normals[i]);
    BOOST_TEST(Vertex_pair_index::agree(d, e, {1e-5f, 1e-5f, 1e-4f}));
    const auto mirrored = [](const Vector& v) { return Vector(-v.x(), v.y(), v.z()); };
    const auto m = Vertex_pair_index::describe(mirrored(cloud.points[0]), mirrored(cloud.normals[0]),
                                               mirrored(cloud.points[i]), mirrored(cloud.normals[i]));
    BOOST_TEST(std::abs(m.angles.turn + d.angles.turn) < 1e-5);
    BOOST_TEST(std::abs(m.angles.first - d.angles.first) < 1e-5);
    // From the other end.
    const auto r = of_pair(cloud, i, 0);
    BOOST_TEST(std::abs(r.angles.turn - d.angles.turn) < 1e-5);
    BOOST_TEST(std::abs(r.angles.first - (pi - d.angles.second)) < 1e-5);
  }
}

BOOST_AUTO_TEST_CASE(queries_find_what_brute_force_finds)
{
  generated::Random random(9);
  for (unsigned seed = 0; seed < 4; ++seed) {
    Cloud cloud = random_cloud(70, 10 + seed);
    for (std::size_t i = 0; i < 5; ++i) cloud.normals[7 * i] = Vector::Zero(); // take no part
    const double least = 0.3, most = 1.4;
    for (double cell : {0.02, 0.2, 3.0}) {
      const Vertex_pair_index index(cloud.points, cloud.normals, least, most, cell, 2 * cell);
      for (int q = 0; q < 60; ++q) {
        // Descriptors of the cloud itself, and any others, inside and outside the range of lengths.
        const auto i = std::size_t(35 * (1 + random.symmetric())) % 70, j = (i + 1 + std::size_t(q)) % 70;
        Vertex_pair_descriptor d = of_pair(cloud, i, j);
        if (cloud.normals[i].isZero() || cloud.normals[j].isZero() || q % 3 == 0)
          d = {float(1 + random.symmetric()),
               {float(1.5 * (1 + random.symmetric())), float(1.5 * (1 + random.symmetric())),
                float(3.14 * random.symmetric())}};
        const auto size = float(std::abs(random.symmetric()));
        const Vertex_pair_tolerance t = {0.3f * size, 0.8f * size, q % 4 == 0 ? 3.2f : 1.5f * size};
        // Nothing within the tolerance is missing, and what is beyond it is beyond by less than rounding may be.
        const std::set<Pair> f = found(index, d, t), least_found = expected(cloud, least, most, d, t),
                             most_found = expected(cloud, least, most, d, changed(d, t, 1.1e-5f));
        BOOST_TEST(std::includes(f.begin(), f.end(), least_found.begin(), least_found.end()));
        BOOST_TEST(std::includes(most_found.begin(), most_found.end(), f.begin(), f.end()));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(queries_may_be_limited_to_classes_of_vertices)
{
  generated::Random random(19);
  const Cloud cloud = random_cloud(80, 5);
  const auto any = [&] { return std::uint8_t(63.5 * (1 + random.symmetric())); };
  std::vector<CR::internal::Vertex_classes> classes;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) classes.push_back({{any(), any()}});
  classes[3] = {{0, 127}};
  classes[4] = {{127, 0}};
  const Vertex_pair_index index(cloud.points, cloud.normals, 0, 4, 0.3, 0.4, classes);
  for (int q = 0; q < 200; ++q) {
    CR::internal::Vertex_class_limits limits;
    for (std::size_t k = 0; k < 2; ++k) {
      limits.first_low[k] = any();
      limits.first_high[k] = (std::max)(limits.first_low[k], any());
      limits.second_low[k] = q % 3 == 0 ? std::uint8_t(0) : any();
      limits.second_high[k] = q % 3 == 0 ? std::uint8_t(127) : (std::max)(limits.second_low[k], any());
    }
    const Vertex_pair_descriptor d = of_pair(cloud, std::size_t(q) % 80, std::size_t(q + 7) % 80);
    const Vertex_pair_tolerance t = {0.5f, 1, q % 2 == 0 ? 3.2f : 1.5f};
    std::set<Pair> wanted, limited;
    for (const Pair& p : expected(cloud, 0, 4, d, t)) {
      const CR::internal::Vertex_classes &a = classes[std::size_t(p.first)], &b = classes[std::size_t(p.second)];
      bool is_within = true;
      for (std::size_t k = 0; k < 2; ++k)
        is_within = is_within && a[k] >= limits.first_low[k] && a[k] <= limits.first_high[k] &&
                    b[k] >= limits.second_low[k] && b[k] <= limits.second_high[k];
      if (is_within) wanted.insert(p);
    }
    index.for_each_match(d, t, limits, [&](const Vertex_pair_index::Pair& p) { limited.insert({p.first, p.second}); });
    BOOST_TEST((limited == wanted));
  }
}

BOOST_AUTO_TEST_CASE(a_pair_is_found_with_no_tolerance_at_all)
{
  const Cloud cloud = random_cloud(50, 21);
  const Vertex_pair_index index(cloud.points, cloud.normals, 0, 4, 0.1, 0.1);
  BOOST_TEST(index.size() == 50u * 49u);
  for (std::size_t i = 0; i < 50; ++i)
    for (std::size_t j = i + 1; j < 50; ++j)
      BOOST_TEST(found(index, of_pair(cloud, i, j), {0, 0, 0}).count({std::int32_t(i), std::int32_t(j)}) == 1u);
}

BOOST_AUTO_TEST_CASE(torsions_are_compared_on_the_circle)
{
  // Torsions on both sides of half a turn.
  Cloud cloud;
  for (int i = 0; i < 8; ++i) {
    const double turn = pi + 0.05 * (i - 3.5);
    cloud.points.emplace_back(10 * i, 0, 0);
    cloud.normals.emplace_back(1, 0, 0);
    cloud.points.emplace_back(10 * i, 0, 1);
    cloud.normals.emplace_back(std::cos(turn), std::sin(turn), 0);
  }
  const Vertex_pair_index index(cloud.points, cloud.normals, 0.5, 2, 0.1, 0.03);
  BOOST_TEST(index.size() == 16u);
  const Vertex_pair_tolerance t = {0.01f, 0.01f, 0.11f};
  for (double turn : {pi, -pi, 3.1, -3.1}) {
    const Vertex_pair_descriptor d = {1, {float(pi / 2), float(pi / 2), float(turn)}};
    BOOST_TEST((found(index, d, t) == expected(cloud, 0.5, 2, d, t)));
    BOOST_TEST(!found(index, d, t).empty());
  }
}

BOOST_AUTO_TEST_CASE(without_normals_pairs_are_told_by_their_distance)
{
  const Cloud cloud = random_cloud(60, 31);
  const Vertex_pair_index index(cloud.points, {}, 0.2, 1, 0.05, 1);
  std::size_t in_range = 0, matching = 0;
  for (const Vector& p : cloud.points)
    for (const Vector& q : cloud.points) {
      const double length = (p - q).norm();
      in_range += length >= 0.2 && length <= 1;
      matching += length >= 0.2 && length <= 1 && std::abs(float(length) - 0.7f) <= 0.04f;
    }
  BOOST_TEST(index.size() == in_range);
  BOOST_TEST(found(index, {0.7f, {0, 0, 0}}, {0.04f, 0, 0}).size() == matching);
}

BOOST_AUTO_TEST_CASE(nothing_and_little)
{
  const Vertex_pair_index none;
  BOOST_TEST(none.size() == 0u);
  BOOST_TEST(found(none, {1, {1, 1, 1}}, {1, 1, 1}).empty());
  const std::vector<Vector> no_points;
  BOOST_TEST(Vertex_pair_index(no_points, no_points, 0, 1, 0.1, 0.1).size() == 0u);
  // Coincident points are no pair.
  const std::vector<Vector> same(3, Vector(1, 1, 1)), normals(3, Vector(0, 0, 1));
  BOOST_TEST(Vertex_pair_index(same, normals, 0, 1, 0.1, 0.1).size() == 0u);
}

BOOST_AUTO_TEST_CASE(wrong_use_is_named)
{
  const Cloud c = random_cloud(5, 41);
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  BOOST_TEST(refuses("normals", c.points, std::vector<Vector>(3, Vector(0, 0, 1)), 0., 1., 0.1, 0.1));
  BOOST_TEST(refuses("minimum_length", c.points, c.normals, -1., 1., 0.1, 0.1));
  BOOST_TEST(refuses("minimum_length", c.points, c.normals, 2., 1., 0.1, 0.1));
  BOOST_TEST(refuses("maximum_length", c.points, c.normals, 0., nan, 0.1, 0.1));
  BOOST_TEST(refuses("maximum_length", c.points, c.normals, 0., inf, 0.1, 0.1));
  BOOST_TEST(refuses("length_cell", c.points, c.normals, 0., 1., 0., 0.1));
  BOOST_TEST(refuses("angle_cell", c.points, c.normals, 0., 1., 0.1, nan));
  using Classes = std::vector<CR::internal::Vertex_classes>;
  BOOST_TEST(refuses("classes", c.points, c.normals, 0., 1., 0.1, 0.1, Classes(4)));
  BOOST_TEST(refuses("classes", c.points, c.normals, 0., 1., 0.1, 0.1, Classes(5, {{0, 128}})));
}

BOOST_AUTO_TEST_CASE(point_grid_finds_what_brute_force_finds)
{
  generated::Random random(51);
  for (double cell : {0., 1e-6, 0.05, 0.4, 100.}) {
    std::vector<Vector> points;
    for (int i = 0; i < 200; ++i) points.push_back(random.vector());
    points.push_back(points[3]); // twice the same
    const CR::internal::Point_grid grid(points, cell);
    for (int q = 0; q < 50; ++q) {
      const Vector p = 1.5 * random.vector();
      const double radius = q % 5 == 0 ? 0 : std::abs(random.symmetric());
      std::set<std::int32_t> near_ones, wanted;
      grid.for_each_within(p, radius, [&](std::int32_t i, double d) {
        BOOST_TEST(d == (points[std::size_t(i)] - p).squaredNorm());
        BOOST_TEST(near_ones.insert(i).second);
      });
      for (std::size_t i = 0; i < points.size(); ++i)
        if ((points[i] - p).squaredNorm() <= radius * radius) wanted.insert(std::int32_t(i));
      BOOST_TEST((near_ones == wanted));
    }
  }
  // Flat and degenerate sets.
  for (const std::vector<Vector>& points :
       {std::vector<Vector>{}, std::vector<Vector>(5, Vector(1, 2, 3)),
        std::vector<Vector>{Vector(0, 0, 0), Vector(1e6, 0, 0), Vector(0, 1e6, 0), Vector(1e-9, 0, 0)}}) {
    const CR::internal::Point_grid grid(points, 1e-9);
    std::size_t count = 0;
    grid.for_each_within(Vector(0, 0, 0), 1e9, [&](std::int32_t, double) { ++count; });
    BOOST_TEST(count == points.size());
  }
}

BOOST_AUTO_TEST_CASE(near_points_are_all_that_are_in_reach_and_none_that_is_far)
{
  generated::Random random(61);
  for (const auto& [cell, reach] : {std::pair(0.1, 0.1), std::pair(0.3, 0.05), std::pair(0.01, 0.2)}) {
    std::vector<Vector> points;
    std::vector<int> items;
    for (int i = 0; i < 200; ++i) {
      points.push_back(random.vector());
      items.push_back(1000 + i);
    }
    points[7] = points[3]; // twice the same
    const CR::internal::Near_points<int> near_points(points, items, cell, reach);
    std::size_t in_reach = 0, nothing = 0;
    for (int q = 0; q < 2000; ++q) {
      Vector p = 1.2 * random.vector();
      // Some of them just in reach of a point.
      if (q % 2 == 0) p = points[std::size_t(q / 10)] + (1 - 1e-12) * reach * random.vector().normalized();
      std::vector<int> found;
      near_points.for_each_near(p, [&](int item) { found.push_back(item); });
      BOOST_TEST(std::is_sorted(found.begin(), found.end()));
      for (std::size_t i = 0; i < points.size(); ++i) {
        const double distance = (points[i] - p).norm();
        const auto count = std::count(found.begin(), found.end(), items[i]);
        BOOST_TEST(count <= 1);
        if (distance <= reach) BOOST_TEST(count == 1);
        in_reach += distance <= reach;
        // The diagonal of a cell more; cells get larger where there would be too many.
        if (distance > reach + 1.75 * (std::max)(cell, 0.05)) BOOST_TEST(count == 0);
      }
      nothing += found.empty();
    }
    BOOST_TEST(in_reach > 1000u);
    BOOST_TEST(nothing > 100u);
  }
  const CR::internal::Near_points<int> none;
  none.for_each_near(Vector(0, 0, 0), [](int) { BOOST_TEST(false); });
}

BOOST_AUTO_TEST_CASE(packed_ranges_are_ranges_of_each_number)
{
  generated::Random random(71);
  const auto check = [&](auto ranges_of, int fields, int size) {
    using Ranges = decltype(ranges_of);
    const auto any = [&] { return int((size - 1e-3) * (0.5 + 0.5 * random.symmetric())); };
    std::size_t within = 0;
    for (int k = 0; k < 3000; ++k) {
      typename Ranges::Word low = 0, width = 0, numbers = 0;
      bool is_within = true;
      for (int f = 0; f < fields; ++f) {
        // Whole circles, single numbers, ranges that pass the end, and numbers at either end of the range.
        const int l = any(), w = k % 5 == 0 ? size - 1 : k % 5 == 1 ? 0 : any();
        int n = any();
        if (k % 2 == 0) n = f % 2 == 0 ? l : (l + w) % size;
        if (k % 20 == 7 && f == 3) n = (l + w + 1) % size;
        low |= Ranges::field(f, l);
        width |= Ranges::field(f, w);
        numbers |= Ranges::field(f, n);
        is_within = is_within && (n - l + size) % size <= w;
      }
      BOOST_TEST(Ranges(low, width).contains(numbers) == is_within);
      within += is_within;
    }
    BOOST_TEST(within > 1000u);
    BOOST_TEST(within < 2500u);
  };
  check(CR::internal::Packed_ranges<8>(0, 0), 8, 128);
  check(CR::internal::Packed_ranges<16>(0, 0), 4, 32768);
}
