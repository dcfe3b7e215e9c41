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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_FLAT_SENSOR_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_FLAT_SENSOR_H

// From where a scan was seen, as the stages have it; the parameters `viewpoint` and `viewing_direction` that say so.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/named_parameters.h>

#include <stdexcept>
#include <string>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// v / |v|, and the zero vector for v = 0; no squared length over- or underflows.
inline Vector unit_or_zero(const Vector& v)
{
  const double largest = v.cwiseAbs().maxCoeff();
  if (!(largest > 0)) return Vector::Zero();
  const Vector scaled = v / largest;
  return scaled / scaled.norm();
}

// The sensor of a stage's inside.
struct Flat_sensor
{
  enum Kind
  {
    UNKNOWN,
    ORTHOGRAPHIC,
    PERSPECTIVE
  };

  Kind kind = UNKNOWN;
  Vector vector = Vector::Zero(); // orthographic: unit viewing direction, into the scene; perspective: viewpoint

  // of any length, from the sensor to p; the sensor is known
  Vector towards(const Vector& p) const { return kind == ORTHOGRAPHIC ? vector : Vector(p - vector); }
};

// The sensor that the parameters `viewpoint` and `viewing_direction` give, or an unknown one. `function` names the
// caller in the text of what is thrown: std::invalid_argument where both are given, or one that says nothing.
template <class NamedParameters>
Flat_sensor sensor_parameter([[maybe_unused]] const NamedParameters& np, [[maybe_unused]] const std::string& function)
{
  constexpr bool has_viewpoint = is_given<NamedParameters, internal_np::viewpoint_t>;
  constexpr bool has_direction = is_given<NamedParameters, internal_np::viewing_direction_t>;
  Flat_sensor sensor;
  if constexpr (has_viewpoint && has_direction)
    throw std::invalid_argument(function + ": both viewpoint and viewing_direction are given");
  else if constexpr (has_viewpoint) {
    sensor = {Flat_sensor::PERSPECTIVE, to_vector(parameter(np, internal_np::viewpoint, 0))};
    if (!sensor.vector.allFinite()) throw std::invalid_argument(function + ": viewpoint is not finite");
  } else if constexpr (has_direction) {
    sensor = {Flat_sensor::ORTHOGRAPHIC, unit_or_zero(to_vector(parameter(np, internal_np::viewing_direction, 0)))};
    if (!sensor.vector.allFinite() || sensor.vector.isZero())
      throw std::invalid_argument(function + ": viewing_direction is null or not finite");
  }
  return sensor;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_FLAT_SENSOR_H
