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

#ifndef CGAL_CRUDE_REGISTRATION_IO_INTERNAL_PLY_ELEMENTS_H
#define CGAL_CRUDE_REGISTRATION_IO_INTERNAL_PLY_ELEMENTS_H

// The elements of a PLY file and their properties, read one after the other from text or from bytes.

#include <CGAL/Crude_registration/IO/IO_error.h>
#include <CGAL/Crude_registration/IO/internal/Text_cursor.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

enum class Ply_type
{
  INT8,
  UINT8,
  INT16,
  UINT16,
  INT32,
  UINT32,
  FLOAT32,
  FLOAT64
};
enum class Ply_role
{
  SKIP,
  X,
  Y,
  Z,
  NX,
  NY,
  NZ,
  RED,
  GREEN,
  BLUE,
  INDICES
};

struct Ply_property
{
  std::string name;
  Ply_type type;
  bool is_list;
  Ply_type count_type;
  Ply_role role;
};

struct Ply_element
{
  std::string name;
  std::uint64_t count;
  std::size_t line;
  std::vector<Ply_property> properties;

  Ply_property* find(std::string_view property)
  {
    for (Ply_property& p : properties)
      if (p.name == property) return &p;
    return nullptr;
  }
};

// One element a line.
class Ply_ascii
{
public:
  Ply_ascii(std::string_view text, const std::string& file, std::size_t line) : m_cursor(text, file, line) {}

  void begin_element(const Ply_element& e, std::uint64_t i)
  {
    if (!m_cursor.next_line())
      throw IO_error(m_cursor.file(), m_cursor.next_line_number(),
                     "the file ends after " + std::to_string(i) + " of " + std::to_string(e.count) + " elements '" +
                         e.name + "'");
  }
  void end_element()
  {
    if (m_cursor.has_word()) m_cursor.fail("more values than the header declares");
  }
  double number(const Ply_property& p) { return m_cursor.number(p.name.c_str()); }
  // where it stands, before it is read
  std::string_view place(const Ply_property&) const { return Text_cursor(m_cursor).word(); }
  long long count(const Ply_property&) { return m_cursor.integer("the length of a list"); }
  long long index(const Ply_property& p) { return m_cursor.integer(p.name.c_str()); }
  void skip(const Ply_property&)
  {
    if (m_cursor.word().empty()) m_cursor.fail("fewer values than the header declares");
  }
  [[noreturn]] void fail(const std::string& what) const { m_cursor.fail(what); }

private:
  Text_cursor m_cursor;
};

template <bool swap>
class Ply_binary
{
public:
  Ply_binary(std::string_view data, std::size_t position, const std::string& file)
      : m_data(data), m_position(position), m_begin(position), m_file(file)
  {}

  void begin_element(const Ply_element& e, std::uint64_t i)
  {
    m_element = &e;
    m_index = i;
    m_begin = m_position;
  }
  void end_element() {}
  double number(const Ply_property& p)
  {
    switch (p.type) {
    case Ply_type::INT8:
      return get<std::int8_t>();
    case Ply_type::UINT8:
      return get<std::uint8_t>();
    case Ply_type::INT16:
      return get<std::int16_t>();
    case Ply_type::UINT16:
      return get<std::uint16_t>();
    case Ply_type::INT32:
      return get<std::int32_t>();
    case Ply_type::UINT32:
      return get<std::uint32_t>();
    case Ply_type::FLOAT32:
      return static_cast<double>(get<float>());
    default:
      return get<double>();
    }
  }
  std::string_view place(const Ply_property& p) const { return m_data.substr(m_position, size(p.type)); }
  long long count(const Ply_property& p) { return integer(p.count_type); }
  long long index(const Ply_property& p) { return integer(p.type); }
  void skip(const Ply_property& p) { advance(size(p.type)); }
  [[noreturn]] void fail(const std::string& what) const { fail_at(m_begin, what); }

private:
  static std::size_t size(Ply_type t)
  {
    return t <= Ply_type::UINT8 ? 1 : t <= Ply_type::UINT16 ? 2 : t == Ply_type::FLOAT64 ? 8 : 4;
  }
  long long integer(Ply_type t)
  {
    switch (t) {
    case Ply_type::INT8:
      return get<std::int8_t>();
    case Ply_type::UINT8:
      return get<std::uint8_t>();
    case Ply_type::INT16:
      return get<std::int16_t>();
    case Ply_type::UINT16:
      return get<std::uint16_t>();
    case Ply_type::INT32:
      return get<std::int32_t>();
    default:
      return get<std::uint32_t>();
    }
  }
  template <class T>
  T get()
  {
    const std::size_t at = m_position;
    advance(sizeof(T));
    unsigned char bytes[sizeof(T)];
    std::memcpy(bytes, m_data.data() + at, sizeof(T));
    if (swap) std::reverse(bytes, bytes + sizeof(T));
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
  }
  void advance(std::size_t bytes)
  {
    if (m_data.size() - m_position < bytes)
      fail_at(m_data.size(), "the file ends after " + std::to_string(m_index) + " of " +
                                 std::to_string(m_element->count) + " elements '" + m_element->name + "'");
    m_position += bytes;
  }
  [[noreturn]] void fail_at(std::size_t byte, const std::string& what) const
  {
    throw IO_error(m_file, "byte " + std::to_string(byte) + ": " + what);
  }

  std::string_view m_data;
  std::size_t m_position;
  std::size_t m_begin; // of the current element
  const std::string& m_file;
  const Ply_element* m_element = nullptr;
  std::uint64_t m_index = 0;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_INTERNAL_PLY_ELEMENTS_H
