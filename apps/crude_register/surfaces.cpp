// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "surfaces.h"

#include <CGAL/Crude_registration/compare_points.h>
#include <CGAL/Crude_registration/sampling/triangulate_range_image.h>

namespace {

// The normals of the surface that was registered, at points of the scan's file.
std::vector<Direction> normals_at(const std::vector<Point>& points, const CR::Scan<Kernel>& scan)
{
  std::vector<Direction> normals;
  normals.reserve(points.size());
  for (const auto& met : CR::compare_points(points, scan, scan, Transformation(CGAL::IDENTITY)))
    normals.push_back(met.normal);
  return normals;
}

} // namespace

std::vector<Point> points_of(const Scan_file& file)
{
  switch (file.kind) {
  case Scan_file::RANGE_IMAGE:
    return file.image.points();
  case Scan_file::MESH:
    return std::vector<Point>(file.mesh.points().begin(), file.mesh.points().end());
  case Scan_file::POINTS:
    break;
  }
  return file.points;
}

Surface surface_to_show(const Scan_file& file, const CR::Scan<Kernel>* scan)
{
  Surface surface;
  if (file.kind == Scan_file::POINTS) {
    surface.points = file.points;
    if (scan != nullptr) {
      surface.normals = normals_at(surface.points, *scan);
      surface.spacing = scan->spacing();
    }
  } else if (file.kind == Scan_file::RANGE_IMAGE) {
    CR::triangulate_range_image(file.image, surface.points, surface.triangles);
  } else {
    const Mesh& mesh = file.mesh;
    surface.points.assign(mesh.points().begin(), mesh.points().end());
    std::vector<std::size_t> corners;
    for (const auto f : mesh.faces()) {
      corners.clear();
      for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) corners.push_back(std::size_t(v));
      for (std::size_t k = 2; k < corners.size(); ++k)
        surface.triangles.push_back({corners[0], corners[k - 1], corners[k]});
    }
  }
  return surface;
}
