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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_PIPELINE_USER_CANDIDATES_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_PIPELINE_USER_CANDIDATES_H

// Any model of CandidateGenerator as a source of candidates for the pipeline.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/internal/matching/Candidate_source.h>

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// `Rounds`: what rounds() of the generator returns.
template <class Rounds>
class User_candidates : public Candidate_source
{
public:
  // `source`, `target`: kept by reference.
  User_candidates(Rounds rounds, const Reduced_scan& source, const Reduced_scan& target)
      : m_rounds(std::move(rounds)), m_source(source), m_target(target)
  {}

  std::optional<Proposals> next(Run_control& control) override
  {
    if (m_rounds.is_done()) return std::nullopt;
    const Stage_timer timer(m_stage);
    const auto motions = m_rounds([&control] { return control.go_on(); });
    if (motions.empty() && m_rounds.is_done()) return std::nullopt;
    ++m_stage.count;
    Proposals proposals;
    const Rigid_motion input_from_own = m_source.own_from_input.inverse();
    for (const auto& m : motions)
      proposals.poses.push_back(to_pose(m_target.own_from_input * to_rigid_motion(m) * input_from_own));
    proposals.judged = most_judged;
    return proposals;
  }

  std::vector<Stage_record> stages() const override { return {m_stage}; }

private:
  static constexpr std::size_t most_judged = 16; // as of the last round of the default

  Rounds m_rounds;
  const Reduced_scan& m_source;
  const Reduced_scan& m_target;
  Stage_record m_stage{"propose"};
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_PIPELINE_USER_CANDIDATES_H
