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

#ifndef CGAL_CRUDE_REGISTRATION_IO_APPLY_MOTION_H
#define CGAL_CRUDE_REGISTRATION_IO_APPLY_MOTION_H

// Writes the file of a scan anew, moved.

#include <CGAL/Crude_registration/IO/IO_error.h>
#include <CGAL/Crude_registration/IO/internal/move_file.h>
#include <CGAL/Crude_registration/IO/write_file.h>
#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>

#include <CGAL/Aff_transformation_3.h>

#include <Eigen/LU>

#include <cmath>
#include <ios>
#include <ostream>
#include <stdexcept>
#include <string>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// \throws std::invalid_argument if it is not one, up to the rounding of six digits
inline Similarity to_similarity(const Rigid_motion& affine)
{
  Similarity s;
  s.motion.translation = affine.translation;
  s.scale = std::cbrt(affine.rotation.determinant());
  if (s.scale > 0) s.motion.rotation = affine.rotation / s.scale;
  // the scale that the motion of a registration has by rounding is none
  if (std::abs(s.scale - 1) < 1e-9) {
    s.scale = 1;
    s.motion.rotation = affine.rotation;
  }
  const Matrix& r = s.motion.rotation;
  if (!(s.scale > 0 && std::isfinite(s.scale) && affine.translation.allFinite() &&
        (r * r.transpose()).isIdentity(1e-6)))
    throw std::invalid_argument("apply_motion: motion is neither a rigid motion nor one with a scaling");
  return s;
}

} // namespace internal

/*!
\ingroup PkgCrudeRegistrationRef

\brief writes the file of a scan anew, moved: in the format of the file, with all that is in it. Coordinates are moved
and normals are turned; all else stays as it is, byte by byte: colours, intensities, texture coordinates, faces,
comments, separators.

What `read_scan()` reads is written, but for depth images, LAS, glTF, GOCAD and VTP files and those whose coordinates
are whole numbers. Normals are those that `read_scan()` finds, and those of OBJ (`vn`), OFF and STL. What the file says
of its sensor is moved, too: `obj_info` of PLY, `VIEWPOINT` of PCD if it is set, or if it is that of a range image. In
PTX files that is all, as their samples are in the scanner's frame; `FILE.ptx#2` is written without the other scans of
the file.

Floats stay floats, doubles doubles; text has the shortest numbers that are read back the same, as doubles where it does
not say `float`. Samples that are missing (see `Scan_file`) stay as they are. The file is written whole or not at all;
it is packed by gzip if its name ends in `.gz`.

\tparam Kernel a model of `Kernel`
\param input the name of the file
\param output the name of the file to be written, which may be the same
\param motion a rigid motion, which may have a scaling: of one unit of length to another

\return the largest difference of a coordinate that is written and the one it was moved to, by the rounding of floats;
zero for doubles

\throws IO_error if the file cannot be read, moved or written
\throws std::invalid_argument if the motion is neither rigid nor a similarity that keeps orientation

\sa `check_motion_can_be_applied()`
*/
template <class Kernel>
double apply_motion(const std::string& input, const std::string& output, const Aff_transformation_3<Kernel>& motion)
{
  const std::string end = ".gz";
  const bool packed = output.size() >= end.size() && output.compare(output.size() - end.size(), end.size(), end) == 0;
  const internal::Similarity similarity = internal::to_similarity(internal::to_rigid_motion(motion));
  const internal::Moved_file moved = internal::moved_file(input, similarity, packed);
  write_file(output,
             [&](std::ostream& out) { out.write(moved.data.data(), static_cast<std::streamsize>(moved.data.size())); });
  return moved.rounding;
}

/*!
\ingroup PkgCrudeRegistrationRef

\brief checks, before the work whose motion is to be applied, whether `apply_motion()` can write the file anew, as far
as its name and its head say.

\throws IO_error if it cannot, or if the file cannot be read
*/
inline void check_motion_can_be_applied(const std::string& input)
{
  internal::check_file_can_be_moved(input);
}

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_APPLY_MOTION_H
