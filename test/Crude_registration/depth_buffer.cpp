#define BOOST_TEST_MODULE depth_buffer
#include <boost/test/unit_test.hpp>

#include "generated_surfaces.h"

#include <CGAL/Crude_registration/internal/lookup/Depth_buffer.h>

#include <cmath>
#include <limits>
#include <vector>

using CGAL::Crude_registration::internal::Depth_buffer;
using CGAL::Crude_registration::internal::Flat_sensor;
using CGAL::Crude_registration::internal::Vector_f;
using generated::Random;
using generated::Rigid_motion;
using generated::Vector;

namespace {

Vector_f single(const Vector& v)
{
  return v.cast<float>();
}

// What is made in a frame that looks along +z, in any frame and unit.
struct Placement
{
  Rigid_motion motion;
  double unit;

  Vector_f operator()(const Vector& p) const { return single(motion(unit * p)); }
  Vector_f direction() const { return single(motion.rotation.col(2)); }
};

std::vector<Placement> placements()
{
  Random random(1);
  std::vector<Placement> result = {{Rigid_motion(), 1}};
  for (double unit : {1e-3, 0.3048, 1e3}) result.push_back({random.motion(3 * unit), unit});
  return result;
}

// Samples (x, y, z(x, y)) of the square [-1, 1]^2, 0.01 apart, where z is finite.
template <class Surface>
std::vector<Vector> sampled(const Surface& z)
{
  std::vector<Vector> samples;
  for (int i = -100; i <= 100; ++i)
    for (int j = -100; j <= 100; ++j) {
      const double x = 0.01 * i, y = 0.01 * j, depth = z(x, y);
      if (std::isfinite(depth)) samples.push_back({x, y, depth});
    }
  return samples;
}

constexpr double cell = 0.03;

Depth_buffer orthographic(const std::vector<Vector>& samples, const Placement& at)
{
  std::vector<Vector_f> placed;
  for (const Vector& p : samples) placed.push_back(at(p));
  return Depth_buffer(Flat_sensor::ORTHOGRAPHIC, Vector_f::Zero(), at.direction(), placed, float(cell * at.unit));
}

// The viewpoint is the origin of the frame the samples are in.
Depth_buffer perspective(const std::vector<Vector>& samples, const Placement& at)
{
  std::vector<Vector_f> placed;
  for (const Vector& p : samples) placed.push_back(at(p));
  return Depth_buffer(Flat_sensor::PERSPECTIVE, at(Vector::Zero()), at.direction(), placed, float(cell * at.unit));
}

// in_front() in the unit of the samples. In a row of places it is the same for each, but that of what nothing is known
// of it is enough to say so.
double in_front(const Depth_buffer& depths, const Placement& at, const Vector& p)
{
  using namespace CGAL::Crude_registration::internal;
  Rows places;
  const auto place = [&](int i) { return at((i % 3 == 0 ? 1. : 0.7 + 0.1 * i) * p); };
  for (int i = 0; i < row_size; ++i)
    for (int k = 0; k < 3; ++k) places[std::size_t(k)][i] = place(i)[k];
  const Row row = depths.in_front(places);
  for (int i = 0; i < row_size; ++i) {
    const float alone = depths.in_front(place(i));
    const float nothing_is_known = -1e30f;
    BOOST_TEST_REQUIRE(
        ((alone > nothing_is_known && row[i] == alone) || (!(alone > nothing_is_known) && row[i] < nothing_is_known)));
  }
  return double(depths.in_front(at(p))) / at.unit;
}

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

// Where lines of sight first meet the sphere of radius 1 around (0, 0, 3), as distance from the origin; direction is
// of length 1.
double range_of_sphere(const Vector& direction)
{
  const double b = 3 * direction.z(), d = b * b - 8;
  return d < 0 ? nothing : b - std::sqrt(d);
}

} // namespace

BOOST_AUTO_TEST_CASE(orthographic_plane_at_right_angles)
{
  for (const Placement& at : placements()) {
    const Depth_buffer depths = orthographic(sampled([](double, double) { return 2.; }), at);
    BOOST_TEST(depths.is_known());
    Random random(2);
    for (int i = 0; i < 1000; ++i) {
      const Vector q = 0.9 * random.vector();
      const double height = 3 * random.symmetric(); // behind it, too, and in front of the origin
      BOOST_TEST(std::abs(in_front(depths, at, {q.x(), q.y(), 2 - height}) - height) < 1e-4);
    }
  }
}

// Free space is never claimed where there is none, and most of what there is is known.
BOOST_AUTO_TEST_CASE(orthographic_slope)
{
  for (const Placement& at : placements()) {
    const auto surface = [](double x, double y) { return 2 + 0.8 * x - 0.5 * y; };
    const Depth_buffer depths = orthographic(sampled(surface), at);
    Random random(3);
    for (int i = 0; i < 1000; ++i) {
      const Vector q = 0.9 * random.vector();
      const double height = 0.7 * random.symmetric();
      const double told = in_front(depths, at, {q.x(), q.y(), surface(q.x(), q.y()) - height});
      BOOST_TEST(told < height + 1e-4);
      // No more is given away than three cells' diagonal of the slope.
      BOOST_TEST(told > height - 3 * std::sqrt(2.) * cell * std::hypot(0.8, 0.5));
    }
  }
}

BOOST_AUTO_TEST_CASE(orthographic_step)
{
  for (const Placement& at : placements()) {
    const Depth_buffer depths = orthographic(sampled([](double x, double) { return x < 0 ? 2. : 3.; }), at);
    Random random(4);
    for (int i = 0; i < 1000; ++i) {
      const Vector q = 0.9 * random.vector();
      const double told = in_front(depths, at, {q.x(), q.y(), 2.5});
      // Behind the upper side; in front of the lower one, but at the step nothing is claimed.
      if (q.x() < 0) BOOST_TEST(std::abs(told + 0.5) < 1e-4);
      else if (q.x() > 3 * cell) BOOST_TEST(std::abs(told - 0.5) < 1e-4);
      else BOOST_TEST((std::abs(told + 0.5) < 1e-4 || std::abs(told - 0.5) < 1e-4));
    }
  }
}

BOOST_AUTO_TEST_CASE(nothing_is_known_at_holes_and_outside)
{
  for (const Placement& at : placements()) {
    const Depth_buffer depths =
        orthographic(sampled([](double x, double y) { return std::hypot(x, y) < 0.2 ? nothing : 2.; }), at);
    const auto is_free = [&](double x, double y) { return in_front(depths, at, {x, y, 1}) > 0; };
    BOOST_TEST(is_free(0.5, 0.5));
    BOOST_TEST(is_free(-0.3, 0));
    for (int i = 0; i < 64; ++i) {
      const double a = 2 * generated::pi * i / 64, x = std::cos(a), y = std::sin(a);
      for (double r : {0., 0.1, 0.16}) BOOST_TEST(!is_free(r * x, r * y), "in the hole, at radius " << r);
      const double border = 1 / (std::max)(std::abs(x), std::abs(y));
      for (double r : {border + 1.5 * cell, border + 0.2, 2., 1e3, 1e9})
        BOOST_TEST(!is_free(r * x, r * y), "outside by " << r - border);
    }
    // The cells along the border reach out by no more than their diagonal, and in by little more.
    BOOST_TEST(is_free(0.9, 0));
    BOOST_TEST(is_free(0, -0.9));
  }
}

BOOST_AUTO_TEST_CASE(perspective_sphere)
{
  for (const Placement& at : placements()) {
    // Lines of sight in a cone around the z axis that holds the sphere (its half angle is 19.5 degrees).
    std::vector<Vector> samples;
    for (int i = -130; i <= 130; ++i)
      for (int j = -130; j <= 130; ++j) {
        const Vector direction = Vector(0.003 * i, 0.003 * j, 1).normalized();
        const double range = range_of_sphere(direction);
        if (range > 0) samples.push_back(range * direction);
      }
    const Depth_buffer depths = perspective(samples, at);
    BOOST_TEST(depths.is_known());
    Random random(5);
    for (int i = 0; i < 2000; ++i) {
      const Vector direction = Vector(0.3 * random.symmetric(), 0.3 * random.symmetric(), 1).normalized();
      const double range = range_of_sphere(direction);
      if (!(range > 0)) continue;
      const Vector hit = range * direction;
      const double cosine = -direction.dot(hit - Vector(0, 0, 3)), height = (range - 0.05) * random.symmetric();
      const double told = in_front(depths, at, (range - height) * direction);
      const double slope = std::sqrt(1 - cosine * cosine) / cosine;
      // One more thousandth: a cell's samples lie on the curved surface.
      BOOST_TEST(told < height + 2e-3);
      if (cosine > 0.4) BOOST_TEST(told > height - 3 * std::sqrt(2.) * cell * slope - 0.02);
      // Inside the sphere nothing is free.
      BOOST_TEST(in_front(depths, at, hit + 0.1 * direction) < 0);
    }
    // Past the sphere, behind the viewpoint and at it.
    for (const Vector& p : {Vector(0, 2, 3), Vector(-1.2, 0, 1), Vector(0.6, 0, 1), Vector(0, 0, -1), Vector(3, 1, -2),
                            Vector(0, 0, -1e6), Vector(0, 0, 0)})
      BOOST_TEST(!(in_front(depths, at, p) > 0), "free at " << p.transpose());
    // Between the viewpoint and the sphere.
    for (const Vector& p : {Vector(0, 0, 1), Vector(0.02, -0.01, 0.1), Vector(0.2, 0.2, 1.8)})
      BOOST_TEST(in_front(depths, at, p) > 0);
  }
}

// A sensor that stands in the middle of what it sees, with no more than the opposite direction left out.
BOOST_AUTO_TEST_CASE(perspective_all_around)
{
  const Placement at = placements()[1];
  std::vector<Vector> samples;
  Random random(6);
  while (samples.size() < 200000) {
    const Vector p = random.vector();
    if (p.norm() > 1 || p.norm() < 0.1 || p.normalized().z() < -0.99) continue;
    samples.push_back(p.normalized());
  }
  const Depth_buffer depths = perspective(samples, at);
  for (int i = 0; i < 1000; ++i) {
    const Vector p = random.vector();
    if (p.norm() < 0.1 || p.normalized().z() < -0.9) continue;
    BOOST_TEST(std::abs(in_front(depths, at, p) - (1 - p.norm())) < 1e-4);
  }
}

BOOST_AUTO_TEST_CASE(without_a_sensor_or_samples_nothing_is_known)
{
  const Depth_buffer of_nothing,
      of_no_samples(Flat_sensor::ORTHOGRAPHIC, Vector_f::Zero(), Vector_f::UnitZ(), {}, 0.1f),
      of_no_sensor(Flat_sensor::UNKNOWN, Vector_f::Zero(), Vector_f::UnitZ(), {Vector_f(0, 0, 1)}, 0.1f);
  for (const Depth_buffer* depths : {&of_nothing, &of_no_samples, &of_no_sensor}) {
    BOOST_TEST(!depths->is_known());
    BOOST_TEST(depths->in_front(Vector_f(0, 0, 0)) < 0);
    BOOST_TEST(depths->in_front(Vector_f(1, 2, 3)) < 0);
  }
  // One sample is no surface.
  const Depth_buffer of_one(Flat_sensor::ORTHOGRAPHIC, Vector_f::Zero(), Vector_f::UnitZ(), {Vector_f(0, 0, 1)}, 0.1f);
  BOOST_TEST(of_one.in_front(Vector_f(0, 0, 0)) < 0);
}

BOOST_AUTO_TEST_CASE(places_that_are_not_finite_are_not_known)
{
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  const std::vector<Vector> plane = sampled([](double, double) { return 2.; });
  for (const Depth_buffer& depths : {orthographic(plane, placements()[0]), perspective(plane, placements()[0])})
    for (const Vector_f& p :
         {Vector_f(nan, 0, 1), Vector_f(0, 0, nan), Vector_f(infinity, 0, 1), Vector_f(0, nan, nan)})
      BOOST_TEST(!(depths.in_front(p) > 0));
}

// Cameras write samples they do not have as zero, which is where the camera is.
BOOST_AUTO_TEST_CASE(a_sample_at_the_viewpoint)
{
  std::vector<Vector> samples = sampled([](double, double) { return 2.; });
  samples.push_back(Vector::Zero());
  const Depth_buffer depths = perspective(samples, placements()[0]);
  BOOST_TEST(std::abs(in_front(depths, placements()[0], {0.3, 0.2, 1}) - std::hypot(1, 0.3, 0.2)) < 0.05);
}

// One sample far away leaves the rest known, and memory as it is.
BOOST_AUTO_TEST_CASE(a_sample_far_away)
{
  std::vector<Vector> samples = sampled([](double, double) { return 2.; });
  samples.push_back({50, 0, 2});
  for (const Placement& at : placements()) {
    const Depth_buffer depths = orthographic(samples, at);
    BOOST_TEST(std::abs(in_front(depths, at, {0.3, 0.2, 1}) - 1) < 1e-4);
    BOOST_TEST(in_front(depths, at, {20, 0.2, 1}) < 0);
  }
  samples.back() = {1e9, -1e9, 2};
  const Depth_buffer depths = orthographic(samples, placements()[0]);
  BOOST_TEST(!(in_front(depths, placements()[0], {2, 0.2, 1}) > 0));
}
