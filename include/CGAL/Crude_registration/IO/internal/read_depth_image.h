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

#ifndef CGAL_CRUDE_REGISTRATION_IO_INTERNAL_READ_DEPTH_IMAGE_H
#define CGAL_CRUDE_REGISTRATION_IO_INTERNAL_READ_DEPTH_IMAGE_H

// Reads depth images: PNG files of one channel of 16 bits.

#include <CGAL/Crude_registration/IO/Depth_camera.h>
#include <CGAL/Crude_registration/IO/IO_error.h>
#include <CGAL/Crude_registration/IO/internal/Flat_scan_file.h>
#include <CGAL/Crude_registration/IO/internal/binary_numbers.h>

#ifdef CGAL_CRUDE_REGISTRATION_USE_PNG
#include <png.h>
#endif

#include <array>
#include <cmath>
#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

#ifdef CGAL_CRUDE_REGISTRATION_USE_PNG

// Decodes a PNG file of 16 bits grey. libpng reports errors by longjmp(): nothing that has to be destroyed is made
// within its reach.
class Depth_png
{
public:
  Depth_png(std::string_view data) : m_data(data)
  {
    m_png = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, &fail, [](png_structp, png_const_charp) {});
    if (m_png != nullptr) m_info = png_create_info_struct(m_png);
  }
  ~Depth_png() { png_destroy_read_struct(&m_png, &m_info, nullptr); }
  Depth_png(const Depth_png&) = delete;
  Depth_png& operator=(const Depth_png&) = delete;

  std::size_t columns = 0, rows = 0;
  std::vector<std::uint16_t> values; // row by row
  std::array<char, 100> error{};     // what is wrong, if decode() returns false

  bool decode()
  {
    if (m_info == nullptr) return fails("there is no memory for the image");
    if (setjmp(png_jmpbuf(m_png))) return false;
    png_set_read_fn(m_png, this, &read);
    png_read_info(m_png, m_info);
    columns = png_get_image_width(m_png, m_info);
    rows = png_get_image_height(m_png, m_info);
    if (png_get_bit_depth(m_png, m_info) != 16 || png_get_color_type(m_png, m_info) != PNG_COLOR_TYPE_GRAY)
      return fails("the image is not one of depths: these have one channel of 16 bits");
    // Deflate packs to a 1032nd at least: a size that the file cannot hold must not make us ask for the memory.
    if (columns > m_data.size() * 516 / rows) return fails("the file is too short for the size of its image");
    values.resize(columns * rows);
    m_lines.resize(rows);
    for (std::size_t row = 0; row < rows; ++row)
      m_lines[row] = reinterpret_cast<png_bytep>(values.data() + row * columns);
    if (is_little_endian()) png_set_swap(m_png);
    png_read_image(m_png, m_lines.data());
    png_read_end(m_png, nullptr);
    return true;
  }

private:
  bool fails(const char* what)
  {
    std::strncpy(error.data(), what, error.size() - 1);
    return false;
  }

  [[noreturn]] static void fail(png_structp png, png_const_charp what)
  {
    static_cast<Depth_png*>(png_get_error_ptr(png))->fails(what);
    png_longjmp(png, 1);
  }

  static void read(png_structp png, png_bytep to, std::size_t size)
  {
    Depth_png& self = *static_cast<Depth_png*>(png_get_io_ptr(png));
    if (self.m_data.size() - self.m_position < size) png_error(png, "the file ends within the image");
    std::memcpy(to, self.m_data.data() + self.m_position, size);
    self.m_position += size;
  }

  std::string_view m_data;
  std::size_t m_position = 0;
  png_structp m_png = nullptr;
  png_infop m_info = nullptr;
  std::vector<png_bytep> m_lines;
};

#endif

// The points of the image in the frame of the camera, which is the sensor. A depth of 0 is a missing sample.
inline Flat_scan_file read_depth_image([[maybe_unused]] std::string_view data, const Depth_camera& camera,
                                       const std::string& file)
{
#ifdef CGAL_CRUDE_REGISTRATION_USE_PNG
  const auto is_length = [](double x) { return std::isfinite(x) && x > 0; };
  if (!is_length(camera.fx) || !is_length(camera.fy) || !std::isfinite(camera.cx) || !std::isfinite(camera.cy) ||
      !is_length(camera.scale))
    throw IO_error(file, "a depth image is read only with its camera: fx, fy, cx, cy and the scale of its depths");
  Depth_png png(data);
  if (!png.decode()) throw IO_error(file, png.error.data());
  Flat_scan_file scan;
  scan.kind = Flat_scan_file::RANGE_IMAGE;
  scan.columns = png.columns;
  scan.rows = png.rows;
  scan.grid.assign(png.values.size(), -1);
  for (std::size_t v = 0, cell = 0; v < png.rows; ++v)
    for (std::size_t u = 0; u < png.columns; ++u, ++cell) {
      if (png.values[cell] == 0) {
        ++scan.missing;
        continue;
      }
      const double z = double(png.values[cell]) / camera.scale;
      scan.grid[cell] = static_cast<std::int32_t>(scan.points.size());
      scan.points.emplace_back((double(u) - camera.cx) * z / camera.fx, (double(v) - camera.cy) * z / camera.fy, z);
    }
  if (scan.points.empty()) throw IO_error(file, "the depth image has no samples");
  scan.sensor = {Flat_sensor::PERSPECTIVE, Vector::Zero()};
  return scan;
#else
  static_cast<void>(camera);
  throw IO_error(file, "depth images are read only where the program was built with libpng");
#endif
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_INTERNAL_READ_DEPTH_IMAGE_H
