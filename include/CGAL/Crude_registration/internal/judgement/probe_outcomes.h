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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_PROBE_OUTCOMES_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_PROBE_OUTCOMES_H

// What comes of the probes of a scan under a pose: they agree, disagree, violate free space, or go missing.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/internal/lookup/Probes.h>
#include <CGAL/Crude_registration/internal/reduction/Reduced_scan.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// What is allowed between two scans of one surface.
struct Probe_tolerance
{
  float distance;   // to the plane of the counterpart
  float angle;      // of the normals, radians
  float free_depth; // before the surface seen
};

// What comes of one probe of a scan under a pose. Probes that agree are told apart by how well.
struct Outcome
{
  static constexpr int residual_bins = 4, angle_bins = 3, fits = residual_bins * angle_bins;
  enum : std::uint8_t
  {
    UNKNOWN = 0, // hidden, or where the other scan did not look
    // 1 .. fits: agrees
    DISAGREES = fits + 1,
    IN_FREE_SPACE,
    MISSING, // would have been seen, and was not
    SIZE
  };
  static constexpr int kinds = 4;
  // 0: agrees, 1: disagrees, 2: in free space, 3: missing.
  static int kind(std::uint8_t outcome) { return outcome <= fits ? 0 : outcome - fits; }
};

// What is allowed between two scans of one surface: as much as all but a few of their own neighbouring surfels are off,
// and no more than the neighbours' spacing, and no angle near a right one; at least what sampling alone leaves.
inline Probe_tolerance probe_tolerance(const Surfel_level& a, const Surfel_level& b, float free_depth)
{
  const float height = 4.3f * (std::max)(a.height_noise, b.height_noise),
              turn = 2.4f * (std::max)(a.normal_noise, b.normal_noise);
  return {(std::max)(a.spacing, b.spacing) * (std::min)((std::max)(height, 0.05f), 1.f),
          (std::min)((std::max)(turn, 0.2f), 1.4f), free_depth};
}

// The outcomes of surfels of a scan under `pose`, `other` from the scan.
inline void probe_outcomes(const Probes& probes, const Reduced_scan& other, const Pose& pose,
                           const Probe_tolerance& tolerance, std::uint8_t* outcome)
{
  // acos is monotonous: the cosines of the bins' edges.
  const std::array<float, 3> cosines = {std::cos(tolerance.angle / 3), std::cos(2 * tolerance.angle / 3),
                                        std::cos(tolerance.angle)};
  const float inverse = 1 / tolerance.distance, widest = other.fine.spacing * other.fine.spacing;
  const bool is_seen = other.depths.is_known();
  // A row at a time, without a branch where what comes of a probe cannot be foretold.
  for (std::size_t from = 0; from < probes.size(); from += std::size_t(row_size), outcome += row_size) {
    const int in_row = int((std::min)(std::size_t(row_size), probes.size() - from));
    const Rows places = moved(pose, probes.positions(from)), normals = rotated(pose.rotation, probes.normals(from));
    const Index_row nearest = other.fine.field.nearest(places);
    for (int i = 0; i < in_row; ++i) {
      const int is_near = int(nearest[i] >= 0);
      const Surfel& t = other.fine.surfels[std::size_t(is_near != 0 ? nearest[i] : 0)];
      const Vector_f d = column(places, i) - t.position;
      const float r = t.normal.dot(d), u = std::abs(r) * inverse, c = column(normals, i).dot(t.normal);
      // Further aside than surfels are apart, the other surface has ended.
      const int is_there = is_near & int((d - r * t.normal).squaredNorm() < widest);
      const int agrees = is_there & int(u < 1) & int(c > cosines[2]);
      const int residual = int(u >= 0.125f) + int(u >= 0.25f) + int(u >= 0.5f);
      const int angle = int(c <= cosines[0]) + int(c <= cosines[1]);
      outcome[i] =
          std::uint8_t(agrees != 0 ? 1 + Outcome::angle_bins * residual + angle : is_there * Outcome::DISAGREES);
    }
    if (!is_seen) continue;
    // The lines of sight tell of those that do not agree.
    const Row depths = other.depths.in_front(places);
    for (int i = 0; i < in_row; ++i) {
      if (outcome[i] != Outcome::UNKNOWN && outcome[i] != Outcome::DISAGREES) continue;
      if (depths[i] > tolerance.free_depth) outcome[i] = Outcome::IN_FREE_SPACE;
      else if (const Vector_f p = column(places, i); outcome[i] == Outcome::UNKNOWN && other.depths.is_empty(p)) {
        // Within 60 degrees of the line of sight.
        const Vector_f sight = other.depths.sight(p);
        if (-sight.dot(column(normals, i)) > 0.5f * sight.norm()) outcome[i] = Outcome::MISSING;
      }
    }
  }
}

// The outcomes of all probes of one scan under some poses.
class Outcome_table
{
public:
  Outcome_table() = default;
  Outcome_table(std::size_t poses, std::size_t probes) : m_probes(probes), m_outcomes(poses * probes) {}

  void resize(std::size_t poses, std::size_t probes)
  {
    m_probes = probes;
    m_outcomes.resize(poses * probes);
  }
  std::size_t poses() const { return m_probes == 0 ? 0 : m_outcomes.size() / m_probes; }
  std::size_t probes() const { return m_probes; }
  std::uint8_t* operator[](std::size_t pose) { return m_outcomes.data() + pose * m_probes; }
  const std::uint8_t* operator[](std::size_t pose) const { return m_outcomes.data() + pose * m_probes; }

private:
  std::size_t m_probes = 0;
  std::vector<std::uint8_t> m_outcomes;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_PROBE_OUTCOMES_H
