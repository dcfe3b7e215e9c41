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

// Calls the preparation of `generator` for such arguments, where it has one.
template <class Generator, class... Arguments>
auto prepare_for(const Generator& generator, int, Arguments&&... arguments)
    -> decltype(generator.prepare(std::forward<Arguments>(arguments)...))
{
  generator.prepare(std::forward<Arguments>(arguments)...);
}

template <class Generator, class... Arguments>
void prepare_for(const Generator&, long, Arguments&&...)
{}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_PREPARE_FOR_H
