// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_TEST_STATUE_VIEWS_H
#define CGAL_CRUDE_REGISTRATION_TEST_STATUE_VIEWS_H

// Simulated views of statues, whose motions are known, and what is asked of the answers for them.

#include "registration_checks.h"

#include <CGAL/Crude_registration/sampling/triangulate_range_image.h>
#include <CGAL/Crude_registration/simulation/make_statue.h>
#include <CGAL/Crude_registration/simulation/simulate_range_image.h>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

inline const Point origin(0, 0, 0);

// A view of a statue: a perspective range image of about 13,000 samples, in the sensor's own frame.
struct View
{
  Image image;
  Rigid_motion scene_from_scan;
  Scan scan;
  Vector centre; // of the statue, in the scan's frame
};

// The view of statue `seed` from the direction of an angle in degrees, by so many lines of sight a side, some of which
// are lost. Made once.
inline const View& view(unsigned seed, int degrees, double noise = 0.2, std::size_t samples = 330,
                        bool with_losses = true)
{
  static std::map<unsigned, CR::Simulated_scene> scenes;
  static std::map<std::tuple<unsigned, int, double, std::size_t, bool>, View> views;
  auto scene = scenes.find(seed);
  if (scene == scenes.end()) {
    Mesh statue;
    CR::make_statue(statue, 72, p::random_seed(seed));
    scene = scenes.emplace(std::piecewise_construct, std::tuple(seed), std::tuple<const Mesh&>(statue)).first;
  }
  const auto key = std::tuple(seed, degrees, noise, samples, with_losses);
  const auto found = views.find(key);
  if (found != views.end()) return found->second;
  const double angle = degrees * pi / 180;
  const CGAL::Bbox_3 box(-0.85, -0.85, -1, 0.85, 0.85, 1);
  auto camera = CR::Range_camera<Kernel>::framing(
      box, Kernel::Vector_3(-std::cos(angle), -std::sin(angle), degrees % 90 == 0 ? -0.2 : 0.1), samples, true);
  camera.noise = noise;
  if (noise > 0 && with_losses) camera.drop_out = 0.02, camera.grazing_drop_out = 0.8;
  camera.seed = std::uint64_t(1000 + degrees);
  const auto simulated = scene->second.range_image(camera);
  const Rigid_motion scene_from_scan = to_rigid_motion(simulated.scene_from_scan);
  return views
      .emplace(key,
               View{simulated.image, scene_from_scan, Scan(simulated.image), scene_from_scan.inverse()(Vector::Zero())})
      .first->second;
}

inline Rigid_motion true_motion(const View& source, const View& target)
{
  return target.scene_from_scan.inverse() * source.scene_from_scan;
}

// Registered, to 1 degree and two sampling distances in the middle of the scan.
inline void check_right(const Result& result, const Rigid_motion& truth, const Vector& centre, double spacing)
{
  check_proper(result);
  BOOST_TEST(result.status() == CR::REGISTERED);
  const Rigid_motion motion = to_rigid_motion(result.transformation());
  BOOST_TEST(angle_between(motion, truth) < 1);
  BOOST_TEST((motion(centre) - truth(centre)).norm() < 2 * spacing);
}

inline void check_right(const Result& result, const View& source, const View& target)
{
  check_right(result, true_motion(source, target), source.centre,
              (std::max)(source.scan.spacing(), target.scan.spacing()));
}

// The largest displacement of one motion against the other on a ball that holds a scan.
inline double difference(const Rigid_motion& a, const Rigid_motion& b, const Vector& centre, double radius = 1)
{
  return (a(centre) - b(centre)).norm() + radius * (a.rotation - b.rotation).norm();
}

// Whatever the answer, it has to say that it is not right.
inline void check_not_registered(const Result& result)
{
  check_proper(result);
  BOOST_TEST(result.status() != CR::REGISTERED);
  if (result.status() == CR::NOT_REGISTERED) {
    BOOST_TEST(result.correspondence().empty());
    BOOST_TEST((to_rigid_motion(result.transformation()).rotation == Matrix::Identity()));
    BOOST_TEST(to_rigid_motion(result.transformation()).translation.norm() == 0.);
  }
}

// How far a point is from the nearest sample of an image.
inline double distance_to_samples(const Image& image, const Point& place)
{
  double least = (std::numeric_limits<double>::max)();
  for (const Point& p : image.points()) least = (std::min)(least, CGAL::squared_distance(p, place));
  return std::sqrt(least);
}

// So many points, which lie on the samples as far as means of them do, are as far from each other on either side to
// within `tolerance`, and are taken to their matches by the crude motion and by the true one as far as points of
// reduced surfaces can be. `spacing`: of the points of the reduced surfaces, the larger one of the two.
inline void check_correspondence(const Result& result, const View& source, const View& target, std::size_t number,
                                 double spacing, double tolerance)
{
  const Result::Correspondence& points = result.correspondence();
  BOOST_TEST(points.size() == number);
  const Rigid_motion truth = true_motion(source, target);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& [s, t] = points[i];
    BOOST_TEST(distance_to_samples(source.image, s) < 0.5 * spacing);
    BOOST_TEST(distance_to_samples(target.image, t) < 0.5 * spacing);
    BOOST_TEST(CGAL::squared_distance(result.crude_transformation().transform(s), t) < 2.25 * spacing * spacing);
    BOOST_TEST((truth(Vector(s.x(), s.y(), s.z())) - Vector(t.x(), t.y(), t.z())).norm() < 1.5 * spacing);
    for (std::size_t j = 0; j < i; ++j) {
      const double there = std::sqrt(CGAL::squared_distance(s, points[j].first)),
                   here = std::sqrt(CGAL::squared_distance(t, points[j].second));
      BOOST_TEST(there > 0);
      BOOST_TEST(std::abs(there - here) < (1 + 1e-6) * tolerance);
    }
  }
}

// The one of two answers, for scans in the one order and the other, is the other one read the other way round.
inline void check_swapped_correspondence(const Result& there, const Result& back)
{
  Result::Correspondence swapped;
  for (const auto& [s, t] : back.correspondence()) swapped.emplace_back(t, s);
  BOOST_TEST((there.correspondence() == swapped));
}

inline Mesh mesh_of(const Image& image)
{
  Mesh mesh;
  CR::triangulate_range_image(image, mesh);
  return mesh;
}

inline void check_same_bits(const Result& first, const Result& second)
{
  BOOST_TEST(first.status() == second.status());
  BOOST_TEST(first.reason() == second.reason());
  for (const auto transformation : {&Result::transformation, &Result::crude_transformation}) {
    const Rigid_motion m = to_rigid_motion((first.*transformation)()), n = to_rigid_motion((second.*transformation)());
    BOOST_TEST((m.rotation == n.rotation));
    BOOST_TEST((m.translation == n.translation));
  }
  BOOST_TEST(first.confidence() == second.confidence());
  BOOST_TEST(first.score() == second.score());
  BOOST_TEST(first.overlap() == second.overlap());
  BOOST_TEST(first.residual() == second.residual());
  BOOST_TEST((first.covariance() == second.covariance()));
  BOOST_TEST((first.correspondence() == second.correspondence()));
  BOOST_TEST_REQUIRE(first.runners_up().size() == second.runners_up().size());
  for (std::size_t i = 0; i < first.runners_up().size(); ++i)
    BOOST_TEST(first.runners_up()[i].score == second.runners_up()[i].score);
  BOOST_TEST_REQUIRE(first.statistics().size() == second.statistics().size());
  for (std::size_t i = 0; i < first.statistics().size(); ++i) {
    BOOST_TEST(first.statistics()[i].name == second.statistics()[i].name);
    BOOST_TEST(first.statistics()[i].count == second.statistics()[i].count);
  }
}

// Ends a run once so much of it is done, or after so many looks at it.
struct Impatient
{
  double enough, last = 0;
  int most;
  int asked = 0, refused = 0;
  bool is_monotone = true, is_share = true;

  explicit Impatient(double share, int looks = (std::numeric_limits<int>::max)()) : enough(share), most(looks) {}
  void progress(double share)
  {
    is_monotone = is_monotone && share >= last;
    is_share = is_share && share >= 0 && share < 1;
    last = share;
  }
  bool go_further()
  {
    const bool goes_on = last < enough && asked < most;
    ++asked;
    refused += !goes_on;
    return goes_on;
  }
};

#endif // CGAL_CRUDE_REGISTRATION_TEST_STATUE_VIEWS_H
