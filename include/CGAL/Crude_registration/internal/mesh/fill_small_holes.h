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

// A halfedge of each border that is no wider than `diameter`, seen from its first vertex, and lies around a hole. The
// outer border of a small part of the surface is no hole: a face that closed it would look the other way than the faces
// around. Linear time.
template <class Triangle_mesh, class Point_map>
std::vector<typename boost::graph_traits<Triangle_mesh>::halfedge_descriptor>
small_holes(const Triangle_mesh& mesh, const Point_map& point_map, double diameter)
{
  using Halfedge = typename boost::graph_traits<Triangle_mesh>::halfedge_descriptor;
  std::vector<Halfedge> holes;
  std::unordered_set<Halfedge> seen; // never iterated over
  for (Halfedge h : halfedges(mesh)) {
    if (!is_border(h, mesh) || !seen.insert(h).second) continue;
    const auto place = [&](Halfedge g) { return to_vector(get(point_map, target(g, mesh))); };
    const Vector first = place(h);
    Vector inside = Vector::Zero(), around = Vector::Zero(), last = Vector::Zero();
    bool is_small = true;
    for (Halfedge g : halfedges_around_face(h, mesh)) {
      seen.insert(g);
      const Vector p = place(g) - first;
      is_small = is_small && p.norm() <= diameter;
      inside += last.cross(p);
      last = p;
      const Halfedge o = opposite(g, mesh);
      const Vector a = place(o) - first, b = place(next(o, mesh)) - first;
      around += (b - a).cross(p - a).stableNormalized();
    }
    if (is_small && inside.dot(around) > 0) holes.push_back(h);
  }
  return holes;
}

// Closes the holes of some borders: each gets a vertex in its middle, joined to all of the border.
template <class Triangle_mesh, class Point_map, class Halfedges>
void fill_holes(Triangle_mesh& mesh, Point_map point_map, const Halfedges& borders)
{
  using Point = typename boost::property_traits<Point_map>::value_type;
  for (auto h : borders) {
    const Vector first = to_vector(get(point_map, target(h, mesh)));
    Vector sum = Vector::Zero();
    double count = 0;
    for (auto g : halfedges_around_face(h, mesh)) {
      sum += to_vector(get(point_map, target(g, mesh))) - first;
      ++count;
    }
    const Vector c = first + sum / count;
    Euler::fill_hole(h, mesh);
    put(point_map, target(Euler::add_center_vertex(h, mesh), mesh), Point(c.x(), c.y(), c.z()));
  }
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MESH_FILL_SMALL_HOLES_H
