// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_BENCHMARK_RESULT_TOOLS_H
#define CGAL_CRUDE_REGISTRATION_BENCHMARK_RESULT_TOOLS_H

// What the benchmarks read from motions and from the answers of registrations.

#include <CGAL/Crude_registration/Registration_result.h>

#include <CGAL/Aff_transformation_3.h>
#include <CGAL/number_utils.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <string>

namespace benchmark_tools {

template <class Kernel>
Eigen::Matrix3d rotation(const CGAL::Aff_transformation_3<Kernel>& motion)
{
  Eigen::Matrix3d r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) r(i, j) = CGAL::to_double(motion.m(i, j));
  return r;
}

template <class Kernel>
Eigen::Vector3d translation(const CGAL::Aff_transformation_3<Kernel>& motion)
{
  return {CGAL::to_double(motion.m(0, 3)), CGAL::to_double(motion.m(1, 3)), CGAL::to_double(motion.m(2, 3))};
}

// x -> rotation x + translation
template <class Kernel, class Rotation, class Translation>
CGAL::Aff_transformation_3<Kernel> to_motion(const Rotation& r, const Translation& t)
{
  return {r(0, 0), r(0, 1), r(0, 2), t[0], r(1, 0), r(1, 1), r(1, 2), t[1], r(2, 0), r(2, 1), r(2, 2), t[2]};
}

// The angle of the rotation that is left over between two.
inline double degrees_between(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b)
{
  return Eigen::AngleAxisd(Eigen::Matrix3d(a * b.transpose())).angle() * 180 / CGAL_PI;
}

template <class Kernel>
double degrees_between(const CGAL::Aff_transformation_3<Kernel>& a, const CGAL::Aff_transformation_3<Kernel>& b)
{
  return degrees_between(rotation(a), rotation(b));
}

// A stage of a registration by its name; one that did nothing where there is none of that name.
template <class Kernel>
typename CGAL::Crude_registration::Registration_result<Kernel>::Stage
stage(const CGAL::Crude_registration::Registration_result<Kernel>& result, const std::string& name)
{
  for (const auto& s : result.statistics())
    if (s.name == name) return s;
  return {name, 0, 0};
}

} // namespace benchmark_tools

#endif // CGAL_CRUDE_REGISTRATION_BENCHMARK_RESULT_TOOLS_H
