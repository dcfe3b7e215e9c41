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

#ifndef CGAL_CRUDE_REGISTRATION_IO_INTERNAL_JSON_WRITER_H
#define CGAL_CRUDE_REGISTRATION_IO_INTERNAL_JSON_WRITER_H

#include <charconv>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Writes JSON (RFC 8259) in the order it is told: the same values give the same bytes, whatever the locale. Numbers are
// the shortest that are read back the same; those that are not finite become null.
class Json_writer
{
public:
  Json_writer& begin_object() { return open('{'); }
  Json_writer& end_object() { return close('}'); }
  Json_writer& begin_array() { return open('['); }
  Json_writer& end_array() { return close(']'); }

  Json_writer& key(std::string_view name)
  {
    separate();
    quote(name);
    m_text += ": ";
    m_after_key = true;
    return *this;
  }

  Json_writer& value(std::string_view text)
  {
    separate();
    quote(text);
    return *this;
  }

  Json_writer& value(const char* text) { return value(std::string_view(text)); }

  template <class T, class = std::enable_if_t<std::is_arithmetic<T>::value>>
  Json_writer& value(T number)
  {
    separate();
    if constexpr (std::is_same<T, bool>::value) m_text += number ? "true" : "false";
    else append_number(number);
    return *this;
  }

  // An array of numbers, in one line.
  template <class Range>
  Json_writer& row(const Range& numbers)
  {
    separate();
    m_text += '[';
    const char* separator = "";
    for (double number : numbers) {
      m_text += separator;
      append_number(number);
      separator = ", ";
    }
    m_text += ']';
    return *this;
  }

  template <class T>
  Json_writer& member(std::string_view name, const T& v)
  {
    return key(name).value(v);
  }

  // The text so far; complete when everything that was begun has been ended.
  const std::string& text() const { return m_text; }

private:
  Json_writer& open(char bracket)
  {
    separate();
    m_levels.push_back(true);
    m_text += bracket;
    return *this;
  }

  Json_writer& close(char bracket)
  {
    const bool was_empty = m_levels.back();
    m_levels.pop_back();
    if (!was_empty) new_line();
    m_text += bracket;
    return *this;
  }

  void new_line()
  {
    m_text += '\n';
    m_text.append(2 * m_levels.size(), ' ');
  }

  // What stands before a key or a value.
  void separate()
  {
    if (m_after_key) {
      m_after_key = false;
      return;
    }
    if (m_levels.empty()) return;
    if (!m_levels.back()) m_text += ',';
    m_levels.back() = false;
    new_line();
  }

  template <class Number>
  void append_number(Number number)
  {
    if constexpr (std::is_floating_point<Number>::value)
      if (!std::isfinite(number)) {
        m_text += "null";
        return;
      }
    char buffer[32];
    const std::to_chars_result result = std::to_chars(buffer, buffer + sizeof buffer, number);
    m_text.append(buffer, result.ptr);
  }

  void quote(std::string_view text)
  {
    constexpr const char* digits = "0123456789abcdef";
    m_text += '"';
    for (char c : text) {
      const unsigned char code = static_cast<unsigned char>(c);
      if (c == '"' || c == '\\') {
        m_text += '\\';
        m_text += c;
      } else if (code < 0x20) {
        m_text += "\\u00";
        m_text += digits[code >> 4];
        m_text += digits[code & 15];
      } else m_text += c;
    }
    m_text += '"';
  }

  std::string m_text;
  std::vector<bool> m_levels; // of what was begun and not ended: whether it is empty
  bool m_after_key = false;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_INTERNAL_JSON_WRITER_H
