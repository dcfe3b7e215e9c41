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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_SENSOR_PLACE_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_SENSOR_PLACE_H

// The place from where a surface of unknown origin may have been seen.

#include <CGAL/Crude_registration/internal/base/Counter_random.h>
#include <CGAL/Crude_registration/internal/base/Flat_sensor.h>
#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/internal/base/Run_control.h>
#include <CGAL/Crude_registration/internal/sampling/Lines_of_sight.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Looks for the place from where a surface was seen, a body by a scanner in front of it, say, or a room by a camera
// that moved in it: most of the surface is visible from there. Places are tried all around and within.
class Sensor_place
{
public:
  Sensor_place(const Lines_of_sight& lines, Run_control& control)
      : m_lines(lines), m_control(control), m_samples(shuffled(lines.size(), 4))
  {}

  std::optional<Vector> find()
  {
    if (!m_lines.has_grid() || m_samples.empty()) return std::nullopt;
    measure();
    // What is seen from one side is as visible from behind, and most of all from where it bends around the place: a
    // body from within. So the surface bulges towards the sensor, where it does at all and hardly less is visible from
    // there. What was a room may be turned over by that, and so is each other scan of it: they fit each other as
    // before.
    std::vector<Place> outside, inside;
    for (const Place& p : all_places()) (bulge(p.position) > 0 ? outside : inside).push_back(p);
    constexpr double most = 0.7, half_of_the_sphere = 0.5, at_all = 0.1, hardly_less = 0.8; // decided: doc/design.md
    const std::vector<Tie> ties = all_ties();
    const Place outer = best_of(std::move(outside), ties), inner = best_of(std::move(inside), ties);
    const bool bulges = bulge(outer.position) >= at_all * -bulge(inner.position),
               is_as_visible = outer.agrees >= hardly_less * inner.agrees;
    if (outer.visible >= most && (inner.visible < most || (bulges && is_as_visible))) return outer.position;
    if (inner.visible < most || coverage(inner.position) > half_of_the_sphere) return std::nullopt;
    return inner.position;
  }

private:
  struct Place
  {
    Vector position = Vector::Zero();
    double visible = 0; // share of the samples
    double agrees = 0;  // less what is torn: see share_torn()
  };

  // What two samples side by side say of each other's side: see Sides_of_points.
  struct Tie
  {
    std::uint32_t a, b;
    double weight; // negative where their normals look to opposite sides
  };

  // The place from where most is visible, less what is torn; one from where nothing is, if there is none.
  Place best_of(std::vector<Place> places, const std::vector<Tie>& ties) const
  {
    // The fewer places are left, the more samples are asked: about as many lines in each round.
    constexpr double all = 0.95;
    keep_best(places, 0, 25, 200);
    keep_best(places, 25, 75, 60);
    keep_best(places, 100, 250, 20);
    keep_best(places, 350, 1000, 20, all);
    Place best;
    for (Place& p : places) {
      p.agrees = p.visible - share_torn(ties, p.position);
      if (p.agrees > best.agrees) best = p;
    }
    return best;
  }

  // Of a sample, along its normal.
  struct Height
  {
    Vector normal;
    double of_sample, over_centroid;
  };

  std::vector<Tie> all_ties() const
  {
    std::vector<Tie> ties;
    m_lines.for_each_pair_of_neighbours([&](std::size_t i, std::size_t j) {
      const Vector d = unit_or_zero(m_lines.point(j) - m_lines.point(i)), &n = m_lines.normal(i),
                   &m = m_lines.normal(j);
      const double a = n.dot(d), b = m.dot(d);
      ties.push_back({std::uint32_t(i), std::uint32_t(j), (n.dot(m) - 2 * a * b) * (1 - std::abs(a * b))});
    });
    return ties;
  }

  // A place from which the back of a face is seen, with nothing before it, turns that face the wrong way: the share of
  // the ties that are torn between it and the next face.
  double share_torn(const std::vector<Tie>& ties, const Vector& place) const
  {
    std::vector<double> side(m_lines.size());
    for (std::size_t i = 0; i < m_lines.size(); ++i)
      side[i] = m_lines.normal(i).dot(place - m_lines.point(i)) < 0 ? -1 : 1;
    double torn = 0, sum = 0;
    for (const Tie& t : ties) {
      sum += std::abs(t.weight);
      torn += (std::max)(-t.weight * side[t.a] * side[t.b], 0.);
    }
    return sum > 0 ? torn / sum : 0;
  }

  void measure()
  {
    m_low = m_high = m_lines.point(0);
    Vector sum = Vector::Zero();
    for (std::size_t i = 0; i < m_lines.size(); ++i) {
      m_low = m_low.cwiseMin(m_lines.point(i));
      m_high = m_high.cwiseMax(m_lines.point(i));
      sum += m_lines.point(i);
    }
    m_centroid = sum / double(m_lines.size());
    m_heights.reserve(m_lines.size());
    for (std::size_t i = 0; i < m_lines.size(); ++i) {
      const Vector &p = m_lines.point(i), &n = m_lines.normal(i);
      m_heights.push_back({n, n.dot(p), n.dot(p - m_centroid)});
    }
  }

  // Up to one and a half extents from the centre along each axis, denser near it.
  std::vector<Place> all_places() const
  {
    constexpr std::array<double, 9> steps = {-1.5, -0.85, -0.375, -0.1, 0, 0.1, 0.375, 0.85, 1.5};
    const double extent = (m_high - m_low).maxCoeff();
    const Vector centre = (m_low + m_high) / 2;
    std::vector<Place> places;
    for (const double x : steps)
      for (const double y : steps)
        for (const double z : steps) places.push_back({centre + extent * Vector(x, y, z)});
    return places;
  }

  // Leaves the places from where most of `n` samples are visible, and all from where a share of `enough` is: from the
  // sample numbered `from` on, around the end. A place is given up where the samples that are left cannot bring it
  // among those any more.
  void keep_best(std::vector<Place>& places, std::size_t from, std::size_t n, std::size_t kept, double enough = 2) const
  {
    n = (std::min)(n, m_samples.size());
    std::vector<double> best; // the shares of the best ones so far, as a heap with the least one in front
    std::vector<Place> left;
    for (Place& p : places) {
      m_control.check();
      // Shares of a thousand samples differ by more than this; of equal ones none is given up.
      constexpr double rounding = 1e-9;
      const double least = best.size() < kept ? 0 : (std::min)(best.front(), enough) - rounding;
      double visible = 0, seen = 0;
      const auto is_out_of_reach = [&](std::size_t samples) { // even if all of so many more are visible
        return visible + double(samples) < least * (seen + double(samples));
      };
      bool is_left = true;
      for (std::size_t i = 0; i < n && is_left; ++i) {
        const int v = m_lines.visibility(std::size_t(m_samples[(from + i) % m_samples.size()]), p.position);
        visible += v > 0;
        seen += v != 0;
        is_left = !is_out_of_reach(n - 1 - i);
      }
      if (!is_left) continue;
      p.visible = seen > 0 ? visible / seen : 0;
      left.push_back(p);
      best.push_back(p.visible);
      std::push_heap(best.begin(), best.end(), std::greater<>());
      if (best.size() <= kept) continue;
      std::pop_heap(best.begin(), best.end(), std::greater<>());
      best.pop_back();
    }
    std::stable_sort(left.begin(), left.end(), [](const Place& a, const Place& b) { return a.visible > b.visible; });
    std::size_t number = (std::min)(kept, left.size());
    while (number < left.size() && left[number].visible >= enough) ++number;
    left.resize(number);
    places = std::move(left);
  }

  // Six times the volume, over that of a cell's cube or so, between the surface, turned to the place, and the centroid.
  double bulge(const Vector& place) const
  {
    double sum = 0;
    for (const Height& h : m_heights) sum += h.normal.dot(place) < h.of_sample ? -h.over_centroid : h.over_centroid;
    return sum;
  }

  // The share of the directions from the place in which there is surface.
  double coverage(const Vector& place) const
  {
    const Counter_random random(6);
    constexpr std::uint64_t n = 500;
    const double far = 4 * ((place - m_centroid).norm() + (m_high - m_low).norm());
    std::size_t hits = 0;
    for (std::uint64_t i = 0; i < n; ++i) {
      const Vector d = unit_or_zero(Vector(random.normal(3 * i), random.normal(3 * i + 1), random.normal(3 * i + 2)));
      hits += !m_lines.is_free(place, d, far);
    }
    return double(hits) / double(n);
  }

  const Lines_of_sight& m_lines;
  Run_control& m_control;
  const std::vector<std::int32_t> m_samples; // in an order without pattern
  std::vector<Height> m_heights;
  Vector m_low, m_high, m_centroid;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_SENSOR_PLACE_H
