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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_PAIR_PLAN_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_PAIR_PLAN_H

// Which pairs of many scans to register next: rounds of what promises most, until all is connected and checked.

#include <CGAL/Crude_registration/internal/assembly/Parts.h>
#include <CGAL/Crude_registration/internal/assembly/Placed_scans.h>
#include <CGAL/Crude_registration/internal/assembly/overlap_prediction.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Edges between nodes 0 .. n-1: those without which it falls apart, by their indices.
inline std::vector<std::size_t> bridges(std::size_t n, const std::vector<Scan_pair>& edges)
{
  std::vector<std::vector<std::pair<std::size_t, std::size_t>>> next(n); // node, edge
  for (std::size_t e = 0; e < edges.size(); ++e) {
    next[edges[e].first].emplace_back(edges[e].second, e);
    next[edges[e].second].emplace_back(edges[e].first, e);
  }
  // Tarjan's algorithm (1974), with a stack of its own.
  constexpr std::size_t none = std::size_t(-1);
  std::vector<std::size_t> order(n, none), low(n, 0), at(n, 0), by(n, none), result, stack;
  std::size_t time = 0;
  for (std::size_t root = 0; root < n; ++root) {
    if (order[root] != none) continue;
    stack.push_back(root);
    order[root] = low[root] = time++;
    while (!stack.empty()) {
      const std::size_t v = stack.back();
      if (at[v] < next[v].size()) {
        const auto [w, e] = next[v][at[v]++];
        if (e == by[v]) continue;
        if (order[w] == none) {
          order[w] = low[w] = time++;
          by[w] = e;
          stack.push_back(w);
        } else low[v] = (std::min)(low[v], order[w]);
        continue;
      }
      stack.pop_back();
      if (stack.empty()) continue;
      const std::size_t u = stack.back();
      low[u] = (std::min)(low[u], low[v]);
      if (low[v] > order[u]) result.push_back(by[v]);
    }
  }
  std::sort(result.begin(), result.end());
  return result;
}

class Pair_plan
{
public:
  // `known`: in the order of the scans, of their own frames.
  Pair_plan(const Placed_scans& placed, const Known_poses& known)
      : m_placed(placed), m_known(known), m_affinities(placed.size() * placed.size(), 0)
  {
    const std::size_t n = placed.size();
    std::vector<double> extents;
    for (std::size_t i = 0; i < n; ++i) extents.push_back(placed.scan(i).extent);
    std::sort(extents.begin(), extents.end());
    std::vector<Pair_histogram> histograms;
    for (std::size_t i = 0; i < n; ++i) histograms.emplace_back(placed.scan(i), extents[n / 2]);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 1; j < n; ++j)
        m_affinities[i * n + j] = m_affinities[j * n + i] = histograms[i].similarity(histograms[j]) + hinted(i, j);
  }

  // No more are tried in all.
  std::size_t budget() const
  {
    const std::size_t n = m_placed.size();
    return (std::min)(n * (n - 1) / 2, 6 * n);
  }

  // The first round: the likeliest partners of each scan.
  std::vector<Scan_pair> first_round()
  {
    constexpr std::size_t partners = 3;
    std::set<Scan_pair> round;
    for (std::size_t i = 0; i < m_placed.size(); ++i) {
      std::vector<std::size_t> others;
      for (std::size_t j = 0; j < m_placed.size(); ++j)
        if (j != i && !is_known({i, j})) others.push_back(j);
      std::stable_sort(others.begin(), others.end(),
                       [&](std::size_t a, std::size_t b) { return affinity(i, a) > affinity(i, b); });
      for (std::size_t k = 0; k < (std::min)(partners, others.size()); ++k)
        round.insert({(std::min)(i, others[k]), (std::max)(i, others[k])});
    }
    return taken(round);
  }

  // The next one: pairs that may connect parts, and pairs that close loops about what hangs by one edge. Empty: done.
  // `edges`: pairs that agree with the poses.
  std::vector<Scan_pair> next_round(const Parts& parts, const std::vector<Scan_pair>& edges)
  {
    std::set<Scan_pair> round;
    add_connecting(parts.parts(), round);
    add_closing(parts, edges, round);
    return taken(round);
  }

private:
  // Where hints say how two scans lie, what overlaps comes first, and what does not last.
  float hinted(std::size_t i, std::size_t j) const
  {
    if (m_known.are_fixed || !m_known.are_related(i, j)) return 0;
    const Rigid_motion motion = m_known.of(j)->motion.inverse() * m_known.of(i)->motion;
    const double overlap =
        (std::max)(m_placed.meeting(i, j, motion).overlap, m_placed.meeting(j, i, motion.inverse()).overlap);
    return overlap > 0 ? 1 + float(overlap) : -1;
  }

  // Nothing is asked of what is known.
  bool is_known(const Scan_pair& s) const { return m_known.are_fixed && m_known.are_related(s.first, s.second); }

  float affinity(std::size_t i, std::size_t j) const { return m_affinities[i * m_placed.size() + j]; }

  std::vector<Scan_pair> taken(const std::set<Scan_pair>& round)
  {
    std::vector<Scan_pair> pairs(round.begin(), round.end());
    const std::size_t left = budget() - m_tried.size();
    if (pairs.size() > left) { // the likeliest ones
      std::stable_sort(pairs.begin(), pairs.end(), [&](const Scan_pair& a, const Scan_pair& b) {
        return affinity(a.first, a.second) > affinity(b.first, b.second);
      });
      pairs.resize(left);
      std::sort(pairs.begin(), pairs.end());
    }
    m_tried.insert(pairs.begin(), pairs.end());
    return pairs;
  }

  // For each part the likeliest pairs with others, until so many between two of them were tried in vain.
  void add_connecting(const std::vector<Part>& parts, std::set<Scan_pair>& round) const
  {
    const std::size_t n = m_placed.size();
    std::vector<std::size_t> part_of(n);
    for (std::size_t p = 0; p < parts.size(); ++p)
      for (const std::size_t i : parts[p].scans) part_of[i] = p;
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> tried;
    const auto between = [&](const Scan_pair& s) {
      const std::size_t a = part_of[s.first], b = part_of[s.second];
      return std::pair((std::min)(a, b), (std::max)(a, b));
    };
    for (const Scan_pair& s : m_tried) ++tried[between(s)];
    const bool all = n * (n - 1) / 2 <= 6 * n;
    const auto most = [&](const std::pair<std::size_t, std::size_t>& p) {
      const std::size_t smaller = (std::min)(parts[p.first].scans.size(), parts[p.second].scans.size());
      return all ? n * n : (std::min)((std::max)(3 * smaller, std::size_t(8)), std::size_t(24));
    };
    for (std::size_t p = 0; p < parts.size(); ++p) {
      std::vector<Scan_pair> open;
      for (const std::size_t i : parts[p].scans)
        for (std::size_t j = 0; j < n; ++j) {
          const Scan_pair s{(std::min)(i, j), (std::max)(i, j)};
          if (part_of[j] != p && m_tried.count(s) == 0) open.push_back(s);
        }
      std::stable_sort(open.begin(), open.end(), [&](const Scan_pair& a, const Scan_pair& b) {
        return affinity(a.first, a.second) > affinity(b.first, b.second);
      });
      constexpr std::size_t at_once = 4;
      std::size_t count = 0;
      for (const Scan_pair& s : open) {
        if (count == at_once) break;
        std::size_t& there = tried[between(s)];
        if (there >= most(between(s))) continue;
        count += 1;
        there += round.insert(s).second;
      }
    }
  }

  // Across each edge that is the only one between two sides of a part: the pair that overlaps most as the poses lie.
  void add_closing(const Parts& parts, const std::vector<Scan_pair>& edges, std::set<Scan_pair>& round)
  {
    const std::size_t n = m_placed.size();
    constexpr double enough = 0.1; // overlap that is likely to be found
    constexpr std::size_t tries = 2;
    for (const std::size_t b : bridges(n, edges)) {
      if (m_closing[edges[b]] >= tries) continue;
      // The scans on the first scan's side of the bridge.
      std::vector<bool> is_there(n, false);
      std::vector<std::size_t> stack{edges[b].first};
      is_there[edges[b].first] = true;
      while (!stack.empty()) {
        const std::size_t v = stack.back();
        stack.pop_back();
        for (std::size_t e = 0; e < edges.size(); ++e) {
          if (e == b || (edges[e].first != v && edges[e].second != v)) continue;
          const std::size_t w = edges[e].first == v ? edges[e].second : edges[e].first;
          if (!is_there[w]) stack.push_back(w);
          is_there[w] = true;
        }
      }
      double largest = enough;
      Scan_pair best{0, 0};
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i + 1; j < n; ++j) {
          if (is_there[i] == is_there[j] || !parts.are_together(i, edges[b].first) ||
              !parts.are_together(j, edges[b].first) || m_tried.count({i, j}) != 0 || is_known({i, j}))
            continue;
          const Rigid_motion motion = parts.poses()[j].inverse() * parts.poses()[i];
          const double overlap =
              (std::max)(m_placed.meeting(i, j, motion).overlap, m_placed.meeting(j, i, motion.inverse()).overlap);
          if (overlap <= largest) continue;
          largest = overlap;
          best = {i, j};
        }
      if (best.first == best.second) continue;
      ++m_closing[edges[b]];
      round.insert(best);
    }
  }

  const Placed_scans& m_placed;
  const Known_poses& m_known;
  std::vector<float> m_affinities;
  std::set<Scan_pair> m_tried;
  std::map<Scan_pair, std::size_t> m_closing;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_PAIR_PLAN_H
