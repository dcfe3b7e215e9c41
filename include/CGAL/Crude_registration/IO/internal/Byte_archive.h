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

#ifndef CGAL_CRUDE_REGISTRATION_IO_INTERNAL_BYTE_ARCHIVE_H
#define CGAL_CRUDE_REGISTRATION_IO_INTERNAL_BYTE_ARCHIVE_H

// Values as bytes, the same on every machine: little-endian, a list as its length, in 8 bytes, and its items.

#include <CGAL/Crude_registration/IO/IO_error.h>

#include <boost/endian/conversion.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The unsigned integer of a size in bytes.
template <std::size_t size>
using Bits = std::conditional_t<
    size == 1, std::uint8_t,
    std::conditional_t<size == 2, std::uint16_t, std::conditional_t<size == 4, std::uint32_t, std::uint64_t>>>;

// Whether a list of such items has the same bytes in memory.
template <class T>
constexpr bool has_bytes_of_memory = std::is_arithmetic<T>::value &&
                                     (boost::endian::order::native == boost::endian::order::little || sizeof(T) == 1);

// Appends values to bytes.
class Byte_writer
{
public:
  template <class T, std::enable_if_t<std::is_arithmetic<T>::value, int> = 0>
  void operator()(const T& value)
  {
    Bits<sizeof(T)> bits;
    std::memcpy(&bits, &value, sizeof bits);
    boost::endian::native_to_little_inplace(bits);
    append(&bits, sizeof bits);
  }

  template <class T, class Item>
  void list(const std::vector<T>& items, const Item& item)
  {
    (*this)(std::uint64_t(items.size()));
    if constexpr (has_bytes_of_memory<T>) append(items.data(), items.size() * sizeof(T));
    else
      for (const T& i : items) item(*this, i);
  }

  void append(const void* data, std::size_t size) { m_bytes.append(static_cast<const char*>(data), size); }
  const std::string& bytes() const { return m_bytes; }

private:
  std::string m_bytes;
};

// Reads them back. \throws IO_error where the bytes end before
class Byte_reader
{
public:
  // `name`: of the bytes, in errors
  Byte_reader(const char* begin, const char* end, const std::string& name) : m_next(begin), m_end(end), m_name(name) {}

  template <class T, std::enable_if_t<std::is_arithmetic<T>::value, int> = 0>
  void operator()(T& value)
  {
    Bits<sizeof(T)> bits;
    std::memcpy(&bits, take(sizeof bits), sizeof bits);
    boost::endian::little_to_native_inplace(bits);
    std::memcpy(&value, &bits, sizeof bits);
  }

  // `item` reads one.
  template <class T, class Item>
  void list(std::vector<T>& items, const Item& item)
  {
    std::uint64_t size = 0;
    (*this)(size);
    // No more memory than the bytes justify: an item has a byte at least, one that is copied has its size.
    if (size > left() / (has_bytes_of_memory<T> ? sizeof(T) : 1)) fail("a list is longer than the bytes that are left");
    items.resize(std::size_t(size));
    if constexpr (has_bytes_of_memory<T>) {
      const char* const data = take(items.size() * sizeof(T));
      if (!items.empty()) std::memcpy(items.data(), data, items.size() * sizeof(T));
    } else
      for (T& i : items) item(*this, i);
  }

  std::size_t left() const { return std::size_t(m_end - m_next); }
  [[noreturn]] void fail(const std::string& what) const { throw IO_error(m_name, what); }

private:
  const char* take(std::size_t size)
  {
    if (size > left()) fail("the bytes of the scan end too early");
    const char* const data = m_next;
    m_next += size;
    return data;
  }

  const char* m_next;
  const char* m_end;
  std::string m_name;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_INTERNAL_BYTE_ARCHIVE_H
