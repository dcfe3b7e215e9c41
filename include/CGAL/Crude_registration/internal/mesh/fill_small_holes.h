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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MESH_FILL_SMALL_HOLES_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MESH_FILL_SMALL_HOLES_H

// Closes the holes that single lost samples leave in the surface of a scan.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>

#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/iterator.h>

#include <cstddef>
#include <unordered_set>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Each border that is no wider than `diameter`, seen from its first vertex, and lies around a hole gets a vertex in its
// middle, joined to all of the border. The outer border of a small part of the surface is no hole: a face that closed
// it would look the other way than the faces around. Returns the number of holes. Linear time.
template <class Triangle_mesh, class Point_map>
std::size_t fill_small_holes(Triangle_mesh& mesh, Point_map point_map, double diameter)
{
  using Halfedge = typename boost::graph_traits<Triangle_mesh>::halfedge_descriptor;
  using Point = typename boost::property_traits<Point_map>::value_type;
  std::vector<std::vector<Halfedge>> borders;
  std::unordered_set<Halfedge> seen; // never iterated over
  for (Halfedge h : halfedges(mesh)) {
    if (!is_border(h, mesh) || !seen.insert(h).second) continue;
    borders.emplace_back();
    for (Halfedge g : halfedges_around_face(h, mesh)) {
      seen.insert(g);
      borders.back().push_back(g);
    }
  }
  std::size_t holes = 0;
  for (const std::vector<Halfedge>& border : borders) {
    const auto place = [&](Halfedge h) { return to_vector(get(point_map, target(h, mesh))); };
    const Vector first = place(border.front());
    Vector inside = Vector::Zero(), around = Vector::Zero(), middle = Vector::Zero(), last = Vector::Zero();
    bool is_small = true;
    for (Halfedge h : border) {
      const Vector p = place(h) - first;
      is_small = is_small && p.norm() <= diameter;
      inside += last.cross(p);
      middle += p / double(border.size());
      last = p;
      const Halfedge o = opposite(h, mesh);
      const Vector a = place(o) - first, b = place(next(o, mesh)) - first;
      around += (b - a).cross(p - a).stableNormalized();
    }
    if (!is_small || border.size() < 3 || !(inside.dot(around) > 0)) continue;
    const Halfedge h = border.front();
    Euler::fill_hole(h, mesh);
    const Vector c = first + middle;
    put(point_map, target(Euler::add_center_vertex(h, mesh), mesh), Point(c.x(), c.y(), c.z()));
    ++holes;
  }
  return holes;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MESH_FILL_SMALL_HOLES_H
