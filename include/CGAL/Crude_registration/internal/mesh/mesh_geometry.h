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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MESH_MESH_GEOMETRY_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MESH_MESH_GEOMETRY_H

// Areas, normals, borders and neighbours of a flat mesh.

#include <CGAL/Crude_registration/internal/mesh/Flat_mesh.h>
#include <CGAL/Crude_registration/internal/base/Counter_random.h>
#include <CGAL/Crude_registration/internal/base/Flat_sensor.h>
#include <CGAL/Crude_registration/internal/base/Run_control.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
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

// Whether any face has an area.
inline bool has_area(const Flat_mesh& mesh)
{
  return std::any_of(mesh.faces.begin(), mesh.faces.end(),
                     [&](const auto& f) { return !area_vector(mesh, f).isZero(0); });
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
  // bits(next) - bits(previous) is then 0. For a single open fan it never is, as mixing is a bijection; for several
  // fans at one vertex it is with probability 2^-64.
  const auto bits = [](std::int32_t i) { return Counter_random::mixed(std::uint64_t(i)); };
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

// The median length of the edges, those inside counted twice. On the triangulation of a range image this is close to
// the larger of the distances along rows and columns.
inline double median_edge_length(const Flat_mesh& mesh)
{
  std::vector<double> lengths2;
  lengths2.reserve(3 * mesh.faces.size());
  for (const auto& f : mesh.faces)
    for (std::size_t k = 0; k < 3; ++k)
      lengths2.push_back((mesh.points[std::size_t(f[k])] - mesh.points[std::size_t(f[(k + 1) % 3])]).squaredNorm());
  if (lengths2.empty()) return 0;
  const auto middle = lengths2.begin() + std::ptrdiff_t(lengths2.size() / 2);
  std::nth_element(lengths2.begin(), middle, lengths2.end());
  return std::sqrt(*middle);
}

// The centre of the points' axis-parallel bounding box: an origin at which coordinates lose nothing to rounding.
inline Vector centre_of_box(const std::vector<Vector>& points)
{
  Vector low = Vector::Constant((std::numeric_limits<double>::max)()), high = -low;
  for (const Vector& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return points.empty() ? Vector(Vector::Zero()) : Vector(0.5 * low + 0.5 * high);
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MESH_MESH_GEOMETRY_H
