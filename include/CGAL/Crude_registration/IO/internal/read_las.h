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

#ifndef CGAL_CRUDE_REGISTRATION_IO_INTERNAL_READ_LAS_H
#define CGAL_CRUDE_REGISTRATION_IO_INTERNAL_READ_LAS_H

// Reads the points of LAS files that are not compressed.

#include <CGAL/Crude_registration/IO/IO_error.h>
#include <CGAL/Crude_registration/IO/internal/Flat_scan_file.h>
#include <CGAL/Crude_registration/IO/internal/binary_numbers.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// LAS 1.0 to 1.4: a point is three whole numbers, times the scale, plus the offset of the header, in double.
// (ASPRS, LAS Specification 1.4 R15, tables 3 and 7.)
inline Flat_scan_file read_las(std::string_view data, const std::string& file)
{
  const auto fail = [&](std::size_t byte, const std::string& what) {
    throw IO_error(file, "byte " + std::to_string(byte) + ": " + what);
  };
  const std::size_t shortest_header = 227;
  if (data.size() < shortest_header) fail(data.size(), "the file ends within the header");
  if (data.substr(0, 4) != "LASF") fail(0, "not a LAS file: it does not start with 'LASF'");
  const int major = static_cast<unsigned char>(data[24]), minor = static_cast<unsigned char>(data[25]);
  if (major != 1 || minor > 4)
    fail(24, "LAS " + std::to_string(major) + "." + std::to_string(minor) + " is not read, 1.0 to 1.4 are");
  const std::size_t start = number_at<std::uint32_t>(data, 96), record = number_at<std::uint16_t>(data, 105);
  const unsigned format = static_cast<unsigned char>(data[104]);
  if (format & 0xc0) // as LAZ marks it
    throw IO_error(file, "the points are compressed (LAZ): convert the file to LAS, with laszip, PDAL or CloudCompare");
  if (format > 10) fail(104, "the point data format " + std::to_string(format) + " is not known");
  const std::size_t shortest_record = format < 6 ? 20 : 30;
  if (record < shortest_record) fail(105, "the points have too few bytes: " + std::to_string(record));
  std::uint64_t count = number_at<std::uint32_t>(data, 107);
  if (minor == 4) {
    if (data.size() < 375) fail(data.size(), "the file ends within the header");
    count = number_at<std::uint64_t>(data, 247);
  }
  const Vector scale(number_at<double>(data, 131), number_at<double>(data, 139), number_at<double>(data, 147));
  const Vector offset(number_at<double>(data, 155), number_at<double>(data, 163), number_at<double>(data, 171));
  if (!scale.allFinite() || !offset.allFinite()) fail(131, "a scale or an offset is NaN or infinite");
  if (start < shortest_header || start > data.size()) fail(96, "the points do not start within the file");
  // checked before the memory is asked for
  if ((data.size() - start) / record < count)
    fail(data.size(), "the file ends after " + std::to_string((data.size() - start) / record) + " of " +
                          std::to_string(count) + " points");
  // Where the colour stands in a point of each format (tables 8 to 17), if it has one; numbers of 16 bits, which some
  // programs fill up to 255 only.
  const std::size_t color_at = format == 2                                  ? 20
                               : format == 3 || format == 5                 ? 28
                               : format == 7 || format == 8 || format == 10 ? 30
                                                                            : 0;
  const bool has_colors = color_at > 0 && record >= color_at + 6;
  const auto color_part = [&](std::size_t point, std::size_t k) {
    return double(number_at<std::uint16_t>(data, start + point * record + color_at + 2 * k));
  };
  double largest = 0;
  for (std::size_t i = 0; has_colors && i < count; ++i)
    for (std::size_t k = 0; k < 3; ++k) largest = (std::max)(largest, color_part(i, k));
  Flat_scan_file scan;
  if (largest > 0) scan.colors.reserve(static_cast<std::size_t>(count));
  for (std::size_t i = 0; largest > 0 && i < count; ++i) {
    const auto part = [&](std::size_t k) { return part_of_color(color_part(i, k), largest > 255 ? 65535 : 255); };
    scan.colors.push_back({part(0), part(1), part(2)});
  }
  scan.points.reserve(static_cast<std::size_t>(count));
  for (std::size_t at = start, i = 0; i < count; ++i, at += record) {
    const Vector whole(number_at<std::int32_t>(data, at), number_at<std::int32_t>(data, at + 4),
                       number_at<std::int32_t>(data, at + 8));
    scan.points.push_back(whole.cwiseProduct(scale) + offset);
  }
  return scan;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_INTERNAL_READ_LAS_H
