// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#define BOOST_TEST_MODULE Curvature_tensors
#include <boost/test/unit_test.hpp>

#include "generated_surfaces.h"

#include <CGAL/Crude_registration/internal/mesh/mesh_geometry.h>
#include <CGAL/Crude_registration/internal/reduction/Curvature_average.h>
#include <CGAL/Crude_registration/internal/reduction/Curvature_tensors.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

using namespace CGAL::Crude_registration::internal;

namespace {

// The curvature in the direction of the projection of `direction` into the tangent plane.
double normal_curvature(const Curvature_field& field, std::size_t i, const Vector& direction)
{
  const Tangent_frame frame(field.normals[i]);
  const double x = frame.u.dot(direction), y = frame.v.dot(direction), length2 = x * x + y * y;
  const Curvature_tensor& t = field.tensors[i];
  return (t.uu * x * x + 2 * t.uv * x * y + t.vv * y * y) / length2;
}

// Root mean square, over the vertices inside, of the differences to the true principal curvatures that
// truth(point) = {minimum, maximum} returns.
template <class Truth>
double error(const Flat_mesh& mesh, const Curvature_field& field, const Truth& truth)
{
  const std::vector<std::uint8_t> borders = border_flags(mesh);
  const Index_lists neighbours = neighbours_of_vertices(mesh);
  double sum = 0, n = 0;
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    // The normals on the border are one-sided, and those are the neighbours' differences.
    if (borders[i] || std::any_of(neighbours.begin(i), neighbours.end(i),
                                  [&](std::int32_t v) { return borders[std::size_t(v)] != 0; }))
      continue;
    const std::array<double, 2> k = truth(mesh.points[i]);
    sum += std::pow(field.tensors[i].minimum() - k[0], 2) + std::pow(field.tensors[i].maximum() - k[1], 2);
    n += 2;
  }
  BOOST_TEST_REQUIRE(n > 0);
  return std::sqrt(sum / n);
}

// Where the vertices are spaced evenly up to a smooth change, each halving of the edges has to leave at most 0.6 times
// the error. Where they are jittered, the error of a vertex does not vanish (a property of the method: the error of the
// normals shrinks with the edges, which it is divided by), but stays a few per cent of the curvature, and that of the
// average over a fixed radius vanishes.
template <class Make_mesh, class Truth>
void check_convergence(const Make_mesh& make_mesh, const Truth& truth, double curvature, double radius)
{
  double even = 0, averaged = 0;
  for (int level = 0; level < 3; ++level) {
    const Flat_mesh mesh = make_mesh(16 << level, 0.0), jittered = make_mesh(16 << level, 0.25);
    const double e = error(mesh, curvature_tensors(mesh), truth);
    Curvature_field field = curvature_tensors(jittered);
    const double f = error(jittered, field, truth);
    field.tensors = average_tensors(jittered, field, radius);
    const double a = error(jittered, field, truth);
    BOOST_TEST_MESSAGE("level " << level << " error " << e << ", jittered " << f << ", averaged " << a);
    if (level > 0) BOOST_TEST(e < 0.6 * even + 1e-10 * curvature); // a cylinder leaves rounding only
    if (level > 0) BOOST_TEST(a < 0.8 * averaged);
    BOOST_TEST(f < 0.05 * curvature);
    even = e;
    averaged = a;
  }
  BOOST_TEST(even < 0.01 * curvature);
}

// A smooth change of the spacing.
double warped(double t)
{
  return t + 0.02 * std::sin(2 * generated::pi * t);
}

} // namespace

BOOST_AUTO_TEST_CASE(tangent_frames_are_orthonormal_and_right_handed)
{
  generated::Random random(1);
  std::vector<Vector> normals = {Vector::UnitX(), Vector::UnitY(), Vector::UnitZ(), -Vector::UnitZ(),
                                 Vector(1e-300, 0, -1)};
  for (int i = 0; i < 100; ++i) normals.push_back(random.vector().normalized());
  for (const Vector& n : normals) {
    const Tangent_frame f(n);
    BOOST_TEST(std::abs(f.u.norm() - 1) < 1e-14);
    BOOST_TEST(std::abs(f.v.norm() - 1) < 1e-14);
    BOOST_TEST((f.u.cross(f.v) - n).norm() < 1e-14);
  }
}

BOOST_AUTO_TEST_CASE(principal_curvatures_of_a_tensor)
{
  // 3 along an axis at the angle 0.4, -1 across.
  const double c = std::cos(0.4), s = std::sin(0.4);
  Curvature_tensor t;
  t.uu = 3 * c * c - s * s;
  t.uv = 4 * c * s;
  t.vv = 3 * s * s - c * c;
  BOOST_TEST(std::abs(t.maximum() - 3) < 1e-14);
  BOOST_TEST(std::abs(t.minimum() + 1) < 1e-14);
  BOOST_TEST(std::abs(t.gaussian() + 3) < 1e-14);
  BOOST_TEST(std::abs(t.direction_of_maximum()[0] - c) < 1e-14);
  BOOST_TEST(std::abs(t.direction_of_maximum()[1] - s) < 1e-14);
}

BOOST_AUTO_TEST_CASE(rotating_a_tensor_keeps_its_curvatures_and_is_undone_by_rotating_back)
{
  generated::Random random(2);
  for (int i = 0; i < 100; ++i) {
    const Vector n = random.vector().normalized();
    const Vector m = (n + 0.8 * random.vector()).normalized();
    Curvature_tensor t, rotated, back;
    t.uu = random.symmetric();
    t.uv = random.symmetric();
    t.vv = random.symmetric();
    BOOST_TEST_REQUIRE(rotate_tensor(t, Tangent_frame(n).u, n, m, rotated));
    BOOST_TEST(std::abs(rotated.maximum() - t.maximum()) < 1e-13);
    BOOST_TEST(std::abs(rotated.minimum() - t.minimum()) < 1e-13);
    BOOST_TEST_REQUIRE(rotate_tensor(rotated, Tangent_frame(m).u, m, n, back));
    BOOST_TEST(std::abs(back.uu - t.uu) + std::abs(back.uv - t.uv) + std::abs(back.vv - t.vv) < 1e-12);
  }
  Curvature_tensor t;
  BOOST_TEST(!rotate_tensor(t, Vector::UnitX(), Vector::UnitZ(), -Vector::UnitZ(), t));
}

BOOST_AUTO_TEST_CASE(sphere)
{
  // The normals are exact, and so, on a sphere, are the differences along edges: nothing is left but rounding.
  const double r = 2.5;
  const Flat_mesh mesh = generated::sphere(10, r);
  const Curvature_field field = curvature_tensors(mesh);
  for (const Curvature_tensor& t : field.tensors) {
    BOOST_TEST(std::abs(t.minimum() - 1 / r) < 1e-10);
    BOOST_TEST(std::abs(t.maximum() - 1 / r) < 1e-10);
  }
}

BOOST_AUTO_TEST_CASE(cylinder)
{
  const double r = 0.5;
  const auto make = [&](int n, double jitter) {
    return generated::grid(
        n, n,
        [&](double u, double v) { return Vector(r * std::cos(2 * warped(u)), r * std::sin(2 * warped(u)), warped(v)); },
        jitter);
  };
  check_convergence(
      make,
      [&](const Vector&) {
        return std::array<double, 2>{0, 1 / r};
      },
      1 / r, 0.2);

  // It bends around the axis, not along it.
  const Flat_mesh mesh = make(64, 0.25);
  const Curvature_field field = curvature_tensors(mesh);
  const std::size_t middle = mesh.points.size() / 2;
  BOOST_TEST(std::abs(normal_curvature(field, middle, Vector::UnitZ())) < 0.05 / r);
  BOOST_TEST(std::abs(normal_curvature(field, middle, field.normals[middle].cross(Vector::UnitZ())) - 1 / r) <
             0.05 / r);
}

BOOST_AUTO_TEST_CASE(torus)
{
  const double R = 3, r = 1;
  check_convergence([&](int n, double jitter) { return generated::torus(3 * n, n, R, r, jitter); },
                    [&](const Vector& p) {
                      const double c = (std::hypot(p.x(), p.y()) - R) / r; // cosine around the tube
                      return std::array<double, 2>{c / (R + r * c), 1 / r};
                    },
                    1 / r, 0.2);
}

BOOST_AUTO_TEST_CASE(saddle)
{
  // z = (x^2 - y^2) / 2, seen from above.
  const auto truth = [](const Vector& p) {
    // First and second fundamental forms of a height field; convex seen from above is negative definite.
    const double fx = p.x(), fy = -p.y(), w = std::sqrt(1 + fx * fx + fy * fy);
    const double E = 1 + fx * fx, F = fx * fy, G = 1 + fy * fy, L = -1 / w, N = 1 / w;
    const double gaussian = L * N / (E * G - F * F), mean = (E * N + G * L) / (2 * (E * G - F * F));
    const double d = std::sqrt(mean * mean - gaussian);
    return std::array<double, 2>{mean - d, mean + d};
  };
  const auto make = [](int n, double jitter) {
    return generated::grid(
        n, n,
        [](double u, double v) {
          const double x = 1.6 * (warped(u) - 0.5), y = 1.6 * (warped(v) - 0.5);
          return Vector(x, y, 0.5 * (x * x - y * y));
        },
        jitter);
  };
  check_convergence(make, truth, 1, 0.2);

  // At the saddle's centre it bends towards the viewer along x: concave, negative.
  const Flat_mesh mesh = make(64, 0.25);
  const Curvature_field field = curvature_tensors(mesh);
  const std::size_t centre = mesh.points.size() / 2;
  BOOST_TEST(std::abs(normal_curvature(field, centre, Vector::UnitX()) + 1) < 0.1);
  BOOST_TEST(std::abs(normal_curvature(field, centre, Vector::UnitY()) - 1) < 0.1);
}

BOOST_AUTO_TEST_CASE(coarse_meshes_with_good_normals)
{
  // Eight faces around the tube, with the surface's own normals: still within a tenth.
  const double R = 3, r = 1;
  const Flat_mesh mesh = generated::torus(24, 8, R, r);
  std::vector<Vector> normals;
  for (const Vector& p : mesh.points) {
    const Vector axis = Vector(p.x(), p.y(), 0).normalized() * R;
    normals.push_back((p - axis).normalized());
  }
  const double e = error(mesh, curvature_tensors(mesh, normals), [&](const Vector& p) {
    const double c = (std::hypot(p.x(), p.y()) - R) / r;
    return std::array<double, 2>{c / (R + r * c), 1 / r};
  });
  BOOST_TEST(e < 0.1);
}

BOOST_AUTO_TEST_CASE(areas_of_vertices_add_up_to_the_surface)
{
  const Flat_mesh mesh = generated::bumps(9);
  const Curvature_field field = curvature_tensors(mesh);
  double sum = 0, expected = 0;
  for (double a : field.areas) {
    BOOST_TEST(a > 0);
    sum += a;
  }
  for (const auto& f : mesh.faces) expected += 0.5 * area_vector(mesh, f).norm();
  BOOST_TEST(sum == expected, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(motion_and_scale)
{
  generated::Random random(5);
  const Flat_mesh mesh = generated::bumps(15);
  const Curvature_field field = curvature_tensors(mesh);
  for (double scale : {1.0, 1e-3, 0.3048, 1e6, 1e-72, 1e72}) {
    const Rigid_motion motion = random.motion(3 * scale);
    const Curvature_field other = curvature_tensors(generated::moved(mesh, motion, scale));
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
      const Vector direction = Tangent_frame(field.normals[i]).u;
      BOOST_TEST((other.normals[i] - motion.rotation * field.normals[i]).norm() < 1e-9);
      BOOST_TEST(std::abs(scale * other.tensors[i].minimum() - field.tensors[i].minimum()) < 1e-7);
      BOOST_TEST(std::abs(scale * other.tensors[i].maximum() - field.tensors[i].maximum()) < 1e-7);
      BOOST_TEST(std::abs(scale * normal_curvature(other, i, motion.rotation * direction) -
                          normal_curvature(field, i, direction)) < 1e-7);
    }
  }
}

BOOST_AUTO_TEST_CASE(seen_from_the_other_side_the_sign_changes)
{
  Flat_mesh mesh = generated::bumps(15);
  const Curvature_field field = curvature_tensors(mesh);
  for (auto& f : mesh.faces) std::swap(f[0], f[1]);
  const Curvature_field other = curvature_tensors(mesh);
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    BOOST_TEST(std::abs(other.tensors[i].maximum() + field.tensors[i].minimum()) < 1e-9);
}

BOOST_AUTO_TEST_CASE(degenerate_faces_do_not_count)
{
  Flat_mesh mesh = generated::bumps(6);
  const Curvature_field expected = curvature_tensors(mesh);
  const auto n = std::int32_t(mesh.points.size());
  mesh.points.push_back(mesh.points[3]);
  mesh.points.push_back(Vector(7, 7, 7)); // isolated
  mesh.faces.push_back({3, n, 20});       // without area
  mesh.faces.push_back({5, 5, 9});
  const Curvature_field field = curvature_tensors(mesh);
  for (std::size_t i = 0; i < std::size_t(n); ++i) {
    BOOST_TEST(field.tensors[i].uu == expected.tensors[i].uu);
    BOOST_TEST(field.tensors[i].vv == expected.tensors[i].vv);
  }
  for (std::size_t i = std::size_t(n); i < field.tensors.size(); ++i) {
    BOOST_TEST(field.areas[i] == 0);
    BOOST_TEST(field.tensors[i].maximum() == 0);
  }

  // A face and its reverse: no normal anywhere.
  Flat_mesh twice;
  twice.points = {Vector(0, 0, 0), Vector(1, 0, 0), Vector(0, 1, 0)};
  twice.faces = {{0, 1, 2}, {0, 2, 1}};
  for (const Curvature_tensor& t : curvature_tensors(twice).tensors) BOOST_TEST(t.maximum() == 0);
}

BOOST_AUTO_TEST_CASE(needles_say_what_their_normals_say)
{
  // A cylinder of radius 1 around z, its rings so close that the squared length of an edge along z is lost beside that
  // of one around. The corner of each face that comes first is another one each time.
  for (double spacing : {1e-3, 1e-9, 1e-14, 1e-20, 1e-60, 1e-100, 1e-200})
    for (std::size_t first = 0; first < 3; ++first) {
      Flat_mesh mesh = generated::grid(
          8, 8, [=](double u, double v) { return Vector(std::cos(u), std::sin(u), spacing * v); }, 0.);
      for (auto& f : mesh.faces) std::rotate(f.begin(), f.begin() + std::ptrdiff_t(first), f.end());
      std::vector<Vector> normals;
      for (const Vector& p : mesh.points) normals.emplace_back(p.x(), p.y(), 0);
      const Curvature_field field = curvature_tensors(mesh, normals);
      const bool has_area = spacing > 1e-150;
      BOOST_TEST_CONTEXT(spacing << ", " << first)
      for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        BOOST_TEST(std::abs(field.tensors[i].minimum()) < 0.01);
        BOOST_TEST(std::abs(field.tensors[i].maximum() - (has_area ? 1 : 0)) < 0.01);
        BOOST_TEST((field.areas[i] > 0) == has_area);
      }
    }

  // In the plane: right angles whose cosines are rounded to 0, as the squares of the two long edges are to equal.
  for (double spacing : {1e-9, 1e-100, 1e-300}) {
    const Flat_mesh mesh = generated::grid(
        12, 12, [=](double u, double v) { return Vector(u, spacing * v, 0); }, 0.);
    for (const Curvature_tensor& t : curvature_tensors(mesh).tensors) {
      BOOST_TEST(t.minimum() == 0);
      BOOST_TEST(t.maximum() == 0);
    }
  }
}

BOOST_AUTO_TEST_CASE(an_average_of_noisy_tensors_is_closer_to_the_surface)
{
  // A sphere's cap with noise of a tenth of the sampling distance along z.
  const double r = 1, radius = 0.15;
  generated::Random random(11);
  const auto cap = [&](double u, double v) {
    const double x = 1.2 * (u - 0.5), y = 1.2 * (v - 0.5);
    return Vector(x, y, std::sqrt(r * r - x * x - y * y) + 0.002 * random.symmetric());
  };
  const Flat_mesh mesh = generated::grid(60, 60, cap);
  const Curvature_field field = curvature_tensors(mesh);
  const Index_lists neighbours = neighbours_of_vertices(mesh);
  const std::vector<std::uint8_t> borders = border_flags(mesh);
  Curvature_average average(mesh, neighbours, field, borders);
  double plain = 0, averaged = 0, n = 0;
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const Vector& p = mesh.points[i];
    if (std::max(std::abs(p.x()), std::abs(p.y())) > 0.4) continue;
    const Curvature_average::Result result = average(i, radius);
    BOOST_TEST(result.radius == radius, boost::test_tools::tolerance(1e-12));
    plain += std::pow(field.tensors[i].mean() - 1 / r, 2);
    averaged += std::pow(result.tensor.mean() - 1 / r, 2);
    n += 1;
  }
  BOOST_TEST_MESSAGE("noise of the mean curvature: " << std::sqrt(plain / n) << ", averaged "
                                                     << std::sqrt(averaged / n));
  BOOST_TEST(averaged < plain / 100);
  BOOST_TEST(std::sqrt(averaged / n) < 0.1 / r);
}

BOOST_AUTO_TEST_CASE(averages_near_a_border_shrink_but_exist)
{
  const double r = 1, radius = 0.2;
  const Flat_mesh mesh = generated::grid(40, 40, [&](double u, double v) {
    const double x = 1.2 * (u - 0.5), y = 1.2 * (v - 0.5);
    return Vector(x, y, std::sqrt(r * r - x * x - y * y));
  });
  const Curvature_field field = curvature_tensors(mesh);
  const Index_lists neighbours = neighbours_of_vertices(mesh);
  const std::vector<std::uint8_t> borders = border_flags(mesh);
  Curvature_average average(mesh, neighbours, field, borders);
  bool shrunk = false;
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const Curvature_average::Result result = average(i, radius);
    double to_border = radius;
    for (std::size_t j = 0; j < mesh.points.size(); ++j)
      if (borders[j]) to_border = std::min(to_border, (mesh.points[i] - mesh.points[j]).norm());
    BOOST_TEST(result.radius == std::max(to_border, 0.5 * radius), boost::test_tools::tolerance(1e-9));
    shrunk = shrunk || result.radius < radius;
    // The normals of the border's neighbours differ from those of the border, which are one-sided.
    BOOST_TEST(std::abs(result.tensor.mean() - 1 / r) < 0.35);
    const Curvature_average::Result again = average(i, radius);
    BOOST_TEST(again.tensor.uu == result.tensor.uu);
  }
  BOOST_TEST(shrunk);
  // A radius below the edge length: the vertex itself, also on the border.
  for (std::size_t i : {std::size_t(0), mesh.points.size() / 2})
    BOOST_TEST(average(i, 1e-6).tensor.uv == field.tensors[i].uv, boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(averages_do_not_jump_to_another_sheet)
{
  // A plane and, close above it, a dome that is not connected to it.
  Flat_mesh mesh = generated::grid(20, 20, [](double u, double v) { return Vector(u, v, 0); });
  const Flat_mesh dome = generated::grid(20, 20, [](double u, double v) {
    return Vector(u, v, 0.05 - 2 * ((u - 0.5) * (u - 0.5) + (v - 0.5) * (v - 0.5)) + 1);
  });
  const auto n = std::int32_t(mesh.points.size());
  for (const Vector& p : dome.points) mesh.points.push_back(p - Vector(0, 0, 1));
  for (const auto& f : dome.faces) mesh.faces.push_back({f[0] + n, f[1] + n, f[2] + n});
  const Curvature_field field = curvature_tensors(mesh);
  const std::vector<Curvature_tensor> averages = average_tensors(mesh, field, 0.2);
  const auto middle = std::size_t(n / 2);
  BOOST_TEST(std::abs(averages[middle].maximum()) < 1e-9);
  BOOST_TEST(std::abs(averages[middle + std::size_t(n)].mean() - 4) < 0.8);
}
