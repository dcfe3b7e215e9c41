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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_TRIHEDRON_CANDIDATES_IMPL_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_TRIHEDRON_CANDIDATES_IMPL_H

// What is behind Trihedron_candidates: the search of the paper.

#include <CGAL/Crude_registration/internal/matching/Trihedron_search.h>
#include <CGAL/Crude_registration/matching/Trihedron_candidates.h>

#include <memory>
#include <stdexcept>

namespace CGAL {
namespace Crude_registration {

CGAL_CRUDE_REGISTRATION_INLINE std::unique_ptr<internal::Candidate_source>
Trihedron_candidates::candidates(const internal::Reduced_scan& source, const internal::Reduced_scan& target,
                                 internal::Execution execution) const
{
  if (!source.simplified || !target.simplified)
    throw std::invalid_argument(
        "Trihedron_candidates: a Scan is not simplified: it has to be made with the parameter candidates, too");
  internal::Trihedron_parameters parameters;
  parameters.minimum_extent = m_extents[0];
  parameters.maximum_extent = m_extents[1];
  parameters.tolerance = m_tolerance;
  parameters.use_normals = m_use_normals;
  return std::make_unique<internal::Trihedron_search>(source, target, parameters, execution);
}

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_TRIHEDRON_CANDIDATES_IMPL_H
