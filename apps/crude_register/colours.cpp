// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "colours.h"

#include "surfaces.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

Colours colours_at(const std::vector<Point>& points, const Scan_file& scan)
{
  if (scan.colors.empty()) return {};
  const std::vector<Point> known = points_of(scan);
  std::vector<std::size_t> order(known.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return known[i] < known[j]; });
  Colours colours;
  colours.reserve(points.size());
  for (const Point& p : points) {
    const auto at =
        std::lower_bound(order.begin(), order.end(), p, [&](std::size_t i, const Point& q) { return known[i] < q; });
    colours.push_back(at != order.end() && known[*at] == p ? scan.colors[*at] : CGAL::IO::white());
  }
  return colours;
}

void add_colours(const Scan_file& scan, Mesh& mesh)
{
  if (scan.colors.empty()) return;
  const Colours colours = colours_at(std::vector<Point>(mesh.points().begin(), mesh.points().end()), scan);
  auto map = mesh.add_property_map<Mesh::Vertex_index, CGAL::IO::Color>("v:color").first;
  for (const auto v : mesh.vertices()) map[v] = colours[std::size_t(v)];
}
