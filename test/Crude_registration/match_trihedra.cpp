// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#define BOOST_TEST_MODULE match_trihedra
#include <boost/test/unit_test.hpp>

#include <CGAL/Crude_registration/internal/matching/flat_trihedra.h>
#include <CGAL/Crude_registration/internal/reduction/Matching_vertices.h>
#include <CGAL/Crude_registration/matching/match_trihedra.h>
#include <CGAL/Crude_registration/reduction/scan_extent.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include "generated_surfaces.h"
#include "mesh_of.h"
#include "wrong_use.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace CR = CGAL::Crude_registration;
using CR::internal::Flat_mesh;
using CR::internal::Match_tolerances;
using CR::internal::Matching_vertices;
using CR::internal::Matrix;
using CR::internal::Rigid_motion;
using CR::internal::Spatial_trihedron;
using CR::internal::Trihedron_options;
using CR::internal::Vector;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

namespace {

// Correspondence of a trihedron: its position and the vertices of D.
using Match = std::array<std::int32_t, 5>;

Matching_vertices described(const Flat_mesh& mesh)
{
  return CR::internal::matching_vertices(mesh, mesh, CR::internal::vertex_normals(mesh),
                                         3 * CR::internal::median_edge_length(mesh));
}

std::set<Match> matches(const Matching_vertices& s, const std::vector<Spatial_trihedron>& trihedra,
                        const Matching_vertices& d, const Match_tolerances& t)
{
  std::set<Match> result;
  for (const auto& c : CR::internal::match_trihedra(s, trihedra, d, t)) {
    const auto& v = c.vertices;
    BOOST_TEST(result.insert({c.trihedron, v[0], v[1], v[2], v[3]}).second); // none twice
  }
  return result;
}

// More digits than the search has.
using Long_vector = Eigen::Matrix<long double, 3, 1>;

Long_vector to_long(const Vector& v)
{
  return v.cast<long double>();
}

long double length(const Vector& p, const Vector& q)
{
  return (to_long(q) - to_long(p)).norm();
}

// Six times the volume of a tetrahedron, by the cofactors of a row.
long double volume(const Vector& a, const Vector& b, const Vector& c, const Vector& d)
{
  const Long_vector u = to_long(b) - to_long(a), v = to_long(c) - to_long(a), w = to_long(d) - to_long(a);
  return u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) + u[2] * (v[0] * w[1] - v[1] * w[0]);
}

double angle_between(const Vector& a, const Vector& b)
{
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// How far the normals of two vertices are turned about the line from the one to the other: the difference of their
// azimuths, from any direction at right angles to the line.
double turn_about_line(const Vector& p, const Vector& np, const Vector& q, const Vector& nq)
{
  const Vector u = (q - p).normalized(), e = u.unitOrthogonal(), f = u.cross(e);
  return std::atan2(nq.dot(f), nq.dot(e)) - std::atan2(np.dot(f), np.dot(e));
}

bool turns_agree(double a, double b, double tolerance)
{
  return std::abs(std::remainder(a - b, 2 * generated::pi)) <= tolerance;
}

// The barycentric coordinates of the projection of a point on the plane of a triangle.
Vector coordinates(const Vector& a, const Vector& b, const Vector& c, const Vector& p)
{
  Matrix m;
  m << b - a, c - a, (b - a).cross(c - a);
  const Vector solution = m.inverse() * (p - a);
  return Vector(1 - solution[0] - solution[1], solution[0], solution[1]);
}

// Whether y is rigidly x, as match_trihedra() promises.
bool are_rigid(const std::array<Vector, 4>& x, const std::array<Vector, 4>& y, double tolerance)
{
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (std::abs(length(x[i], x[j]) - length(y[i], y[j])) > (i == 1 ? tolerance : 2 * tolerance)) return false;
  if (!(volume(x[0], x[1], x[2], x[3]) * volume(y[0], y[1], y[2], y[3]) > 0)) return false;
  // The fourth vertex is on the same side of each edge: of the line through the other two vertices of the triangle.
  const Vector there = coordinates(x[0], x[1], x[2], x[3]), here = coordinates(y[0], y[1], y[2], y[3]);
  for (int k = 0; k < 3; ++k) {
    const Vector &a = x[std::size_t((k + 1) % 3)], &b = x[std::size_t((k + 2) % 3)];
    const double height = (x[std::size_t(k)] - a).cross(b - a).norm() / (b - a).norm();
    if (std::abs(there[k]) * height > 2 * tolerance && there[k] * here[k] < 0) return false;
  }
  return true;
}

// Columns: along the line from p to q, towards the mean normal, and at right angles to both.
Matrix frame_of_pair(const Vector& p, const Vector& np, const Vector& q, const Vector& nq)
{
  Matrix m;
  m.col(0) = (q - p).normalized();
  const Vector mean = np + nq;
  m.col(1) = (mean - mean.dot(m.col(0)) * m.col(0)).normalized();
  m.col(2) = m.col(0).cross(m.col(1));
  return m;
}

Matrix frame_of_triangle(const Vector& p, const Vector& q, const Vector& r)
{
  Matrix m;
  m.col(0) = (q - p).normalized();
  m.col(2) = (q - p).cross(r - p).normalized();
  m.col(1) = m.col(2).cross(m.col(0));
  return m;
}

// The search of section 6 of the paper as it is defined: every vertex for every corner, nothing looked up.
std::set<Match> by_brute_force(const Matching_vertices& s, const std::vector<Spatial_trihedron>& trihedra,
                               const Matching_vertices& d, const Match_tolerances& t)
{
  std::set<Match> result;
  const auto n = std::int32_t(d.points.size());
  const auto S = [&](std::int32_t i) { return s.points[std::size_t(i)]; };
  const auto D = [&](std::int32_t i) { return d.points[std::size_t(i)]; };
  const auto s_normal = [&](std::int32_t i) { return s.normals[std::size_t(i)]; };
  const auto d_normal = [&](std::int32_t i) { return d.normals[std::size_t(i)]; };
  const auto alike = [&](std::int32_t i, std::int32_t j) {
    return !d_normal(j).isZero() &&
           std::abs(s.minimum_curvatures[std::size_t(i)] - d.minimum_curvatures[std::size_t(j)]) <= t.curvature &&
           std::abs(s.maximum_curvatures[std::size_t(i)] - d.maximum_curvatures[std::size_t(j)]) <= t.curvature;
  };
  for (std::size_t k = 0; k < trihedra.size(); ++k) {
    const std::int32_t V = trihedra[k].origin, v1 = trihedra[k].ends[0], v2 = trihedra[k].ends[1],
                       v3 = trihedra[k].ends[2];
    const Vector a1 = S(v1) - S(V), a2 = S(v2) - S(V), a3 = S(v3) - S(V);
    const Matrix pair_frame = frame_of_pair(S(V), s_normal(V), S(v1), s_normal(v1));
    const Vector u = pair_frame.col(0), line = s_normal(V) + s_normal(v1);
    const double sine = (std::min)(u.cross(s_normal(V)).norm(), u.cross(s_normal(v1)).norm()),
                 spread = u.cross(line).norm();
    // v2 in cylinder coordinates about the line, and v3 in coordinates of the triangle.
    const Vector local2 = pair_frame.transpose() * a2;
    const double axial = local2[0] - a1.norm() / 2, radius = std::hypot(local2[1], local2[2]),
                 azimuth = std::atan2(local2[2], local2[1]);
    Matrix triangle;
    triangle << a1, a2, a1.cross(a2).normalized();
    const Vector local3 = triangle.inverse() * a3;
    for (std::int32_t c0 = 0; c0 < n; ++c0) {
      if (!alike(V, c0)) continue;
      for (std::int32_t c1 = 0; c1 < n; ++c1) {
        if (c1 == c0 || !alike(v1, c1)) continue;
        const Vector b1 = D(c1) - D(c0);
        if (!(std::abs(length(D(c0), D(c1)) - length(S(V), S(v1))) <= t.length)) continue; // on the sphere
        if (t.use_normals && (std::abs(angle_between(b1, d_normal(c0)) - angle_between(a1, s_normal(V))) > t.angle ||
                              std::abs(angle_between(b1, d_normal(c1)) - angle_between(a1, s_normal(v1))) > t.angle ||
                              !turns_agree(turn_about_line(D(c0), d_normal(c0), D(c1), d_normal(c1)),
                                           turn_about_line(S(V), s_normal(V), S(v1), s_normal(v1)), t.angle / sine)))
          continue;
        const Matrix image = frame_of_pair(D(c0), d_normal(c0), D(c1), d_normal(c1));
        for (std::int32_t c2 = 0; c2 < n; ++c2) {
          if (c2 == c0 || c2 == c1 || !alike(v2, c2)) continue;
          const Vector b2 = D(c2) - D(c0), local = image.transpose() * b2;
          // On the circle.
          if (std::hypot(local[0] - b1.norm() / 2 - axial, std::hypot(local[1], local[2]) - radius) > t.length)
            continue;
          if (t.use_normals) {
            const double turn = std::abs(std::remainder(std::atan2(local[2], local[1]) - azimuth, 2 * CGAL_PI));
            if (turn > 2 * t.angle / spread) continue;
            if (angle_between(d_normal(c2), image * pair_frame.transpose() * s_normal(v2)) > t.angle) continue;
          }
          Matrix image_triangle;
          image_triangle << b1, b2, b1.cross(b2).normalized();
          const Vector p = D(c0) + image_triangle * local3;
          const Matrix turn =
              frame_of_triangle(D(c0), D(c1), D(c2)) * frame_of_triangle(S(V), S(v1), S(v2)).transpose();
          for (std::int32_t c3 = 0; c3 < n; ++c3) {
            if (!alike(v3, c3) || !((D(c3) - p).norm() <= t.length)) continue;
            if (t.use_normals && angle_between(d_normal(c3), turn * s_normal(v3)) > t.angle) continue;
            if (are_rigid({S(V), S(v1), S(v2), S(v3)}, {D(c0), D(c1), D(c2), D(c3)}, t.length))
              result.insert({std::int32_t(k), c0, c1, c2, c3});
          }
        }
      }
    }
  }
  return result;
}

Match_tolerances tolerances(const Flat_mesh& mesh, double length, bool use_normals)
{
  Match_tolerances t;
  t.length = length * CR::internal::median_edge_length(mesh);
  t.angle = 0.3;
  t.curvature = 0.5 / CR::internal::median_edge_length(mesh);
  t.use_normals = use_normals;
  return t;
}

Trihedron_options arms(double least, double most)
{
  Trihedron_options o;
  o.minimum_length = least;
  o.maximum_length = most;
  return o;
}

Flat_mesh mirrored(Flat_mesh mesh)
{
  for (Vector& p : mesh.points) p.x() = -p.x();
  for (auto& f : mesh.faces) std::swap(f[0], f[1]);
  return mesh;
}

double displacement(const Flat_mesh& mesh, const Rigid_motion& a, const Rigid_motion& b)
{
  double largest = 0;
  for (const Vector& p : mesh.points) largest = (std::max)(largest, (a(p) - b(p)).norm());
  return largest;
}

using Vertex = Mesh::Vertex_index;
using Mesh_match = CR::Trihedron_match<Vertex, Vertex, Kernel>;

std::int32_t index(Vertex v)
{
  return std::int32_t(std::size_t(v));
}

std::array<std::int32_t, 4> indices(const CR::Spatial_trihedron<Vertex>& t)
{
  return {index(t.origin), index(t.ends[0]), index(t.ends[1]), index(t.ends[2])};
}

Match indices(const Mesh_match& m)
{
  const auto d = indices(m.target);
  return {index(m.source.origin), d[0], d[1], d[2], d[3]};
}

// In an order that does not depend on the frame; that of the trihedra is kept.
template <class NamedParameters>
std::vector<Mesh_match> sorted_matches(const Flat_mesh& s, const Flat_mesh& d, const NamedParameters& np)
{
  const auto found = CR::match_trihedra(mesh_of<Mesh>(s), mesh_of<Mesh>(d), np);
  for (std::size_t i = 1; i < found.size(); ++i) BOOST_TEST(found[i - 1].source.origin <= found[i].source.origin);
  std::map<Match, std::size_t> order;
  for (std::size_t i = 0; i < found.size(); ++i) order[indices(found[i])] = i;
  BOOST_TEST(order.size() == found.size()); // none twice
  std::vector<Mesh_match> result;
  for (const auto& i : order) result.push_back(found[i.second]);
  return result;
}

} // namespace

BOOST_AUTO_TEST_CASE(the_search_finds_what_brute_force_finds)
{
  generated::Random random(1);
  const Flat_mesh source = generated::bumps(9);
  // Not the same surface, but one alike, so that the tolerances decide; its vertices in another order.
  Flat_mesh target = generated::shuffled(generated::moved(source, random.motion(2)), 5);
  for (Vector& p : target.points) p += 0.03 * random.vector();
  Matching_vertices s = described(source), d = described(target);
  for (std::size_t i = 0; i < d.normals.size(); i += 17) d.normals[i].setZero(); // take no part
  const auto trihedra = CR::internal::spatial_trihedra(s.points, s.inside, arms(0.15, 0.5));
  BOOST_TEST_REQUIRE(trihedra.size() > 30u);
  for (bool use_normals : {true, false})
    for (double size : {0.2, 0.6}) {
      const Match_tolerances t = tolerances(source, size, use_normals);
      const std::set<Match> found = matches(s, trihedra, d, t), wanted = by_brute_force(s, trihedra, d, t);
      BOOST_TEST_MESSAGE(wanted.size() << " matches");
      BOOST_TEST(wanted.size() > 10u); // or the test would say little
      BOOST_TEST((found == wanted));
    }
}

BOOST_AUTO_TEST_CASE(every_trihedron_is_found_in_a_moved_copy)
{
  generated::Random random(2);
  const Flat_mesh mesh = generated::bumps(14);
  const Rigid_motion motion = random.motion(3);
  const Matching_vertices s = described(mesh), d = described(generated::moved(mesh, motion));
  const auto trihedra = CR::internal::spatial_trihedra(s.points, s.inside, arms(0, 0.5));
  for (bool use_normals : {true, false}) {
    std::vector<int> is_found(trihedra.size(), 0);
    for (const auto& c : CR::internal::match_trihedra(s, trihedra, d, tolerances(mesh, 0.3, use_normals))) {
      const Spatial_trihedron& t = trihedra[std::size_t(c.trihedron)];
      if (c.vertices != std::array<std::int32_t, 4>{t.origin, t.ends[0], t.ends[1], t.ends[2]}) continue;
      is_found[std::size_t(c.trihedron)] = 1;
      BOOST_TEST(c.residual < 1e-12);
      BOOST_TEST(displacement(mesh, c.motion, motion) < 1e-9);
    }
    BOOST_TEST(std::count(is_found.begin(), is_found.end(), 1) == std::ptrdiff_t(trihedra.size()));
  }
}

BOOST_AUTO_TEST_CASE(mirror_images_and_degenerate_trihedra_are_no_match)
{
  // A trihedron so flat that the place of v3 and that of its mirror image are within the tolerance of each other.
  Matching_vertices s;
  s.points = {Vector(0, 0, 0), Vector(1, 0.1, 0), Vector(-0.2, 1.3, 0), Vector(0.7, 0.8, 0.05)};
  s.normals.assign(4, Vector(0, 0, 1));
  s.minimum_curvatures.assign(4, 0);
  s.maximum_curvatures.assign(4, 0);
  s.inside.assign(4, 1);
  const std::vector<Spatial_trihedron> trihedra = {{0, {1, 2, 3}}};
  Match_tolerances t;
  t.length = 0.15;
  t.angle = 0.2;
  t.curvature = 1;
  for (bool use_normals : {true, false}) {
    t.use_normals = use_normals;
    Matching_vertices d = s;
    BOOST_TEST(matches(s, trihedra, d, t).count({0, 0, 1, 2, 3}) == 1u);
    d.points[3].z() = -d.points[3].z();
    BOOST_TEST(matches(s, trihedra, d, t).empty());
    d.points[3].z() = 0; // neither the trihedron nor its mirror image
    BOOST_TEST(matches(s, trihedra, d, t).empty());
    d.points[3].z() = std::numeric_limits<double>::min(); // the least that is not in the plane
    BOOST_TEST(matches(s, trihedra, d, t).count({0, 0, 1, 2, 3}) == 1u);
    Matching_vertices flat = s;
    flat.points[3].z() = 0;
    BOOST_TEST(matches(flat, trihedra, s, t).empty());
  }

  // No trihedron of a surface is one of its mirror image.
  const Flat_mesh mesh = generated::bumps(12);
  const Matching_vertices a = described(mesh), b = described(mirrored(mesh));
  const auto all = CR::internal::spatial_trihedra(a.points, a.inside, arms(0, 0.5));
  for (const Match& m : matches(a, all, b, tolerances(mesh, 0.3, true))) {
    const Spatial_trihedron& x = all[std::size_t(m[0])];
    BOOST_TEST((m != Match{m[0], x.origin, x.ends[0], x.ends[1], x.ends[2]}));
    const auto volume_of = [](const Matching_vertices& v, std::array<std::int32_t, 4> i) {
      return volume(v.points[std::size_t(i[0])], v.points[std::size_t(i[1])], v.points[std::size_t(i[2])],
                    v.points[std::size_t(i[3])]);
    };
    BOOST_TEST(volume_of(a, {x.origin, x.ends[0], x.ends[1], x.ends[2]}) * volume_of(b, {m[1], m[2], m[3], m[4]}) > 0);
  }
}

BOOST_AUTO_TEST_CASE(of_meshes_in_any_frame_unit_and_order)
{
  generated::Random random(4);
  const Flat_mesh s = generated::bumps(12);
  Flat_mesh d = s;
  for (Vector& p : d.points) p.z() += 0.004 * random.symmetric();
  const auto f = [](double scale) {
    return CR::parameters::minimum_extent(0.1).maximum_extent(0.6).tolerance(0.04 * scale);
  };
  const auto expected = sorted_matches(s, d, f(1));
  BOOST_TEST_REQUIRE(expected.size() > 30u);
  // Units that float does not hold, too.
  for (double scale : {1., 1e-3, 1e3, 1e-42, 1e42}) {
    const Rigid_motion a = random.motion(2 * scale), b = random.motion(2 * scale);
    const auto found = sorted_matches(generated::moved(s, a, scale), generated::moved(d, b, scale), f(scale));
    BOOST_TEST_REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      BOOST_TEST((indices(found[i]) == indices(expected[i])));
      BOOST_TEST(std::abs(found[i].residual - scale * expected[i].residual) < 1e-9 * scale);
      Rigid_motion wanted = CR::internal::to_rigid_motion(expected[i].transformation);
      wanted.translation *= scale;
      const Rigid_motion m = b.inverse() * CR::internal::to_rigid_motion(found[i].transformation) * a;
      BOOST_TEST(displacement(generated::moved(s, Rigid_motion(), scale), m, wanted) < 1e-8 * scale);
    }
  }
  // The order of the target's vertices only changes that of the matches of a trihedron.
  const auto motions = [](const auto& found) {
    std::vector<std::array<double, 2>> result;
    for (const auto& m : found) result.push_back({double(std::size_t(m.source.origin)), m.residual});
    std::sort(result.begin(), result.end());
    return result;
  };
  const auto shuffled = motions(sorted_matches(s, generated::shuffled(d, 9), f(1)));
  const auto wanted = motions(expected);
  BOOST_TEST_REQUIRE(shuffled.size() == wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    BOOST_TEST(shuffled[i][0] == wanted[i][0]);
    BOOST_TEST(std::abs(shuffled[i][1] - wanted[i][1]) < 1e-9);
  }
}

BOOST_AUTO_TEST_CASE(extents_of_the_axes)
{
  const Mesh mesh = mesh_of<Mesh>(generated::bumps(14));
  const double extent = CR::scan_extent(mesh).mean();
  const auto check = [&](const auto& np, double f1, double f2) {
    // Those of spatial_trihedra() are matched, all of them in a copy, with arms within f1 M and f2 M.
    const auto trihedra = CR::spatial_trihedra(mesh, np);
    std::set<std::array<std::int32_t, 4>> wanted, found;
    for (const auto& t : trihedra) wanted.insert(indices(t));
    for (const Mesh_match& m : CR::match_trihedra(mesh, mesh, np)) {
      if (m.source == m.target) found.insert(indices(m.source));
      for (const auto& t : {m.source, m.target})
        for (const Vertex e : t.ends) {
          const double share = std::sqrt(CGAL::squared_distance(mesh.point(t.origin), mesh.point(e))) / extent;
          // The source's exactly, the target's by twice the tolerance.
          const double slack = t == m.source ? 0 : 1.4 * 0.09 / extent;
          BOOST_TEST(share >= f1 - slack);
          BOOST_TEST(share <= f2 + slack);
        }
    }
    BOOST_TEST((found == wanted));
    BOOST_TEST(wanted.size() > 50u);
    return found;
  };
  const auto by_default = check(CR::parameters::default_values(), 0, 0.3);
  // Each of the bounds is heard, for itself.
  BOOST_TEST((check(CR::parameters::minimum_extent(0.2), 0.2, 0.3) != by_default));
  BOOST_TEST((check(CR::parameters::maximum_extent(0.2), 0, 0.2) != by_default));
  check(CR::parameters::minimum_extent(0.3).maximum_extent(0.6), 0.3, 0.6);
}

BOOST_AUTO_TEST_CASE(normals_and_curvatures_are_those_given)
{
  const Flat_mesh flat = generated::bumps(10);
  Mesh mesh = mesh_of<Mesh>(flat);
  const Matching_vertices v = described(flat);
  auto normals = mesh.add_property_map<Mesh::Vertex_index, Kernel::Vector_3>("v:given_normal").first;
  auto curvatures = mesh.add_property_map<Mesh::Vertex_index, CR::Principal_curvatures<Kernel>>("v:given").first;
  for (const auto i : mesh.vertices()) {
    const Vector n = 3 * v.normals[i]; // of any length
    normals[i] = Kernel::Vector_3(n.x(), n.y(), n.z());
    curvatures[i].minimum = v.minimum_curvatures[i];
    curvatures[i].maximum = v.maximum_curvatures[i];
  }
  const auto np = CR::parameters::vertex_normal_map(normals).curvature_map(curvatures);
  const auto found = CR::match_trihedra(mesh, mesh, np, np);
  BOOST_TEST(!found.empty());
  // The same as from the flat arrays.
  Match_tolerances t;
  t.length = 0.7 * CR::internal::median_edge_length(flat);
  t.angle = 15 * CGAL_PI / 180;
  t.curvature = 0.15 / t.length;
  std::vector<Spatial_trihedron> trihedra;
  for (const auto& x : CR::spatial_trihedra(mesh))
    trihedra.push_back({index(x.origin), {index(x.ends[0]), index(x.ends[1]), index(x.ends[2])}});
  const auto check = [&](const std::vector<Mesh_match>& some) {
    const auto wanted = CR::internal::match_trihedra(v, trihedra, v, t);
    BOOST_TEST_REQUIRE(some.size() == wanted.size());
    for (std::size_t i = 0; i < some.size(); ++i) {
      const Spatial_trihedron& x = trihedra[std::size_t(wanted[i].trihedron)];
      const auto& y = wanted[i].vertices;
      BOOST_TEST((indices(some[i].source) == std::array<std::int32_t, 4>{x.origin, x.ends[0], x.ends[1], x.ends[2]}));
      BOOST_TEST((indices(some[i].target) == y));
    }
  };
  check(found);
  // Without normals there are more.
  t.use_normals = false;
  const auto by_curvatures = CR::match_trihedra(mesh, mesh, np.use_normals(false), np);
  check(by_curvatures);
  BOOST_TEST(by_curvatures.size() > found.size());

  // A target whose curvatures are all far away has no match, nor has one whose normals all point the other way.
  auto other = mesh.add_property_map<Mesh::Vertex_index, CR::Principal_curvatures<Kernel>>("v:other").first;
  auto opposite = mesh.add_property_map<Mesh::Vertex_index, Kernel::Vector_3>("v:opposite").first;
  for (const auto i : mesh.vertices()) {
    other[i].minimum = other[i].maximum = 1e3;
    opposite[i] = -normals[i];
  }
  BOOST_TEST(
      CR::match_trihedra(mesh, mesh, np, CR::parameters::vertex_normal_map(normals).curvature_map(other)).empty());
  for (const auto& m :
       CR::match_trihedra(mesh, mesh, np, CR::parameters::vertex_normal_map(opposite).curvature_map(curvatures)))
    BOOST_TEST((m.source != m.target));
}

BOOST_AUTO_TEST_CASE(wrong_use_is_named)
{
  namespace P = CR::parameters;
  const Mesh mesh = mesh_of<Mesh>(generated::bumps(6)), empty;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto call = [&mesh](auto np) { return [&mesh, np] { CR::match_trihedra(mesh, mesh, np); }; };
  BOOST_TEST(is_refused(call(P::minimum_extent(0.4).maximum_extent(0.3)), "match_trihedra:", "minimum_extent"));
  BOOST_TEST(is_refused(call(P::minimum_extent(0.3).maximum_extent(0.3)), "match_trihedra:", "minimum_extent"));
  BOOST_TEST(is_refused(call(P::minimum_extent(-0.1)), "match_trihedra:", "minimum_extent"));
  BOOST_TEST(is_refused(call(P::minimum_extent(nan)), "match_trihedra:", "minimum_extent"));
  BOOST_TEST(is_refused(call(P::maximum_extent(nan)), "match_trihedra:", "maximum_extent"));
  BOOST_TEST(is_refused(call(P::maximum_extent(0.)), "match_trihedra:", "maximum_extent"));
  for (double t : {0., -1., nan, std::numeric_limits<double>::infinity()})
    BOOST_TEST(is_refused(call(P::tolerance(t)), "match_trihedra:", "tolerance"));

  BOOST_TEST(is_refused([&] { CR::match_trihedra(empty, mesh); }, "match_trihedra:", "source"));
  BOOST_TEST(is_refused([&] { CR::match_trihedra(mesh, empty); }, "match_trihedra:", "target"));
  // All of its vertices are on the border; as a target it would do.
  const Mesh strip = mesh_of<Mesh>(generated::bumps(1));
  BOOST_TEST(is_refused([&] { CR::match_trihedra(strip, mesh); }, "match_trihedra:", "source"));
  BOOST_CHECK_NO_THROW(CR::match_trihedra(mesh, strip));
  Mesh triangle;
  triangle.add_face(triangle.add_vertex(Kernel::Point_3(0, 0, 0)), triangle.add_vertex(Kernel::Point_3(1, 0, 0)),
                    triangle.add_vertex(Kernel::Point_3(0, 1, 0)));
  BOOST_TEST(is_refused([&] { CR::match_trihedra(mesh, triangle); }, "match_trihedra:", "target"));

  Mesh broken = mesh;
  broken.point(*broken.vertices().begin()) = Kernel::Point_3(0, nan, 0);
  BOOST_TEST(is_refused([&] { CR::match_trihedra(broken, mesh); }, "match_trihedra:", "source"));
  BOOST_TEST(is_refused([&] { CR::match_trihedra(mesh, broken); }, "match_trihedra:", "target"));
  Mesh quad;
  quad.add_face(quad.add_vertex(Kernel::Point_3(0, 0, 0)), quad.add_vertex(Kernel::Point_3(1, 0, 0)),
                quad.add_vertex(Kernel::Point_3(1, 1, 0)), quad.add_vertex(Kernel::Point_3(0, 1, 0)));
  BOOST_TEST(is_refused([&] { CR::match_trihedra(quad, mesh); }, "match_trihedra:", "not a triangle"));
  BOOST_TEST(is_refused([&] { CR::match_trihedra(mesh, quad); }, "match_trihedra:", "not a triangle"));

  Mesh described_wrongly = mesh;
  auto normals = described_wrongly.add_property_map<Mesh::Vertex_index, Kernel::Vector_3>("v:n").first;
  for (const auto v : described_wrongly.vertices()) normals[v] = Kernel::Vector_3(0, 0, nan);
  BOOST_TEST(is_refused([&] { CR::match_trihedra(described_wrongly, mesh, P::vertex_normal_map(normals)); },
                        "match_trihedra:", "a normal"));
  auto curvatures =
      described_wrongly.add_property_map<Mesh::Vertex_index, CR::Principal_curvatures<Kernel>>("v:k").first;
  for (const auto v : described_wrongly.vertices()) curvatures[v].maximum = nan;
  BOOST_TEST(is_refused(
      [&] { CR::match_trihedra(mesh, described_wrongly, P::default_values(), P::curvature_map(curvatures)); },
      "match_trihedra:", "curvature"));
}

BOOST_AUTO_TEST_CASE(vertices_are_described_by_the_dense_surface)
{
  // A sphere and a cylinder with outward normals; vertices of the simplified mesh off the surface by a little.
  const Flat_mesh sphere = generated::sphere(40, 2);
  Flat_mesh coarse = generated::sphere(6, 2.01);
  Matching_vertices v = CR::internal::matching_vertices(coarse, sphere, CR::internal::vertex_normals(sphere), 0.5);
  for (std::size_t i = 0; i < v.points.size(); ++i) {
    if (std::abs(v.points[i].normalized().z()) > 0.95) continue; // the mesh is coarse at its poles
    BOOST_TEST(v.normals[i].dot(v.points[i].normalized()) > 0.999);
    BOOST_TEST(std::abs(v.minimum_curvatures[i] - 0.5) < 0.03);
    BOOST_TEST(std::abs(v.maximum_curvatures[i] - 0.5) < 0.03);
    BOOST_TEST(int(v.inside[i]) == 1);
  }
  const auto cylinder = [](int columns, int rows) {
    return generated::grid(
        columns, rows,
        [](double x, double y) {
          return Vector(0.5 * std::cos(2 * generated::pi * x), 0.5 * std::sin(2 * generated::pi * x), 2 * y);
        },
        0.25, true, false);
  };
  const Flat_mesh dense = cylinder(80, 50);
  coarse = cylinder(12, 6);
  v = CR::internal::matching_vertices(coarse, dense, CR::internal::vertex_normals(dense), 0.2);
  const auto borders = CR::internal::border_flags(coarse);
  for (std::size_t i = 0; i < v.points.size(); ++i) {
    BOOST_TEST(int(v.inside[i]) == int(!borders[i]));
    BOOST_TEST(std::abs(v.minimum_curvatures[i]) < 0.1);
    BOOST_TEST(std::abs(v.maximum_curvatures[i] - 2) < 0.2);
  }
  // Nothing near, nothing known: the vertex takes no part.
  v = CR::internal::matching_vertices(generated::moved(coarse, generated::Random(1).motion(0), 9.), dense,
                                      CR::internal::vertex_normals(dense), 0.2);
  for (std::size_t i = 0; i < v.points.size(); ++i) {
    BOOST_TEST(v.normals[i].isZero(0));
    BOOST_TEST(int(v.inside[i]) == 0);
  }
}
