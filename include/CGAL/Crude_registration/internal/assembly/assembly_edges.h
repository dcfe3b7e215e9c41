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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_ASSEMBLY_EDGES_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_ASSEMBLY_EDGES_H

// What is said of the pairs that were tried, once the scans lie as they lie.

#include <CGAL/Crude_registration/internal/assembly/Parts.h>
#include <CGAL/Crude_registration/internal/assembly/Placed_scans.h>
#include <CGAL/Crude_registration/internal/assembly/assemble_reduced_scans.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Of two scans of one part, second from first.
inline Rigid_motion motion_in(const Parts& parts, const Scan_pair& pair)
{
  return parts.poses()[pair.second].inverse() * parts.poses()[pair.first];
}

// `order`: the place in the input of each scan.
inline Assembly_edge assembly_edge(const Placed_scans& placed, const Parts& parts,
                                   const std::vector<std::size_t>& order, const Tried_pair& pair)
{
  Assembly_edge e;
  e.source = order[pair.scans.first];
  e.target = order[pair.scans.second];
  if (e.source > e.target) std::swap(e.source, e.target);
  e.registration = pair.answer.status;
  e.reason = pair.answer.reason;
  e.overlap = pair.answer.overlap;
  e.residual = pair.answer.residual;
  if (!pair.answer.motions.empty()) e.confidence = pair.answer.motions.front().probability;
  if (pair.answer.status == NOT_REGISTERED) e.status = WITHOUT_OVERLAP;
  else if (!parts.are_together(pair.scans.first, pair.scans.second)) {
    e.status = NOT_CONNECTING;
    if (e.reason.empty())
      e.reason = pair.is_fused ? "found by the surface of a component alone" : "not certain enough alone";
    for (const Join& join : parts.refused()) {
      const std::size_t a = parts.part_of(pair.scans.first), b = parts.part_of(pair.scans.second);
      if (join.first != (std::min)(a, b) || join.second != (std::max)(a, b)) continue;
      if (join.violations > 0.1) e.reason = "one component would lie in the free space of the other";
      else if (join.contradicting > 0) e.reason = "the pairs between the components contradict each other";
    }
  } else {
    e.status = DROPPED;
    for (std::size_t k = 0; k < pair.answer.motions.size(); ++k)
      if (Parts::agrees(placed, pair.scans, pair.answer.motions[k].motion, motion_in(parts, pair.scans))) {
        e.status = USED;
        if (k > 0) e.reason = "decided by the other scans";
        else if (pair.is_fused) e.reason = "by the surface that its component has together";
        break;
      }
    if (e.status == DROPPED) e.reason = "contradicts the poses that the other pairs give";
  }
  return e;
}

// Why a scan is alone.
inline std::string reason_alone(std::size_t scan, const Assembly_outcome& outcome)
{
  std::set<std::size_t> tried, fitting; // other scans: some are tried again as part of a surface
  const Assembly_edge* doubtful = nullptr;
  for (const Assembly_edge& e : outcome.edges) {
    if (e.source != scan && e.target != scan) continue;
    const std::size_t other = e.source == scan ? e.target : e.source;
    tried.insert(other);
    if (e.status != NOT_CONNECTING) continue;
    if (!doubtful || e.confidence > doubtful->confidence) doubtful = &e;
    fitting.insert(other);
  }
  if (outcome.is_interrupted) return "interrupted before it was connected";
  if (tried.empty()) return "there is no other scan";
  if (doubtful)
    return "no pair is certain enough: the best of " + std::to_string(fitting.size()) +
           " that may fit: " + doubtful->reason;
  return "no overlap found with any of the " + std::to_string(tried.size()) + " scans tried";
}

// Of each scan why the hint of its pose was dropped; empty where it was not, or nothing tells. Hints of one group that
// lie in one part have one frame: the one that most of them say. `known`: of own frames.
inline std::vector<std::string> lost_hints(const Placed_scans& placed, const Parts& parts, const Known_poses& known)
{
  std::vector<std::string> texts(placed.size());
  if (known.are_fixed) return texts;
  std::map<std::tuple<std::size_t, std::size_t>, std::vector<std::size_t>> together; // by part and group
  for (std::size_t i = 0; i < placed.size(); ++i)
    if (known.of(i)) together[{parts.part_of(i), known.of(i)->group}].push_back(i);
  for (const auto& entry : together) {
    const std::vector<std::size_t>& scans = entry.second;
    if (scans.size() < 2) continue;
    std::vector<std::size_t> most;
    for (const std::size_t i : scans) {
      const Rigid_motion part_from_group = parts.poses()[i] * known.of(i)->motion.inverse();
      std::vector<std::size_t> agreeing;
      for (const std::size_t j : scans)
        if (placed.displacement(j, part_from_group * known.of(j)->motion, parts.poses()[j]) <=
            hint_tolerance * placed.deviation(j))
          agreeing.push_back(j);
      if (agreeing.size() > most.size()) most = agreeing;
    }
    for (const std::size_t i : scans) {
      if (most.size() < 2) texts[i] = "it contradicts the pairs, and no other known pose tells which of them is wrong";
      else if (!std::binary_search(most.begin(), most.end(), i))
        texts[i] = "it contradicts the pairs, which " + std::to_string(most.size()) + " other known poses agree with";
    }
  }
  return texts;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_ASSEMBLY_EDGES_H
