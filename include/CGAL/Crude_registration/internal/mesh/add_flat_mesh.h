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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MESH_ADD_FLAT_MESH_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MESH_ADD_FLAT_MESH_H

// The door from flat arrays to the models of FaceGraph.

#include <CGAL/Crude_registration/internal/mesh/Flat_mesh.h>
#include <CGAL/Crude_registration/named_parameters.h>

#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/named_params_helper.h>

#include <array>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Adds a flat mesh that is manifold, vertices and faces in their order, to what a FaceGraph holds.
template <class FaceGraph, class NamedParameters>
void add_flat_mesh(const Flat_mesh& flat, FaceGraph& mesh, const NamedParameters& np)
{
  auto point_map = parameter(np, internal_np::vertex_point, get_property_map(vertex_point, mesh));
  using Point = typename boost::property_traits<decltype(point_map)>::value_type;
  std::vector<typename boost::graph_traits<FaceGraph>::vertex_descriptor> vertices;
  vertices.reserve(flat.points.size());
  for (const Vector& p : flat.points) {
    vertices.push_back(add_vertex(mesh));
    put(point_map, vertices.back(), Point(p.x(), p.y(), p.z()));
  }
  for (const auto& f : flat.faces)
    Euler::add_face(std::array{vertices[static_cast<std::size_t>(f[0])], vertices[static_cast<std::size_t>(f[1])],
                               vertices[static_cast<std::size_t>(f[2])]},
                    mesh);
}

// Leaves the property maps of the mesh, which CGAL::clear() of a Surface_mesh does not.
template <class Mesh>
auto remove_all_elements(Mesh& mesh, int) -> decltype(mesh.clear_without_removing_property_maps())
{
  mesh.clear_without_removing_property_maps();
}

template <class Mesh>
void remove_all_elements(Mesh& mesh, long)
{
  const auto remove_all = [&mesh](const auto& range, const auto& remove) {
    const std::vector<std::decay_t<decltype(*range.begin())>> all(range.begin(), range.end());
    for (auto element : all) remove(element, mesh);
  };
  remove_all(faces(mesh), [](auto f, Mesh& m) { remove_face(f, m); });
  remove_all(edges(mesh), [](auto e, Mesh& m) { remove_edge(e, m); });
  remove_all(vertices(mesh), [](auto v, Mesh& m) { remove_vertex(v, m); });
}

template <class Mesh>
void remove_all_elements(Mesh& mesh)
{
  remove_all_elements(mesh, 0);
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MESH_ADD_FLAT_MESH_H
