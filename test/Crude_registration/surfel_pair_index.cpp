#define BOOST_TEST_MODULE surfel_pair_index
#include <boost/test/unit_test.hpp>

#include "generated_surfaces.h"

#include <CGAL/Crude_registration/internal/lookup/Surfel_pair_index.h>

#include <Eigen/LU>

#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <utility>
#include <vector>

using namespace CGAL::Crude_registration::internal;
using generated::pi;
using generated::Random;

namespace {

using Pair = std::pair<std::size_t, std::size_t>;

Surfel surfel(const Vector& position, const Vector& normal, float k1 = 0, float k2 = 0)
{
  Surfel s;
  s.position = position.cast<float>();
  s.normal = normal.normalized().cast<float>();
  s.minimal_curvature = k1;
  s.maximal_curvature = k2;
  return s;
}

std::vector<Surfel> surfels_in_cube(std::size_t n, unsigned seed)
{
  Random random(seed);
  std::vector<Surfel> surfels;
  while (surfels.size() < n) {
    const Vector p = random.vector(), normal = random.vector();
    const float k = float(random.symmetric()), l = float(random.symmetric());
    if (normal.norm() > 0.1 && normal.norm() < 1)
      surfels.push_back(surfel(p, normal, (std::min)(k, l), (std::max)(k, l)));
  }
  return surfels;
}

Surfel moved(const Surfel& s, const Rigid_motion& motion, double unit = 1)
{
  return surfel(motion(unit * s.position.cast<double>()), motion.rotation * s.normal.cast<double>(),
                s.minimal_curvature, s.maximal_curvature);
}

// The difference of two turns.
double turn_between(float a, float b)
{
  return std::abs(std::remainder(double(a) - double(b), 2 * pi));
}

// All pairs of a length, each in both orders.
struct Found_pair
{
  Pair pair;
  Pair_angles angles;
};

std::vector<Found_pair> all_pairs(const std::vector<Surfel>& surfels, double least, double most)
{
  std::vector<Found_pair> pairs;
  for (std::size_t i = 0; i < surfels.size(); ++i)
    for (std::size_t j = 0; j < surfels.size(); ++j) {
      const double length = (surfels[j].position.cast<double>() - surfels[i].position.cast<double>()).norm();
      Pair_angles angles;
      if (i != j && length >= least && length <= most && pair_angles(surfels[i], surfels[j], angles))
        pairs.push_back({{i, j}, angles});
    }
  return pairs;
}

bool agree(const Pair_curvatures& a, const Pair_curvatures& b, int tolerance)
{
  return Curvature_window(a, tolerance).contains(b);
}

std::multiset<Pair> looked_up(const Surfel_pair_index& index, const Pair_angles& angles)
{
  std::multiset<Pair> pairs;
  index.for_each_run(angles, [&](const Surfel_pair_index::Entry* from, const Surfel_pair_index::Entry* to) {
    for (; from != to; ++from) pairs.insert({from->first, from->second});
  });
  return pairs;
}

// What the index promises: everything within half a bin of the angles, nothing off by one and a half.
constexpr double angle_bin = pi / 15, turn_bin = pi / 10;

} // namespace

BOOST_AUTO_TEST_CASE(angles_of_a_known_pair)
{
  const Surfel a = surfel({1, 2, 3}, {0, 0, 1}), b = surfel({3, 2, 3}, {0.6, 0, 0.8}), c = surfel({3, 2, 3}, {0, 1, 1}),
               d = surfel({3, 2, 3}, {0, -1, 1}), e = surfel({3, 2, 3}, {0, 0, -1});
  Pair_angles angles;
  BOOST_TEST_REQUIRE(pair_angles(a, b, angles));
  BOOST_TEST(std::abs(double(angles.first) - pi / 2) < 1e-6);
  BOOST_TEST(std::abs(double(angles.second) - std::acos(0.6)) < 1e-6);
  BOOST_TEST(std::abs(double(angles.turn)) < 1e-6);
  // Counterclockwise from a's normal to the other one, seen against the line, is positive.
  BOOST_TEST_REQUIRE(pair_angles(a, c, angles));
  BOOST_TEST(std::abs(double(angles.second) - pi / 2) < 1e-6);
  BOOST_TEST(std::abs(double(angles.turn) + pi / 4) < 1e-6);
  BOOST_TEST_REQUIRE(pair_angles(a, d, angles));
  BOOST_TEST(std::abs(double(angles.turn) - pi / 4) < 1e-6);
  BOOST_TEST_REQUIRE(pair_angles(a, e, angles));
  BOOST_TEST(std::abs(std::abs(double(angles.turn)) - pi) < 1e-6);
}

BOOST_AUTO_TEST_CASE(pairs_without_angles)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Surfel a = surfel({1, 2, 3}, {0, 0, 1});
  Pair_angles angles;
  BOOST_TEST(!pair_angles(a, a, angles));
  // A normal along the line has no direction around it.
  BOOST_TEST(!pair_angles(a, surfel({1, 2, 4}, {1, 0, 0}), angles));
  BOOST_TEST(!pair_angles(surfel({1, 2, 4}, {1, 0, 0}), a, angles));
  Surfel bad = surfel({3, 2, 3}, {0, 0, 1});
  bad.position[1] = nan;
  BOOST_TEST(!pair_angles(a, bad, angles));
  BOOST_TEST(!pair_angles(bad, a, angles));
}

BOOST_AUTO_TEST_CASE(angles_do_not_depend_on_frame_and_unit_but_on_the_side)
{
  const std::vector<Surfel> surfels = surfels_in_cube(40, 1);
  Random random(2);
  Rigid_motion mirror;
  mirror.rotation(0, 0) = -1;
  for (double unit : {1., 1e-3, 1e3}) {
    const Rigid_motion motion = random.motion(3 * unit);
    for (const Found_pair& p : all_pairs(surfels, 0.1, 4)) {
      const Surfel &a = surfels[p.pair.first], &b = surfels[p.pair.second];
      Pair_angles angles;
      if (!pair_angles(moved(a, motion, unit), moved(b, motion, unit), angles)) continue; // at the limit of the slope
      BOOST_TEST(std::abs(angles.first - p.angles.first) < 1e-4);
      BOOST_TEST(std::abs(angles.second - p.angles.second) < 1e-4);
      BOOST_TEST(turn_between(angles.turn, p.angles.turn) < 1e-4);

      if (!pair_angles(moved(a, mirror), moved(b, mirror), angles)) continue;
      BOOST_TEST(std::abs(angles.first - p.angles.first) < 1e-4);
      BOOST_TEST(std::abs(angles.second - p.angles.second) < 1e-4);
      BOOST_TEST(turn_between(angles.turn, -p.angles.turn) < 1e-4);
    }
  }
}

BOOST_AUTO_TEST_CASE(from_the_other_end_angles_are_supplements)
{
  const std::vector<Surfel> surfels = surfels_in_cube(40, 3);
  for (const Found_pair& p : all_pairs(surfels, 0, 4)) {
    Pair_angles angles;
    BOOST_TEST_REQUIRE(pair_angles(surfels[p.pair.second], surfels[p.pair.first], angles));
    BOOST_TEST(std::abs(double(angles.first + p.angles.second) - pi) < 1e-5);
    BOOST_TEST(std::abs(double(angles.second + p.angles.first) - pi) < 1e-5);
    BOOST_TEST(turn_between(angles.turn, p.angles.turn) < 1e-5);
  }
}

BOOST_AUTO_TEST_CASE(frames_are_rotations_that_tell_the_motion)
{
  std::vector<Surfel> surfels = surfels_in_cube(40, 4);
  // Opposite normals: their sum has no direction.
  surfels.push_back(surfel({0, 0, 0}, {0, 0.1, 1}));
  surfels.push_back(surfel({1, 0, 0}, {0, -0.1, -1}));
  surfels.push_back(surfel({0.5, 0.5, 0}, {0, -0.1, -1}));
  Random random(5);
  for (const Found_pair& p : all_pairs(surfels, 0.1, 4)) {
    const Surfel &a = surfels[p.pair.first], &b = surfels[p.pair.second];
    const Matrix_f frame = pair_frame(a, b);
    BOOST_TEST((frame.transpose() * frame - Matrix_f::Identity()).norm() < 1e-5f);
    BOOST_TEST(frame.determinant() > 0.999f);
    BOOST_TEST((frame.col(0) - (b.position - a.position).normalized()).norm() < 1e-5f);
    const Vector_f sum = a.normal + b.normal;
    if (std::abs((sum - sum.dot(frame.col(0)) * frame.col(0)).norm() - 0.3f) < 1e-3f) continue; // at the limit
    const Rigid_motion motion = random.motion(2);
    const Matrix_f other = pair_frame(moved(a, motion), moved(b, motion));
    BOOST_TEST((other * frame.transpose() - motion.rotation.cast<float>()).norm() < 1e-4f);
  }
}

BOOST_AUTO_TEST_CASE(holds_every_pair_of_the_length_in_both_orders_vs_brute_force)
{
  const std::vector<Surfel> surfels = surfels_in_cube(300, 6);
  for (const auto& [length, half_width] : {std::pair(0.5f, 0.03f), std::pair(1.1f, 0.2f), std::pair(0.1f, 0.1f)}) {
    const Surfel_pair_index index(surfels, length, half_width);
    const double least = double(length - half_width), most = double(length + half_width);
    const std::vector<Found_pair> inner = all_pairs(surfels, least * 1.00001, most * 0.99999),
                                  outer = all_pairs(surfels, least * 0.99999, most * 1.00001);
    BOOST_TEST(inner.size() > 100u);
    BOOST_TEST(index.size() >= inner.size());
    BOOST_TEST(index.size() <= outer.size());
    std::set<Pair> possible;
    for (const Found_pair& p : outer) possible.insert(p.pair);
    for (const Found_pair& p : inner) {
      const std::multiset<Pair> pairs = looked_up(index, p.angles);
      BOOST_TEST(pairs.count(p.pair) == 1u);
      for (const Pair& q : pairs) BOOST_TEST((possible.count(q) == 1));
      // The other order.
      Pair_angles reversed;
      BOOST_TEST_REQUIRE(pair_angles(surfels[p.pair.second], surfels[p.pair.first], reversed));
      BOOST_TEST(looked_up(index, reversed).count({p.pair.second, p.pair.first}) == 1u);
    }
  }
}

BOOST_AUTO_TEST_CASE(looks_up_what_is_close_and_nothing_that_is_not_vs_brute_force)
{
  const std::vector<Surfel> surfels = surfels_in_cube(300, 7);
  const Surfel_pair_index index(surfels, 0.8f, 0.1f);
  const std::vector<Found_pair> pairs = all_pairs(surfels, 0.7001, 0.8999);
  Random random(8);
  std::size_t close = 0, at_the_seam = 0;
  for (int i = 0; i < 500; ++i) {
    Pair_angles angles;
    angles.first = float(pi / 2 * (1 + 0.95 * random.symmetric()));
    angles.second = float(pi / 2 * (1 + 0.95 * random.symmetric()));
    angles.turn = float(pi * (i % 5 == 0 ? 1 - 0.02 * (1 + random.symmetric()) : random.symmetric()));
    if (i % 2 == 0) angles.turn = -angles.turn;
    const std::multiset<Pair> found = looked_up(index, angles);
    BOOST_TEST(index.count(angles) == found.size());
    for (const Found_pair& p : pairs) {
      const double first = double(std::abs(p.angles.first - angles.first)) / angle_bin,
                   second = double(std::abs(p.angles.second - angles.second)) / angle_bin,
                   turn = turn_between(p.angles.turn, angles.turn) / turn_bin;
      const double worst = (std::max)({first, second, turn});
      if (worst < 0.499) {
        BOOST_TEST(found.count(p.pair) == 1u);
        ++close;
        at_the_seam += std::abs(p.angles.turn - angles.turn) > 3;
      }
      if (worst > 1.501) BOOST_TEST(found.count(p.pair) == 0u);
    }
  }
  BOOST_TEST(close > 500u);
  BOOST_TEST(at_the_seam > 5u);
}

BOOST_AUTO_TEST_CASE(entries_hold_the_curvatures_in_their_order)
{
  const std::vector<Surfel> surfels = surfels_in_cube(100, 9);
  const Surfel_pair_index index(surfels, 0.8f, 0.1f);
  std::size_t entries = 0;
  for (const Found_pair& p : all_pairs(surfels, 0.71, 0.89))
    index.for_each_run(p.angles, [&](const Surfel_pair_index::Entry* from, const Surfel_pair_index::Entry* to) {
      for (; from != to; ++from) {
        ++entries;
        const Surfel &a = surfels[from->first], &b = surfels[from->second];
        BOOST_TEST(agree(from->curvatures, Pair_curvatures::of(a, b), 0));
      }
    });
  BOOST_TEST(entries > 100u);
}

BOOST_AUTO_TEST_CASE(agreement_of_curvatures)
{
  const Vector o(0, 0, 0), z(0, 0, 1);
  const auto of = [&](float k1, float k2, float l1, float l2) {
    return Pair_curvatures::of(surfel(o, z, k1, k2), surfel(o, z, l1, l2));
  };
  const Pair_curvatures c = of(-0.5f, 0.25f, 0, 0.75f);
  BOOST_TEST(agree(c, c, 0));
  for (const Pair_curvatures& d : {of(-0.4f, 0.25f, 0, 0.75f), of(-0.5f, 0.35f, 0, 0.75f),
                                   of(-0.5f, 0.25f, -0.1f, 0.75f), of(-0.5f, 0.25f, 0, 0.65f)}) {
    // 0.1 is 12.8 of 128.
    BOOST_TEST(!agree(c, d, 11));
    BOOST_TEST(!agree(d, c, 11));
    BOOST_TEST(agree(c, d, 14));
    BOOST_TEST(agree(d, c, 14));
  }
  // The two ends are told apart.
  BOOST_TEST(!agree(c, of(0, 0.75f, -0.5f, 0.25f), 30));
  // What is beyond the range is the same as its end.
  const float most = (std::numeric_limits<float>::max)();
  BOOST_TEST(agree(of(-most, most, -2, 2), of(-2, 2, -most, most), 0));
  BOOST_TEST(!agree(of(-most, most, 0, 0), of(0, 0, 0, 0), 100));
}

BOOST_AUTO_TEST_CASE(nothing_to_index)
{
  const Pair_angles angles = {1, 1, 1};
  for (std::size_t n : {0u, 1u}) {
    const Surfel_pair_index index(surfels_in_cube(n, 1), 1, 0.1f);
    BOOST_TEST(index.size() == 0u);
    BOOST_TEST(index.count(angles) == 0u);
  }
  // All in one place, and all too far apart.
  const std::vector<Surfel> in_one_place(50, surfel({1, 2, 3}, {0, 0, 1}));
  BOOST_TEST(Surfel_pair_index(in_one_place, 1, 0.1f).size() == 0u);
  BOOST_TEST(Surfel_pair_index(in_one_place, 0.1f, 0.1f).size() == 0u);
  BOOST_TEST(Surfel_pair_index(surfels_in_cube(50, 2), 100, 1).size() == 0u);
}
