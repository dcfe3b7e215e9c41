// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// Grouping before the collapse: the groups and their quadrics, and simplify_scan() with cell_size.

#define BOOST_TEST_MODULE group_by_cells
#include <boost/test/unit_test.hpp>

#include "generated_surfaces.h"
#include "mesh_of.h"
#include "wrong_use.h"

#include <CGAL/Crude_registration/internal/lookup/Triangle_tree.h>
#include <CGAL/Crude_registration/internal/reduction/collapse_edges.h>
#include <CGAL/Crude_registration/internal/reduction/group_by_cells.h>
#include <CGAL/Crude_registration/reduction/simplify_scan.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

using namespace CGAL::Crude_registration::internal;
namespace CR = CGAL::Crude_registration;
namespace parameters = CR::parameters;
namespace SMS = CGAL::Surface_mesh_simplification;
using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;

namespace {

struct Plane
{
  Vector normal, point;
};
using Planes = std::vector<Plane>;

double sum_of_squares(const Planes& planes, const Vector& p)
{
  double sum = 0;
  for (const Plane& plane : planes) sum += std::pow(plane.normal.dot(p - plane.point), 2);
  return sum;
}

// The planes that each group stands for, by definition: those of the dense faces, once for each corner.
std::vector<Planes> planes_of_groups(const Flat_mesh& dense, const Grouped_mesh& grouped)
{
  std::vector<Planes> planes(grouped.mesh.points.size());
  for (const auto& f : dense.faces) {
    const Vector a = dense.points[std::size_t(f[0])], b = dense.points[std::size_t(f[1])],
                 c = dense.points[std::size_t(f[2])], n = (c - a).cross(b - a);
    if (!(n.norm() > 0)) continue;
    for (std::int32_t v : f) {
      const std::int32_t group = grouped.group_of_vertex[std::size_t(v)];
      if (group >= 0) planes[std::size_t(group)].push_back({n / n.norm(), b});
    }
  }
  return planes;
}

double value(const Plane_quadric& q, const Vector& p)
{
  const double x = p.x(), y = p.y(), z = p.z();
  return q.xx * x * x + q.yy * y * y + q.zz * z * z + 2 * (q.xy * x * y + q.xz * x * z + q.yz * y * z) +
         2 * (q.x * x + q.y * y + q.z * z) + q.c;
}

std::size_t number_of_groups(const Grouped_mesh& grouped)
{
  std::int32_t last = -1;
  for (std::int32_t g : grouped.group_of_vertex) last = std::max(last, g);
  return std::size_t(last + 1);
}

// What a grouped mesh always is.
void check(const Flat_mesh& dense, const Grouped_mesh& grouped)
{
  const std::size_t n = grouped.mesh.points.size();
  BOOST_TEST(grouped.quadrics.size() == n);
  BOOST_TEST(grouped.group_of_vertex.size() == dense.points.size());
  BOOST_TEST(number_of_groups(grouped) <= n);
  std::vector<std::map<int, int>> next(n); // around each vertex, from face to face
  std::set<std::array<std::int32_t, 3>> faces;
  for (auto f : grouped.mesh.faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      BOOST_TEST_REQUIRE((f[k] >= 0 && std::size_t(f[k]) < n));
      BOOST_TEST(next[std::size_t(f[k])].emplace(f[(k + 1) % 3], f[(k + 2) % 3]).second); // no directed edge twice
    }
    std::sort(f.begin(), f.end());
    BOOST_TEST((f[0] < f[1] && f[1] < f[2]));
    BOOST_TEST(faces.insert(f).second); // no face twice, in whatever sense
  }
  for (std::size_t v = 0; v < n; ++v) {
    BOOST_TEST(grouped.mesh.points[v].allFinite());
    BOOST_TEST_REQUIRE(!next[v].empty());
    // One fan: from the neighbour that none leads to, or any, all are reached.
    int first = next[v].begin()->first;
    for (const auto& from : next[v])
      if (std::none_of(next[v].begin(), next[v].end(), [&](const auto& f) { return f.second == from.first; }))
        first = from.first;
    std::size_t reached = 0;
    for (int at = first; next[v].count(at) > 0 && reached <= next[v].size(); ++reached) {
      at = next[v].at(at);
      if (at == first) {
        ++reached;
        break;
      }
    }
    BOOST_TEST(reached == next[v].size());
  }
  const Mesh mesh = mesh_of<Mesh>(grouped.mesh);
  BOOST_TEST(mesh.number_of_faces() == grouped.mesh.faces.size());
  BOOST_TEST(CGAL::is_valid_polygon_mesh(mesh));
}

long euler_characteristic(const Flat_mesh& mesh)
{
  std::set<std::pair<int, int>> edges;
  for (const auto& f : mesh.faces)
    for (std::size_t k = 0; k < 3; ++k) edges.insert(std::minmax(f[k], f[(k + 1) % 3]));
  return long(mesh.points.size()) - long(edges.size()) + long(mesh.faces.size());
}

bool is_closed(const Flat_mesh& mesh)
{
  const std::vector<std::uint8_t> borders = border_flags(mesh);
  return std::count(borders.begin(), borders.end(), 1) == 0;
}

// Root mean square and largest distance of points from a mesh.
std::pair<double, double> distance(const std::vector<Vector>& points, const Flat_mesh& flat)
{
  const auto point = [](const Vector& p) { return Point(p.x(), p.y(), p.z()); };
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

template <class NamedParameters>
Flat_mesh simplified(const Flat_mesh& dense, const NamedParameters& np)
{
  Mesh mesh = mesh_of<Mesh>(dense);
  const std::size_t n = CR::simplify_scan(mesh, np);
  BOOST_TEST(mesh.number_of_vertices() == n);
  BOOST_TEST(CGAL::is_triangle_mesh(mesh));
  BOOST_TEST(CGAL::is_valid_polygon_mesh(mesh));
  return flat_mesh_of(mesh);
}

// Bumps with noise of standard deviation 0.0012; what the tests group has some ten samples a cell.
const Flat_mesh& noisy_bumps()
{
  static const Flat_mesh mesh = generated::bumps(60, 1, 0.002);
  return mesh;
}
constexpr double cell = 0.0537, error = 4e-6;

std::vector<Flat_mesh> dense_meshes()
{
  return {noisy_bumps(), generated::sphere(15, 0.5), generated::torus(90, 30, 0.5, 0.2)};
}

} // namespace

BOOST_AUTO_TEST_CASE(a_quadric_is_the_sum_of_squared_distances)
{
  generated::Random random(1);
  Plane_quadric quadric;
  Planes planes;
  for (int i = 0; i < 9; ++i) {
    planes.push_back({(random.vector() + Vector(0, 0, 2)).normalized(), random.vector()});
    quadric.add(Plane_quadric(planes.back().normal, planes.back().point));
  }
  BOOST_TEST(quadric.weight == 9);
  for (double stiffness : {1e-2, 1.0}) {
    const Vector anchor = random.vector();
    const Plane_quadric::Optimum optimum = quadric.optimum_near(anchor, stiffness);
    BOOST_TEST(9 * optimum.mean_squared_distance == sum_of_squares(planes, optimum.position),
               boost::test_tools::tolerance(1e-9));
    // Least: no neighbour is better.
    const auto stiff_value = [&](const Vector& p) {
      return sum_of_squares(planes, p) + stiffness * 9 * (p - anchor).squaredNorm();
    };
    for (int i = 0; i < 50; ++i)
      BOOST_TEST(stiff_value(optimum.position) <= stiff_value(optimum.position + 1e-3 * random.vector()));
  }
}

BOOST_AUTO_TEST_CASE(an_optimum_stays_near_its_anchor_where_planes_say_nothing)
{
  // One plane, three times, tilted by rounding: the foot of the perpendicular, not somewhere along the plane.
  Plane_quadric quadric;
  for (double tilt : {0.0, 1e-9, -1e-9}) quadric.add(Plane_quadric(Vector(tilt, 0, 1).normalized(), Vector(0, 0, 5)));
  const Plane_quadric::Optimum optimum = quadric.optimum_near(Vector(1, 2, 5.5));
  BOOST_TEST((optimum.position - Vector(1, 2, 5)).norm() < 0.01);
  const Plane_quadric nothing;
  BOOST_TEST(nothing.optimum_near(Vector(1, 2, 3)).position == Vector(1, 2, 3));
  // Three planes of a corner: the corner.
  Plane_quadric corner;
  for (const Vector& n : {Vector(1, 0, 0), Vector(0, 1, 0), Vector(0, 0, 1)})
    corner.add(Plane_quadric(n, Vector(0.1, 0.2, 0.3)));
  BOOST_TEST((corner.optimum_near(Vector::Zero()).position - Vector(0.1, 0.2, 0.3)).norm() < 0.02);
}

BOOST_AUTO_TEST_CASE(groups_are_connected_pieces_of_cells)
{
  // Two sheets through the same cells, the upper one upside down.
  Flat_mesh mesh = generated::grid(40, 40, [](double u, double v) { return Vector(u, v, 0.01); });
  const std::size_t n = mesh.points.size(), m = mesh.faces.size();
  for (std::size_t i = 0; i < n; ++i) mesh.points.push_back(mesh.points[i] + Vector(0, 0, 0.02));
  for (std::size_t i = 0; i < m; ++i) {
    auto f = mesh.faces[i];
    for (std::int32_t& v : f) v += std::int32_t(n);
    std::swap(f[0], f[1]);
    mesh.faces.push_back(f);
  }
  const double size = 0.1;
  for (double allowed : {0.0, 1e-3}) { // more than the square of the distance between the sheets
    const Grouped_mesh grouped = group_by_cells(mesh, size, allowed);
    check(mesh, grouped);
    const std::vector<std::int32_t>& group = grouped.group_of_vertex;
    const std::set<std::int32_t> lower(group.begin(), group.begin() + std::ptrdiff_t(n)),
        upper(group.begin() + std::ptrdiff_t(n), group.end());
    for (std::int32_t g : lower) BOOST_TEST(upper.count(g) == 0);
    for (std::int32_t g : lower)
      BOOST_TEST(grouped.mesh.points[std::size_t(g)].z() == 0.01, boost::test_tools::tolerance(1e-12));
    for (std::int32_t g : upper)
      BOOST_TEST(grouped.mesh.points[std::size_t(g)].z() == 0.03, boost::test_tools::tolerance(1e-12));
    if (allowed > 0) {
      BOOST_TEST(grouped.mesh.points.size() < 11 * 11);
      continue;
    }
    BOOST_TEST(grouped.mesh.points.size() == 2 * 11 * 11); // the last row and column reach the eleventh cell
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
      for (std::size_t j = i % 17; j < i; j += 17)
        if (group[i] == group[j]) {
          const Vector a = (mesh.points[i] / size).array().floor(), b = (mesh.points[j] / size).array().floor();
          BOOST_TEST(a == b);
        }
  }
  // Both through the public call: what is left of one sheet has none of the other.
  const Flat_mesh left = simplified(mesh, parameters::approximation_error(1e-3).cell_size(size));
  for (const Vector& p : left.points) BOOST_TEST(std::min(std::abs(p.z() - 0.01), std::abs(p.z() - 0.03)) < 1e-12);
}

BOOST_AUTO_TEST_CASE(quadrics_are_those_of_the_dense_faces)
{
  generated::Random random(2);
  for (const Flat_mesh& dense : dense_meshes())
    for (double size : {0.03, cell, 0.11})
      for (double allowed : {0.0, error}) {
        const Grouped_mesh grouped = group_by_cells(dense, size, allowed);
        check(dense, grouped);
        const std::vector<Planes> planes = planes_of_groups(dense, grouped);
        const std::size_t n = number_of_groups(grouped);
        for (std::size_t g = 0; g < n; ++g) {
          BOOST_TEST(grouped.quadrics[g].weight == double(planes[g].size()));
          const Vector p = grouped.mesh.points[g] + 0.1 * random.vector();
          BOOST_TEST(value(grouped.quadrics[g], p) == sum_of_squares(planes[g], p), boost::test_tools::tolerance(1e-9));
        }
        // The others repeat a group, at its place.
        for (std::size_t v = n; v < grouped.mesh.points.size(); ++v) {
          const auto same = std::find(grouped.mesh.points.begin(), grouped.mesh.points.begin() + std::ptrdiff_t(n),
                                      grouped.mesh.points[v]);
          const auto g = std::size_t(same - grouped.mesh.points.begin());
          BOOST_TEST_REQUIRE(g < n);
          BOOST_TEST(value(grouped.quadrics[v], Vector(1, 2, 3)) == value(grouped.quadrics[g], Vector(1, 2, 3)));
        }
      }
}

BOOST_AUTO_TEST_CASE(groups_unite_up_to_the_error)
{
  for (const Flat_mesh& dense : dense_meshes())
    for (double size : {0.03, cell})
      for (double allowed : {1e-7, error, 1e-4}) {
        const Grouped_mesh fine = group_by_cells(dense, size), coarse = group_by_cells(dense, size, allowed);
        const std::vector<Planes> planes = planes_of_groups(dense, coarse);
        std::vector<std::set<std::int32_t>> parts(number_of_groups(coarse));
        for (std::size_t i = 0; i < dense.points.size(); ++i) {
          const std::int32_t g = coarse.group_of_vertex[i], part = fine.group_of_vertex[i];
          BOOST_TEST((g < 0) == (part < 0)); // nothing vanishes
          if (g >= 0) parts[std::size_t(g)].insert(part);
        }
        std::set<std::int32_t> all;
        std::size_t sum = 0;
        for (std::size_t g = 0; g < parts.size(); ++g) {
          all.insert(parts[g].begin(), parts[g].end());
          sum += parts[g].size();
          if (parts[g].size() == 1) continue;
          // The point of least distance to the planes has no larger one than that which was accepted.
          const Plane_quadric& q = coarse.quadrics[g];
          const Vector best = q.optimum_near(coarse.mesh.points[g], 1e-6).position;
          BOOST_TEST(sum_of_squares(planes[g], best) <= 1.0001 * allowed * double(planes[g].size()));
        }
        BOOST_TEST(sum == all.size()); // no group is in two
        if (allowed >= error) BOOST_TEST(parts.size() < all.size());
      }
}

BOOST_AUTO_TEST_CASE(uniting_cuts_nothing_off)
{
  // Two fields joined by a bridge of less than two cells, in a frame that puts cells across it: at every error the
  // groups hang together, and the fields stay joined by more than a vertex.
  Flat_mesh dense;
  const Flat_mesh field = generated::grid(40, 40, [](double u, double v) { return Vector(u, v, 0); });
  for (const auto& f : field.faces) {
    const Vector centre =
        (field.points[std::size_t(f[0])] + field.points[std::size_t(f[1])] + field.points[std::size_t(f[2])]) / 3;
    if (std::abs(centre.x() - 0.5) < 0.15 && std::abs(centre.y() - 0.55) > 0.06) continue;
    dense.faces.push_back(f);
  }
  dense.points = field.points;
  for (double allowed : {0.0, 1e-8, 1.0}) {
    const Grouped_mesh grouped = group_by_cells(dense, 0.075, allowed);
    check(dense, grouped);
    BOOST_TEST(number_of_groups(grouped) == grouped.mesh.points.size()); // no vertex had to be repeated
    BOOST_TEST(euler_characteristic(grouped.mesh) == 1);                 // one disc
    if (allowed > 0) BOOST_TEST(grouped.mesh.points.size() < 60);
  }
}

BOOST_AUTO_TEST_CASE(closed_surfaces_stay_closed)
{
  for (const Flat_mesh& dense : {generated::torus(60, 20, 3, 1), generated::sphere(12, 1)})
    for (double size : {0.2, 0.35})
      for (double allowed : {0.0, 1e-4, 1e-3}) {
        const Grouped_mesh grouped = group_by_cells(dense, size, allowed);
        BOOST_TEST(is_closed(grouped.mesh));
        BOOST_TEST(euler_characteristic(grouped.mesh) == euler_characteristic(dense));
        if (allowed == 0) continue;
        const Flat_mesh left = simplified(dense, parameters::approximation_error(2 * allowed).cell_size(size));
        BOOST_TEST(is_closed(left));
        BOOST_TEST(euler_characteristic(left) == euler_characteristic(dense));
        BOOST_TEST(left.points.size() < grouped.mesh.points.size());
      }
}

namespace {

using Policies = Given_quadrics_policies<Mesh, Kernel>;
using Point_map = Mesh::Property_map<Mesh::Vertex_index, Point>;

// Compares the cost of every edge with the planes that its vertices stand for.
struct Cost_checker : SMS::Edge_collapse_visitor_base<Mesh, Point_map, Kernel>
{
  using Base = SMS::Edge_collapse_visitor_base<Mesh, Point_map, Kernel>;

  template <class Cost>
  void OnCollected(const typename Base::Profile& profile, const Cost& cost)
  {
    Planes all = (*planes)[profile.v0()];
    all.insert(all.end(), (*planes)[profile.v1()].begin(), (*planes)[profile.v1()].end());
    const auto p = *(*policies)(profile);
    const double expected = sum_of_squares(all, Vector(p.x(), p.y(), p.z())) / double(all.size());
    BOOST_TEST(std::abs(*cost - expected) <= 1e-9 * (expected + 1e-6));
    ++*number;
  }

  const std::vector<Planes>* planes = nullptr;
  const Policies* policies = nullptr;
  std::size_t* number = nullptr;
};

} // namespace

BOOST_AUTO_TEST_CASE(the_cost_of_a_collapse_is_the_mean_squared_distance_to_the_planes_of_the_dense_faces)
{
  const Flat_mesh& dense = noisy_bumps();
  const Grouped_mesh grouped = group_by_cells(dense, cell, error);
  std::vector<Planes> planes = planes_of_groups(dense, grouped);
  BOOST_TEST_REQUIRE(number_of_groups(grouped) == grouped.mesh.points.size());
  Mesh mesh = mesh_of<Mesh>(grouped.mesh);
  const Policies policies(mesh, grouped.quadrics);
  std::size_t edges = 0;
  Cost_checker checker;
  checker.planes = &planes;
  checker.policies = &policies;
  checker.number = &edges;
  std::size_t left = 100;
  SMS::edge_collapse(mesh, Simplification_stop{{1e300, 100}, &left}, // at once
                     CGAL::parameters::geom_traits(Kernel())
                         .get_cost(policies.get_cost())
                         .get_placement(policies.get_placement())
                         .visitor(checker));
  BOOST_TEST(edges == mesh.number_of_edges());
  // All planes of the groups are still there after any number of collapses.
  const std::size_t n = collapse_edges(mesh, mesh.points(), grouped.mesh.points.size(), {1e300, 50}, policies);
  BOOST_TEST(n == 50);
  double weight = 0;
  for (Mesh::Vertex_index v : mesh.vertices()) weight += get(policies.vcm(), v).topLeftCorner<3, 3>().trace();
  double expected = 0;
  for (const Planes& p : planes_of_groups(dense, grouped)) expected += double(p.size());
  BOOST_TEST(weight == expected, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(expected > 0.99 * 3 * double(dense.faces.size())); // but for what fell into one cell
}

BOOST_AUTO_TEST_CASE(as_good_as_without_grouping)
{
  for (double noise : {0.0, 0.002}) {
    const Flat_mesh dense = generated::bumps(120, 1, noise);
    const double s = 1.0 / 120, epsilon = 0.15 * s * 1 / 45;
    const Flat_mesh plain = simplified(dense, parameters::approximation_error(epsilon));
    const std::pair<double, double> expected = distance(dense.points, plain);
    // No two vertices are in one of the smallest cells: the same without CGAL's quadrics and placement.
    for (double size : {1e-3 * s, 3 * s, 4 * s}) {
      const Flat_mesh mesh = simplified(dense, parameters::approximation_error(epsilon).cell_size(size));
      const double n = double(mesh.points.size());
      const std::pair<double, double> d = distance(dense.points, mesh);
      BOOST_TEST_MESSAGE("noise " << noise << " cell " << size / s << " s: " << n << " vertices, distance "
                                  << d.first / s << " s, at most " << d.second / s << " s; plain: "
                                  << plain.points.size() << ", " << expected.first / s << ", " << expected.second / s);
      // Of scans, which have noise, as many vertices; a surface without any keeps more, and is nearer for it.
      BOOST_TEST(std::abs(n - double(plain.points.size())) <=
                 (noise > 0 ? 0.05 : 1. / 3) * double(plain.points.size()));
      BOOST_TEST(d.first < 1.25 * expected.first);
      BOOST_TEST(d.second < 1.5 * expected.second);
    }
  }
}

BOOST_AUTO_TEST_CASE(stops_where_it_is_told_to)
{
  const Flat_mesh& dense = noisy_bumps();
  for (std::size_t n : {std::size_t(300), std::size_t(50)}) {
    BOOST_TEST(simplified(dense, parameters::number_of_vertices(n).cell_size(cell)).points.size() == n);
    // The number counts even where the error would allow groups to unite to fewer.
    BOOST_TEST(
        simplified(dense, parameters::number_of_vertices(n).cell_size(cell).approximation_error(1)).points.size() == n);
  }
  // There is no more than one vertex a group.
  const std::size_t groups = group_by_cells(dense, 0.2).mesh.points.size();
  BOOST_TEST(simplified(dense, parameters::number_of_vertices(3000).cell_size(0.2)).points.size() < 2 * groups);
  std::size_t previous = dense.points.size();
  for (double epsilon : {1e-6, 1e-5, 1e-4}) {
    const std::size_t n = simplified(dense, parameters::approximation_error(epsilon).cell_size(cell)).points.size();
    BOOST_TEST(n < previous);
    previous = n;
  }
  // The default of approximation_error is that of the dense mesh; no cell is no grouping.
  const double epsilon = CR::internal::approximation_error(dense, parameters::default_values(), "test");
  BOOST_TEST((simplified(dense, parameters::cell_size(cell)).points ==
              simplified(dense, parameters::cell_size(cell).approximation_error(epsilon)).points));
  BOOST_TEST(
      (simplified(dense, parameters::cell_size(0)).points == simplified(dense, parameters::default_values()).points));
}

BOOST_AUTO_TEST_CASE(units_and_frames_do_not_matter)
{
  const Flat_mesh& dense = noisy_bumps();
  const auto run = [&](const Rigid_motion& motion, double scale) {
    Flat_mesh mesh = simplified(generated::moved(dense, motion, scale),
                                parameters::approximation_error(2 * error * scale * scale).cell_size(cell * scale));
    for (Vector& p : mesh.points) p = motion.inverse()(p) / scale;
    return mesh;
  };
  const Flat_mesh expected = run(Rigid_motion(), 1);
  for (double scale : {std::ldexp(1.0, -40), std::ldexp(1.0, 30)}) {
    const Flat_mesh mesh = run(Rigid_motion(), scale);
    BOOST_TEST((mesh.faces == expected.faces));
    BOOST_TEST((mesh.points == expected.points)); // powers of two: no digit is lost
  }
  // Rounding decides between equal costs, and on which side of a cell's wall a vertex lies.
  generated::Random random(6);
  for (double scale : {1e-3, 1.0, 1e4})
    for (double far : {0.0, 1.0, 1e4}) {
      const Flat_mesh mesh = run(random.motion(far * scale), scale);
      BOOST_TEST(std::abs(double(mesh.points.size()) - double(expected.points.size())) <=
                 0.03 * double(expected.points.size()));
      const std::pair<double, double> d = distance(mesh.points, expected);
      BOOST_TEST(d.first < 0.002);
    }
}

BOOST_AUTO_TEST_CASE(the_order_of_vertices_and_faces_does_not_matter)
{
  const Flat_mesh &dense = noisy_bumps(), other = generated::shuffled(dense, 5);
  for (double allowed : {0.0, error}) {
    const Grouped_mesh a = group_by_cells(dense, cell, allowed), b = group_by_cells(other, cell, allowed);
    BOOST_TEST(a.mesh.points.size() == b.mesh.points.size());
    BOOST_TEST(a.mesh.faces.size() == b.mesh.faces.size());
    BOOST_TEST(hausdorff(a.mesh.points, b.mesh.points) < 1e-9);
  }
  const auto np = parameters::number_of_vertices(150).cell_size(cell);
  BOOST_TEST(hausdorff(simplified(dense, np).points, simplified(other, np).points) < 1e-6);
}

BOOST_AUTO_TEST_CASE(the_same_bits_every_time)
{
  const auto np = parameters::approximation_error(2 * error).cell_size(cell);
  const Flat_mesh a = simplified(noisy_bumps(), np), b = simplified(noisy_bumps(), np);
  BOOST_TEST((a.points == b.points));
  BOOST_TEST((a.faces == b.faces));
}

BOOST_AUTO_TEST_CASE(every_kind_of_mesh)
{
  const auto np = parameters::approximation_error(2 * error).cell_size(cell);
  const Flat_mesh expected = simplified(noisy_bumps(), np);
  using Exact_kernel = CGAL::Exact_predicates_exact_constructions_kernel;
  auto polyhedron = mesh_of<CGAL::Polyhedron_3<Kernel>>(noisy_bumps());
  BOOST_TEST(CR::simplify_scan(polyhedron, np) == expected.points.size());
  BOOST_TEST((flat_mesh_of(polyhedron).points == expected.points));
  BOOST_TEST(polyhedron.size_of_facets() == expected.faces.size());
  BOOST_TEST(CGAL::is_valid_polygon_mesh(polyhedron));
  auto exact = mesh_of<CGAL::Surface_mesh<Exact_kernel::Point_3>>(noisy_bumps());
  CR::simplify_scan(exact, np);
  BOOST_TEST((flat_mesh_of(exact).points == expected.points));
}

BOOST_AUTO_TEST_CASE(property_maps_stay)
{
  Mesh mesh = mesh_of<Mesh>(noisy_bumps());
  auto map = mesh.add_property_map<Mesh::Vertex_index, Point>("v:elsewhere").first;
  for (Mesh::Vertex_index v : mesh.vertices()) {
    map[v] = mesh.point(v);
    mesh.point(v) = Point(7, 7, 7);
  }
  const std::size_t n = CR::simplify_scan(
      mesh, parameters::number_of_vertices(100).cell_size(cell).vertex_point_map(map).sampling_distance(1));
  BOOST_TEST_REQUIRE(n == 100);
  const Flat_mesh expected = simplified(noisy_bumps(), parameters::number_of_vertices(100).cell_size(cell));
  std::size_t i = 0;
  for (Mesh::Vertex_index v : mesh.vertices()) {
    const Vector& p = expected.points[i++];
    BOOST_TEST(map[v] == Point(p.x(), p.y(), p.z()));
  }
  BOOST_TEST((mesh.property_map<Mesh::Vertex_index, Point>("v:elsewhere").second));
}

BOOST_AUTO_TEST_CASE(flat_regions_are_simplified_evenly)
{
  // Costs are zero but for rounding, and the quadrics singular: no vertex leaves its plane, none of the shape is lost.
  const Flat_mesh roof = generated::grid(
      40, 40, [](double u, double v) { return Vector(u, v, 0.3 * std::min(u, 1 - u) + 0.2 * v); }, 0);
  for (std::size_t n : {std::size_t(100), std::size_t(40)}) {
    const Flat_mesh left = simplified(roof, parameters::number_of_vertices(n).cell_size(0.07));
    BOOST_TEST(left.points.size() == n);
    double longest = 0;
    for (const Vector& p : left.points) {
      BOOST_TEST((p.x() > -0.01 && p.x() < 1.01 && p.y() > -0.01 && p.y() < 1.01));
      BOOST_TEST(std::abs(p.z() - 0.3 * std::min(p.x(), 1 - p.x()) - 0.2 * p.y()) < 0.004);
    }
    for (const auto& f : left.faces)
      for (std::size_t k = 0; k < 3; ++k)
        longest = std::max(longest, (left.points[std::size_t(f[k])] - left.points[std::size_t(f[(k + 1) % 3])]).norm());
    BOOST_TEST(longest < 0.8);
  }
}

BOOST_AUTO_TEST_CASE(degenerate_input)
{
  const auto run = [](const Flat_mesh& mesh) {
    for (double size : {1e-300, 0.3, 1e3})
      for (double allowed : {0.0, 1e-3, 1e200}) check(mesh, group_by_cells(mesh, size, allowed));
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
  mesh.points = {Vector(5, 0, 0), Vector(6, 0, 0), Vector(7, 0, 0), Vector(8, 0, 0)}; // collinear
  mesh.faces = {{0, 1, 2}, {1, 3, 2}};
  run(mesh);
  // A group that no face with an area says anything about is where its vertices are.
  BOOST_TEST((group_by_cells(mesh, 0.3).mesh.points == mesh.points));
  mesh.points.assign(4, Vector(1, 1, 1)); // one point
  run(mesh);
  // Five faces at one edge; a pillow of two faces; a tetrahedron; a bow tie.
  mesh.points.clear();
  mesh.faces.clear();
  for (int i = 0; i < 7; ++i) mesh.points.push_back(Vector(i < 2 ? 0 : std::cos(i), i < 2 ? 0 : std::sin(i), i == 1));
  for (std::int32_t i = 2; i < 7; ++i) mesh.faces.push_back({0, 1, i});
  run(mesh);
  mesh.faces = {{0, 1, 2}, {0, 2, 1}};
  run(mesh);
  mesh.faces = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  run(mesh);
  mesh.faces = {{0, 1, 2}, {0, 3, 4}};
  run(mesh);
  BOOST_TEST(group_by_cells(mesh, 1e-3).mesh.points.size() == 6);
  // Bumps with a spike far away.
  mesh = generated::bumps(15);
  mesh.points[40].z() = 1e6;
  run(mesh);
  // Random triangles: nothing is manifold.
  generated::Random random(8);
  mesh = Flat_mesh();
  for (int i = 0; i < 30; ++i) mesh.points.push_back(random.vector());
  for (int i = 0; i < 300; ++i)
    mesh.faces.push_back({std::int32_t(15 + 14.9 * random.symmetric()), std::int32_t(15 + 14.9 * random.symmetric()),
                          std::int32_t(15 + 14.9 * random.symmetric())});
  run(mesh);
}

BOOST_AUTO_TEST_CASE(degenerate_meshes)
{
  // Vertices all of whose faces have no area, edges of length 0, a vertex without a face, pieces smaller than a cell.
  Flat_mesh dense = generated::bumps(10);
  for (std::size_t i : {std::size_t(12), std::size_t(13), std::size_t(23), std::size_t(24), std::size_t(25)})
    dense.points[i] = dense.points[14];
  dense.points.push_back(Vector(0.5, 0.5, 3));
  for (double size : {1e-6, 0.15, 0.4}) {
    const Flat_mesh left = simplified(dense, parameters::number_of_vertices(20).cell_size(size));
    BOOST_TEST(left.points.size() <= (size < 0.3 ? 20u : 25u));
    for (const Vector& p : left.points) BOOST_TEST((p.allFinite() && p.norm() < 2));
  }
  // The cells meet in the middle of the scan: of cells larger than that one vertex is left of each connected piece.
  BOOST_TEST(simplified(dense, parameters::cell_size(100)).points.size() <=
             simplified(dense, parameters::cell_size(0.4)).points.size());
  BOOST_TEST(simplified(Flat_mesh(), parameters::cell_size(1)).points.empty());
}

BOOST_AUTO_TEST_CASE(wrong_use_is_named)
{
  Mesh mesh = mesh_of<Mesh>(generated::bumps(5));
  for (double bad : {-1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    BOOST_CHECK_EXCEPTION(CR::simplify_scan(mesh, parameters::cell_size(bad)), std::invalid_argument,
                          names("simplify_scan: cell_size"));
  BOOST_TEST(mesh.number_of_vertices() == 36);
}
