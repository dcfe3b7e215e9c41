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

#ifndef CGAL_CRUDE_REGISTRATION_RANGE_IMAGE_H
#define CGAL_CRUDE_REGISTRATION_RANGE_IMAGE_H

// A grid of samples, and the sensor that took them.

#include <CGAL/Crude_registration/Sensor.h>

#include <CGAL/assertions.h>
#include <CGAL/number_utils.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {

/*!
\ingroup PkgCrudeRegistrationRef

\brief a range image: a grid of columns and rows whose cells hold one sample (a 3D point) or none, and the sensor that
saw them.

Columns and rows are in the order of the scanner; nothing is assumed about their handedness. The points are in any unit
and any frame, the sensor is in the frame of the points.

\tparam Kernel a model of `Kernel`
*/
template <class Kernel>
class Range_image
{
public:
  /// \name Types
  /// @{
  typedef typename Kernel::Point_3 Point_3;
  /// the index of a sample in `points()`, or `no_sample`
  typedef std::int32_t Index;
  /// @}

  /// the index in a cell that has no sample.
  static constexpr Index no_sample = -1;

  /// the image without columns and rows.
  Range_image() = default;

  /// an image without samples.
  /// \throws std::invalid_argument if the number of cells is above 2^31 - 1.
  Range_image(std::size_t columns, std::size_t rows) : m_columns(columns), m_rows(rows)
  {
    if (columns != 0 && rows > static_cast<std::size_t>((std::numeric_limits<Index>::max)()) / columns)
      throw std::invalid_argument("Range_image: columns times rows is above 2^31 - 1");
    m_grid.assign(columns * rows, no_sample);
  }

  /// an image with all its samples.
  /// \param columns the number of columns
  /// \param rows the number of rows
  /// \param points the samples, in any order
  /// \param grid the index of every cell's sample in `points`, or `no_sample`, row by row
  /// \throws std::invalid_argument if the size of `grid` is not `columns * rows`, an index is outside `points` or in
  ///         two cells, or a coordinate is NaN or infinite.
  Range_image(std::size_t columns, std::size_t rows, std::vector<Point_3> points, std::vector<Index> grid)
      : m_columns(columns), m_rows(rows), m_points(std::move(points)), m_grid(std::move(grid))
  {
    if (columns == 0 || rows == 0 ? !m_grid.empty() : m_grid.size() / columns != rows || m_grid.size() % columns != 0)
      throw std::invalid_argument("Range_image: the size of grid is not columns times rows");
    if (m_grid.size() > static_cast<std::size_t>((std::numeric_limits<Index>::max)()))
      throw std::invalid_argument("Range_image: columns times rows is above 2^31 - 1");
    for (const Point_3& p : m_points) check(p);
    std::vector<bool> used(m_points.size(), false);
    for (Index i : m_grid) {
      if (i == no_sample) continue;
      if (i < 0 || static_cast<std::size_t>(i) >= m_points.size())
        throw std::invalid_argument("Range_image: grid holds the index " + std::to_string(i) + ", but there are " +
                                    std::to_string(m_points.size()) + " points");
      if (used[static_cast<std::size_t>(i)])
        throw std::invalid_argument("Range_image: grid holds the index " + std::to_string(i) + " twice");
      used[static_cast<std::size_t>(i)] = true;
    }
  }

  /// \name Access
  /// @{
  std::size_t columns() const { return m_columns; }
  std::size_t rows() const { return m_rows; }

  /// the samples. A point that no cell refers to takes part in nothing.
  const std::vector<Point_3>& points() const { return m_points; }

  /// the indices of all cells, row by row.
  const std::vector<Index>& grid() const { return m_grid; }

  /// the index of the sample of a cell, or `no_sample`.
  /// \pre `column < columns()` and `row < rows()`
  Index index(std::size_t column, std::size_t row) const
  {
    CGAL_precondition(column < m_columns && row < m_rows);
    return m_grid[row * m_columns + column];
  }

  /// the sensor, in the frame of the points; unknown unless it was set.
  const Sensor<Kernel>& sensor() const { return m_sensor; }
  /// @}

  /// sets the sensor, given in the frame of the points.
  void set_sensor(const Sensor<Kernel>& sensor) { m_sensor = sensor; }

  /// gives a cell its sample, in place of the one it may have.
  /// \throws std::invalid_argument if the cell is outside the grid or a coordinate is not finite or above 1e75.
  void set_sample(std::size_t column, std::size_t row, const Point_3& p)
  {
    if (column >= m_columns || row >= m_rows) throw std::invalid_argument("Range_image::set_sample: no such cell");
    check(p);
    Index& i = m_grid[row * m_columns + column];
    if (i == no_sample) {
      i = static_cast<Index>(m_points.size());
      m_points.push_back(p);
    } else {
      m_points[static_cast<std::size_t>(i)] = p;
    }
  }

private:
  template <class K>
  friend void transform(Range_image<K>& image, const typename K::Aff_transformation_3& motion);

  static void check(const Point_3& p)
  {
    const internal::Vector q = internal::to_vector(p);
    if (!q.allFinite()) throw std::invalid_argument("Range_image: a coordinate of points is NaN or infinite");
    if (q.cwiseAbs().maxCoeff() > internal::largest_coordinate)
      throw std::invalid_argument(
          "Range_image: a coordinate of points is above 1e75: another unit of length is needed");
  }

  std::size_t m_columns = 0;
  std::size_t m_rows = 0;
  std::vector<Point_3> m_points;
  std::vector<Index> m_grid;
  Sensor<Kernel> m_sensor;
};

/*!
\ingroup PkgCrudeRegistrationRef

\brief moves the samples of a range image and its sensor by `motion`, a rigid motion (not checked).
*/
template <class Kernel>
void transform(Range_image<Kernel>& image, const typename Kernel::Aff_transformation_3& motion)
{
  for (auto& p : image.m_points) p = p.transform(motion);
  image.m_sensor = image.m_sensor.transformed(motion);
}

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_RANGE_IMAGE_H
