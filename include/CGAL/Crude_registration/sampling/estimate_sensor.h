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

#ifndef CGAL_CRUDE_REGISTRATION_SAMPLING_ESTIMATE_SENSOR_H
#define CGAL_CRUDE_REGISTRATION_SAMPLING_ESTIMATE_SENSOR_H

// Recovers the sensor of a range image from its grid.

#include <CGAL/Crude_registration/Range_image.h>
#include <CGAL/Crude_registration/Sensor.h>
#include <CGAL/Crude_registration/internal/sampling/Flat_range_image.h>
#include <CGAL/Crude_registration/internal/sampling/estimate_flat_sensor.h>

namespace CGAL {
namespace Crude_registration {

/*!
\ingroup PkgCrudeRegistrationRef

\brief recovers the sensor of a range image from its grid: the lines of sight are the lines on which column and row are
constant.

The result is
- perspective, if a camera (a projective map from points to columns and rows) explains the grid clearly better than
  parallel lines of sight do;
- orthographic, if parallel lines explain the grid, in the direction that the lines have at the centroid. This covers
  scanners that move a laser stripe, whose lines are parallel in one axis and meet in the other. Which end of the lines
  is the sensor's is decided by, in this order: the side on which columns or rows converge; the side from which the
  surface recedes where it ends in the image; that of columns x rows;
- unknown, if neither explains the grid (a scan around a full turn), or if the samples are too few (fewer than 24) or
lie in a plane.

The handedness of columns and rows, the frame and the unit of the points have no influence (handedness only as the last
resort above). The sensor that `image` may have is not looked at.

\tparam Kernel a model of `Kernel`
\param image a range image
\return the sensor, in the frame of the points

Complexity: linear in the number of cells.
*/
template <class Kernel>
Sensor<Kernel> estimate_sensor(const Range_image<Kernel>& image)
{
  return internal::to_sensor<Kernel>(internal::estimated_sensor(internal::Flat_range_image(image)));
}

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_SAMPLING_ESTIMATE_SENSOR_H
