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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_SAMPLE_SURFACE_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_SAMPLE_SURFACE_H

// The surface of a mesh as samples with normals, whether its vertices are samples or the corners of large faces.

#include <CGAL/Crude_registration/internal/base/Counter_random.h>
#include <CGAL/Crude_registration/internal/base/Flat_sensor.h>
#include <CGAL/Crude_registration/internal/base/Run_control.h>
#include <CGAL/Crude_registration/internal/mesh/Flat_mesh.h>
#include <CGAL/Crude_registration/internal/mesh/mesh_geometry.h>
#include <CGAL/Crude_registration/internal/sampling/orient_points.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The surface as samples with unit normals, in the frame of the scan's own.
struct Oriented_samples
{
  std::vector<Vector_f> points;
  std::vector<Vector_f> normals;
};

// Numbers that a place alone gives, in cells, and another cell others. (Not by its last bits, which the unit of length
// changes.)
inline Counter_random random_of_place(const Vector& place)
{
  std::uint64_t seed = 0;
  for (int i = 0; i < 3; ++i) seed = Counter_random::mixed(seed ^ std::uint64_t(std::llround(place[i])));
  return Counter_random(seed);
}

// Points about `distance` apart in rows along the longest edge of a face, at least one. A face that is narrower has as
// many as its area asks for, anywhere on it: those of many side by side lie evenly, and rows would not.
inline void sample_face(const Flat_mesh& mesh, std::array<std::int32_t, 3> face, const Rigid_motion& own,
                        double distance, Oriented_samples& samples)
{
  const auto squared_length = [&](int i) {
    return (mesh.points[std::size_t(face[std::size_t((i + 1) % 3)])] - mesh.points[std::size_t(face[std::size_t(i)])])
        .squaredNorm();
  };
  // Of two sides that are as long but for rounding the first.
  constexpr double shorter = 1 - double(std::numeric_limits<float>::epsilon());
  int longest = 0;
  for (int i : {1, 2})
    if (shorter * squared_length(i) > squared_length(longest)) longest = i;
  std::rotate(face.begin(), face.begin() + longest, face.end());
  const Vector &a = mesh.points[std::size_t(face[0])], &b = mesh.points[std::size_t(face[1])],
               &c = mesh.points[std::size_t(face[2])];
  const Vector twice_area = area_vector(a, b, c), normal = unit_or_zero(twice_area);
  const double length = (b - a).norm();
  if (normal.isZero() || !(length > 0)) return;
  constexpr double most = 2000; // points in a row, rows
  const auto count = [&](double l) { return int(std::ceil((std::min)((std::max)(l / distance, 1.), most))); };
  const double width = twice_area.norm() / length;
  const auto add = [&](double up, double along) {
    samples.points.push_back(own(Vector(a + along * (b - a) + up * (c - a))).cast<float>());
    samples.normals.push_back((own.rotation * normal).cast<float>());
  };
  if (width < distance) {
    const int points = count(0.5 * width * length / distance);
    // Cells in a sample's distance, far larger than rounding: floats leave 15 bits below it, as it is some 2^-9 of the
    // size.
    constexpr double cells = 1024;
    const Counter_random random = random_of_place(own(Vector((a + b + c) / 3)) * (cells / distance));
    const double first = random.uniform(0);
    for (int j = 0; j < points; ++j) {
      const double root = std::sqrt((j + first) / points); // evenly over the triangle
      add(1 - root, root * random.uniform(std::uint64_t(j) + 1));
    }
    return;
  }
  const int rows = count(width);
  for (int i = 0; i < rows; ++i) {
    const double up = (i + 0.5) / rows;
    const int points = count((1 - up) * length);
    for (int j = 0; j < points; ++j) add(up, (1 - up) * (j + 0.5) / points);
  }
}

// A face is as large as it is long: the right isosceles triangle of its longest side, which two faces of a grid are, or
// more. The vertices of slivers, which are small, tell their surface as little as those of large faces do.
inline double area_by_length(const Flat_mesh& mesh, const std::array<std::int32_t, 3>& face, double area)
{
  const Vector &a = mesh.points[std::size_t(face[0])], &b = mesh.points[std::size_t(face[1])],
               &c = mesh.points[std::size_t(face[2])];
  return (std::max)({area, (b - a).squaredNorm() / 4, (c - b).squaredNorm() / 4, (a - c).squaredNorm() / 4});
}

// Whether the faces are so large that their vertices do not tell the surface (a CAD model).
inline bool are_faces_large(const Flat_mesh& mesh, const std::vector<double>& areas)
{
  const double area = std::accumulate(areas.begin(), areas.end(), 0.);
  double area_of_large_faces = 0;
  for (std::size_t f = 0; f < areas.size(); ++f)
    if (area_by_length(mesh, mesh.faces[f], areas[f]) > area / 1000) area_of_large_faces += areas[f];
  return area_of_large_faces > 0.2 * area;
}

// The vertices of the faces, as a scan's samples are; where the faces are large, points spread evenly over them, about
// `distance` from each other. Samples that are seen at a grazing angle lie on the faces that bridge a depth edge: they
// are left out.
inline Oriented_samples samples_of_faces(const Flat_mesh& mesh, const std::vector<double>& areas,
                                         const Rigid_motion& own, const Flat_sensor& sensor, double distance,
                                         Run_control& control)
{
  Oriented_samples samples;
  const Matrix_f rotation = own.rotation.cast<float>();
  if (sensor.kind == Flat_sensor::UNKNOWN && are_faces_large(mesh, areas)) {
    for (const auto& f : mesh.faces) {
      control.check();
      sample_face(mesh, f, own, distance, samples);
    }
    return samples;
  }
  const std::vector<Vector> normals = vertex_normals(mesh, control);
  samples.points.reserve(mesh.points.size());
  samples.normals.reserve(mesh.points.size());
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    control.check(i);
    if (normals[i].isZero()) continue;
    if (sensor.kind != Flat_sensor::UNKNOWN) {
      const Vector sight = sensor.towards(mesh.points[i]);
      if (-sight.dot(normals[i]) < grazing_cosine * sight.norm()) continue;
    }
    samples.points.push_back(own(mesh.points[i]).cast<float>());
    samples.normals.push_back(rotation * normals[i].cast<float>());
  }
  return samples;
}

// The points as samples in the frame of the scan's own.
inline Oriented_samples samples_of_points(const Oriented_points& given, const Rigid_motion& own, Run_control& control)
{
  Oriented_samples samples;
  samples.points.reserve(given.points.size());
  samples.normals.reserve(given.points.size());
  for (std::size_t i = 0; i < given.points.size(); ++i) {
    control.check(i);
    samples.points.push_back(own(given.points[i]).cast<float>());
    samples.normals.push_back((own.rotation * given.normals[i]).cast<float>());
  }
  return samples;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_SAMPLE_SURFACE_H
