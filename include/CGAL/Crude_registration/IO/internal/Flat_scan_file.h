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

#ifndef CGAL_CRUDE_REGISTRATION_IO_INTERNAL_FLAT_SCAN_FILE_H
#define CGAL_CRUDE_REGISTRATION_IO_INTERNAL_FLAT_SCAN_FILE_H

// What is in a file, as flat arrays.

#include <CGAL/Crude_registration/internal/base/Flat_sensor.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Red, green and blue.
using Color = std::array<std::uint8_t, 3>;

// A part of a colour, of which so much is the largest.
inline std::uint8_t part_of_color(double value, double largest)
{
  const double part = 255 * (value / largest) + 0.5;
  return part > 0 ? static_cast<std::uint8_t>((std::min)(part, 255.)) : std::uint8_t(0); // and where it is no number
}

struct Flat_scan_file
{
  enum Kind
  {
    RANGE_IMAGE,
    MESH,
    POINTS
  };

  Kind kind = POINTS;
  std::vector<Vector> points;
  std::vector<std::vector<std::size_t>> polygons; // of a mesh: a manifold with consistent faces, no vertex without one
  std::size_t columns = 0, rows = 0;              // of a range image
  std::vector<std::int32_t> grid;                 // row by row; -1 where there is no sample
  Flat_sensor sensor;                             // as the file says, or as its grid tells
  std::vector<Vector> normals;                    // of points and samples, as the file has them: one each, or none
  std::vector<Color> colors;                      // of points, samples or vertices: one each, or none
  std::size_t missing = 0;                        // points of the file that are no samples
  std::vector<std::string> notes;                 // sentences on how the file was understood
};

// A normal of a file: of length 1, or null where the file has none for its point.
inline Vector unit_normal(const Vector& v)
{
  return v.allFinite() ? unit_or_zero(v) : Vector(Vector::Zero());
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_INTERNAL_FLAT_SCAN_FILE_H
