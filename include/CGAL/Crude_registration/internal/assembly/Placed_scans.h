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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_PLACED_SCANS_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_PLACED_SCANS_H

// Scans that have a place in a common frame: how much of one lies on another, and how much in its free space.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/internal/reduction/Reduced_scan.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// What some probes of one scan meet in another one.
struct Meeting
{
  double overlap = 0;    // the share that lies on the surface of the other one and faces its way
  double violations = 0; // the share that lies where the other one saw that there is nothing
};

// Looks at scans as they lie, at the resolution of their coarse surfels, so that some drift of the poses does not
// matter.
class Placed_scans
{
public:
  static constexpr std::size_t number_of_probes = 200;

  explicit Placed_scans(const std::vector<const Reduced_scan*>& scans) : m_scans(scans)
  {
    for (const Reduced_scan* scan : scans) {
      Ball ball;
      for (const Surfel& s : scan->coarse.surfels) ball.centre += s.position.cast<double>();
      if (!scan->coarse.surfels.empty()) ball.centre /= double(scan->coarse.surfels.size());
      double spread = 0;
      for (const Surfel& s : scan->coarse.surfels) {
        const double square = (s.position.cast<double>() - ball.centre).squaredNorm();
        ball.radius = (std::max)(ball.radius, square);
        spread += square;
      }
      ball.radius = std::sqrt(ball.radius);
      if (!scan->coarse.surfels.empty()) ball.deviation = std::sqrt(spread / double(scan->coarse.surfels.size()));
      m_balls.push_back(ball);
    }
  }

  std::size_t size() const { return m_scans.size(); }
  const Reduced_scan& scan(std::size_t i) const { return *m_scans[i]; }
  const Vector& centre(std::size_t i) const { return m_balls[i].centre; } // of its surface, in its own frame
  double deviation(std::size_t i) const { return m_balls[i].deviation; }  // root mean square, from the centre

  // Two motions of scan i displace its surface by this against each other, root mean square (of a ball of its
  // deviation).
  double displacement(std::size_t i, const Rigid_motion& a, const Rigid_motion& b) const
  {
    const Ball& ball = m_balls[i];
    // Mean square over a body whose points deviate by d: |turn - 1|_F^2 d^2 / 3.
    return std::sqrt((a(ball.centre) - b(ball.centre)).squaredNorm() +
                     (a.rotation - b.rotation).squaredNorm() * ball.deviation * ball.deviation / 3);
  }

  // Of the probes of i under `motion`, to the frame of j: how many meet the surface of j; which of them lie in its free
  // space is marked.
  Meeting meeting(std::size_t i, std::size_t j, const Rigid_motion& motion,
                  std::vector<std::uint8_t>* is_violating = nullptr) const
  {
    Meeting result;
    const Reduced_scan &source = *m_scans[i], &target = *m_scans[j];
    const std::vector<std::int32_t>& probes = source.coarse.probes;
    const std::size_t n = (std::min)(number_of_probes, probes.size());
    if (n == 0) return result;
    const float spacing = (std::max)(source.coarse.spacing, target.coarse.spacing);
    const double reach = m_balls[i].radius + m_balls[j].radius + double(spacing);
    const bool may_meet = (motion(m_balls[i].centre) - m_balls[j].centre).norm() < reach;
    if (!may_meet && !target.depths.is_known()) return result;
    constexpr float minimal_cosine = 0.7f, free_depth = 1.2f;
    const Pose pose = to_pose(motion);
    std::size_t on = 0, before = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const Surfel& s = source.coarse.surfels[std::size_t(probes[k])];
      const Vector_f p = pose(s.position);
      const int nearest = target.coarse.field.nearest(p);
      if (nearest >= 0) {
        const Surfel& t = target.coarse.surfels[std::size_t(nearest)];
        const bool is_near = std::abs(t.normal.dot(p - t.position)) <= 0.7f * spacing;
        on += is_near && (pose.rotation * s.normal).dot(t.normal) >= minimal_cosine;
        if (is_near) continue;
      }
      if (!target.depths.is_known() || !(target.depths.in_front(p) > free_depth * spacing)) continue;
      ++before;
      if (is_violating) (*is_violating)[k] = 1;
    }
    result.overlap = double(on) / double(n);
    result.violations = double(before) / double(n);
    return result;
  }

private:
  struct Ball
  {
    Vector centre = Vector::Zero();
    double radius = 0, deviation = 0;
  };

  std::vector<const Reduced_scan*> m_scans;
  std::vector<Ball> m_balls;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_PLACED_SCANS_H
