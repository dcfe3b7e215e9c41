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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_LIKELY_VIEWPOINT_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_LIKELY_VIEWPOINT_H

// The place from where most of a surface is visible.

#include <CGAL/Crude_registration/internal/base/Counter_random.h>
#include <CGAL/Crude_registration/internal/mesh/Flat_mesh.h>
#include <CGAL/Crude_registration/internal/base/Run_control.h>
#include <CGAL/Crude_registration/internal/lookup/Triangle_tree.h>
#include <CGAL/Crude_registration/internal/mesh/mesh_geometry.h>

#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Looks for the place from where a surface of unknown origin was seen, a room by a camera that moved in it, say: most
// of the surface is visible from there, without a piece of it in between. Places are tried all around and within.
class Likely_viewpoint
{
  using Kernel = CGAL::Simple_cartesian<double>;

public:
  // \pre The faces of each connected part of `mesh` look, in the mean, away from the centroid of the whole.
  // `spacing`: of the vertices. `axes`: unit, the frame in which places are tried; it moves with the mesh.
  Likely_viewpoint(const Flat_mesh& mesh, double spacing, const Matrix& axes, Run_control& control)
      : m_mesh(mesh), m_spacing(spacing), m_axes(axes), m_control(control), m_vertices(shuffled(mesh.points.size(), 4)),
        m_faces(shuffled(mesh.faces.size(), 5))
  {}

  // Is there a place from where the surface was most likely seen from inside? An object seen from outside has none:
  // its surface is as visible from a place that it looks at already.
  bool find(Vector& viewpoint)
  {
    if (m_mesh.faces.empty()) return false;
    build();
    std::vector<Place> places = all_places();
    keep_best(places, 0, 150, 150);
    keep_best(places, 150, 500, 40);
    keep_best(places, 650, 3000, places.size());
    constexpr double all = 0.95, most = 0.7, half_of_the_sphere = 0.5;
    for (const Place& p : places)
      if (p.visible >= all && is_looked_at(p.position)) return false;
    if (places.front().visible < most || coverage(places.front().position) > half_of_the_sphere) return false;
    viewpoint = m_centre + m_spacing * places.front().position;
    return true;
  }

private:
  struct Place
  {
    Vector position;
    double visible; // share of the vertices
  };

  static Kernel::Point_3 to_point(const Vector& v) { return {v.x(), v.y(), v.z()}; }

  // (The tree takes coordinates about the centre, in spacings: its tolerances, if any, then fit the data.)
  void build()
  {
    constexpr double infinite = (std::numeric_limits<double>::max)();
    m_low = Vector::Constant(infinite);
    m_high = -m_low;
    for (const Vector& p : m_mesh.points) {
      const Vector q = m_axes.transpose() * (p - m_mesh.points.front());
      m_low = m_low.cwiseMin(q);
      m_high = m_high.cwiseMax(q);
    }
    m_centre = m_mesh.points.front() + m_axes * (m_low + m_high) / 2;
    m_triangles.reserve(m_mesh.faces.size());
    for (const auto& f : m_mesh.faces) m_triangles.emplace_back(local(f[0]), local(f[1]), local(f[2]));
    m_tree.insert(m_triangles.cbegin(), m_triangles.cend());
    m_tree.build();
  }

  Kernel::Point_3 local(std::int32_t vertex) const { return to_point(position(vertex)); }

  Vector position(std::int32_t vertex) const
  {
    return (m_mesh.points[static_cast<std::size_t>(vertex)] - m_centre) / m_spacing;
  }

  // Up to one and a half extents from the centre along each axis, denser near it.
  std::vector<Place> all_places() const
  {
    constexpr std::array<double, 9> steps = {-1.5, -0.85, -0.375, -0.1, 0, 0.1, 0.375, 0.85, 1.5};
    const double extent = (m_high - m_low).maxCoeff() / m_spacing;
    std::vector<Place> places;
    for (double x : steps)
      for (double y : steps)
        for (double z : steps) places.push_back({m_axes * (extent * Vector(x, y, z)), 0});
    return places;
  }

  // Leaves the places from where most of `n` vertices are visible: from the one numbered `from` on, around the end.
  void keep_best(std::vector<Place>& places, std::size_t from, std::size_t n, std::size_t kept) const
  {
    n = (std::min)(n, m_vertices.size());
    for (Place& p : places) {
      m_control.check();
      std::size_t visible = 0;
      for (std::size_t i = from; i < from + n; ++i)
        visible += is_visible(position(m_vertices[i % m_vertices.size()]), p.position);
      p.visible = static_cast<double>(visible) / static_cast<double>(n);
    }
    std::stable_sort(places.begin(), places.end(),
                     [](const Place& a, const Place& b) { return a.visible > b.visible; });
    places.resize((std::min)(kept, places.size()));
  }

  // Nothing in between: but the noise around the point itself. No more than that: what stands before a wall is hidden
  // from behind the wall, and tells its sides apart.
  bool is_visible(const Vector& point, const Vector& from) const
  {
    constexpr double noise = 1; // spacings
    const Vector d = from - point;
    const double length = d.norm();
    return length <= noise ||
           !m_tree.do_intersect(Kernel::Segment_3(to_point(from), to_point(point + noise / length * d)));
  }

  // Does more of the surface look at the place than away from it?
  bool is_looked_at(const Vector& place) const
  {
    double sum = 0;
    for (std::size_t i = 0; i < (std::min)(m_faces.size(), std::size_t(2000)); ++i) {
      const auto& face = m_mesh.faces[static_cast<std::size_t>(m_faces[i])];
      sum += area_vector(m_mesh, face).dot(unit_or_zero(place - position(face[0])));
    }
    return sum > 0;
  }

  // The share of the directions from the place in which there is surface.
  double coverage(const Vector& place) const
  {
    const Counter_random random(6);
    constexpr std::uint64_t n = 500;
    const double far = 4 * (place.norm() + (m_high - m_low).norm() / m_spacing);
    std::size_t hits = 0;
    for (std::uint64_t i = 0; i < n; ++i) {
      const Vector d = unit_or_zero(Vector(random.normal(3 * i), random.normal(3 * i + 1), random.normal(3 * i + 2)));
      hits += m_tree.do_intersect(Kernel::Segment_3(to_point(place), to_point(place + far * (m_axes * d))));
    }
    return static_cast<double>(hits) / static_cast<double>(n);
  }

  const Flat_mesh& m_mesh;
  const double m_spacing;
  const Matrix m_axes;
  Run_control& m_control;
  const std::vector<std::int32_t> m_vertices, m_faces; // in an order without pattern
  Vector m_low, m_high, m_centre;
  Triangle_tree<Kernel>::Triangles m_triangles;
  Triangle_tree<Kernel>::type m_tree;
};

// Turns each face of a mesh, whose connected parts are consistent each, to the side that its neighbourhood shows to the
// viewpoint: to that of the mean over the faces at its vertices.
inline void turn_to(const Vector& viewpoint, Flat_mesh& mesh)
{
  const auto shown = [&](const std::array<std::int32_t, 3>& face) {
    return area_vector(mesh, face).dot(unit_or_zero(viewpoint - mesh.points[static_cast<std::size_t>(face[0])]));
  };
  std::vector<double> side(mesh.points.size(), 0);
  for (const auto& f : mesh.faces)
    for (std::int32_t v : f) side[static_cast<std::size_t>(v)] += shown(f);
  for (auto& f : mesh.faces) {
    double sum = 0;
    for (std::int32_t v : f) sum += side[static_cast<std::size_t>(v)];
    if (sum < 0) std::swap(f[1], f[2]);
  }
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_LIKELY_VIEWPOINT_H
