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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_SIMULATION_MARCHING_TETRAHEDRA_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_SIMULATION_MARCHING_TETRAHEDRA_H

// The mesh of an implicit surface.

#include <CGAL/Crude_registration/internal/mesh/Flat_mesh.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The surface where `value` (a function of a point, positive inside) changes its sign, on a lattice of cubes of side
// `size` whose first corner is `origin`. Each cube is cut into the six tetrahedra around its diagonal, which agree
// between neighbouring cubes, so that the surface is a manifold; it is closed where `value` is not positive on the
// border of the lattice. Two layers of values are kept, not the whole lattice.
template <class Function>
Flat_mesh marching_tetrahedra(const Function& value, const Vector& origin, double size, std::array<int, 3> cubes)
{
  const std::size_t nx = static_cast<std::size_t>(cubes[0]) + 1, ny = static_cast<std::size_t>(cubes[1]) + 1;

  // Corners of a cube and directions of lattice edges are numbers from 0 to 7 whose bits are the steps in x, y and z.
  struct Layer
  {
    std::vector<double> values;
    std::vector<std::int32_t> vertices; // [corner][direction of the edge that starts there]
  };
  auto point = [&](int x, int y, int z) -> Vector { return origin + size * Vector(x, y, z); };
  auto fill = [&](Layer& layer, int z) {
    layer.values.resize(nx * ny);
    layer.vertices.assign(nx * ny * 8, -1);
    for (int y = 0; y <= cubes[1]; ++y)
      for (int x = 0; x <= cubes[0]; ++x)
        layer.values[static_cast<std::size_t>(y) * nx + static_cast<std::size_t>(x)] = value(point(x, y, z));
  };

  Flat_mesh mesh;
  std::array<Layer, 2> layers;
  fill(layers[1], 0);
  for (int z = 0; z < cubes[2]; ++z) {
    std::swap(layers[0], layers[1]);
    fill(layers[1], z + 1);
    for (int y = 0; y < cubes[1]; ++y)
      for (int x = 0; x < cubes[0]; ++x) {
        std::array<double, 8> values;
        auto at = [&](int corner) {
          return static_cast<std::size_t>(y + (corner >> 1 & 1)) * nx + static_cast<std::size_t>(x + (corner & 1));
        };
        auto layer = [&](int corner) -> Layer& { return layers[static_cast<std::size_t>(corner >> 2)]; };
        int number_inside = 0;
        for (int c = 0; c < 8; ++c) {
          const double v = layer(c).values[at(c)];
          values[static_cast<std::size_t>(c)] = v;
          number_inside += v > 0;
        }
        if (number_inside == 0 || number_inside == 8) continue;

        // The vertex on the edge between two corners, one inside and one outside; it is kept off the corners by a
        // hundredth of the edge, so that no face degenerates.
        auto vertex = [&](int a, int b) {
          const int from = (std::min)(a, b), to = (std::max)(a, b);
          std::int32_t& v = layer(from).vertices[at(from) * 8 + static_cast<std::size_t>(from ^ to)];
          if (v < 0) {
            const Vector p = point(x + (from & 1), y + (from >> 1 & 1), z + (from >> 2));
            const Vector q = point(x + (to & 1), y + (to >> 1 & 1), z + (to >> 2));
            double s = 0, t = 1, f = values[static_cast<std::size_t>(from)], g = values[static_cast<std::size_t>(to)];
            for (int step = 0; step < 2;
                 ++step) { // regula falsi: linear interpolation alone leaves a visible staircase
              const double r = std::clamp(s + (t - s) * f / (f - g), 0.01, 0.99), h = value(p + r * (q - p));
              if ((h > 0) == (f > 0)) s = r, f = h;
              else t = r, g = h;
            }
            v = static_cast<std::int32_t>(mesh.points.size());
            mesh.points.push_back(p + std::clamp(s + (t - s) * f / (f - g), 0.01, 0.99) * (q - p));
          }
          return v;
        };
        std::array<int, 3> steps{1, 2,
                                 4}; // one tetrahedron for each order of the three steps from corner 0 to corner 7
        do {
          const std::array<int, 4> corners{0, steps[0], steps[0] | steps[1], 7};
          // Inside corners first. The tetrahedron they then form is positively oriented if the steps and the reordering
          // have the same parity, and a face of a positive tetrahedron is oriented as written below.
          std::array<int, 4> c;
          std::size_t inside = 0, end = 0;
          for (int i : corners)
            if (values[static_cast<std::size_t>(i)] > 0) c[inside++] = i;
          end = inside;
          for (int i : corners)
            if (!(values[static_cast<std::size_t>(i)] > 0)) c[end++] = i;
          if (inside == 0 || inside == 4) continue;
          int inversions = (steps[0] > steps[1]) + (steps[0] > steps[2]) + (steps[1] > steps[2]);
          for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = i + 1; j < 4; ++j) inversions += c[i] > c[j]; // corners are in increasing order
          auto add = [&](std::int32_t u, std::int32_t v, std::int32_t w) {
            if (inversions % 2 == 0) mesh.faces.push_back({u, v, w});
            else mesh.faces.push_back({u, w, v});
          };
          if (inside == 1) add(vertex(c[0], c[1]), vertex(c[0], c[2]), vertex(c[0], c[3]));
          else if (inside == 3) add(vertex(c[0], c[3]), vertex(c[1], c[3]), vertex(c[2], c[3]));
          else {
            const std::int32_t v02 = vertex(c[0], c[2]), v03 = vertex(c[0], c[3]), v13 = vertex(c[1], c[3]),
                               v12 = vertex(c[1], c[2]);
            add(v02, v03, v13);
            add(v02, v13, v12);
          }
        } while (std::next_permutation(steps.begin(), steps.end()));
      }
  }
  return mesh;
}

// Keeps the connected part that has most faces.
inline Flat_mesh largest_component(const Flat_mesh& mesh)
{
  std::vector<std::int32_t> parent(mesh.points.size());
  for (std::size_t i = 0; i < parent.size(); ++i) parent[i] = static_cast<std::int32_t>(i);
  auto root = [&](std::int32_t i) {
    auto up = [&](std::int32_t j) -> std::int32_t& { return parent[static_cast<std::size_t>(j)]; };
    while (up(i) != i) i = up(i) = up(up(i));
    return i;
  };
  for (const auto& f : mesh.faces)
    for (std::size_t i = 1; i < 3; ++i) parent[static_cast<std::size_t>(root(f[i]))] = root(f[0]);

  std::vector<std::size_t> faces(parent.size(), 0);
  for (const auto& f : mesh.faces) ++faces[static_cast<std::size_t>(root(f[0]))];
  const auto largest = static_cast<std::int32_t>(std::max_element(faces.begin(), faces.end()) - faces.begin());

  Flat_mesh part;
  std::vector<std::int32_t> index(parent.size(), -1);
  for (const auto& f : mesh.faces) {
    if (root(f[0]) != largest) continue;
    std::array<std::int32_t, 3> face;
    for (std::size_t i = 0; i < 3; ++i) {
      std::int32_t& v = index[static_cast<std::size_t>(f[i])];
      if (v < 0) {
        v = static_cast<std::int32_t>(part.points.size());
        part.points.push_back(mesh.points[static_cast<std::size_t>(f[i])]);
      }
      face[i] = v;
    }
    part.faces.push_back(face);
  }
  return part;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_SIMULATION_MARCHING_TETRAHEDRA_H
