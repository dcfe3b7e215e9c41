#define BOOST_TEST_MODULE surfel_field
#include <boost/test/unit_test.hpp>

#include "generated_surfaces.h"

#include <CGAL/Crude_registration/internal/lookup/Surfel_field.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

using CGAL::Crude_registration::internal::Surfel;
using CGAL::Crude_registration::internal::Surfel_field;
using CGAL::Crude_registration::internal::Vector_f;
using generated::Random;
using generated::Vector;

namespace {

Vector_f in_cube(Random& random)
{
  return random.vector().cast<float>();
}

std::vector<Surfel> surfels_at(const std::vector<Vector_f>& positions)
{
  std::vector<Surfel> surfels(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    surfels[i].position = positions[i];
    surfels[i].normal = Vector_f::UnitZ();
  }
  return surfels;
}

// Points in a cube, and on a sphere.
std::vector<Surfel> in_cube(std::size_t n, unsigned seed)
{
  Random random(seed);
  std::vector<Vector_f> positions;
  for (std::size_t i = 0; i < n; ++i) positions.push_back(in_cube(random));
  return surfels_at(positions);
}

std::vector<Surfel> on_sphere(std::size_t n, unsigned seed)
{
  std::vector<Surfel> surfels = in_cube(n, seed);
  for (Surfel& s : surfels) s.position.normalize();
  return surfels;
}

// Where on a line along `axis` through p the answer of the field changes, from p on; NaN if nowhere within `length`.
double next_change(const Surfel_field& field, Vector_f p, int axis, float step, float length)
{
  const float start = p[axis];
  const int first = field.nearest(p);
  for (float from = start; from < start + length; from += step) {
    p[axis] = from + step;
    if (field.nearest(p) == first) continue;
    float low = from, high = from + step;
    for (int i = 0; i < 40; ++i) {
      p[axis] = 0.5f * (low + high);
      (field.nearest(p) == first ? low : high) = p[axis];
    }
    return double(low);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

// The lattice of voxels shows where answers change: at the same places modulo the edge of a voxel on every line.
Vector lattice(const Surfel_field& field, float voxel)
{
  Random random(3);
  Vector origin;
  for (int axis = 0; axis < 3; ++axis) {
    int found = 0;
    for (int line = 0; line < 300 && found < 40; ++line) {
      const double x = next_change(field, in_cube(random), axis, voxel / 8, 4 * voxel);
      if (std::isnan(x)) continue;
      if (found++ == 0) origin[axis] = x;
      const double voxels = (x - origin[axis]) / double(voxel);
      BOOST_TEST(std::abs(voxels - std::round(voxels)) < 1e-4);
    }
    BOOST_TEST_REQUIRE(found > 5);
  }
  return origin;
}

// Every place is told the surfel that is nearest to the centre of its voxel, where that is within reach.
void check_against_brute_force(const std::vector<Surfel>& surfels, float voxel, float reach)
{
  const Surfel_field field(surfels, voxel, reach);
  const Vector origin = lattice(field, voxel);
  Random random(4);
  std::size_t answers = 0, none = 0, wrong = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vector_f p = 1.5f * in_cube(random);
    Vector centre;
    bool is_at_border = false;
    for (int k = 0; k < 3; ++k) {
      const double x = (double(p[k]) - origin[k]) / double(voxel);
      is_at_border = is_at_border || std::abs(x - std::round(x)) < 1e-3;
      centre[k] = origin[k] + (std::floor(x) + 0.5) * double(voxel);
    }
    if (is_at_border) continue;
    double nearest = (std::numeric_limits<double>::max)();
    for (const Surfel& s : surfels) nearest = (std::min)(nearest, (s.position.cast<double>() - centre).norm());
    const int j = field.nearest(p);
    const double slack = 1e-4 * double(voxel);
    if (j == Surfel_field::none) {
      ++none;
      wrong += nearest < double(reach) - slack;
    } else {
      ++answers;
      BOOST_TEST_REQUIRE(std::size_t(j) < surfels.size());
      const double distance = (surfels[std::size_t(j)].position.cast<double>() - centre).norm();
      wrong += distance > double(reach) + slack || distance > nearest + slack;
    }
  }
  BOOST_TEST(wrong == 0u);
  BOOST_TEST(answers > 100u);
  BOOST_TEST(none > 100u);
}

} // namespace

BOOST_AUTO_TEST_CASE(is_nearest_to_the_centre_of_the_voxel_vs_brute_force)
{
  check_against_brute_force(in_cube(40, 1), 0.13f, 0.3f);
  check_against_brute_force(on_sphere(500, 1), 0.1f, 0.16f);
  check_against_brute_force(on_sphere(500, 2), 0.05f, 0.2f);
  check_against_brute_force(on_sphere(60, 3), 0.2f, 0.21f);
}

BOOST_AUTO_TEST_CASE(a_surfel_finds_itself_or_a_nearer_one)
{
  const std::vector<Surfel> surfels = on_sphere(2000, 5);
  const float voxel = 0.04f;
  const Surfel_field field(surfels, voxel, 2 * voxel);
  for (const Surfel& s : surfels) {
    const int j = field.nearest(s.position);
    BOOST_TEST_REQUIRE(j != Surfel_field::none);
    // Both are within half a diagonal of the voxel's centre.
    BOOST_TEST((surfels[std::size_t(j)].position - s.position).norm() <= 1.74f * voxel);
  }
}

BOOST_AUTO_TEST_CASE(of_surfels_in_one_place_the_first_is_told)
{
  std::vector<Surfel> surfels = on_sphere(300, 6);
  const std::size_t n = surfels.size();
  for (std::size_t i = 0; i < n; ++i) surfels.push_back(surfels[i]);
  const Surfel_field field(surfels, 0.1f, 0.3f);
  for (std::size_t i = 0; i < n; ++i) BOOST_TEST(field.nearest(surfels[i].position) < int(n));
}

BOOST_AUTO_TEST_CASE(nothing_is_told_where_nothing_is)
{
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  const Surfel_field of_nothing, of_no_surfels({}, 0.1f, 0.2f), field(on_sphere(300, 7), 0.1f, 0.2f);
  for (const Vector_f& p :
       {Vector_f(0, 0, 0), Vector_f(2, 0, 0), Vector_f(-2, 0, 0), Vector_f(0, 0, 1e30f), Vector_f(0, -1e30f, 0),
        Vector_f(nan, 0, 1), Vector_f(0, infinity, 1), Vector_f(0, 0, -infinity)}) {
    BOOST_TEST(of_nothing.nearest(p) == Surfel_field::none);
    BOOST_TEST(of_no_surfels.nearest(p) == Surfel_field::none);
    BOOST_TEST(field.nearest(p) == Surfel_field::none);
  }
}

BOOST_AUTO_TEST_CASE(one_surfel)
{
  const Surfel_field field(surfels_at({Vector_f(5, -7, 11)}), 0.1f, 0.25f);
  BOOST_TEST(field.nearest(Vector_f(5, -7, 11)) == 0);
  BOOST_TEST(field.nearest(Vector_f(5.1f, -7, 11)) == 0);
  BOOST_TEST(field.nearest(Vector_f(5.5f, -7, 11)) == Surfel_field::none);
}

BOOST_AUTO_TEST_CASE(a_spike_far_away_hides_nothing)
{
  std::vector<Surfel> surfels = on_sphere(500, 8);
  const float voxel = 0.1f;
  const Surfel_field without(surfels, voxel, 2 * voxel);
  for (const Vector_f& spike :
       {Vector_f(300, 0, 0), Vector_f(0, -1e5f, 0), Vector_f(1e7f, 1e7f, 1e7f), Vector_f(0, 0, -1e12f)}) {
    std::vector<Surfel> spoilt = surfels;
    spoilt.push_back(surfels_at({spike}).front());
    const Surfel_field field(spoilt, voxel, 2 * voxel);
    std::size_t lost = 0;
    for (const Surfel& s : surfels) lost += field.nearest(s.position) == Surfel_field::none;
    BOOST_TEST(lost == 0u, "spike at " << spike.transpose() << " hides " << lost << " surfels");
  }
}

// Multiplication by a power of two is exact.
BOOST_AUTO_TEST_CASE(the_unit_does_not_matter)
{
  const std::vector<Surfel> surfels = on_sphere(500, 9);
  const Surfel_field field(surfels, 0.1f, 0.2f);
  for (const float unit : {0.0009765625f, 1024.f}) {
    std::vector<Surfel> scaled = surfels;
    for (Surfel& s : scaled) s.position *= unit;
    const Surfel_field other(scaled, unit * 0.1f, unit * 0.2f);
    Random random(10);
    std::size_t different = 0;
    for (int i = 0; i < 5000; ++i) {
      const Vector_f p = 1.2f * in_cube(random);
      different += field.nearest(p) != other.nearest(unit * p);
    }
    BOOST_TEST(different == 0u);
  }
}

BOOST_AUTO_TEST_CASE(as_many_as_it_can_hold)
{
  std::vector<Surfel> surfels = on_sphere(Surfel_field::maximum_size, 11);
  const float voxel = 0.02f;
  const Surfel_field field(surfels, voxel, 2 * voxel);
  bool last_is_told = false;
  for (std::size_t i = surfels.size() - 200; i < surfels.size(); ++i) {
    const int j = field.nearest(surfels[i].position);
    BOOST_TEST_REQUIRE(j != Surfel_field::none);
    BOOST_TEST((surfels[std::size_t(j)].position - surfels[i].position).norm() <= 1.74f * voxel);
    last_is_told = last_is_told || std::size_t(j) > surfels.size() - 3000;
  }
  BOOST_TEST(last_is_told);
}
