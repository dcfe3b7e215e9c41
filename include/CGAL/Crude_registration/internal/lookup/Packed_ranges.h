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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_LOOKUP_PACKED_RANGES_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_LOOKUP_PACKED_RANGES_H

// Ranges of several small numbers at once: some numbers are packed into one word and compared by a few instructions.

#include <cstdint>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// A word of fields of `bits` bits, each with a number below 2^(bits - 1): the highest bit of a field is free, so that
// sums and differences of all fields are made at once, none with a carry into the next one.
template <int bits>
class Packed_ranges
{
public:
  using Word = std::uint64_t;

  // The least number of each field, and by how much its greatest one is above. Where that would be 2^(bits - 1) or more
  // the range goes on at 0: the numbers lie on a circle.
  Packed_ranges(Word low, Word width) : m_offset((tops - low) & ~tops), m_width(width | tops) {}

  // Whether each number is in its range: moved by the offset the range starts at 0, and only a number beyond the width
  // needs the highest bit of the difference.
  bool contains(Word numbers) const { return ((m_width - ((numbers + m_offset) & ~tops)) & tops) == tops; }

  static constexpr Word field(int index, int number) { return Word(unsigned(number)) << (bits * index); }

private:
  static constexpr Word tops = (~Word(0) / ((Word(1) << bits) - 1)) << (bits - 1);

  Word m_offset, m_width;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_LOOKUP_PACKED_RANGES_H
