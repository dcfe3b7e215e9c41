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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MESH_FLAT_MESH_REPAIR_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MESH_FLAT_MESH_REPAIR_H

// Makes a manifold of triangles.

#include <CGAL/Crude_registration/internal/mesh/Flat_mesh.h>
#include <CGAL/Crude_registration/internal/mesh/mesh_geometry.h>
#include <CGAL/Crude_registration/internal/base/Run_control.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Makes the points that the faces refer to the points of the mesh, in their order. \throws Run_control::Stopped
inline void keep_used_points(Flat_mesh& mesh, const std::vector<Vector>& points, Run_control& control)
{
  std::vector<std::int32_t> new_index(points.size(), -1);
  for (const auto& f : mesh.faces)
    for (std::int32_t v : f) new_index[static_cast<std::size_t>(v)] = 0;
  std::vector<Vector> kept;
  for (std::size_t v = 0; v < points.size(); ++v) {
    control.check(v);
    if (new_index[v] < 0) continue;
    new_index[v] = static_cast<std::int32_t>(kept.size());
    kept.push_back(points[v]);
  }
  control.check();
  for (auto& f : mesh.faces)
    for (std::int32_t& v : f) v = new_index[static_cast<std::size_t>(v)];
  mesh.points = std::move(kept);
}

// Makes the edges manifold and the faces consistent: of the faces that have an edge in the same direction the first at
// its vertex stays.
inline void keep_manifold_edges(Flat_mesh& mesh)
{
  const Index_lists faces = faces_of_vertices(mesh);
  std::vector<std::int32_t> seen_from(mesh.points.size(), -1);
  std::vector<bool> is_left_out(mesh.faces.size(), false);
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    for (const std::int32_t* i = faces.begin(v); i != faces.end(v); ++i) {
      if (is_left_out[static_cast<std::size_t>(*i)]) continue;
      const auto& f = mesh.faces[static_cast<std::size_t>(*i)];
      const auto vertex = static_cast<std::int32_t>(v);
      std::int32_t& from = seen_from[static_cast<std::size_t>(f[0] == vertex ? f[1] : f[1] == vertex ? f[2] : f[0])];
      if (from == vertex) is_left_out[static_cast<std::size_t>(*i)] = true;
      from = vertex;
    }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < mesh.faces.size(); ++i)
    if (!is_left_out[i]) mesh.faces[kept++] = mesh.faces[i];
  mesh.faces.resize(kept);
}

// A corner of a face at some vertex.
struct Corner
{
  std::size_t id;              // 3 f + k: the k-th of face f
  std::int32_t next, previous; // the other vertices of the face
};

// Takes a fan from the corners that are left at a vertex: those of faces that follow each other over shared edges.
inline std::vector<std::size_t> take_fan(std::vector<Corner>& open)
{
  // it grows over the edges at both of its ends
  Corner fan = open.front();
  std::vector<std::size_t> members = {fan.id};
  open.erase(open.begin());
  for (std::size_t i = 0; i < open.size();) {
    if (open[i].next == fan.previous) fan.previous = open[i].previous;
    else if (open[i].previous == fan.next) fan.next = open[i].next;
    else {
      ++i;
      continue;
    }
    members.push_back(open[i].id);
    open.erase(open.begin() + static_cast<std::ptrdiff_t>(i));
    i = 0;
  }
  return members;
}

// In a mesh whose edges are manifold and whose faces are consistent, gives each fan of faces around a vertex, faces
// that follow each other over shared edges, a vertex of its own: the first keeps the vertex, the others get copies at
// the end of the points. Returns what vertex each of these copies. Linear, as long as vertices have few faces.
// \throws Run_control::Stopped
inline std::vector<std::int32_t> split_non_manifold_vertices(Flat_mesh& mesh, Run_control& control = to_the_end())
{
  std::vector<std::int32_t> originals;
  // the corners of each vertex
  std::vector<std::int32_t> begin(mesh.points.size() + 1, 0), corners(3 * mesh.faces.size());
  for (const auto& f : mesh.faces)
    for (std::int32_t v : f) ++begin[static_cast<std::size_t>(v) + 1];
  for (std::size_t v = 1; v < begin.size(); ++v) begin[v] += begin[v - 1];
  std::vector<std::int32_t> end(begin.begin(), begin.end() - 1);
  for (std::size_t c = 0; c < corners.size(); ++c) {
    control.check(c);
    corners[static_cast<std::size_t>(end[static_cast<std::size_t>(mesh.faces[c / 3][c % 3])]++)] =
        static_cast<std::int32_t>(c);
  }

  const std::vector<std::array<std::int32_t, 3>> faces = mesh.faces; // next and previous before any splitting
  std::vector<Corner> open;
  for (std::size_t v = 0; v + 1 < begin.size(); ++v) {
    control.check(v);
    open.clear();
    for (std::int32_t i = begin[v]; i < begin[v + 1]; ++i) {
      const std::size_t c = static_cast<std::size_t>(corners[static_cast<std::size_t>(i)]);
      const auto& face = faces[c / 3];
      open.push_back({c, face[(c % 3 + 1) % 3], face[(c % 3 + 2) % 3]});
    }
    for (bool is_first = true; !open.empty(); is_first = false) {
      const std::vector<std::size_t> members = take_fan(open);
      if (is_first) continue;
      const auto copy = static_cast<std::int32_t>(mesh.points.size());
      mesh.points.push_back(Vector(mesh.points[v]));
      originals.push_back(static_cast<std::int32_t>(v));
      for (std::size_t c : members) mesh.faces[c / 3][c % 3] = copy;
    }
  }
  return originals;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MESH_FLAT_MESH_REPAIR_H
