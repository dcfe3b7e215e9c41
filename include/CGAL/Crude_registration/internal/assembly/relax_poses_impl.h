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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_RELAX_POSES_IMPL_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_RELAX_POSES_IMPL_H

// The steps of relax_poses.h.

#include <CGAL/Crude_registration/internal/assembly/relax_poses.h>
#include <CGAL/Crude_registration/internal/motion/Nearest_surfel.h>
#include <CGAL/Crude_registration/internal/motion/Normal_equations.h>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

class Pose_relaxation
{
public:
  Pose_relaxation(const Placed_scans& placed, const std::vector<std::size_t>& scans,
                  const std::vector<std::size_t>& bodies, Execution execution, Run_control& control)
      : m_placed(placed), m_scans(scans), m_bodies(bodies), m_unknowns(*std::max_element(bodies.begin(), bodies.end())),
        m_execution(execution), m_control(control)
  {}

  Relaxation operator()(const std::vector<Rigid_motion>& initial)
  {
    Relaxation result;
    result.poses = initial;
    choose_pairs(initial);
    find_scale(initial);
    use(FINE);
    match_all(initial);
    find_sigmas();
    for (Pair& pair : m_pairs) pair.fixed_sigma = pair.sigma;
    result.objective = result.initial_objective = objective(initial);
    if (m_unknowns > 0) {
      // The coarse surfels reach further, where the poses have drifted; what was near enough may do without.
      for (const bool with_coarse : {true, false}) {
        std::vector<Rigid_motion> poses = initial;
        if (with_coarse) {
          use(COARSE);
          result.iterations += iterate(poses, most_coarse_iterations);
        }
        use(FINE);
        result.iterations += iterate(poses, most_iterations);
        if (m_control.is_stopped()) break;
        const double there = objective(poses);
        if (!(there < result.objective)) continue;
        result.objective = there;
        result.poses = poses;
        break;
      }
    }
    conclude(result);
    return result;
  }

private:
  enum Level
  {
    COARSE,
    FINE
  };
  static constexpr std::size_t most_coarse_iterations = 10, most_iterations = 30;
  // As in the refinement of a pair.
  static constexpr double biweight_reach = 4.685, smallest_sigma = 1e-3, smallest_normal_cosine = 0.70710678118654752;
  static constexpr double tolerance = 1e-2; // of a sampling distance
  // A surfel's plane goes astray beyond its cell, where the surface bends; to tell an overlap there have to be no gaps.
  static constexpr double own_cell = 0.5, without_gaps = Nearest_surfel::beyond;

  struct Match
  {
    Vector source, normal; // in the frame of the part; the source half way to the target
    double residual;
  };

  // What the probes of one scan find on another one.
  struct Pair
  {
    std::size_t source, target; // places among m_scans
    std::size_t probes = 0;
    std::vector<Match> matches;
    double sigma = 0, fixed_sigma = 0; // the scale of the residuals: now, and for comparisons
    Normal_equations<double> equations;
  };

  const Reduced_scan& scan(std::size_t k) const { return m_placed.scan(m_scans[k]); }
  const Surfel_level& level(std::size_t k) const { return m_level == FINE ? scan(k).fine : scan(k).coarse; }

  // Both ways, of those that overlap; where they are many, of each scan those that overlap most.
  void choose_pairs(const std::vector<Rigid_motion>& poses)
  {
    constexpr double least_overlap = 0.03;
    constexpr std::size_t most_partners = 16;
    const std::size_t n = m_scans.size();
    std::vector<std::vector<std::pair<double, std::size_t>>> partners(n);
    for_each_index(m_execution, n, to_the_end(), [&](std::size_t i) {
      for (std::size_t j = 0; j < n; ++j) {
        if (j == i) continue;
        const Rigid_motion motion = poses[j].inverse() * poses[i];
        const double overlap = (std::max)(m_placed.meeting(m_scans[i], m_scans[j], motion).overlap,
                                          m_placed.meeting(m_scans[j], m_scans[i], motion.inverse()).overlap);
        if (overlap >= least_overlap) partners[i].emplace_back(overlap, j);
      }
      std::stable_sort(partners[i].begin(), partners[i].end(),
                       [](const auto& a, const auto& b) { return a.first > b.first; });
      if (partners[i].size() > most_partners) partners[i].resize(most_partners);
    });
    std::vector<std::uint8_t> is_pair(n * n, 0);
    for (std::size_t i = 0; i < n; ++i)
      for (const auto& p : partners[i]) is_pair[i * n + p.second] = is_pair[p.second * n + i] = 1;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) {
        if (is_pair[i * n + j] == 0) continue;
        m_pairs.emplace_back();
        m_pairs.back().source = i;
        m_pairs.back().target = j;
      }
  }

  // The centre and the size of the part: unknowns are turns about the centre, times the size, and shifts.
  void find_scale(const std::vector<Rigid_motion>& poses)
  {
    std::vector<Vector> centres;
    m_centre = Vector::Zero();
    for (std::size_t k = 0; k < m_scans.size(); ++k) {
      centres.push_back(poses[k](m_placed.centre(m_scans[k])));
      m_centre += centres.back() / double(m_scans.size());
    }
    double sum = 0;
    for (std::size_t k = 0; k < m_scans.size(); ++k) {
      const double deviation = m_placed.deviation(m_scans[k]);
      sum += (centres[k] - m_centre).squaredNorm() + deviation * deviation;
    }
    m_radius = std::sqrt(sum / double(m_scans.size()));
    if (!(m_radius > 0)) m_radius = 1;
  }

  void use(Level level)
  {
    m_level = level;
    // All surfels of each scan; fewer where the pairs are very many.
    constexpr std::size_t most_matches = 4000000, fewest_probes = 500;
    m_most_probes = (std::max)(fewest_probes, most_matches / (std::max)(m_pairs.size(), std::size_t(1)));
  }

  void match(Pair& pair, const std::vector<Rigid_motion>& poses) const
  {
    const Surfel_level &source = level(pair.source), &target = level(pair.target);
    const Nearest_surfel surface{target.surfels, target.field,
                                 m_aside / Nearest_surfel::beyond * double(target.spacing)};
    const Rigid_motion &pose = poses[pair.source], &target_pose = poses[pair.target];
    const Rigid_motion motion = target_pose.inverse() * pose;
    const double reach = double(target.spacing);
    pair.matches.clear();
    const bool all = source.surfels.size() <= m_most_probes;
    pair.probes = all ? source.surfels.size() : (std::min)(m_most_probes, source.probes.size());
    for (std::size_t k = 0; k < pair.probes; ++k) {
      const Surfel& s = source.surfels[all ? k : std::size_t(source.probes[k])];
      const Vector p = motion(s.position.cast<double>());
      Surface_point closest;
      if (!surface.closest(p, reach, closest)) continue;
      const Vector normal = motion.rotation * s.normal.cast<double>();
      if (!(normal.dot(closest.normal) > smallest_normal_cosine)) continue;
      const Vector n = (normal + closest.normal).normalized();
      pair.matches.push_back(
          {target_pose(Vector(0.5 * (p + closest.point))), target_pose.rotation * n, (closest.point - p).dot(n)});
    }
  }

  void match_all(const std::vector<Rigid_motion>& poses)
  {
    for_each_index(m_execution, m_pairs.size(), to_the_end(), [&](std::size_t q) { match(m_pairs[q], poses); });
  }

  double spacing(const Pair& pair) const { return (std::max)(scan(pair.source).spacing, scan(pair.target).spacing); }

  void find_sigmas()
  {
    std::vector<double> sizes;
    for (Pair& pair : m_pairs) {
      pair.sigma = smallest_sigma * spacing(pair);
      if (pair.matches.empty()) continue;
      sizes.clear();
      for (const Match& m : pair.matches) sizes.push_back(std::abs(m.residual));
      const auto middle = sizes.begin() + std::ptrdiff_t(sizes.size() / 2);
      std::nth_element(sizes.begin(), middle, sizes.end());
      pair.sigma = (std::max)(pair.sigma, 1.4826 * *middle);
    }
  }

  // The sum over all probes of the biweight's loss, which is 1 where nothing is near. The scale is that of the start:
  // what is compared is the same.
  double objective(const std::vector<Rigid_motion>& poses)
  {
    std::vector<double> sums(m_pairs.size(), 0);
    for_each_index(m_execution, m_pairs.size(), to_the_end(), [&](std::size_t q) {
      Pair& pair = m_pairs[q];
      match(pair, poses);
      sums[q] = double(pair.probes - pair.matches.size());
      for (const Match& m : pair.matches) {
        const double u = m.residual / (biweight_reach * pair.fixed_sigma), v = (std::max)(0., 1 - u * u);
        sums[q] += 1 - v * v * v;
      }
    });
    double sum = 0;
    for (const double s : sums) sum += s;
    return sum;
  }

  // The normal equations of each pair: with r the residual of a match, n its normal and p its place,
  //   sum w (r - (p x n) . (a_i - a_j) - n . (t_i - t_j))^2 -> min
  // for small turns a and shifts t of its two scans i and j.
  void accumulate(Pair& pair) const
  {
    pair.equations = {};
    const double variance = pair.sigma * pair.sigma;
    for (const Match& m : pair.matches) {
      const double u = m.residual / (biweight_reach * pair.sigma);
      pair.equations.add((m.source - m_centre).cross(m.normal) / m_radius, m.normal, m.residual,
                         biweight(u * u) / variance);
    }
  }

  using Sparse = Eigen::SparseMatrix<double>;

  // The equations of all bodies but the first, which is fixed; what nothing determines stays.
  Sparse normal_matrix(Eigen::VectorXd& right) const
  {
    const std::size_t n = m_unknowns;
    right = Eigen::VectorXd::Zero(Eigen::Index(6 * n));
    std::vector<Eigen::Triplet<double>> entries;
    const auto add = [&](std::size_t i, std::size_t j, const Matrix_6& block) {
      if (i == 0 || j == 0) return;
      for (int r = 0; r < 6; ++r)
        for (int c = 0; c < 6; ++c) entries.emplace_back(int(6 * (i - 1)) + r, int(6 * (j - 1)) + c, block(r, c));
    };
    for (const Pair& pair : m_pairs) {
      const Matrix_6 block = pair.equations.left.selfadjointView<Eigen::Lower>();
      const std::size_t source = m_bodies[pair.source], target = m_bodies[pair.target];
      if (source == target) continue;
      add(source, source, block);
      add(target, target, block);
      add(source, target, -block);
      add(target, source, -block);
      if (source > 0) right.segment<6>(Eigen::Index(6 * (source - 1))) += pair.equations.right;
      if (target > 0) right.segment<6>(Eigen::Index(6 * (target - 1))) -= pair.equations.right;
    }
    // As if each scan were known to within its part's size already.
    const double damping = 1 / (m_radius * m_radius);
    for (std::size_t k = 0; k < 6 * n; ++k) entries.emplace_back(int(k), int(k), damping);
    Sparse matrix(Eigen::Index(6 * n), Eigen::Index(6 * n));
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }

  // A small motion of the unknowns.
  Rigid_motion motion_of(const Vector_6& x) const
  {
    Vector_6 twist;
    twist.head<3>() = x.head<3>() / m_radius;
    twist.tail<3>() = x.tail<3>() - twist.head<3>().cross(m_centre);
    return exponential(twist, 1);
  }

  std::size_t iterate(std::vector<Rigid_motion>& poses, std::size_t most)
  {
    for (std::size_t iteration = 0; iteration < most; ++iteration) {
      for_each_index(m_execution, m_pairs.size(), m_control, [&](std::size_t q) { match(m_pairs[q], poses); });
      if (m_control.is_stopped()) return iteration;
      find_sigmas();
      for (Pair& pair : m_pairs) accumulate(pair);
      Eigen::VectorXd right;
      const Sparse matrix = normal_matrix(right);
      const Eigen::SimplicialLDLT<Sparse> solver(matrix);
      if (solver.info() != Eigen::Success) return iteration;
      const Eigen::VectorXd x = solver.solve(right);
      double largest = 0; // in sampling distances
      for (std::size_t k = 0; k < poses.size(); ++k) {
        if (m_bodies[k] == 0) continue;
        const Rigid_motion moved = motion_of(x.segment<6>(Eigen::Index(6 * (m_bodies[k] - 1)))) * poses[k];
        largest = (std::max)(largest, m_placed.displacement(m_scans[k], moved, poses[k]) / scan(k).spacing);
        poses[k] = moved;
      }
      if (largest <= tolerance) return iteration + 1;
    }
    return most;
  }

  void conclude(Relaxation& result)
  {
    const std::size_t n = m_scans.size();
    result.covariances.assign(n, Matrix_6::Zero());
    result.residuals.assign(n, 0);
    std::vector<double> squares(n, 0), counts(n, 0);
    m_aside = without_gaps;
    match_all(result.poses);
    for (const Pair& pair : m_pairs) {
      // As far as the refinement of a pair counts.
      double sum = 0, count = 0;
      const double reach = 2 * spacing(pair);
      for (const Match& m : pair.matches) {
        if (std::abs(m.residual) > reach) continue;
        sum += m.residual * m.residual;
        count += 1;
      }
      if (count == 0) continue;
      const double square = sum / (spacing(pair) * spacing(pair));
      result.pairs.push_back(
          {m_scans[pair.source], m_scans[pair.target], count / double(pair.probes), std::sqrt(square / count)});
      for (const std::size_t k : {pair.source, pair.target}) {
        squares[k] += square;
        counts[k] += count;
      }
    }
    for (std::size_t k = 0; k < n; ++k)
      if (counts[k] > 0) result.residuals[k] = std::sqrt(squares[k] / counts[k]);
    if (m_unknowns == 0) return;
    m_aside = own_cell;
    match_all(result.poses);
    find_sigmas();
    for (Pair& pair : m_pairs) accumulate(pair);
    Eigen::VectorXd right;
    // Both scans of a pair ask each other: every distance is there twice.
    const Eigen::SimplicialLDLT<Sparse> solver(Sparse(0.5 * normal_matrix(right)));
    if (solver.info() != Eigen::Success) return;
    // From (radius w, shift of the centre) to (w, shift of the origin).
    Matrix_6 to_origin = Matrix_6::Zero();
    to_origin.topLeftCorner<3, 3>() = Matrix::Identity() / m_radius;
    to_origin.bottomRightCorner<3, 3>() = Matrix::Identity();
    to_origin.bottomLeftCorner<3, 3>() = cross_matrix(m_centre) / m_radius;
    for (std::size_t k = 0; k < n; ++k) {
      if (m_bodies[k] == 0) continue;
      const Eigen::Index from = Eigen::Index(6 * (m_bodies[k] - 1));
      Matrix_6 block;
      for (int c = 0; c < 6; ++c) {
        const Eigen::VectorXd column = solver.solve(Eigen::VectorXd::Unit(Eigen::Index(6 * m_unknowns), from + c));
        block.col(c) = column.segment<6>(from);
      }
      const Matrix_6 covariance = to_origin * block * to_origin.transpose();
      result.covariances[k] = 0.5 * (covariance + covariance.transpose());
    }
  }

  const Placed_scans& m_placed;
  const std::vector<std::size_t>&m_scans, &m_bodies;
  const std::size_t m_unknowns; // bodies that move
  const Execution m_execution;
  Run_control& m_control;
  std::vector<Pair> m_pairs;
  Level m_level = FINE;
  std::size_t m_most_probes = 0;
  Vector m_centre = Vector::Zero();
  double m_radius = 1;
  double m_aside = own_cell; // how far a surfel stands for the surface, in spacings
};

CGAL_CRUDE_REGISTRATION_INLINE Relaxation relax_poses(const Placed_scans& placed, const std::vector<std::size_t>& scans,
                                                      const std::vector<Rigid_motion>& poses,
                                                      const std::vector<std::size_t>& bodies, Execution execution,
                                                      Run_control& control)
{
  return Pose_relaxation(placed, scans, bodies, execution, control)(poses);
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_RELAX_POSES_IMPL_H
