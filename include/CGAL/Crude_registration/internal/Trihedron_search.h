// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_TRIHEDRON_SEARCH_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_TRIHEDRON_SEARCH_H

#include <CGAL/Crude_registration/internal/Motion_evaluation.h>
#include <CGAL/Crude_registration/match_trihedra.h>

#include <CGAL/for_each.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <stdexcept>
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
  double length;    // in spacings
  double angle;     // in degrees
  double curvature; // in 1 / description radius
};

struct Trihedron_search_parameters
{
  double minimum_extent = 0;   // f1
  double maximum_extent = 0.3; // f2
  bool use_normals = true;
  // Passes follow each other until the best motion's fine score is at least `certain_score`. Every pass looks at all
  // its trihedra and the whole D-mesh.
  std::vector<Trihedron_pass> passes = {{{2. / 3}, 1, 0.7, 12, 0.15},
                                        {{1, 2. / 3}, 1, 0.7, 15, 0.2},
                                        {{1, 2. / 3}, 4, 0.7, 20, 0.2},
                                        {{1, 2. / 3, 4. / 9}, 4, 0.8, 20, 0.4}};
  double certain_score = 0.1;
  std::size_t coarse_probes = 96;
  std::size_t kept_by_trihedron = 8;
  std::size_t kept = 1000;   // by all their vertices
  std::size_t distinct = 24; // refined
};

struct Trihedron_search_result
{
  bool is_found = false; // whether there was any candidate
  // From the own frame of the source to that of the target: the motion of the best trihedron, of all vertices that
  // agree under it, and refined.
  Rigid_motion trihedron_motion, crude_motion, refined_motion;
  double score = 0;           // the fine score of the refined motion
  double runner_up_score = 0; // the best of a distinct one
  Spatial_trihedron trihedron{};
  std::array<std::int32_t, 4> vertices{};
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
    const std::vector<Scored_candidate> candidates = distinct(match(pass, trihedra, count));
    result.candidates += count;
    if (candidates.empty()) return;

    std::vector<Rigid_motion> refined(candidates.size());
    std::vector<double> scores(candidates.size());
    for_each_index(candidates.size(), [&](std::size_t i) {
      refined[i] = m_evaluation.refined(candidates[i].candidate.motion);
      scores[i] = m_evaluation.fine_score(refined[i]).value();
    });
    const auto best = std::size_t(std::max_element(scores.begin(), scores.end()) - scores.begin());
    if (result.is_found && scores[best] <= result.score) return;
    const double spacing = (std::max)(m_s.spacing, m_d.spacing);
    result.is_found = true;
    result.score = scores[best];
    result.refined_motion = refined[best];
    // Of the candidates that lead to the same place the one that was best before.
    std::size_t crude = best;
    double runner_up = 0;
    for (std::size_t i = candidates.size(); i-- > 0;)
      if (m_evaluation.distance(refined[i], refined[best]) < spacing / 2) crude = i;
      else runner_up = (std::max)(runner_up, scores[i]);
    result.runner_up_score = runner_up;
    const Candidate_motion& c = candidates[crude].candidate;
    result.trihedron_motion = c.motion;
    result.crude_motion = m_evaluation.reestimated(c.motion);
    result.trihedron = trihedra[std::size_t(c.trihedron)];
    result.vertices = c.vertices;
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
    for_each_index(slots.size(), [&](std::size_t k) {
      Trihedron_matching::Workspace work;
      std::vector<Scored_candidate> found;
      for (std::size_t t = k * chunk; t < (std::min)((k + 1) * chunk, trihedra.size()); ++t) {
        found.clear();
        trihedra[t] = matching.rarest_first(trihedra[t]);
        matching(trihedra[t], work, [&](const auto& vertices, const auto& x, const auto& y) {
          Scored_candidate c;
          if (!candidate_motion(std::int32_t(t), vertices, x, y, c.candidate)) return;
          ++slots[k].count;
          c.score = m_evaluation.coarse_score(c.candidate.motion, m_parameters.coarse_probes).value();
          found.push_back(c);
        });
        keep_best(found, m_parameters.kept_by_trihedron);
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

  // The best candidates by all vertices, best first, each further than a spacing from all before.
  std::vector<Scored_candidate> distinct(std::vector<Scored_candidate> candidates) const
  {
    keep_best(candidates, m_parameters.kept);
    for_each_index(candidates.size(), [&](std::size_t i) {
      candidates[i].score = m_evaluation.coarse_score(candidates[i].candidate.motion, std::size_t(-1)).value();
    });
    keep_best(candidates, candidates.size());
    const double spacing = (std::max)(m_s.spacing, m_d.spacing);
    std::vector<Scored_candidate> result;
    for (const Scored_candidate& c : candidates) {
      if (result.size() == m_parameters.distinct) break;
      if (std::none_of(result.begin(), result.end(), [&](const Scored_candidate& r) {
            return m_evaluation.distance(c.candidate.motion, r.candidate.motion) < spacing;
          }))
        result.push_back(c);
    }
    return result;
  }

  // The `count` best, best first; equal ones stay in their order.
  static void keep_best(std::vector<Scored_candidate>& candidates, std::size_t count)
  {
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Scored_candidate& a, const Scored_candidate& b) { return a.score > b.score; });
    if (candidates.size() > count) candidates.resize(count);
  }

  template <class Function>
  static void for_each_index(std::size_t n, const Function& f)
  {
    std::vector<std::size_t> indices(n);
    std::iota(indices.begin(), indices.end(), std::size_t(0));
    CGAL::for_each<ConcurrencyTag>(indices, [&](std::size_t& i) {
      f(i);
      return true;
    });
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

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_TRIHEDRON_SEARCH_H
