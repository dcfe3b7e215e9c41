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

#ifndef CGAL_CRUDE_REGISTRATION_IO_INTERNAL_MOVED_NUMBERS_H
#define CGAL_CRUDE_REGISTRATION_IO_INTERNAL_MOVED_NUMBERS_H

// The bytes of a file, in which the numbers of points and of normals are moved.

#include <CGAL/Crude_registration/IO/IO_error.h>
#include <CGAL/Crude_registration/IO/internal/binary_numbers.h>
#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// x -> rotation * (scale * x) + translation
struct Similarity
{
  Rigid_motion motion;
  double scale = 1;

  Vector operator()(const Vector& p) const { return motion(Vector(scale * p)); }
};

// How a number stands in a file.
struct Number_form
{
  bool is_text = true;
  bool is_double = true; // else float, as text to the digits that tell floats apart
  bool is_big_endian = false;
  bool has_comma = false; // as the decimal mark of a text
};

// Copies the bytes of a file. Numbers are handed over point by point, text in its order; those of samples that are
// missing stay as they are, byte by byte, and so do normals that are null or not finite.
class Moved_numbers
{
public:
  static constexpr std::size_t roles = 6; // x, y, z, and those of the normal

  // `file` is only named in errors.
  Moved_numbers(std::string_view data, const Similarity& motion, const std::string& file)
      : m_data(data), m_motion(motion), m_file(file)
  {}

  // Then (0, 0, 0) is no point.
  void set_origin_is_missing(bool on) { m_origin_is_missing = on; }

  // A number of the point or its normal, and the bytes of the data that it stands in.
  void number(std::size_t role, std::string_view place, double value, const Number_form& form)
  {
    m_numbers[role] = {place, value, form};
    m_given[role] = true;
  }

  void end_of_point()
  {
    const bool has_point = m_given[0] && m_given[1] && m_given[2], has_normal = m_given[3] && m_given[4] && m_given[5];
    m_given.fill(false);
    std::array<const Number*, roles> changed{};
    std::size_t count = 0;
    const auto set = [&](std::size_t first, const Vector& v) {
      for (std::size_t i = 0; i < 3; ++i) {
        m_numbers[first + i].value = v(static_cast<int>(i)) + 0.; // without the sign of a zero
        std::size_t at = count++;                                 // in the order of their places
        for (; at > 0 && changed[at - 1]->place.data() > m_numbers[first + i].place.data(); --at)
          changed[at] = changed[at - 1];
        changed[at] = &m_numbers[first + i];
      }
    };
    if (has_point) {
      const Vector p = vector(0);
      if (!p.allFinite() || (m_origin_is_missing && p.isZero(0))) return;
      set(0, m_motion(p));
      for (std::size_t i = 0; i < 3; ++i) m_rounding = (std::max)(m_rounding, rounding_of(m_numbers[i]));
    }
    if (has_normal) {
      const Vector n = vector(3);
      if (n.allFinite() && !n.isZero(0)) set(3, m_motion.motion.rotation * n);
    }
    for (std::size_t i = 0; i < count; ++i) write(*changed[i]);
  }

  // The same for what is not moved as a point is: a number in place of a word.
  void replace(std::string_view place, double value) { write({place, value, Number_form()}); }

  // How far a coordinate is at most from where it was moved to, by the rounding of floats.
  double rounding() const { return m_rounding; }

  std::string take()
  {
    if (m_is_in_place) return std::move(m_moved);
    m_moved += m_data.substr(m_copied);
    m_copied = m_data.size();
    return std::move(m_moved);
  }

private:
  struct Number
  {
    std::string_view place;
    double value = 0;
    Number_form form;
  };

  Vector vector(std::size_t first) const
  {
    return Vector(m_numbers[first].value, m_numbers[first + 1].value, m_numbers[first + 2].value);
  }

  double rounding_of(const Number& n) const
  {
    if (n.form.is_double) return 0;
    const float rounded = static_cast<float>(n.value);
    if (!std::isfinite(rounded)) throw IO_error(m_file, "a coordinate is too large for a float where it is moved to");
    return std::abs(n.value - static_cast<double>(rounded));
  }

  void write(const Number& n)
  {
    const std::size_t at = static_cast<std::size_t>(n.place.data() - m_data.data());
    if (!n.form.is_text) {
      if (!m_is_in_place) m_moved = m_data;
      m_is_in_place = true;
      if (n.form.is_double) put_number(m_moved, at, n.value, n.form.is_big_endian);
      else put_number(m_moved, at, static_cast<float>(n.value), n.form.is_big_endian);
      return;
    }
    m_moved += m_data.substr(m_copied, at - m_copied);
    m_copied = at + n.place.size();
    // the shortest text that is read back the same
    std::array<char, 32> text;
    char* const end = n.form.is_double
                          ? std::to_chars(text.data(), text.data() + text.size(), n.value).ptr
                          : std::to_chars(text.data(), text.data() + text.size(), static_cast<float>(n.value)).ptr;
    if (n.form.has_comma) std::replace(text.data(), end, '.', ',');
    m_moved.append(text.data(), end);
  }

  std::string_view m_data;
  const Similarity& m_motion;
  const std::string& m_file;
  bool m_origin_is_missing = false, m_is_in_place = false;
  std::array<Number, roles> m_numbers;
  std::array<bool, roles> m_given{};
  std::string m_moved;
  std::size_t m_copied = 0; // of the data, where it is text
  double m_rounding = 0;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_INTERNAL_MOVED_NUMBERS_H
