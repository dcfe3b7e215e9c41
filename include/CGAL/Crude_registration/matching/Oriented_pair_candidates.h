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

#ifndef CGAL_CRUDE_REGISTRATION_MATCHING_ORIENTED_PAIR_CANDIDATES_H
#define CGAL_CRUDE_REGISTRATION_MATCHING_ORIENTED_PAIR_CANDIDATES_H

// The default way to propose motions: pairs of oriented points of the reduced surfaces.

#include <CGAL/Crude_registration/internal/base/compiled.h>
#include <CGAL/Crude_registration/internal/base/for_each_index.h>
#include <CGAL/Crude_registration/internal/matching/Candidate_source.h>
#include <CGAL/Crude_registration/internal/matching/Proposed_motions.h>
#include <CGAL/Crude_registration/internal/matching/extents.h>
#include <CGAL/Crude_registration/named_parameters.h>

#include <array>
#include <memory>
#include <string>

namespace CGAL {
namespace Crude_registration {

/*!
\ingroup PkgCrudeRegistrationRef

\brief proposes motions by pairs of oriented points of the reduced surfaces: the default.

Both scans are reduced to some thousand small pieces of surface, each with its normal and curvatures. Pairs
\f$ (V, v_1) \f$ of the source's pieces, as long as the bounds allow, are looked up among the pairs of the target by
what a rigid motion leaves of them: their length, the two angles between the normals and the line that joins them, the
turn from the one normal to the other about that line, and the four curvatures. A pair with its normals fixes the
motion. Two more pieces on either side of the line, and most of some *witnesses* around, have to find a counterpart
where the motion takes them. What is left is ranked by how much of both scans agrees and by the free space of both.

Rounds of shorter pairs and larger tolerances follow as long as no motion is certain.

\cgalModels{CandidateGenerator}
*/
class Oriented_pair_candidates
{
public:
  /*!
  \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below; where they
         are given to `register_meshes()` or `register_scans()`, those count

  \cgalNamedParamsBegin
    \cgalParamNBegin{minimum_extent}
      \cgalParamDescription{\f$ f_1 \f$: no pair is shorter than this share of the mean extent \f$ M \f$ of the smaller
                            scan}
      \cgalParamType{`double`, zero or above}
      \cgalParamDefault{`0`}
    \cgalParamNEnd
    \cgalParamNBegin{maximum_extent}
      \cgalParamDescription{\f$ f_2 \f$: no pair is longer than this share of \f$ M \f$}
      \cgalParamType{`double`, above `minimum_extent`}
      \cgalParamDefault{`0.3`}
    \cgalParamNEnd
  \cgalNamedParamsEnd

  \throws std::invalid_argument if not \f$ 0 \le f_1 < f_2 \f$, or one of them is not finite
  */
  template <class NamedParameters = parameters::Default_named_parameters>
  explicit Oriented_pair_candidates(const NamedParameters& np = parameters::default_values())
      : m_extents(internal::extent_parameters(np, "Oriented_pair_candidates"))
  {}

  /// starts to propose motions of `source` to `target`, two `Scan`s, which are kept by reference.
  template <class ConcurrencyTag = CGAL::Sequential_tag, class Scan>
  auto rounds(const Scan& source, const Scan& target) const
  {
    return internal::Proposed_motions<typename Scan::Kernel>(
        candidates(source.reduced(), target.reduced(), internal::execution<ConcurrencyTag>()), source.reduced(),
        target.reduced());
  }

  /// \cond SKIP_IN_MANUAL
  // With what the parameters of `function` say.
  template <class NamedParameters>
  Oriented_pair_candidates with(const NamedParameters& np, const std::string& function) const
  {
    Oriented_pair_candidates result = *this;
    result.m_extents = internal::extent_parameters(np, function, m_extents);
    return result;
  }

  std::unique_ptr<internal::Candidate_source> candidates(const internal::Reduced_scan& source,
                                                         const internal::Reduced_scan& target,
                                                         internal::Execution execution) const;
  /// \endcond

private:
  std::array<double, 2> m_extents;
};

} // namespace Crude_registration
} // namespace CGAL

#ifndef CGAL_CRUDE_REGISTRATION_COMPILED
#include <CGAL/Crude_registration/internal/matching/Oriented_pair_candidates_impl.h>
#endif

#endif // CGAL_CRUDE_REGISTRATION_MATCHING_ORIENTED_PAIR_CANDIDATES_H
