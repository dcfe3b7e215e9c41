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

#ifndef CGAL_CRUDE_REGISTRATION_IO_INTERNAL_LZF_H
#define CGAL_CRUDE_REGISTRATION_IO_INTERNAL_LZF_H

// Unpacks what LZF has packed, and packs it.

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The format of liblzf: a control byte below 32 is followed by one more than that many bytes as they are; the others
// point back into what is unpacked already, their upper three bits being the length, 7 of which asks for a byte more,
// and the lower five with the byte that follows the distance. Returns whether the data gives `size` bytes, no more, no
// less.
inline bool unpack_lzf(std::string_view packed, std::size_t size, std::string& unpacked)
{
  // a reference of three bytes gives 264 at most: a size that the data cannot give must not make us ask for the memory
  if (size / 88 > packed.size()) return false;
  unpacked.clear();
  unpacked.reserve(size);
  const auto byte = [&](std::size_t i) { return static_cast<std::size_t>(static_cast<unsigned char>(packed[i])); };
  for (std::size_t i = 0; i < packed.size();) {
    const std::size_t control = byte(i++);
    if (control < 32) {
      const std::size_t length = control + 1;
      if (packed.size() - i < length || size - unpacked.size() < length) return false;
      unpacked.append(packed.substr(i, length));
      i += length;
      continue;
    }
    std::size_t length = (control >> 5) + 2;
    if (control >> 5 == 7) {
      if (i == packed.size()) return false;
      length += byte(i++);
    }
    if (i == packed.size()) return false;
    const std::size_t distance = ((control & 31) << 8 | byte(i++)) + 1;
    if (distance > unpacked.size() || size - unpacked.size() < length) return false;
    // what is copied may itself be copied on
    for (std::size_t from = unpacked.size() - distance, k = 0; k < length; ++k) unpacked.push_back(unpacked[from + k]);
  }
  return unpacked.size() == size;
}

// Packs bytes in this format: three bytes that stood before, where their hash says, become a reference as long as the
// two places agree; all others stay as they are.
inline std::string pack_lzf(std::string_view data)
{
  constexpr std::size_t longest = 264, farthest = 8192, bits = 14, unknown = static_cast<std::size_t>(-1);
  std::string packed;
  std::array<std::size_t, std::size_t(1) << bits> last;
  last.fill(unknown);
  const auto byte = [&](std::size_t i) { return static_cast<std::size_t>(static_cast<unsigned char>(data[i])); };
  std::size_t begin = 0; // of the bytes that are not written yet
  const auto write_bytes = [&](std::size_t end) {
    while (begin < end) {
      const std::size_t length = (std::min)(end - begin, std::size_t(32));
      packed += static_cast<char>(length - 1);
      packed += data.substr(begin, length);
      begin += length;
    }
  };
  for (std::size_t i = 0; i + 2 < data.size();) {
    // Knuth's multiplier, of which the upper bits are well mixed
    const std::size_t hash =
        ((byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2)) * 2654435761u & 0xffffffffu) >> (32 - bits);
    const std::size_t from = last[hash];
    last[hash] = i;
    std::size_t length = 0;
    if (from != unknown && i - from <= farthest)
      while (length < longest && i + length < data.size() && data[from + length] == data[i + length]) ++length;
    if (length < 3) {
      ++i;
      continue;
    }
    write_bytes(i);
    const std::size_t l = length - 2, distance = i - from - 1;
    packed += static_cast<char>((std::min)(l, std::size_t(7)) << 5 | distance >> 8);
    if (l >= 7) packed += static_cast<char>(l - 7);
    packed += static_cast<char>(distance & 255);
    begin = i += length;
  }
  write_bytes(data.size());
  return packed;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_INTERNAL_LZF_H
