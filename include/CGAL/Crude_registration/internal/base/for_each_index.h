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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_FOR_EACH_INDEX_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_FOR_EACH_INDEX_H

// Loops whose steps are independent of each other, by one thread or by several.

#include <CGAL/Crude_registration/internal/base/Run_control.h>
#include <CGAL/Crude_registration/internal/base/compiled.h>

#include <CGAL/tags.h>

#include <cstddef>
#include <functional>
#include <type_traits>

namespace CGAL {
namespace Crude_registration {
namespace internal {

enum class Execution
{
  SEQUENTIAL,
  PARALLEL
};

// What the tag of a public function asks for.
template <class ConcurrencyTag>
constexpr Execution execution()
{
  constexpr bool is_parallel = std::is_convertible<ConcurrencyTag, Parallel_tag>::value;
#ifndef CGAL_LINKED_WITH_TBB
  static_assert(!is_parallel, "Parallel_tag is enabled but TBB is unavailable.");
#endif
  return is_parallel ? Execution::PARALLEL : Execution::SEQUENTIAL;
}

// f(0) .. f(n - 1), each of which writes what is its own. As long as `control` says so; what is left then is not
// called.
void for_each_index(Execution execution, std::size_t n, Run_control& control,
                    const std::function<void(std::size_t)>& f);

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#ifndef CGAL_CRUDE_REGISTRATION_COMPILED
#include <CGAL/Crude_registration/internal/base/for_each_index_impl.h>
#endif

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_FOR_EACH_INDEX_H
