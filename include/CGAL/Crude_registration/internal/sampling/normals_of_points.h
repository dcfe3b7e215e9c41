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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_NORMALS_OF_POINTS_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_NORMALS_OF_POINTS_H

// The planes that fit the neighbourhoods of points, at the scale at which they are a surface.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/internal/base/Run_control.h>
#include <CGAL/Crude_registration/internal/lookup/Point_grid.h>
#include <CGAL/Crude_registration/internal/sampling/Evened_points.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The plane that fits some points in the least squares sense.
class Plane_fit
{
public:
  void add(const Vector& d)
  {
    m_sum += d;
    m_xx += d[0] * d[0];
    m_xy += d[0] * d[1];
    m_xz += d[0] * d[2];
    m_yy += d[1] * d[1];
    m_yz += d[1] * d[2];
    m_zz += d[2] * d[2];
    ++m_count;
  }

  std::size_t count() const { return m_count; }
  const Vector& normal() const { return m_normal; }   // null where there is no plane
  const Vector& tangent() const { return m_tangent; } // perpendicular to it
  double least() const { return m_values[0]; }        // variances
  double middle() const { return m_values[1]; }
  double largest() const { return m_values[2]; }

  // The eigenvalues by the angle that solves the characteristic polynomial (Smith 1961), the eigenvectors by cross
  // products: ten times as fast as rotations, and exact enough for what noise leaves of a plane.
  void solve()
  {
    const double w = 1 / double(m_count);
    const Vector m = m_sum * w;
    Matrix a;
    a << m_xx * w - m[0] * m[0], m_xy * w - m[0] * m[1], m_xz * w - m[0] * m[2], //
        0, m_yy * w - m[1] * m[1], m_yz * w - m[1] * m[2],                       //
        0, 0, m_zz * w - m[2] * m[2];
    a(1, 0) = a(0, 1);
    a(2, 0) = a(0, 2);
    a(2, 1) = a(1, 2);
    const double q = a.trace() / 3;
    const double off = a(0, 1) * a(0, 1) + a(0, 2) * a(0, 2) + a(1, 2) * a(1, 2);
    const Vector d = a.diagonal().array() - q;
    const double p = std::sqrt((d.squaredNorm() + 2 * off) / 6);
    m_normal = m_tangent = Vector::Zero();
    m_values = {q, q, q};
    if (!(p > 0)) return;
    const double determinant = d[0] * (d[1] * d[2] - a(1, 2) * a(1, 2)) -
                               a(0, 1) * (a(0, 1) * d[2] - a(1, 2) * a(0, 2)) +
                               a(0, 2) * (a(0, 1) * a(1, 2) - d[1] * a(0, 2));
    const double r = (std::min)((std::max)(determinant / (2 * p * p * p), -1.), 1.);
    const double angle = std::acos(r) / 3;
    constexpr double third_of_a_turn = 2.0943951023931953; // 2 pi / 3
    m_values[2] = q + 2 * p * std::cos(angle);
    m_values[0] = (std::max)(q + 2 * p * std::cos(angle + third_of_a_turn), 0.);
    m_values[1] = (std::max)(3 * q - m_values[0] - m_values[2], 0.);
    m_normal = eigenvector(a, m_values[0]);
    const Vector along = eigenvector(a, m_values[2]);
    m_tangent = along - along.dot(m_normal) * m_normal;
    const double length = m_tangent.norm();
    if (length > 0.5) m_tangent /= length;
    else m_normal = Vector::Zero();
  }

private:
  static Vector eigenvector(const Matrix& a, double value)
  {
    const Matrix b = a - value * Matrix::Identity();
    const Vector r0 = b.row(0), r1 = b.row(1), r2 = b.row(2);
    const std::array<Vector, 3> products = {r0.cross(r1), r1.cross(r2), r2.cross(r0)};
    std::size_t best = 0;
    for (std::size_t i = 1; i < 3; ++i)
      if (products[i].squaredNorm() > products[best].squaredNorm()) best = i;
    const double length = products[best].norm();
    return length > 0 ? Vector(products[best] / length) : Vector(Vector::Zero());
  }

  Vector m_sum = Vector::Zero(), m_normal = Vector::Zero(), m_tangent = Vector::Zero();
  double m_xx = 0, m_xy = 0, m_xz = 0, m_yy = 0, m_yz = 0, m_zz = 0;
  std::size_t m_count = 0;
  std::array<double, 3> m_values{};
};

// The normals, of either sign, of evened points.
class Normals_of_points
{
public:
  // \throws Run_control::Stopped
  Normals_of_points(const Evened_points& points, Run_control& control) : m_points(points)
  {
    const std::vector<Vector>& finest = points.level(0).points;
    normals.assign(finest.size(), Vector::Zero());
    scales.assign(finest.size(), 0);
    for (std::size_t i = 0; i < finest.size(); ++i) {
      control.check(i);
      find(i, control);
    }
  }

  // Within so many spacings a sample's neighbourhood is looked for: of even samples it holds some fifteen (pi 2.2^2).
  static constexpr double reach = 2.2;

  double radius(std::size_t scale) const { return std::ldexp(reach * m_points.spacing(), int(scale)); }

  std::vector<Vector> normals;      // null where there is no surface
  std::vector<std::uint8_t> scales; // the level at which it was found

private:
  // How far a neighbourhood may be from a plane, as the ratio of variances, across it over along it. A disc has a
  // quarter of its squared radius along it: noise of a sixth of the radius makes up 0.12; a right angle has 0.28.
  static constexpr double flat = 0.12, flattest_fold = 0.5;
  static constexpr std::size_t number_of_scales = 4;

  // Tries scale by scale. Where none is flat (a fold), the flattest counts, of those the finest.
  void find(std::size_t i, Run_control& control)
  {
    const Vector& p = m_points.level(0).points[i];
    double best = flattest_fold;
    for (std::size_t scale = 0; scale < number_of_scales; ++scale) {
      const Plane_fit fit = fitted(p, scale, control);
      if (fit.normal().isZero(0)) continue;
      const double flatness = fit.least() / fit.middle();
      if (!(flatness < 0.8 * best) && !(flatness <= flat)) continue;
      best = flatness;
      normals[i] = fit.normal();
      scales[i] = std::uint8_t(scale);
      if (flatness <= flat) return;
    }
  }

  // No normal where the points around are too few, or do not surround the place: where they are a line, or two that
  // meet, which a plane fits, too.
  Plane_fit fitted(const Vector& p, std::size_t scale, Run_control& control)
  {
    const std::vector<Vector>& points = m_points.level(scale).points;
    if (!m_grids[scale]) {
      control.check();
      m_grids[scale].emplace(points, radius(scale));
      control.check();
    }
    Plane_fit fit;
    const std::size_t n = m_grids[scale]->differences_within(p, radius(scale), m_around);
    constexpr std::size_t fewest = 5;
    constexpr double thinnest = 0.08; // a half disc has 0.28, two lines at a radius's distance more
    if (n < fewest) return Plane_fit();
    for (std::size_t i = 0; i < n; ++i) fit.add(m_around[i]);
    fit.solve();
    if (!(fit.middle() > thinnest * fit.largest())) return Plane_fit();
    const Vector u = fit.tangent(), v = fit.normal().cross(u);
    const double inner = 0.3 * radius(scale);
    unsigned sectors = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double x = m_around[i].dot(u), y = m_around[i].dot(v);
      const unsigned sector = unsigned(x < 0) | unsigned(y < 0) << 1 | unsigned(std::abs(x) < std::abs(y)) << 2;
      sectors |= unsigned(!(x * x + y * y < inner * inner)) << sector;
    }
    unsigned count = 0;
    for (; sectors != 0; sectors &= sectors - 1) ++count;
    return count >= 3 ? fit : Plane_fit();
  }

  const Evened_points& m_points;
  std::array<std::optional<Point_grid>, number_of_scales> m_grids;
  std::vector<Vector> m_around;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_NORMALS_OF_POINTS_H
