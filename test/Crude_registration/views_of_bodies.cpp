// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#define BOOST_TEST_MODULE views_of_bodies
#include <boost/test/unit_test.hpp>

#include "../../benchmark/Crude_registration/machined_parts.h"
#include "mesh_of.h"
#include "registration_checks.h"

#include <CGAL/Crude_registration/internal/judgement/Pose_judge.h>
#include <CGAL/Crude_registration/internal/mesh/encloses_a_body.h>
#include <CGAL/Crude_registration/register_scans.h>
#include <CGAL/Crude_registration/sampling/triangulate_range_image.h>
#include <CGAL/Crude_registration/simulation/simulate_range_image.h>

#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

// Single views of machined parts, with the closed models of the parts.

using benchmark_tools::Machined_part;

namespace {

Mesh part(const std::string& name)
{
  for (const Machined_part& p : benchmark_tools::machined_parts())
    if (p.name == name) return p.assembly();
  BOOST_FAIL("there is no part " + name);
  return {};
}

Mesh in_a_mirror(Mesh mesh)
{
  for (const auto v : mesh.vertices()) {
    const Point& q = mesh.point(v);
    mesh.point(v) = Point(-q.x(), q.y(), q.z());
  }
  CGAL::Polygon_mesh_processing::reverse_face_orientations(mesh);
  return mesh;
}

struct View
{
  Image image; // no sensor is known of it
  Rigid_motion part_from_view;
  Mesh mesh;
  Vector centre = Vector::Zero();
  double spacing;
};

View view_of(const Mesh& mesh, const Kernel::Vector_3& direction)
{
  const CR::Simulated_scene scene(mesh);
  auto camera = CR::Range_camera<Kernel>::framing(CGAL::Polygon_mesh_processing::bbox(mesh), direction, 90, true);
  camera.noise = 0.1;
  const auto seen = scene.range_image(camera);
  View view{seen.image, to_rigid_motion(seen.scene_from_scan), {}, Vector::Zero(), camera.spacing};
  CR::triangulate_range_image(view.image, view.mesh);
  for (const Point& q : view.image.points()) view.centre += to_vector(q) / double(view.image.points().size());
  return view;
}

bool is_right(const Result& result, const View& view)
{
  const Rigid_motion found = to_rigid_motion(result.transformation());
  const Matrix left = found.rotation * view.part_from_view.rotation.transpose();
  return (left - Matrix::Identity()).norm() < 0.05 &&
         (found(view.centre) - view.part_from_view(view.centre)).norm() < 2 * view.spacing;
}

bool is_body(const Flat_mesh& mesh)
{
  return CR::internal::encloses_a_body(mesh, Matrix::Identity());
}

// A prism of square ends, as triangles with corners of their own; the ends are the last four.
Flat_mesh box()
{
  Flat_mesh mesh;
  const auto corner = [](int i) { return Vector(i & 1, 2 * (i >> 1 & 1), 3 * (i >> 2 & 1)); };
  const int quads[6][4] = {{0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& q : quads)
    for (const auto& t : {std::array<int, 3>{q[0], q[1], q[2]}, std::array<int, 3>{q[0], q[2], q[3]}}) {
      const auto n = std::int32_t(mesh.points.size());
      for (const int k : t) mesh.points.push_back(corner(k));
      mesh.faces.push_back({n, n + 1, n + 2});
    }
  return mesh;
}

// A dish of forty sides with a rim, along its profile from the middle of the bottom to that of the inside; `around`:
// points a side; `along`: the largest step along the profile, `first`: the corner of the profile it begins at. All
// points lie on the forty-sided dish.
Flat_mesh dish(int around, double along, std::size_t first)
{
  constexpr int sides = 40;
  const std::vector<std::array<double, 2>> corners = {{0, 0}, {1, 0}, {1, 0.45}, {0.75, 0.45}, {0.75, 0.37}, {0, 0.37}};
  std::vector<std::array<double, 2>> profile;
  for (std::size_t k = first; k + 1 < corners.size(); ++k) {
    const auto &a = corners[k], &b = corners[k + 1];
    const auto steps = int(std::ceil(std::hypot(b[0] - a[0], b[1] - a[1]) / along));
    for (int i = 0; i < steps; ++i) {
      const double t = double(i) / steps;
      profile.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])});
    }
  }
  profile.push_back(corners.back());
  Flat_mesh mesh;
  const auto n = std::int32_t(sides * around);
  for (const auto& [radius, height] : profile)
    for (std::int32_t k = 0; k < n; ++k) {
      const auto corner = [](int side) {
        const double angle = 2 * CGAL_PI * side / sides;
        return Vector(std::cos(angle), std::sin(angle), 0);
      };
      const double t = double(k % around) / around;
      const Vector at = (1 - t) * corner(k / around) + t * corner(k / around + 1);
      mesh.points.push_back(radius * at + Vector(0, 0, height));
    }
  for (std::int32_t row = 0; row + 1 < std::int32_t(profile.size()); ++row)
    for (std::int32_t k = 0; k < n; ++k) {
      const std::int32_t a = row * n + k, b = row * n + (k + 1) % n, c = a + n, d = b + n;
      if (profile[std::size_t(row)][0] > 0) mesh.faces.push_back({a, b, c});
      if (profile[std::size_t(row) + 1][0] > 0) mesh.faces.push_back({b, d, c});
    }
  return mesh;
}

} // namespace

BOOST_AUTO_TEST_CASE(what_is_a_body)
{
  const Flat_mesh closed = box();
  BOOST_TEST(is_body(closed));
  for (unsigned seed = 1; seed <= 5; ++seed) {
    generated::Random random(seed);
    BOOST_TEST(is_body(generated::moved(closed, random.motion(10), 0.01)));
  }
  // Without one of the ends, without both, without one triangle.
  for (const std::size_t faces : {11u, 10u, 8u}) {
    Flat_mesh open = closed;
    open.faces.resize(faces);
    BOOST_TEST(!is_body(open), faces);
  }
  // A corner on an edge of a face that has none there.
  Flat_mesh split = closed;
  const auto f = split.faces.front();
  const auto n = std::int32_t(split.points.size());
  split.points.push_back((split.points[std::size_t(f[0])] + split.points[std::size_t(f[1])]) / 2);
  split.faces.front() = {f[0], n, f[2]};
  split.faces.push_back({n, f[1], f[2]});
  BOOST_TEST(is_body(split));
  // Two that reach into each other; one, and an open one in it.
  Flat_mesh two = closed;
  for (const Vector& q : closed.points) two.points.push_back(Vector(q + Vector(0.3, 0.4, 0.5)));
  const auto m = std::int32_t(closed.points.size());
  for (const auto& g : closed.faces) two.faces.push_back({g[0] + m, g[1] + m, g[2] + m});
  BOOST_TEST(is_body(two));
  two.faces.resize(two.faces.size() - 3);
  BOOST_TEST(!is_body(two));
  BOOST_TEST(is_body(generated::torus(40, 20, 1, 0.3)));
  BOOST_TEST(!is_body(generated::bumps(20)));
  BOOST_TEST(!is_body({}));
}

// What is told of a scan: no view is a body, nor points, nor what a sensor saw.
BOOST_AUTO_TEST_CASE(bodies_among_scans)
{
  const Mesh mesh = part("stairs");
  BOOST_TEST(Scan(mesh).reduced().is_body);
  BOOST_TEST(!Scan(mesh, p::viewpoint(Point(0, 0, 10))).reduced().is_body);
  const View view = view_of(mesh, Kernel::Vector_3(1, 2, -3));
  BOOST_TEST(!Scan(view.mesh).reduced().is_body);
  BOOST_TEST(!Scan(view.image.points()).reduced().is_body);
}

// All are planes, of which each fits many: the motion is known by what of the view lies on the model.
BOOST_AUTO_TEST_CASE(views_that_tell_the_motion)
{
  const Kernel::Vector_3 directions[] = {{1, 2, -3}, {-3, -1, -2}};
  for (const char* name : {"angle", "stairs", "plate of three holes"}) {
    const Mesh mesh = part(name);
    const Scan model(mesh);
    for (const auto& direction : directions) {
      const View view = view_of(mesh, direction);
      for (const bool is_mesh : {true, false}) {
        const Scan scan = is_mesh ? Scan(view.mesh) : Scan(view.image.points());
        const Result result = CR::register_scans(scan, model);
        check_sound(result);
        BOOST_TEST(is_right(result, view), name << ", " << direction);
        // Surfels of plain points are off at edges, as no one knows on which side of these a point is.
        const auto least = is_mesh ? CR::REGISTERED : CR::AMBIGUOUS;
        BOOST_TEST((result.status() == CR::REGISTERED || result.status() == least),
                   name << ", " << direction << ": " << result.confidence() << ", " << result.reason());
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(the_model_may_be_the_source)
{
  const Mesh mesh = part("stairs");
  const View view = view_of(mesh, Kernel::Vector_3(1, 2, -3));
  const Result result = CR::register_scans(Scan(mesh), Scan(view.mesh));
  BOOST_TEST(result.status() == CR::REGISTERED, result.reason());
  const Rigid_motion back = to_rigid_motion(result.transformation()).inverse();
  BOOST_TEST((back.rotation - view.part_from_view.rotation).norm() < 0.05);
}

// At sharp edges, too, whose surfels are off the surface: under the true motion no probe is off the body, and under one
// of three that are off by a twenty-fifth of its size, along an axis each, at least one in fifty is.
BOOST_AUTO_TEST_CASE(right_motions_leave_no_probe_off_the_body)
{
  const Kernel::Vector_3 directions[] = {{1, 2, -3}, {-3, -1, -2}, {2, -2, -1}};
  for (const char* name : {"angle", "stairs", "pentagon", "wedge"}) {
    const Mesh mesh = part(name);
    const Scan model(mesh);
    const CR::internal::Reduced_scan& body = model.reduced();
    for (const auto& direction : directions) {
      const View view = view_of(mesh, direction);
      for (const bool is_mesh : {true, false}) {
        const Scan scan = is_mesh ? Scan(view.mesh) : Scan(view.image.points());
        const CR::internal::Reduced_scan& seen = scan.reduced();
        const auto tolerance = CR::internal::probe_tolerance(seen.fine, body.fine, 0);
        const auto probes = CR::internal::neighbouring_probes(seen.fine, 1500);
        const Rigid_motion truth = body.own_from_input * view.part_from_view * seen.own_from_input.inverse();
        const auto share_off = [&](const Rigid_motion& motion) {
          return CR::internal::share_off_body(probes, body.fine, CR::internal::to_pose(motion), tolerance);
        };
        // Triangles reach over steps that a view shows, and what is there is off; of points there are none.
        BOOST_TEST(share_off(truth) <= (is_mesh ? 0.01 : 0),
                   name << ", " << direction << (is_mesh ? ", mesh: " : ", points: ")
                        << share_off(truth) * double(probes.size()) << " probes");
        // Along one axis at least: planes slide along themselves.
        double most = 0;
        for (int k = 0; k < 3; ++k) {
          Rigid_motion off = truth;
          off.translation += body.extent / 25 * Vector::Unit(k);
          most = (std::max)(most, share_off(off));
        }
        BOOST_TEST(most > 0.02, name << ", " << direction << ": " << most);
      }
    }
  }
}

// Nothing of another body is believed, nor of the mirror image.
BOOST_AUTO_TEST_CASE(views_of_other_bodies)
{
  const std::vector<const char*> names = {"angle", "stairs", "plate of three holes", "bracket"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const View view = view_of(part(names[i]), Kernel::Vector_3(1, 2, -3));
    const Scan scan(view.mesh);
    const Result foreign = CR::register_scans(scan, Scan(part(names[(i + 1) % names.size()])));
    BOOST_TEST(foreign.status() != CR::REGISTERED, names[i] << ": " << foreign.confidence());
    if (names[i] != std::string("bracket")) continue; // prisms are their own mirror images
    const Result mirrored = CR::register_scans(scan, Scan(in_a_mirror(part(names[i]))));
    BOOST_TEST(mirrored.status() != CR::REGISTERED, names[i] << " in a mirror: " << mirrored.confidence());
  }
}

// What a body's symmetry leaves open stays open.
BOOST_AUTO_TEST_CASE(views_of_symmetric_bodies)
{
  for (const char* name : {"block", "cross", "hexagon", "plate of four holes"}) {
    const Mesh mesh = part(name);
    const View view = view_of(mesh, Kernel::Vector_3(1, 2, -3));
    const Result result = CR::register_scans(Scan(view.mesh), Scan(mesh));
    check_sound(result);
    BOOST_TEST(result.status() == CR::AMBIGUOUS, name << ": " << result.confidence() << ", " << result.reason());
  }
}

// Along edges surfels lie beneath the surface, on the one side of a view that has only upper edges, and of a plate seen
// from above nearly all directions of the normal are those of edges.
BOOST_AUTO_TEST_CASE(edges_do_not_pull_a_view_off_its_model)
{
  const Flat_mesh coarse = dish(1, 10, 0), seen = dish(10, 0.02, 2);
  BOOST_TEST(is_body(coarse));
  for (unsigned seed = 1; seed <= 3; ++seed) {
    generated::Random random(seed);
    const Rigid_motion view_from_dish = random.motion(3);
    const Scan view(mesh_of<Mesh>(generated::moved(seen, view_from_dish))), model(mesh_of<Mesh>(coarse));
    const Result result = CR::register_scans(view, model);
    BOOST_TEST(result.status() == CR::AMBIGUOUS, result.confidence() << ", " << result.reason());
    BOOST_TEST_REQUIRE(result.free_motions().size() == 1u);
    BOOST_TEST(result.free_motions().front().find("rotation about") == 0u, result.free_motions().front());
    // Refinement leaves the true motion where it is, to within a part of the least tolerance of probes, 0.05 spacings.
    const CR::internal::Reduced_scan &a = view.reduced(), &b = model.reduced();
    const Rigid_motion own_b_from_a = b.own_from_input * view_from_dish.inverse() * a.own_from_input.inverse();
    const Vector up = (b.own_from_input.rotation * Vector::UnitZ()).normalized();
    for (const bool swapped : {false, true}) {
      const CR::internal::Pose_judge judge(swapped ? b : a, swapped ? a : b, CR::internal::Execution::SEQUENTIAL,
                                           CR::internal::to_the_end());
      const Rigid_motion truth = swapped ? own_b_from_a.inverse() : own_b_from_a,
                         end = to_rigid_motion(judge.refined(CR::internal::to_pose(truth))),
                         left = swapped ? end.inverse() * truth : end * truth.inverse();
      const double spacing = (std::max)(a.fine.spacing, b.fine.spacing);
      BOOST_TEST(std::abs(up.dot(left(Vector(Vector::Zero())))) < 0.02 * spacing,
                 up.dot(left(Vector(Vector::Zero()))) / spacing << " spacings" << (swapped ? ", swapped" : ""));
    }
  }
}
