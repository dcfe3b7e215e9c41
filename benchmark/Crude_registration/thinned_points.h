// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_BENCHMARK_THINNED_POINTS_H
#define CGAL_CRUDE_REGISTRATION_BENCHMARK_THINNED_POINTS_H

// Thins points by voxels, as users do before they register: the mean of the points of each cube is left.

#include <CGAL/Bbox_3.h>
#include <CGAL/bounding_box.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace benchmark_tools {

// The diagonal of the box of points, of which there is at least one.
template <class Point>
double diagonal(const std::vector<Point>& points)
{
  const CGAL::Bbox_3 box = CGAL::bounding_box(points.begin(), points.end()).bbox();
  return std::hypot(box.x_span(), box.y_span(), box.z_span());
}

// The means of the points in the cubes of edge `edge` about the origin's corner, in the cubes' order.
template <class Point>
std::vector<Point> thinned_points(const std::vector<Point>& points, double edge)
{
  using Cube = std::array<double, 3>;
  std::map<Cube, std::pair<std::array<double, 3>, std::size_t>> cubes; // sums and numbers
  for (const Point& p : points) {
    auto& [sum, n] = cubes[{std::floor(p.x() / edge), std::floor(p.y() / edge), std::floor(p.z() / edge)}];
    sum[0] += p.x(), sum[1] += p.y(), sum[2] += p.z();
    ++n;
  }
  std::vector<Point> means;
  for (const auto& [cube, content] : cubes) {
    const auto& [sum, n] = content;
    means.emplace_back(sum[0] / double(n), sum[1] / double(n), sum[2] / double(n));
  }
  return means;
}

} // namespace benchmark_tools

#endif // CGAL_CRUDE_REGISTRATION_BENCHMARK_THINNED_POINTS_H
