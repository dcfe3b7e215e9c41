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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_FOR_EACH_INDEX_IMPL_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_FOR_EACH_INDEX_IMPL_H

// The loops of for_each_index.h, on those of CGAL.

#include <CGAL/Crude_registration/internal/base/for_each_index.h>

#include <CGAL/for_each.h>

#include <numeric>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

CGAL_CRUDE_REGISTRATION_INLINE void for_each_index(Execution execution, std::size_t n, Run_control& control,
                                                   const std::function<void(std::size_t)>& f)
{
  const auto step = [&](std::size_t i) {
    if (!control.go_on()) return false;
    f(i);
    return true;
  };
#ifdef CGAL_LINKED_WITH_TBB
  if (execution == Execution::PARALLEL) {
    std::vector<std::size_t> indices(n);
    std::iota(indices.begin(), indices.end(), std::size_t(0));
    CGAL::for_each<Parallel_tag>(indices, [&](std::size_t& i) { return step(i); });
    return;
  }
#endif
  CGAL_USE(execution);
  for (std::size_t i = 0; i < n && step(i); ++i) {
  }
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_FOR_EACH_INDEX_IMPL_H
