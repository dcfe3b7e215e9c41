// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_POSE_SEARCH_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_POSE_SEARCH_H

#include <CGAL/Crude_registration/internal/reduction/Prepared_scan.h>
#include <CGAL/Crude_registration/internal/lookup/Surfel_pair_index.h>
#include <CGAL/Crude_registration/internal/base/for_each_index.h>

#include <array>
#include <utility>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Target from source, in the own frames of the scans.
struct Pose
{
  Matrix_f rotation = Matrix_f::Identity();
  Vector_f translation = Vector_f::Zero();

  Vector_f operator()(const Vector_f& p) const { return rotation * p + translation; }
  Pose inverse() const
  {
    Pose i;
    i.rotation = rotation.transpose();
    i.translation = -(i.rotation * translation);
    return i;
  }
};

// One step of point-to-plane least squares (Chen and Medioni 1991) of some surfels of the source against the target's
// nearest ones. Returns the number of correspondences; the pose is left as it is where they are fewer than six.
struct Step
{
  float reach;          // largest distance to the plane
  float minimal_cosine; // of the normals
};

template <class Indices>
int refine_step(const Surfel_level& source, const Indices& indices, const Surfel_level& target, const Step& step,
                Pose& pose)
{
  // The unknowns are a rotation about the middle of the correspondences, in units of their spread, and a translation.
  constexpr std::size_t most = 4096;
  thread_local std::vector<std::array<float, 7>> rows; // p, n, residual
  rows.clear();
  Vector_f middle = Vector_f::Zero();
  for (const auto i : indices) {
    const Surfel& s = source.surfels[std::size_t(i)];
    const Vector_f p = pose(s.position);
    const int j = target.field.nearest(p);
    if (j < 0) continue;
    const Surfel& t = target.surfels[std::size_t(j)];
    const Vector_f e = p - t.position;
    const float r = t.normal.dot(e);
    if (std::abs(r) > step.reach || (e - r * t.normal).squaredNorm() > 4 * step.reach * step.reach) continue;
    if ((pose.rotation * s.normal).dot(t.normal) < step.minimal_cosine) continue;
    rows.push_back({p[0], p[1], p[2], t.normal[0], t.normal[1], t.normal[2], r});
    middle += p;
    if (rows.size() == most) break;
  }
  if (rows.size() < 6) return int(rows.size());
  middle /= float(rows.size());
  float spread = 0;
  for (const auto& r : rows) spread += (Vector_f(r[0], r[1], r[2]) - middle).squaredNorm();
  const float unit = std::sqrt(spread / float(rows.size()));
  if (!(unit > 0)) return 0;

  Eigen::Matrix<float, 6, 6> left = Eigen::Matrix<float, 6, 6>::Zero();
  Eigen::Matrix<float, 6, 1> right = Eigen::Matrix<float, 6, 1>::Zero();
  const float inverse_unit = 1 / unit, inverse_reach2 = 1 / (step.reach * step.reach);
  for (const auto& r : rows) {
    const Vector_f n(r[3], r[4], r[5]);
    const Vector_f c = ((Vector_f(r[0], r[1], r[2]) - middle) * inverse_unit).cross(n);
    float w = 1 - r[6] * r[6] * inverse_reach2; // Tukey's biweight
    w *= w;
    const float v[6] = {c[0], c[1], c[2], n[0], n[1], n[2]};
    for (int i = 0; i < 6; ++i) {
      const float wi = w * v[i];
      for (int j = i; j < 6; ++j) left(j, i) += wi * v[j];
      right[i] -= wi * r[6];
    }
  }
  // What the correspondences do not determine stays: a little of the identity.
  left.diagonal().array() += 1e-3f * float(rows.size()) / 6;
  const Eigen::Matrix<float, 6, 1> x = left.selfadjointView<Eigen::Lower>().ldlt().solve(right);
  const Vector_f w = x.head<3>() * inverse_unit, t = x.tail<3>();
  const float angle = w.norm();
  const Matrix_f r = angle > 1e-7f ? Eigen::AngleAxisf(angle, w / angle).toRotationMatrix() : Matrix_f::Identity();
  pose.translation = r * (pose.translation - middle) + middle + t;
  pose.rotation = r * pose.rotation;
  return int(rows.size());
}

// How a pose explains the scans.
struct Agreement
{
  float overlap = 0;    // share of the source's surfels with a target surfel near and facing the same way
  float violations = 0; // surfels of either scan in the free space of the other, as a share of the source's
};

template <class Indices>
Agreement agreement(const Prepared_scan& source, const Surfel_level& source_level, const Indices& source_indices,
                    const Prepared_scan& target, const Surfel_level& target_level, const Indices& target_indices,
                    const Pose& pose, float distance, float minimal_cosine, float free_depth)
{
  int overlap = 0, violations = 0;
  const bool target_is_known = target.depths.is_known();
  for (const auto i : source_indices) {
    const Surfel& s = source_level.surfels[std::size_t(i)];
    const Vector_f p = pose(s.position);
    const int j = target_level.field.nearest(p);
    if (j >= 0) {
      const Surfel& t = target_level.surfels[std::size_t(j)];
      overlap += int(std::abs(t.normal.dot(p - t.position)) <= distance) &
                 int((pose.rotation * s.normal).dot(t.normal) >= minimal_cosine);
    }
    if (target_is_known) violations += target.depths.in_front(p) > free_depth;
  }
  if (source.depths.is_known()) {
    const Pose back = pose.inverse();
    for (const auto i : target_indices)
      violations += source.depths.in_front(back(target_level.surfels[std::size_t(i)].position)) > free_depth;
  }
  Agreement a;
  const float n = float(source_indices.size());
  a.overlap = float(overlap) / n;
  a.violations = float(violations) / n;
  return a;
}

// Some of the probes of a level, which are kept by reference: `n` in a row, from the one that is `from` on, from the
// front again at the end.
class Probes
{
public:
  Probes(const std::vector<std::int32_t>& all, std::size_t from, std::size_t n) : m_begin(all.data())
  {
    n = (std::min)(n, all.size());
    if (n > 0) m_begin += from % (all.size() - n + 1);
    m_end = m_begin + n;
  }
  const std::int32_t* begin() const { return m_begin; }
  const std::int32_t* end() const { return m_end; }
  std::size_t size() const { return std::size_t(m_end - m_begin); }

private:
  const std::int32_t* m_begin;
  const std::int32_t* m_end;
};

struct Candidate
{
  Pose pose;
  float score;
};

// One round of the search.
struct Search_round
{
  std::vector<float> scales; // lengths of the first axis of a trihedron, in shares of M, the largest first
  int origins;               // vertices V of the source
  int pairs;                 // vertices v1 for each of them and each scale
  std::size_t looks;         // at most that many pairs (C, c1) of the target are looked at
  int curvature_tolerance;   // in 1/128 of the inverse spacing, for scans without noise
  std::size_t kept;          // distinct candidates that are refined
  std::size_t judged;        // those of them that are looked at closely
};

struct Search_parameters
{
  std::vector<Search_round> rounds = {{{0.16f}, 300, 5, 80000, 14, 32, 8},
                                      {{0.16f, 0.1f}, 800, 5, 200000, 14, 60, 8},
                                      {{0.25f, 0.16f, 0.1f, 0.06f}, 2000, 4, 1200000, 20, 300, 16}};
  float source_half_width = 0.3f; // of the lengths, in spacings
  float target_half_width = 0.7f;
  float distance = 0.8f; // of a witness to the plane of its counterpart, in spacings
  float minimal_cosine = 0.75f;
  int witnesses = 16, witnesses_needed = 9;
  float witness_reach = 0.22f; // of the witnesses from the middle of the pair, in shares of M
};

struct Search_counts
{
  std::size_t looks = 0, hits = 0, candidates = 0, refined = 0, judged = 0;
};

// A pose after refinement, looked at closely.
struct Judged_pose
{
  Pose pose;
  float tight = 0;      // share of the source's surfels on the target, to the scans' noise
  float violations = 0; // share of the surfels in free space
  float score() const { return tight - 2 * violations; }
};

// The search for the motion of a source to a target: trihedra of the source (V, v1, v2, v3) looked up in the target.
// V and v1 with their normals and curvatures find (C, c1) in the index of surfel pairs (the sphere of section 6, and
// the turn on the circle, which the normals give); v2 and v3, on either side of the line, have to find a counterpart
// where the motion takes them (the fourth vertex), and so have most of some further witnesses around. What is left is
// scored on the whole scan, with free space, and the best distinct motions are refined and judged.
template <class ConcurrencyTag = CGAL::Sequential_tag>
class Pose_search
{
public:
  // `control`: kept by reference.
  Pose_search(const Prepared_scan& source, const Prepared_scan& target, Search_parameters parameters,
              Run_control& control)
      : m_source(source), m_target(target), m_parameters(std::move(parameters)), m_control(control),
        m_fine_source_probes(source.fine.probes, 0, 2500), m_fine_target_probes(target.fine.probes, 0, 2500)
  {
    m_spacing = (std::max)(source.coarse.spacing, target.coarse.spacing);
    m_extent = float((std::min)(source.extent, target.extent));
    // About the noise of the worst tenth of surfels; a floor, as sampling leaves something even of scans without noise.
    m_coarse_tolerance = tolerance(source.coarse, target.coarse, 2.7f, 1.75f);
    // Normals of surfels side by side on smooth bodies differ by up to 0.33.
    const float turn = (std::max)(source.coarse.normal_noise, target.coarse.normal_noise);
    const float noise = (std::max)(turn / 0.33f, 1.f);
    m_curvature_noise = (std::min)(noise * std::sqrt(noise), 1.8f);
    m_fine_tolerance = tolerance(source.fine, target.fine, 4.3f, 2.4f);
    std::vector<Vector> points;
    points.reserve(source.coarse.surfels.size());
    for (const Surfel& s : source.coarse.surfels) points.push_back(s.position.cast<double>());
    m_grid = Point_grid(points, double(2 * m_spacing));
    for (const std::int32_t v : shuffled(source.coarse.surfels.size(), 1))
      if (!source.coarse.borders[std::size_t(v)]) m_origins.push_back(v);
  }

  // The distinct poses, best first, once one of them is certain or all rounds are done; those of the rounds that were
  // done if the run is stopped.
  // \pre Both scans have at least four surfels.
  std::vector<Judged_pose> operator()()
  {
    std::vector<Judged_pose> judged;
    if (m_origins.empty()) return judged; // a ribbon: all of its surfels are on the border
    for (const Search_round& round : m_parameters.rounds) {
      // The last round is most of the work.
      m_control.advance(&round == &m_parameters.rounds.back() ? 0.25 : 0);
      const std::vector<Candidate> best = refined(next_round(round), round.judged);
      std::vector<Judged_pose> poses(best.size());
      for_each_index<ConcurrencyTag>(best.size(), m_control, [&](std::size_t i) { poses[i] = judge(best[i].pose); });
      if (m_control.is_stopped()) break;
      m_counts.judged += poses.size();
      for (const Judged_pose& p : poses) add_distinct(p, judged);
      if (is_certain(judged)) break;
    }
    return judged;
  }

  const Search_counts& counts() const { return m_counts; }

  // Twice what any wrong pose was seen to reach, and far ahead of every other pose.
  static bool is_certain(const std::vector<Judged_pose>& judged)
  {
    if (judged.empty() || judged.front().score() < 0.2f) return false;
    return judged.size() == 1 || judged[1].score() < 0.4f * judged.front().score();
  }

  // The distinct candidates of the next round, best first.
  std::vector<Candidate> next_round(const Search_round& round)
  {
    std::vector<Candidate> candidates = match(choose_pairs(round), round);
    m_counts.candidates += candidates.size();
    // More probes for fewer candidates: most are told to be wrong by the first few.
    narrow(candidates, 12, (std::max)(8 * round.kept, candidates.size() / 8));
    narrow(candidates, 40, 4 * round.kept);
    score(candidates, 100);
    std::vector<Candidate> kept;
    for (const Candidate& c : candidates) {
      if (kept.size() == round.kept) break;
      if (std::none_of(kept.begin(), kept.end(), [&](const Candidate& k) { return are_close(c.pose, k.pose); }))
        kept.push_back(c);
    }
    return kept;
  }

  // The candidates after some steps of refinement, best first, no more than `number` of them.
  std::vector<Candidate> refined(std::vector<Candidate> candidates, std::size_t number)
  {
    m_counts.refined += candidates.size();
    const Probes target_probes(m_target.coarse.probes, 0, 200);
    const auto refine = [&](std::size_t number_of_probes, std::initializer_list<float> reaches) {
      const Probes source_probes(m_source.coarse.probes, 0, number_of_probes);
      for_each_index<ConcurrencyTag>(candidates.size(), m_control, [&](std::size_t i) {
        Candidate& c = candidates[i];
        for (float reach : reaches)
          if (refine_step(m_source.coarse, source_probes, m_target.coarse, {reach * m_spacing, 0.7f}, c.pose) < 6)
            break;
        const Agreement a =
            agreement(m_source, m_source.coarse, source_probes, m_target, m_target.coarse, target_probes, c.pose,
                      m_coarse_tolerance.distance, m_coarse_tolerance.minimal_cosine, 1.2f * m_spacing);
        c.score = a.overlap - 1.5f * a.violations;
      });
      sort_by_score(candidates);
    };
    refine(200, {1.5f, 1.5f, 1.f});
    if (candidates.size() > 4 * number) candidates.resize(4 * number);
    refine(400, {1.f, 0.5f, 0.5f, 0.5f});
    // Some from around each pose, as not all end in it; not all from around the best one, as it needs rivals.
    constexpr auto most_of_one = 3;
    std::vector<Candidate> best;
    for (const Candidate& c : candidates) {
      if (best.size() == number) break;
      const auto count = [&](const auto& is_near) {
        return std::count_if(best.begin(), best.end(), [&](const Candidate& k) { return is_near(c.pose, k.pose); });
      };
      if (count([&](const Pose& x, const Pose& y) { return are_close(x, y); }) == 0 &&
          count([&](const Pose& x, const Pose& y) { return are_one(x, y); }) < most_of_one)
        best.push_back(c);
    }
    return best;
  }

  // A pose after refinement on the fine surfels.
  Judged_pose judge(Pose pose) const
  {
    const float spacing = (std::max)(m_source.fine.spacing, m_target.fine.spacing);
    // The first steps are the longest, and fewer probes tell them.
    const Probes some(m_source.fine.probes, 0, 800);
    for (float reach : {2.f, 2.f, 2.f, 1.25f})
      if (refine_step(m_source.fine, some, m_target.fine, {reach * spacing, 0.8f}, pose) < 6) break;
    for (float reach : {1.25f, 0.75f})
      if (refine_step(m_source.fine, m_fine_source_probes, m_target.fine, {reach * spacing, 0.8f}, pose) < 6) break;
    return assess(pose);
  }

  // A pose as it is.
  Judged_pose assess(const Pose& pose) const
  {
    const Agreement a =
        agreement(m_source, m_source.fine, m_fine_source_probes, m_target, m_target.fine, m_fine_target_probes, pose,
                  m_fine_tolerance.distance, m_fine_tolerance.minimal_cosine,
                  3 * float((std::max)(m_source.spacing, m_target.spacing)));
    return {pose, a.overlap, a.violations};
  }

private:
  // Planes and spheres match themselves everywhere; so many candidates are enough to show it.
  static constexpr std::size_t most_candidates = 100000;

  struct Source_pair
  {
    std::int32_t first, second;
    Pair_angles angles;
    std::uint32_t count; // of target pairs to look at
    std::uint8_t scale;
  };

  struct Tolerance
  {
    float distance, minimal_cosine;
  };

  static Tolerance tolerance(const Surfel_level& a, const Surfel_level& b, float times_height, float times_normal)
  {
    const float height = times_height * (std::max)(a.height_noise, b.height_noise),
                turn = times_normal * (std::max)(a.normal_noise, b.normal_noise);
    return {(std::max)(a.spacing, b.spacing) * (std::min)((std::max)(height, 0.05f), 1.f),
            std::cos((std::min)((std::max)(turn, 0.2f), 0.7f))};
  }

  static void sort_by_score(std::vector<Candidate>& candidates)
  {
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
  }

  void index_scales(const std::vector<float>& scales)
  {
    const std::size_t old = m_indices.size();
    for (const float scale : scales)
      if (std::none_of(m_indices.begin(), m_indices.end(), [&](const auto& i) { return i.first == scale; }))
        m_indices.emplace_back(scale, Surfel_pair_index());
    for_each_index<ConcurrencyTag>(m_indices.size() - old, [&](std::size_t i) {
      auto& [scale, index] = m_indices[old + i];
      index = Surfel_pair_index(m_target.coarse.surfels, scale * m_extent, m_parameters.target_half_width * m_spacing);
    });
  }

  // \pre `scale` is indexed
  const Surfel_pair_index& index_of_scale(float scale) const
  {
    return std::find_if(m_indices.begin(), m_indices.end(), [&](const auto& i) { return i.first == scale; })->second;
  }

  // Poses that refinement will most likely make one: within some spacings and degrees.
  bool are_close(const Pose& a, const Pose& b) const
  {
    const float trace = (a.rotation.array() * b.rotation.array()).sum();
    return trace > 2.989f && (a.translation - b.translation).squaredNorm() < 2.25f * m_spacing * m_spacing;
  }

  // Poses that are no more than 10 degrees and a twentieth of the extent apart.
  bool are_one(const Pose& a, const Pose& b) const
  {
    const float trace = (a.rotation.array() * b.rotation.array()).sum();
    return trace > 1 + 2 * 0.985f && (a.translation - b.translation).norm() < 0.05f * m_extent;
  }

  // Keeps `judged` sorted and its poses distinct: the best of each.
  void add_distinct(const Judged_pose& pose, std::vector<Judged_pose>& judged) const
  {
    const auto same = [&](const Judged_pose& other) { return are_one(pose.pose, other.pose); };
    for (const Judged_pose& other : judged)
      if (other.score() >= pose.score() && same(other)) return;
    judged.erase(std::remove_if(judged.begin(), judged.end(), same), judged.end());
    judged.insert(std::find_if(judged.begin(), judged.end(),
                               [&](const Judged_pose& other) { return other.score() < pose.score(); }),
                  pose);
  }

  // Leaves the best, by the score of that many probes: others for each candidate, since the candidates near the right
  // pose are many, and any few probes may all lie outside of the overlap.
  void narrow(std::vector<Candidate>& candidates, std::size_t probes, std::size_t left) const
  {
    if (candidates.size() <= left) return;
    score(candidates, probes, probes);
    candidates.resize(left);
  }

  // Scores the candidates by that many probes of either scan, from `stride` further on for each candidate; the best
  // come first.
  void score(std::vector<Candidate>& candidates, std::size_t probes, std::size_t stride = 0) const
  {
    for_each_index<ConcurrencyTag>(candidates.size(), m_control, [&](std::size_t i) {
      Candidate& c = candidates[i];
      const Agreement a =
          agreement(m_source, m_source.coarse, Probes(m_source.coarse.probes, i * stride, probes), m_target,
                    m_target.coarse, Probes(m_target.coarse.probes, i * stride, probes), c.pose,
                    m_parameters.distance * m_spacing, m_parameters.minimal_cosine, 1.2f * m_spacing);
      c.score = a.overlap - 1.5f * a.violations;
    });
    sort_by_score(candidates);
  }

  // Pairs (V, v1) of the source for the next origins, the rarest in the target first: they say the most for each look.
  std::vector<Source_pair> choose_pairs(const Search_round& round)
  {
    std::vector<Source_pair> pairs;
    std::vector<std::vector<std::int32_t>> shells(round.scales.size());
    const float width = m_parameters.source_half_width * m_spacing;
    const float longest = round.scales.front() * m_extent + width;
    index_scales(round.scales);
    for (int o = 0; o < round.origins && m_next_origin < m_origins.size(); ++o, ++m_next_origin) {
      const std::int32_t v = m_origins[m_next_origin];
      const Surfel& origin = m_source.coarse.surfels[std::size_t(v)];
      for (auto& s : shells) s.clear();
      m_grid.for_each_within(origin.position.cast<double>(), double(longest), [&](std::int32_t j, double d2) {
        if (m_source.coarse.borders[std::size_t(j)]) return;
        const float d = std::sqrt(float(d2));
        for (std::size_t k = 0; k < shells.size(); ++k)
          if (std::abs(d - round.scales[k] * m_extent) <= width) shells[k].push_back(j);
      });
      for (std::size_t k = 0; k < shells.size(); ++k) {
        const Surfel_pair_index& index = index_of_scale(round.scales[k]);
        for (int n = 0; n < round.pairs && !shells[k].empty(); ++n) {
          const std::size_t r = Counter_random::mixed(std::uint64_t(v) * 64 + std::uint64_t(n)) % shells[k].size();
          Source_pair p;
          p.first = v;
          p.second = shells[k][r];
          shells[k][r] = shells[k].back();
          shells[k].pop_back();
          p.scale = std::uint8_t(k);
          if (!pair_angles(origin, m_source.coarse.surfels[std::size_t(p.second)], p.angles)) continue;
          p.count = std::uint32_t(index.count(p.angles));
          if (p.count > 0) pairs.push_back(p);
        }
      }
    }
    if (m_next_origin == m_origins.size()) m_next_origin = 0;
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const Source_pair& a, const Source_pair& b) { return a.count < b.count; });
    return pairs;
  }

  // A surfel of the source in the frame of a pair: pair_frame() about the pair's middle.
  struct Witness
  {
    Vector_f position, normal;
  };

  // `frame`, `middle`: of the target's pair.
  bool has_counterpart(const Witness& w, const Matrix_f& frame, const Vector_f& middle) const
  {
    const Vector_f p = frame * w.position + middle;
    const int j = m_target.coarse.field.nearest(p);
    if (j < 0) return false;
    const Surfel& t = m_target.coarse.surfels[std::size_t(j)];
    return std::abs(t.normal.dot(p - t.position)) <= m_parameters.distance * m_spacing &&
           (frame * w.normal).dot(t.normal) >= m_parameters.minimal_cosine;
  }

  // Surfels around the pair. The first two are v2 and v3: furthest from the line through V and v1, on either side.
  bool choose_witnesses(const Source_pair& p, std::vector<Witness>& witnesses) const
  {
    const Surfel &a = m_source.coarse.surfels[std::size_t(p.first)],
                 &b = m_source.coarse.surfels[std::size_t(p.second)];
    std::vector<std::int32_t> around;
    const Vector_f middle = 0.5f * (a.position + b.position);
    const float reach = (std::max)(m_parameters.witness_reach * m_extent, 4 * m_spacing);
    m_grid.for_each_within(middle.cast<double>(), double(reach), [&](std::int32_t j, double) {
      if (!m_source.coarse.borders[std::size_t(j)]) around.push_back(j);
    });
    if (around.size() < 10) return false;
    const std::uint64_t seed = std::uint64_t(p.first) << 32 | std::uint64_t(p.second) << 8;
    const Matrix_f to_pair = pair_frame(a, b).transpose();
    witnesses.clear();
    for (int w = 0; w < m_parameters.witnesses; ++w) {
      const std::size_t r = Counter_random::mixed(seed + std::uint64_t(w)) % around.size();
      const Surfel& s = m_source.coarse.surfels[std::size_t(around[r])];
      witnesses.push_back({to_pair * (s.position - middle), to_pair * s.normal});
    }
    // The line is the first axis.
    const auto arm = [](const Witness& w) -> Vector_f { return {0, w.position[1], w.position[2]}; };
    std::iter_swap(witnesses.begin(),
                   std::max_element(witnesses.begin(), witnesses.end(), [&](const Witness& x, const Witness& y) {
                     return arm(x).squaredNorm() < arm(y).squaredNorm();
                   }));
    const Vector_f opposite = -arm(witnesses.front());
    std::iter_swap(witnesses.begin() + 1,
                   std::max_element(witnesses.begin() + 1, witnesses.end(), [&](const Witness& x, const Witness& y) {
                     return arm(x).dot(opposite) < arm(y).dot(opposite);
                   }));
    return true;
  }

  // What a pair of the source matches.
  struct Matches
  {
    std::size_t looks = 0, hits = 0;
    std::vector<Candidate> candidates;
  };

  // The candidates of the pairs, in their order, as far as the round's number of looks goes.
  std::vector<Candidate> match(const std::vector<Source_pair>& pairs, const Search_round& round)
  {
    std::vector<std::size_t> looks(round.scales.size(), round.looks / round.scales.size());
    std::vector<const Source_pair*> chosen;
    for (const Source_pair& p : pairs) {
      if (looks[p.scale] < p.count) continue;
      looks[p.scale] -= p.count;
      chosen.push_back(&p);
    }
    // In blocks that are the same whatever the number of threads, and that hold no more matches than are wanted: of
    // planes and spheres a single pair has thousands.
    constexpr std::size_t block = 128;
    std::vector<Candidate> candidates;
    for (std::size_t from = 0, to = 0;
         from < chosen.size() && candidates.size() <= most_candidates && m_control.go_on(); from = to) {
      for (std::size_t n = candidates.size(); to < chosen.size() && to - from < block && n <= most_candidates; ++to)
        n += chosen[to]->count;
      std::vector<Matches> found(to - from);
      for_each_index<ConcurrencyTag>(found.size(), m_control,
                                     [&](std::size_t i) { found[i] = match(*chosen[from + i], round); });
      for (const Matches& m : found) {
        m_counts.looks += m.looks;
        m_counts.hits += m.hits;
        candidates.insert(candidates.end(), m.candidates.begin(), m.candidates.end());
      }
    }
    return candidates;
  }

  Matches match(const Source_pair& p, const Search_round& round) const
  {
    Matches matches;
    std::vector<Witness> witnesses;
    if (!choose_witnesses(p, witnesses)) return matches;
    const Surfel &a = m_source.coarse.surfels[std::size_t(p.first)],
                 &b = m_source.coarse.surfels[std::size_t(p.second)];
    const Vector_f middle = 0.5f * (a.position + b.position);
    const Matrix_f source_frame = pair_frame(a, b).transpose();
    const Curvature_window window(Pair_curvatures::of(a, b), int(float(round.curvature_tolerance) * m_curvature_noise));
    const auto examine = [&](const Surfel_pair_index::Entry& e) {
      const Surfel &c = m_target.coarse.surfels[e.first], &c1 = m_target.coarse.surfels[e.second];
      const Matrix_f frame = pair_frame(c, c1);
      const Vector_f there = 0.5f * (c.position + c1.position);
      if (!has_counterpart(witnesses[0], frame, there) || !has_counterpart(witnesses[1], frame, there)) return;
      int support = 2;
      const int n = m_parameters.witnesses, needed = m_parameters.witnesses_needed;
      for (int w = 2; w < n && support + n - w >= needed; ++w)
        support += has_counterpart(witnesses[std::size_t(w)], frame, there);
      if (support < needed) return;
      Pose pose;
      pose.rotation = frame * source_frame;
      pose.translation = there - pose.rotation * middle;
      matches.candidates.push_back({pose, 0});
    };
    const auto look = [&](const Surfel_pair_index::Entry* from, const Surfel_pair_index::Entry* to) {
      matches.looks += std::size_t(to - from);
      // Some at a time, without a branch: which of them have the curvatures cannot be foretold.
      std::array<Surfel_pair_index::Entry, 64> hits;
      while (from != to) {
        const auto* const end = from + (std::min)(to - from, std::ptrdiff_t(hits.size()));
        std::size_t n = 0;
        for (; from != end; ++from) {
          hits[n] = *from;
          n += window.contains(from->curvatures);
        }
        matches.hits += n;
        for (std::size_t i = 0; i < n; ++i) examine(hits[i]);
      }
    };
    index_of_scale(round.scales[p.scale]).for_each_run(p.angles, look);
    return matches;
  }

  const Prepared_scan& m_source;
  const Prepared_scan& m_target;
  const Search_parameters m_parameters;
  Run_control& m_control;
  const Probes m_fine_source_probes, m_fine_target_probes;
  float m_spacing = 0, m_extent = 0, m_curvature_noise = 1;
  Tolerance m_coarse_tolerance, m_fine_tolerance;
  Point_grid m_grid;
  std::vector<std::int32_t> m_origins;
  std::vector<std::pair<float, Surfel_pair_index>> m_indices;
  std::size_t m_next_origin = 0;
  Search_counts m_counts;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_POSE_SEARCH_H
