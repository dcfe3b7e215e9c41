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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_AGREEMENT_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_AGREEMENT_H

// How a pose explains two scans: what agrees, and what lies where the other scan saw that there is nothing.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/internal/judgement/Judged_pose.h>
#include <CGAL/Crude_registration/internal/reduction/Reduced_scan.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// How close is near, what faces the same way, and how far in front of what was seen is free space.
struct Look
{
  float distance;       // to the plane of the nearest surfel
  float minimal_cosine; // of the normals
  float free_depth;
};

// Some of the probes of a level: `n` in a row, from the one that is `from` on, from the front again at the end. The
// level is kept by reference.
class Probes
{
public:
  class iterator
  {
  public:
    iterator(const Surfel* surfels, const std::int32_t* index) : m_surfels(surfels), m_index(index) {}
    const Surfel& operator*() const { return m_surfels[*m_index]; }
    iterator& operator++()
    {
      ++m_index;
      return *this;
    }
    friend bool operator!=(const iterator& a, const iterator& b) { return a.m_index != b.m_index; }

  private:
    const Surfel* m_surfels;
    const std::int32_t* m_index;
  };

  Probes(const Surfel_level& level, std::size_t from, std::size_t n)
      : m_surfels(level.surfels.data()), m_begin(level.probes.data()), m_size((std::min)(n, level.probes.size()))
  {
    if (m_size > 0) m_begin += from % (level.probes.size() - m_size + 1);
  }

  iterator begin() const { return {m_surfels, m_begin}; }
  iterator end() const { return {m_surfels, m_begin + m_size}; }
  std::size_t size() const { return m_size; }

private:
  const Surfel* m_surfels;
  const std::int32_t* m_begin;
  std::size_t m_size;
};

// The first `n` probes of a level, in the order of its surfels: one after the other lies near the one before, and finds
// in the cache what that has looked at.
inline std::vector<Surfel> neighbouring_probes(const Surfel_level& level, std::size_t n)
{
  std::vector<std::int32_t> indices(level.probes.begin(),
                                    level.probes.begin() + std::ptrdiff_t((std::min)(n, level.probes.size())));
  std::sort(indices.begin(), indices.end());
  std::vector<Surfel> probes;
  probes.reserve(indices.size());
  for (const std::int32_t i : indices) probes.push_back(level.surfels[std::size_t(i)]);
  return probes;
}

// The agreement under `pose`, target from source, of probes of either scan; those of the source are compared with the
// surfels of `level`. It ends where a score of `least` is out of reach: the score is then any below it.
template <class Source_probes, class Target_probes>
Agreement agreement(const Reduced_scan& source, const Source_probes& source_probes, const Reduced_scan& target,
                    const Target_probes& target_probes, const Surfel_level& level, const Pose& pose, const Look& look,
                    float least = -(std::numeric_limits<float>::max)())
{
  const std::size_t n = source_probes.size(), m = target_probes.size();
  std::size_t agreeing = 0, before_target = 0, before_source = 0;
  // With `open` probes of the source to come: no later score is above that with all of them agreeing.
  const auto result = [&](std::size_t open) {
    Agreement a;
    if (n > 0) a.overlap = float(agreeing + open) / float(n);
    if (n > 0) a.violations = float(before_target) / float(n);
    if (m > 0) a.violations += float(before_source) / float(m);
    return a;
  };
  constexpr std::size_t every = 8; // probes between looks at the bound
  const bool target_is_known = target.depths.is_known();
  std::size_t i = 0;
  for (const Surfel& s : source_probes) {
    if (i % every == 0 && result(n - i).score() < least) return result(n - i);
    ++i;
    const Vector_f p = pose(s.position);
    const int j = level.field.nearest(p);
    if (j >= 0) {
      const Surfel& t = level.surfels[std::size_t(j)];
      // What agrees is on the surface that was seen, though it may be before it along a grazing line of sight.
      if (std::abs(t.normal.dot(p - t.position)) <= look.distance &&
          (pose.rotation * s.normal).dot(t.normal) >= look.minimal_cosine) {
        ++agreeing;
        continue;
      }
    }
    if (target_is_known) before_target += target.depths.in_front(p) > look.free_depth;
  }
  if (source.depths.is_known()) {
    const Pose back = pose.inverse();
    i = 0;
    for (const Surfel& t : target_probes) {
      if (i % every == 0 && result(0).score() < least) break;
      ++i;
      before_source += source.depths.in_front(back(t.position)) > look.free_depth;
    }
  }
  return result(0);
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_AGREEMENT_H
