// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Author(s)     : The Crude_registration authors

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_ORIENT_POINTS_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_ORIENT_POINTS_H

// Points as they come, made samples of a surface, each with its normal: without triangles.

#include <CGAL/Crude_registration/internal/base/Flat_sensor.h>
#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/internal/base/Run_control.h>
#include <CGAL/Crude_registration/internal/base/compiled.h>

#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Where the sensor is known, what it sees at such an angle, seven degrees from along the surface, is left out: it may
// be what bridges a depth edge.
constexpr double grazing_cosine = 0.12;

// Samples of a surface, of even density, in the frame of the input.
struct Oriented_points
{
  std::vector<Vector> points;
  std::vector<Vector> normals; // unit
  double area = 0;             // of the surface that they are samples of
  bool is_side_known = true;   // or as likely the other one, of all together
};

inline void turn_over(Oriented_points& samples)
{
  for (Vector& n : samples.normals) n = -n;
}

// Makes samples of points:
// 1. copies are one point, and the density is evened: what is left are the means of the cells of a grid that is laid
//    along the points' own axes, some ten thousand at most;
// 2. the normals are those of the planes that fit neighbourhoods, found at the scale at which they are a surface; what
//    has no such scale is left out;
// 3. the side is the one of the sensor, where that is known (what it sees at a grazing angle is left out); the one of
//    `normals`, unless that is empty, one for each point, null where there is none; or else the one from where the
//    surface is visible: from a place where one is found that could be a sensor's, from outside otherwise.
// Copies of points, all as many times, change no bit; moved or scaled or in another order, the points give the same
// samples but for rounding. Linear. \throws Run_control::Stopped
Oriented_points orient_points(const std::vector<Vector>& points, const std::vector<Vector>& normals,
                              const Flat_sensor& sensor, Run_control& control = to_the_end());

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#ifndef CGAL_CRUDE_REGISTRATION_COMPILED
#include <CGAL/Crude_registration/internal/sampling/orient_points_impl.h>
#endif

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_ORIENT_POINTS_H
