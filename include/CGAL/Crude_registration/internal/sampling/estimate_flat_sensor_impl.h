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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_ESTIMATE_FLAT_SENSOR_IMPL_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_ESTIMATE_FLAT_SENSOR_IMPL_H

// The sensor of a range image, found from its grid.

#include <CGAL/Crude_registration/internal/sampling/estimate_flat_sensor.h>
#include <CGAL/Crude_registration/internal/base/Run_control.h>
#include <CGAL/Crude_registration/internal/base/symmetric_eigen.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Recovers the sensor from the grid: the columns and rows of a range image are what its sensor measured, so that
// (column, row) is a function of the point alone, and the lines on which that function is constant are the lines of
// sight. Noise along a line of sight, the largest part of a scanner's noise, changes nothing in it.
//
// Three functions are fitted, by linear least squares, to points X = (x, y, z, 1):
//   parallel    column = a.X, row = b.X                            an orthographic sensor;
//   central     column = p.X / r.X, row = q.X / r.X                a camera (direct linear transformation; Hartley and
//               Zisserman, Multiple View Geometry, 2nd ed., 7.1), whose centre has p.X = q.X = r.X = 0;
//   pencil      column = p.X / r.X alone, and row alone            the planes of equal column meet in a line: a laser
//               stripe that is moved along and seen by a camera is parallel in one axis and a pencil in the other.
class Sensor_estimation
{
  using Vector_4 = Eigen::Vector4d;
  using Matrix_4 = Eigen::Matrix4d;

public:
  explicit Sensor_estimation(const Flat_range_image& image, Run_control& control = to_the_end())
      : m_image(image), m_control(control)
  {}

  // \throws Run_control::Stopped
  Flat_sensor operator()()
  {
    if (!normalise()) return Flat_sensor();
    accumulate();
    fit_parallel();
    fit_pencil(0);
    fit_pencil(1);
    fit_central();
    measure_residuals();
    if (is_central()) return central_sensor();
    return parallel_sensor();
  }

private:
  // One coordinate of the grid, axis 0 the column and 1 the row, as a function of X; values in normalised units.
  struct Axis
  {
    Vector_4 sum = Vector_4::Zero();       // sum of w X
    Matrix_4 first = Matrix_4::Zero();     // sum of w X X^T
    Matrix_4 second = Matrix_4::Zero();    // sum of w^2 X X^T
    Vector_4 parallel = Vector_4::Zero();  // w = parallel.X
    Vector_4 numerator = Vector_4::Zero(); // w = numerator.X / denominator.X, denominator 1 at the centroid
    Vector_4 denominator = Vector_4::Zero();
    bool has_pencil = false;
    double parallel_residual = 0, pencil_residual = 0; // root mean square
    double deviation = 0;                              // of w itself

    // Is the pencil the better explanation? Nested models: it always fits better, so it has to be by half, and the
    // parallel model off by more than a 50th of a cell.
    bool is_pencil(double cell) const
    {
      return has_pencil && parallel_residual > 0.02 * cell && pencil_residual < 0.5 * parallel_residual;
    }
  };

  template <class Visitor>
  void for_each_sample(Visitor visitor) const
  {
    const std::int32_t* cell = m_image.grid;
    for (std::size_t row = 0; row < m_image.rows; ++row) {
      m_control.check();
      for (std::size_t column = 0; column < m_image.columns; ++column, ++cell)
        if (*cell >= 0) visitor(static_cast<double>(column), static_cast<double>(row), m_image.point(*cell));
    }
  }

  // Points are centred and scaled to a root mean square distance of 1 from the centroid, columns and rows together
  // likewise (Hartley, In defense of the eight-point algorithm, 1997): no unit and no frame has any influence.
  bool normalise()
  {
    std::size_t count = 0;
    double column_sum = 0, row_sum = 0;
    Vector point_sum = Vector::Zero(), first = Vector::Zero();
    for_each_sample([&](double column, double row, const Vector& p) {
      if (count == 0) first = p;
      point_sum += p - first; // from a sample of the scan: precise far from the origin, too
      column_sum += column;
      row_sum += row;
      ++count;
    });
    if (count < 24) return false; // twice the parameters of the central model
    m_count = static_cast<double>(count);
    m_origin = first + point_sum / m_count;
    m_mean = {column_sum / m_count, row_sum / m_count};
    double square = 0, column_square = 0, row_square = 0;
    for_each_sample([&](double column, double row, const Vector& p) {
      square += (p - m_origin).squaredNorm();
      column_square += (column - m_mean[0]) * (column - m_mean[0]);
      row_square += (row - m_mean[1]) * (row - m_mean[1]);
    });
    m_scale = std::sqrt(square / m_count);
    m_cells = std::sqrt((column_square + row_square) / m_count);
    if (!(m_scale > 0) || !std::isfinite(m_scale) || !(column_square > 0) || !(row_square > 0)) return false;
    m_axes[0].deviation = std::sqrt(column_square / m_count) / m_cells;
    m_axes[1].deviation = std::sqrt(row_square / m_count) / m_cells;
    return true;
  }

  Vector_4 homogeneous(const Vector& p) const
  {
    Vector_4 x;
    x << (p - m_origin) / m_scale, 1;
    return x;
  }

  void accumulate()
  {
    for_each_sample([&](double column, double row, const Vector& p) {
      const Vector_4 x = homogeneous(p);
      const Matrix_4 xx = x * x.transpose();
      m_moments += xx;
      const std::array<double, 2> w = {(column - m_mean[0]) / m_cells, (row - m_mean[1]) / m_cells};
      for (std::size_t i = 0; i < 2; ++i) {
        m_axes[i].sum += w[i] * x;
        m_axes[i].first += w[i] * xx;
        m_axes[i].second += w[i] * w[i] * xx;
      }
    });
    m_moments /= m_count;
    for (Axis& axis : m_axes) {
      axis.sum /= m_count;
      axis.first /= m_count;
      axis.second /= m_count;
    }
  }

  void fit_parallel()
  {
    // the coordinates are centred: the moments fall into the covariance of the points and 1
    const auto [values, vectors] = symmetric_eigen(m_moments.topLeftCorner<3, 3>());
    // what is flatter than the rounding of single precision says nothing about the third dimension
    m_is_flat = !(values[0] > 1e-13);
    if (m_is_flat) return;
    m_inverse_covariance = vectors * values.cwiseInverse().asDiagonal() * vectors.transpose();
    for (Axis& axis : m_axes) axis.parallel << m_inverse_covariance * axis.sum.head<3>(), axis.sum(3);
  }

  // The unit vector h for which h^T A h is smallest, and whether it is so by far. (Matrices of dynamic size, as of one
  // type they compile once.)
  static bool null_vector(const Eigen::MatrixXd& a, Eigen::VectorXd& h)
  {
    const auto [values, vectors] = symmetric_eigen(a);
    h = vectors.col(0);
    return values[1] > 1e-11 && values[0] < 0.01 * values[1];
  }

  // numerator.X - w denominator.X = 0
  void fit_pencil(std::size_t i)
  {
    Axis& axis = m_axes[i];
    Eigen::MatrixXd a(8, 8);
    a.topLeftCorner<4, 4>() = m_moments;
    a.topRightCorner<4, 4>() = a.bottomLeftCorner<4, 4>() = -axis.first;
    a.bottomRightCorner<4, 4>() = axis.second;
    Eigen::VectorXd h;
    axis.has_pencil = null_vector(a, h) && h(7) != 0;
    if (!axis.has_pencil) return;
    axis.numerator = h.head<4>() / h(7);
    axis.denominator = h.tail<4>() / h(7);
  }

  void fit_central()
  {
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(12, 12);
    for (Eigen::Index i = 0; i < 2; ++i) {
      a.block<4, 4>(4 * i, 4 * i) = m_moments;
      a.block<4, 4>(4 * i, 8) = a.block<4, 4>(8, 4 * i) = -m_axes[static_cast<std::size_t>(i)].first;
      a.block<4, 4>(8, 8) += m_axes[static_cast<std::size_t>(i)].second;
    }
    Eigen::VectorXd h;
    m_has_central = null_vector(a, h) && h(11) != 0;
    if (!m_has_central) return;
    for (Eigen::Index i = 0; i < 3; ++i) m_central.row(i) = h.segment<4>(4 * i).transpose() / h(11);
  }

  // root mean squares; a denominator that changes its sign within the scan has no meaning as a distance from a sensor
  void measure_residuals()
  {
    std::array<double, 2> parallel = {0, 0}, pencil = {0, 0};
    double central = 0;
    for_each_sample([&](double column, double row, const Vector& p) {
      const Vector_4 x = homogeneous(p);
      const std::array<double, 2> w = {(column - m_mean[0]) / m_cells, (row - m_mean[1]) / m_cells};
      for (std::size_t i = 0; i < 2; ++i) {
        Axis& axis = m_axes[i];
        const double parallel_error = axis.parallel.dot(x) - w[i];
        parallel[i] += parallel_error * parallel_error;
        if (!axis.has_pencil) continue;
        const double denominator = axis.denominator.dot(x);
        if (!(denominator > 0)) axis.has_pencil = false;
        const double pencil_error = axis.numerator.dot(x) / denominator - w[i];
        pencil[i] += pencil_error * pencil_error;
      }
      if (m_has_central) {
        const Vector y = m_central * x;
        if (!(y.z() > 0)) m_has_central = false;
        const double column_error = y.x() / y.z() - w[0], row_error = y.y() / y.z() - w[1];
        central += column_error * column_error + row_error * row_error;
      }
    });
    for (std::size_t i = 0; i < 2; ++i) {
      m_axes[i].parallel_residual = std::sqrt(parallel[i] / m_count);
      m_axes[i].pencil_residual = std::sqrt(pencil[i] / m_count);
    }
    m_central_residual = std::sqrt(central / m_count);
  }

  // A camera explains the grid if it leaves half of what parallel lines leave, and hardly more than columns and rows
  // leave that converge each on a line of its own; and if what it leaves is small at all.
  bool is_central() const
  {
    if (!m_has_central) return false;
    const double cell = 1 / m_cells;
    const double parallel = m_is_flat ? 1 : std::hypot(m_axes[0].parallel_residual, m_axes[1].parallel_residual);
    double pencils = 0;
    for (const Axis& axis : m_axes) pencils = std::hypot(pencils, axis.has_pencil ? axis.pencil_residual : 1);
    return parallel > 0.02 * cell && m_central_residual < 0.5 * parallel &&
           m_central_residual < 1.25 * pencils + 0.02 * cell && m_central_residual < 0.1;
  }

  Flat_sensor central_sensor() const
  {
    const Vector centre = -m_central.leftCols<3>().inverse() * m_central.col(3);
    if (!centre.allFinite()) return Flat_sensor();
    return {Flat_sensor::PERSPECTIVE, m_origin + m_scale * centre};
  }

  // The lines of sight as parallels, in the direction they have at the centroid.
  Flat_sensor parallel_sensor() const
  {
    if (m_is_flat) return Flat_sensor();
    const double cell = 1 / m_cells;
    std::array<Vector, 2> gradients; // of column and row at the centroid
    double error = 0;                // length, in the image plane, that the model leaves unexplained
    for (std::size_t i = 0; i < 2; ++i) {
      const Axis& axis = m_axes[i];
      const bool is_pencil = axis.is_pencil(cell);
      const double residual = is_pencil ? axis.pencil_residual : axis.parallel_residual;
      gradients[i] = axis.parallel.head<3>();
      if (is_pencil) gradients[i] = axis.numerator.head<3>() - axis.numerator(3) * axis.denominator.head<3>();
      if (!(residual < 0.1 * axis.deviation)) return Flat_sensor(); // neither parallels nor pencils: not explained
      error = std::hypot(error, residual / gradients[i].norm());
    }
    Vector direction = gradients[0].cross(gradients[1]);
    direction /= direction.norm();
    // The depth that columns and rows leave free has to stand out well from what they leave unexplained: a flat scene
    // does not say from where it was seen.
    const double depth = 1 / std::sqrt(direction.dot(m_inverse_covariance * direction));
    if (!direction.allFinite() || !(error < 0.25 * depth)) return Flat_sensor();
    return {Flat_sensor::ORTHOGRAPHIC, is_towards_sensor(direction) ? Vector(-direction) : direction};
  }

  // Parallel lines of sight look the same from both ends. `direction` is columns x rows. In this order:
  // 1. where columns or rows form a pencil, its planes meet on the sensor's side;
  // 2. a surface turns away from the sensor where it ends in the image (at a silhouette, never at the frame);
  // 3. columns x rows points to the sensor, as in the files of Cyberware's scanners.
  bool is_towards_sensor(const Vector& direction) const
  {
    double convergence = 0;
    for (const Axis& axis : m_axes)
      if (axis.is_pencil(1 / m_cells)) convergence -= axis.denominator.head<3>().dot(direction);
    if (convergence != 0) return convergence > 0;
    std::size_t receding = 0, approaching = 0;
    count_silhouettes(direction, receding, approaching);
    if (receding + approaching >= 20 && 5 * (std::max)(receding, approaching) >= 3 * (receding + approaching))
      return receding > approaching;
    return true;
  }

  // At the ends of runs of samples along rows and columns: does the run recede along `direction` or approach?
  void count_silhouettes(const Vector& direction, std::size_t& receding, std::size_t& approaching) const
  {
    const auto count = [&](std::int32_t beyond, std::int32_t end, std::int32_t inner) {
      if (beyond >= 0 || end < 0 || inner < 0) return;
      const double step = direction.dot(m_image.point(end) - m_image.point(inner));
      if (step < 0) ++receding;
      if (step > 0) ++approaching;
    };
    for (std::size_t row = 0; row < m_image.rows; ++row) {
      m_control.check();
      for (std::size_t column = 0; column < m_image.columns; ++column) {
        const std::int32_t* cell = m_image.grid + row * m_image.columns + column;
        for (std::size_t axis = 0; axis < 2; ++axis) {
          const bool has_four = axis == 0 ? column + 3 < m_image.columns : row + 3 < m_image.rows;
          if (!has_four) continue;
          const std::size_t step = axis == 0 ? 1 : m_image.columns;
          if (cell[step] < 0 || cell[2 * step] < 0) continue;
          count(cell[0], cell[step], cell[2 * step]);
          count(cell[3 * step], cell[2 * step], cell[step]);
        }
      }
    }
  }

  const Flat_range_image& m_image;
  Run_control& m_control;
  double m_count = 0;
  Vector m_origin = Vector::Zero(); // normalised x = (p - origin) / scale
  double m_scale = 1;
  std::array<double, 2> m_mean = {0, 0}; // normalised w = (column or row - mean) / cells
  double m_cells = 1;
  Matrix_4 m_moments = Matrix_4::Zero();
  std::array<Axis, 2> m_axes;
  Matrix m_inverse_covariance = Matrix::Zero();
  Eigen::Matrix<double, 3, 4> m_central = Eigen::Matrix<double, 3, 4>::Zero();
  double m_central_residual = 0;
  bool m_is_flat = true;
  bool m_has_central = false;
};

CGAL_CRUDE_REGISTRATION_INLINE Flat_sensor estimated_sensor(const Flat_range_image& image, Run_control& control)
{
  return Sensor_estimation(image, control)();
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_ESTIMATE_FLAT_SENSOR_IMPL_H
