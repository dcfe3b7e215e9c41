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

#ifndef CGAL_CRUDE_REGISTRATION_SENSOR_H
#define CGAL_CRUDE_REGISTRATION_SENSOR_H

// From where a scan was seen.

#include <CGAL/Crude_registration/internal/base/Flat_sensor.h>

#include <CGAL/Aff_transformation_3.h>
#include <CGAL/number_utils.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace CGAL {
namespace Crude_registration {

/*!
\ingroup PkgCrudeRegistrationRef

\brief says from where a range scan was seen, in the frame of the scan's points.

A sensor is
- *unknown*, the default;
- *orthographic*: all lines of sight are parallel, and only their direction is known;
- *perspective*: all lines of sight start at one viewpoint.

\tparam Kernel a model of `Kernel`; lengths are normalised in `double`.
*/
template <class Kernel>
class Sensor
{
public:
  /// \name Types
  /// @{
  typedef typename Kernel::Point_3 Point_3;
  typedef typename Kernel::Vector_3 Vector_3;
  typedef typename Kernel::Aff_transformation_3 Aff_transformation_3;
  /// @}

  /// the unknown sensor.
  Sensor() = default;

  /// an orthographic sensor; `viewing_direction` points from the sensor into the scene and need not have length 1.
  /// \throws std::invalid_argument if `viewing_direction` is null or not finite.
  static Sensor orthographic(const Vector_3& viewing_direction)
  {
    Sensor s;
    s.m_kind = ORTHOGRAPHIC;
    s.m_direction = unit(viewing_direction);
    if (s.m_direction == CGAL::NULL_VECTOR)
      throw std::invalid_argument("Sensor::orthographic: viewing_direction is null or not finite");
    return s;
  }

  /// a perspective sensor.
  /// \throws std::invalid_argument if `viewpoint` is not finite.
  static Sensor perspective(const Point_3& viewpoint)
  {
    for (int i = 0; i < 3; ++i)
      if (!std::isfinite(CGAL::to_double(viewpoint[i])))
        throw std::invalid_argument("Sensor::perspective: viewpoint is not finite");
    Sensor s;
    s.m_kind = PERSPECTIVE;
    s.m_viewpoint = viewpoint;
    return s;
  }

  /// \name Access
  /// @{
  bool is_known() const { return m_kind != UNKNOWN; }
  bool is_orthographic() const { return m_kind == ORTHOGRAPHIC; }
  bool is_perspective() const { return m_kind == PERSPECTIVE; }

  /// the viewpoint of a perspective sensor.
  /// \throws std::invalid_argument if the sensor is not perspective.
  const Point_3& viewpoint() const
  {
    if (!is_perspective()) throw std::invalid_argument("Sensor::viewpoint: the sensor is not perspective");
    return m_viewpoint;
  }

  /// the direction of all lines of sight of an orthographic sensor, from the sensor into the scene, of length 1.
  /// \throws std::invalid_argument if the sensor is not orthographic.
  const Vector_3& viewing_direction() const
  {
    if (!is_orthographic()) throw std::invalid_argument("Sensor::viewing_direction: the sensor is not orthographic");
    return m_direction;
  }

  /// the direction of the line of sight that ends at `p`, from the sensor to `p`, of length 1; null where `p` is the
  /// viewpoint.
  /// \throws std::invalid_argument if the sensor is unknown.
  Vector_3 line_of_sight(const Point_3& p) const
  {
    if (!is_known()) throw std::invalid_argument("Sensor::line_of_sight: the sensor is unknown");
    return is_orthographic() ? m_direction : unit(p - m_viewpoint);
  }
  /// @}

  /// the sensor of the scan whose points are moved by `motion`, a rigid motion (not checked).
  Sensor transformed(const Aff_transformation_3& motion) const
  {
    if (is_orthographic()) return orthographic(m_direction.transform(motion));
    if (is_perspective()) return perspective(m_viewpoint.transform(motion));
    return Sensor();
  }

private:
  static Vector_3 unit(const Vector_3& v)
  {
    const internal::Vector d = internal::unit_or_zero(internal::to_vector(v));
    return d.allFinite() ? Vector_3(d.x(), d.y(), d.z()) : Vector_3(CGAL::NULL_VECTOR);
  }

  enum Kind
  {
    UNKNOWN,
    ORTHOGRAPHIC,
    PERSPECTIVE
  };
  Kind m_kind = UNKNOWN;
  Point_3 m_viewpoint = CGAL::ORIGIN;
  Vector_3 m_direction = CGAL::NULL_VECTOR;
};

namespace internal {

template <class Kernel>
Flat_sensor to_flat_sensor(const Sensor<Kernel>& sensor)
{
  Flat_sensor s;
  if (sensor.is_orthographic()) s = {Flat_sensor::ORTHOGRAPHIC, to_vector(sensor.viewing_direction())};
  if (sensor.is_perspective()) s = {Flat_sensor::PERSPECTIVE, to_vector(sensor.viewpoint())};
  return s;
}

// The sensor that the parameters give, or else the other one.
template <class NamedParameters, class Kernel>
Flat_sensor sensor_parameter(const NamedParameters& np, const std::string& function, const Sensor<Kernel>& other)
{
  const Flat_sensor given = sensor_parameter(np, function);
  return given.kind == Flat_sensor::UNKNOWN ? to_flat_sensor(other) : given;
}

template <class Kernel>
Sensor<Kernel> to_sensor(const Flat_sensor& s)
{
  const Vector& v = s.vector;
  if (s.kind == Flat_sensor::ORTHOGRAPHIC)
    return Sensor<Kernel>::orthographic(typename Kernel::Vector_3(v.x(), v.y(), v.z()));
  if (s.kind == Flat_sensor::PERSPECTIVE)
    return Sensor<Kernel>::perspective(typename Kernel::Point_3(v.x(), v.y(), v.z()));
  return Sensor<Kernel>();
}

} // namespace internal

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_SENSOR_H
