// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#define BOOST_TEST_MODULE spatial_trihedron
#include <boost/test/unit_test.hpp>

#include <CGAL/Crude_registration/internal/matching/flat_trihedra.h>
#include <CGAL/Crude_registration/matching/spatial_trihedra.h>
#include <CGAL/Crude_registration/reduction/scan_extent.h>

#include <CGAL/Simple_cartesian.h>
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
#include <string>
#include <vector>

namespace CR = CGAL::Crude_registration;
using CR::internal::Flat_mesh;
using CR::internal::Spatial_trihedron;
using CR::internal::Trihedron_options;
using CR::internal::Vector;
using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

namespace {

std::vector<std::uint8_t> all_inside(const std::vector<Vector>& points)
{
  return std::vector<std::uint8_t>(points.size(), 1);
}

std::vector<std::uint8_t> inside_of(const Flat_mesh& mesh)
{
  std::vector<std::uint8_t> inside = CR::internal::border_flags(mesh);
  for (std::uint8_t& i : inside) i = !i;
  return inside;
}

Trihedron_options options(double least, double most)
{
  Trihedron_options o;
  o.minimum_length = least;
  o.maximum_length = most;
  return o;
}

double volume(const std::vector<Vector>& p, std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d)
{
  const Vector& o = p[std::size_t(a)];
  return (p[std::size_t(b)] - o).cross(p[std::size_t(c)] - o).dot(p[std::size_t(d)] - o);
}

} // namespace

BOOST_AUTO_TEST_CASE(arms_are_within_their_limits_and_inside_the_mesh)
{
  const Flat_mesh mesh = generated::bumps(24);
  const std::vector<std::uint8_t> inside = inside_of(mesh);
  const auto trihedra = CR::internal::spatial_trihedra(mesh.points, inside, options(0.1, 0.3));
  std::size_t number_inside = 0;
  for (std::uint8_t i : inside) number_inside += i;
  // Every vertex of this mesh has others in reach, in no plane with it.
  BOOST_TEST(trihedra.size() == number_inside);
  for (const Spatial_trihedron& t : trihedra) {
    BOOST_TEST(inside[std::size_t(t.origin)] == 1);
    for (std::int32_t e : t.ends) {
      BOOST_TEST(inside[std::size_t(e)] == 1);
      const double length = (mesh.points[std::size_t(e)] - mesh.points[std::size_t(t.origin)]).norm();
      BOOST_TEST(length >= 0.1);
      BOOST_TEST(length <= 0.3);
    }
  }
}

BOOST_AUTO_TEST_CASE(arms_are_as_long_and_as_orthogonal_as_the_surface_allows)
{
  // On a sphere of radius 1, seen from a vertex, the arms that make the largest volume with ends within a distance of
  // sqrt(2) reach all of it; a quarter of the largest possible volume is far from degenerate.
  const Flat_mesh mesh = generated::sphere(12, 1);
  const auto trihedra = CR::internal::spatial_trihedra(mesh.points, inside_of(mesh), options(0, std::sqrt(2.)));
  BOOST_TEST_REQUIRE(trihedra.size() == mesh.points.size());
  for (const Spatial_trihedron& t : trihedra)
    BOOST_TEST(std::abs(volume(mesh.points, t.origin, t.ends[0], t.ends[1], t.ends[2])) > 0.25);

  // No end makes more volume with the first two than the third does.
  const Flat_mesh bumps = generated::bumps(12);
  for (const Spatial_trihedron& t :
       CR::internal::spatial_trihedra(bumps.points, all_inside(bumps.points), options(0, 0.4))) {
    const double largest = std::abs(volume(bumps.points, t.origin, t.ends[0], t.ends[1], t.ends[2]));
    for (std::size_t i = 0; i < bumps.points.size(); ++i)
      if ((bumps.points[i] - bumps.points[std::size_t(t.origin)]).norm() <= 0.4)
        BOOST_TEST(std::abs(volume(bumps.points, t.origin, t.ends[0], t.ends[1], std::int32_t(i))) <=
                   largest * (1 + 1e-12));
  }
}

BOOST_AUTO_TEST_CASE(limits_are_exact)
{
  // A Pythagorean tetrapod: arms of length exactly 5 in units of 2^-20, which double represents.
  const double unit = std::ldexp(1., -20);
  const std::vector<Vector> points = {Vector(0, 0, 0), unit * Vector(3, 4, 0), unit * Vector(-4, 3, 0),
                                      unit * Vector(0, 0, 5)};
  std::vector<std::uint8_t> only_first = {1, 1, 1, 1};
  const auto from_first = [&](const std::vector<Vector>& p, double least, double most) {
    std::size_t n = 0;
    for (const auto& t : CR::internal::spatial_trihedra(p, only_first, options(least, most))) n += t.origin == 0;
    return n;
  };
  BOOST_TEST(from_first(points, 5 * unit, 6 * unit) == 1u);
  BOOST_TEST(from_first(points, 0, 5 * unit) == 1u);
  BOOST_TEST(from_first(points, std::nextafter(5 * unit, 1.), 6 * unit) == 0u);
  BOOST_TEST(from_first(points, 0, std::nextafter(5 * unit, 0.)) == 0u);
  std::vector<Vector> longer = points;
  longer[3][2] = std::nextafter(longer[3][2], 1.);
  BOOST_TEST(from_first(longer, 0, 5 * unit) == 0u);
}

BOOST_AUTO_TEST_CASE(coplanar_vertices_make_no_trihedron)
{
  // Points of the plane z = 3x + 5y with integer coordinates so large that products of them are rounded.
  generated::Random random(3);
  std::vector<Vector> points;
  for (int i = 0; i < 40; ++i) {
    const double x = std::round(std::ldexp(random.symmetric(), 40)), y = std::round(std::ldexp(random.symmetric(), 40));
    points.emplace_back(x, y, 3 * x + 5 * y);
  }
  bool is_rounded = false;
  for (std::int32_t i = 3; i < 40; ++i) is_rounded = is_rounded || volume(points, 0, 1, 2, i) != 0;
  BOOST_TEST(is_rounded); // or the test would say nothing
  const double reach = std::ldexp(1., 44);
  BOOST_TEST(CR::internal::spatial_trihedra(points, all_inside(points), options(0, reach)).empty());

  // One step of one coordinate out of the plane is enough for all of them, though in double other volumes, of rounding
  // alone, are larger.
  points[7][2] = std::nextafter(points[7][2], reach);
  const auto trihedra = CR::internal::spatial_trihedra(points, all_inside(points), options(0, reach));
  BOOST_TEST(trihedra.size() == 40u);
  bool is_smaller = false;
  for (const Spatial_trihedron& t : trihedra) {
    BOOST_TEST((t.origin == 7 || std::find(t.ends.begin(), t.ends.end(), 7) != t.ends.end()));
    const double chosen = std::abs(volume(points, t.origin, t.ends[0], t.ends[1], t.ends[2]));
    for (std::int32_t i = 0; i < 40; ++i)
      is_smaller = is_smaller || std::abs(volume(points, t.origin, t.ends[0], t.ends[1], i)) > chosen;
  }
  BOOST_TEST(is_smaller);
}

BOOST_AUTO_TEST_CASE(a_volume_that_double_does_not_see_makes_a_trihedron)
{
  // All vertices but one are nearer to a line than double can tell: consecutive Fibonacci numbers make triangles whose
  // area is exactly 1/2 and 0 in double.
  std::vector<Vector> points = {Vector(0, 0, 0)};
  double a = 0, b = 1;
  for (int i = 0; i < 62; ++i) {
    const double c = a + b;
    a = b;
    b = c;
    if (i > 57) points.emplace_back(b, a, 0);
  }
  for (std::size_t i = 2; i < points.size(); ++i) BOOST_TEST(points[i - 1].cross(points[i]).isZero(0));
  points.emplace_back(2 * points.back()); // the one that is on a line with another one
  const double reach = 4 * points.back().norm();
  BOOST_TEST(CR::internal::spatial_trihedra(points, all_inside(points), options(0, reach)).empty());
  // Only this one is not in their plane, by nothing that a volume in double would show.
  points.emplace_back(1, -1, 1e-300);
  const auto trihedra = CR::internal::spatial_trihedra(points, all_inside(points), options(0, reach));
  BOOST_TEST(trihedra.size() == points.size());
  for (const Spatial_trihedron& t : trihedra)
    BOOST_TEST((t.origin == std::int32_t(points.size()) - 1 ||
                std::find(t.ends.begin(), t.ends.end(), std::int32_t(points.size()) - 1) != t.ends.end()));
}

BOOST_AUTO_TEST_CASE(collinear_few_or_coincident_vertices_make_no_trihedron)
{
  std::vector<Vector> points;
  BOOST_TEST(CR::internal::spatial_trihedra(points, all_inside(points), options(0, 1)).empty());
  for (int i = 0; i < 10; ++i) points.emplace_back(i, 2 * i, -i);
  BOOST_TEST(CR::internal::spatial_trihedra(points, all_inside(points), options(0, 100)).empty());
  points = {Vector(0, 0, 0), Vector(1, 0, 0), Vector(0, 1, 0)};
  BOOST_TEST(CR::internal::spatial_trihedra(points, all_inside(points), options(0, 100)).empty());
  points.assign(10, Vector(1, 2, 3));
  BOOST_TEST(CR::internal::spatial_trihedra(points, all_inside(points), options(0, 100)).empty());
  points = {Vector(0, 0, 0), Vector(1, 0, 0), Vector(0, 1, 0), Vector(0, 0, 1)};
  BOOST_TEST(CR::internal::spatial_trihedra(points, all_inside(points), options(0, 0)).empty());
  BOOST_TEST(CR::internal::spatial_trihedra(points, all_inside(points), options(0, 2)).size() == 4u);
}

BOOST_AUTO_TEST_CASE(the_choice_depends_on_neither_frame_nor_unit_nor_order)
{
  const Flat_mesh mesh = generated::bumps(16);
  const auto inside = inside_of(mesh);
  const auto expected = CR::internal::spatial_trihedra(mesh.points, inside, options(0.05, 0.35));
  generated::Random random(5);
  for (double scale : {1., 1e-3, 1e3}) {
    const Flat_mesh moved = generated::moved(mesh, random.motion(2 * scale), scale);
    const auto found = CR::internal::spatial_trihedra(moved.points, inside, options(0.05 * scale, 0.35 * scale));
    BOOST_TEST(std::equal(found.begin(), found.end(), expected.begin(), expected.end()));
  }
  std::vector<std::int32_t> order(mesh.points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = std::int32_t((i * 101 + 17) % order.size());
  std::vector<Vector> points(order.size());
  std::vector<std::uint8_t> shuffled_inside(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    points[std::size_t(order[i])] = mesh.points[i];
    shuffled_inside[std::size_t(order[i])] = inside[i];
  }
  auto found = CR::internal::spatial_trihedra(points, shuffled_inside, options(0.05, 0.35));
  BOOST_TEST_REQUIRE(found.size() == expected.size());
  for (const Spatial_trihedron& t : expected) {
    Spatial_trihedron renamed{order[std::size_t(t.origin)], {}};
    for (std::size_t i = 0; i < 3; ++i) renamed.ends[i] = order[std::size_t(t.ends[i])];
    BOOST_TEST((std::find(found.begin(), found.end(), renamed) != found.end()));
  }
}

BOOST_AUTO_TEST_CASE(several_trihedra_a_vertex_at_several_scales)
{
  const Flat_mesh mesh = generated::bumps(20);
  const auto inside = inside_of(mesh);
  Trihedron_options o = options(0.1, 0.4);
  const auto single = CR::internal::spatial_trihedra(mesh.points, inside, o);
  o.trihedra_per_scale = 3;
  const auto three = CR::internal::spatial_trihedra(mesh.points, inside, o);
  BOOST_TEST(three.size() > 2 * single.size());
  // The first one of each is the single one, and the first arms differ.
  std::size_t next = 0;
  for (std::size_t i = 0; i < three.size(); ++i) {
    const bool is_first = i == 0 || three[i].origin != three[i - 1].origin;
    if (is_first) BOOST_TEST((three[i] == single[next++]));
    else BOOST_TEST(three[i].ends[0] != three[i - 1].ends[0]);
  }
  o.trihedra_per_scale = 1;
  o.scales = {1, 0.5};
  const auto two_scales = CR::internal::spatial_trihedra(mesh.points, inside, o);
  BOOST_TEST(two_scales.size() == 2 * single.size());
  for (std::size_t i = single.size(); i < two_scales.size(); ++i)
    for (std::int32_t e : two_scales[i].ends)
      BOOST_TEST((mesh.points[std::size_t(e)] - mesh.points[std::size_t(two_scales[i].origin)]).norm() <= 0.25);
}

BOOST_AUTO_TEST_CASE(of_a_mesh_with_the_papers_shares)
{
  const Flat_mesh flat = generated::bumps(20);
  Mesh mesh;
  // Vertices in gaps between removed ones: a descriptor is not a position.
  const std::vector<std::uint8_t> borders = CR::internal::border_flags(flat);
  std::vector<Mesh::Vertex_index> handles;
  std::vector<Mesh::Vertex_index> removed;
  for (const Vector& p : flat.points) {
    removed.push_back(mesh.add_vertex(Kernel::Point_3(9, 9, 9)));
    handles.push_back(mesh.add_vertex(Kernel::Point_3(p.x(), p.y(), p.z())));
  }
  for (const auto& f : flat.faces)
    mesh.add_face(handles[std::size_t(f[0])], handles[std::size_t(f[1])], handles[std::size_t(f[2])]);
  for (const Mesh::Vertex_index v : removed) mesh.remove_vertex(v);

  const double extent = CR::scan_extent(mesh).mean();
  const auto length = [&](Mesh::Vertex_index v, Mesh::Vertex_index w) {
    return std::sqrt(CGAL::squared_distance(mesh.point(v), mesh.point(w))) / extent;
  };
  // f1 and f2 are the bounds, or 0 and 0.3; each is met by more than half.
  const auto check = [&](const auto& np, double f1, double f2) {
    const auto trihedra = CR::spatial_trihedra(mesh, np);
    BOOST_TEST(trihedra.size() > 100u);
    double shortest = 9, longest = 0;
    for (const CR::Spatial_trihedron<Mesh::Vertex_index>& t : trihedra) {
      BOOST_TEST(!mesh.is_border(t.origin));
      for (const Mesh::Vertex_index e : t.ends) {
        BOOST_TEST(!mesh.is_border(e));
        BOOST_TEST(length(t.origin, e) >= f1);
        BOOST_TEST(length(t.origin, e) <= f2);
        shortest = (std::min)(shortest, length(t.origin, e));
        longest = (std::max)(longest, length(t.origin, e));
      }
    }
    BOOST_TEST(shortest < f1 + 0.5 * (f2 - f1));
    BOOST_TEST(longest > f2 - 0.1 * (f2 - f1));
  };
  check(CR::parameters::default_values(), 0, 0.3);
  check(CR::parameters::minimum_extent(0.2).maximum_extent(0.5), 0.2, 0.5);
  check(CR::parameters::minimum_extent(0.2), 0.2, 0.3);
  check(CR::parameters::maximum_extent(0.15), 0, 0.15);
  // All trihedra are those of the flat mesh, whatever the vertices are called.
  const auto found = CR::spatial_trihedra(mesh);
  std::vector<std::uint8_t> inside(flat.points.size());
  for (std::size_t i = 0; i < inside.size(); ++i) inside[i] = !borders[i];
  const auto wanted = CR::internal::spatial_trihedra(flat.points, inside, options(0, 0.3 * extent));
  BOOST_TEST_REQUIRE(found.size() == wanted.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    BOOST_TEST(found[i].origin == handles[std::size_t(wanted[i].origin)]);
    for (std::size_t k = 0; k < 3; ++k) BOOST_TEST(found[i].ends[k] == handles[std::size_t(wanted[i].ends[k])]);
  }
  Mesh empty;
  BOOST_TEST(CR::spatial_trihedra(empty).empty());
}

BOOST_AUTO_TEST_CASE(wrong_use_is_named)
{
  const Mesh mesh = mesh_of<Mesh>(generated::bumps(4));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  namespace P = CR::parameters;
  const auto call = [&](auto np) { return [&mesh, np] { CR::spatial_trihedra(mesh, np); }; };
  BOOST_TEST(is_refused(call(P::minimum_extent(0.4).maximum_extent(0.3)), "spatial_trihedra", "minimum_extent"));
  BOOST_TEST(is_refused(call(P::minimum_extent(0.3).maximum_extent(0.3)), "spatial_trihedra", "minimum_extent"));
  BOOST_TEST(is_refused(call(P::minimum_extent(-0.1)), "spatial_trihedra", "minimum_extent"));
  BOOST_TEST(is_refused(call(P::maximum_extent(nan)), "spatial_trihedra", "maximum_extent"));
  BOOST_TEST(is_refused(call(P::maximum_extent(0.)), "spatial_trihedra", "maximum_extent"));
  Mesh broken = mesh;
  broken.point(*broken.vertices().begin()) = Kernel::Point_3(0, nan, 0);
  BOOST_TEST(is_refused([&] { CR::spatial_trihedra(broken); }, "spatial_trihedra", "mesh"));
}
