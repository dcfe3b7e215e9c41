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

#ifndef CGAL_CRUDE_REGISTRATION_IO_INTERNAL_BINARY_NUMBERS_H
#define CGAL_CRUDE_REGISTRATION_IO_INTERNAL_BINARY_NUMBERS_H

// Numbers in the bytes of a file.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace CGAL {
namespace Crude_registration {
namespace internal {

inline bool is_little_endian()
{
  const std::uint16_t one = 1;
  unsigned char first;
  std::memcpy(&first, &one, 1);
  return first == 1;
}

// The number of type T at a place of the data, which holds it.
template <class T>
T number_at(std::string_view data, std::size_t at, bool big_endian = false)
{
  unsigned char bytes[sizeof(T)];
  std::memcpy(bytes, data.data() + at, sizeof(T));
  if (big_endian == is_little_endian()) std::reverse(bytes, bytes + sizeof(T));
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

// Puts a number there.
template <class T>
void put_number(std::string& data, std::size_t at, T value, bool big_endian = false)
{
  unsigned char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  if (big_endian == is_little_endian()) std::reverse(bytes, bytes + sizeof(T));
  std::memcpy(&data[at], bytes, sizeof(T));
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_INTERNAL_BINARY_NUMBERS_H
