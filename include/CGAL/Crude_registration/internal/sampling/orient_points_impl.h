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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_ORIENT_POINTS_IMPL_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_ORIENT_POINTS_IMPL_H

// The steps of orient_points().

#include <CGAL/Crude_registration/internal/sampling/Evened_points.h>
#include <CGAL/Crude_registration/internal/sampling/Lines_of_sight.h>
#include <CGAL/Crude_registration/internal/sampling/normals_of_points.h>
#include <CGAL/Crude_registration/internal/sampling/orient_points.h>
#include <CGAL/Crude_registration/internal/sampling/sensor_place.h>
#include <CGAL/Crude_registration/internal/sampling/sides_of_points.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Samples in the frame of the points' own, on their way to a side.
struct Samples_without_side
{
  std::vector<Vector> points, normals;
  std::vector<std::uint32_t> index; // of the evened point
  std::vector<double> reaches;      // of the neighbourhood that the normal is from
  std::vector<std::uint32_t> discs; // see lines_of_sight()
};

// The area of the surface: a plane of normal n meets |n_x| + |n_y| + |n_z| cells for each square of their edge length.
inline double area_of_samples(const Evened_points& evened, const Samples_without_side& samples)
{
  // Cells of a surface, not of its samples: of some sixteen samples or more.
  std::size_t level = 0;
  while (level + 1 < Evened_points::number_of_levels && evened.cell(level) < 4 * evened.spacing()) ++level;
  std::vector<double> sums(evened.level(level).points.size(), 0), counts(sums.size(), 0);
  for (std::size_t i = 0; i < samples.index.size(); ++i) {
    std::size_t cell = samples.index[i];
    for (std::size_t l = 0; l < level; ++l) cell = evened.level(l).parents[cell];
    sums[cell] += 1 / samples.normals[i].lpNorm<1>();
    ++counts[cell];
  }
  double area = 0;
  for (std::size_t c = 0; c < sums.size(); ++c)
    if (counts[c] > 0) area += sums[c] / counts[c];
  return area * evened.cell(level) * evened.cell(level);
}

// Discs at a resolution of some thousand. Also numbers the disc of each sample.
inline Lines_of_sight lines_of_sight(const Evened_points& evened, Samples_without_side& samples)
{
  constexpr std::size_t most = 2500;
  std::size_t level = 0;
  // In cells of some four samples or more hardly a disc is missing.
  while (level + 1 < Evened_points::number_of_levels &&
         (evened.level(level).points.size() > most || evened.cell(level) < 2 * evened.spacing()))
    ++level;
  const std::size_t n = evened.level(level).points.size();
  std::vector<Vector> points(n, Vector::Zero()), normals(n, Vector::Zero());
  std::vector<double> counts(n, 0);
  samples.discs.reserve(samples.index.size());
  for (std::size_t i = 0; i < samples.index.size(); ++i) {
    std::size_t cell = samples.index[i];
    for (std::size_t l = 0; l < level; ++l) cell = evened.level(l).parents[cell];
    samples.discs.push_back(std::uint32_t(cell));
    points[cell] += samples.points[i];
    normals[cell] += (normals[cell].dot(samples.normals[i]) < 0 ? -1 : 1) * samples.normals[i];
    ++counts[cell];
  }
  std::vector<Vector> disc_points, disc_normals;
  std::vector<std::uint32_t> number(n, 0);
  for (std::size_t c = 0; c < n; ++c)
    if (counts[c] > 0) {
      number[c] = std::uint32_t(disc_points.size());
      disc_points.push_back(points[c] / counts[c]);
      disc_normals.push_back(unit_or_zero(normals[c]));
    }
  for (std::uint32_t& d : samples.discs) d = number[d];
  const double cell = evened.cell(level);
  Vector low = disc_points.front();
  for (const Vector& p : disc_points) low = low.cwiseMin(p);
  const Vector corner = evened.corner() + cell * Vector(((low - evened.corner()) / cell).array().floor());
  return Lines_of_sight(std::move(disc_points), std::move(disc_normals), corner, cell);
}

// Turns the samples that hang together to the side from where, in the mean, more lines of sight are open; where neither
// is, away from the centroid of all. Whether the lines tell the side of most of the surface: it is closed.
inline bool turn_outwards(Samples_without_side& samples, Run_control& control, const Lines_of_sight& lines, double cell)
{
  const std::vector<std::uint8_t> is_sure(samples.points.size(), 0);
  Sides_of_points sides(samples.points, samples.normals, samples.reaches, cell, is_sure, control);
  const std::size_t n = samples.points.size();
  Vector centroid = Vector::Zero();
  for (const Vector& p : samples.points) centroid += p / double(n);
  // (A longest line that leaves the surface's box.)
  double far = 0;
  for (const Vector& p : samples.points) far = (std::max)(far, 4 * (p - centroid).norm());
  std::vector<double> open(n, 0), outwards(n, 0), sizes(n, 0);
  const std::size_t step = n / 3000 + 1;
  for (std::size_t i = 0; i < n; ++i) {
    control.check(i);
    const auto [root, is_opposite] = sides.side(i);
    if (is_opposite) samples.normals[i] = -samples.normals[i];
    const Vector &p = samples.points[i], &normal = samples.normals[i];
    outwards[root] += normal.dot(p - centroid);
    if (!lines.has_grid() || i % step != 0) continue;
    open[root] += double(lines.is_free(p, normal, far)) - double(lines.is_free(p, -normal, far));
    ++sizes[root];
  }
  constexpr double least = 0.1;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t root = sides.side(i).first;
    const double side = std::abs(open[root]) > least * sizes[root] ? open[root] : outwards[root];
    if (side < 0) samples.normals[i] = -samples.normals[i];
  }
  double told = 0, all = 0;
  for (std::size_t i = 0; i < n; ++i) {
    told += std::abs(open[i]);
    all += sizes[i];
  }
  return told > 0.5 * all;
}

// Turns the samples towards a sensor. What is seen at a grazing angle is left out by a null normal.
inline void turn_towards(const Flat_sensor& sensor, double grazing, Samples_without_side& samples)
{
  for (std::size_t i = 0; i < samples.points.size(); ++i) {
    Vector& normal = samples.normals[i];
    const Vector sight = sensor.towards(samples.points[i]);
    const double along = sight.dot(normal);
    if (std::abs(along) < grazing * sight.norm()) normal = Vector::Zero();
    else if (along > 0) normal = -normal;
  }
}

// Turns the samples that are not sure to the side that their neighbours tell, from those that are; `untold(i)` is
// called of each of which none does. `cell`: about the least of the reaches.
template <class Function>
void turn_as_neighbours(const std::vector<std::uint8_t>& is_sure, double cell, Run_control& control,
                        Samples_without_side& samples, const Function& untold)
{
  Sides_of_points sides(samples.points, samples.normals, samples.reaches, cell, is_sure, control);
  for (std::size_t i = 0; i < samples.points.size(); ++i) {
    if (is_sure[i]) continue;
    const auto [root, is_opposite] = sides.side(i);
    if (!is_sure[root]) untold(i);
    else if (is_opposite) samples.normals[i] = -samples.normals[i];
  }
}

// Turns the samples towards a place that is about that of the sensor: what is seen squarely from there has the right
// side, and what is not, which a place beside it would see from behind, has that of its neighbours.
inline void turn_towards_about(const Vector& place, double cell, Run_control& control, Samples_without_side& samples)
{
  constexpr double squarely = 0.5; // the cosine; decided: 30 degrees and more above the surface
  std::vector<std::uint8_t> is_sure(samples.points.size());
  for (std::size_t i = 0; i < samples.points.size(); ++i) {
    Vector& normal = samples.normals[i];
    const double cosine = unit_or_zero(place - samples.points[i]).dot(normal);
    if (cosine < 0) normal = -normal;
    is_sure[i] = std::uint8_t(std::abs(cosine) >= squarely);
  }
  turn_as_neighbours(is_sure, cell, control, samples, [](std::size_t) {});
}

// Turns the samples to the side of normals that are given with the points; false where they do not say one for most.
// Those of which none is given have the side that their neighbours tell, or, where none of these is told, are left out
// by a null normal.
inline bool turn_as_given(const Evened_points& evened, const std::vector<Vector>& given, double cell,
                          Run_control& control, Samples_without_side& samples)
{
  std::vector<Vector> sums(evened.level(0).points.size(), Vector::Zero());
  evened.for_each_member([&](std::size_t i, std::size_t member) { sums[member] += unit_or_zero(given[i]); });
  const std::size_t n = samples.points.size();
  std::vector<std::uint8_t> is_given(n);
  for (std::size_t i = 0; i < n; ++i) {
    Vector& normal = samples.normals[i];
    const double along = (evened.axes().transpose() * sums[samples.index[i]]).dot(normal);
    is_given[i] = std::uint8_t(along != 0);
    if (along < 0) normal = -normal;
  }
  const auto number_given = std::size_t(std::count(is_given.begin(), is_given.end(), std::uint8_t(1)));
  if (2 * number_given <= n) return false;
  if (number_given == n) return true;
  turn_as_neighbours(is_given, cell, control, samples, [&](std::size_t i) { samples.normals[i] = Vector::Zero(); });
  return true;
}

CGAL_CRUDE_REGISTRATION_INLINE Oriented_points orient_points(const std::vector<Vector>& points,
                                                             const std::vector<Vector>& normals,
                                                             const Flat_sensor& sensor, Run_control& control)
{
  Oriented_points result;
  // A surface of n samples cuts 1.5 n / 4 cells of two spacings: of as many as the finest surfels are to be, 15,000.
  constexpr std::size_t most = 40000;
  const Evened_points evened(points, most, control);
  if (evened.is_empty()) return result;
  const Normals_of_points fits(evened, control);
  Samples_without_side samples;
  for (std::size_t i = 0; i < fits.normals.size(); ++i) {
    if (fits.normals[i].isZero(0)) continue;
    samples.points.push_back(evened.level(0).points[i]);
    samples.normals.push_back(fits.normals[i]);
    samples.index.push_back(std::uint32_t(i));
    // Dust has many neighbours at the largest scales.
    samples.reaches.push_back(fits.radius((std::min)(std::size_t(fits.scales[i]), std::size_t(2))));
  }
  if (samples.points.empty()) return result;
  result.area = area_of_samples(evened, samples);

  if (sensor.kind != Flat_sensor::UNKNOWN) {
    const bool is_far = sensor.kind == Flat_sensor::ORTHOGRAPHIC;
    turn_towards(
        {sensor.kind, is_far ? Vector(evened.axes().transpose() * sensor.vector) : evened.to_local(sensor.vector)},
        grazing_cosine, samples);
  } else if (normals.empty() || !turn_as_given(evened, normals, fits.radius(0), control, samples)) {
    const Lines_of_sight lines = lines_of_sight(evened, samples);
    if (const std::optional<Vector> place = Sensor_place(lines, control).find()) {
      turn_towards_about(*place, fits.radius(0), control, samples);
      result.is_side_known = false;
    } else {
      result.is_side_known = turn_outwards(samples, control, lines, fits.radius(0));
    }
  }
  result.points.reserve(samples.points.size());
  result.normals.reserve(samples.points.size());
  for (std::size_t i = 0; i < samples.points.size(); ++i) {
    control.check(i);
    if (samples.normals[i].isZero(0)) continue;
    result.points.push_back(evened.to_input(samples.points[i]));
    result.normals.push_back(evened.axes() * samples.normals[i]);
  }
  return result;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_ORIENT_POINTS_IMPL_H
