// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CRUDE_REGISTER_PNG_FILE_H
#define CRUDE_REGISTER_PNG_FILE_H

// Pixels as a PNG file, in bands of rows that are compressed each by itself.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

constexpr bool can_write_png()
{
#ifdef CGAL_CRUDE_REGISTRATION_USE_PNG
  return true;
#else
  return false;
#endif
}

// A part of the one compressed stream that the pixels of a PNG file are.
struct Png_band
{
  std::string bytes;
  unsigned long checksum = 0; // Adler-32 of what was compressed
  std::size_t size = 0;       // of that
};

// `pixels`: rows of three bytes a pixel. `is_last`: they are the last rows of the picture.
Png_band png_band(const std::uint8_t* pixels, int width, int rows, bool is_last);

// The bytes of the file of all bands, from the top.
std::string png_file(int width, int height, const std::vector<Png_band>& bands);

#endif // CRUDE_REGISTER_PNG_FILE_H
