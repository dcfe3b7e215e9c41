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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_ORIENTED_PAIR_SEARCH_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_ORIENTED_PAIR_SEARCH_H

// The default search: pairs of oriented points of one reduced scan, with witnesses, looked up in the other.

#include <CGAL/Crude_registration/internal/base/Counter_random.h>
#include <CGAL/Crude_registration/internal/base/for_each_index.h>
#include <CGAL/Crude_registration/internal/judgement/agreement.h>
#include <CGAL/Crude_registration/internal/judgement/estimate_poses.h>
#include <CGAL/Crude_registration/internal/lookup/Point_grid.h>
#include <CGAL/Crude_registration/internal/lookup/Probes.h>
#include <CGAL/Crude_registration/internal/lookup/Surfel_pair_index.h>
#include <CGAL/Crude_registration/internal/matching/Candidate_source.h>
#include <CGAL/Crude_registration/internal/matching/Matched_pair.h>
#include <CGAL/Crude_registration/internal/matching/Oriented_pair_parameters.h>
#include <CGAL/Crude_registration/internal/matching/Witness.h>
#include <CGAL/Crude_registration/internal/reduction/Reduced_scan.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Proposes poses by pairs of oriented points: pairs (V, v1) of the source's surfels, with their normals and curvatures,
// find pairs (C, c1) of the target's in an index (the sphere of section 6 of the paper, and the turn on the circle,
// which the normals give); v2 and v3, on either side of the line, have to find a counterpart where the motion takes
// them (the fourth vertex), and so have most of some further witnesses around. What is left is scored on the whole
// scan, with free space.
class Oriented_pair_search : public Candidate_source
{
public:
  // The scans are kept by reference.
  // \pre Both scans have at least four surfels.
  Oriented_pair_search(const Reduced_scan& source, const Reduced_scan& target, Oriented_pair_parameters parameters,
                       Execution execution)
      : m_source(source), m_target(target), m_parameters(std::move(parameters)), m_execution(execution),
        m_source_probes(ordered_probes(source.coarse)), m_target_probes(ordered_probes(target.coarse))
  {
    m_spacing = (std::max)(source.coarse.spacing, target.coarse.spacing);
    m_extent = float((std::min)(source.extent, target.extent));
    // Normals of surfels side by side on smooth bodies differ by up to 0.33.
    const float turn = (std::max)(source.coarse.normal_noise, target.coarse.normal_noise);
    const float noise = (std::max)(turn / 0.33f, 1.f);
    m_curvature_noise = (std::min)(noise * std::sqrt(noise), 1.8f);
    std::vector<Vector> points;
    points.reserve(source.coarse.surfels.size());
    for (const Surfel& s : source.coarse.surfels) points.push_back(s.position.cast<double>());
    m_grid = Point_grid(points, double(2 * m_spacing));
    // A ribbon, all of whose surfels are on the border, has no origins.
    for (const std::int32_t v : shuffled(source.coarse.surfels.size(), 1))
      if (!source.coarse.borders[std::size_t(v)]) m_origins.push_back(v);
  }

  // The distinct candidates of the next round.
  std::optional<Proposals> next(Run_control& control) override
  {
    if (m_origins.empty() || m_next_round == m_parameters.rounds.size()) return std::nullopt;
    Proposals proposals;
    const Oriented_pair_round& round = m_parameters.rounds[m_next_round++];
    ++m_rounds.count;
    const Stage_timer timer(m_rounds);
    std::vector<Candidate> candidates = match(choose_pairs(round), round, control);
    const Stage_timer score_timer(m_scores);
    m_scores.count += candidates.size();
    // More probes for fewer candidates: most are told to be wrong by the first few.
    narrow(candidates, 12, (std::max)(8 * round.kept, candidates.size() / 8), control);
    proposals.dropped = first_distinct(candidates, m_parameters.rounds.front().kept, m_extent);
    narrow(candidates, 40, 4 * round.kept, control);
    score(candidates, 100, 0, candidates.size(), control);
    std::vector<Pose> kept;
    std::vector<Matched_pair> pairs;
    for (const Candidate& c : candidates) {
      if (kept.size() == round.kept) break;
      if (std::any_of(kept.begin(), kept.end(), [&](const Pose& p) { return are_close(c.pose, p, m_spacing); }))
        continue;
      kept.push_back(c.pose);
      pairs.push_back(c.pair);
    }
    // A pair fixes its motion to some degrees only; all that agrees under it tells more.
    for (const Estimated_pose& p :
         estimated_again(m_source, m_target, kept, round.judged, m_execution, control, proposals.tried)) {
      proposals.poses.push_back(p.pose);
      proposals.correspondences.push_back(correspondence(pairs[p.index], m_source.coarse, m_target.coarse));
    }
    proposals.are_estimated = true;
    proposals.judged = round.judged;
    return proposals;
  }

  // The last round is most of the work.
  double progress() const override { return m_next_round + 1 < m_parameters.rounds.size() ? 0 : 0.25; }

  std::vector<Stage_record> stages() const override { return {m_rounds, m_pairs, m_looks, m_scores}; }

private:
  // Planes and spheres match themselves everywhere; so many candidates are enough to show it.
  static constexpr std::size_t most_candidates = 100000;

  struct Candidate
  {
    Pose pose;
    float score;
    Matched_pair pair;
  };

  struct Source_pair
  {
    std::int32_t first, second;
    Pair_angles angles;
    std::uint32_t count; // of target pairs to look at
    std::uint8_t scale;
  };

  void index_scales(const std::vector<double>& scales)
  {
    const std::size_t old = m_indices.size();
    for (const double scale : scales)
      if (std::none_of(m_indices.begin(), m_indices.end(), [&](const auto& i) { return i.first == scale; }))
        m_indices.emplace_back(scale, Surfel_pair_index());
    for_each_index(m_execution, m_indices.size() - old, to_the_end(), [&](std::size_t i) {
      auto& [scale, index] = m_indices[old + i];
      index = Surfel_pair_index(m_target.coarse.surfels, m_parameters.length(scale) * m_extent,
                                m_parameters.target_half_width * m_spacing);
    });
  }

  // \pre `scale` is indexed
  const Surfel_pair_index& index_of_scale(double scale) const
  {
    return std::find_if(m_indices.begin(), m_indices.end(), [&](const auto& i) { return i.first == scale; })->second;
  }

  // Leaves the best, by the score of that many probes: others for each candidate, since the candidates near the right
  // pose are many, and any few probes may all lie outside of the overlap.
  void narrow(std::vector<Candidate>& candidates, std::size_t probes, std::size_t left, Run_control& control) const
  {
    if (candidates.size() > left) score(candidates, probes, probes, left, control);
  }

  // Scores the candidates by that many probes of either scan, from `stride` further on for each candidate; the best
  // `left` of them are left, the best first. In blocks: what is seen to be worse than that many before it is not looked
  // at to the end.
  void score(std::vector<Candidate>& candidates, std::size_t probes, std::size_t stride, std::size_t left,
             Run_control& control) const
  {
    const Look look{m_parameters.distance * m_spacing, m_parameters.minimal_cosine, 1.2f * m_spacing};
    constexpr std::size_t block = 1024;
    float least = std::numeric_limits<float>::lowest();
    std::vector<float> best_scores;
    for (std::size_t from = 0; from < candidates.size(); from += block) {
      const std::size_t n = (std::min)(block, candidates.size() - from);
      for_each_index(m_execution, n, control, [&](std::size_t k) {
        const std::size_t i = from + k;
        candidates[i].score = agreement(m_source, Some_probes(m_source_probes, i * stride, probes), m_target,
                                        Some_probes(m_target_probes, i * stride, probes), m_target.coarse,
                                        candidates[i].pose, look, least)
                                  .score();
      });
      for (std::size_t k = 0; k < n; ++k) best_scores.push_back(candidates[from + k].score);
      if (best_scores.size() <= left) continue;
      const auto last = best_scores.begin() + std::ptrdiff_t(left - 1);
      std::nth_element(best_scores.begin(), last, best_scores.end(), std::greater<>());
      best_scores.resize(left);
      least = best_scores.back();
    }
    std::vector<std::size_t> order(candidates.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    const auto is_better = [&](std::size_t a, std::size_t b) {
      return candidates[a].score != candidates[b].score ? candidates[a].score > candidates[b].score : a < b;
    };
    if (left < order.size()) {
      std::nth_element(order.begin(), order.begin() + std::ptrdiff_t(left), order.end(), is_better);
      order.resize(left);
    }
    std::sort(order.begin(), order.end(), is_better);
    std::vector<Candidate> best;
    best.reserve(order.size());
    for (const std::size_t i : order) best.push_back(candidates[i]);
    candidates.swap(best);
  }

  // Pairs (V, v1) of the source for the next origins.
  std::vector<Source_pair> choose_pairs(const Oriented_pair_round& round)
  {
    const Stage_timer timer(m_pairs);
    std::vector<Source_pair> pairs;
    // The surfels around an origin at each of the lengths; they are collected without a branch.
    std::vector<std::vector<std::int32_t>> shells(round.scales.size(),
                                                  std::vector<std::int32_t>(m_source.coarse.surfels.size() + 1));
    std::vector<std::size_t> sizes(shells.size());
    const float width = m_parameters.source_half_width * m_spacing;
    std::vector<float> lengths;
    for (const double scale : round.scales) lengths.push_back(m_parameters.length(scale) * m_extent);
    const float longest = lengths.front() + width;
    const auto least = float(m_parameters.minimum_extent) * m_extent,
               greatest = float(m_parameters.maximum_extent) * m_extent;
    index_scales(round.scales);
    for (int o = 0; o < round.origins && m_next_origin < m_origins.size(); ++o, ++m_next_origin) {
      const std::int32_t v = m_origins[m_next_origin];
      const Surfel& origin = m_source.coarse.surfels[std::size_t(v)];
      std::fill(sizes.begin(), sizes.end(), std::size_t(0));
      m_grid.for_each_within(origin.position.cast<double>(), double(longest), [&](std::int32_t j, double d2) {
        const float d = std::sqrt(float(d2));
        const int is_one = int(m_source.coarse.borders[std::size_t(j)] == 0) & int(d >= least) & int(d <= greatest);
        for (std::size_t k = 0; k < shells.size(); ++k) {
          shells[k][sizes[k]] = j;
          sizes[k] += std::size_t(is_one & int(std::abs(d - lengths[k]) <= width));
        }
      });
      for (std::size_t k = 0; k < shells.size(); ++k) {
        const Surfel_pair_index& index = index_of_scale(round.scales[k]);
        for (int n = 0; n < round.pairs && sizes[k] > 0; ++n) {
          const std::size_t r = Counter_random::mixed(std::uint64_t(v) * 64 + std::uint64_t(n)) % sizes[k];
          Source_pair p;
          p.first = v;
          p.second = shells[k][r];
          shells[k][r] = shells[k][--sizes[k]];
          p.scale = std::uint8_t(k);
          if (!pair_angles(origin, m_source.coarse.surfels[std::size_t(p.second)], p.angles)) continue;
          p.count = std::uint32_t(index.count(p.angles));
          if (p.count > 0) pairs.push_back(p);
        }
      }
    }
    if (m_next_origin == m_origins.size()) m_next_origin = 0;
    m_pairs.count += pairs.size();
    return pairs;
  }

  // A pair that is looked at, and how its matches are examined.
  struct Chosen_pair
  {
    const Source_pair* pair;
    Witness_rule rule;
  };

  // Those that the round's looks suffice for, as many for each scale. The rarest in the target say the most for each
  // look. But where the scans have little in common, what is rarest in the target is what it has not seen: so a round
  // that is to find such scans, too, looks at pairs at random as well, with nearer witnesses.
  std::vector<Chosen_pair> affordable(const std::vector<Source_pair>& pairs, const Oriented_pair_round& round) const
  {
    std::vector<Chosen_pair> chosen;
    std::vector<bool> is_chosen(pairs.size(), false);
    const auto choose = [&](const std::vector<std::int32_t>& order, double share, const Witness_rule& rule) {
      std::vector<std::size_t> looks(round.scales.size(),
                                     std::size_t(share * double(round.looks)) / round.scales.size());
      for (const std::int32_t i : order) {
        const Source_pair& p = pairs[std::size_t(i)];
        if (is_chosen[std::size_t(i)] || looks[p.scale] < p.count) continue;
        looks[p.scale] -= p.count;
        is_chosen[std::size_t(i)] = true;
        chosen.push_back({&p, rule});
      }
    };
    std::vector<std::int32_t> order(pairs.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](std::int32_t i, std::int32_t j) {
      return pairs[std::size_t(i)].count < pairs[std::size_t(j)].count;
    });
    choose(order, 1 - round.at_random, m_parameters.of_rarest);
    if (round.at_random > 0) choose(shuffled(pairs.size(), 2), round.at_random, m_parameters.of_random);
    return chosen;
  }

  // What a pair of the source matches.
  struct Matches
  {
    std::size_t looks = 0;
    std::vector<Candidate> candidates;
  };

  // The candidates of the pairs, as far as the round's number of looks goes.
  std::vector<Candidate> match(const std::vector<Source_pair>& pairs, const Oriented_pair_round& round,
                               Run_control& control)
  {
    const Stage_timer timer(m_looks);
    const std::vector<Chosen_pair> chosen = affordable(pairs, round);
    // In blocks that are the same whatever the number of threads, and that hold no more matches than are wanted: of
    // planes and spheres a single pair has thousands.
    constexpr std::size_t block = 128;
    std::vector<Candidate> candidates;
    for (std::size_t from = 0, to = 0; from < chosen.size() && candidates.size() <= most_candidates && control.go_on();
         from = to) {
      for (std::size_t n = candidates.size(); to < chosen.size() && to - from < block && n <= most_candidates; ++to)
        n += chosen[to].pair->count;
      std::vector<Matches> found(to - from);
      for_each_index(m_execution, found.size(), control,
                     [&](std::size_t i) { found[i] = match(chosen[from + i], round); });
      for (const Matches& m : found) {
        m_looks.count += m.looks;
        candidates.insert(candidates.end(), m.candidates.begin(), m.candidates.end());
      }
    }
    return candidates;
  }

  Matches match(const Chosen_pair& chosen, const Oriented_pair_round& round) const
  {
    const Source_pair& p = *chosen.pair;
    Matches matches;
    std::vector<Witness> witnesses;
    if (!choose_witnesses(m_source.coarse, m_grid, p.first, p.second,
                          (std::max)(chosen.rule.reach * m_extent, 4 * m_spacing), m_parameters.witnesses, witnesses))
      return matches;
    const Surfel &a = m_source.coarse.surfels[std::size_t(p.first)],
                 &b = m_source.coarse.surfels[std::size_t(p.second)];
    const Vector_f middle = 0.5f * (a.position + b.position);
    const Matrix_f source_frame = pair_frame(a, b).transpose();
    const std::array<std::uint16_t, 2> source_pair = {std::uint16_t(p.first), std::uint16_t(p.second)};
    const Curvature_window window(Pair_curvatures::of(a, b), int(float(round.curvature_tolerance) * m_curvature_noise));
    const Witness_tolerance tolerance{m_parameters.distance * m_spacing, m_parameters.minimal_cosine};
    Pairs_with_counterpart first_witness(witnesses.front(), m_target.coarse, tolerance);
    const Witness_rows further_witnesses(witnesses, 2);
    const auto examine = [&](const Pairs_with_counterpart::Found_pair& found) {
      const Pose& there = found.place;
      if (!has_counterpart(witnesses[1], there, m_target.coarse, tolerance) ||
          !further_witnesses.have_counterparts(chosen.rule.needed - 2, there, m_target.coarse, tolerance))
        return;
      Pose pose;
      pose.rotation = there.rotation * source_frame;
      pose.translation = there.translation - pose.rotation * middle;
      matches.candidates.push_back({pose, 0, {source_pair, {found.pair.first, found.pair.second}}});
    };
    std::array<Surfel_pair_index::Entry, Pairs_with_counterpart::most> hits;
    std::array<Pairs_with_counterpart::Found_pair, Pairs_with_counterpart::most> found;
    std::size_t number_of_hits = 0;
    const auto examine_hits = [&] {
      const std::size_t n = first_witness.find(hits, number_of_hits, found);
      for (std::size_t i = 0; i < n; ++i) examine(found[i]);
      number_of_hits = 0;
    };
    const auto look = [&](const Surfel_pair_index::Entry* from, const Surfel_pair_index::Entry* to) {
      matches.looks += std::size_t(to - from);
      // Some at a time, without a branch: which of them have the curvatures cannot be foretold.
      const Curvature_window w = window; // that no hit is written to
      while (from != to) {
        std::size_t n = number_of_hits;
        const auto* const end = from + (std::min)(to - from, std::ptrdiff_t(hits.size() - n));
        for (; from != end; ++from) {
          hits[n] = *from;
          n += w.contains(from->curvatures);
        }
        number_of_hits = n;
        if (n == hits.size()) examine_hits();
      }
    };
    index_of_scale(round.scales[p.scale]).for_each_run(p.angles, look);
    if (number_of_hits > 0) examine_hits();
    return matches;
  }

  const Reduced_scan& m_source;
  const Reduced_scan& m_target;
  const Oriented_pair_parameters m_parameters;
  const Execution m_execution;
  const Probes m_source_probes, m_target_probes;
  float m_spacing = 0, m_extent = 0, m_curvature_noise = 1;
  Point_grid m_grid;
  std::vector<std::int32_t> m_origins;
  std::vector<std::pair<double, Surfel_pair_index>> m_indices; // by scale
  std::size_t m_next_origin = 0, m_next_round = 0;
  Stage_record m_rounds{"propose"}, m_pairs{"propose: pairs"}, m_looks{"propose: looks"}, m_scores{"propose: scores"};
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_ORIENTED_PAIR_SEARCH_H
