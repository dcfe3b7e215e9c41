// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "png_file.h"

#include <algorithm>
#include <array>
#include <new>

#ifdef CGAL_CRUDE_REGISTRATION_USE_PNG

#include <png.h>
#include <zlib.h>

namespace {

constexpr int bytes_of_pixel = 3;

// The rows as PNG filters them: each byte less the one above it, in the first row less that to the left, so that no
// band needs another one. Before each row stands its filter.
std::vector<std::uint8_t> filtered(const std::uint8_t* pixels, int width, int rows)
{
  const std::size_t n = std::size_t(bytes_of_pixel) * std::size_t(width);
  std::vector<std::uint8_t> bytes((1 + n) * std::size_t(rows));
  std::uint8_t* at = bytes.data();
  for (int y = 0; y < rows; ++y, pixels += n) {
    const std::ptrdiff_t step = y == 0 ? bytes_of_pixel : std::ptrdiff_t(n);
    const std::size_t begin = y == 0 ? (std::min)(std::size_t(bytes_of_pixel), n) : 0;
    *at++ = std::uint8_t(y == 0 ? PNG_FILTER_VALUE_SUB : PNG_FILTER_VALUE_UP);
    std::copy(pixels, pixels + begin, at);
    for (std::size_t i = begin; i < n; ++i) at[i] = std::uint8_t(pixels[i] - *(pixels + i - step));
    at += n;
  }
  return bytes;
}

} // namespace

Png_band png_band(const std::uint8_t* pixels, int width, int rows, bool is_last)
{
  std::vector<std::uint8_t> bytes = filtered(pixels, width, rows);
  Png_band band;
  band.size = bytes.size();
  band.checksum = adler32(adler32(0, nullptr, 0), bytes.data(), uInt(bytes.size()));
  // The fastest that makes no larger file than the default does, measured on pictures of scans: runs alone are looked
  // for. A negative number of bits asks for a stream without a head of its own.
  z_stream stream = {};
  constexpr int level = 1, window_bits = -15, memory = 8;
  if (deflateInit2(&stream, level, Z_DEFLATED, window_bits, memory, Z_RLE) != Z_OK) throw std::bad_alloc();
  constexpr std::size_t end_of_band = 16; // a band that is not the last one ends with an empty block, at a whole byte
  band.bytes.resize(deflateBound(&stream, uLong(bytes.size())) + end_of_band);
  stream.next_in = bytes.data();
  stream.avail_in = uInt(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(&band.bytes[0]);
  stream.avail_out = uInt(band.bytes.size());
  deflate(&stream, is_last ? Z_FINISH : Z_SYNC_FLUSH);
  band.bytes.resize(band.bytes.size() - stream.avail_out);
  deflateEnd(&stream);
  return band;
}

std::string png_file(int width, int height, const std::vector<Png_band>& bands)
{
  std::string file;
  uLong checksum = adler32(0, nullptr, 0);
  for (const Png_band& band : bands) checksum = adler32_combine(checksum, band.checksum, z_off_t(band.size));
  constexpr std::array<png_byte, 2> head = {0x78, 0x01}; // of zlib's streams: 32 KB of window, the fastest level
  std::array<png_byte, 4> tail{};
  for (std::size_t i = 0; i < 4; ++i) tail[i] = png_byte(checksum >> (24 - 8 * i) & 255);

  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  if (info == nullptr || setjmp(png_jmpbuf(png)) != 0) { // there was no memory
    png_destroy_write_struct(&png, &info);
    throw std::bad_alloc();
  }
  const auto append = [](png_structp p, png_bytep bytes, std::size_t size) {
    static_cast<std::string*>(png_get_io_ptr(p))->append(reinterpret_cast<const char*>(bytes), size);
  };
  png_set_write_fn(png, &file, append, nullptr);
  png_set_IHDR(png, info, png_uint_32(width), png_uint_32(height), 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  const auto* const pixels = reinterpret_cast<png_const_bytep>("IDAT");
  png_write_chunk(png, pixels, head.data(), head.size());
  for (const Png_band& band : bands)
    png_write_chunk(png, pixels, reinterpret_cast<png_const_bytep>(band.bytes.data()), band.bytes.size());
  png_write_chunk(png, pixels, tail.data(), tail.size());
  png_write_chunk(png, reinterpret_cast<png_const_bytep>("IEND"), nullptr, 0);
  png_destroy_write_struct(&png, &info);
  return file;
}

#else

Png_band png_band(const std::uint8_t*, int, int, bool)
{
  return {};
}

std::string png_file(int, int, const std::vector<Png_band>&)
{
  return "";
}

#endif
