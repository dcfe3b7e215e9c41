// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CRUDE_REGISTER_SURFACES_H
#define CRUDE_REGISTER_SURFACES_H

// Scans as they are shown: points with normals, and triangles where the file has them.

#include "files.h"
#include "options.h"

#include <CGAL/Crude_registration/Scan.h>
#include <CGAL/Crude_registration/sampling/triangulate_range_image.h>

#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/Search_traits_adapter.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

using Direction = Kernel::Vector_3;

struct Colour
{
  int red, green, blue;
};

// Colours that are told apart by people who do not tell red from green, too (from blue to orange first), in turn.
inline Colour colour_of_scan(std::size_t i)
{
  constexpr std::array<Colour, 8> colours = {Colour{230, 145, 40}, {60, 130, 200},  {70, 170, 120}, {200, 90, 150},
                                             {215, 200, 60},       {110, 190, 225}, {200, 80, 40},  {130, 110, 190}};
  return colours[i % colours.size()];
}

// What is shown of a scan.
struct Surface
{
  std::vector<Point> points;
  std::vector<Direction> normals; // of unit length, or null where none is known; as many
  std::vector<std::array<std::size_t, 3>> triangles;
  Colour colour = {128, 128, 128};
  double spacing = 0; // of the points, about
};

inline std::vector<Point> points_of(const Scan_file& file)
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

// The normals of the surface that was registered, at points of the scan's file: those of the nearest of its points.
inline std::vector<Direction> normals_at(const std::vector<Point>& points, const CR::Scan<Kernel>* scan)
{
  std::vector<Direction> normals(points.size(), CGAL::NULL_VECTOR);
  if (scan == nullptr) return normals;
  using Place = std::pair<Point, std::size_t>;
  using Traits =
      CGAL::Search_traits_adapter<Place, CGAL::First_of_pair_property_map<Place>, CGAL::Search_traits_3<Kernel>>;
  using Search = CGAL::Orthogonal_k_neighbor_search<Traits>;
  const std::vector<Point> places = scan->points();
  const std::vector<Direction> known = scan->normals();
  std::vector<Place> numbered;
  numbered.reserve(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) numbered.emplace_back(places[i], i);
  const Search::Tree tree(numbered.begin(), numbered.end());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Search search(tree, points[i], 1);
    if (search.begin() != search.end()) normals[i] = known[search.begin()->first.second];
  }
  return normals;
}

// All of a scan for a picture: with triangles, but where it is points alone.
inline Surface surface_to_show(const Scan_file& file, const CR::Scan<Kernel>* scan)
{
  Surface surface;
  if (file.kind == Scan_file::POINTS) {
    surface.points = file.points;
    surface.normals = normals_at(surface.points, scan);
    if (scan != nullptr) surface.spacing = scan->spacing();
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

inline void move(Surface& surface, const Transformation& motion)
{
  for (Point& p : surface.points) p = p.transform(motion);
  for (Direction& n : surface.normals) n = n.transform(motion);
}

#endif // CRUDE_REGISTER_SURFACES_H
