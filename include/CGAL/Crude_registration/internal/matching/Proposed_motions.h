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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_PROPOSED_MOTIONS_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_PROPOSED_MOTIONS_H

// The rounds of a built-in candidate generator, as users of the concept see them.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/internal/base/Run_control.h>
#include <CGAL/Crude_registration/internal/matching/Candidate_source.h>

#include <CGAL/Aff_transformation_3.h>

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// \tparam Kernel of the motions
template <class Kernel>
class Proposed_motions
{
public:
  // `source`, `target`: kept by reference.
  Proposed_motions(std::unique_ptr<Candidate_source> candidates, const Reduced_scan& source, const Reduced_scan& target)
      : m_candidates(std::move(candidates)), m_source(&source), m_target(&target)
  {}

  // The motions of the next round, best first, between the frames of the inputs; a round may find nothing, and the
  // rounds end with an empty one for which is_done() is true.
  std::vector<Aff_transformation_3<Kernel>> operator()(const std::function<bool()>& go_on)
  {
    Run_control control([&](double) { return go_on(); }, (std::numeric_limits<double>::infinity)());
    const std::optional<Proposals> proposals = m_candidates->next(control);
    m_is_done = !proposals;
    std::vector<Aff_transformation_3<Kernel>> motions;
    if (!proposals) return motions;
    const Rigid_motion input_from_own = m_target->own_from_input.inverse();
    for (const Pose& p : proposals->poses)
      motions.push_back(to_aff_transformation<Kernel>(input_from_own * to_rigid_motion(p) * m_source->own_from_input));
    return motions;
  }

  bool is_done() const { return m_is_done; }

private:
  std::unique_ptr<Candidate_source> m_candidates;
  const Reduced_scan* m_source;
  const Reduced_scan* m_target;
  bool m_is_done = false;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_PROPOSED_MOTIONS_H
