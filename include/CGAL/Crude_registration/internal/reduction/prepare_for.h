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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_PREPARE_FOR_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_PREPARE_FOR_H

// What a candidate generator needs of a scan beside what all scans are reduced to.

#include <utility>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Whether `generator` has a preparation for such arguments. It is called then.
template <class Generator, class... Arguments>
auto prepare_for(const Generator& generator, int, Arguments&&... arguments)
    -> decltype(generator.prepare(std::forward<Arguments>(arguments)...), true)
{
  generator.prepare(std::forward<Arguments>(arguments)...);
  return true;
}

template <class Generator, class... Arguments>
bool prepare_for(const Generator&, long, Arguments&&...)
{
  return false;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_PREPARE_FOR_H
