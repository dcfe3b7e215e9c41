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

#ifndef CGAL_CRUDE_REGISTRATION_IO_DEPTH_CAMERA_H
#define CGAL_CRUDE_REGISTRATION_IO_DEPTH_CAMERA_H

// The camera of a depth image.

namespace CGAL {
namespace Crude_registration {

/*!
\ingroup PkgCrudeRegistrationRef

\brief what makes points of a depth image: the value \f$ d \f$ in column \f$ u \f$ and row \f$ v \f$, counted from
\f$ 0 \f$, is the point \f$ ((u - c_x) z / f_x, (v - c_y) z / f_y, z) \f$ with \f$ z = d / \f$ `scale`, in the frame of
the camera, which looks along \f$ z \f$.

The default is a camera that is not known, by which no depth image is read.
*/
struct Depth_camera
{
  /// the focal lengths, in pixels.
  double fx = 0, fy = 0;
  /// the image of the optical axis, in pixels.
  double cx = 0, cy = 0;
  /// how many units of depth there are to the unit of length: 1000 where a value is in millimetres and points shall be
  /// in metres, 5000 in the benchmarks of the Technical University of Munich (TUM).
  double scale = 0;
};

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_DEPTH_CAMERA_H
