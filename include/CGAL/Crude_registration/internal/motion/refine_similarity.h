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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_REFINE_SIMILARITY_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_REFINE_SIMILARITY_H

// A motion and a scale refined together, on the planes of surfels.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/internal/motion/Nearest_surfel.h>
#include <CGAL/Crude_registration/internal/motion/Normal_equations.h>

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

struct Similarity_refinement
{
  Rigid_motion motion;          // behind the scaling
  double scale = 1;             // x -> motion(scale x)
  std::size_t matches = 0;      // points that have a correspondence
  double deviation = 0;         // standard, of the scale, as a share of it
  double median = 0;            // of the distances of the matches along their normals
  bool is_scale_free = false;   // the surfaces agree as well at other scales, see refined_similarity()
  double radius = 0;            // root mean square, of the matches about their mean
  double sampling_distance = 0; // the larger of the two scans'
};

// Point-to-plane least squares with seven unknowns: a turn a, a displacement t and a growth g about the mean m of the
// matches, sum w ((x - m) x n . a + n . t + (x - m) . n g - (q - x) . n)^2 -> min (Chen and Medioni 1991, with the
// scale as Du et al. 2010 have it), weighed by Tukey's biweight. Turn and growth are measured by the displacement at
// the distance `radius`, so that the unknowns have one unit. `s`: the sampling distance, the larger of the two scans'.
class Similarity_refiner
{
public:
  Similarity_refiner(const std::vector<Surfel>& surfels, const std::vector<std::int32_t>& probes,
                     const Nearest_surfel& target, double s)
      : m_surfels(surfels), m_probes(probes), m_target(target), m_s(s)
  {}

  Similarity_refinement operator()(const Rigid_motion& initial) { return refined(initial, 1, false); }

  // At a scale that stays as it is.
  Similarity_refinement at_scale(const Rigid_motion& initial, double scale) { return refined(initial, scale, true); }

private:
  Similarity_refinement refined(const Rigid_motion& initial, double scale, bool scale_stays)
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

  using Matrix_7 = Eigen::Matrix<double, 7, 7>;
  using Vector_7 = Eigen::Matrix<double, 7, 1>;

  static constexpr std::size_t fewest_matches = 50;
  // Those of Point_to_plane: normals within 45 degrees, 95 % efficiency, and what counts as no residual.
  static constexpr double smallest_normal_cosine = 0.70710678118654752, biweight_reach = 4.685, smallest_sigma = 1e-3;

  struct Match
  {
    Vector source, normal;
    double height; // of the target's plane above the source
  };

  void find_matches(const Similarity_refinement& r, double reach)
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

  double median_height()
  {
    std::vector<double> heights;
    for (const Match& m : m_matches) heights.push_back(std::abs(m.height));
    const auto middle = heights.begin() + std::ptrdiff_t(heights.size() / 2);
    std::nth_element(heights.begin(), middle, heights.end());
    return *middle;
  }

  // A step; returns how far it moves the matches, about.
  double move(Similarity_refinement& r, bool scale_stays)
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

  // Whatever the residuals are, a surfel, which is the mean of a cell, is off the surface by about so much of s.
  double deviation_of_scale(Matrix_7 left, double variance) const
  {
    constexpr double error_of_surfel = 0.1;
    const double rounding = 1e-12 * left.trace(); // what is free altogether deviates much, but not by infinity
    left.diagonal().array() += rounding;
    const double inverse = Eigen::LDLT<Matrix_7>(left).solve(Vector_7::Unit(6))[6];
    return (std::max)(std::sqrt(variance), error_of_surfel * m_s) * std::sqrt((std::max)(inverse, 0.));
  }

  const std::vector<Surfel>& m_surfels;
  const std::vector<std::int32_t>& m_probes;
  const Nearest_surfel& m_target;
  double m_s;
  std::vector<Match> m_matches;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_REFINE_SIMILARITY_H
