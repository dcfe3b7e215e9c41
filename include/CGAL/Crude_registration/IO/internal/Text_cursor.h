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

#ifndef CGAL_CRUDE_REGISTRATION_IO_INTERNAL_TEXT_CURSOR_H
#define CGAL_CRUDE_REGISTRATION_IO_INTERNAL_TEXT_CURSOR_H

// Walks through a text by lines and words, and knows where it is.

#include <CGAL/Crude_registration/IO/IO_error.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <system_error>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// A number at the start of [first, last), read the same in every locale. `next` is set behind it; nullptr where there
// is none. What is too small for a double is 0, what is too large is infinite.
inline double parse_double(const char* first, const char* last, const char*& next)
{
  if (first != last && *first == '+') ++first; // std::from_chars takes no plus sign
  double value = 0;
  const std::from_chars_result r = std::from_chars(first, last, value);
  if (r.ec == std::errc()) {
    next = r.ptr;
    return value;
  }
  if (r.ec == std::errc::result_out_of_range) {
    // from_chars does not say on which side: the exponent does
    next = r.ptr;
    const std::string_view number(first, static_cast<std::size_t>(r.ptr - first));
    const std::size_t e = number.find_first_of("eE");
    const bool tiny = e == std::string_view::npos ? number.find_first_of("123456789") > number.find('.')
                                                  : e + 1 < number.size() && number[e + 1] == '-';
    return tiny ? 0. : HUGE_VAL;
  }
  next = nullptr;
  return 0;
}

// Walks a text line by line and word by word, counting lines; blank lines are passed over.
class Text_cursor
{
public:
  // `first_line` is the number of the line that starts at text.begin(); `file` is only named in errors and must outlive
  // the cursor
  Text_cursor(std::string_view text, const std::string& file, std::size_t first_line = 1)
      : m_next(text.data()), m_end(text.data() + text.size()), m_word(m_next), m_line_end(m_next), m_file(file),
        m_next_line(first_line), m_line(first_line)
  {}

  // Words are separated by white space; with a separator by it alone, white space around it being ignored.
  void set_separator(char separator) { m_separator = separator; }

  // Numbers may have a comma for a point, as where the language says so; the separator is none then, or another.
  void set_decimal_comma(bool on) { m_decimal_comma = on; }
  bool has_decimal_comma() const { return m_decimal_comma; }

  // A word may stand in quotation marks, a separator within them being a part of it.
  void set_quotes(bool on) { m_quotes = on; }

  // to the next line that has a word; false at the end of the text. Lines end in \n, \r\n or \r.
  bool next_line()
  {
    while (m_next != m_end) {
      m_word = m_next;
      m_line = m_next_line++;
      const char* p = m_next;
      while (p != m_end && *p != '\n' && *p != '\r') ++p;
      m_line_end = p;
      if (p != m_end) p += (*p == '\r' && p + 1 != m_end && p[1] == '\n') ? 2 : 1;
      m_next = p;
      skip_space();
      if (m_word != m_line_end) return true;
    }
    m_word = m_line_end = m_end;
    return false;
  }

  // is there another word on this line?
  bool has_word() const { return m_word != m_line_end; }

  // the next word of this line; empty at its end
  std::string_view word()
  {
    const char* first = m_word;
    if (m_quotes && first != m_line_end && *first == '"') {
      const char* const last = std::find(first + 1, m_line_end, '"');
      if (last != m_line_end && ends_word(last + 1)) {
        m_word = last + 1;
        to_next_word();
        return std::string_view(first + 1, static_cast<std::size_t>(last - first - 1));
      }
    }
    while (!at_word_end(m_word)) ++m_word;
    const char* last = m_word;
    while (last != first && is_space(last[-1])) --last;
    to_next_word();
    return std::string_view(first, static_cast<std::size_t>(last - first));
  }

  // what is left of the line
  std::string_view rest() const { return std::string_view(m_word, static_cast<std::size_t>(m_line_end - m_word)); }

  // The next word, if it is a number, which may be infinite or NaN; else the cursor stays.
  bool try_number(double& value)
  {
    const char* next = nullptr;
    value = parse_double(m_word, m_line_end, next);
    if (next != nullptr && ends_word(next)) {
      m_word = next;
      to_next_word();
      return true;
    }
    if (!m_quotes && !m_decimal_comma) return false;
    const char* const before = m_word;
    constexpr std::size_t longest = 400; // of a double in decimal, with its exponent spelt out
    std::string text(word().substr(0, longest + 1));
    if (m_decimal_comma) std::replace(text.begin(), text.end(), ',', '.');
    const char* const end = text.data() + text.size();
    value = parse_double(text.data(), end, next);
    if (next == end && !text.empty() && text.size() <= longest) return true;
    m_word = before;
    return false;
  }

  // the next word as a number, which may be infinite or NaN; `what` names it in the error
  double number(const char* what)
  {
    double value = 0;
    if (!try_number(value)) fail_at_word(what, "a number");
    return value;
  }

  // the next word as an integer
  long long integer(const char* what)
  {
    long long value = 0;
    const std::from_chars_result r = std::from_chars(m_word, m_line_end, value);
    if (r.ec != std::errc() || !ends_word(r.ptr)) fail_at_word(what, "an integer");
    m_word = r.ptr;
    to_next_word();
    return value;
  }

  std::size_t line() const { return m_line; }
  const std::string& file() const { return m_file; }
  const char* next_line_begin() const { return m_next; }
  std::size_t next_line_number() const { return m_next_line; }

  [[noreturn]] void fail(const std::string& what) const { throw IO_error(m_file, m_line, what); }

private:
  static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

  bool at_word_end(const char* p) const
  {
    return p == m_line_end || (m_separator == 0 ? is_space(*p) : *p == m_separator);
  }

  // does nothing but white space stand between p and the end of its word?
  bool ends_word(const char* p) const
  {
    if (m_separator != 0)
      while (p != m_line_end && is_space(*p)) ++p;
    return at_word_end(p);
  }

  void skip_space()
  {
    while (m_word != m_line_end && is_space(*m_word)) ++m_word;
  }

  void to_next_word()
  {
    skip_space();
    if (m_separator != 0 && m_word != m_line_end && *m_word == m_separator) {
      ++m_word;
      skip_space();
    }
  }

  [[noreturn]] void fail_at_word(const char* what, const char* kind)
  {
    if (!has_word()) fail(std::string("the line ends before ") + what);
    fail(std::string(what) + " is not " + kind + ": '" + std::string(word().substr(0, 40)) + "'");
  }

  const char* m_next;
  const char* m_end;
  const char* m_word;
  const char* m_line_end;
  const std::string& m_file;
  std::size_t m_next_line;
  std::size_t m_line;
  char m_separator = 0;
  bool m_decimal_comma = false;
  bool m_quotes = false;
};

// The next three words of the line as coordinates, which may be infinite or NaN.
inline std::array<double, 3> read_coordinates(Text_cursor& cursor)
{
  std::array<double, 3> p;
  static constexpr const char* names[3] = {"x", "y", "z"};
  for (std::size_t i = 0; i < 3; ++i) p[i] = cursor.number(names[i]);
  return p;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_INTERNAL_TEXT_CURSOR_H
