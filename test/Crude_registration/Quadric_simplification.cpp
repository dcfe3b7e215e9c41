// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#define BOOST_TEST_MODULE Quadric_simplification
#include <boost/test/unit_test.hpp>

#include "generated_surfaces.h"
#include "mesh_of.h"

#include <CGAL/Crude_registration/internal/reduction/Quadric_simplification.h>
#include <CGAL/Crude_registration/internal/lookup/Triangle_tree.h>
#include <CGAL/Crude_registration/reduction/simplify_scan.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>
#include <vector>

using namespace CGAL::Crude_registration::internal;
namespace CR = CGAL::Crude_registration;
namespace parameters = CR::parameters;
using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

namespace {

double sum_of_squares(const std::vector<std::pair<Vector, Vector>>& planes, const Vector& p)
{
  double sum = 0;
  for (const auto& plane : planes) sum += std::pow(plane.first.dot(p - plane.second), 2);
  return sum;
}

// What every state of a simplification has to be.
void check(const Flat_mesh& dense, const Quadric_simplification& simplification)
{
  const Simplified_mesh s = simplification.mesh();
  const std::size_t n = s.mesh.points.size();
  BOOST_TEST(n == std::size_t(simplification.number_of_vertices()));
  BOOST_TEST(s.normals.size() == n);
  BOOST_TEST((s.borders == border_flags(s.mesh)));
  BOOST_TEST(s.nearest_group.size() == n);

  std::vector<int> faces_of_vertex(n, 0);
  std::set<std::array<std::int32_t, 3>> faces;
  for (auto f : s.mesh.faces) {
    for (std::int32_t v : f) {
      BOOST_TEST_REQUIRE(v >= 0);
      BOOST_TEST_REQUIRE(std::size_t(v) < n);
      ++faces_of_vertex[std::size_t(v)];
    }
    std::sort(f.begin(), f.end());
    BOOST_TEST((f[0] < f[1] && f[1] < f[2]));
    BOOST_TEST(faces.insert(f).second); // no face twice, in whatever sense
  }
  for (std::size_t i = 0; i < n; ++i) {
    BOOST_TEST(faces_of_vertex[i] > 0);
    BOOST_TEST(s.mesh.points[i].allFinite());
    BOOST_TEST(std::abs(s.normals[i].norm() - 1) < 1e-9);
    BOOST_TEST(s.nearest_group[i] >= 0);
    BOOST_TEST(s.nearest_group[i] < simplification.number_of_groups());
  }
  const std::vector<std::int32_t>& groups = simplification.group_of_vertex();
  BOOST_TEST(groups.size() == dense.points.size());
  for (std::int32_t g : groups) BOOST_TEST((g >= -1 && g < simplification.number_of_groups()));
}

// Edges with other than one or two faces.
std::size_t number_of_bad_edges(const Flat_mesh& mesh)
{
  std::map<std::pair<int, int>, int> edges;
  for (const auto& f : mesh.faces)
    for (std::size_t k = 0; k < 3; ++k) ++edges[{f[k], f[(k + 1) % 3]}];
  std::size_t bad = 0;
  for (const auto& e : edges) bad += std::size_t(e.second != 1); // the same direction twice
  return bad;
}

// Root mean square and largest distance of points from a mesh.
std::pair<double, double> distance(const std::vector<Vector>& points, const Flat_mesh& flat)
{
  const auto point = [](const Vector& p) { return Kernel::Point_3(p.x(), p.y(), p.z()); };
  const auto corner = [&](std::int32_t v) { return point(flat.points[std::size_t(v)]); };
  Triangle_tree<Kernel>::Triangles triangles;
  for (const auto& f : flat.faces) triangles.emplace_back(corner(f[0]), corner(f[1]), corner(f[2]));
  const Triangle_tree<Kernel>::type tree(triangles.cbegin(), triangles.cend());
  double sum = 0, largest = 0;
  for (const Vector& p : points) {
    const double d2 = tree.squared_distance(point(p));
    sum += d2;
    largest = std::max(largest, d2);
  }
  return {std::sqrt(sum / double(points.size())), std::sqrt(largest)};
}

// For each point of a the distance to the nearest of b, the largest of them.
double hausdorff(const std::vector<Vector>& a, const std::vector<Vector>& b)
{
  double largest = 0;
  for (const Vector& p : a) {
    double least = (std::numeric_limits<double>::max)();
    for (const Vector& q : b) least = std::min(least, (p - q).squaredNorm());
    largest = std::max(largest, least);
  }
  return std::sqrt(largest);
}

} // namespace

BOOST_AUTO_TEST_CASE(a_quadric_is_the_sum_of_squared_distances)
{
  generated::Random random(1);
  Plane_quadric quadric;
  std::vector<std::pair<Vector, Vector>> planes;
  for (int i = 0; i < 9; ++i) {
    planes.emplace_back((random.vector() + Vector(0, 0, 2)).normalized(), random.vector());
    quadric.add(Plane_quadric(planes.back().first, planes.back().second));
  }
  BOOST_TEST(quadric.weight == 9);
  for (double stiffness : {1e-2, 1.0}) {
    const Vector anchor = random.vector();
    const Plane_quadric::Optimum optimum = quadric.optimum_near(anchor, stiffness);
    BOOST_TEST(9 * optimum.mean_squared_distance == sum_of_squares(planes, optimum.position),
               boost::test_tools::tolerance(1e-9));
    // Least: no neighbour is better.
    const auto value = [&](const Vector& p) {
      return sum_of_squares(planes, p) + stiffness * 9 * (p - anchor).squaredNorm();
    };
    for (int i = 0; i < 50; ++i)
      BOOST_TEST(value(optimum.position) <= value(optimum.position + 1e-3 * random.vector()));
  }
}

BOOST_AUTO_TEST_CASE(an_optimum_stays_near_its_anchor_where_planes_say_nothing)
{
  // One plane, three times, tilted by rounding: the foot of the perpendicular, not somewhere along the plane.
  Plane_quadric quadric;
  for (double tilt : {0.0, 1e-9, -1e-9}) quadric.add(Plane_quadric(Vector(tilt, 0, 1).normalized(), Vector(0, 0, 5)));
  const Plane_quadric::Optimum optimum = quadric.optimum_near(Vector(1, 2, 5.5), 1e-2);
  BOOST_TEST((optimum.position - Vector(1, 2, 5)).norm() < 0.01);
  const Plane_quadric nothing;
  BOOST_TEST(nothing.optimum_near(Vector(1, 2, 3), 1e-2).position == Vector(1, 2, 3));
  // Three planes of a corner: the corner.
  Plane_quadric corner;
  for (const Vector& n : {Vector(1, 0, 0), Vector(0, 1, 0), Vector(0, 0, 1)})
    corner.add(Plane_quadric(n, Vector(0.1, 0.2, 0.3)));
  BOOST_TEST((corner.optimum_near(Vector::Zero(), 1e-2).position - Vector(0.1, 0.2, 0.3)).norm() < 0.02);
}

BOOST_AUTO_TEST_CASE(groups_are_connected_pieces_of_cells)
{
  // Two sheets through the same cells.
  Flat_mesh mesh = generated::grid(40, 40, [](double u, double v) { return Vector(u, v, 0.01); });
  const std::size_t n = mesh.points.size(), m = mesh.faces.size();
  for (std::size_t i = 0; i < n; ++i) mesh.points.push_back(mesh.points[i] + Vector(0, 0, 0.02));
  for (std::size_t i = 0; i < m; ++i) {
    auto f = mesh.faces[i];
    for (std::int32_t& v : f) v += std::int32_t(n);
    std::swap(f[0], f[1]);
    mesh.faces.push_back(f);
  }
  const double cell = 0.1;
  const Quadric_simplification simplification(mesh, cell);
  check(mesh, simplification);
  const std::vector<std::int32_t>& group = simplification.group_of_vertex();
  std::set<std::int32_t> lower(group.begin(), group.begin() + std::ptrdiff_t(n)),
      upper(group.begin() + std::ptrdiff_t(n), group.end());
  for (std::int32_t g : lower) BOOST_TEST(upper.count(g) == 0);
  BOOST_TEST(simplification.number_of_vertices() == 2 * 11 * 11); // the last row and column reach the eleventh cell
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    for (std::size_t j = i % 17; j < i; j += 17)
      if (group[i] == group[j]) {
        const Vector a = (mesh.points[i] / cell).array().floor(), b = (mesh.points[j] / cell).array().floor();
        BOOST_TEST(a == b);
      }
  // The normals of the sheets are those of their own faces.
  const Simplified_mesh s = simplification.mesh();
  for (std::size_t i = 0; i < s.normals.size(); ++i)
    BOOST_TEST(s.normals[i].z() == (s.mesh.points[i].z() < 0.02 ? 1 : -1), boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(grouping_and_collapse_keep_a_mesh)
{
  for (double cell : {0.0, 0.03, 0.07}) {
    for (const Flat_mesh& dense :
         {generated::bumps(60, 1, 0.003), generated::sphere(15, 0.5), generated::torus(90, 30, 0.5, 0.2)}) {
      Quadric_simplification simplification(dense, cell);
      check(dense, simplification);
      BOOST_TEST(number_of_bad_edges(simplification.mesh().mesh) == 0);
      const std::int32_t groups = simplification.number_of_groups();
      for (std::int32_t n : {groups / 2, groups / 4, 60, 40}) {
        simplification.collapse_to_number(n);
        BOOST_TEST(simplification.number_of_vertices() == n);
        check(dense, simplification);
        BOOST_TEST(number_of_bad_edges(simplification.mesh().mesh) == 0);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(collapses_keep_the_topology)
{
  // Euler characteristic and borders: a torus stays one, a sphere stays one, a disc stays one.
  const auto characteristic = [](const Flat_mesh& mesh) {
    std::set<std::pair<int, int>> edges;
    for (const auto& f : mesh.faces)
      for (std::size_t k = 0; k < 3; ++k) edges.insert(std::minmax(f[k], f[(k + 1) % 3]));
    return long(mesh.points.size()) - long(edges.size()) + long(mesh.faces.size());
  };
  for (const Flat_mesh& dense : {generated::torus(60, 20, 3, 1), generated::sphere(12, 1), generated::bumps(30)}) {
    Quadric_simplification simplification(dense, 0);
    simplification.collapse_to_number(0); // as far as it goes
    const Simplified_mesh s = simplification.mesh();
    BOOST_TEST(characteristic(s.mesh) == characteristic(dense));
    BOOST_TEST(s.mesh.points.size() < 30);
    const std::vector<std::uint8_t> borders = border_flags(dense);
    BOOST_TEST((std::count(s.borders.begin(), s.borders.end(), 1) > 0) ==
               (std::count(borders.begin(), borders.end(), 1) > 0));
  }
}

BOOST_AUTO_TEST_CASE(no_collapse_costs_more_than_the_given_error)
{
  const Flat_mesh dense = generated::bumps(60, 1, 0.002);
  std::int32_t previous = std::int32_t(dense.points.size());
  for (double error : {1e-8, 1e-6, 1e-5, 1e-4}) {
    Quadric_simplification simplification(dense, 0);
    simplification.collapse_to_error(error);
    BOOST_TEST(simplification.error() <= error);
    BOOST_TEST(simplification.number_of_vertices() < previous);
    previous = simplification.number_of_vertices();
    // The largest mean squared distance bounds that of the surface as a whole, up to what lies beyond the border.
    std::vector<Vector> inside;
    for (const Vector& p : dense.points)
      if (std::abs(p.x() - 0.5) < 0.3 && std::abs(p.y() - 0.5) < 0.3) inside.push_back(p);
    BOOST_TEST(distance(inside, simplification.mesh().mesh).first < 2 * std::sqrt(error) + 0.002);
  }
}

BOOST_AUTO_TEST_CASE(several_sizes_from_one_run_are_those_of_single_runs)
{
  const Flat_mesh dense = generated::bumps(50, 1, 0.002);
  Quadric_simplification several(dense, 0.05), one(dense, 0.05);
  for (std::int32_t n : {300, 200, 100}) several.collapse_to_number(n);
  one.collapse_to_number(100);
  BOOST_TEST((several.mesh().mesh.points == one.mesh().mesh.points));
  BOOST_TEST((several.mesh().mesh.faces == one.mesh().mesh.faces));
}

BOOST_AUTO_TEST_CASE(as_good_as_the_plain_path_on_cgal)
{
  for (double noise : {0.0, 0.002}) {
    const Flat_mesh dense = generated::bumps(120, 1, noise);
    const double s = 1.0 / 120, error = 0.15 * s * 1 / 45;
    Mesh plain = mesh_of<Mesh>(dense);
    const std::size_t expected = CR::simplify_scan(plain, parameters::approximation_error(error));
    const Flat_mesh expected_mesh = flat_mesh_of(plain);
    const std::pair<double, double> expected_distance = distance(dense.points, expected_mesh);
    for (double cell : {0.0, 3 * s, 4 * s}) {
      Quadric_simplification simplification(dense, cell);
      simplification.collapse_to_error(error);
      const double n = simplification.number_of_vertices();
      BOOST_TEST(std::abs(n - double(expected)) <= 0.2 * double(expected));
      const std::pair<double, double> d = distance(dense.points, simplification.mesh().mesh);
      BOOST_TEST_MESSAGE("noise " << noise << " cell " << cell / s << " s: " << n << " vertices, distance "
                                  << d.first / s << " s, at most " << d.second / s << " s; plain: " << expected << ", "
                                  << expected_distance.first / s << ", " << expected_distance.second / s);
      BOOST_TEST(d.first < 1.25 * expected_distance.first);
      BOOST_TEST(d.second < 1.5 * expected_distance.second);
    }
  }
}

BOOST_AUTO_TEST_CASE(units_and_far_origins)
{
  const Flat_mesh dense = generated::bumps(50, 1, 0.001);
  const double cell = 0.0537;
  Quadric_simplification simplification(dense, cell);
  simplification.collapse_to_number(200);
  const Flat_mesh expected = simplification.mesh().mesh;
  for (double scale : {std::ldexp(1.0, -40), 1e-3, 0.3048, 1e5}) {
    Quadric_simplification other(generated::moved(dense, Rigid_motion(), scale), scale * cell);
    other.collapse_to_number(200);
    const Flat_mesh mesh = other.mesh().mesh;
    BOOST_TEST((mesh.faces == expected.faces));
    BOOST_TEST_REQUIRE(mesh.points.size() == expected.points.size());
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
      BOOST_TEST((mesh.points[i] / scale - expected.points[i]).norm() < 1e-9);
  }
  // The grid of cells moves along with a translation by whole cells.
  Rigid_motion far;
  far.translation = 200000 * cell * Vector(1, -1, 1);
  Quadric_simplification other(generated::moved(dense, far), cell);
  other.collapse_to_number(200);
  std::vector<Vector> back = other.mesh().mesh.points;
  for (Vector& p : back) p -= far.translation;
  BOOST_TEST(hausdorff(back, expected.points) < 1e-3);
}

BOOST_AUTO_TEST_CASE(the_order_of_vertices_and_faces_does_not_matter)
{
  const Flat_mesh dense = generated::bumps(50, 1, 0.001);
  for (double cell : {0.0, 0.0537}) {
    Quadric_simplification simplification(dense, cell), other(generated::shuffled(dense, 5), cell);
    BOOST_TEST(other.number_of_groups() == simplification.number_of_groups());
    for (std::int32_t n : {400, 150}) {
      simplification.collapse_to_number(n);
      other.collapse_to_number(n);
      BOOST_TEST(hausdorff(simplification.mesh().mesh.points, other.mesh().mesh.points) < 1e-9);
    }
  }
}

BOOST_AUTO_TEST_CASE(the_same_bits_every_time)
{
  const Flat_mesh dense = generated::bumps(50, 1, 0.001);
  const auto run = [&]() {
    Quadric_simplification simplification(dense, 0.05);
    simplification.collapse_to_number(120);
    return simplification.mesh();
  };
  const Simplified_mesh a = run(), b = run();
  BOOST_TEST((a.mesh.points == b.mesh.points));
  BOOST_TEST((a.mesh.faces == b.mesh.faces));
  BOOST_TEST((a.nearest_group == b.nearest_group));
}

BOOST_AUTO_TEST_CASE(flat_regions_are_simplified_evenly)
{
  // All costs are zero but for rounding: no sliver as long as the plane, and nothing leaves the plane.
  const Flat_mesh dense = generated::grid(40, 40, [](double u, double v) { return Vector(u, v, 0.1 * u + 0.2 * v); });
  Quadric_simplification simplification(dense, 0);
  simplification.collapse_to_number(100);
  const Simplified_mesh s = simplification.mesh();
  for (const Vector& p : s.mesh.points) BOOST_TEST(std::abs(p.z() - 0.1 * p.x() - 0.2 * p.y()) < 1e-12);
  double longest = 0;
  for (const auto& f : s.mesh.faces)
    for (std::size_t k = 0; k < 3; ++k)
      longest =
          std::max(longest, (s.mesh.points[std::size_t(f[k])] - s.mesh.points[std::size_t(f[(k + 1) % 3])]).norm());
  BOOST_TEST(longest < 0.4);
}

BOOST_AUTO_TEST_CASE(degenerate_input)
{
  const auto run = [](const Flat_mesh& mesh) {
    for (double cell : {0.0, 0.3, 1e3}) {
      Quadric_simplification simplification(mesh, cell);
      simplification.collapse_to_number(3);
      simplification.collapse_to_error(1e300);
      const Simplified_mesh s = simplification.mesh();
      BOOST_TEST(s.mesh.points.size() == std::size_t(simplification.number_of_vertices()));
      for (const Vector& p : s.mesh.points) BOOST_TEST(p.allFinite());
    }
  };
  Flat_mesh mesh;
  run(mesh);
  mesh.points = {Vector(0, 0, 0)};
  run(mesh);
  mesh.points = {Vector(0, 0, 0), Vector(1, 0, 0), Vector(0, 1, 0)};
  mesh.faces = {{0, 1, 2}};
  run(mesh);
  mesh.faces = {{0, 1, 2}, {0, 1, 2}, {0, 2, 1}, {0, 0, 1}}; // again, reversed, without area
  run(mesh);
  mesh.points = {Vector(0, 0, 0), Vector(1, 0, 0), Vector(2, 0, 0), Vector(3, 0, 0)}; // collinear
  mesh.faces = {{0, 1, 2}, {1, 3, 2}};
  run(mesh);
  mesh.points.assign(4, Vector(1, 1, 1)); // one point
  run(mesh);
  // Five faces at one edge; a pillow of two faces; a tetrahedron.
  mesh.points.clear();
  mesh.faces.clear();
  for (int i = 0; i < 7; ++i) mesh.points.push_back(Vector(i < 2 ? 0 : std::cos(i), i < 2 ? 0 : std::sin(i), i == 1));
  for (std::int32_t i = 2; i < 7; ++i) mesh.faces.push_back({0, 1, i});
  run(mesh);
  mesh.faces = {{0, 1, 2}, {0, 2, 1}};
  run(mesh);
  mesh.faces = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  run(mesh);
  // Bumps with a spike far away, and one that overflows.
  for (double height : {1e6, 1e200}) {
    mesh = generated::bumps(15);
    mesh.points[40].z() = height;
    run(mesh);
  }
  // Random triangles: nothing is manifold.
  generated::Random random(8);
  mesh = Flat_mesh();
  for (int i = 0; i < 30; ++i) mesh.points.push_back(random.vector());
  for (int i = 0; i < 300; ++i)
    mesh.faces.push_back({std::int32_t(15 + 14.9 * random.symmetric()), std::int32_t(15 + 14.9 * random.symmetric()),
                          std::int32_t(15 + 14.9 * random.symmetric())});
  run(mesh);
}
