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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_REFINE_SIMILARITY_IMPL_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_REFINE_SIMILARITY_IMPL_H

// The least squares of refine_similarity.h.

#include <CGAL/Crude_registration/internal/motion/Nearest_surfel.h>
#include <CGAL/Crude_registration/internal/motion/Normal_equations.h>
#include <CGAL/Crude_registration/internal/motion/refine_similarity.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

CGAL_CRUDE_REGISTRATION_INLINE Similarity_refinement Similarity_refiner::refined(const Rigid_motion& initial,
                                                                                 double scale, bool scale_stays)
{
  constexpr int most_steps = 50;
  constexpr double tolerance = 1e-2, shortest_reach = 2, first_reach = 4; // in sampling distances
  Similarity_refinement result;
  result.motion = initial;
  result.scale = scale;
  result.sampling_distance = m_s;
  double reach = first_reach * m_s;
  for (int step = 0; step < most_steps; ++step) {
    find_matches(result, reach);
    result.matches = m_matches.size();
    if (m_matches.size() < fewest_matches) return result;
    const double displacement = move(result, scale_stays);
    if (!(displacement > tolerance * m_s)) break;
    reach = (std::max)(shortest_reach * m_s, (std::min)(reach, 4 * median_height()));
  }
  return result;
}

CGAL_CRUDE_REGISTRATION_INLINE void Similarity_refiner::find_matches(const Similarity_refinement& r, double reach)
{
  m_matches.clear();
  for (const std::int32_t i : m_probes) {
    const Surfel& s = m_surfels[std::size_t(i)];
    Match match;
    match.source = r.motion(r.scale * s.position.cast<double>());
    Surface_point closest;
    if (!m_target.closest(match.source, reach, closest)) continue;
    const Vector normal = r.motion.rotation * s.normal.cast<double>();
    if (!(normal.dot(closest.normal) > smallest_normal_cosine)) continue;
    match.normal = (normal + closest.normal).normalized();
    match.height = (closest.point - match.source).dot(match.normal);
    m_matches.push_back(match);
  }
}

CGAL_CRUDE_REGISTRATION_INLINE double Similarity_refiner::median_height()
{
  std::vector<double> heights;
  for (const Match& m : m_matches) heights.push_back(std::abs(m.height));
  const auto middle = heights.begin() + std::ptrdiff_t(heights.size() / 2);
  std::nth_element(heights.begin(), middle, heights.end());
  return *middle;
}

CGAL_CRUDE_REGISTRATION_INLINE double Similarity_refiner::move(Similarity_refinement& r, bool scale_stays)
{
  r.median = median_height();
  const double sigma = (std::max)(1.4826 * r.median, smallest_sigma * m_s);
  Vector mean = Vector::Zero();
  double total = 0, spread = 0, squares = 0;
  std::vector<double> weights;
  for (const Match& m : m_matches) {
    const double u = m.height / (biweight_reach * sigma);
    weights.push_back(biweight(u * u));
    total += weights.back();
    mean += weights.back() * (m.source - m_matches.front().source);
  }
  mean = m_matches.front().source + mean / total;
  for (std::size_t i = 0; i < m_matches.size(); ++i) {
    spread += weights[i] * (m_matches[i].source - mean).squaredNorm();
    squares += weights[i] * m_matches[i].height * m_matches[i].height;
  }
  r.radius = (std::max)(std::sqrt(spread / total), m_s);
  Matrix_7 left = Matrix_7::Zero();
  Vector_7 right = Vector_7::Zero();
  for (std::size_t i = 0; i < m_matches.size(); ++i) {
    const Match& m = m_matches[i];
    const Vector p = (m.source - mean) / r.radius;
    Vector_7 row;
    row << p.cross(m.normal), m.normal, scale_stays ? 0 : p.dot(m.normal);
    left += weights[i] * row * row.transpose();
    right += weights[i] * m.height * row;
  }
  const double variance = (std::max)(squares / total, smallest_sigma * smallest_sigma * m_s * m_s);
  r.deviation = deviation_of_scale(left, variance) / r.radius;
  // What the matches leave free stays: as if each unknown were known to be 0 to within s beforehand.
  left.diagonal().array() += variance / (m_s * m_s);
  const Vector_7 x = Eigen::LDLT<Matrix_7>(left).solve(right);
  constexpr double largest_growth = 0.1; // a step; what asks for more is no overlap
  const double growth = 1 + (std::min)((std::max)(x[6] / r.radius, -largest_growth), largest_growth);
  const Vector turn = x.head<3>() / r.radius, shift = x.segment<3>(3);
  const double angle = turn.norm();
  const Matrix rotation =
      angle > 0 ? Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() : Matrix(Matrix::Identity());
  r.motion.translation = mean + shift + growth * (rotation * (r.motion.translation - mean));
  r.motion.rotation = Eigen::Quaterniond(Matrix(rotation * r.motion.rotation)).normalized().toRotationMatrix();
  r.scale *= growth;
  return x.norm();
}

CGAL_CRUDE_REGISTRATION_INLINE double Similarity_refiner::deviation_of_scale(Matrix_7 left, double variance) const
{
  constexpr double error_of_surfel = 0.1;
  const double rounding = 1e-12 * left.trace(); // what is free altogether deviates much, but not by infinity
  left.diagonal().array() += rounding;
  const double inverse = Eigen::LDLT<Matrix_7>(left).solve(Vector_7::Unit(6))[6];
  return (std::max)(std::sqrt(variance), error_of_surfel * m_s) * std::sqrt((std::max)(inverse, 0.));
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_REFINE_SIMILARITY_IMPL_H
