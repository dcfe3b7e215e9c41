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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_SURFACE_FROM_POINTS_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_SURFACE_FROM_POINTS_H

// A surface of points whose sensor is not known.

#include <CGAL/Crude_registration/internal/mesh/Flat_mesh.h>
#include <CGAL/Crude_registration/internal/base/Run_control.h>
#include <CGAL/Crude_registration/internal/sampling/advancing_front.h>
#include <CGAL/Crude_registration/internal/lookup/cell_items.h>
#include <CGAL/Crude_registration/internal/mesh/flat_mesh_repair.h>
#include <CGAL/Crude_registration/internal/sampling/likely_viewpoint.h>
#include <CGAL/Crude_registration/internal/base/symmetric_eigen.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <numeric>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Triangulates points of which nothing more is known: thinned to their means in the cells of a grid, and joined by
// CGAL's advancing front.
class Surface_from_points
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

public:
  // no edge is longer than `ratio` times the spacing of the thinned points
  Surface_from_points(const std::vector<Vector>& points, double ratio, Run_control& control)
      : m_points(points), m_ratio(ratio), m_control(control)
  {}

  // \throws Run_control::Stopped
  Flat_mesh operator()()
  {
    Flat_mesh mesh;
    if (m_points.size() < 3) return mesh;
    to_principal_frame();
    if (m_is_line) return mesh;
    const std::vector<Vector> points = thin();
    m_control.check();
    advance_front(points, mesh);
    keep_used_points(mesh, points, m_control);
    split_non_manifold_vertices(mesh, m_control);
    orient_outwards(mesh);
    m_control.check();
    Vector viewpoint;
    if (Likely_viewpoint(mesh, m_spacing, m_axes, m_control).find(viewpoint)) {
      turn_to(viewpoint, mesh);
      split_non_manifold_vertices(mesh, m_control);
    }
    return mesh;
  }

private:
  // Up to this many points are taken as they are, and of more about this many kept: the front takes 50 microseconds a
  // point.
  static constexpr std::size_t largest = 40000;

  // The grid is laid along the points' own axes, from their centroid, so that it moves with them.
  void to_principal_frame()
  {
    Vector sum = Vector::Zero();
    for (const Vector& p : m_points) sum += p - m_points.front();
    m_centroid = m_points.front() + sum / static_cast<double>(m_points.size());
    m_control.check();
    Matrix covariance = Matrix::Zero();
    for (const Vector& p : m_points) covariance += (p - m_centroid) * (p - m_centroid).transpose();
    const Symmetric_eigen<Matrix> eigen = symmetric_eigen(covariance);
    m_axes = eigen.vectors;
    m_is_line = !(eigen.values[1] > 1e-14 * eigen.values[2]); // or one point, many times
    m_local.reserve(m_points.size());
    Vector third = Vector::Zero();
    for (const Vector& p : m_points) {
      m_control.check(m_local.size());
      m_local.push_back(m_axes.transpose() * (p - m_centroid));
      third += m_local.back().cwiseProduct(m_local.back()).cwiseProduct(m_local.back());
      m_extent = (std::max)(m_extent, 2 * m_local.back().cwiseAbs().maxCoeff());
    }
    // an axis points to the side where the points reach farther
    for (int i = 0; i < 3; ++i)
      if (third[i] < 0) {
        m_axes.col(i) = -m_axes.col(i);
        for (Vector& p : m_local) p[i] = -p[i];
      }
  }

  static bool is_same_cell(const Cell_item& a, const Cell_item& b) { return a.key == b.key; }

  // the size of cells of which about `count` hold points: on a surface their number falls with the square of the size
  double cell_size(std::size_t count) const
  {
    const double wanted = static_cast<double>(count);
    const double smallest = m_extent / double(1 << 20); // 21 bits an axis
    double size = (std::max)(smallest, m_extent / std::sqrt(wanted));
    for (int i = 0; i < 8; ++i) {
      std::vector<Cell_item> items = items_by_cells(m_local, size, m_control);
      const double got = static_cast<double>(std::unique(items.begin(), items.end(), is_same_cell) - items.begin());
      if (std::abs(got - wanted) < 0.05 * wanted) break;
      size = (std::max)(smallest, size * std::sqrt(got / wanted));
    }
    return size;
  }

  // also finds the spacing of what it returns
  std::vector<Vector> thin()
  {
    const std::size_t n = m_points.size();
    if (n <= largest) {
      m_spacing = cell_size((n + 3) / 4) / 2; // cells of four points are two spacings wide
      return m_points;
    }
    m_spacing = cell_size(largest);
    const std::vector<Cell_item> items = items_by_cells(m_local, m_spacing, m_control);
    std::vector<Vector> means;
    for (std::size_t i = 0; i < n;) {
      m_control.check(means.size());
      const Cell_item& first = items[i];
      Vector sum = Vector::Zero();
      std::size_t count = 0;
      for (; i < n && is_same_cell(items[i], first); ++i, ++count)
        sum += m_points[items[i].index] - m_points[first.index];
      means.push_back(m_points[first.index] + sum / static_cast<double>(count));
    }
    return means;
  }

  // Facets in the order of their smallest empty spheres, and none whose sphere is wider than the longest edge.
  struct Priority
  {
    double squared_radius_limit;
    Run_control* control; // asked from within the front: about once a facet

    template <class Front, class Cell_handle>
    double operator()(const Front& front, Cell_handle& cell, const int& index) const
    {
      control->check();
      const double squared_radius = front.smallest_radius_delaunay_sphere(cell, index);
      return squared_radius <= squared_radius_limit ? squared_radius : front.infinity();
    }
  };

  void advance_front(const std::vector<Vector>& points, Flat_mesh& mesh) const
  {
    // CGAL's front has absolute tolerances: it is given points at the origin, one unit apart
    std::vector<Kernel::Point_3> input;
    input.reserve(points.size());
    for (const Vector& p : points) {
      const Vector q = (p - m_centroid) / m_spacing;
      input.emplace_back(q.x(), q.y(), q.z());
    }
    for (const auto& f : advancing_front(input, Priority{m_ratio * m_ratio / 4, &m_control}, m_control))
      mesh.faces.push_back(
          {static_cast<std::int32_t>(f[0]), static_cast<std::int32_t>(f[1]), static_cast<std::int32_t>(f[2])});
  }

  // Turns each connected part so that its faces look, in the mean, away from the centroid of all points.
  void orient_outwards(Flat_mesh& mesh) const
  {
    std::vector<std::size_t> parent(mesh.points.size());
    std::iota(parent.begin(), parent.end(), std::size_t(0));
    const auto root = [&](std::int32_t vertex) {
      std::size_t v = static_cast<std::size_t>(vertex);
      while (parent[v] != v) v = parent[v] = parent[parent[v]];
      return v;
    };
    for (const auto& f : mesh.faces)
      for (std::size_t k = 1; k < 3; ++k) {
        const std::size_t a = root(f[0]), b = root(f[k]);
        parent[(std::max)(a, b)] = (std::min)(a, b);
      }
    std::vector<double> outwards(mesh.points.size(), 0);
    for (const auto& f : mesh.faces) {
      const Vector a = mesh.points[static_cast<std::size_t>(f[0])] - m_centroid,
                   b = mesh.points[static_cast<std::size_t>(f[1])] - m_centroid,
                   c = mesh.points[static_cast<std::size_t>(f[2])] - m_centroid;
      outwards[root(f[0])] += a.dot(b.cross(c));
    }
    for (auto& f : mesh.faces)
      if (outwards[root(f[0])] < 0) std::swap(f[1], f[2]);
  }

  const std::vector<Vector>& m_points;
  const double m_ratio;
  Run_control& m_control;
  Vector m_centroid = Vector::Zero();
  Matrix m_axes = Matrix::Identity(); // of the principal frame
  std::vector<Vector> m_local;        // the points in it
  bool m_is_line = false;
  double m_extent = 0;
  double m_spacing = 0;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_SURFACE_FROM_POINTS_H
