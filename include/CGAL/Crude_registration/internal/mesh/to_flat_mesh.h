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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MESH_TO_FLAT_MESH_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MESH_TO_FLAT_MESH_H

// The door from the models of FaceGraph to flat arrays.

#include <CGAL/Crude_registration/internal/base/Run_control.h>
#include <CGAL/Crude_registration/internal/mesh/Flat_mesh.h>
#include <CGAL/Crude_registration/internal/mesh/mesh_geometry.h>
#include <CGAL/Crude_registration/named_parameters.h>

#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/named_params_helper.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The vertex point map of a named parameter pack, or the one of the graph.
template <class Face_graph, class NP>
auto const_vertex_point_map(const Face_graph& graph, const NP& np)
{
  return parameter(np, internal_np::vertex_point, get_const_property_map(vertex_point, graph));
}

template <class Face_graph, class NP>
auto mutable_vertex_point_map(Face_graph& graph, const NP& np)
{
  return parameter(np, internal_np::vertex_point, get_property_map(vertex_point, graph));
}

inline void check_size(const std::vector<Vector>& points, const std::string& function, const std::string& argument)
{
  if (points.empty()) return;
  Vector low = points.front(), high = low;
  for (const Vector& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double size = (high - low).maxCoeff();
  if ((std::max)(high.maxCoeff(), -low.minCoeff()) > largest_coordinate || (size > 0 && size < smallest_size))
    throw std::invalid_argument(function + ": " + argument +
                                " has coordinates above 1e75 or a size below 1e-75: another unit of length is needed");
}

// A FaceGraph as flat arrays: vertices and faces in the order of vertices(graph) and faces(graph), vertices without a
// face included, null faces left out.
// `function` and `argument` name the caller and its argument in the text of what is thrown:
// std::invalid_argument for a face that is not a triangle, a coordinate that is not finite, more than 2^31 - 1 vertices
// or faces; Run_control::Stopped.
template <class Face_graph, class NP>
Flat_mesh to_flat_mesh(const Face_graph& graph, const NP& np, const std::string& function, const std::string& argument,
                       Run_control& control = to_the_end())
{
  const auto point_map = const_vertex_point_map(graph, np);
  const auto index_map = CGAL::get_initialized_vertex_index_map(graph);
  constexpr std::size_t limit = std::size_t((std::numeric_limits<std::int32_t>::max)());
  if (num_vertices(graph) > limit || num_faces(graph) > limit)
    throw std::invalid_argument(function + ": " + argument + " has more than 2^31 - 1 vertices or faces");

  Flat_mesh mesh;
  mesh.points.reserve(num_vertices(graph));
  mesh.faces.reserve(num_faces(graph));
  // Removed elements that have not been collected leave gaps in the graph's own indices.
  std::vector<std::int32_t> flat_index(num_vertices(graph), -1);
  for (auto v : vertices(graph)) {
    control.check(mesh.points.size());
    const auto& p = get(point_map, v);
    const Vector q(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
    if (!q.allFinite())
      throw std::invalid_argument(function + ": vertex " + std::to_string(mesh.points.size()) + " of " + argument +
                                  " has a coordinate that is not finite");
    flat_index[std::size_t(get(index_map, v))] = std::int32_t(mesh.points.size());
    mesh.points.push_back(q);
  }
  check_size(mesh.points, function, argument);
  for (auto f : faces(graph)) {
    control.check(mesh.faces.size());
    const auto h = halfedge(f, graph);
    const auto h1 = next(h, graph), h2 = next(h1, graph);
    if (next(h2, graph) != h || h2 == h || h1 == h)
      throw std::invalid_argument(function + ": face " + std::to_string(mesh.faces.size()) + " of " + argument +
                                  " is not a triangle");
    mesh.faces.push_back({flat_index[std::size_t(get(index_map, target(h, graph)))],
                          flat_index[std::size_t(get(index_map, target(h1, graph)))],
                          flat_index[std::size_t(get(index_map, target(h2, graph)))]});
  }
  return mesh;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MESH_TO_FLAT_MESH_H
