// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_EVALUATION_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_EVALUATION_H

#include <CGAL/Crude_registration/internal/Counter_random.h>
#include <CGAL/Crude_registration/internal/Matching_vertices.h>
#include <CGAL/Crude_registration/internal/Point_grid.h>
#include <CGAL/Crude_registration/internal/Prepared_scan.h>
#include <CGAL/Crude_registration/internal/point_to_plane.h>

#include <CGAL/tags.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// How a motion explains two scans.
struct Motion_score
{
  double agreeing = 0;  // share of the source's probes with a piece of the target's surface near that faces their way
  double violating = 0; // probes of either scan in the free space of the other, as a share of theirs, summed

  double value() const { return agreeing - 2 * violating; }
};

// Evaluates motions from the own frame of a prepared source scan to that of a prepared target scan. The overlap alone
// ranks wrong motions above the true one on most pairs of little overlap; what the lines of sight rule out and a closer
// look after refinement separate them.
class Motion_evaluation
{
public:
  // `s`, `d`: the vertices of the simplified meshes, in the own frames of the scans, all kept by reference; `spacing`:
  // the distance of neighbouring vertices.
  Motion_evaluation(const Prepared_scan& source, const Matching_vertices& s, const Prepared_scan& target,
                    const Matching_vertices& d, double spacing)
      : m_source(source), m_target(target), m_spacing(spacing), m_source_probes(probes(s)), m_target_probes(probes(d)),
        m_s(s), m_vertices{Point_grid(d.points, spacing), d}, m_surface{target.coarse}
  {
    for (std::size_t i = 0; i < s.points.size(); ++i) m_mean += s.points[i] / double(s.points.size());
    for (const Vector& p : s.points) m_covariance += (p - m_mean) * (p - m_mean).transpose() / double(s.points.size());
    const std::size_t stride = source.fine.surfels.size() / 1500 + 1;
    for (std::size_t i = 0; i < source.fine.surfels.size(); i += stride) {
      m_points.push_back(source.fine.surfels[i].position.cast<double>());
      m_normals.push_back(source.fine.surfels[i].normal.cast<double>());
    }
  }

  // A look at a crude motion by at most `count` vertices of each mesh.
  Motion_score coarse_score(const Rigid_motion& motion, std::size_t count) const
  {
    const auto spacing = float(m_spacing);
    return score(motion, m_source_probes, m_target_probes, count, m_target.coarse, 0.6f * spacing, 0.7f,
                 0.8f * spacing);
  }

  // A tight look at a refined motion by all the surface.
  Motion_score fine_score(const Rigid_motion& motion) const
  {
    const auto u = float((std::max)(m_source.spacing, m_target.spacing));
    return score(motion, m_source.fine.surfels, m_target.fine.surfels, std::size_t(-1), m_target.fine, 1.4f * u, 0.9f,
                 4 * u);
  }

  // A crude motion after some steps of fine registration.
  Rigid_motion refined(const Rigid_motion& motion) const
  {
    Refinement_options options;
    options.sampling_distance = (std::max)(m_source.spacing, m_target.spacing);
    options.reach = m_spacing;
    options.maximum_number_of_iterations = 8;
    return Point_to_plane<Sequential_tag, Surfels>(m_points, m_normals, m_surface, options)(motion).motion;
  }

  // A crude motion, estimated again from all vertices of S and D that agree under it: the nearest ones, where they are
  // no further apart than vertices are and face the same way. As the two meshes have their vertices at different places
  // of the surface, only the distances along the mean normals are made least.
  Rigid_motion reestimated(const Rigid_motion& motion) const
  {
    Refinement_options options;
    options.sampling_distance = m_spacing / 2;
    options.reach = m_spacing;
    options.maximum_number_of_iterations = 5;
    return Point_to_plane<Sequential_tag, Vertices>(m_s.points, m_s.normals, m_vertices, options)(motion).motion;
  }

  // The root mean square distance of the vertices of S under two motions.
  double distance(const Rigid_motion& a, const Rigid_motion& b) const
  {
    const Matrix difference = a.rotation - b.rotation;
    return std::sqrt((difference * m_mean + a.translation - b.translation).squaredNorm() +
                     (std::max)(0., (difference * m_covariance * difference.transpose()).trace()));
  }

private:
  struct Motion_f
  {
    explicit Motion_f(const Rigid_motion& m)
        : rotation(m.rotation.cast<float>()), translation(m.translation.cast<float>())
    {}
    Vector_f operator()(const Vector_f& p) const { return rotation * p + translation; }

    Matrix_f rotation;
    Vector_f translation;
  };

  // The surface of the target as the planes of its surfels.
  struct Surfels
  {
    const Surfel_level& level;

    bool closest(const Vector& query, double reach, Surface_point& answer) const
    {
      const int i = level.field.nearest(query.cast<float>());
      if (i < 0) return false;
      const Vector position = level.surfels[std::size_t(i)].position.cast<double>();
      answer.normal = level.surfels[std::size_t(i)].normal.cast<double>();
      const double height = answer.normal.dot(query - position);
      answer.point = query - height * answer.normal;
      answer.is_on_border = false;
      return std::abs(height) <= reach;
    }
  };

  // The vertices of the target's simplified mesh.
  struct Vertices
  {
    Point_grid grid;
    const Matching_vertices& vertices;

    bool closest(const Vector& query, double reach, Surface_point& answer) const
    {
      std::int32_t nearest = -1;
      double least = 0;
      grid.for_each_within(query, reach, [&](std::int32_t i, double d) {
        if (vertices.normals[std::size_t(i)].isZero(0) || (nearest >= 0 && d >= least)) return;
        least = d;
        nearest = i;
      });
      if (nearest < 0) return false;
      answer.point = vertices.points[std::size_t(nearest)];
      answer.normal = vertices.normals[std::size_t(nearest)];
      answer.is_on_border = false;
      return true;
    }
  };

  // The described vertices, any first ones of them spread over the mesh.
  static std::vector<Surfel> probes(const Matching_vertices& vertices)
  {
    std::vector<Surfel> result;
    for (std::size_t i = 0; i < vertices.points.size(); ++i) {
      if (vertices.normals[i].isZero(0)) continue;
      Surfel s;
      s.position = vertices.points[i].cast<float>();
      s.normal = vertices.normals[i].cast<float>();
      result.push_back(s);
    }
    const Counter_random random(0);
    for (std::size_t i = result.size(); i > 1; --i) std::swap(result[i - 1], result[std::size_t(random.bits(i) % i)]);
    return result;
  }

  Motion_score score(const Rigid_motion& motion, const std::vector<Surfel>& source, const std::vector<Surfel>& target,
                     std::size_t count, const Surfel_level& level, float distance, float least_cosine,
                     float free_depth) const
  {
    const Motion_f forth(motion), back(motion.inverse());
    const std::size_t n = (std::min)(count, source.size()), m = (std::min)(count, target.size());
    std::size_t agreeing = 0, before_target = 0, before_source = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const Vector_f p = forth(source[i].position);
      const int j = level.field.nearest(p);
      if (j >= 0) {
        const Surfel& t = level.surfels[std::size_t(j)];
        if (std::abs(t.normal.dot(p - t.position)) <= distance &&
            (forth.rotation * source[i].normal).dot(t.normal) >= least_cosine) {
          ++agreeing;
          continue;
        }
      }
      before_target += m_target.depths.is_known() && m_target.depths.in_front(p) > free_depth;
    }
    if (m_source.depths.is_known())
      for (std::size_t i = 0; i < m; ++i)
        before_source += m_source.depths.in_front(back(target[i].position)) > free_depth;
    Motion_score result;
    if (n > 0) {
      result.agreeing = double(agreeing) / double(n);
      result.violating = double(before_target) / double(n);
    }
    if (m > 0) result.violating += double(before_source) / double(m);
    return result;
  }

  const Prepared_scan& m_source;
  const Prepared_scan& m_target;
  double m_spacing;
  std::vector<Surfel> m_source_probes, m_target_probes;
  const Matching_vertices& m_s;
  Vertices m_vertices;
  Surfels m_surface;
  std::vector<Vector> m_points, m_normals; // of the source, to refine with
  Vector m_mean = Vector::Zero();
  Matrix m_covariance = Matrix::Zero();
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_EVALUATION_H
