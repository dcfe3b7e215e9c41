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

#ifndef CGAL_CRUDE_REGISTRATION_IO_INTERNAL_TO_KERNEL_H
#define CGAL_CRUDE_REGISTRATION_IO_INTERNAL_TO_KERNEL_H

// What a file holds, in the types of a kernel.

#include <CGAL/Crude_registration/IO/IO_error.h>
#include <CGAL/Crude_registration/IO/internal/read_flat_scan.h>
#include <CGAL/Crude_registration/Range_image.h>

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

template <class Kernel>
std::vector<typename Kernel::Point_3> to_points(const std::vector<Vector>& vectors)
{
  std::vector<typename Kernel::Point_3> points;
  points.reserve(vectors.size());
  for (const Vector& v : vectors) points.emplace_back(v.x(), v.y(), v.z());
  return points;
}

template <class Kernel>
std::vector<typename Kernel::Vector_3> to_kernel_vectors(const std::vector<Vector>& vectors)
{
  std::vector<typename Kernel::Vector_3> result;
  result.reserve(vectors.size());
  for (const Vector& v : vectors) result.emplace_back(v.x(), v.y(), v.z());
  return result;
}

// Faults of the contents are told as those of the file.
template <class Kernel>
Range_image<Kernel> to_range_image(Flat_scan_file&& scan, const std::string& file)
{
  try {
    Range_image<Kernel> image(scan.columns, scan.rows, to_points<Kernel>(scan.points), std::move(scan.grid));
    image.set_sensor(to_sensor<Kernel>(scan.sensor));
    return image;
  } catch (const std::invalid_argument& e) {
    throw IO_error(file, e.what());
  }
}

// Adds a mesh to what a CGAL::Surface_mesh holds.
template <class Mesh>
void add_polygons(const Flat_scan_file& scan, Mesh& mesh)
{
  std::vector<typename Mesh::Vertex_index> vertices;
  vertices.reserve(scan.points.size());
  for (const Vector& p : scan.points) vertices.push_back(mesh.add_vertex(typename Mesh::Point(p.x(), p.y(), p.z())));
  std::vector<typename Mesh::Vertex_index> corners;
  for (const auto& polygon : scan.polygons) {
    corners.clear();
    for (const std::size_t i : polygon) corners.push_back(vertices[i]);
    mesh.add_face(corners);
  }
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_INTERNAL_TO_KERNEL_H
