// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_TRIHEDRON_SEARCH_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_TRIHEDRON_SEARCH_H

#include <CGAL/Crude_registration/internal/base/for_each_index.h>
#include <CGAL/Crude_registration/internal/judgement/Motion_evaluation.h>
#include <CGAL/Crude_registration/matching/match_trihedra.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// A scan's simplified mesh as the search sees it, in the own frame of the prepared scan.
struct Simplified_scan
{
  Matching_vertices vertices;
  double spacing = 0; // of neighbouring vertices
  double extent = 0;  // M
};

// The neighbourhood that describes a vertex: what is left of the noise of a scan in a fit over some hundred samples
// does not hide the shape.
inline double description_radius(const Prepared_scan& scan)
{
  return 10 * scan.spacing;
}

// `simplified`, `dense`: in the frame of the input.
inline Simplified_scan simplified_scan(const Prepared_scan& scan, const Flat_mesh& simplified, const Flat_mesh& dense,
                                       const std::vector<Vector>& dense_normals)
{
  Simplified_scan result;
  result.vertices = matching_vertices(simplified, dense, dense_normals, description_radius(scan));
  for (Vector& p : result.vertices.points) p = scan.own_from_input(p);
  for (Vector& n : result.vertices.normals) n = scan.own_from_input.rotation * n;
  result.spacing = median_edge_length(simplified);
  result.extent = scan.extent;
  return result;
}

// How far a pass goes: which trihedra, and how far vertices that correspond may differ.
struct Trihedron_pass
{
  std::vector<double> scales;
  int trihedra_per_scale;
  double length;        // in spacings
  double angle;         // in degrees
  double curvature;     // in 1 / description radius
  std::size_t distinct; // motions that are estimated again
  double spacing;       // the largest, in shares of M: vertices further apart differ by more than this pass allows for
};

struct Trihedron_search_parameters
{
  double minimum_extent = 0;   // f1
  double maximum_extent = 0.3; // f2
  bool use_normals = true;
  // Passes follow each other until the best motion's fine score is at least `certain_score`. Every pass looks up all
  // its trihedra in the whole D-mesh and scores every candidate.
  std::vector<Trihedron_pass> passes = {{{2. / 3}, 1, 0.7, 9, 0.12, 16, 0.025},
                                        {{2. / 3}, 1, 0.7, 12, 0.15, 16, 0.065},
                                        {{1, 2. / 3}, 1, 0.7, 15, 0.2, 10, 10},
                                        {{1, 2. / 3}, 4, 0.7, 20, 0.2, 32, 10},
                                        {{1, 2. / 3, 4. / 9}, 4, 0.8, 20, 0.4, 48, 10}};
  double certain_score = 0.1;
  // All candidates are scored by a few of the vertices, the best of them by more, the best of these by all; the best
  // distinct ones are estimated again from all vertices, scored again by all, and refined from the best one on until
  // one is certain.
  std::size_t coarse_probes = 96;
  std::size_t kept_by_trihedron = 8;
  std::size_t kept = 1000;
  std::size_t more_probes = 256;
  std::size_t kept_by_more = 100;
  std::size_t refined_at_once = 2; // by different threads
};

struct Trihedron_search_result
{
  bool is_found = false; // whether there was any candidate
  // From the own frame of the source to that of the target: the motion of the best trihedron, that of all vertices that
  // agree under it, and refined.
  Rigid_motion trihedron_motion, crude_motion, refined_motion;
  double score = 0; // the fine score of the refined motion
  std::size_t passes = 0, trihedra = 0, candidates = 0;
  double seconds = 0;
};

// Sections 5 and 6 of the paper from one end to the other: all trihedra of S in the whole of D, and the best of all
// candidates.
template <class ConcurrencyTag>
class Trihedron_search
{
public:
  // All kept by reference.
  Trihedron_search(const Prepared_scan& source, const Simplified_scan& s, const Prepared_scan& target,
                   const Simplified_scan& d, const Trihedron_search_parameters& parameters)
      : m_source(source), m_s(s), m_d(d), m_parameters(parameters),
        m_evaluation(source, s.vertices, target, d.vertices, (std::max)(s.spacing, d.spacing))
  {}

  Trihedron_search_result operator()()
  {
    const auto start = std::chrono::steady_clock::now();
    Trihedron_search_result result;
    for (const Trihedron_pass& pass : m_parameters.passes) {
      if (spacing() > pass.spacing * m_s.extent) continue;
      ++result.passes;
      run(pass, result);
      if (result.is_found && result.score >= m_parameters.certain_score) break;
    }
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
  }

private:
  struct Scored_candidate
  {
    Candidate_motion candidate;
    double score;
  };

  struct Crude_motion
  {
    Rigid_motion trihedron_motion, motion;
    double score;
  };

  // A bound of the score that the last of the best so many candidates has. At any time at least that many scores of
  // candidates that take part to the end are above the bound: what is below it is not among the best, whatever the
  // other threads have added so far.
  class Best_scores
  {
  public:
    Best_scores(std::size_t number, std::size_t probes)
        : m_number(number), m_probes(double(probes)), m_counts(probes + 1)
    {}

    double least() const { return m_least.load(std::memory_order_relaxed); }

    void add(double score)
    {
      // Rounded down by more than the rounding of a score. What is not above zero does not count.
      const double level = score * m_probes - 1e-6;
      if (!(level >= 0)) return;
      ++m_counts[std::size_t(level)];
      std::size_t sum = 0;
      for (std::size_t i = m_counts.size(); i-- > 0;) {
        sum += m_counts[i];
        if (sum < m_number) continue;
        const double least = double(i) / m_probes;
        for (double l = m_least; l < least && !m_least.compare_exchange_weak(l, least);) {
        }
        return;
      }
    }

  private:
    std::size_t m_number;
    double m_probes;
    std::vector<std::atomic<std::size_t>> m_counts;
    std::atomic<double> m_least{-(std::numeric_limits<double>::max)()};
  };

  double spacing() const { return (std::max)(m_s.spacing, m_d.spacing); }

  void run(const Trihedron_pass& pass, Trihedron_search_result& result)
  {
    Trihedron_options options;
    options.minimum_length = m_parameters.minimum_extent * m_s.extent;
    options.maximum_length = m_parameters.maximum_extent * m_s.extent;
    options.scales = pass.scales;
    options.trihedra_per_scale = pass.trihedra_per_scale;
    std::vector<Spatial_trihedron> trihedra = spatial_trihedra(m_s.vertices.points, m_s.vertices.inside, options);
    if (trihedra.empty()) return;
    result.trihedra += trihedra.size();

    std::size_t count = 0;
    const std::vector<Crude_motion> crude = crude_motions(match(pass, trihedra, count), pass.distinct);
    result.candidates += count;

    // In their order, some at a time (always the same number, whatever the number of threads), until one is certain.
    for (std::size_t from = 0; from < crude.size() && !(result.is_found && result.score >= m_parameters.certain_score);
         from += m_parameters.refined_at_once) {
      std::vector<Rigid_motion> refined((std::min)(m_parameters.refined_at_once, crude.size() - from));
      std::vector<double> scores(refined.size(), -(std::numeric_limits<double>::max)());
      for_each_index<ConcurrencyTag>(refined.size(), [&](std::size_t i) {
        refined[i] = m_evaluation.refined(crude[from + i].motion);
        // What ends elsewhere is no crude registration of where it ends.
        if (m_evaluation.distance(refined[i], crude[from + i].motion) < spacing())
          scores[i] = m_evaluation.fine_score(refined[i]).value();
      });
      for (std::size_t i = 0; i < refined.size(); ++i) {
        if (scores[i] <= (result.is_found ? result.score : -(std::numeric_limits<double>::max)())) continue;
        result.is_found = true;
        result.score = scores[i];
        result.refined_motion = refined[i];
        result.crude_motion = m_evaluation.reestimated(crude[from + i].motion);
        result.trihedron_motion = crude[from + i].trihedron_motion;
      }
    }
  }

  // The candidates of all trihedra, each applied and scored; the best few of each trihedron are returned, by trihedron.
  // The ends of the trihedra are put in order.
  std::vector<Scored_candidate> match(const Trihedron_pass& pass, std::vector<Spatial_trihedron>& trihedra,
                                      std::size_t& count)
  {
    Match_tolerances tolerances;
    tolerances.length = pass.length * m_d.spacing;
    tolerances.angle = pass.angle * CGAL_PI / 180;
    tolerances.curvature = pass.curvature / description_radius(m_source);
    tolerances.use_normals = m_parameters.use_normals;
    const std::array<double, 2> arms = range_of_arms(m_s.vertices.points, trihedra);
    const Trihedron_matching matching(m_s.vertices, m_d.vertices, arms[0], arms[1], tolerances);

    // Chunks of trihedra, each with a slot of its own: the result does not depend on who does what when.
    constexpr std::size_t chunk = 32;
    struct Slot
    {
      std::vector<Scored_candidate> best;
      std::size_t count = 0;
    };
    std::vector<Slot> slots((trihedra.size() + chunk - 1) / chunk);
    Best_scores best_scores(m_parameters.kept, m_parameters.coarse_probes);
    for_each_index<ConcurrencyTag>(slots.size(), [&](std::size_t k) {
      Trihedron_matching::Workspace work;
      std::vector<Scored_candidate> found;
      for (std::size_t t = k * chunk; t < (std::min)((k + 1) * chunk, trihedra.size()); ++t) {
        found.clear();
        trihedra[t] = matching.rarest_first(trihedra[t]);
        matching(trihedra[t], work, [&](const auto& vertices, const auto& x, const auto& y) {
          Scored_candidate c;
          if (!candidate_motion(std::int32_t(t), vertices, x, y, c.candidate)) return;
          ++slots[k].count;
          const double least = best_scores.least();
          c.score = m_evaluation.coarse_score(c.candidate.motion, m_parameters.coarse_probes, least).value();
          if (c.score >= least) found.push_back(c);
        });
        keep_best(found, m_parameters.kept_by_trihedron);
        for (const Scored_candidate& c : found) best_scores.add(c.score);
        slots[k].best.insert(slots[k].best.end(), found.begin(), found.end());
      }
    });
    std::vector<Scored_candidate> candidates;
    for (const Slot& s : slots) {
      candidates.insert(candidates.end(), s.best.begin(), s.best.end());
      count += s.count;
    }
    return candidates;
  }

  // The best of the candidates, estimated again from all vertices that agree under them: what aligns S best over D
  // first.
  std::vector<Crude_motion> crude_motions(std::vector<Scored_candidate> candidates, std::size_t distinct) const
  {
    constexpr auto all = std::size_t(-1);
    const auto look = [&](std::size_t number, std::size_t probes) {
      keep_best(candidates, number);
      for_each_index<ConcurrencyTag>(candidates.size(), [&](std::size_t i) {
        candidates[i].score = m_evaluation.coarse_score(candidates[i].candidate.motion, probes).value();
      });
    };
    if (candidates.size() > m_parameters.kept_by_more) look(m_parameters.kept, m_parameters.more_probes);
    look(m_parameters.kept_by_more, all);
    keep_best(candidates, candidates.size());

    std::vector<Crude_motion> crude;
    for (const Scored_candidate& c : candidates) {
      if (crude.size() == distinct) break;
      const Rigid_motion& m = c.candidate.motion;
      if (is_distinct(m, crude, spacing(), [](const Crude_motion& r) { return r.trihedron_motion; }))
        crude.push_back({m, m, 0});
    }
    for_each_index<ConcurrencyTag>(crude.size(), [&](std::size_t i) {
      crude[i].motion = m_evaluation.reestimated(crude[i].trihedron_motion);
      crude[i].score = m_evaluation.coarse_score(crude[i].motion, all).value();
    });
    keep_best(crude, crude.size());
    std::vector<Crude_motion> result;
    for (const Crude_motion& c : crude)
      if (is_distinct(c.motion, result, spacing() / 4, [](const Crude_motion& r) { return r.motion; }))
        result.push_back(c);
    return result;
  }

  template <class Motion_of>
  bool is_distinct(const Rigid_motion& motion, const std::vector<Crude_motion>& others, double distance,
                   const Motion_of& motion_of) const
  {
    return std::none_of(others.begin(), others.end(),
                        [&](const Crude_motion& o) { return m_evaluation.distance(motion, motion_of(o)) < distance; });
  }

  // The `count` best, best first; equal ones stay in their order.
  template <class Candidate>
  static void keep_best(std::vector<Candidate>& candidates, std::size_t count)
  {
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
    if (candidates.size() > count) candidates.resize(count);
  }

  const Prepared_scan& m_source;
  const Simplified_scan& m_s;
  const Simplified_scan& m_d;
  Trihedron_search_parameters m_parameters;
  Motion_evaluation m_evaluation;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_TRIHEDRON_SEARCH_H
