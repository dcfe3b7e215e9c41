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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_ASSEMBLE_REDUCED_SCANS_IMPL_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_ASSEMBLE_REDUCED_SCANS_IMPL_H

// The steps of assemble_reduced_scans.h.

#include <CGAL/Crude_registration/internal/assembly/Pair_plan.h>
#include <CGAL/Crude_registration/internal/assembly/Parts.h>
#include <CGAL/Crude_registration/internal/assembly/Placed_scans.h>
#include <CGAL/Crude_registration/internal/assembly/assemble_reduced_scans.h>
#include <CGAL/Crude_registration/internal/assembly/assembly_edges.h>
#include <CGAL/Crude_registration/internal/assembly/fuse_scans.h>
#include <CGAL/Crude_registration/internal/assembly/loop_evidence.h>
#include <CGAL/Crude_registration/internal/assembly/relax_poses.h>
#include <CGAL/Crude_registration/internal/base/run_tasks.h>
#include <CGAL/Crude_registration/internal/matching/Candidate_source.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The scans in an order that does not depend on that of the input.
inline std::vector<std::size_t> canonical_order(const std::vector<const Reduced_scan*>& scans)
{
  std::vector<std::size_t> order(scans.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  const auto key = [&](std::size_t i) {
    const Reduced_scan& s = *scans[i];
    return std::tuple(s.number_of_samples, s.fine.surfels.size(), s.coarse.surfels.size(), s.extent, s.spacing);
  };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  return order;
}

class Assembler
{
public:
  Assembler(const std::vector<const Reduced_scan*>& scans, const Round_registration& register_pairs,
            const Surface_registration& register_surfaces, Execution execution, Run_control& control,
            const Known_poses& known)
      : m_scans(scans), m_register_pairs(register_pairs), m_register_surfaces(register_surfaces),
        m_execution(execution), m_control(control), m_order(canonical_order(scans)), m_placed(in_order(scans, m_order)),
        m_known(known), m_own_known(in_own_frames(known))
  {}

  Assembly_outcome operator()()
  {
    Stage_record reducing{"reduce"}, predicting{"predict"}, registering{"register"}, joining{"join"}, fusing{"fuse"};
    for (const Reduced_scan* scan : m_scans) {
      ++reducing.count;
      reducing.seconds += scan->seconds;
    }
    std::optional<Pair_plan> plan;
    {
      const Stage_timer timer(predicting);
      plan.emplace(m_placed, m_own_known);
      predicting.count = m_scans.size() * (m_scans.size() - 1) / 2;
    }
    // First what pairs say that are certain alone, as long as there are others to try; then what several say together;
    // then what the parts say that have come of it.
    std::optional<Parts> parts;
    const auto join = [&](Trust trust) {
      const Stage_timer timer(joining);
      ++joining.count;
      parts.emplace(m_placed, with_loop_evidence(m_placed, m_pairs), trust, m_own_known);
    };
    Trust trust = Trust::CERTAIN_PAIRS;
    join(trust);
    std::vector<Scan_pair> round = plan->first_round();
    for (;;) {
      if (!round.empty()) {
        const Stage_timer timer(registering);
        if (!register_round(round)) break;
      }
      registering.count = m_pairs.size();
      m_control.advance(0.9 * double(m_pairs.size()) / double(plan->budget() + 1));
      if (round.empty() && trust == Trust::CERTAIN_PAIRS) {
        if (parts->parts().size() <= 1) break;
        trust = Trust::ALL_PAIRS;
      } else if (round.empty()) {
        const Stage_timer timer(fusing);
        const std::size_t before = parts->parts().size(), tried = register_fused(*parts);
        fusing.count += tried;
        if (tried == 0) break;
        join(trust);
        if (parts->parts().size() >= before) break;
      }
      join(trust);
      round = plan->next_round(*parts, agreeing_pairs(*parts));
    }
    Assembly_outcome outcome;
    outcome.stages = {reducing, predicting, registering, joining, fusing};
    conclude(*parts, outcome);
    return outcome;
  }

private:
  static std::vector<const Reduced_scan*> in_order(const std::vector<const Reduced_scan*>& scans,
                                                   const std::vector<std::size_t>& order)
  {
    std::vector<const Reduced_scan*> result;
    result.reserve(order.size());
    for (const std::size_t i : order) result.push_back(scans[i]);
    return result;
  }

  // The same in the canonical order, of the scans' own frames.
  Known_poses in_own_frames(const Known_poses& known) const
  {
    Known_poses own = known;
    for (std::size_t k = 0; k < own.poses.size(); ++k) {
      own.poses[k] = known.poses[m_order[k]];
      if (own.poses[k]) own.poses[k]->motion = own.poses[k]->motion * m_placed.scan(k).own_from_input.inverse();
    }
    return own;
  }

  // False where the run was stopped: the answers of a round that was not done to its end are left out.
  bool register_round(const std::vector<Scan_pair>& round)
  {
    std::vector<Input_pair> pairs;
    pairs.reserve(round.size());
    for (const Scan_pair& p : round) pairs.push_back({m_order[p.first], m_order[p.second]});
    std::vector<Pair_answer> answers = m_register_pairs(pairs, m_control);
    if (m_control.is_stopped()) return false;
    std::vector<Tried_pair> tried;
    tried.reserve(round.size());
    for (std::size_t k = 0; k < round.size(); ++k) {
      tried.push_back({round[k], std::move(answers[k])});
      const Rigid_motion own_from_source = m_scans[pairs[k].source]->own_from_input;
      for (Ranked_motion& m : tried.back().answer.motions)
        m.motion = m_scans[pairs[k].target]->own_from_input * m.motion * own_from_source.inverse();
    }
    add(std::move(tried));
    return true;
  }

  // In an order that does not depend on when they came.
  void add(std::vector<Tried_pair> tried)
  {
    for (Tried_pair& pair : tried)
      if (pair.answer.status == REGISTERED && !pair.is_fused) pair.answer.motions.front().is_registered = true;
    m_pairs.insert(m_pairs.end(), tried.begin(), tried.end());
    std::stable_sort(m_pairs.begin(), m_pairs.end(),
                     [](const Tried_pair& a, const Tried_pair& b) { return a.scans < b.scans; });
  }

  // Registers what is still apart with the surfaces that the largest parts have together; the number of tries.
  std::size_t register_fused(const Parts& parts)
  {
    if (!m_register_surfaces || m_control.is_stopped()) return 0;
    std::vector<Part> all = parts.parts();
    std::stable_sort(all.begin(), all.end(),
                     [](const Part& a, const Part& b) { return a.scans.size() > b.scans.size(); });
    constexpr std::size_t largest = 3;                      // so many parts are large ones
    std::vector<std::pair<std::size_t, std::size_t>> tasks; // indices of parts: what is registered with what
    for (std::size_t q = 0; q < (std::min)(largest, all.size()); ++q)
      for (std::size_t p = q + 1; p < all.size(); ++p)
        if (all[q].scans.size() > 1 && m_fused.insert({all[p].scans, all[q].scans}).second) tasks.emplace_back(p, q);
    std::vector<Reduced_scan> surfaces(all.size());
    std::vector<std::uint8_t> is_wanted(all.size(), 0);
    for (const auto& t : tasks) is_wanted[t.first] = is_wanted[t.second] = 1;
    bool is_done = run_tasks(all.size(), m_execution, m_control, [&](std::size_t p, Run_control& control) {
      if (is_wanted[p] == 0 || all[p].scans.size() == 1) return;
      try {
        surfaces[p] = fuse_scans(m_placed, all[p].scans, parts.poses(), control);
      } catch (const Run_control::Stopped&) {
      }
    });
    std::vector<Tried_pair> tried(tasks.size());
    const auto surface = [&](std::size_t p) -> const Reduced_scan& {
      return all[p].scans.size() == 1 ? m_placed.scan(all[p].scans.front()) : surfaces[p];
    };
    is_done = is_done && run_tasks(tasks.size(), m_execution, m_control, [&](std::size_t t, Run_control& control) {
                tried[t] = fused_pair(parts, all[tasks[t].first], all[tasks[t].second],
                                      m_register_surfaces(surface(tasks[t].first), surface(tasks[t].second), control));
              });
    if (!is_done) return 0;
    add(std::move(tried));
    return tasks.size();
  }

  // What the registration of two parts says, as that of the two of their scans that meet most. The frame of a scan that
  // is alone is its own.
  Tried_pair fused_pair(const Parts& parts, const Part& part, const Part& other, Pair_answer answer) const
  {
    Tried_pair pair{{part.scans.front(), other.scans.front()}, std::move(answer), true};
    // The judgement of a pair knows no surface of this size, around which more fits by chance: it is not enough alone;
    // the pair of two scans that has the same motion among its own makes it so.
    // The odds are half of those by which parts are joined.
    constexpr double most_certain = trusted_join / (2 - trusted_join);
    double sum = 0;
    for (const Ranked_motion& m : pair.answer.motions) sum += m.probability;
    if (sum > most_certain)
      for (Ranked_motion& m : pair.answer.motions) m.probability *= most_certain / sum;
    if (!pair.answer.motions.empty()) {
      const Rigid_motion motion = pair.answer.motions.front().motion;
      double largest = -1;
      for (const std::size_t i : part.scans)
        for (const std::size_t j : other.scans) {
          const double overlap = m_placed.meeting(i, j, parts.poses()[j].inverse() * motion * parts.poses()[i]).overlap;
          if (overlap > largest) pair.scans = {i, j};
          largest = (std::max)(largest, overlap);
        }
      for (Ranked_motion& m : pair.answer.motions)
        m.motion = parts.poses()[pair.scans.second].inverse() * m.motion * parts.poses()[pair.scans.first];
    }
    if (pair.scans.first > pair.scans.second) {
      std::swap(pair.scans.first, pair.scans.second);
      for (Ranked_motion& m : pair.answer.motions) m.motion = m.motion.inverse();
    }
    return pair;
  }

  // Whether the first motion of a pair is that of the model.
  bool agrees(const Parts& parts, const Tried_pair& pair) const
  {
    return parts.are_together(pair.scans.first, pair.scans.second) && !pair.answer.motions.empty() &&
           pair.answer.status != NOT_REGISTERED &&
           Parts::agrees(m_placed, pair.scans, pair.answer.motions.front().motion, motion_in(parts, pair.scans));
  }

  std::vector<Scan_pair> agreeing_pairs(const Parts& parts) const
  {
    std::vector<Scan_pair> result;
    for (const Tried_pair& pair : m_pairs)
      if (agrees(parts, pair)) result.push_back(pair.scans);
    return result;
  }

  void conclude(const Parts& parts, Assembly_outcome& outcome) const
  {
    const std::size_t n = m_scans.size();
    outcome.is_interrupted = m_control.is_stopped();
    outcome.poses.resize(n);
    outcome.components.resize(n);
    outcome.reasons.resize(n);
    outcome.lost_hints.resize(n);
    outcome.residuals.resize(n, 0);
    outcome.covariances.resize(n, Matrix_6::Zero());
    // Components by their size, then by the first of their scans in the input, whose frame is that of the component.
    std::vector<std::vector<std::size_t>> components;
    for (const Part& part : parts.parts()) {
      components.emplace_back();
      for (const std::size_t i : part.scans) components.back().push_back(m_order[i]);
      std::sort(components.back().begin(), components.back().end());
    }
    std::sort(components.begin(), components.end(), [](const auto& a, const auto& b) {
      return a.size() != b.size() ? a.size() > b.size() : a.front() < b.front();
    });
    std::vector<std::size_t> place(n);
    for (std::size_t i = 0; i < n; ++i) place[m_order[i]] = i;
    outcome.number_of_components = components.size();
    Stage_record relaxing{"relax"};
    {
      const Stage_timer timer(relaxing);
      for (std::size_t c = 0; c < components.size(); ++c)
        relaxing.count += place_component(components[c], c, place, parts.poses(), outcome);
    }
    outcome.stages.push_back(relaxing);
    for (const Tried_pair& pair : m_pairs) outcome.edges.push_back(assembly_edge(m_placed, parts, m_order, pair));
    std::sort(outcome.edges.begin(), outcome.edges.end(), [](const Assembly_edge& a, const Assembly_edge& b) {
      return std::tuple(a.source, a.target) < std::tuple(b.source, b.target);
    });
    std::sort(outcome.pairs.begin(), outcome.pairs.end(), [](const Assembled_pair& a, const Assembled_pair& b) {
      return std::tuple(a.source, a.target) < std::tuple(b.source, b.target);
    });
    for (const std::vector<std::size_t>& component : components)
      if (component.size() == 1) outcome.reasons[component.front()] = reason_alone(component.front(), outcome);
    const std::vector<std::string> lost = lost_hints(m_placed, parts, m_own_known);
    for (std::size_t i = 0; i < n; ++i) outcome.lost_hints[m_order[i]] = lost[i];
  }

  // The refined poses of a component, in the frame of its anchor; the number of iterations.
  std::size_t place_component(const std::vector<std::size_t>& component, std::size_t number,
                              const std::vector<std::size_t>& place, const std::vector<Rigid_motion>& poses,
                              Assembly_outcome& outcome) const
  {
    std::vector<std::size_t> places;
    std::vector<Rigid_motion> initial;
    for (const std::size_t i : component) {
      places.push_back(place[i]);
      initial.push_back(poses[place[i]]);
    }
    const std::size_t anchor = m_known.anchor(component);
    const auto is_fixed_to = [&](std::size_t i, std::size_t j) {
      return i == j || (m_known.are_fixed && m_known.are_related(i, j));
    };
    std::vector<std::size_t> bodies;
    std::size_t last = 0; // body
    for (std::size_t k = 0; k < component.size(); ++k) {
      const auto other = std::find_if(component.begin(), component.begin() + std::ptrdiff_t(k),
                                      [&](std::size_t i) { return is_fixed_to(i, component[k]); });
      if (is_fixed_to(anchor, component[k])) bodies.push_back(0);
      else if (other != component.begin() + std::ptrdiff_t(k))
        bodies.push_back(bodies[std::size_t(other - component.begin())]);
      else bodies.push_back(++last);
    }
    const Relaxation relaxed = relax_poses(m_placed, places, initial, bodies, m_execution, m_control);
    const auto at = std::size_t(std::find(component.begin(), component.end(), anchor) - component.begin());
    const auto fixed_pose = [&](std::size_t i) { // in the frame of the component, of what is fixed to the anchor
      return m_known.are_fixed && m_known.of(i) ? *m_known.of(i) : Known_pose();
    };
    const Rigid_motion model_from_part =
        fixed_pose(anchor).motion * (relaxed.poses[at] * m_scans[anchor]->own_from_input).inverse();
    const Matrix_6 to_model = adjoint(model_from_part);
    for (std::size_t k = 0; k < component.size(); ++k) {
      const std::size_t i = component[k];
      outcome.components[i] = number;
      const Known_pose fixed = fixed_pose(i);
      outcome.poses[i] = bodies[k] == 0 ? fixed.given.value_or(fixed.motion)
                                        : model_from_part * relaxed.poses[k] * m_scans[i]->own_from_input;
      outcome.residuals[i] = relaxed.residuals[k];
      const Matrix_6 covariance = to_model * relaxed.covariances[k] * to_model.transpose();
      outcome.covariances[i] = 0.5 * (covariance + covariance.transpose());
    }
    for (const Relaxed_pair& p : relaxed.pairs)
      outcome.pairs.push_back({m_order[p.source], m_order[p.target], p.overlap, p.residual});
    return relaxed.iterations;
  }

  const std::vector<const Reduced_scan*>& m_scans;
  const Round_registration& m_register_pairs;
  const Surface_registration& m_register_surfaces;
  const Execution m_execution;
  Run_control& m_control;
  const std::vector<std::size_t> m_order; // the place in the input of each in the canonical order
  const Placed_scans m_placed;            // in the canonical order
  const Known_poses& m_known;
  const Known_poses m_own_known; // the same in the canonical order, of own frames
  std::vector<Tried_pair> m_pairs;
  std::set<std::pair<std::vector<std::size_t>, std::vector<std::size_t>>> m_fused; // parts that were tried
};

CGAL_CRUDE_REGISTRATION_INLINE Assembly_outcome assemble_reduced_scans(const std::vector<const Reduced_scan*>& scans,
                                                                       const Round_registration& register_round,
                                                                       const Surface_registration& register_surfaces,
                                                                       Execution execution, Run_control& control,
                                                                       const Known_poses& known)
{
  return Assembler(scans, register_round, register_surfaces, execution, control, known)();
}

CGAL_CRUDE_REGISTRATION_INLINE Assembly_outcome assemble_reduced_scans(const std::vector<const Reduced_scan*>& scans,
                                                                       const Pair_registration& register_pair,
                                                                       const Surface_registration& register_surfaces,
                                                                       Execution execution, Run_control& control,
                                                                       const Known_poses& known)
{
  const Round_registration register_round = [&](const std::vector<Input_pair>& pairs, Run_control& run_control) {
    std::vector<Pair_answer> answers(pairs.size());
    run_tasks(pairs.size(), execution, run_control, [&](std::size_t k, Run_control& task) {
      answers[k] = register_pair(pairs[k].source, pairs[k].target, task);
    });
    return answers;
  };
  return assemble_reduced_scans(scans, register_round, register_surfaces, execution, control, known);
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_ASSEMBLE_REDUCED_SCANS_IMPL_H
