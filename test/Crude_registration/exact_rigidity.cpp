// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// Input so near to degenerate that arithmetic in double decides wrongly, and the decisions that the search takes for
// all that. Each test computes the decision in double, too, and says that it is wrong: or it would show nothing.

#define BOOST_TEST_MODULE exact_rigidity
#include <boost/test/unit_test.hpp>

#include <CGAL/Crude_registration/internal/matching/Fourth_vertex.h>
#include <CGAL/Crude_registration/internal/matching/exact_rigidity.h>
#include <CGAL/Crude_registration/internal/matching/flat_trihedra.h>

#include "generated_surfaces.h"

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

using namespace CGAL::Crude_registration::internal;
using generated::Random;

namespace {

// 200 digits: what is computed from double by a few additions and multiplications is exact, and a square root is as
// good as.
using Real = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<200>, boost::multiprecision::et_off>;
using Exact_vector = std::array<Real, 3>;

Exact_vector between(const Vector& p, const Vector& q)
{
  return {Real(q[0]) - Real(p[0]), Real(q[1]) - Real(p[1]), Real(q[2]) - Real(p[2])};
}

Real dot(const Exact_vector& a, const Exact_vector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Exact_vector cross(const Exact_vector& a, const Exact_vector& b)
{
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <class Number>
int sign(const Number& x)
{
  return (x > 0) - (x < 0);
}

using Points = std::array<Vector, 4>;

double volume(const Points& p)
{
  return (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]);
}

int exact_handedness(const Points& p)
{
  return sign(dot(cross(between(p[0], p[1]), between(p[0], p[2])), between(p[0], p[3])));
}

// The signed distance of s from the plane over the edge p q of the triangle p q r, positive on the side of r.
double distance_from_edge(const Vector& p, const Vector& q, const Vector& r, const Vector& s)
{
  const Vector u = q - p, inwards = u.cross(r - p).cross(u);
  return inwards.dot(s - p) / inwards.norm();
}

Real exact_distance_from_edge(const Vector& p, const Vector& q, const Vector& r, const Vector& s)
{
  const Exact_vector u = between(p, q), inwards = cross(cross(u, between(p, r)), u);
  return dot(inwards, between(p, s)) / sqrt(dot(inwards, inwards));
}

// Whether the search takes y for a match of x, vertex by vertex, by the places of the vertices alone.
bool is_match(const Points& x, const Points& y, double tolerance)
{
  const auto described = [](const Points& p) {
    Matching_vertices v;
    v.points.assign(p.begin(), p.end());
    v.normals.assign(4, Vector(0, 0, 1));
    v.minimum_curvatures.assign(4, 0);
    v.maximum_curvatures.assign(4, 0);
    v.inside.assign(4, 1);
    return v;
  };
  Match_tolerances t;
  t.length = tolerance;
  t.angle = 1;
  t.curvature = 1;
  t.use_normals = false;
  const std::vector<Spatial_trihedron> trihedra = {{0, {1, 2, 3}}};
  const auto found = match_trihedra(described(x), trihedra, described(y), t);
  return std::any_of(found.begin(), found.end(), [](const Candidate_motion& c) {
    return c.vertices == std::array<std::int32_t, 4>{0, 1, 2, 3};
  });
}

// Two consecutive Fibonacci numbers, about 2.5e12 and 4.1e12 and their sum 6.6e12: the triangle of 0, (b, a) and
// (a + b, b) has twice the area b b - a (a + b) = 1 or -1, and products that double rounds to the same.
std::pair<double, double> fibonacci()
{
  double a = 0, b = 1;
  for (int i = 0; i < 60; ++i) {
    const double c = a + b;
    a = b;
    b = c;
  }
  return {a, b};
}

// A triangle in the plane z = 0 that is 1e-13 wide and 1e12 long.
Points thin_trihedron(const Vector& fourth)
{
  const auto [a, b] = fibonacci();
  return {Vector(0, 0, 0), Vector(b, a, 0), Vector(a + b, b, 0), fourth};
}

} // namespace

BOOST_AUTO_TEST_CASE(six_lengths)
{
  const double tolerance = 0.25;
  const Points x = {Vector(0, 0, 0), Vector(1, 0, 0), Vector(0, 1, 0), Vector(0, 0, 1)};
  // One arm is longer by exactly the tolerance; one step aside makes it longer by more, by what double cannot tell.
  Points y = x;
  y[1] = Vector(1.25, 0, 0);
  BOOST_TEST(is_match(x, y, tolerance));
  y[1] = Vector(1.25, std::ldexp(1., -30), 0);
  BOOST_TEST((y[1] - y[0]).norm() - (x[1] - x[0]).norm() <= tolerance); // in double
  BOOST_TEST(!lengths_agree(x[0], x[1], y[0], y[1], tolerance));
  BOOST_TEST(!is_match(x, y, tolerance));

  // Each of the six as much longer as it may be, and more.
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j) {
      const double limit = j == 1 ? tolerance : 2 * tolerance;
      Points z = x;
      for (double factor : {0.99, 1.01}) {
        z[j] = x[i] + (x[j] - x[i]) * (1 + factor * limit / (x[j] - x[i]).norm());
        BOOST_TEST(lengths_agree(x[i], x[j], z[i], z[j], limit) == (factor < 1));
        BOOST_TEST((factor < 1 || !are_rigid(x, z, tolerance)));
      }
    }
  BOOST_TEST(are_rigid(x, x, 0));
}

BOOST_AUTO_TEST_CASE(lengths_at_their_limits_vs_200_digits)
{
  Random random(1);
  std::size_t wrong_in_double = 0, longer = 0, shorter = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vector p = random.vector(), q = random.vector(), r = random.vector(), s = random.vector();
    const double in_double = std::abs((p - q).norm() - (r - s).norm());
    // The difference in double and its neighbours are as near to the limit as double comes.
    const double tolerance = i % 3 == 0   ? in_double
                             : i % 3 == 1 ? std::nextafter(in_double, 0.)
                                          : std::nextafter(in_double, 4.);
    const Exact_vector a = between(p, q), b = between(r, s);
    const bool agree = abs(sqrt(dot(a, a)) - sqrt(dot(b, b))) <= Real(tolerance);
    BOOST_TEST(lengths_agree(p, q, r, s, tolerance) == agree);
    BOOST_TEST(lengths_agree(r, s, q, p, tolerance) == agree);
    wrong_in_double += (in_double <= tolerance) != agree;
    const double length = i % 2 == 0 ? (p - q).norm() : std::nextafter((p - q).norm(), 0.);
    const int compared = sign(Real(sqrt(dot(a, a)) - Real(length)));
    BOOST_TEST(int(compare_distance(p, q, length)) == compared);
    longer += compared > 0;
    shorter += compared < 0;
  }
  BOOST_TEST(wrong_in_double > 500u);
  BOOST_TEST(longer > 500u);
  BOOST_TEST(shorter > 500u);
  // In the largest and the smallest unit that there is.
  for (double unit : {1e75, 1e-75}) {
    const Vector o(0, 0, 0), a(unit, 0, 0), b(0, 1.25 * unit, 0), c(0, 1.25 * unit, 1e-9 * unit);
    BOOST_TEST(lengths_agree(o, a, o, b, b.y() - a.x()));
    BOOST_TEST(!lengths_agree(o, a, o, c, b.y() - a.x()));
  }
}

BOOST_AUTO_TEST_CASE(collinear_vertices)
{
  // On a line through the origin, all digits of the coordinates being used: their differences are rounded, and double
  // finds an area.
  const Vector p(0.1, 0.7, 0.3), o = -p / 8, q = p / 2;
  const Vector n = (p - o).cross(q - o);
  BOOST_TEST(!n.isZero(0)); // in double
  BOOST_TEST(are_collinear(o, p, q));
  BOOST_TEST(Triangle_normal(o, p, q).vector.isZero(0));
  // No match of a trihedron that is flat by no more than the tolerance allows for.
  const double tolerance = 0.02;
  const Vector aside = 0.5 * tolerance * p.unitOrthogonal(), above = 0.3 * p.cross(aside).normalized();
  const Points x = {o, p, q + aside, above}, y = {o, p, q, above};
  BOOST_TEST(are_rigid(x, y, tolerance));
  BOOST_TEST(is_match(x, x, tolerance));
  BOOST_TEST(!is_match(x, y, tolerance));

  // On no line, but double finds no area: a match of itself for all that.
  const Points thin = thin_trihedron(Vector(5e11, -7e11, 9e11));
  BOOST_TEST((thin[1] - thin[0]).cross(thin[2] - thin[0]).isZero(0)); // in double
  BOOST_TEST(!are_collinear(thin[0], thin[1], thin[2]));
  BOOST_TEST(std::abs(std::abs(Triangle_normal(thin[0], thin[1], thin[2]).vector.z()) - 1) < 1e-15);
  BOOST_TEST(is_match(thin, thin, 1e10));
}

BOOST_AUTO_TEST_CASE(mirror_images)
{
  // Four points in the plane z = 3x + 5y, one of them a step above it or below it.
  Random random(3);
  std::size_t wrong_in_double = 0;
  for (int i = 0; i < 200; ++i) {
    Points x;
    for (Vector& p : x) {
      const double u = std::round(std::ldexp(random.symmetric(), 40)),
                   v = std::round(std::ldexp(random.symmetric(), 40));
      p = Vector(u, v, 3 * u + 5 * v);
    }
    Points y = x;
    const double size = std::ldexp(1., 44);
    x[3].z() = std::nextafter(x[3].z(), size);
    y[3].z() = std::nextafter(y[3].z(), -size);
    if (std::abs((x[1] - x[0]).cross(x[2] - x[0]).z()) < std::ldexp(1., 78)) continue; // thin
    const int hand = exact_handedness(x);
    BOOST_TEST(hand != 0);
    BOOST_TEST(exact_handedness(y) == -hand);
    BOOST_TEST(int(handedness(x)) == hand);
    BOOST_TEST(int(handedness(y)) == -hand);
    const double tolerance = 0.01 * (x[1] - x[0]).norm();
    BOOST_TEST(is_match(x, x, tolerance));
    BOOST_TEST(!is_match(x, y, tolerance));
    wrong_in_double += sign(volume(x)) == sign(volume(y));
  }
  BOOST_TEST(wrong_in_double > 20u);
}

BOOST_AUTO_TEST_CASE(the_side_of_the_triangle)
{
  // From the line of the thin triangle as far as it is high over the plane, on one side or on the other: in each case
  // all six lengths and the handedness are the same.
  const auto [a, b] = fibonacci();
  const Vector line = Vector(b, a, 0).normalized(), across = Vector(-line.y(), line.x(), 0), up(0, 0, 1);
  const Points x = thin_trihedron(1e12 * (line + across + up)), y = thin_trihedron(1e12 * (line - across + up));
  const double tolerance = 1e10;
  BOOST_TEST(are_rigid(x, y, tolerance));
  BOOST_TEST(int(handedness(x)) == int(handedness(y)));
  const Real there = exact_distance_from_edge(x[0], x[1], x[2], x[3]),
             other = exact_distance_from_edge(y[0], y[1], y[2], y[3]);
  BOOST_TEST(sign(there) == -sign(other));
  // In double neither has a side, nor a place.
  BOOST_TEST(!std::isfinite(distance_from_edge(x[0], x[1], x[2], x[3])));
  const Vector n = (x[1] - x[0]).cross(x[2] - x[0]);
  BOOST_TEST(!(n / n.squaredNorm()).allFinite());
  BOOST_TEST(int(side_of_edge(x[0], x[1], x[2], x[3], 2 * tolerance)) == sign(there));
  BOOST_TEST(int(side_of_edge(y[0], y[1], y[2], y[3], 2 * tolerance)) == sign(other));
  BOOST_TEST(is_match(x, x, tolerance));
  BOOST_TEST(is_match(y, y, tolerance));
  BOOST_TEST(!is_match(x, y, tolerance));
  BOOST_TEST(!is_match(y, x, tolerance));
  // The place of the fourth vertex of the same triangle is the fourth vertex.
  const Triangle_normal normal(x[0], x[1], x[2]);
  BOOST_TEST((Fourth_vertex(x, tolerance).place(x, normal) - x[3]).norm() < 1e-3);

  // Points that are as far from the plane over an edge as the margin is, but for rounding.
  Random random(5);
  std::size_t wrong_in_double = 0, within = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector p = random.vector(), q = random.vector(), r = random.vector(), s = random.vector();
    const double in_double = distance_from_edge(p, q, r, s), margin = std::abs(in_double);
    const Real exact = exact_distance_from_edge(p, q, r, s);
    const bool is_within = abs(exact) <= Real(margin);
    BOOST_TEST(int(side_of_edge(p, q, r, s, margin)) == (is_within ? 0 : sign(exact)));
    BOOST_TEST(int(side_of_edge(p, q, r, s, 0)) == sign(exact));
    wrong_in_double += !is_within; // in double it is
    within += is_within;
  }
  BOOST_TEST(wrong_in_double > 300u);
  BOOST_TEST(within > 300u);
}

BOOST_AUTO_TEST_CASE(the_fourth_vertex_stays_on_its_side_of_an_edge)
{
  // v3 is over the further side of the edge (V, v1) of a narrow triangle; in a match that is narrower yet, a vertex on
  // the other side is within the tolerance of its place. That is no match unless v3 itself is near the edge.
  const double tolerance = 1;
  const Points y = {Vector(0, 0, 0), Vector(10, 0, 0), Vector(5, 0.91, 0), Vector(5, -0.04, 6)};
  for (const auto& [from_edge, is_near] : {std::pair(2., true), std::pair(std::nextafter(2., 3.), false)}) {
    const Points x = {Vector(0, 0, 0), Vector(10, 0, 0), Vector(5, 1.9, 0), Vector(5, from_edge, 6)};
    BOOST_TEST(are_rigid(x, y, tolerance));
    const Fourth_vertex fourth(x, tolerance);
    BOOST_TEST((fourth.place(y, Triangle_normal(y[0], y[1], y[2])) - y[3]).norm() < tolerance);
    BOOST_TEST(fourth.is_on_its_side(y) == is_near);
    BOOST_TEST(is_match(x, y, tolerance) == is_near);
    BOOST_TEST(is_match(x, x, tolerance));
  }
}

BOOST_AUTO_TEST_CASE(barycentric_coordinates_of_the_projection)
{
  Random random(7);
  for (int i = 0; i < 300; ++i) {
    // Far from the origin, in all directions.
    const Vector far = 1e3 * random.vector();
    Points x;
    for (Vector& p : x) p = far + random.vector();
    const auto c = coordinates_of_projection<CGAL::Simple_cartesian<double>>(x);
    const auto e = coordinates_of_projection<Exact_kernel>(x);
    const Vector n = (x[1] - x[0]).cross(x[2] - x[0]);
    if (n.norm() < 0.05 * (x[1] - x[0]).norm() * (x[2] - x[0]).norm()) continue;
    const Vector foot = c[0] * x[0] + c[1] * x[1] + c[2] * x[2];
    BOOST_TEST(std::abs(c[0] + c[1] + c[2] - 1) < 1e-10);
    BOOST_TEST((x[3] - foot).cross(n).norm() < 1e-8); // along the normal
    BOOST_TEST((e[0] + e[1] + e[2] == 1));
    for (std::size_t k = 0; k < 3; ++k) BOOST_TEST(std::abs(c[k] - CGAL::to_double(e[k])) < 1e-9 / n.norm());
    // Where the triangle is the same the place is the vertex itself.
    const Triangle_normal normal(x[0], x[1], x[2]);
    BOOST_TEST(!normal.is_thin);
    BOOST_TEST((Fourth_vertex(x, 0.1).place(x, normal) - x[3]).norm() < 1e-9);
    // In a motion it is moved, and a mirror image is not on its side.
    const Rigid_motion motion = random.motion(3);
    Points y;
    std::transform(x.begin(), x.end(), y.begin(), motion);
    BOOST_TEST((Fourth_vertex(x, 0.1).place(y, Triangle_normal(y[0], y[1], y[2])) - y[3]).norm() < 1e-8);
    BOOST_TEST(Fourth_vertex(x, 0.1).is_on_its_side(y));
    for (Vector& p : y) p.x() = -p.x();
    BOOST_TEST(!Fourth_vertex(x, 0.1).is_on_its_side(y));
  }
}
