// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_REGISTER_PREPARED_SCANS_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_REGISTER_PREPARED_SCANS_H

#include <CGAL/Crude_registration/internal/Pose_search.h>
#include <CGAL/Crude_registration/internal/point_to_plane.h>

#include <chrono>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// A target of refine(): the fine surfels' planes.
class Surfel_target
{
public:
  explicit Surfel_target(const Surfel_level& level) : m_level(level) {}

  bool closest(const Vector& query, double reach, Surface_point& answer) const
  {
    const int i = m_level.field.nearest(query.cast<float>());
    if (i < 0) return false;
    const Surfel& s = m_level.surfels[std::size_t(i)];
    const Vector n = s.normal.cast<double>(), d = query - s.position.cast<double>();
    const double height = n.dot(d);
    const double aside = (d - height * n).norm();
    if (std::abs(height) > reach || aside > 1.2 * double(m_level.spacing)) return false;
    answer = {query - height * n, n, false};
    return true;
  }

private:
  const Surfel_level& m_level;
};

struct Registration_outcome
{
  std::vector<Judged_pose> poses; // distinct, best first; in own frames
  bool is_swapped = false;        // the poses map the target to the source
  Rigid_motion crude, motion;     // target from source, in the frames of the input
  Refinement refinement;          // in own frames
  float runner_up = 0;
  Search_counts counts;
  double search_seconds = 0, refine_seconds = 0;
};

inline Rigid_motion to_rigid_motion(const Pose& pose)
{
  Rigid_motion m;
  // the nearest rotation in double: a float's is orthogonal to seven digits only
  m.rotation = Eigen::Quaterniond(Matrix(pose.rotation.cast<double>())).normalized().toRotationMatrix();
  m.translation = pose.translation.cast<double>();
  return m;
}

// The scan with fewer surfels is looked for in the other one; equal ones are told apart by size, so that swapping the
// arguments gives the inverse.
inline bool are_swapped(const Prepared_scan& source, const Prepared_scan& target)
{
  if (source.coarse.surfels.size() != target.coarse.surfels.size())
    return source.coarse.surfels.size() > target.coarse.surfels.size();
  return source.extent > target.extent;
}

inline Registration_outcome register_prepared_scans(const Prepared_scan& a, const Prepared_scan& b,
                                                    const Search_parameters& parameters = {})
{
  Registration_outcome outcome;
  outcome.is_swapped = are_swapped(a, b);
  const Prepared_scan &source = outcome.is_swapped ? b : a, &target = outcome.is_swapped ? a : b;
  const auto start = std::chrono::steady_clock::now();
  Pose_search<> search(source, target, parameters);
  outcome.poses = search();
  outcome.counts = search.counts();
  const auto middle = std::chrono::steady_clock::now();
  outcome.search_seconds = std::chrono::duration<double>(middle - start).count();
  if (outcome.poses.empty()) return outcome;
  if (outcome.poses.size() > 1) outcome.runner_up = outcome.poses[1].score();

  std::vector<Vector> points, normals;
  for (const std::int32_t i : search.fine_source_probes(4000)) {
    const Surfel& s = source.fine.surfels[std::size_t(i)];
    points.push_back(s.position.cast<double>());
    normals.push_back(s.normal.cast<double>());
  }
  const Surfel_target surface(target.fine);
  Refinement_options options{};
  options.sampling_distance = (std::max)(source.spacing, target.spacing);
  options.reach = 2 * options.sampling_distance;
  options.tolerance = 1e-3;
  Point_to_plane<CGAL::Sequential_tag, Surfel_target> refine(points, normals, surface, options);
  const Rigid_motion crude = to_rigid_motion(outcome.poses.front().pose);
  outcome.refinement = refine(crude);
  const auto to_input = [&](const Rigid_motion& m) {
    const Rigid_motion in_input = target.own_from_input.inverse() * m * source.own_from_input;
    return outcome.is_swapped ? in_input.inverse() : in_input;
  };
  outcome.crude = to_input(crude);
  outcome.motion = to_input(outcome.refinement.motion);
  outcome.refine_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - middle).count();
  return outcome;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_REGISTER_PREPARED_SCANS_H
