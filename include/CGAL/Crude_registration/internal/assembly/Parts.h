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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_PARTS_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_PARTS_H

// Joins scans to parts of a model by the motions that their pairs may have, the best supported first.

#include <CGAL/Crude_registration/internal/assembly/Assembly_coefficients.h>
#include <CGAL/Crude_registration/internal/assembly/Known_poses.h>
#include <CGAL/Crude_registration/internal/assembly/Pair_answer.h>
#include <CGAL/Crude_registration/internal/assembly/Placed_scans.h>
#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Scans that lie in one frame.
struct Part
{
  std::vector<std::size_t> scans; // ascending
};

// A way to put two parts together.
struct Join
{
  std::size_t first = 0, second = 0; // parts
  Rigid_motion motion;               // to the frame of the first from that of the second
  double probability = 0;            // that it is right
  double overlap = 0;                // of the best pair that says so
  std::size_t agreeing = 0;          // pairs that say so
  std::size_t certain = 0;           // those of them that are certain alone
  std::size_t contradicting = 0;     // pairs that were registered otherwise
  double violations = 0;             // the largest share of a scan in the free space of the other part
};

// What is believed: only what a pair says that is certain alone, or also what several say that are not. Several such
// pairs may well agree in what is wrong, where a body has parts that look alike: scans that see the same of it are
// misled together.
enum class Trust
{
  CERTAIN_PAIRS,
  ALL_PAIRS
};

// The probability from which on parts are joined.
constexpr double trusted_join = 0.9;

// The parts that scans make by the pairs that were tried: a forest that grows by the join that is most to be believed.
//
// A relative motion of two parts is a hypothesis that all pairs between them vote on. With p_q the probability that
// pair q gives to the motion of the hypothesis, and r_q what it leaves for motions that it does not name, the
// likelihood is
//   c prod_q p_q / c  over the pairs that agree,  times  prod_q r_q  over the others,
// as the motions of two pairs agree by chance in one of 1/c cases only; it is compared with the other hypotheses and
// with that of none being right, prod_q r_q. What lies in free space counts as it does in the judgement of a pair.
class Parts
{
public:
  // `known`: in the order of the scans, of their own frames.
  Parts(const Placed_scans& placed, std::vector<Tried_pair> pairs, Trust trust, const Known_poses& known,
        const Assembly_coefficients& coefficients = {})
      : m_placed(placed), m_pairs(std::move(pairs)), m_trust(trust), m_known(known), m_coefficients(coefficients),
        m_poses(placed.size()), m_part_of(placed.size())
  {
    for (std::size_t i = 0; i < placed.size(); ++i) {
      m_parts.push_back({{i}});
      m_part_of[i] = i;
    }
    if (known.are_fixed) put_together_what_is_fixed();
    for (std::size_t q = 0; q < m_pairs.size(); ++q) {
      const std::size_t a = m_part_of[m_pairs[q].scans.first], b = m_part_of[m_pairs[q].scans.second];
      if (a != b && !m_pairs[q].answer.motions.empty()) m_between[{(std::min)(a, b), (std::max)(a, b)}].push_back(q);
    }
    for (const auto& entry : m_between) add_join(entry.first.first, entry.first.second);
    while (join_best()) {
    }
  }

  const std::vector<Rigid_motion>& poses() const { return m_poses; } // part from own
  bool are_together(std::size_t i, std::size_t j) const { return m_part_of[i] == m_part_of[j]; }

  // Those that hold scans, each by ascending scans; by their first scans.
  std::vector<Part> parts() const
  {
    std::vector<Part> result;
    for (const Part& p : m_parts)
      if (!p.scans.empty()) result.push_back(p);
    std::sort(result.begin(), result.end(),
              [](const Part& a, const Part& b) { return a.scans.front() < b.scans.front(); });
    return result;
  }

  // What was looked at between parts and not believed.
  std::vector<Join> refused() const
  {
    std::vector<Join> result;
    for (const auto& entry : m_joins) result.push_back(entry.second);
    return result;
  }

  // The part of a scan as Join numbers it.
  std::size_t part_of(std::size_t scan) const { return m_part_of[scan]; }

  // Whether a motion of a pair, j from i, is that of the poses.
  static bool agrees(const Placed_scans& placed, const Scan_pair& pair, const Rigid_motion& motion,
                     const Rigid_motion& other)
  {
    // The motions that the registration of a pair tells apart are a twentieth of the scan's extent apart.
    constexpr double distinct = 0.05;
    const double extent = (std::min)(placed.scan(pair.first).extent, placed.scan(pair.second).extent);
    return placed.displacement(pair.first, motion, other) <= distinct * extent;
  }

private:
  using Key = std::pair<std::size_t, std::size_t>; // parts, the smaller number first

  void put_together_what_is_fixed()
  {
    std::map<std::size_t, std::size_t> part_of_group;
    for (std::size_t i = 0; i < m_placed.size(); ++i) {
      const Known_pose* pose = m_known.of(i);
      if (!pose) continue;
      m_poses[i] = pose->motion;
      const std::size_t part = part_of_group.emplace(pose->group, i).first->second;
      if (part == i) continue;
      m_parts[part].scans.push_back(i);
      m_parts[i].scans.clear();
      m_part_of[i] = part;
    }
  }

  // Hints say of two parts what a pair says that is as likely right as not, once for all of their scans: this is what
  // it makes of the likelihood of a hypothesis; nullopt where there is no hint.
  std::optional<double> vote_of_hints(const Join& join) const
  {
    constexpr double even = 0.5;
    bool is_hinted = false;
    for (const std::size_t a : m_parts[join.first].scans)
      for (const std::size_t b : m_parts[join.second].scans) {
        if (!m_known.are_related(a, b)) continue;
        is_hinted = true;
        const Rigid_motion hinted = m_known.of(a)->motion.inverse() * m_known.of(b)->motion;
        if (m_placed.displacement(b, hinted, m_poses[a].inverse() * join.motion * m_poses[b]) <=
            hint_tolerance * m_placed.deviation(b))
          return even / m_coefficients.agreeing;
      }
    if (!is_hinted) return std::nullopt;
    return even;
  }

  double probability(const Ranked_motion& m) const { return (std::min)(m.probability, 1 - m_coefficients.wrong); }

  double rest(const Pair_answer& answer) const
  {
    double sum = 0;
    for (const Ranked_motion& m : answer.motions) sum += m.probability;
    return (std::max)(1 - sum, m_coefficients.wrong);
  }

  // The motion of the parts' frames, first from second, that a motion of a pair between them means.
  Rigid_motion between_parts(const Tried_pair& pair, const Rigid_motion& motion, std::size_t first) const
  {
    const std::size_t i = pair.scans.first, j = pair.scans.second;
    const Rigid_motion i_from_j = m_poses[i] * motion.inverse() * m_poses[j].inverse();
    return m_part_of[i] == first ? i_from_j : i_from_j.inverse();
  }

  // The motion of a pair, second from first, that follows from one of the parts.
  Rigid_motion of_pair(const Tried_pair& pair, const Rigid_motion& between, std::size_t first) const
  {
    const std::size_t i = pair.scans.first, j = pair.scans.second;
    const Rigid_motion i_from_j = m_part_of[i] == first ? between : between.inverse();
    return m_poses[j].inverse() * i_from_j.inverse() * m_poses[i];
  }

  // The likelihood of a hypothesis by the votes of all pairs.
  double vote(const std::vector<std::size_t>& pairs, Join& join) const
  {
    const double chance = m_coefficients.agreeing;
    double likelihood = chance;
    join.agreeing = join.certain = join.contradicting = 0;
    join.overlap = 0;
    for (const std::size_t q : pairs) {
      const Tried_pair& pair = m_pairs[q];
      const Rigid_motion motion = of_pair(pair, join.motion, join.first);
      double agreeing = 0;
      bool is_certain = false;
      for (const Ranked_motion& m : pair.answer.motions)
        if (probability(m) > agreeing && agrees(m_placed, pair.scans, m.motion, motion)) {
          agreeing = probability(m);
          is_certain = m.is_registered;
        }
      if (agreeing > chance) {
        likelihood *= agreeing / chance;
        ++join.agreeing;
        join.certain += is_certain;
        join.overlap = (std::max)(join.overlap, pair.answer.overlap);
      } else {
        likelihood *= rest(pair.answer);
        join.contradicting += pair.answer.status == REGISTERED;
      }
    }
    return likelihood;
  }

  // The largest share of a scan that lies in the free space of the other part.
  double violations(const Join& join) const
  {
    double largest = 0;
    const auto look = [&](const Part& part, const Part& other, const Rigid_motion& motion) {
      for (const std::size_t i : part.scans) {
        std::vector<std::uint8_t> is_violating(Placed_scans::number_of_probes, 0);
        for (const std::size_t j : other.scans)
          m_placed.meeting(i, j, m_poses[j].inverse() * motion * m_poses[i], &is_violating);
        const auto n = std::count(is_violating.begin(), is_violating.end(), 1);
        largest = (std::max)(largest, double(n) / double(Placed_scans::number_of_probes));
      }
    };
    look(m_parts[join.second], m_parts[join.first], join.motion);
    look(m_parts[join.first], m_parts[join.second], join.motion.inverse());
    return largest;
  }

  // Finds the best way to join two parts, if a pair says how.
  void add_join(std::size_t first, std::size_t second)
  {
    const auto pairs = m_between.find({first, second});
    if (pairs == m_between.end()) return;
    double none = 1;
    for (const std::size_t q : pairs->second) none *= rest(m_pairs[q].answer);
    bool is_hinted = false;
    std::vector<std::pair<double, Join>> hypotheses;
    for (const std::size_t q : pairs->second)
      for (const Ranked_motion& m : m_pairs[q].answer.motions) {
        Join join;
        join.first = first;
        join.second = second;
        join.motion = between_parts(m_pairs[q], m.motion, first);
        const double likelihood = vote(pairs->second, join);
        const std::optional<double> hints = m_known.are_fixed ? std::nullopt : vote_of_hints(join);
        is_hinted = hints.has_value();
        hypotheses.emplace_back(likelihood * hints.value_or(1), join);
      }
    if (is_hinted) none *= 0.5;
    std::stable_sort(hypotheses.begin(), hypotheses.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    // Free space is looked at for the best ones only.
    constexpr std::size_t most = 4;
    std::vector<std::pair<double, Join>> distinct;
    for (const auto& h : hypotheses) {
      if (distinct.size() == most) break;
      const auto is_same = [&](const auto& other) {
        return std::all_of(m_parts[second].scans.begin(), m_parts[second].scans.end(), [&](std::size_t i) {
          return agrees(m_placed, {i, i}, h.second.motion * m_poses[i], other.second.motion * m_poses[i]);
        });
      };
      if (std::any_of(distinct.begin(), distinct.end(), is_same)) continue;
      distinct.push_back(h);
    }
    // Nor where no motion would be trusted if none of the scans were in free space: it takes every scan with every
    // other.
    const bool is_hopeless = std::all_of(distinct.begin(), distinct.end(),
                                         [&](const auto& h) { return h.first < trusted_join * (none + h.first); });
    double sum = none;
    for (auto& h : distinct) {
      if (!is_hopeless) h.second.violations = violations(h.second);
      h.first *=
          std::exp(-m_coefficients.free_space * (std::max)(0., h.second.violations - m_coefficients.at_the_rims));
      sum += h.first;
    }
    const auto best = std::max_element(distinct.begin(), distinct.end(),
                                       [](const auto& a, const auto& b) { return a.first < b.first; });
    if (best == distinct.end()) return;
    best->second.probability = best->first / sum;
    m_joins[{first, second}] = best->second;
  }

  bool join_best()
  {
    const auto merit = [](const Join& j) { return j.probability * (0.1 + j.overlap); };
    auto best = m_joins.end();
    for (auto j = m_joins.begin(); j != m_joins.end(); ++j)
      if (j->second.probability >= trusted_join && (m_trust == Trust::ALL_PAIRS || j->second.certain > 0) &&
          (best == m_joins.end() || merit(j->second) > merit(best->second)))
        best = j;
    if (best == m_joins.end()) return false;
    const Join join = best->second;
    for (const std::size_t i : m_parts[join.second].scans) {
      m_poses[i] = join.motion * m_poses[i];
      m_part_of[i] = join.first;
    }
    std::vector<std::size_t>&into = m_parts[join.first].scans, &from = m_parts[join.second].scans;
    into.insert(into.end(), from.begin(), from.end());
    std::sort(into.begin(), into.end());
    from.clear();
    // The pairs of the second part with others are pairs of the first part now.
    std::map<Key, std::vector<std::size_t>> between;
    std::vector<std::size_t> touched;
    for (auto& entry : m_between) {
      const auto renamed = [&](std::size_t p) { return p == join.second ? join.first : p; };
      const std::size_t a = renamed(entry.first.first), b = renamed(entry.first.second);
      if (a == b) continue;
      std::vector<std::size_t>& pairs = between[{(std::min)(a, b), (std::max)(a, b)}];
      pairs.insert(pairs.end(), entry.second.begin(), entry.second.end());
      if (a == join.first || b == join.first) touched.push_back(a == join.first ? b : a);
    }
    for (auto& entry : between) std::sort(entry.second.begin(), entry.second.end());
    m_between.swap(between);
    for (auto j = m_joins.begin(); j != m_joins.end();) {
      const auto is_of = [&](std::size_t p) { return j->first.first == p || j->first.second == p; };
      j = is_of(join.first) || is_of(join.second) ? m_joins.erase(j) : std::next(j);
    }
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    for (const std::size_t other : touched) add_join((std::min)(join.first, other), (std::max)(join.first, other));
    return true;
  }

  const Placed_scans& m_placed;
  const std::vector<Tried_pair> m_pairs;
  const Trust m_trust;
  const Known_poses& m_known;
  const Assembly_coefficients m_coefficients;
  std::vector<Rigid_motion> m_poses;
  std::vector<std::size_t> m_part_of;
  std::vector<Part> m_parts;
  std::map<Key, std::vector<std::size_t>> m_between; // indices of pairs
  std::map<Key, Join> m_joins;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_PARTS_H
