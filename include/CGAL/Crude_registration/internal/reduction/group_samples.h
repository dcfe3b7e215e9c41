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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_GROUP_SAMPLES_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_GROUP_SAMPLES_H

// Samples grouped by the cells of a grid to surfels: the surface at a resolution.

#include <CGAL/Crude_registration/internal/base/Run_control.h>
#include <CGAL/Crude_registration/internal/lookup/cell_items.h>
#include <CGAL/Crude_registration/internal/reduction/Reduced_scan.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// What the samples of one cell that face the same way say of the place of their surfel.
class Samples_of_cell
{
public:
  void add(const Vector& point, const Vector& normal, double weight)
  {
    m_position += weight * point;
    m_normal += weight * normal;
    m_weight += weight;
  }

  // The same, where their planes are asked for.
  void add_plane(const Vector& point, const Vector& normal, double weight)
  {
    const Vector n = weight * normal;
    m_planes += n * normal.transpose();
    m_heights += normal.dot(point) * n;
  }

  double weight() const { return m_weight; }
  const Vector& normal() const { return m_normal; } // the sum
  Vector mean() const { return m_position / m_weight; }

  // The mean of samples on both sides of an edge lies beneath the surface, and so it does where that is bent. The place
  // that is nearest to the planes of all (as in dual contouring, Ju et al. 2002) lies on the edge, and as far above
  // what is bent as the mean lies beneath it: halfway is on the surface. Along the surface, where normals that are off
  // by some 0.3 radians are all that tells the place, the mean counts.
  Vector between_mean_and_planes() const
  {
    constexpr double of_noise = 0.1;
    const Vector place = mean(), heights = (m_heights - m_planes * place) / m_weight;
    const Matrix planes = m_planes / m_weight + of_noise * Matrix::Identity();
    return place + planes.inverse() * heights / 2;
  }

private:
  Vector m_position = Vector::Zero(), m_normal = Vector::Zero(), m_heights = Vector::Zero();
  Matrix m_planes = Matrix::Zero();
  double m_weight = 0;
};

// How far, squared, the mean of the samples of a cell may lie from the surface, which depends on where the cell begins.
// With a the RMS angle between their normals and the mean one, a^2 = 2 (1 - |mean of the normals|), the standard
// deviation of their heights over the mean plane is 0.13 a times the cell on a sphere, 0.14 across an edge of two
// planes.
inline float variance_of_place(double bend, double cell)
{
  return float(0.13 * 0.13 * 2 * (std::max)(bend, 0.) * cell * cell);
}

// The samples (weight 1 each, or `weights`) of each cell of a grid whose cells meet at the origin, as surfels: means of
// positions and normals. `has_edges`: the positions are drawn to the planes of the samples; where triangles leave out
// what is seen at a grazing angle, there is little on the other side of an edge, and the mean will do. Samples of one
// cell that face away from their mean normal are another sheet and make a surfel of their own. In the order of the
// cells; that of the samples does not matter but for rounding.
inline Surfel_level group_samples(const std::vector<Vector_f>& points, const std::vector<Vector_f>& normals,
                                  const std::vector<float>& weights, float cell, Run_control& control,
                                  bool has_edges = false)
{
  const std::vector<Cell_item> items = items_by_cells(points, cell, control);
  Surfel_level level;
  level.spacing = cell;
  const auto emit = [&](const Samples_of_cell& s) {
    const double length = s.normal().norm();
    if (!(length > 0.4 * s.weight())) return; // no surface with a side
    Surfel surfel;
    surfel.position = (has_edges ? s.between_mean_and_planes() : s.mean()).cast<float>();
    surfel.normal = (s.normal() / length).cast<float>();
    surfel.variance = variance_of_place(1 - length / s.weight(), double(cell));
    level.surfels.push_back(surfel);
    level.weights.push_back(float(s.weight()));
  };
  const auto is_less = [&](const Cell_item& a, const Cell_item& b) {
    const Vector_f &p = points[a.index], &q = points[b.index];
    return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3);
  };
  std::size_t cells = 0;
  for (std::size_t from = 0; from < items.size();) {
    control.check(++cells);
    Samples_of_cell front, back;
    std::size_t to = from, least = from;
    Vector all = Vector::Zero();
    for (; to < items.size() && items[to].key == items[from].key; ++to) {
      all += normals[items[to].index].cast<double>();
      if (is_less(items[to], items[least])) least = to;
    }
    // Two sheets of the same size leave no mean normal.
    const Vector_f reference =
        all.norm() > 0.01 * double(to - from) ? Vector_f(all.cast<float>()) : normals[items[least].index];
    for (std::size_t k = from; k < to; ++k) {
      const std::size_t i = items[k].index;
      const double w = weights.empty() ? 1. : double(weights[i]);
      Samples_of_cell& samples = normals[i].dot(reference) >= 0 ? front : back;
      const Vector point = points[i].cast<double>(), normal = normals[i].cast<double>();
      samples.add(point, normal, w);
      if (has_edges) samples.add_plane(point, normal, w);
    }
    if (front.weight() > 0) emit(front);
    if (back.weight() > 0) emit(back);
    from = to;
  }
  return level;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_GROUP_SAMPLES_H
