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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_LOOP_EVIDENCE_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_LOOP_EVIDENCE_H

// What the loops of three pairs say about the motions of each of them.

#include <CGAL/Crude_registration/internal/assembly/Pair_answer.h>
#include <CGAL/Crude_registration/internal/assembly/Parts.h>
#include <CGAL/Crude_registration/internal/assembly/Placed_scans.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The pairs with the probabilities that their motions have once all loops of three are looked at, as in one round of
// belief propagation. Let two motions of a loop be right with probability p together, and close a loop by chance in a
// share c of the cases. The third one is then seen to close it in p + (1 - p) c of the cases if it is right, and in c
// if it is wrong; the ratio of the two, or of what is left of both, multiplies its odds against the pair's other
// motions.
// That nothing closes a loop speaks against a motion only where the two others are certain alone.
inline std::vector<Tried_pair> with_loop_evidence(const Placed_scans& placed, const std::vector<Tried_pair>& pairs,
                                                  const Assembly_coefficients& coefficients = {})
{
  const double chance = coefficients.closing;
  // What is less than the share that is wrong of what is certain says nothing.
  const double least = coefficients.wrong;
  struct Way // from one scan to another by a third one
  {
    Rigid_motion motion;
    double probability;
  };
  const std::size_t n = placed.size();
  std::vector<std::vector<std::size_t>> at(n);
  for (std::size_t q = 0; q < pairs.size(); ++q)
    if (!pairs[q].answer.motions.empty()) {
      at[pairs[q].scans.first].push_back(q);
      at[pairs[q].scans.second].push_back(q);
    }
  const auto motion_from = [&](const Tried_pair& pair, const Ranked_motion& m, std::size_t from) {
    return pair.scans.first == from ? m.motion : m.motion.inverse();
  };
  const auto other_end = [](const Tried_pair& pair, std::size_t scan) {
    return pair.scans.first == scan ? pair.scans.second : pair.scans.first;
  };
  std::vector<Tried_pair> result = pairs;
  for (Tried_pair& pair : result) {
    std::vector<Ranked_motion>& motions = pair.answer.motions;
    if (motions.empty()) continue;
    std::vector<double> evidence(motions.size(), 0); // logarithms of the ratios
    std::map<std::size_t, std::size_t> of_third;     // pair of first and third
    for (const std::size_t q : at[pair.scans.first]) of_third.emplace(other_end(pairs[q], pair.scans.first), q);
    for (const std::size_t r : at[pair.scans.second]) {
      const std::size_t third = other_end(pairs[r], pair.scans.second);
      const auto found = of_third.find(third);
      if (third == pair.scans.first || found == of_third.end()) continue;
      std::vector<Way> ways;
      double all = 0;
      for (const Ranked_motion& a : pairs[found->second].answer.motions)
        for (const Ranked_motion& b : pairs[r].answer.motions) {
          const double p = a.probability * b.probability;
          if (p < least) continue;
          if (a.is_registered && b.is_registered) all += p;
          ways.push_back({motion_from(pairs[r], b, third) * motion_from(pairs[found->second], a, pair.scans.first), p});
        }
      if (ways.empty()) continue;
      for (std::size_t k = 0; k < motions.size(); ++k) {
        double closing = 0;
        for (const Way& way : ways)
          if (Parts::agrees(placed, pair.scans, motions[k].motion, way.motion))
            closing = (std::max)(closing, way.probability);
        evidence[k] +=
            closing > 0 ? std::log((closing + (1 - closing) * chance) / chance) : std::log((1 - all * (1 - chance)));
      }
    }
    double rest = 1, sum = 0;
    for (const Ranked_motion& m : motions) rest -= m.probability;
    rest = (std::max)(rest, least);
    // What has not been named closes no loop, and is not asked.
    constexpr double most = 20;
    for (std::size_t k = 0; k < motions.size(); ++k) {
      motions[k].probability *= std::exp((std::min)((std::max)(evidence[k], -most), most));
      sum += motions[k].probability;
    }
    for (Ranked_motion& m : motions) m.probability /= sum + rest;
    std::stable_sort(motions.begin(), motions.end(),
                     [](const Ranked_motion& a, const Ranked_motion& b) { return a.probability > b.probability; });
  }
  return result;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_LOOP_EVIDENCE_H
