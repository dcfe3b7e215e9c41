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

#include <boost/sort/spreadsort/integer_sort.hpp>

#include <cstddef>
#include <cstdint>
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

// By cells, the samples of a cell by their indices. \throws Run_control::Stopped
inline void sort_cell_items(std::vector<Cell_item>& items, Run_control& control)
{
  std::size_t steps = 0;
  boost::sort::spreadsort::integer_sort(
      items.begin(), items.end(),
      [&](const Cell_item& a, unsigned shift) {
        control.check(++steps);
        return a.key >> shift;
      },
      [](const Cell_item& a, const Cell_item& b) { return a.key != b.key ? a.key < b.key : a.index < b.index; });
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_LOOKUP_CELL_ITEMS_H
