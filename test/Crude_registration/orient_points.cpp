// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#define BOOST_TEST_MODULE orient_points
#include <boost/test/unit_test.hpp>

#include <CGAL/Crude_registration/internal/base/Counter_random.h>
#include <CGAL/Crude_registration/internal/base/Run_control.h>
#include <CGAL/Crude_registration/internal/sampling/orient_points.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <utility>
#include <vector>

using namespace CGAL::Crude_registration::internal;

namespace {

constexpr double pi = 3.14159265358979323846;

// Points with the normals of the surface that they are from, on the side from where it is seen.
struct Cloud
{
  std::vector<Vector> points, normals;

  void add(const Vector& p, const Vector& n)
  {
    points.push_back(p);
    normals.push_back(n);
  }
};

// Unit vectors, spread evenly and without a pattern of their own.
Vector direction(const Counter_random& random, std::uint64_t i)
{
  const double z = 2 * random.uniform(2 * i) - 1, angle = 2 * pi * random.uniform(2 * i + 1);
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

Cloud sphere(std::size_t n)
{
  Cloud cloud;
  const Counter_random random(1);
  for (std::uint64_t i = 0; i < n; ++i) cloud.add(direction(random, i), direction(random, i));
  return cloud;
}

Cloud torus(std::size_t n)
{
  Cloud cloud;
  const Counter_random random(2);
  for (std::uint64_t i = 0; cloud.points.size() < n; ++i) {
    const double u = 2 * pi * random.uniform(3 * i), v = 2 * pi * random.uniform(3 * i + 1);
    if (3.8 * random.uniform(3 * i + 2) > 2.8 + std::cos(v)) continue; // even
    const Vector normal(std::cos(u) * std::cos(v), std::sin(u) * std::cos(v), std::sin(v));
    cloud.add(2.8 * Vector(std::cos(u), std::sin(u), 0) + normal, normal);
  }
  return cloud;
}

Cloud noisy_plane(std::size_t n, double noise)
{
  Cloud cloud;
  const Counter_random random(3);
  for (std::uint64_t i = 0; i < n; ++i)
    cloud.add({random.uniform(3 * i), random.uniform(3 * i + 1), noise * random.normal(3 * i + 2)}, Vector::UnitZ());
  return cloud;
}

// A room of 8 x 6 x 3 with a cupboard, a pillar and a table top in it, and what a ray from within hits.
struct Box
{
  Vector low, high;
};

const std::array<Box, 4> boxes = {
    {{{0, 0, 0}, {8, 6, 3}}, {{6.5, 0, 0}, {8, 1.5, 2}}, {{3, 4.5, 0}, {3.6, 5.1, 3}}, {{5, 3, 0.8}, {7, 4.5, 1}}}};

void add_hit(const Vector& eye, const Vector& d, Cloud& cloud)
{
  double nearest = 1e9;
  Vector normal = Vector::Zero();
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    double enter = -1e9, leave = 1e9;
    int first = 0, last = 0;
    for (int k = 0; k < 3; ++k) {
      const double t0 = (boxes[b].low[k] - eye[k]) / d[k], t1 = (boxes[b].high[k] - eye[k]) / d[k];
      if ((std::min)(t0, t1) > enter) {
        enter = (std::min)(t0, t1);
        first = k;
      }
      if ((std::max)(t0, t1) < leave) {
        leave = (std::max)(t0, t1);
        last = k;
      }
    }
    const double t = b == 0 ? leave : enter;
    if (!(enter < leave) || !(t > 0 && t < nearest)) continue;
    nearest = t;
    const int axis = b == 0 ? last : first;
    normal = d[axis] > 0 ? Vector(-Vector::Unit(axis)) : Vector(Vector::Unit(axis));
  }
  cloud.add(eye + nearest * d, normal);
}

const Vector eye(2, 2, 1.4);

// By a camera, in a cone of 35 degrees.
Cloud view_of_room(std::size_t n)
{
  Cloud cloud;
  const Counter_random random(4);
  const Vector axis = Vector(5, 2, -0.6).normalized();
  for (std::uint64_t i = 0; cloud.points.size() < n; ++i)
    if (const Vector d = direction(random, i); d.dot(axis) > std::cos(35 * pi / 180)) add_hit(eye, d, cloud);
  return cloud;
}

// Stairs, as they are seen from far away in a direction of which all coordinates are positive: nothing hides a part.
Cloud view_of_stairs(const Vector& towards_sensor, std::size_t n)
{
  constexpr std::array<std::array<double, 2>, 5> corners = {{{1.4, 0}, {1.05, 0.2}, {0.65, 0.45}, {0.3, 0.75}, {0, 1}}};
  constexpr double width = 0.8;
  Cloud cloud;
  const Counter_random random(5);
  for (std::uint64_t i = 0; cloud.points.size() < n; ++i) {
    const Vector p(1.4 * random.uniform(5 * i), random.uniform(5 * i + 1), width * random.uniform(5 * i + 2));
    const auto axis = Eigen::Index(3 * random.uniform(5 * i + 3));
    // As dense as a sensor sees it.
    if (random.uniform(5 * i + 4) > towards_sensor[axis]) continue;
    // The step on which p is, or of which it is the front or the end.
    std::size_t k = 0;
    while (k + 1 < corners.size() && (axis == 0 ? p[1] > corners[k + 1][1] : p[0] < corners[k + 1][0])) ++k;
    if (axis == 0) cloud.add({corners[k][0], p[1], p[2]}, Vector::UnitX());
    else if (axis == 1) cloud.add({p[0], corners[k + 1][1], p[2]}, Vector::UnitY());
    else if (p[1] < corners[k + 1][1]) cloud.add({p[0], p[1], width}, Vector::UnitZ());
  }
  return cloud;
}

// By a spinning scanner: rings of which each is far denser along than the rings are across.
Cloud rings(std::size_t number, std::size_t points)
{
  Cloud cloud;
  for (std::size_t ring = 0; ring < number; ++ring)
    for (std::size_t i = 0; i < points; ++i) {
      const double up = (-15 + 30 * (double(ring) + 0.5) / double(number)) * pi / 180,
                   turn = 2 * pi * (double(i) + 0.3) / double(points);
      add_hit(eye, {std::cos(up) * std::cos(turn), std::cos(up) * std::sin(turn), std::sin(up)}, cloud);
    }
  return cloud;
}

Oriented_points oriented(const Cloud& cloud, const Flat_sensor& sensor = {})
{
  return orient_points(cloud.points, {}, sensor);
}

Flat_sensor at(const Vector& viewpoint)
{
  return {Flat_sensor::PERSPECTIVE, viewpoint};
}

struct Quality
{
  double right_angle = 0, right_side = 0, compared = 0; // shares
};

// Of samples away from edges, where the points around agree on the normal: how many have that normal, within some
// degrees, and how many look to its side. By comparison of all with all.
Quality quality(const Cloud& cloud, const Oriented_points& samples, double radius, double degrees)
{
  Quality q;
  for (std::size_t i = 0; i < samples.points.size(); ++i) {
    Vector sum = Vector::Zero();
    double count = 0;
    for (std::size_t j = 0; j < cloud.points.size(); ++j)
      if ((cloud.points[j] - samples.points[i]).squaredNorm() < radius * radius) {
        sum += cloud.normals[j];
        ++count;
      }
    if (!(sum.norm() > 0.97 * count) || count == 0) continue;
    const double cosine = sum.normalized().dot(samples.normals[i]);
    ++q.compared;
    q.right_angle += std::abs(cosine) > std::cos(degrees * pi / 180);
    q.right_side += cosine > 0;
  }
  q.right_angle /= q.compared;
  q.right_side /= q.compared;
  q.compared /= double(samples.points.size());
  return q;
}

Cloud moved(Cloud cloud, const Rigid_motion& motion, double scale)
{
  for (Vector& p : cloud.points) p = scale * motion(p);
  for (Vector& n : cloud.normals) n = motion.rotation * n;
  return cloud;
}

// Every sample has a counterpart: the same place and normal.
void check_same(const Oriented_points& a, const Oriented_points& b, double tolerance, double share)
{
  BOOST_TEST_REQUIRE(!a.points.empty());
  BOOST_TEST(std::abs(a.area - b.area) < 0.01 * a.area);
  BOOST_TEST(std::abs(double(a.points.size()) - double(b.points.size())) < 0.01 * double(a.points.size()));
  std::size_t same = 0;
  for (std::size_t i = 0; i < a.points.size(); ++i)
    for (std::size_t j = 0; j < b.points.size(); ++j)
      if ((a.points[i] - b.points[j]).norm() < tolerance && a.normals[i].dot(b.normals[j]) > 0.999) {
        ++same;
        break;
      }
  BOOST_TEST(double(same) > share * double(a.points.size()));
}

bool has_same_bits(const Oriented_points& a, const Oriented_points& b)
{
  return a.points == b.points && a.normals == b.normals && a.area == b.area;
}

Rigid_motion some_motion()
{
  Rigid_motion motion;
  motion.rotation = Eigen::AngleAxisd(1.1, Vector(1, -2, 0.5).normalized()).toRotationMatrix();
  motion.translation = Vector(3, -5, 11);
  return motion;
}

} // namespace

BOOST_AUTO_TEST_CASE(closed_surfaces_look_outwards)
{
  struct Case
  {
    Cloud cloud;
    double area, radius;
  };
  for (const Case& c : {Case{sphere(6000), 4 * pi, 0.12}, Case{torus(12000), 4 * pi * pi * 2.8, 0.25}}) {
    const Oriented_points samples = oriented(c.cloud);
    BOOST_TEST(samples.is_side_known);
    BOOST_TEST(samples.area == c.area, boost::test_tools::tolerance(0.15));
    const Quality q = quality(c.cloud, samples, c.radius, 6);
    BOOST_TEST(q.compared > 0.95);
    BOOST_TEST(q.right_angle > 0.99);
    BOOST_TEST(q.right_side == 1);
    for (const Vector& n : samples.normals) BOOST_TEST_REQUIRE(std::abs(n.norm() - 1) < 1e-9);
  }
}

BOOST_AUTO_TEST_CASE(noise_is_met_by_a_larger_scale)
{
  // 4,000 points are 1/63 apart; noise of half that, and of all of it.
  for (const double noise : {0., 0.008, 0.016}) {
    const Cloud cloud = noisy_plane(4000, noise);
    const Quality q = quality(cloud, orient_points(cloud.points, {}, {Flat_sensor::ORTHOGRAPHIC, -Vector::UnitZ()}),
                              0.1, noise > 0.01 ? 20 : 12);
    BOOST_TEST(q.right_angle > 0.95);
    BOOST_TEST(q.right_side == 1);
  }
}

BOOST_AUTO_TEST_CASE(a_room_is_seen_from_inside)
{
  const Cloud cloud = view_of_room(8000);
  const Oriented_points without = oriented(cloud), with = oriented(cloud, at(eye));
  for (const Oriented_points* samples : {&with, &without}) {
    const Quality q = quality(cloud, *samples, 0.15, 6);
    BOOST_TEST(q.compared > 0.7);
    BOOST_TEST(q.right_angle > 0.95);
    BOOST_TEST(q.right_side > (samples == &with ? 0.999 : 0.96));
  }
}

BOOST_AUTO_TEST_CASE(no_face_is_seen_from_behind_and_bodies_from_outside)
{
  for (std::uint64_t i = 0; i < 12; ++i) {
    const Vector towards_sensor = (direction(Counter_random(8), i).cwiseAbs() + Vector::Constant(0.3)).normalized();
    const Cloud cloud = view_of_stairs(towards_sensor, 5000);
    const Oriented_points found = orient_points(cloud.points, {}, {});
    double outside = 0;
    for (std::size_t k = 0; k < found.points.size(); ++k) outside += found.normals[k].dot(towards_sensor) > 0;
    outside /= double(found.points.size());
    // From behind all is as visible; the stairs bulge towards the sensor.
    BOOST_TEST(outside > 0.98, "view " << i << ": " << outside);
    BOOST_TEST(!found.is_side_known);
  }
}

BOOST_AUTO_TEST_CASE(the_rings_of_a_spinning_scanner_are_a_surface)
{
  const Cloud cloud = rings(16, 1400);
  const std::clock_t start = std::clock();
  const Oriented_points with = oriented(cloud, at(eye));
  const Oriented_points without = oriented(cloud);
  const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
  BOOST_TEST_MESSAGE("rings with and without viewpoint: " << seconds << " s");
  for (const Oriented_points* samples : {&with, &without}) {
    const Quality q = quality(cloud, *samples, 0.3, 10);
    BOOST_TEST(q.compared > 0.5);
    BOOST_TEST(q.right_angle > 0.9);
    BOOST_TEST(q.right_side > 0.95);
  }
  // Not a ring by itself: its samples are far fewer than its points.
  BOOST_TEST(with.points.size() < cloud.points.size());
}

BOOST_AUTO_TEST_CASE(copies_change_no_bit)
{
  const Cloud cloud = view_of_room(3000);
  const Oriented_points once = oriented(cloud);
  for (const std::size_t n : {4u, 12u, 30u}) {
    Cloud each, all; // each line so many times; the file so many times
    for (std::size_t i = 0; i < n * cloud.points.size(); ++i) {
      each.points.push_back(cloud.points[i / n]);
      all.points.push_back(cloud.points[i % cloud.points.size()]);
    }
    BOOST_TEST(has_same_bits(once, oriented(each)));
    BOOST_TEST(has_same_bits(once, oriented(all)));
  }
  // Copies that were rounded: 1e-7 of the size apart.
  Cloud rounded;
  const Counter_random random(9);
  for (std::size_t i = 0; i < 12 * cloud.points.size(); ++i)
    rounded.points.push_back(cloud.points[i / 12] + 6e-7 * direction(random, i));
  const Oriented_points near = oriented(rounded);
  BOOST_TEST(std::abs(double(near.points.size()) - double(once.points.size())) < 0.1 * double(once.points.size()));
  const Quality q = quality(cloud, near, 0.2, 6);
  BOOST_TEST(q.right_angle > 0.9);
  // As a whole the view may be from behind.
  BOOST_TEST(!near.is_side_known);
  BOOST_TEST((std::max)(q.right_side, 1 - q.right_side) > 0.94);
}

BOOST_AUTO_TEST_CASE(nothing_depends_on_frame_unit_or_order)
{
  const Cloud cloud = view_of_room(3000);
  const Oriented_points samples = oriented(cloud);
  BOOST_TEST(has_same_bits(samples, oriented(cloud)));
  const Rigid_motion motion = some_motion();
  for (const double unit : {1., 0.0254, 1000.}) {
    Oriented_points other = oriented(moved(cloud, motion, unit));
    for (Vector& p : other.points) p = motion.inverse()(p / unit);
    for (Vector& n : other.normals) n = motion.rotation.transpose() * n;
    other.area /= unit * unit;
    check_same(samples, other, 1e-6, 0.99);
  }
  Cloud shuffled_cloud;
  for (const std::int32_t i : shuffled(cloud.points.size(), 17))
    shuffled_cloud.points.push_back(cloud.points[std::size_t(i)]);
  check_same(samples, oriented(shuffled_cloud), 1e-6, 0.99);
}

BOOST_AUTO_TEST_CASE(given_normals_tell_the_side)
{
  Cloud cloud = sphere(3000);
  for (Vector& n : cloud.normals) n = -2 * n; // of any length, inwards
  const Oriented_points samples = orient_points(cloud.points, cloud.normals, {});
  BOOST_TEST(samples.is_side_known);
  for (std::size_t i = 0; i < samples.points.size(); ++i)
    BOOST_TEST_REQUIRE(samples.normals[i].dot(samples.points[i]) < 0);
  // Points of which no normal is given have the side of their neighbours; those that have none are left out.
  Cloud some = cloud;
  const Vector far_away(20, 0, 0);
  for (const Vector& p : sphere(1000).points) some.points.push_back(p + far_away);
  some.normals.resize(some.points.size(), Vector::Zero());
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
    if (i % 5 < 1 || cloud.points[i].x() > 0.8) some.normals[i] = Vector::Zero();
  const Oriented_points neighbours = orient_points(some.points, some.normals, {});
  BOOST_TEST(neighbours.is_side_known);
  BOOST_TEST(neighbours.points.size() > 0.9 * double(samples.points.size()));
  for (std::size_t i = 0; i < neighbours.points.size(); ++i)
    BOOST_TEST_REQUIRE(neighbours.normals[i].dot(neighbours.points[i]) < 0);
  // Normals that are all null say nothing.
  const Oriented_points null = orient_points(cloud.points, std::vector<Vector>(3000, Vector::Zero()), {});
  for (std::size_t i = 0; i < null.points.size(); ++i) BOOST_TEST_REQUIRE(null.normals[i].dot(null.points[i]) > 0);
}

BOOST_AUTO_TEST_CASE(what_is_no_surface_gives_nothing)
{
  const auto count = [](const std::vector<Vector>& points) { return orient_points(points, {}, {}).points.size(); };
  BOOST_TEST(count({}) == 0);
  BOOST_TEST(count({Vector(1, 2, 3)}) == 0);
  BOOST_TEST(count(std::vector<Vector>(100, Vector(1, 2, 3))) == 0);
  BOOST_TEST(count({Vector(1, 2, 3), Vector(0, 0, 0)}) == 0);
  std::vector<Vector> line, curve;
  for (int i = 0; i < 500; ++i) {
    line.push_back(Vector(1, 2, -1) * i / 500.);
    curve.push_back({std::cos(i / 80.), std::sin(i / 80.), 0.001 * i});
  }
  BOOST_TEST(count(line) == 0);
  BOOST_TEST(count(curve) < 100);
  // An outlier far away, and a plane without thickness.
  Cloud plane = noisy_plane(2000, 0);
  plane.points.push_back({1e5, 1e5, 1e5});
  BOOST_TEST(count(plane.points) < 2001);
  plane.points.pop_back();
  BOOST_TEST(count(plane.points) > 1000);
}

BOOST_AUTO_TEST_CASE(it_ends_when_told_to)
{
  const Cloud cloud = sphere(300000);
  // Of its own time: what else runs on the machine has no say.
  const std::clock_t start = std::clock();
  Run_control control([](double) { return true; }, 0.001);
  BOOST_CHECK_THROW(orient_points(cloud.points, {}, {}, control), Run_control::Stopped);
  BOOST_TEST(double(std::clock() - start) / CLOCKS_PER_SEC < 0.1);
}
