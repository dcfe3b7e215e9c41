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

#ifndef CGAL_CRUDE_REGISTRATION_IO_READ_SCAN_H
#define CGAL_CRUDE_REGISTRATION_IO_READ_SCAN_H

// Reads a scan from a file of any format, whatever it holds.

#include <CGAL/Crude_registration/IO/IO_error.h>
#include <CGAL/Crude_registration/IO/internal/read_flat_scan.h>
#include <CGAL/Crude_registration/IO/internal/to_kernel.h>
#include <CGAL/Crude_registration/Range_image.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {

/*!
\ingroup PkgCrudeRegistrationRef

\brief what `read_scan()` found in a file: a range image, a mesh or points, in the unit and frame of the file. The two
others are empty.

\tparam Kernel a model of `Kernel`
*/
template <class Kernel>
struct Scan_file
{
  typedef typename Kernel::Point_3 Point_3;

  enum Kind
  {
    RANGE_IMAGE,
    MESH,
    POINTS
  };

  Kind kind = POINTS;
  Range_image<Kernel> image;
  CGAL::Surface_mesh<Point_3> mesh;
  std::vector<Point_3> points;
};

/*!
\ingroup PkgCrudeRegistrationRef

\brief reads a range scan from a file, whatever it holds.

The format is told by the first bytes of the file where these are unmistakable (PLY, OFF), else by the end of its name:

- `.ply` with an `element range_grid`: a range image, see `read_range_image()`; with faces: a mesh; else points;
- `.off`, `.obj`, `.stl`, `.ts` and, where the program was built with VTK, `.vtp`: a mesh, or points where there is no
face;
- `.ptx` (one scan): a range image, moved to the world as the file says, with a perspective sensor at the scanner's
place;
- `.las`, `.laz`, where the program was built with LASlib: points;
- any other text (`.xyz`, `.txt`, `.pts`, `.csv`, ...): points, one a line. Words are separated by white space, or by
  commas or semicolons if the first line has them; the first three are x, y and z, what follows is passed over. Lines
  that start with `#` or `//` are comments. The first line may name the columns, three of which are `x`, `y` and `z`; a
line before the points may hold their number alone.

Where a mesh's faces do not form an oriented manifold, faces are turned and vertices are split until they do; faces that
name a vertex twice and vertices without a face are left out.

Numbers are read the same whatever the locale of the program is.

\tparam Kernel a model of `Kernel`
\param filename the name of the file

\throws IO_error if the file cannot be opened, does not parse, or has no points; `IO_error::line()` says where, if it is
a text of a format that CGAL does not read for us (`.ts`, `.vtp`, `.las`).
*/
template <class Kernel>
Scan_file<Kernel> read_scan(const std::string& filename)
{
  internal::Flat_scan_file flat = internal::read_flat_scan(filename);
  Scan_file<Kernel> scan;
  switch (flat.kind) {
  case internal::Flat_scan_file::RANGE_IMAGE:
    scan.kind = Scan_file<Kernel>::RANGE_IMAGE;
    scan.image = internal::to_range_image<Kernel>(std::move(flat), filename);
    break;
  case internal::Flat_scan_file::MESH:
    scan.kind = Scan_file<Kernel>::MESH;
    internal::add_polygons(flat, scan.mesh);
    break;
  case internal::Flat_scan_file::POINTS:
    scan.points = internal::to_points<Kernel>(flat.points);
  }
  return scan;
}

#ifdef CGAL_CRUDE_REGISTRATION_COMPILED
// The kernel that most programs use is compiled with the core.
extern template Scan_file<Exact_predicates_inexact_constructions_kernel>
read_scan<Exact_predicates_inexact_constructions_kernel>(const std::string&);
#endif

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_READ_SCAN_H
