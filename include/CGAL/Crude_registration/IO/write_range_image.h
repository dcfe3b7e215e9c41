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

#ifndef CGAL_CRUDE_REGISTRATION_IO_WRITE_RANGE_IMAGE_H
#define CGAL_CRUDE_REGISTRATION_IO_WRITE_RANGE_IMAGE_H

// Writes range images.

#include <CGAL/Crude_registration/IO/write_file.h>
#include <CGAL/Crude_registration/Range_image.h>

#include <CGAL/IO/Color.h>
#include <CGAL/number_utils.h>

#include <array>
#include <charconv>
#include <cstddef>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// the shortest text that is read back as the same doubles
template <class Tuple>
void write_coordinates(std::ostream& out, const Tuple& p)
{
  std::array<char, 32> text;
  for (int i = 0; i < 3; ++i) {
    const auto end = std::to_chars(text.data(), text.data() + text.size(), CGAL::to_double(p[i])).ptr;
    if (i > 0) out.put(' ');
    out.write(text.data(), end - text.data());
  }
}

} // namespace internal

/*!
\ingroup PkgCrudeRegistrationRef

\brief writes a range image as an ascii PLY file with an `element range_grid`, which `read_range_image()` reads back the
same, coordinates and a known sensor included.

The sensor is written as `obj_info viewpoint x y z` or `obj_info viewing_direction x y z`. The state of `out` tells
whether writing succeeded.

\param out the stream
\param image the range image
\param colors those of its samples, in their order, which `read_scan()` reads back; none are written if it is empty

\throws std::invalid_argument if there are colours, but not as many as samples
*/
template <class Kernel>
void write_range_image(std::ostream& out, const Range_image<Kernel>& image,
                       const std::vector<CGAL::IO::Color>& colors = {})
{
  if (!colors.empty() && colors.size() != image.points().size())
    throw std::invalid_argument("write_range_image: there are not as many colors as samples");
  out << "ply\nformat ascii 1.0\n"
      << "obj_info num_cols " << std::to_string(image.columns()) << "\n"
      << "obj_info num_rows " << std::to_string(image.rows()) << "\n";
  if (image.sensor().is_perspective()) {
    out << "obj_info viewpoint ";
    internal::write_coordinates(out, image.sensor().viewpoint());
    out << "\n";
  }
  if (image.sensor().is_orthographic()) {
    out << "obj_info viewing_direction ";
    internal::write_coordinates(out, image.sensor().viewing_direction());
    out << "\n";
  }
  out << "element vertex " << std::to_string(image.points().size()) << "\n"
      << "property double x\nproperty double y\nproperty double z\n"
      << (colors.empty() ? "" : "property uchar red\nproperty uchar green\nproperty uchar blue\n")
      << "element range_grid " << std::to_string(image.grid().size()) << "\n"
      << "property list uchar int vertex_indices\nend_header\n";
  for (std::size_t i = 0; i < image.points().size(); ++i) {
    internal::write_coordinates(out, image.points()[i]);
    for (std::size_t k = 0; !colors.empty() && k < 3; ++k) out << ' ' << std::to_string(int(colors[i][k]));
    out.put('\n');
  }
  for (const auto i : image.grid())
    if (i == Range_image<Kernel>::no_sample) out << "0\n";
    else out << "1 " << std::to_string(i) << "\n";
}

/*!
\ingroup PkgCrudeRegistrationRef

\brief writes a range image to a file, whole or not at all: an error leaves a file of that name as it was.

\param filename the name of the file
\param image the range image
\param colors those of its samples, in their order; none are written if it is empty

\throws IO_error if the file cannot be written.
\throws std::invalid_argument if there are colours, but not as many as samples

\sa `write_range_image(std::ostream&, const Range_image<Kernel>&, const std::vector<CGAL::IO::Color>&)`
*/
template <class Kernel>
void write_range_image(const std::string& filename, const Range_image<Kernel>& image,
                       const std::vector<CGAL::IO::Color>& colors = {})
{
  write_file(filename, [&](std::ostream& out) { write_range_image(out, image, colors); });
}

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_WRITE_RANGE_IMAGE_H
