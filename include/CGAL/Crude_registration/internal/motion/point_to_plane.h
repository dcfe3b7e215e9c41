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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_POINT_TO_PLANE_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_POINT_TO_PLANE_H

// Robust point-to-plane registration of points with normals to any surface that answers where it is closest.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/internal/base/for_each_index.h>
#include <CGAL/Crude_registration/internal/base/symmetric_eigen.h>
#include <CGAL/Crude_registration/internal/motion/Normal_equations.h>
#include <CGAL/Crude_registration/internal/motion/Refinement.h>
#include <CGAL/Crude_registration/internal/motion/Surface_point.h>
#include <CGAL/Crude_registration/internal/motion/twist.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Robust point-to-plane registration.
template <class Target>
class Point_to_plane
{
public:
  Point_to_plane(const std::vector<Vector>& points, const std::vector<Vector>& normals, const Target& target,
                 const Refinement_options& options, Execution execution = Execution::SEQUENTIAL)
      : m_points(points), m_normals(normals), m_target(target), m_options(options), m_execution(execution),
        m_matches(points.size())
  {}

  Refinement operator()(const Rigid_motion& initial)
  {
    Refinement result;
    result.motion = initial;
    const double s = m_options.sampling_distance;
    double reach = (std::max)(m_options.reach, shortest_reach * s);
    while (!result.is_converged && result.iterations < m_options.maximum_number_of_iterations) {
      find_matches(result.motion, reach);
      if (m_used.size() < fewest_matches) break;
      weigh_matches();
      accumulate();
      const Rigid_motion step = solve();
      result.motion = step * result.motion;
      ++result.iterations;
      result.is_converged = displacement(step) <= m_options.tolerance * s;
      reach = (std::max)(shortest_reach * s, (std::min)(reach, 4 * median_distance()));
    }
    evaluate(result);
    return result;
  }

private:
  // Neighbouring samples of two scans of one surface are less than s apart; twice that leaves room for noise.
  static constexpr double shortest_reach = 2;
  // Correspondences whose normals differ by more than 45 degrees are not of the same piece of surface (Rusinkiewicz and
  // Levoy 2001, section 3.4).
  static constexpr double smallest_normal_cosine = 0.70710678118654752;
  // 95 % efficiency of Tukey's biweight for normal errors.
  static constexpr double biweight_reach = 4.685;
  static constexpr std::size_t fewest_matches = 6;
  // Scale of residuals, in units of s, and of errors of normals, in radians, that counts as none: what the sampling of
  // a surface without noise leaves.
  static constexpr double smallest_sigma = 1e-3;
  static constexpr double smallest_normal_sigma = 5e-3;

  struct Match
  {
    Vector source, target, normal;
    double residual, normal_difference, weight;
    enum
    {
      NONE,
      BORDER,
      USED
    } kind;
  };

  void find_matches(const Rigid_motion& motion, double reach)
  {
    for_each_index(m_execution, m_matches.size(), to_the_end(), [&](std::size_t i) {
      Match& match = m_matches[i];
      match.kind = Match::NONE;
      match.source = motion(m_points[i]);
      Surface_point closest;
      if (m_normals[i].isZero() || !m_target.closest(match.source, reach, closest)) return;
      const Vector normal = motion.rotation * m_normals[i];
      if (!(normal.dot(closest.normal) > smallest_normal_cosine)) return;
      match.kind = closest.is_on_border ? Match::BORDER : Match::USED;
      match.target = closest.point;
      match.normal = (normal + closest.normal).normalized();
      match.normal_difference = (normal - closest.normal).squaredNorm();
      match.residual = (match.target - match.source).dot(match.normal);
    });
    m_used.clear();
    for (std::size_t i = 0; i < m_matches.size(); ++i)
      if (m_matches[i].kind == Match::USED) m_used.push_back(i);
  }

  template <class Value>
  double median(const Value& value)
  {
    m_scratch.clear();
    for (std::size_t i : m_used) m_scratch.push_back(value(m_matches[i]));
    const auto middle = m_scratch.begin() + std::ptrdiff_t(m_scratch.size() / 2);
    std::nth_element(m_scratch.begin(), middle, m_scratch.end());
    return *middle;
  }

  double median_distance()
  {
    return median([](const Match& m) { return (m.target - m.source).norm(); });
  }

  // Tukey's biweight at the scale of the residuals' median; surfaces that agree to rounding keep a scale above it.
  void weigh_matches()
  {
    const double sigma = (std::max)(1.4826 * median([](const Match& m) { return std::abs(m.residual); }),
                                    smallest_sigma * m_options.sampling_distance);
    for (std::size_t i : m_used) {
      Match& m = m_matches[i];
      const double u = m.residual / (biweight_reach * sigma);
      m.weight = biweight(u * u);
    }
  }

  // The normal equations of Rusinkiewicz, "A symmetric objective function for ICP", 2019: with p, q the source and
  // target points, p', q' the same relative to their means and n the normal between theirs,
  //   sum w ((p - q) . n + ((p' + q') / 2 x n) . a + n . t)^2 -> min
  // for a turn a of the source and a displacement t of its mean. It is Chen and Medioni's point-to-plane distance where
  // the surface is flat, and exact where it is curved evenly, so that fewer steps are needed. Rotations are measured by
  // the displacement at the distance m_radius, so that the six unknowns have one unit.
  void accumulate()
  {
    m_total_weight = 0;
    m_source_mean = m_target_mean = Vector::Zero();
    const Vector source_origin = m_matches[m_used.front()].source, target_origin = m_matches[m_used.front()].target;
    for (std::size_t i : m_used) {
      const Match& m = m_matches[i];
      m_total_weight += m.weight;
      m_source_mean += m.weight * (m.source - source_origin);
      m_target_mean += m.weight * (m.target - target_origin);
    }
    m_source_mean = source_origin + m_source_mean / m_total_weight;
    m_target_mean = target_origin + m_target_mean / m_total_weight;

    double spread = 0;
    for (std::size_t i : m_used) spread += m_matches[i].weight * (m_matches[i].source - m_source_mean).squaredNorm();
    m_radius = std::sqrt(spread / m_total_weight);
    if (!(m_radius > 0)) m_radius = m_options.sampling_distance;

    Normal_equations<double> equations;
    m_squared_residuals = 0;
    for (std::size_t i : m_used) {
      const Match& m = m_matches[i];
      const Vector p = m.source - m_source_mean, q = m.target - m_target_mean;
      equations.add((p + q).cross(m.normal) / (2 * m_radius), m.normal, m.residual, m.weight);
      m_squared_residuals += m.weight * m.residual * m.residual;
    }
    m_normal_matrix = equations.left.selfadjointView<Eigen::Lower>();
    m_right_side = equations.right;
  }

  // Variance of the residuals; that of surfaces sampled without noise stays above zero.
  double variance() const
  {
    const double smallest = smallest_sigma * m_options.sampling_distance;
    return (std::max)(m_squared_residuals / m_total_weight, smallest * smallest);
  }

  // The eigenvalue below which the standard deviation of a motion exceeds s.
  double smallest_information() const
  {
    return variance() / (m_options.sampling_distance * m_options.sampling_distance);
  }

  // The step; it has no part along motions about which the matches say nothing.
  Rigid_motion solve() const
  {
    const Symmetric_eigen<Matrix_6> eigen = symmetric_eigen(m_normal_matrix);
    Vector_6 x = Vector_6::Zero();
    for (int k = 0; k < 6; ++k)
      if (eigen.values[k] > smallest_information())
        x += eigen.vectors.col(k).dot(m_right_side) / eigen.values[k] * eigen.vectors.col(k);

    // Both sides turn by half the angle, of tangent |a| / 2, in opposite directions.
    const Vector a = x.head<3>() / (2 * m_radius), t = m_source_mean - m_target_mean + x.tail<3>();
    const double angle = std::atan(a.norm());
    const Matrix half =
        angle > 0 ? Eigen::AngleAxisd(angle, a.normalized()).toRotationMatrix() : Matrix(Matrix::Identity());
    Rigid_motion step;
    step.rotation = half * half;
    step.translation = m_target_mean + std::cos(angle) * (half * t) - step.rotation * m_source_mean;
    return step;
  }

  // RMS displacement of the matched points.
  double displacement(const Rigid_motion& step) const
  {
    double sum = 0;
    for (std::size_t i : m_used) {
      const Match& m = m_matches[i];
      sum += m.weight * (step(m.source) - m.source).squaredNorm();
    }
    return std::sqrt(sum / m_total_weight);
  }

  // What the noise of the normals alone contributes to the normal equations. The variance of one component of one
  // normal comes from the median of the squared differences between the normals of matches, 2 log 2 times the variance
  // of the difference for two components; the mean of two normals has half of it.
  Matrix_6 noise_matrix()
  {
    const double variance = (std::max)(median([](const Match& m) { return m.normal_difference; }) / (8 * std::log(2.)),
                                       smallest_normal_sigma * smallest_normal_sigma / 2);
    Matrix_6 noise = Matrix_6::Zero();
    for (std::size_t i : m_used) {
      const Match& m = m_matches[i];
      const Matrix cross = cross_matrix((m.source - m_source_mean) / m_radius),
                   tangential = m.weight * variance * (Matrix::Identity() - m.normal * m.normal.transpose()),
                   turned = cross * tangential;
      noise.topLeftCorner<3, 3>() -= turned * cross; // the transposed of a cross matrix is its negative
      noise.bottomLeftCorner<3, 3>() += turned.transpose();
      noise.bottomRightCorner<3, 3>() += tangential;
    }
    noise.topRightCorner<3, 3>() = noise.bottomLeftCorner<3, 3>().transpose();
    return noise;
  }

  void evaluate(Refinement& result)
  {
    find_matches(result.motion, shortest_reach * m_options.sampling_distance);
    result.matches = m_used.size();
    std::size_t close = 0;
    for (const Match& m : m_matches)
      if (m.kind != Match::NONE) ++close;
    if (close > 0) result.overlap = double(close) / double(m_points.size());
    if (m_used.size() < fewest_matches) {
      result.is_converged = false;
      result.covariance.diagonal().setConstant((std::numeric_limits<double>::infinity)());
      for (int k = 0; k < 6; ++k) result.free_motions.push_back(Vector_6::Unit(k));
      return;
    }
    double sum = 0;
    for (std::size_t i : m_used) sum += m_matches[i].residual * m_matches[i].residual;
    result.residual = std::sqrt(sum / double(m_used.size()));
    weigh_matches();
    accumulate();

    // From (m_radius w, displacement of the mean) to (w, displacement of the origin).
    Matrix_6 to_origin = Matrix_6::Zero();
    to_origin.topLeftCorner<3, 3>() = Matrix::Identity() / m_radius;
    to_origin.bottomRightCorner<3, 3>() = Matrix::Identity();
    to_origin.bottomLeftCorner<3, 3>() = cross_matrix(m_target_mean) / m_radius;

    // A motion is free where the information about it is less than twice what noise of the normals makes up, or where
    // its standard deviation exceeds s. The eigenvectors v_k of A v = mu N v have v_k^T N v_k = 1 and, with them,
    // A^-1 = sum_k v_k v_k^T / mu_k.
    const Matrix_6 noise = 2 * noise_matrix() + smallest_information() * Matrix_6::Identity();
    const Symmetric_eigen<Matrix_6> eigen = symmetric_eigen(m_normal_matrix, noise);
    for (int k = 0; k < 6; ++k) {
      const double information = eigen.values[k];
      const Vector_6 v = to_origin * eigen.vectors.col(k);
      const double length = eigen.vectors.col(k).norm();
      if (information > 1) result.covariance += variance() / information * v * v.transpose();
      else {
        // As uncertain as the matched surface is large.
        result.free_motions.push_back(v / length);
        result.covariance += m_radius * m_radius / (length * length) * v * v.transpose();
      }
    }
  }

  const std::vector<Vector>& m_points;
  const std::vector<Vector>& m_normals;
  const Target& m_target;
  const Refinement_options m_options;
  const Execution m_execution;

  std::vector<Match> m_matches;    // slot i: source point i
  std::vector<std::size_t> m_used; // indices of the matches of kind USED
  std::vector<double> m_scratch;

  Vector m_source_mean, m_target_mean;
  double m_total_weight = 0, m_radius = 0, m_squared_residuals = 0;
  Matrix_6 m_normal_matrix;
  Vector_6 m_right_side;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_POINT_TO_PLANE_H
