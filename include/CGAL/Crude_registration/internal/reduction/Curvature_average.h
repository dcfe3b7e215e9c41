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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_CURVATURE_AVERAGE_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_CURVATURE_AVERAGE_H

// Curvature tensors averaged over neighbourhoods.

#include <CGAL/Crude_registration/internal/mesh/Flat_mesh.h>
#include <CGAL/Crude_registration/internal/mesh/mesh_geometry.h>
#include <CGAL/Crude_registration/internal/reduction/Curvature_tensor.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// `t`, written in the frame of first vector `u` of the plane of normal n, rotated about n x m into the plane of normal
// m and written in that plane's Tangent_frame (Rusinkiewicz 2004, section 3.2). False, and `result` untouched, where n
// and m are so nearly opposite that the rotation has no meaning.
inline bool rotate_tensor(const Curvature_tensor& t, const Vector& u, const Vector& n, const Vector& m,
                          Curvature_tensor& result)
{
  const double denominator = 1 + n.dot(m);
  if (!(denominator > 1e-3)) return false;
  const Vector rotated = u - ((u.dot(m) / denominator) * (n + m));
  const Tangent_frame frame(m);
  const double c = rotated.dot(frame.u), s = rotated.dot(frame.v);
  const double cc = c * c, cs = c * s, ss = s * s;
  result.uu = cc * t.uu - 2 * cs * t.uv + ss * t.vv;
  result.uv = cs * (t.uu - t.vv) + (cc - ss) * t.uv;
  result.vv = ss * t.uu + 2 * cs * t.uv + cc * t.vv;
  return true;
}

// Averages of the tensors of a field over the vertices around a vertex. At the resolution of a scan the curvature is
// mostly noise; its average over a neighbourhood is what another scan of the surface shows, too.
class Curvature_average
{
public:
  // The arguments are kept by reference. `borders`: flags as of border_flags().
  Curvature_average(const Flat_mesh& mesh, const Index_lists& neighbours, const Curvature_field& field,
                    const std::vector<std::uint8_t>& borders)
      : m_mesh(mesh), m_neighbours(neighbours), m_field(field), m_borders(borders), m_seen_from(mesh.points.size(), -1)
  {}

  struct Result
  {
    Curvature_tensor tensor; // in the Tangent_frame of the vertex's normal
    double radius = 0;       // of the neighbourhood that was used, 0 for an isolated vertex
  };

  // The average over the vertices that are connected to `vertex` inside the ball of the given radius around it,
  // weighted by area and by 1 - (distance / radius)^2. The neighbourhood ends at the nearest border vertex, where the
  // tensors become one-sided, but not below half the radius: there it takes what lies inside the border, and the border
  // itself only where there is nothing else. The cost is proportional to the number of vertices in the ball.
  Result operator()(std::size_t vertex, double radius)
  {
    const Vector& centre = m_mesh.points[vertex];
    m_found.clear();
    m_found.push_back({std::int32_t(vertex), 0.0});
    m_seen_from[vertex] = std::int32_t(vertex);
    double border_distance2 = radius * radius;
    for (std::size_t i = 0; i < m_found.size(); ++i) {
      const auto [w, distance2] = m_found[i];
      if (m_borders[std::size_t(w)]) border_distance2 = (std::min)(border_distance2, distance2);
      for (const std::int32_t* x = m_neighbours.begin(std::size_t(w)); x != m_neighbours.end(std::size_t(w)); ++x) {
        if (m_seen_from[std::size_t(*x)] == std::int32_t(vertex)) continue;
        m_seen_from[std::size_t(*x)] = std::int32_t(vertex);
        const double d2 = (m_mesh.points[std::size_t(*x)] - centre).squaredNorm();
        if (d2 < radius * radius) m_found.push_back({*x, d2});
      }
    }
    // A vertex is found once a call; without this a second call for it would find nothing.
    for (const Found& found : m_found) m_seen_from[std::size_t(found.vertex)] = -1;

    const double end2 = (std::max)(border_distance2, 0.25 * radius * radius);
    Result result;
    if (!sum(vertex, end2, false, result.tensor) && !sum(vertex, end2, true, result.tensor)) {
      result.tensor = m_field.tensors[vertex];
      return result;
    }
    result.radius = std::sqrt(end2);
    return result;
  }

private:
  struct Found
  {
    std::int32_t vertex;
    double distance2;
  };

  bool sum(std::size_t vertex, double end2, bool with_borders, Curvature_tensor& average) const
  {
    const Vector& normal = m_field.normals[vertex];
    Curvature_tensor total;
    double weights = 0;
    for (const Found& found : m_found) {
      const auto w = std::size_t(found.vertex);
      if (found.distance2 >= end2 || (m_borders[w] && !with_borders)) continue;
      const double weight = m_field.areas[w] * (1 - found.distance2 / end2);
      Curvature_tensor rotated;
      if (!(weight > 0) ||
          !rotate_tensor(m_field.tensors[w], Tangent_frame(m_field.normals[w]).u, m_field.normals[w], normal, rotated))
        continue;
      total += weight * rotated;
      weights += weight;
    }
    if (!(weights > 0)) return false;
    average = total / weights;
    return true;
  }

  const Flat_mesh& m_mesh;
  const Index_lists& m_neighbours;
  const Curvature_field& m_field;
  const std::vector<std::uint8_t>& m_borders;
  std::vector<std::int32_t> m_seen_from;
  std::vector<Found> m_found;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_CURVATURE_AVERAGE_H
