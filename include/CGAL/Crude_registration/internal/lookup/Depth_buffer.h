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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_LOOKUP_DEPTH_BUFFER_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_LOOKUP_DEPTH_BUFFER_H

// What a sensor saw, as an image of depths: where in front of it there is nothing.

#include <CGAL/Crude_registration/internal/base/Flat_sensor.h>
#include <CGAL/Crude_registration/internal/base/Rows.h>
#include <CGAL/Crude_registration/internal/base/Run_control.h>
#include <CGAL/Crude_registration/internal/lookup/Surfel_field.h>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Free space: a range scan also says where there is nothing, as every sample lies at the end of a line of sight that
// was empty before it. The lines of sight in cells, each with the least depth of the samples in its 3 x 3
// neighbourhood, so that neither noise nor a slanted surface nor a depth edge makes up a violation.
class Depth_buffer
{
public:
  Depth_buffer() = default;

  // `direction`: unit, from the sensor into the scene; for a perspective sensor at `viewpoint` its mean direction.
  // `cell`: the edge length of a cell, for a perspective sensor at the mean range.
  // \throws Run_control::Stopped
  Depth_buffer(Flat_sensor::Kind kind, const Vector_f& viewpoint, const Vector_f& direction,
               const std::vector<Vector_f>& samples, float cell, Run_control& control = to_the_end())
      : m_kind(samples.empty() ? Flat_sensor::UNKNOWN : kind)
  {
    m_viewpoint = viewpoint;
    if (m_kind == Flat_sensor::UNKNOWN) return;
    const Vector_f u = direction.unitOrthogonal();
    m_axes.row(0) = u;
    m_axes.row(1) = direction.cross(u);
    m_axes.row(2) = direction;

    std::vector<Vector_f> projected; // x, y, depth
    projected.reserve(samples.size());
    double sum = 0;
    std::size_t steps = 0;
    for (const Vector_f& p : samples) {
      control.check(++steps);
      const Vector_f q = project(p);
      if (!q.allFinite()) continue;
      projected.push_back(q);
      sum += double(q[2]);
    }
    if (projected.empty()) {
      m_kind = Flat_sensor::UNKNOWN;
      return;
    }
    if (m_kind == Flat_sensor::PERSPECTIVE) cell /= float(sum / double(projected.size()));
    Vector_f low = projected.front(), high = low;
    for (const Vector_f& q : projected) {
      low = low.cwiseMin(q);
      high = high.cwiseMax(q);
    }
    constexpr float most = 4096; // cells a side
    cell = (std::max)(cell, (std::max)(high[0] - low[0], high[1] - low[1]) / most);
    m_scale = 1 / cell;
    m_low_x = low[0] - 2 * cell;
    m_low_y = low[1] - 2 * cell;
    m_columns = int((high[0] - m_low_x) * m_scale) + 3;
    m_rows = int((high[1] - m_low_y) * m_scale) + 3;
    constexpr float far = (std::numeric_limits<float>::max)();
    std::vector<float> nearest(std::size_t(m_columns) * std::size_t(m_rows), far);
    for (const Vector_f& q : projected) {
      control.check(++steps);
      float& d = nearest[std::size_t(int((q[0] - m_low_x) * m_scale)) * std::size_t(m_rows) +
                         std::size_t(int((q[1] - m_low_y) * m_scale))];
      d = (std::min)(d, q[2]);
    }
    // A cell at a hole or at the border of what was seen knows nothing.
    m_depths.assign(nearest.size(), -far);
    m_is_empty.assign(nearest.size(), 0);
    for (int i = 1; i + 1 < m_columns; ++i) {
      control.check();
      for (int j = 1; j + 1 < m_rows; ++j) {
        const std::size_t c = std::size_t(i) * std::size_t(m_rows) + std::size_t(j);
        int filled = 0;
        float least = far;
        for (int di = -1; di <= 1; ++di)
          for (int dj = -1; dj <= 1; ++dj) {
            const float d = nearest[std::size_t(i + di) * std::size_t(m_rows) + std::size_t(j + dj)];
            filled += d < far;
            least = (std::min)(least, d);
          }
        if (nearest[c] < far && filled >= 7) m_depths[c] = least;
        // Two cells around what was seen are there for the sake of the border; the sensor need not have looked there.
        m_is_empty[c] = filled == 0 && i > 2 && j > 2 && i + 3 < m_columns && j + 3 < m_rows;
      }
    }
  }

  bool is_known() const { return m_kind != Flat_sensor::UNKNOWN; }

  // How far `p` is in front of the surface that was seen behind it, along the line of sight; negative, or not a number,
  // where it is behind the surface or nothing is known.
  float in_front(const Vector_f& p) const
  {
    const Vector_f q = project(p);
    return m_depths[cell(q)] - q[2];
  }

  // The same for a row of places.
  Row in_front(const Rows& places) const
  {
    Rows q = places;
    for (std::size_t i = 0; i < 3; ++i) q[i] -= m_viewpoint[Eigen::Index(i)];
    q = rotated(m_axes, q);
    if (m_kind == Flat_sensor::PERSPECTIVE) {
      const Row r = root(Row(q[0] * q[0] + (q[1] * q[1] + q[2] * q[2]))), sum = r + q[2], f = root(Row(2 / (r * sum)));
      constexpr float nowhere = (std::numeric_limits<float>::quiet_NaN)();
      q = {(sum > 1e-3f * r).select(q[0] * f, nowhere), (sum > 1e-3f * r).select(q[1] * f, nowhere), r};
    }
    const Index_row i = clamped((q[0] - m_low_x) * m_scale, float(m_columns - 1)),
                    j = clamped((q[1] - m_low_y) * m_scale, float(m_rows - 1));
    Row depths;
    for (int k = 0; k < row_size; ++k)
      depths[k] = m_depths[std::size_t(i[k]) * std::size_t(m_rows) + std::size_t(j[k])];
    return depths - q[2];
  }

  // Whether `p` would have been seen at a place of the image where nothing was: no sample in its cell nor in those
  // around it.
  bool is_empty(const Vector_f& p) const { return m_is_empty[cell(project(p))] != 0; }

  // The direction of the line of sight through p, of any length.
  Vector_f sight(const Vector_f& p) const
  {
    return m_kind == Flat_sensor::PERSPECTIVE ? Vector_f(p - m_viewpoint) : Vector_f(m_axes.row(2));
  }

  // That of the samples in another unit of length. What a perspective sensor sees has angles across, and depths.
  void scale(float factor)
  {
    m_viewpoint *= factor;
    if (m_kind == Flat_sensor::ORTHOGRAPHIC) {
      m_low_x *= factor;
      m_low_y *= factor;
      m_scale /= factor;
    }
    for (float& depth : m_depths)
      if (std::abs(depth) < (std::numeric_limits<float>::max)()) depth *= factor;
  }

  // All that it consists of, `buffer` being it: f(part), for a writer and a reader.
  template <class Buffer, class Function>
  static void for_each_part(Buffer& buffer, const Function& f)
  {
    f(buffer.m_kind);
    f(buffer.m_viewpoint);
    f(buffer.m_axes);
    f(buffer.m_low_x);
    f(buffer.m_low_y);
    f(buffer.m_scale);
    f(buffer.m_columns);
    f(buffer.m_rows);
    f(buffer.m_is_empty);
    f(buffer.m_depths);
  }

  // Whether it can be looked into.
  bool is_consistent() const
  {
    const bool is_kind =
        m_kind == Flat_sensor::ORTHOGRAPHIC || m_kind == Flat_sensor::PERSPECTIVE || m_kind == Flat_sensor::UNKNOWN;
    return is_kind && m_columns > 0 && m_rows > 0 && std::size_t(m_columns) * std::size_t(m_rows) == m_depths.size() &&
           m_is_empty.size() == m_depths.size();
  }

private:
  // Image coordinates and depth; not numbers where there are none. Perspective: Lambert's azimuthal equal-area
  // projection about the mean direction, as it holds the whole sphere (but the point opposite) in one plane.
  Vector_f project(const Vector_f& p) const
  {
    Vector_f q = m_axes * (p - m_viewpoint);
    if (m_kind == Flat_sensor::PERSPECTIVE) {
      const float r = q.norm();
      if (!(r + q[2] > 1e-3f * r)) // at the viewpoint or opposite
        return Vector_f::Constant((std::numeric_limits<float>::quiet_NaN)());
      const float f = std::sqrt(2 / (r * (r + q[2])));
      q = Vector_f(q[0] * f, q[1] * f, r);
    }
    return q;
  }

  // The cell of a projected point: an outermost one for what is outside of the image, or not a number.
  std::size_t cell(const Vector_f& q) const
  {
    const auto coordinate = [&](float x, int cells) {
      return std::size_t((std::min)((std::max)(0.f, x * m_scale), float(cells - 1)));
    };
    return coordinate(q[0] - m_low_x, m_columns) * std::size_t(m_rows) + coordinate(q[1] - m_low_y, m_rows);
  }

  Flat_sensor::Kind m_kind = Flat_sensor::UNKNOWN;
  Vector_f m_viewpoint = Vector_f::Zero();
  Matrix_f m_axes = Matrix_f::Identity();
  float m_low_x = 0, m_low_y = 0, m_scale = 1;
  // The outermost cells, at least one, know nothing.
  int m_columns = 1, m_rows = 1;
  std::vector<std::uint8_t> m_is_empty = {0};
  std::vector<float> m_depths = {-(std::numeric_limits<float>::max)()};
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_LOOKUP_DEPTH_BUFFER_H
