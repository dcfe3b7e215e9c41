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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_LOOKUP_BINS_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_LOOKUP_BINS_H

// Items in numbered bins, one array for all: what every index of this room is made of.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The bins follow each other in the array, and the items of a bin are in the order in which they were added.
template <class Item>
class Bins
{
public:
  Bins() : m_begin(1, 0) {}

  // `for_each(add)` calls add(bin, item) for each item. It is called twice, first to count, and has to do the same both
  // times.
  template <class For_each>
  Bins(std::size_t number_of_bins, const For_each& for_each) : m_begin(number_of_bins + 1, 0)
  {
    for_each([&](std::size_t bin, const Item&) { ++m_begin[bin + 1]; });
    for (std::size_t b = 1; b < m_begin.size(); ++b) m_begin[b] += m_begin[b - 1];
    m_items.resize(m_begin.back());
    std::vector<std::uint32_t> next(m_begin.begin(), m_begin.end() - 1);
    for_each([&](std::size_t bin, const Item& item) { m_items[next[bin]++] = item; });
  }

  // All items, and where in them a bin begins and ends.
  const std::vector<Item>& items() const { return m_items; }
  std::size_t begin(std::size_t bin) const { return m_begin[bin]; }
  std::size_t end(std::size_t bin) const { return m_begin[bin + 1]; }

private:
  std::vector<std::uint32_t> m_begin; // of each bin in m_items, and the end of the last one
  std::vector<Item> m_items;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_LOOKUP_BINS_H
