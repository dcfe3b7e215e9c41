// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#define BOOST_TEST_MODULE scan_frame
#include <boost/test/unit_test.hpp>

#include "generated_surfaces.h"

#include <CGAL/Crude_registration/internal/reduction/scan_frame.h>

#include <cmath>

using namespace CGAL::Crude_registration::internal;

namespace {

// Coordinates in the scan's own frame have to be those of the moved scan in its own frame.
void check_equivariance(const Flat_mesh& mesh, bool with_direction)
{
  generated::Random random(3);
  const Vector direction = with_direction ? Vector(0.1, -0.2, -0.9) : Vector(0, 0, 0);
  const Rigid_motion own = scan_frame(mesh, direction);
  BOOST_TEST((own.rotation * own.rotation.transpose() - Matrix::Identity()).norm() < 1e-12);
  BOOST_TEST(std::abs(own.rotation.determinant() - 1) < 1e-12);
  for (int i = 0; i < 5; ++i) {
    const Rigid_motion motion = random.motion(100);
    for (const Flat_mesh& moved :
         {generated::moved(mesh, motion), generated::shuffled(generated::moved(mesh, motion), 7)}) {
      const Rigid_motion other = scan_frame(moved, motion.rotation * direction);
      const Rigid_motion difference = (other * motion) * own.inverse();
      BOOST_TEST((difference.rotation - Matrix::Identity()).norm() < 1e-9);
      BOOST_TEST(difference.translation.norm() < 1e-9);
    }
  }
}

} // namespace

BOOST_AUTO_TEST_CASE(frames_move_with_the_scan)
{
  check_equivariance(generated::bumps(20), false);
  check_equivariance(generated::bumps(20), true);
  // Closed, without symmetry: the normals cancel.
  Flat_mesh potato = generated::sphere(8, 1);
  for (Vector& p : potato.points)
    p = Vector(2 * p.x() + 0.5 * p.y() * p.y(), 1.3 * p.y() + 0.2 * p.z() * p.z(), p.z() + 0.3 * p.x() * p.x());
  check_equivariance(potato, false);
}

BOOST_AUTO_TEST_CASE(axes_of_a_rectangle)
{
  // 3 x 1, facing +x, its long side along z.
  const Flat_mesh mesh = generated::grid(10, 10, [](double u, double v) { return Vector(7, u, 3 * v); });
  const Rigid_motion frame = scan_frame(mesh);
  BOOST_TEST((frame.rotation.row(2).transpose() - Vector(1, 0, 0)).norm() < 1e-12);
  BOOST_TEST(std::abs(std::abs(frame.rotation(0, 2)) - 1) < 1e-12);
  BOOST_TEST(frame(Vector(7, 0.5, 1.5)).norm() < 1e-12);
  const Vector extent = extent_in_frame(mesh, frame);
  BOOST_TEST((extent - Vector(3, 1, 0)).norm() < 1e-12);
  // However the rectangle is cut into triangles.
  Flat_mesh two;
  two.points = {Vector(7, 0, 0), Vector(7, 1, 0), Vector(7, 1, 3), Vector(7, 0, 3), Vector(99, 0, 0)};
  two.faces = {{0, 1, 2}, {0, 2, 3}};
  BOOST_TEST(scan_frame(two)(Vector(7, 0.5, 1.5)).norm() < 1e-12);
  BOOST_TEST((extent_in_frame(two, scan_frame(two)) - Vector(3, 1, 0)).norm() < 1e-12);
}

BOOST_AUTO_TEST_CASE(the_depth_axis_is_against_the_viewing_direction)
{
  const Rigid_motion frame = scan_frame(generated::bumps(10), Vector(0, 3, -4));
  BOOST_TEST((frame.rotation.row(2).transpose() - Vector(0, -0.6, 0.8)).norm() < 1e-12);
}

BOOST_AUTO_TEST_CASE(scans_without_area)
{
  Flat_mesh mesh;
  BOOST_TEST(scan_frame(mesh).rotation.allFinite());
  mesh.points.assign(3, Vector(1, 2, 3));
  mesh.faces = {{0, 1, 2}};
  BOOST_TEST(scan_frame(mesh)(Vector(1, 2, 3)).norm() == 0);
  BOOST_TEST(extent_in_frame(mesh, scan_frame(mesh)).norm() == 0);
  BOOST_TEST(median_edge_length(mesh) == 0);
  BOOST_TEST(median_edge_length(Flat_mesh()) == 0);
}

BOOST_AUTO_TEST_CASE(median_edge)
{
  // A right-angled grid of unit cells: two thirds of the edges are sides, one third diagonals.
  const Flat_mesh mesh = generated::grid(
      10, 10, [](double u, double v) { return Vector(10 * u, 10 * v, 0); }, 0);
  BOOST_TEST(median_edge_length(mesh) == 1, boost::test_tools::tolerance(1e-12));
}
