// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MESH_MESH_GEOMETRY_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MESH_MESH_GEOMETRY_H

#include <CGAL/Crude_registration/internal/mesh/Flat_mesh.h>
#include <CGAL/Crude_registration/internal/base/Run_control.h>
#include <CGAL/Crude_registration/named_parameters.h>

#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/named_params_helper.h>

#include <Eigen/Geometry>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The normal of face (a, b, c) times twice its area.
inline Vector area_vector(const Vector& a, const Vector& b, const Vector& c)
{
  return (b - a).cross(c - a);
}

inline Vector area_vector(const Flat_mesh& mesh, const std::array<std::int32_t, 3>& face)
{
  return area_vector(mesh.points[std::size_t(face[0])], mesh.points[std::size_t(face[1])],
                     mesh.points[std::size_t(face[2])]);
}

// The area of each face. \throws Run_control::Stopped
inline std::vector<double> face_areas(const Flat_mesh& mesh, Run_control& control = to_the_end())
{
  std::vector<double> areas;
  areas.reserve(mesh.faces.size());
  for (const auto& f : mesh.faces) {
    control.check(areas.size());
    areas.push_back(0.5 * area_vector(mesh, f).norm());
  }
  return areas;
}

// v / |v|, and the zero vector for v = 0; no squared length over- or underflows.
inline Vector unit_or_zero(const Vector& v)
{
  const double largest = v.cwiseAbs().maxCoeff();
  if (!(largest > 0)) return Vector::Zero();
  const Vector scaled = v / largest;
  return scaled / scaled.norm();
}

// Unit normals of the vertices; zero where no face of positive area is incident. The faces' normals are weighted by
// sin(angle) / (product of the two edge lengths), which is exact on a sphere however it is triangulated (Max, "Weights
// for computing vertex normals from facet normals", 1999), and is what Rusinkiewicz's curvatures build on.
// \throws Run_control::Stopped
inline std::vector<Vector> vertex_normals(const Flat_mesh& mesh, Run_control& control = to_the_end())
{
  std::vector<Vector> normals(mesh.points.size(), Vector::Zero());
  std::size_t steps = 0;
  for (const auto& f : mesh.faces) {
    control.check(++steps);
    const auto a = std::size_t(f[0]), b = std::size_t(f[1]), c = std::size_t(f[2]);
    const Vector ab = mesh.points[b] - mesh.points[a], ac = mesh.points[c] - mesh.points[a],
                 bc = mesh.points[c] - mesh.points[b];
    const double ab2 = ab.squaredNorm(), ac2 = ac.squaredNorm(), bc2 = bc.squaredNorm();
    // One after the other: no product is of more than two lengths.
    const double by_ab2 = 1 / ab2, by_ac2 = 1 / ac2, by_bc2 = 1 / bc2;
    if (!std::isfinite(ab2 + ac2 + bc2) || !std::isfinite(by_ab2 + by_ac2 + by_bc2)) continue;
    const Vector n = ab.cross(ac);
    normals[a] += by_ac2 * (by_ab2 * n);
    normals[b] += by_bc2 * (by_ab2 * n);
    normals[c] += by_bc2 * (by_ac2 * n);
  }
  for (Vector& n : normals) {
    control.check(++steps);
    n = unit_or_zero(n);
  }
  return normals;
}

// 1 for each vertex whose faces do not close a cycle around it with consistent orientation: the vertices of borders, of
// edges with three or more faces or of inconsistently oriented faces; 0 for the vertices inside, and for those without
// a face.
inline std::vector<std::uint8_t> border_flags(const Flat_mesh& mesh)
{
  // In a closed cycle every neighbour is the next corner of one face and the previous corner of another. The sum of
  // bits(next) - bits(previous) is then 0. For a single open fan it never is, as `bits` is a bijection (splitmix64);
  // for several fans at one vertex it is with probability 2^-64.
  const auto bits = [](std::int32_t i) {
    std::uint64_t x = (std::uint64_t(i) + 1) * 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
  };
  std::vector<std::uint64_t> sums(mesh.points.size(), 0);
  for (const auto& f : mesh.faces) {
    const std::uint64_t a = bits(f[0]), b = bits(f[1]), c = bits(f[2]);
    sums[std::size_t(f[0])] += b - c;
    sums[std::size_t(f[1])] += c - a;
    sums[std::size_t(f[2])] += a - b;
  }
  std::vector<std::uint8_t> flags(sums.size());
  for (std::size_t i = 0; i < sums.size(); ++i) flags[i] = std::uint8_t(sums[i] != 0);
  return flags;
}

// The lists of a ragged table in one array: list i is items[offsets[i]] .. items[offsets[i + 1] - 1].
struct Index_lists
{
  std::vector<std::int64_t> offsets;
  std::vector<std::int32_t> items;

  const std::int32_t* begin(std::size_t i) const { return items.data() + offsets[i]; }
  const std::int32_t* end(std::size_t i) const { return items.data() + offsets[i + 1]; }
};

// The faces at each vertex, in the order of the faces.
inline Index_lists faces_of_vertices(const Flat_mesh& mesh)
{
  Index_lists lists;
  const std::size_t n = mesh.points.size();
  lists.offsets.assign(n + 2, 0);
  // Counted two places further on, so that filling leaves the offsets where they belong.
  for (const auto& f : mesh.faces)
    for (std::int32_t v : f) ++lists.offsets[std::size_t(v) + 2];
  for (std::size_t i = 2; i < n + 2; ++i) lists.offsets[i] += lists.offsets[i - 1];
  lists.items.resize(3 * mesh.faces.size());
  for (std::size_t i = 0; i < mesh.faces.size(); ++i)
    for (std::int32_t v : mesh.faces[i])
      lists.items[std::size_t(lists.offsets[std::size_t(v) + 1]++)] = std::int32_t(i);
  lists.offsets.pop_back();
  return lists;
}

// The vertices joined to each vertex by an edge, each once.
inline Index_lists neighbours_of_vertices(const Flat_mesh& mesh)
{
  const Index_lists faces = faces_of_vertices(mesh);
  Index_lists lists;
  const std::size_t n = mesh.points.size();
  lists.offsets.reserve(n + 1);
  lists.offsets.push_back(0);
  lists.items.reserve(3 * mesh.faces.size() + n / 4);
  std::vector<std::int32_t> seen_from(n, -1);
  for (std::size_t i = 0; i < n; ++i) {
    seen_from[i] = std::int32_t(i);
    for (const std::int32_t* f = faces.begin(i); f != faces.end(i); ++f)
      for (std::int32_t v : mesh.faces[std::size_t(*f)])
        if (seen_from[std::size_t(v)] != std::int32_t(i)) {
          seen_from[std::size_t(v)] = std::int32_t(i);
          lists.items.push_back(v);
        }
    lists.offsets.push_back(std::int64_t(lists.items.size()));
  }
  return lists;
}

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

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MESH_MESH_GEOMETRY_H
