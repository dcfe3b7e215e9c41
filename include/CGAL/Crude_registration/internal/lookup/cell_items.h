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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_LOOKUP_CELL_ITEMS_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_LOOKUP_CELL_ITEMS_H

// Items sorted by the cell of a grid that they are in.

#include <CGAL/Crude_registration/internal/base/Run_control.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// A sample, and the cell of a grid that it is in.
struct Cell_item
{
  std::uint64_t key;
  std::uint32_t index;
};

// Sorts items that are in the order of their indices by cells; those of a cell stay in that order. By the digits of the
// keys, the lowest first, but for those that all have in common: five times as fast as boost::sort::spreadsort, which
// compares items as soon as there are few, and took a seventh of the time of preparing a scan.
// \throws Run_control::Stopped
inline void sort_cell_items(std::vector<Cell_item>& items, Run_control& control)
{
  constexpr unsigned bits_of_digit = 12; // counters of 16 kB, half of a usual first-level cache
  constexpr std::size_t digits = std::size_t(1) << bits_of_digit;
  std::uint64_t different = 0;
  for (const Cell_item& item : items) different |= item.key ^ items.front().key;
  std::vector<Cell_item> sorted(items.size());
  std::size_t steps = 0;
  for (unsigned shift = 0; shift < 64 && different >> shift != 0; shift += bits_of_digit) {
    if ((different >> shift) % digits == 0) continue;
    std::array<std::uint32_t, digits + 1> place{};
    for (const Cell_item& item : items) ++place[(item.key >> shift) % digits + 1];
    std::partial_sum(place.begin(), place.end(), place.begin());
    for (const Cell_item& item : items) {
      control.check(++steps);
      sorted[place[(item.key >> shift) % digits]++] = item;
    }
    items.swap(sorted);
  }
}

// Points by the cells of a grid whose cells meet at the origin: by the x of the cells, by y, by z. Cells more than 2^20
// away from the origin are one. As they are sorted by bits, keys have no more of these than tell the cells apart that
// there are.
// \throws Run_control::Stopped
template <class Point>
std::vector<Cell_item> items_by_cells(const std::vector<Point>& points, typename Point::Scalar cell,
                                      Run_control& control)
{
  using Scalar = typename Point::Scalar;
  const Scalar scale = 1 / cell;
  constexpr Scalar limit = Scalar(1 << 20) - 1;
  const auto coordinate = [&](Scalar x) { // the integer below
    const Scalar in_cells = (std::min)((std::max)(x * scale, -limit), limit);
    const auto towards_zero = static_cast<std::int32_t>(in_cells);
    return towards_zero - std::int32_t(in_cells < Scalar(towards_zero));
  };
  std::vector<std::array<std::int32_t, 3>> cells(points.size());
  std::array<std::int32_t, 3> low{1 << 20, 1 << 20, 1 << 20}, high{-(1 << 20), -(1 << 20), -(1 << 20)};
  for (std::size_t k = 0; k < points.size(); ++k) {
    control.check(k);
    for (int i = 0; i < 3; ++i) {
      const std::int32_t c = coordinate(points[k][i]);
      cells[k][std::size_t(i)] = c;
      low[std::size_t(i)] = (std::min)(low[std::size_t(i)], c);
      high[std::size_t(i)] = (std::max)(high[std::size_t(i)], c);
    }
  }
  std::array<unsigned, 3> bits{};
  for (std::size_t i = 0; i < 3; ++i)
    while (((high[i] - low[i]) >> bits[i]) > 0) ++bits[i];
  std::vector<Cell_item> items(cells.size());
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const auto steps = [&](std::size_t i) { return std::uint64_t(cells[k][i] - low[i]); };
    items[k] = {((steps(0) << bits[1] | steps(1)) << bits[2]) | steps(2), std::uint32_t(k)};
  }
  sort_cell_items(items, control);
  return items;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_LOOKUP_CELL_ITEMS_H
