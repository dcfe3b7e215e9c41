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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_PROJECTED_TRIANGULATION_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_PROJECTED_TRIANGULATION_H

// The triangulation of points by their projections along the lines of sight.

#include <CGAL/Crude_registration/internal/mesh/Flat_mesh.h>
#include <CGAL/Crude_registration/internal/sampling/Flat_range_image.h>
#include <CGAL/Crude_registration/internal/base/Run_control.h>
#include <CGAL/Crude_registration/internal/mesh/flat_mesh_repair.h>

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/Triangulation_data_structure_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include <boost/property_map/function_property_map.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Triangulates points that a known sensor saw, without a grid: they are projected along the lines of sight, and the
// Delaunay triangulation of the projections is the neighbourhood that the grid would have given.
//
// An orthographic sensor's points are projected on a plane, a perspective one's on the sphere of directions and from
// there stereographically on a plane: that maps circles to circles, so that the result is the Delaunay triangulation of
// the directions however wide the view, short of its antipode.
class Projected_triangulation
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Point_2 = Kernel::Point_2;
  using Vertex_base = CGAL::Triangulation_vertex_base_with_info_2<std::int32_t, Kernel>;
  using Delaunay = CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex_base>>;

public:
  // a known sensor; the longest edge is as in Flat_triangulation
  Projected_triangulation(const std::vector<Vector>& points, const Flat_sensor& sensor, double ratio,
                          Run_control& control)
      : m_points(points), m_sensor(sensor), m_ratio(ratio), m_control(control)
  {}

  // Vertices in the order of the points. Of points on one line of sight only the nearest takes part.
  // \throws Run_control::Stopped
  Flat_mesh operator()()
  {
    Flat_mesh mesh;
    if (m_points.size() < 3) return mesh;
    project();
    insert();
    measure_sampling();
    make_mesh(mesh);
    split_non_manifold_vertices(mesh, m_control);
    return mesh;
  }

private:
  bool is_perspective() const { return m_sensor.kind == Flat_sensor::PERSPECTIVE; }

  void project()
  {
    Vector axis = m_sensor.vector; // the mean line of sight
    Vector origin = m_points.front();
    if (is_perspective()) {
      origin = m_sensor.vector;
      m_ranges.resize(m_points.size());
      m_directions.resize(m_points.size());
      axis = Vector::Zero();
      for (std::size_t i = 0; i < m_points.size(); ++i) {
        m_control.check(i);
        m_directions[i] = m_points[i] - m_sensor.vector;
        m_ranges[i] = m_directions[i].norm();
        if (m_ranges[i] > 0) m_directions[i] /= m_ranges[i];
        axis += m_directions[i];
      }
      // seen all around: any axis will do
      if (!(axis.norm() > 1e-3 * static_cast<double>(m_points.size()))) axis = m_directions.front();
    }
    if (!(axis.norm() > 0)) axis = Vector::UnitZ();
    axis.normalize();
    // u x v points to the sensor: counterclockwise in the plane is so seen from it
    const Vector u = axis.unitOrthogonal(), v = u.cross(axis);
    m_projections.resize(m_points.size());
    for (std::size_t i = 0; i < m_points.size(); ++i) {
      m_control.check(i);
      const Vector p = is_perspective() ? m_directions[i] : Vector(m_points[i] - origin);
      const double scale = is_perspective() ? 1 + p.dot(axis) : 1;
      m_projections[i] = Point_2(p.dot(u) / scale, p.dot(v) / scale);
    }
  }

  // is there a line of sight, and is it not opposite to the mean one?
  bool has_projection(std::size_t i) const
  {
    return (!is_perspective() || m_ranges[i] > 0) && std::isfinite(m_projections[i].x()) &&
           std::isfinite(m_projections[i].y());
  }

  double depth(std::size_t i) const { return is_perspective() ? m_ranges[i] : m_sensor.vector.dot(m_points[i]); }

  void insert()
  {
    std::vector<std::size_t> order;
    order.reserve(m_points.size());
    for (std::size_t i = 0; i < m_points.size(); ++i)
      if (has_projection(i)) order.push_back(i);
    // (Sorting asks for the projections: it can be stopped there.)
    std::size_t steps = 0;
    const auto projection =
        boost::make_function_property_map<std::size_t, const Point_2&>([&](std::size_t i) -> const Point_2& {
          m_control.check(++steps);
          return m_projections[i];
        });
    CGAL::spatial_sort(order.begin(), order.end(),
                       CGAL::Spatial_sort_traits_adapter_2<Kernel, decltype(projection)>(projection));
    Delaunay::Face_handle hint;
    for (std::size_t i : order) {
      m_control.check();
      const std::size_t before = m_delaunay.number_of_vertices();
      const Delaunay::Vertex_handle v = m_delaunay.insert(m_projections[i], hint);
      hint = v->face();
      const bool is_new = m_delaunay.number_of_vertices() > before;
      if (is_new || is_nearer(i, static_cast<std::size_t>(v->info()))) v->info() = static_cast<std::int32_t>(i);
    }
  }

  bool is_nearer(std::size_t i, std::size_t j) const { return depth(i) < depth(j) || (depth(i) == depth(j) && i < j); }

  // The sampling distance, from the median edge of the Delaunay triangulation in the image: on a grid of a by b the
  // edges are a, b and the diagonal, so that the median is the larger of a and b, as it is for a range image.
  void measure_sampling()
  {
    std::vector<double> lengths;
    for (auto e = m_delaunay.finite_edges_begin(); e != m_delaunay.finite_edges_end(); ++e) {
      m_control.check(lengths.size());
      const auto v = e->first->vertex(Delaunay::ccw(e->second)), w = e->first->vertex(Delaunay::cw(e->second));
      const std::size_t i = static_cast<std::size_t>(v->info()), j = static_cast<std::size_t>(w->info());
      lengths.push_back(is_perspective() ? (m_directions[i] - m_directions[j]).norm()
                                         : std::sqrt(CGAL::to_double(CGAL::squared_distance(v->point(), w->point()))));
    }
    m_sampling.distance = median(lengths);
    if (is_perspective()) {
      m_sampling.angle = m_sampling.distance;
      std::vector<double> ranges = m_ranges;
      m_sampling.distance *= median(ranges);
    }
  }

  double squared_limit(std::size_t i) const
  {
    const double limit = m_ratio * (is_perspective() ? m_sampling.angle * m_ranges[i] : m_sampling.distance);
    return limit * limit * (1 + 1e-9);
  }

  bool is_short(std::size_t i, std::size_t j) const
  {
    return (m_points[i] - m_points[j]).squaredNorm() <= (std::min)(squared_limit(i), squared_limit(j));
  }

  void make_mesh(Flat_mesh& mesh) const
  {
    std::size_t steps = 0;
    for (auto f = m_delaunay.finite_faces_begin(); f != m_delaunay.finite_faces_end(); ++f) {
      m_control.check(++steps);
      const std::array<std::int32_t, 3> face = {f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()};
      bool keep = true;
      for (std::size_t k = 0; k < 3; ++k)
        keep = keep && is_short(static_cast<std::size_t>(face[k]), static_cast<std::size_t>(face[(k + 1) % 3]));
      if (keep) mesh.faces.push_back(face);
    }
    keep_used_points(mesh, m_points, m_control);
  }

  const std::vector<Vector>& m_points;
  const Flat_sensor& m_sensor;
  const double m_ratio;
  Run_control& m_control;
  std::vector<double> m_ranges;     // perspective only
  std::vector<Vector> m_directions; // perspective only: unit, from the viewpoint
  std::vector<Point_2> m_projections;
  Delaunay m_delaunay;
  Sampling m_sampling;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_PROJECTED_TRIANGULATION_H
