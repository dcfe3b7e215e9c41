// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_TEST_GENERATED_SURFACES_H
#define CGAL_CRUDE_REGISTRATION_TEST_GENERATED_SURFACES_H

// Triangle meshes of surfaces whose geometry is known, with vertices where nothing is regular about them.

#include <CGAL/Crude_registration/internal/mesh/Flat_mesh.h>

#include <Eigen/Geometry>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>

namespace generated {

using CGAL::Crude_registration::internal::Flat_mesh;
using CGAL::Crude_registration::internal::Matrix;
using CGAL::Crude_registration::internal::Rigid_motion;
using CGAL::Crude_registration::internal::Vector;

constexpr double pi = 3.14159265358979323846;

class Random
{
public:
  explicit Random(unsigned seed) : m_engine(seed) {}

  // In [-1, 1]. std::uniform_real_distribution differs between libraries.
  double symmetric() { return 2 * (double(m_engine() >> 8) / double(1 << 24)) - 1; }

  Vector vector() // in a cube
  {
    const double x = symmetric(), y = symmetric(), z = symmetric();
    return Vector(x, y, z);
  }

  Rigid_motion motion(double translation)
  {
    // One after the other: in one expression the order would be the compiler's.
    const Vector axis = (vector() + Vector(0.1, 0.2, 1.5)).normalized();
    Rigid_motion m;
    m.rotation = Eigen::AngleAxisd(pi * symmetric(), axis).toRotationMatrix();
    m.translation = translation * vector();
    return m;
  }

private:
  std::mt19937 m_engine;
};

// The surface (u, v) -> surface(u, v), u and v in [0, 1], as a grid of columns x rows cells whose inner vertices are
// jittered by up to `jitter` cells; a surface closed along u or v has its first column or row for its last one. Faces
// are counterclockwise seen from the side of d/du x d/dv.
template <class Surface>
Flat_mesh grid(int columns, int rows, const Surface& surface, double jitter = 0.25, bool closed_u = false,
               bool closed_v = false, unsigned seed = 1)
{
  Random random(seed);
  Flat_mesh mesh;
  const int width = closed_u ? columns : columns + 1, height = closed_v ? rows : rows + 1;
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i) {
      const double du = jitter * random.symmetric(), dv = jitter * random.symmetric();
      const bool inner_u = closed_u || (i > 0 && i < columns), inner_v = closed_v || (j > 0 && j < rows);
      mesh.points.push_back(surface((i + (inner_u ? du : 0)) / columns, (j + (inner_v ? dv : 0)) / rows));
    }
  const auto index = [&](int i, int j) { return std::int32_t((j % height) * width + i % width); };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const std::int32_t a = index(i, j), b = index(i + 1, j), c = index(i + 1, j + 1), d = index(i, j + 1);
      if ((i + j) % 2 == 0) {
        mesh.faces.push_back({a, b, c});
        mesh.faces.push_back({a, c, d});
      } else {
        mesh.faces.push_back({a, b, d});
        mesh.faces.push_back({b, c, d});
      }
    }
  return mesh;
}

// Radii R (to the middle of the tube) and r, normals outwards.
inline Flat_mesh torus(int columns, int rows, double R, double r, double jitter = 0.25)
{
  const auto surface = [=](double u, double v) {
    const double a = 2 * pi * u, b = 2 * pi * v;
    return Vector((R + r * std::cos(b)) * std::cos(a), (R + r * std::cos(b)) * std::sin(a), r * std::sin(b));
  };
  return grid(columns, rows, surface, jitter, true, true);
}

// A closed sphere around the origin, normals outwards: a cube's six faces, bulged; `n` cells along an edge.
inline Flat_mesh sphere(int n, double radius)
{
  Flat_mesh mesh = grid(
      4 * n, 2 * n,
      [=](double u, double v) {
        // Poles excluded: rings from one polar circle to the other.
        const double a = 2 * pi * u, b = (v - 0.5) * 0.9 * pi;
        return Vector(radius * std::cos(b) * std::cos(a), radius * std::cos(b) * std::sin(a), radius * std::sin(b));
      },
      0.25, true, false);
  const std::int32_t width = 4 * n, south = std::int32_t(mesh.points.size()), north = south + 1, last = 2 * n * width;
  mesh.points.push_back(Vector(0, 0, -radius));
  mesh.points.push_back(Vector(0, 0, radius));
  for (std::int32_t i = 0; i < width; ++i) {
    mesh.faces.push_back({south, (i + 1) % width, i});
    mesh.faces.push_back({north, last + i, last + (i + 1) % width});
  }
  return mesh;
}

// A smooth field of bumps over the square [0, size]^2, seen from above, with noise along z.
inline Flat_mesh bumps(int n, double size = 1, double noise = 0, unsigned seed = 7)
{
  Random random(seed);
  return grid(n, n, [&](double u, double v) {
    const double z = 0.06 * std::sin(11 * u + 3 * v) + 0.05 * std::sin(5 - 7 * v + 4 * u * u) +
                     0.15 * std::exp(-30 * ((u - 0.6) * (u - 0.6) + (v - 0.3) * (v - 0.3)));
    return Vector(size * u, size * v, size * z + noise * random.symmetric());
  });
}

inline Flat_mesh moved(Flat_mesh mesh, const Rigid_motion& motion, double scale = 1)
{
  for (Vector& p : mesh.points) p = motion(scale * p);
  return mesh;
}

// The same mesh with its vertices and faces in another order.
inline Flat_mesh shuffled(const Flat_mesh& mesh, unsigned seed)
{
  std::mt19937 engine(seed);
  std::vector<std::int32_t> order(mesh.points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = std::int32_t(i);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[engine() % i]);
  Flat_mesh result = mesh;
  for (std::size_t i = 0; i < order.size(); ++i) result.points[std::size_t(order[i])] = mesh.points[i];
  for (auto& f : result.faces)
    for (std::int32_t& v : f) v = order[std::size_t(v)];
  for (std::size_t i = result.faces.size(); i > 1; --i) std::swap(result.faces[i - 1], result.faces[engine() % i]);
  return result;
}

} // namespace generated

#endif // CGAL_CRUDE_REGISTRATION_TEST_GENERATED_SURFACES_H
