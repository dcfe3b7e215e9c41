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

#include <CGAL/Crude_registration/IO/Depth_camera.h>
#include <CGAL/Crude_registration/IO/IO_error.h>
#include <CGAL/Crude_registration/IO/internal/read_flat_scan.h>
#include <CGAL/Crude_registration/IO/internal/to_kernel.h>
#include <CGAL/Crude_registration/Range_image.h>
#include <CGAL/Crude_registration/Sensor.h>

#include <CGAL/IO/Color.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {

/*!
\ingroup PkgCrudeRegistrationRef

\brief what `read_scan()` found in a file: a range image, a mesh or points, in the unit and frame of the file. The two
others are empty.

A point that is NaN or infinite, or that is (0, 0, 0) in a range image whose format writes so where the sensor saw
nothing, is a missing sample: it is counted and left out, with the faces that name it. So is (0, 0, 0) among points
where it stands more than once and outside the box of the others.

\tparam Kernel a model of `Kernel`
*/
template <class Kernel>
struct Scan_file
{
  typedef typename Kernel::Point_3 Point_3;
  typedef typename Kernel::Vector_3 Vector_3;

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

  /// the normals that the file has for its points or for the samples of its range image, in their order: of length 1,
  /// or null where there is none for a point. Empty where the file has no normals, and for meshes.
  std::vector<Vector_3> normals;

  /// the colours that the file has for its points, for the samples of its range image or for the vertices of its mesh,
  /// in their order. Empty where the file has none.
  std::vector<CGAL::IO::Color> colors;

  /// what the file says of the sensor that saw its points or its mesh; a range image has its own.
  Sensor<Kernel> sensor;

  /// how many points of the file are missing samples.
  std::size_t missing = 0;

  /// sentences on how the file was understood, where it could have been otherwise.
  std::vector<std::string> notes;
};

/*!
\ingroup PkgCrudeRegistrationRef

\brief reads a range scan from a file, whatever it holds.

The format is told by the first bytes of the file where these are unmistakable (PLY, OFF, PCD, NPY, PNG, LAS, binary
glTF), else by
the end of its name:

- `.ply` with an `element range_grid`: a range image, see `read_range_image()`; with faces: a mesh; else points; the
  `obj_info` of a sensor is read for all of them;
- `.off`, `.obj`, `.stl`, `.ts` and, where the program was built with VTK, `.vtp`: a mesh, or points where there is no
face;
- `.glb` and `.gltf` (glTF 2.0), where the program was built with nlohmann-json: the triangles that the nodes of the
  scene place, as one mesh, in which vertices that are equal are one; or points where there is no triangle. What is
  compressed (Draco, meshopt) or sparse is not read;
- `.ptx`: a range image, moved to the world as the file says, with a perspective sensor at the scanner's place. Of
several scans in a file, `FILE.ptx#2` is the second one's name;
- `.pcd` (ascii, binary and binary_compressed): a range image where the points are organised, else points. The sensor is
  the viewpoint of the file; where this is the one that is written if there is none, 0 0 0, that of a range image is the
  one that its grid tells, or the origin where the grid does not tell it, or tells one nearer to the origin than to any
  sample;
- NumPy's `.npy` of `f4` or `f8`: points for an array of n x 3 or more numbers, a range image for one of rows x columns
x 3;
- `.png` of one channel of 16 bits, where the program was built with libpng: a depth image, which is a range image with
  the sensor at the origin, by the parameter `camera`;
- `.las` (1.0 to 1.4, not compressed): points, in double as scale and offset give them;
- any other text (`.xyz`, `.txt`, `.asc`, `.pts`, `.csv`, ...): points, one a line. Words are separated by white space,
  or by semicolons or commas if the first line of numbers has them; they may stand in quotation marks. With semicolons,
  or with white space where each word has a comma, a comma is that of a decimal number. The first three words are x, y
  and z; of three or six more in each line, three that are unit vectors are normals, and three that are whole numbers
  from 0 to 255 colours, as are the last three of four in a `.pts` file, behind the intensity, and in others those of
  four that can be meant; what else follows is passed over. A first column of growing whole numbers before three others
  or more numbers the points, and is passed over.
  Lines that start with `#`, `//` or `%` are comments. The lines before the points that do not start with a number are
  passed over, if the last of them does not have as many words as the points have columns: such a line names the
columns, three of which are `x`, `y` and `z` (or `Points:0` to `Points:2`), and those of normals `nx`, `ny` and `nz` (or
  `normal_x`, ..., `Normals:0`, ...), in any case of letters and with a unit in brackets behind; so may a comment. A
line before the points may hold their number alone.

Each of these may be packed by gzip (`.xyz.gz`), where the program was built with Boost.Iostreams.

Colours are read from PLY (`red`, `green`, `blue`), PCD (`rgb`, `rgba`), PTX, LAS, glTF (`COLOR_0`), OBJ (three numbers
behind the coordinates), OFF (`COFF`), arrays of n x 6 or n x 9 (as in text) and text, where columns may be named `r`,
`g`, `b` or `red`, `green`, `blue`; parts are from 0 to 255, those of 16 bits and shares are rounded to that.

Normals are read from PLY (`nx`, `ny`, `nz`), PCD (`normal_x`, ...), the points of glTF, arrays of n x 6 or n x 9 and
text.

Where a mesh's faces do not form an oriented manifold, faces are turned and vertices are split until they do; faces that
name a vertex twice and vertices without a face are left out.

Numbers are read the same whatever the locale of the program is.

\tparam Kernel a model of `Kernel`
\param filename the name of the file
\param camera the camera of a depth image

\throws IO_error if the file cannot be opened, does not parse, or has no points; `IO_error::line()` says where, if it is
a text of a format that CGAL does not read for us (`.ts`, `.vtp`).
*/
template <class Kernel>
Scan_file<Kernel> read_scan(const std::string& filename, const Depth_camera& camera = Depth_camera())
{
  internal::Flat_scan_file flat = internal::read_flat_scan(filename, camera);
  Scan_file<Kernel> scan;
  scan.normals = internal::to_kernel_vectors<Kernel>(flat.normals);
  scan.colors.reserve(flat.colors.size());
  for (const internal::Color& c : flat.colors) scan.colors.emplace_back(c[0], c[1], c[2]);
  scan.missing = flat.missing;
  scan.notes = std::move(flat.notes);
  if (flat.kind != internal::Flat_scan_file::RANGE_IMAGE) scan.sensor = internal::to_sensor<Kernel>(flat.sensor);
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
read_scan<Exact_predicates_inexact_constructions_kernel>(const std::string&, const Depth_camera&);
#endif

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_READ_SCAN_H
