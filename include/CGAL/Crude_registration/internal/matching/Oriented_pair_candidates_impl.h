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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_ORIENTED_PAIR_CANDIDATES_IMPL_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_ORIENTED_PAIR_CANDIDATES_IMPL_H

// What is behind Oriented_pair_candidates: the search for oriented pairs.

#include <CGAL/Crude_registration/internal/matching/Oriented_pair_search.h>
#include <CGAL/Crude_registration/matching/Oriented_pair_candidates.h>

#include <memory>

namespace CGAL {
namespace Crude_registration {

CGAL_CRUDE_REGISTRATION_INLINE std::unique_ptr<internal::Candidate_source>
Oriented_pair_candidates::candidates(const internal::Reduced_scan& source, const internal::Reduced_scan& target,
                                     internal::Execution execution) const
{
  internal::Oriented_pair_parameters parameters;
  parameters.minimum_extent = m_extents[0];
  parameters.maximum_extent = m_extents[1];
  return std::make_unique<internal::Oriented_pair_search>(source, target, parameters, execution);
}

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_ORIENTED_PAIR_CANDIDATES_IMPL_H
