// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_FOR_EACH_INDEX_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_FOR_EACH_INDEX_H

#include <CGAL/Crude_registration/internal/base/Run_control.h>

#include <CGAL/for_each.h>

#include <cstddef>
#include <numeric>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// f(0) .. f(n - 1), by several threads under Parallel_tag: each call writes what is its own. As long as `control` says
// so; what is left then is not called.
template <class ConcurrencyTag, class Function>
void for_each_index(std::size_t n, Run_control& control, const Function& f)
{
  std::vector<std::size_t> indices(n);
  std::iota(indices.begin(), indices.end(), std::size_t(0));
  CGAL::for_each<ConcurrencyTag>(indices, [&](std::size_t& i) {
    if (!control.go_on()) return false;
    f(i);
    return true;
  });
}

template <class ConcurrencyTag, class Function>
void for_each_index(std::size_t n, const Function& f)
{
  for_each_index<ConcurrencyTag>(n, to_the_end(), f);
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_FOR_EACH_INDEX_H
