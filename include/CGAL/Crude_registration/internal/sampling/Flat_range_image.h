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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_FLAT_RANGE_IMAGE_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_FLAT_RANGE_IMAGE_H

// A range image as flat arrays, and how densely it was sampled.

#include <CGAL/Crude_registration/Sensor.h>
#include <CGAL/Crude_registration/internal/base/Flat_sensor.h>
#include <CGAL/Crude_registration/internal/base/Run_control.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The range image of a stage's inside. The grid is the image's own, which has to outlive this.
struct Flat_range_image
{
  std::size_t columns = 0, rows = 0;
  std::vector<Vector> points;
  const std::int32_t* grid = nullptr; // row by row; -1 where there is no sample
  Flat_sensor sensor;

  Flat_range_image(std::size_t number_of_columns, std::size_t number_of_rows, std::vector<Vector> samples,
                   const std::int32_t* cells)
      : columns(number_of_columns), rows(number_of_rows), points(std::move(samples)), grid(cells)
  {}

  template <class Range_image>
  explicit Flat_range_image(const Range_image& image)
      : columns(image.columns()), rows(image.rows()), grid(image.grid().data()), sensor(to_flat_sensor(image.sensor()))
  {
    points.reserve(image.points().size());
    for (const auto& p : image.points()) points.push_back(to_vector(p));
  }

  std::int32_t index(std::size_t column, std::size_t row) const { return grid[row * columns + column]; }
  const Vector& point(std::int32_t index) const { return points[static_cast<std::size_t>(index)]; }
};

// The middle value, the upper one of two; reorders. 0 for no values.
inline double median(std::vector<double>& values)
{
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// How densely a sensor sampled: `distance` is the sampling distance s, in the unit of the points; `angle` is, for a
// perspective sensor, the tangent of the angle between adjacent lines of sight: at range r the distance is angle * r.
struct Sampling
{
  double distance = 0;
  double angle = 0;
};

// The larger of the two medians, along rows and along columns, of the distances between adjacent samples, measured
// perpendicular to the line of sight: "the maximum distance between adjacent range points when we flatten the range
// image" (section 4), made robust. Distances 0 do not count. Without a sensor the distances are those in space.
// \throws Run_control::Stopped
inline Sampling sampling(const Flat_range_image& image, Run_control& control = to_the_end())
{
  const bool is_perspective = image.sensor.kind == Flat_sensor::PERSPECTIVE;
  const bool is_known = image.sensor.kind != Flat_sensor::UNKNOWN;
  std::array<double, 2> medians = {0, 0};
  std::vector<double> distances;
  distances.reserve(image.points.size());
  for (std::size_t axis = 0; axis < 2; ++axis) {
    distances.clear();
    const std::size_t step = axis == 0 ? 1 : image.columns;
    const std::size_t columns = axis == 0 && image.columns > 0 ? image.columns - 1 : image.columns;
    const std::size_t rows = axis == 1 && image.rows > 0 ? image.rows - 1 : image.rows;
    for (std::size_t row = 0; row < rows; ++row) {
      control.check();
      const std::int32_t* cell = image.grid + row * image.columns;
      for (std::size_t column = 0; column < columns; ++column, ++cell) {
        if (cell[0] < 0 || cell[step] < 0) continue;
        const Vector& p = image.point(cell[0]);
        Vector pq = image.point(cell[step]) - p;
        double range = 1;
        if (is_known) {
          Vector sight = image.sensor.towards(p);
          if (is_perspective) {
            range = sight.norm();
            if (!(range > 0)) continue;
            sight /= range;
          }
          pq -= sight * sight.dot(pq);
        }
        const double distance = pq.norm() / range;
        if (distance > 0) distances.push_back(distance);
      }
    }
    medians[axis] = median(distances);
    control.check();
  }
  Sampling s;
  s.distance = (std::max)(medians[0], medians[1]);
  if (is_perspective) {
    std::vector<double>& ranges = distances;
    ranges.clear();
    for (std::size_t cell = 0; cell < image.columns * image.rows; ++cell) {
      control.check(cell);
      if (image.grid[cell] >= 0) ranges.push_back((image.point(image.grid[cell]) - image.sensor.vector).norm());
    }
    s.angle = s.distance;
    s.distance *= median(ranges);
  }
  return s;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_FLAT_RANGE_IMAGE_H
