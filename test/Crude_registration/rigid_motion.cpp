#define BOOST_TEST_MODULE rigid_motion
#include <boost/test/unit_test.hpp>

#include "wrong_use.h"

#include <CGAL/Crude_registration/motion/rigid_motion.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>

#include <Eigen/Geometry>

#include <cmath>
#include <cstdint>
#include <limits>
#include <list>
#include <stdexcept>
#include <string>
#include <vector>

namespace CR = CGAL::Crude_registration;
using CR::internal::least_squares_motion;
using CR::internal::Matrix;
using CR::internal::Rigid_motion;
using CR::internal::Vector;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;

namespace {

// A generator of its own: the same numbers with every standard library.
struct Random
{
  std::uint32_t state;
  double operator()() // in [-1, 1)
  {
    state = state * 1664525u + 1013904223u;
    return double(state >> 8) / double(1u << 23) - 1;
  }
  Vector vector() { return {(*this)(), (*this)(), (*this)()}; }
  Rigid_motion motion(double reach)
  {
    Rigid_motion m;
    m.rotation = Eigen::Quaterniond((*this)(), (*this)(), (*this)(), (*this)()).normalized().toRotationMatrix();
    m.translation = reach * vector();
    return m;
  }
};

std::vector<Vector> random_points(Random& random, std::size_t n)
{
  std::vector<Vector> points(n);
  for (Vector& p : points) p = random.vector();
  return points;
}

std::vector<Vector> moved(const Rigid_motion& m, std::vector<Vector> points)
{
  for (Vector& p : points) p = m(p);
  return points;
}

auto fit(const std::vector<Vector>& source, const std::vector<Vector>& target)
{
  return least_squares_motion(source.data(), target.data(), nullptr, source.size());
}

double cost(const Rigid_motion& m, const std::vector<Vector>& source, const std::vector<Vector>& target,
            const std::vector<double>& weights)
{
  double sum = 0;
  for (std::size_t i = 0; i < source.size(); ++i) sum += weights[i] * (m(source[i]) - target[i]).squaredNorm();
  return sum;
}

double distance(const Rigid_motion& a, const Rigid_motion& b)
{
  return (a.rotation - b.rotation).norm() + (a.translation - b.translation).norm();
}

bool is_proper(const Rigid_motion& m)
{
  return (m.rotation * m.rotation.transpose() - Matrix::Identity()).norm() < 1e-12 && m.rotation.determinant() > 0;
}

} // namespace

BOOST_AUTO_TEST_CASE(exact_correspondences_give_the_motion)
{
  Random random{1};
  for (std::size_t n : {3u, 4u, 5u, 100u})
    for (int i = 0; i < 50; ++i) {
      const auto source = random_points(random, n);
      const Rigid_motion truth = random.motion(10);
      const auto motion = fit(source, moved(truth, source));
      BOOST_REQUIRE(motion);
      BOOST_TEST(is_proper(*motion));
      BOOST_TEST(distance(*motion, truth) < (n == 3 ? 1e-9 : 1e-11));
    }
}

BOOST_AUTO_TEST_CASE(it_maps_source_to_target)
{
  const std::vector<Point> source = {Point(0, 0, 0), Point(1, 0, 0), Point(0, 2, 0)};
  const std::vector<Point> target = {Point(5, 0, 0), Point(5, 1, 0), Point(3, 0, 0)};
  const auto motion = CR::rigid_motion(source, target);
  BOOST_REQUIRE(motion.has_value());
  for (std::size_t i = 0; i < 3; ++i)
    BOOST_TEST(CGAL::squared_distance(motion->transform(source[i]), target[i]) < 1e-28);
}

BOOST_AUTO_TEST_CASE(no_motion_nearby_has_a_smaller_sum)
{
  Random random{2};
  for (int i = 0; i < 20; ++i) {
    const auto source = random_points(random, 8);
    auto target = moved(random.motion(3), source);
    for (Vector& p : target) p += 0.3 * random.vector();
    std::vector<double> weights(8);
    for (double& w : weights) w = 1.1 + random();
    const auto motion = least_squares_motion(source.data(), target.data(), weights.data(), 8);
    BOOST_REQUIRE(motion);
    const double best = cost(*motion, source, target, weights);
    for (int j = 0; j < 100; ++j) {
      Rigid_motion nearby = *motion;
      nearby.rotation = Eigen::AngleAxisd(0.1 * random(), random.vector().normalized()) * nearby.rotation;
      nearby.translation += 0.1 * random.vector();
      BOOST_TEST(cost(nearby, source, target, weights) >= best * (1 - 1e-12));
    }
  }
}

BOOST_AUTO_TEST_CASE(weights_count_as_repetitions_and_zero_leaves_out)
{
  Random random{3};
  auto source = random_points(random, 6), target = random_points(random, 6);
  const std::vector<double> weights = {1, 2, 3, 0, 1, 1};
  std::vector<Vector> s, t;
  for (std::size_t i = 0; i < 6; ++i)
    for (int j = 0; j < int(weights[i]); ++j) {
      s.push_back(source[i]);
      t.push_back(target[i]);
    }
  const auto a = least_squares_motion(source.data(), target.data(), weights.data(), 6), b = fit(s, t);
  BOOST_REQUIRE((a && b));
  BOOST_TEST(distance(*a, *b) < 1e-12);
}

BOOST_AUTO_TEST_CASE(mirror_images_give_a_proper_rotation)
{
  Random random{4};
  for (int i = 0; i < 50; ++i) {
    const auto source = random_points(random, 10);
    auto target = moved(random.motion(3), source);
    for (Vector& p : target) p.x() = -p.x();
    const auto motion = fit(source, target);
    BOOST_REQUIRE(motion);
    BOOST_TEST(is_proper(*motion));
  }
}

BOOST_AUTO_TEST_CASE(planar_points_are_enough)
{
  Random random{5};
  for (int i = 0; i < 50; ++i) {
    auto source = random_points(random, 4);
    for (Vector& p : source) p.z() = 0;
    const Rigid_motion truth = random.motion(3);
    const auto motion = fit(source, moved(truth, source));
    BOOST_REQUIRE(motion);
    BOOST_TEST(is_proper(*motion));
    BOOST_TEST(distance(*motion, truth) < 1e-9);
  }
}

BOOST_AUTO_TEST_CASE(what_does_not_determine_a_motion_is_reported)
{
  Random random{6};
  const auto good = random_points(random, 5);
  const std::vector<Vector> coincident(5, Vector(1, 2, 3));
  std::vector<Vector> line, rounded_line;
  const Rigid_motion any = random.motion(3);
  for (int i = 0; i < 5; ++i) {
    line.emplace_back(i, 0, 0);
    rounded_line.push_back(any(Vector(0.1 + i * i, 0, 0)));
  }
  const std::vector<std::vector<Vector>> bad = {{},   {Vector(1, 2, 3)}, {Vector(1, 2, 3), Vector(2, 3, 5)}, coincident,
                                                line, rounded_line};
  for (const auto& points : bad)
    for (double unit : {1e-250, 1e-3, 1., 1e3, 1e250})
      for (double offset : {0., 1., 1e6}) {
        std::vector<Vector> source = points;
        for (Vector& p : source) p = unit * (p + offset * Vector(1, -2, 0.3));
        BOOST_TEST(!fit(source, source));
        if (points.size() == 5) {
          BOOST_TEST(!fit(source, good));
          BOOST_TEST(!fit(good, source));
        }
      }
  const std::vector<double> nothing(5, 0.), two = {1, 0, 0, 2, 0};
  BOOST_TEST(!least_squares_motion(good.data(), good.data(), nothing.data(), 5));
  BOOST_TEST(!least_squares_motion(good.data(), good.data(), two.data(), 5));

  // The corners of a cube against their mirror image: many rotations are equally good.
  std::vector<Vector> cube, mirrored;
  for (int i = 0; i < 8; ++i) {
    cube.emplace_back(i & 1, (i >> 1) & 1, i >> 2);
    mirrored.emplace_back(-(i & 1), (i >> 1) & 1, i >> 2);
  }
  BOOST_TEST(!fit(cube, mirrored));
}

BOOST_AUTO_TEST_CASE(unit_and_frame_do_not_matter)
{
  Random random{7};
  const auto source = random_points(random, 7);
  auto target = moved(random.motion(3), source);
  for (Vector& p : target) p += 0.1 * random.vector();
  const auto reference = fit(source, target);
  BOOST_REQUIRE(reference);

  for (double unit : {1e-250, 1e-3, 0.3048, 1e3, 1e250}) {
    auto s = source, t = target;
    for (Vector& p : s) p *= unit;
    for (Vector& p : t) p *= unit;
    auto motion = fit(s, t);
    BOOST_REQUIRE(motion);
    motion->translation /= unit;
    BOOST_TEST(distance(*motion, *reference) < 1e-12);
  }
  for (int i = 0; i < 20; ++i) {
    const Rigid_motion a = random.motion(100), b = random.motion(100);
    const auto motion = fit(moved(a, source), moved(b, target));
    BOOST_REQUIRE(motion);
    BOOST_TEST(distance(b.inverse() * *motion * a, *reference) < 1e-10);
  }
  const auto inverse = fit(target, source);
  BOOST_REQUIRE(inverse);
  BOOST_TEST(distance(inverse->inverse(), *reference) < 1e-12);
}

BOOST_AUTO_TEST_CASE(far_from_the_origin)
{
  Random random{8};
  const auto source = random_points(random, 20);
  Rigid_motion truth = random.motion(1), away;
  away.translation = Vector(1e6, -2e6, 3e6);
  const auto motion = fit(source, moved(away * truth, source));
  BOOST_REQUIRE(motion);
  BOOST_TEST((motion->rotation - truth.rotation).norm() < 1e-9);
}

BOOST_AUTO_TEST_CASE(any_kernel_and_any_range)
{
  using Cartesian = CGAL::Simple_cartesian<float>;
  const std::list<Cartesian::Point_3> source = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}};
  const std::list<Cartesian::Point_3> target = {{1, 0, 0}, {2, 0, 0}, {1, 2, 0}};
  const std::list<int> weights = {1, 1, 2};
  const auto motion = CR::rigid_motion(source, target, weights);
  BOOST_REQUIRE(motion.has_value());
  BOOST_TEST(std::abs(motion->m(0, 3) - 1) < 1e-6);
}

BOOST_AUTO_TEST_CASE(wrong_use_names_the_argument)
{
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  const std::vector<Point> three = {Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0)},
                           two = {Point(0, 0, 0), Point(1, 0, 0)};
  const std::vector<Point> not_finite = {Point(0, 0, 0), Point(1, nan, 0), Point(0, 1, 0)};
  const std::vector<double> negative = {1, -1, 1}, infinite = {1, infinity, 1}, short_weights = {1, 1};
  BOOST_CHECK_EXCEPTION(CR::rigid_motion(three, two), std::invalid_argument,
                        names("rigid_motion: source and target differ"));
  BOOST_CHECK_EXCEPTION(CR::rigid_motion(not_finite, three), std::invalid_argument, names("rigid_motion: source"));
  BOOST_CHECK_EXCEPTION(CR::rigid_motion(three, not_finite), std::invalid_argument, names("rigid_motion: target"));
  BOOST_CHECK_EXCEPTION(CR::rigid_motion(three, three, negative), std::invalid_argument,
                        names("rigid_motion: weights"));
  BOOST_CHECK_EXCEPTION(CR::rigid_motion(three, three, infinite), std::invalid_argument,
                        names("rigid_motion: weights"));
  BOOST_CHECK_EXCEPTION(CR::rigid_motion(three, three, short_weights), std::invalid_argument,
                        names("rigid_motion: weights"));
}
