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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_DESCRIBE_SURFELS_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_DESCRIBE_SURFELS_H

// What is said of the surfels of a level: curvatures, borders, noise, and which of them stand for all.

#include <CGAL/Crude_registration/internal/base/Counter_random.h>
#include <CGAL/Crude_registration/internal/lookup/Point_grid.h>
#include <CGAL/Crude_registration/internal/reduction/Curvature_tensors.h>
#include <CGAL/Crude_registration/internal/reduction/Reduced_scan.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Borders and curvatures of the surfels of a level, from the surfels within 2.6 spacings: the second fundamental form
// that best explains how the normal changes, d n = W (d x), as Rusinkiewicz does on one face, here in the least squares
// sense over the neighbourhood (which is cut off at borders, not dropped).
inline void describe_surfels(Surfel_level& level)
{
  const float radius = 2.6f * level.spacing;
  std::vector<Vector> points;
  points.reserve(level.surfels.size());
  for (const Surfel& s : level.surfels) points.push_back(s.position.cast<double>());
  const Point_grid grid(points, double(radius));
  level.borders.assign(level.surfels.size(), 0);
  for (std::size_t i = 0; i < level.surfels.size(); ++i) {
    Surfel& s = level.surfels[i];
    const Vector_f u = s.normal.unitOrthogonal(), v = s.normal.cross(u);
    Vector_f mean = Vector_f::Zero();
    int count = 0;
    Second_fundamental_form_fit fit;
    grid.for_each_within(points[i], double(radius), [&](std::int32_t j, double) {
      const Surfel& t = level.surfels[std::size_t(j)];
      if (std::size_t(j) == i || t.normal.dot(s.normal) < 0.3f) return;
      const Vector_f d = t.position - s.position, dn = t.normal - s.normal;
      mean += d;
      ++count;
      fit.add(double(d.dot(u)), double(d.dot(v)), double(dn.dot(u)), double(dn.dot(v)));
    });
    level.borders[i] = count < 5 || mean.norm() > 0.8f * level.spacing * float(count);
    // A little of the identity: what the neighbours do not determine is flat.
    fit.a += 1e-6 * double(level.spacing * level.spacing);
    fit.c += 1e-6 * double(level.spacing * level.spacing);
    const Curvature_tensor form = fit.solved(fit.minor());
    s.minimal_curvature = float(form.minimum() * double(level.spacing));
    s.maximal_curvature = float(form.maximum() * double(level.spacing));
  }
}

// Surfels that stand for the whole scan, in an order such that each beginning does: by turns from each direction of the
// normal (Rusinkiewicz and Levoy 2001, normal-space sampling), so that a wall or a floor, whatever its size, does not
// outvote all else.
inline std::vector<std::int32_t> choose_probes(const std::vector<Surfel>& surfels, std::size_t n)
{
  constexpr std::size_t side = 5; // cells along the edge of a cube's face
  std::vector<std::vector<std::int32_t>> bins(6 * side * side);
  for (const std::int32_t i : shuffled(surfels.size(), 2)) {
    const Vector_f& normal = surfels[std::size_t(i)].normal;
    int axis;
    const float largest = normal.cwiseAbs().maxCoeff(&axis);
    const auto cell = [&](float x) {
      return (std::min)(std::size_t((x / largest + 1) * 0.5f * float(side)), side - 1);
    };
    const std::size_t face = 2 * std::size_t(axis) + (normal[axis] < 0);
    bins[(face * side + cell(normal[(axis + 1) % 3])) * side + cell(normal[(axis + 2) % 3])].push_back(i);
  }
  std::vector<std::int32_t> order;
  n = (std::min)(n, surfels.size());
  for (std::size_t turn = 0; order.size() < n; ++turn)
    for (const auto& bin : bins)
      if (turn < bin.size() && order.size() < n) order.push_back(bin[turn]);
  return order;
}

// Measures the noise of a level on some hundred surfels and their neighbours, which the field finds.
inline void measure_noise(Surfel_level& level)
{
  std::vector<float> heights, turns;
  const std::size_t step = level.surfels.size() / 1000 + 1;
  for (std::size_t i = 0; i < level.surfels.size(); i += step) {
    const Surfel& s = level.surfels[i];
    const Vector_f u = s.normal.unitOrthogonal(), v = s.normal.cross(u);
    for (const Vector_f& d : {u, v, Vector_f(-u), Vector_f(-v)}) {
      const int j = level.field.nearest(s.position + level.spacing * d);
      if (j < 0 || std::size_t(j) == i) continue;
      const Surfel& t = level.surfels[std::size_t(j)];
      const float cosine = s.normal.dot(t.normal);
      if (cosine < 0.7f) continue; // an edge
      heights.push_back(std::abs(s.normal.dot(t.position - s.position)) / level.spacing);
      turns.push_back(std::acos((std::min)(1.f, cosine)));
    }
  }
  const auto third_quartile = [](std::vector<float>& values) {
    if (values.empty()) return 0.f;
    const auto q = values.begin() + std::ptrdiff_t(values.size() * 3 / 4);
    std::nth_element(values.begin(), q, values.end());
    return *q;
  };
  level.height_noise = third_quartile(heights);
  level.normal_noise = third_quartile(turns);
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_DESCRIBE_SURFELS_H
