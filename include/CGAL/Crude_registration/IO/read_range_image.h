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

#ifndef CGAL_CRUDE_REGISTRATION_IO_READ_RANGE_IMAGE_H
#define CGAL_CRUDE_REGISTRATION_IO_READ_RANGE_IMAGE_H

// Reads range images.

#include <CGAL/Crude_registration/IO/IO_error.h>
#include <CGAL/Crude_registration/IO/internal/read_flat_scan.h>
#include <CGAL/Crude_registration/IO/internal/to_kernel.h>
#include <CGAL/Crude_registration/Range_image.h>

#include <istream>
#include <iterator>
#include <string>

namespace CGAL {
namespace Crude_registration {

/*!
\ingroup PkgCrudeRegistrationRef

\brief reads a range image from a PLY file with an `element range_grid`, as those of the Stanford 3D Scanning
Repository.

The encodings are ascii, binary little endian and binary big endian. The grid has `obj_info num_cols` times
`obj_info num_rows` cells, row by row, each of which is a list of no vertex or of one. All else in the file is passed
over, except `obj_info viewpoint x y z` and `obj_info viewing_direction x y z`, which `write_range_image()` writes: they
give the image its sensor. Without them, the sensor is what `estimate_sensor()` finds in the grid. A vertex that is NaN
or infinite is no sample.

\param filename the name of the file
\param image the output, in the unit and frame of the file; left as it was where an error is thrown

\throws IO_error if the file cannot be opened or does not parse: it is cut off; a word is not a number; an index is
outside the vertices or in two cells; `num_cols` or `num_rows` is missing or does not match the grid; there is no grid
or no sample.
*/
template <class Kernel>
void read_range_image(const std::string& filename, Range_image<Kernel>& image)
{
  image = internal::to_range_image<Kernel>(internal::parse_flat_range_image(internal::read_file(filename), filename),
                                           filename);
}

/*!
\ingroup PkgCrudeRegistrationRef

\brief reads a range image from a stream, opened as binary, that holds a PLY file; `name` stands for it in errors.

\sa `read_range_image(const std::string&, Range_image<Kernel>&)`
*/
template <class Kernel>
void read_range_image(std::istream& in, Range_image<Kernel>& image, const std::string& name = "stream")
{
  const std::string data((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (in.bad()) throw IO_error(name, "the stream cannot be read");
  image = internal::to_range_image<Kernel>(internal::parse_flat_range_image(data, name), name);
}

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_READ_RANGE_IMAGE_H
