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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_POSE_JUDGE_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_POSE_JUDGE_H

// The third step of a registration: proposed poses are refined, weighed by evidence, and told apart.

#include <CGAL/Crude_registration/internal/base/for_each_index.h>
#include <CGAL/Crude_registration/internal/judgement/Chance.h>
#include <CGAL/Crude_registration/internal/judgement/Judged_pose.h>
#include <CGAL/Crude_registration/internal/judgement/Proposals.h>
#include <CGAL/Crude_registration/internal/judgement/Verdict.h>
#include <CGAL/Crude_registration/internal/judgement/agreement.h>
#include <CGAL/Crude_registration/internal/judgement/estimate_poses.h>
#include <CGAL/Crude_registration/internal/judgement/log_odds.h>
#include <CGAL/Crude_registration/internal/judgement/on_body.h>
#include <CGAL/Crude_registration/internal/judgement/probe_outcomes.h>
#include <CGAL/Crude_registration/internal/judgement/spread.h>
#include <CGAL/Crude_registration/internal/judgement/variety.h>
#include <CGAL/Crude_registration/internal/motion/refine_step.h>
#include <CGAL/Crude_registration/internal/reduction/Reduced_scan.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

class Pose_judge
{
public:
  // The scans and the control are kept by reference.
  Pose_judge(const Reduced_scan& source, const Reduced_scan& target, Execution execution, Run_control& control,
             const Evidence_coefficients& coefficients = {})
      : m_source(source), m_target(target), m_execution(execution), m_control(control), m_coefficients(coefficients),
        m_few_source_probes(neighbouring_probes(source.fine, 800)),
        m_fine_source_probes(neighbouring_probes(source.fine, 2500)),
        m_fine_target_probes(neighbouring_probes(target.fine, 2500)),
        m_source_probes(neighbouring_probes(source.fine, evidence_probes)),
        m_target_probes(neighbouring_probes(target.fine, evidence_probes)), m_usual(usual_log_ratios(coefficients)),
        m_extent(float((std::min)(source.extent, target.extent))), m_fine_look(fine_look(source, target)),
        m_tolerance(probe_tolerance(source.fine, target.fine, m_fine_look.free_depth))
  {}

  // Refines and weighs what a round of the search proposes: of the poses the best, as many as are worth it, with no
  // more than a few from around each place. What the earlier rounds brought is weighed again, as each round tells more
  // of chance. Nothing is added if the run is stopped.
  void add_round(Proposals round)
  {
    std::vector<Estimated_pose> best;
    if (round.are_estimated)
      for (std::size_t i = 0; i < (std::min)(round.poses.size(), round.judged); ++i)
        best.push_back({round.poses[i], 0, i});
    else best = estimated_again(m_source, m_target, round.poses, round.judged, m_execution, m_control, round.tried);
    std::vector<Judged_pose> poses(best.size());
    for_each_index(m_execution, best.size(), m_control, [&](std::size_t i) {
      poses[i].pose = refined(best[i].pose);
      poses[i].proposed = round.poses[best[i].index];
      if (!round.correspondences.empty()) poses[i].correspondence = round.correspondences[best[i].index];
    });
    if (m_control.is_stopped()) return;
    add_candidates(round);
    if (m_control.is_stopped()) return;
    const std::size_t old = m_judged.size();
    m_judged.insert(m_judged.end(), poses.begin(), poses.end());
    m_judged_source_outcomes.resize(m_judged.size(), m_source_probes.size());
    m_judged_target_outcomes.resize(m_judged.size(), m_target_probes.size());
    m_chance.emplace(*this, m_tried_rows);
    m_fuller_chance.emplace(*this, m_all_rows);
    for_each_index(m_execution, m_judged.size(), to_the_end(), [&](std::size_t i) {
      std::uint8_t *const source = m_judged_source_outcomes[i], *const target = m_judged_target_outcomes[i];
      if (i >= old) look(m_judged[i].pose, source, target);
      weigh(m_judged[i], source, target);
    });
    m_tried.insert(m_tried.end(), round.tried.begin(), round.tried.end());
    refine_leaders();
  }

  // No more rounds will come.
  void end_rounds() { m_all_were_tried = true; }

  std::size_t number_of_judged() const { return m_judged.size(); }

  // Whether one is the whole surface of a body, and the other one is not, but may be a view of it.
  bool has_body() const { return m_source.is_body != m_target.is_body; }

  // The distinct poses of all rounds, most probable first: of each the best, with the proposal that is nearest to it of
  // those that have led there. Their probabilities and that of none of them add up to one. `by`: where the scans fit
  // each other in many ways, what is usual for this pair tells none from others. \pre has_body(), if they are judged by
  // it
  std::vector<Judged_pose> distinct_poses(Judged_by by = Judged_by::PAIR) const
  {
    std::vector<Judged_pose> sorted = m_judged, distinct;
    if (by == Judged_by::BODY)
      for_each_index(m_execution, sorted.size(), to_the_end(), [&](std::size_t i) { weigh_by_body(sorted[i]); });
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const Judged_pose& a, const Judged_pose& b) { return a.log_weight > b.log_weight; });
    for (const Judged_pose& p : sorted) {
      const auto same = std::find_if(distinct.begin(), distinct.end(),
                                     [&](const Judged_pose& d) { return are_one(p.pose, d.pose, m_extent); });
      if (same == distinct.end()) distinct.push_back(p);
      else if (is_nearer(p.proposed, same->proposed, same->pose, m_extent)) {
        same->proposed = p.proposed;
        same->correspondence = p.correspondence;
      }
    }
    share_probability(distinct, by);
    return distinct;
  }

  // What share_probability() of log_odds.h says of distinct poses that were weighed.
  void share_probability(std::vector<Judged_pose>& poses, Judged_by by) const
  {
    if (poses.empty()) return;
    Judged_pose& first = poses[std::size_t(leading(poses) - poses.begin())];
    add_variety_and_spread(first);
    internal::share_probability(poses, by != Judged_by::PAIR, m_all_were_tried,
                                by == Judged_by::BODY ? coefficients_of_body(m_coefficients) : m_coefficients);
  }

  // To the evidence of a pose what counts of a leading one alone: the logarithm of the number of planes in which lies
  // what agrees, by the mean of both scans, and how far apart that lies.
  void add_variety_and_spread(Judged_pose& leading) const
  {
    const std::vector<std::uint8_t> found = outcomes(leading.pose);
    const std::uint8_t *const of_source = found.data(), *const of_target = of_source + m_source_probes.size();
    leading.evidence.variety = -std::log((probability_of_one_plane(m_source_probes, of_source, m_tolerance) +
                                          probability_of_one_plane(m_target_probes, of_target, m_tolerance)) /
                                         2);
    const auto variance = [](const Probes& probes, const Reduced_scan& scan, const std::uint8_t* of_scan) {
      const auto spacing = double(scan.fine.spacing);
      return variance_of_agreeing(probes, of_scan, spacing * spacing);
    };
    leading.evidence.spread = spread(variance(m_source_probes, m_source, of_source),
                                     variance(m_target_probes, m_target, of_target), double(m_extent));
  }

  // A pose as it is.
  Agreement assess(const Pose& pose) const
  {
    return agreement(m_source, m_fine_source_probes, m_target, m_fine_target_probes, m_target.fine, pose, m_fine_look);
  }

  // A pose after refinement on the fine surfels.
  Pose refined(Pose pose) const
  {
    const float spacing = (std::max)(m_source.fine.spacing, m_target.fine.spacing),
                variance = m_tolerance.distance * m_tolerance.distance;
    // The first steps are the longest, and fewer probes tell them.
    for (float reach : {2.f, 2.f, 2.f, 1.25f})
      if (refine_step(m_few_source_probes, m_target.fine, {reach * spacing, 0.8f, variance}, pose) < 6) break;
    for (float reach : {1.25f, 0.75f})
      if (refine_step(m_fine_source_probes, m_target.fine, {reach * spacing, 0.8f, variance}, pose) < 6) break;
    return pose;
  }

  // Whether two poses count as one.
  bool are_same(const Pose& a, const Pose& b) const { return are_one(a, b, m_extent); }

  // A pose as it is, with what the evidence says of it.
  // \pre A round was added.
  Judged_pose weighed(const Pose& pose, Judged_by by = Judged_by::PAIR) const
  {
    Judged_pose judged;
    judged.pose = pose;
    const std::vector<std::uint8_t> found = outcomes(pose);
    weigh(judged, found.data(), found.data() + m_source_probes.size());
    if (by == Judged_by::BODY) weigh_by_body(judged);
    return judged;
  }

  // The same, of the weights that are compared along a motion: as chance is among all that is known of the pair.
  double weight_along_motion(const Pose& pose, Judged_by by) const
  {
    const Judged_pose judged = weighed(pose, by);
    if (by == Judged_by::BODY) return judged.log_weight;
    return log_weight(judged.evidence, by == Judged_by::USUAL ? judged.evidence.usual : judged.evidence.fuller);
  }

  // The distinct candidates so far, those of them that were tried, and what the probes of either scan meet under them.
  const std::vector<Pose>& candidates() const { return m_candidates; }
  const std::vector<std::size_t>& tried_candidates() const { return m_tried_rows; }
  const Outcome_table& source_outcomes() const { return m_source_outcomes; }
  const Outcome_table& target_outcomes() const { return m_target_outcomes; }

  // What the probes of the source meet under a pose, and behind them those of the target.
  std::vector<std::uint8_t> outcomes(const Pose& pose) const
  {
    std::vector<std::uint8_t> result(m_source_probes.size() + m_target_probes.size());
    look(pose, result.data(), result.data() + m_source_probes.size());
    return result;
  }

private:
  static constexpr std::size_t evidence_probes = 1500; // of either scan

  // Chance is known from so many distinct candidates, where there are as many: what the first round keeps, and twice as
  // many, more of which say the same.
  static constexpr std::size_t fewest_candidates = 32, most_candidates = 64;

  // What the probes of either scan meet by chance.
  struct Pair_chance
  {
    Pair_chance(const Pose_judge& judge, const std::vector<std::size_t>& rows)
        : source(judge.m_source_outcomes, rows, judge.m_coefficients),
          target(judge.m_target_outcomes, rows, judge.m_coefficients)
    {}

    Chance source, target;
  };

  // Where planes slide along each other, refinement ends beside the best pose, and from elsewhere in another place: the
  // leading poses that are in doubt are refined from each of the search's poses around them, too. The best one counts.
  void refine_leaders()
  {
    constexpr std::size_t most_leaders = 2; // the best and its rival
    std::vector<Judged_pose> leaders = distinct_poses();
    if (leaders.size() > most_leaders) leaders.resize(most_leaders);
    for (const Judged_pose& leader : leaders) {
      if (leader.by_law <= 1 - certain || leader.by_law >= certain) continue;
      std::vector<Pose> starts;
      for (const Pose& p : m_tried)
        if (are_one(p, leader.pose, m_extent)) starts.push_back(p);
      std::vector<Judged_pose> ends(starts.size(), leader);
      for_each_index(m_execution, starts.size(), to_the_end(), [&](std::size_t i) {
        const Judged_pose end = weighed(refined(starts[i]));
        if (end.log_weight > leader.log_weight) ends[i] = with_proposal(end, leader);
      });
      const auto best = std::max_element(ends.begin(), ends.end(), [](const Judged_pose& a, const Judged_pose& b) {
        return a.log_weight < b.log_weight;
      });
      if (best != ends.end() && best->log_weight > leader.log_weight) add(*best);
    }
  }

  static Judged_pose with_proposal(Judged_pose pose, const Judged_pose& of)
  {
    pose.proposed = of.proposed;
    pose.correspondence = of.correspondence;
    return pose;
  }

  void add(const Judged_pose& pose)
  {
    m_judged.push_back(pose);
    m_judged_source_outcomes.resize(m_judged.size(), m_source_probes.size());
    m_judged_target_outcomes.resize(m_judged.size(), m_target_probes.size());
    look(pose.pose, m_judged_source_outcomes[m_judged.size() - 1], m_judged_target_outcomes[m_judged.size() - 1]);
  }

  // Candidates that are none of the earlier ones: they crowd at some poses, and chance is one opinion a pose. Between
  // planes nearly all of them crowd, and some that were dropped are taken, too.
  void add_candidates(const Proposals& round)
  {
    std::vector<std::size_t> changed;
    const auto row_of = [&](const Pose& p) {
      return std::size_t(std::find_if(m_candidates.begin(), m_candidates.end(),
                                      [&](const Pose& q) { return are_one(p, q, m_extent); }) -
                         m_candidates.begin());
    };
    const auto put = [&](std::size_t row, const Pose& p) {
      if (row == m_candidates.size()) {
        m_candidates.emplace_back();
        m_all_rows.push_back(row);
      }
      m_candidates[row] = p;
      changed.push_back(row);
    };
    for (const Pose& p : round.tried) {
      if (m_tried_rows.size() == most_candidates) break;
      const std::size_t row = row_of(p);
      if (std::find(m_tried_rows.begin(), m_tried_rows.end(), row) != m_tried_rows.end()) continue;
      put(row, p);
      m_tried_rows.push_back(row);
    }
    for (const Pose& p : round.dropped) {
      if (m_candidates.size() >= fewest_candidates) break;
      const std::size_t row = row_of(p);
      if (row == m_candidates.size()) put(row, p);
    }
    m_source_outcomes.resize(m_candidates.size(), m_source_probes.size());
    m_target_outcomes.resize(m_candidates.size(), m_target_probes.size());
    for_each_index(m_execution, changed.size(), m_control, [&](std::size_t i) {
      const std::size_t row = changed[i];
      look(m_candidates[row], m_source_outcomes[row], m_target_outcomes[row]);
    });
  }

  void look(const Pose& pose, std::uint8_t* source, std::uint8_t* target) const
  {
    probe_outcomes(m_source_probes, m_target, pose, m_tolerance, source);
    probe_outcomes(m_target_probes, m_source, pose.inverse(), m_tolerance, target);
  }

  // `source`, `target`: the outcomes under the pose.
  void weigh(Judged_pose& judged, const std::uint8_t* source, const std::uint8_t* target) const
  {
    // The middle of each bin of the residuals.
    constexpr std::array<double, Outcome::residual_bins> residuals = {0.0625, 0.1875, 0.375, 0.75};
    double agreeing = 1, violating = 0, squares = residuals.back() * residuals.back(); // as if one more agreed, badly
    const auto add = [&](const std::uint8_t* outcomes, std::size_t n) {
      for (std::size_t i = 0; i < n; ++i) {
        const std::uint8_t o = outcomes[i];
        violating += double(o == Outcome::IN_FREE_SPACE);
        if (o == Outcome::UNKNOWN || o > Outcome::fits) continue;
        const double u = residuals[std::size_t(o - 1) / Outcome::angle_bins];
        squares += u * u;
        ++agreeing;
      }
    };
    add(source, m_source_probes.size());
    add(target, m_target_probes.size());
    const auto probes = double(m_source_probes.size() + m_target_probes.size());
    const auto evidence = [&](const Pair_chance& chance, const std::vector<std::size_t>& rows) {
      std::vector<std::size_t> near;
      for (const std::size_t k : rows)
        if (are_one(judged.pose, m_candidates[k], m_extent)) near.push_back(k);
      return (chance.source.evidence(source, near) + chance.target.evidence(target, near)) / probes;
    };
    judged.evidence.tried = evidence(*m_chance, m_tried_rows);
    judged.evidence.fuller = evidence(*m_fuller_chance, m_all_rows);
    judged.evidence.usual = (usual_evidence(source, m_source_probes.size(), m_usual) +
                             usual_evidence(target, m_target_probes.size(), m_usual)) /
                            probes;
    judged.evidence.residual = std::sqrt(squares / agreeing);
    judged.evidence.violations = violating / agreeing;
    judged.evidence.surfels = double((std::min)(m_source.fine.surfels.size(), m_target.fine.surfels.size()));
    // Where a body fits itself in several ways, most that was tried is one of these, and what they have in common says
    // nothing for any of them.
    judged.log_weight = log_weight(judged.evidence, judged.evidence.tried, m_coefficients);
  }

  // What of a view is off the body; as the body's laws weigh it. \pre It was weighed, and has_body().
  void weigh_by_body(Judged_pose& judged) const
  {
    const double off = m_target.is_body
                           ? share_off_body(m_source_probes, m_target.fine, judged.pose, m_tolerance)
                           : share_off_body(m_target_probes, m_source.fine, judged.pose.inverse(), m_tolerance);
    judged.evidence = with_share_off(judged.evidence, off);
    judged.log_weight = log_weight(judged.evidence, judged.evidence.usual, coefficients_of_body(m_coefficients));
  }

  const Reduced_scan& m_source;
  const Reduced_scan& m_target;
  const Execution m_execution;
  Run_control& m_control;
  const Evidence_coefficients m_coefficients;
  const Probes m_few_source_probes, m_fine_source_probes, m_fine_target_probes, m_source_probes, m_target_probes;
  const std::array<double, Outcome::SIZE> m_usual;
  const float m_extent;
  const Look m_fine_look;
  const Probe_tolerance m_tolerance;
  std::vector<Pose> m_candidates; // distinct; with what the probes of the source and of the target meet under them
  Outcome_table m_source_outcomes, m_target_outcomes;
  std::vector<std::size_t> m_tried_rows, m_all_rows;    // of the candidates: those that were tried, and all
  std::optional<Pair_chance> m_chance, m_fuller_chance; // by the ones, and by the others
  std::vector<Pose> m_tried;                            // of all rounds
  bool m_all_were_tried = false;
  std::vector<Judged_pose> m_judged;
  Outcome_table m_judged_source_outcomes, m_judged_target_outcomes;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_POSE_JUDGE_H
