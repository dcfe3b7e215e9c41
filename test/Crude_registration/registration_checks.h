// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_TEST_REGISTRATION_CHECKS_H
#define CGAL_CRUDE_REGISTRATION_TEST_REGISTRATION_CHECKS_H

// What the tests of registration share: the names of the types, and what holds of every answer.

#include "generated_surfaces.h"
#include "matrix_of.h"
#include "mesh_of.h"

#include <CGAL/Crude_registration/register_meshes.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <vector>

namespace CR = CGAL::Crude_registration;
namespace p = CR::parameters;
using CR::internal::Flat_mesh;
using CR::internal::Matrix;
using CR::internal::Rigid_motion;
using CR::internal::to_rigid_motion;
using CR::internal::to_vector;
using CR::internal::Vector;
using generated::pi;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Scan = CR::Scan<Kernel>;
using Result = CR::Registration_result<Kernel>;
using Image = CR::Range_image<Kernel>;
using Sensor = CR::Sensor<Kernel>;

inline Mesh mesh_of(const Flat_mesh& flat)
{
  return mesh_of<Mesh>(flat);
}

// x -> motion(unit * x).
inline Image moved(const Image& image, const Rigid_motion& motion, double unit = 1)
{
  const auto to_point = [](const Vector& v) { return Point(v.x(), v.y(), v.z()); };
  std::vector<Point> points;
  for (const Point& q : image.points()) points.push_back(to_point(motion(unit * to_vector(q))));
  Image result(image.columns(), image.rows(), points, image.grid());
  const Sensor& sensor = image.sensor();
  if (sensor.is_perspective())
    result.set_sensor(Sensor::perspective(to_point(motion(unit * to_vector(sensor.viewpoint())))));
  if (sensor.is_orthographic()) {
    const auto d = sensor.viewing_direction();
    const Vector turned = motion.rotation * Vector(d.x(), d.y(), d.z());
    result.set_sensor(Sensor::orthographic(Kernel::Vector_3(turned.x(), turned.y(), turned.z())));
  }
  return result;
}

// In degrees.
inline double angle_between(const Rigid_motion& a, const Rigid_motion& b)
{
  return Eigen::AngleAxisd(a.rotation * b.rotation.transpose()).angle() * 180 / pi;
}

inline Matrix_6 covariance_of(const Result& result)
{
  return matrix_of(result.covariance());
}

inline bool is_rigid(const CGAL::Aff_transformation_3<Kernel>& transformation)
{
  const Rigid_motion m = to_rigid_motion(transformation);
  return m.translation.allFinite() && (m.rotation * m.rotation.transpose() - Matrix::Identity()).norm() < 1e-9 &&
         std::abs(m.rotation.determinant() - 1) < 1e-9;
}

// What holds of every answer, to whatever input.
inline void check_sound(const Result& result)
{
  BOOST_TEST(is_rigid(result.transformation()));
  BOOST_TEST(is_rigid(result.crude_transformation()));
  BOOST_TEST(is_rigid(result.inverse_transformation()));
  BOOST_TEST(result.confidence() >= 0);
  BOOST_TEST(result.confidence() <= 1);
  const Matrix_6 covariance = covariance_of(result);
  BOOST_TEST(!covariance.hasNaN(), result.status() << ", " << result.reason());
  BOOST_TEST((result.status() == CR::NOT_REGISTERED || covariance == covariance.transpose()));
  BOOST_TEST(result.free_space_violations() >= 0);
  BOOST_TEST(result.free_space_violations() <= 2);
  BOOST_TEST((result.source_has_free_space() || result.target_has_free_space() || result.free_space_violations() == 0));
  BOOST_TEST(std::isfinite(result.overlap()));
  BOOST_TEST(std::isfinite(result.residual()));
  BOOST_TEST(std::isfinite(result.score()));
  BOOST_TEST((result.status() == CR::REGISTERED) == result.reason().empty());
  for (const auto& other : result.runners_up()) {
    BOOST_TEST(is_rigid(other.transformation));
    BOOST_TEST(std::isfinite(other.score));
  }
}

// ... and to scans of shapes that determine a motion.
inline void check_proper(const Result& result)
{
  check_sound(result);
  BOOST_TEST(covariance_of(result).allFinite());
}

#endif // CGAL_CRUDE_REGISTRATION_TEST_REGISTRATION_CHECKS_H
