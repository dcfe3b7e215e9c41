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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_TRIHEDRON_SEARCH_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_TRIHEDRON_SEARCH_H

// The search of the paper: spatial trihedra of the S-mesh, matched exhaustively in the D-mesh.

#include <CGAL/Crude_registration/internal/base/Counter_random.h>
#include <CGAL/Crude_registration/internal/base/for_each_index.h>
#include <CGAL/Crude_registration/internal/judgement/agreement.h>
#include <CGAL/Crude_registration/internal/lookup/Probes.h>
#include <CGAL/Crude_registration/internal/matching/Candidate_source.h>
#include <CGAL/Crude_registration/internal/matching/Trihedron_matching.h>
#include <CGAL/Crude_registration/internal/matching/extents.h>
#include <CGAL/Crude_registration/internal/matching/flat_trihedra.h>
#include <CGAL/Crude_registration/internal/motion/Nearest_surfel.h>
#include <CGAL/Crude_registration/internal/motion/point_to_plane.h>
#include <CGAL/Crude_registration/internal/reduction/Reduced_scan.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

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

struct Trihedron_parameters
{
  double minimum_extent = 0, maximum_extent = default_maximum_extent; // f1, f2
  double tolerance = 0; // of the place of a vertex, a length; 0: as the passes have it
  bool use_normals = true;
  // A next pass is made as long as nothing is certain. Every pass looks up all its trihedra in the whole D-mesh and
  // scores every candidate.
  std::vector<Trihedron_pass> passes = {{{2. / 3}, 1, 0.7, 9, 0.12, 16, 0.025},
                                        {{2. / 3}, 1, 0.7, 12, 0.15, 16, 0.065},
                                        {{1, 2. / 3}, 1, 0.7, 15, 0.2, 10, 10},
                                        {{1, 2. / 3}, 4, 0.7, 20, 0.2, 32, 10},
                                        {{1, 2. / 3, 4. / 9}, 4, 0.8, 20, 0.4, 48, 10}};
  // All candidates are scored by a few of the vertices, the best of them by more, the best of these by all; the best
  // distinct ones are estimated again from all vertices, and scored again by all.
  std::size_t coarse_probes = 96;
  std::size_t kept_by_trihedron = 8;
  std::size_t kept = 1000;
  std::size_t more_probes = 256;
  std::size_t kept_by_more = 100;
};

// Sections 5 and 6 of the paper from one end to the other: all trihedra of S in the whole of D, and the motions that
// align S best over D.
class Trihedron_search : public Candidate_source
{
public:
  // The scans are kept by reference.
  // \pre Both scans have their simplified meshes.
  Trihedron_search(const Reduced_scan& source, const Reduced_scan& target, Trihedron_parameters parameters,
                   Execution execution)
      : m_source(source), m_target(target), m_s(*source.simplified), m_d(*target.simplified),
        m_parameters(std::move(parameters)), m_execution(execution), m_spacing((std::max)(m_s.spacing, m_d.spacing)),
        m_source_probes(probes(m_s.vertices)), m_target_probes(probes(m_d.vertices)),
        m_field(some_of(m_target_probes.surfels(), Surfel_field::maximum_size), 0.4f * float(m_spacing),
                float(m_spacing))
  {
    const std::vector<Vector>& points = m_s.vertices.points;
    for (const Vector& p : points) m_mean += p / double(points.size());
    for (const Vector& p : points) m_covariance += (p - m_mean) * (p - m_mean).transpose() / double(points.size());
  }

  std::optional<Proposals> next(Run_control& control) override
  {
    const std::size_t passes = m_parameters.passes.size();
    while (m_next_pass < passes && m_spacing > m_parameters.passes[m_next_pass].spacing * m_s.extent) ++m_next_pass;
    if (m_next_pass == passes || m_source_probes.size() == 0 || m_target_probes.size() == 0) return std::nullopt;
    const Trihedron_pass& pass = m_parameters.passes[m_next_pass++];
    const Stage_timer timer(m_rounds);
    ++m_rounds.count;
    std::vector<Spatial_trihedron> trihedra = chosen(pass);
    Proposals proposals;
    if (trihedra.empty()) return proposals;
    const std::vector<Crude_motion> crude = crude_motions(match(pass, trihedra, control), pass.distinct, control);
    for (const Crude_motion& c : crude) {
      proposals.poses.push_back(to_pose(c.motion));
      proposals.correspondences.push_back(correspondence(trihedra[std::size_t(c.candidate.trihedron)], c.candidate));
    }
    proposals.judged = judged;
    return proposals;
  }

  double progress() const override { return double(m_next_pass) / double(m_parameters.passes.size()); }

  std::vector<Stage_record> stages() const override { return {m_rounds, m_trihedra, m_matches, m_estimates}; }

private:
  static constexpr std::size_t judged = 8; // as of the pairs of oriented points

  struct Scored_candidate
  {
    Candidate_motion candidate;
    double score;
  };

  struct Crude_motion
  {
    Candidate_motion candidate; // of a trihedron
    Rigid_motion motion;        // estimated again
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

  // The described vertices, any first ones of them spread over the mesh.
  static Probes probes(const Matching_vertices& vertices)
  {
    std::vector<Surfel> result;
    for (const std::int32_t i : shuffled(vertices.points.size(), 0)) {
      if (vertices.normals[std::size_t(i)].isZero(0)) continue;
      Surfel s;
      s.position = vertices.points[std::size_t(i)].cast<float>();
      s.normal = vertices.normals[std::size_t(i)].cast<float>();
      result.push_back(s);
    }
    return Probes(std::move(result));
  }

  static std::vector<Surfel> some_of(const std::vector<Surfel>& surfels, std::size_t number)
  {
    return {surfels.begin(), surfels.begin() + std::ptrdiff_t((std::min)(number, surfels.size()))};
  }

  // How well S lies over D, by at most `count` vertices of each.
  double score_of(const Rigid_motion& motion, std::size_t count,
                  double least = -(std::numeric_limits<double>::max)()) const
  {
    const auto spacing = float(m_spacing);
    return double(agreement(m_source, Some_probes(m_source_probes, 0, count), m_target,
                            Some_probes(m_target_probes, 0, count), m_target.coarse, to_pose(motion),
                            {0.6f * spacing, 0.7f, 0.8f * spacing}, float(least))
                      .score());
  }

  // A motion estimated again from all vertices of S and D that agree under it: the nearest ones, where they are no
  // further apart than vertices are and face the same way. As the two meshes have their vertices at different places of
  // the surface, only the distances along the mean normals are made least.
  Rigid_motion reestimated(const Rigid_motion& motion) const
  {
    Refinement_options options;
    options.sampling_distance = m_spacing / 2;
    options.reach = m_spacing;
    options.maximum_number_of_iterations = 8;
    const Nearest_surfel d{m_target_probes.surfels(), m_field, m_spacing};
    return Point_to_plane<Nearest_surfel>(m_s.vertices.points, m_s.vertices.normals, d, options)(motion).motion;
  }

  // The root mean square distance of the vertices of S under two motions.
  double distance(const Rigid_motion& a, const Rigid_motion& b) const
  {
    const Matrix difference = a.rotation - b.rotation;
    return std::sqrt((difference * m_mean + a.translation - b.translation).squaredNorm() +
                     (std::max)(0., (difference * m_covariance * difference.transpose()).trace()));
  }

  // V, v1, v2, v3, and what they were matched with. \pre The ends are in the order in which they were matched.
  Correspondence correspondence(const Spatial_trihedron& trihedron, const Candidate_motion& candidate) const
  {
    const std::array<std::int32_t, 4> s = {trihedron.origin, trihedron.ends[0], trihedron.ends[1], trihedron.ends[2]};
    Correspondence result;
    for (std::size_t i = 0; i < 4; ++i)
      result.emplace_back(m_s.vertices.points[std::size_t(s[i])],
                          m_d.vertices.points[std::size_t(candidate.vertices[i])]);
    return result;
  }

  std::vector<Spatial_trihedron> chosen(const Trihedron_pass& pass)
  {
    const Stage_timer timer(m_trihedra);
    Trihedron_options options;
    options.minimum_length = m_parameters.minimum_extent * m_s.extent;
    options.maximum_length = m_parameters.maximum_extent * m_s.extent;
    options.scales = pass.scales;
    options.trihedra_per_scale = pass.trihedra_per_scale;
    std::vector<Spatial_trihedron> trihedra = spatial_trihedra(m_s.vertices.points, m_s.vertices.inside, options);
    m_trihedra.count += trihedra.size();
    return trihedra;
  }

  // The candidates of all trihedra, each applied and scored; the best few of each trihedron are returned, by trihedron.
  // The ends of the trihedra are put in order.
  std::vector<Scored_candidate> match(const Trihedron_pass& pass, std::vector<Spatial_trihedron>& trihedra,
                                      Run_control& control)
  {
    const Stage_timer timer(m_matches);
    Match_tolerances tolerances;
    tolerances.length = m_parameters.tolerance > 0 ? m_parameters.tolerance : pass.length * m_d.spacing;
    tolerances.angle = pass.angle * CGAL_PI / 180;
    tolerances.curvature = pass.curvature / m_s.description_radius;
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
    for_each_index(m_execution, slots.size(), control, [&](std::size_t k) {
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
          c.score = score_of(c.candidate.motion, m_parameters.coarse_probes, least);
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
      m_matches.count += s.count;
    }
    return candidates;
  }

  // The best of the candidates, estimated again from all vertices that agree under them: what aligns S best over D
  // first.
  std::vector<Crude_motion> crude_motions(std::vector<Scored_candidate> candidates, std::size_t distinct,
                                          Run_control& control)
  {
    const Stage_timer timer(m_estimates);
    constexpr auto all = std::size_t(-1);
    const auto look = [&](std::size_t number, std::size_t probes) {
      keep_best(candidates, number);
      for_each_index(m_execution, candidates.size(), control,
                     [&](std::size_t i) { candidates[i].score = score_of(candidates[i].candidate.motion, probes); });
    };
    if (candidates.size() > m_parameters.kept_by_more) look(m_parameters.kept, m_parameters.more_probes);
    look(m_parameters.kept_by_more, all);
    keep_best(candidates, candidates.size());

    std::vector<Crude_motion> crude;
    for (const Scored_candidate& c : candidates) {
      if (crude.size() == distinct) break;
      const Rigid_motion& m = c.candidate.motion;
      if (is_distinct(m, crude, m_spacing, [](const Crude_motion& r) { return r.candidate.motion; }))
        crude.push_back({c.candidate, m, 0});
    }
    for_each_index(m_execution, crude.size(), control, [&](std::size_t i) {
      crude[i].motion = reestimated(crude[i].candidate.motion);
      crude[i].score = score_of(crude[i].motion, all);
    });
    keep_best(crude, crude.size());
    m_estimates.count += crude.size();
    std::vector<Crude_motion> result;
    for (const Crude_motion& c : crude)
      if (is_distinct(c.motion, result, m_spacing / 4, [](const Crude_motion& r) { return r.motion; }))
        result.push_back(c);
    return result;
  }

  template <class Motion_of>
  bool is_distinct(const Rigid_motion& motion, const std::vector<Crude_motion>& others, double least,
                   const Motion_of& motion_of) const
  {
    return std::none_of(others.begin(), others.end(),
                        [&](const Crude_motion& o) { return distance(motion, motion_of(o)) < least; });
  }

  // The `count` best, best first; equal ones stay in their order.
  template <class Candidate>
  static void keep_best(std::vector<Candidate>& candidates, std::size_t count)
  {
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
    if (candidates.size() > count) candidates.resize(count);
  }

  const Reduced_scan& m_source;
  const Reduced_scan& m_target;
  const Simplified_scan& m_s;
  const Simplified_scan& m_d;
  const Trihedron_parameters m_parameters;
  const Execution m_execution;
  const double m_spacing;
  const Probes m_source_probes, m_target_probes;
  const Surfel_field m_field; // of the target's probes
  Vector m_mean = Vector::Zero();
  Matrix m_covariance = Matrix::Zero();
  std::size_t m_next_pass = 0;
  Stage_record m_rounds{"propose"}, m_trihedra{"propose: trihedra"}, m_matches{"propose: matches"},
      m_estimates{"propose: estimates"};
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_TRIHEDRON_SEARCH_H
