// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_MOTION_EVALUATION_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_MOTION_EVALUATION_H

#include <CGAL/Crude_registration/internal/base/Counter_random.h>
#include <CGAL/Crude_registration/internal/reduction/Matching_vertices.h>
#include <CGAL/Crude_registration/internal/lookup/Point_grid.h>
#include <CGAL/Crude_registration/internal/reduction/Prepared_scan.h>
#include <CGAL/Crude_registration/internal/motion/point_to_plane.h>

#include <CGAL/tags.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
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
        m_s(s), m_vertices{m_target_probes, field_of(m_target_probes, float(spacing))}, m_surface{target.coarse}
  {
    for (std::size_t i = 0; i < s.points.size(); ++i) m_mean += s.points[i] / double(s.points.size());
    for (const Vector& p : s.points) m_covariance += (p - m_mean) * (p - m_mean).transpose() / double(s.points.size());
    for (const Surfel& surfel : some_of(source.fine.surfels, 1500)) {
      m_points.push_back(surfel.position.cast<double>());
      m_normals.push_back(surfel.normal.cast<double>());
    }
    m_fine_source_probes = some_of(source.fine.surfels, 2000);
    m_fine_target_probes = some_of(target.fine.surfels, 2000);
  }

  // A look at a crude motion by at most `count` vertices of each mesh. It ends where `least` is out of reach: the value
  // is then any below it.
  Motion_score coarse_score(const Rigid_motion& motion, std::size_t count,
                            double least = -(std::numeric_limits<double>::max)()) const
  {
    const auto spacing = float(m_spacing);
    return score(motion, m_source_probes, m_target_probes, count, m_target.coarse, 0.6f * spacing, 0.7f, 0.8f * spacing,
                 least);
  }

  // A tight look at a refined motion by all parts of the surface.
  Motion_score fine_score(const Rigid_motion& motion) const
  {
    const auto u = float((std::max)(m_source.spacing, m_target.spacing));
    return score(motion, m_fine_source_probes, m_fine_target_probes, std::size_t(-1), m_target.fine, 1.4f * u, 0.9f,
                 4 * u, -(std::numeric_limits<double>::max)());
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
    options.maximum_number_of_iterations = 8;
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
  // Some surfels, evenly spread.
  static std::vector<Surfel> some_of(const std::vector<Surfel>& surfels, std::size_t number)
  {
    std::vector<Surfel> result;
    for (std::size_t i = 0; i < surfels.size(); i += surfels.size() / number + 1) result.push_back(surfels[i]);
    return result;
  }

  static Surfel_field field_of(const std::vector<Surfel>& vertices, float spacing)
  {
    return Surfel_field(some_of(vertices, Surfel_field::maximum_size), 0.4f * spacing, spacing);
  }

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
    const std::vector<Surfel>& vertices;
    Surfel_field field;

    bool closest(const Vector& query, double reach, Surface_point& answer) const
    {
      const int i = field.nearest(query.cast<float>());
      if (i < 0) return false;
      answer.point = vertices[std::size_t(i)].position.cast<double>();
      answer.normal = vertices[std::size_t(i)].normal.cast<double>();
      answer.is_on_border = false;
      return (answer.point - query).squaredNorm() <= reach * reach;
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
                     std::size_t count, const Surfel_level& level, float distance, float least_cosine, float free_depth,
                     double least) const
  {
    const Motion_f forth(motion), back(motion.inverse());
    const std::size_t n = (std::min)(count, source.size()), m = (std::min)(count, target.size());
    std::size_t agreeing = 0, before_target = 0, before_source = 0;
    // With `open` probes of the source to come. No later value is above that with all of them agreeing.
    const auto result = [&](std::size_t open) {
      Motion_score r;
      if (n > 0) {
        r.agreeing = double(agreeing + open) / double(n);
        r.violating = double(before_target) / double(n);
      }
      if (m > 0) r.violating += double(before_source) / double(m);
      return r;
    };
    constexpr std::size_t every = 8; // probes between looks at the bound
    for (std::size_t i = 0; i < n; ++i) {
      if (i % every == 0 && result(n - i).value() < least) return result(n - i);
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
      for (std::size_t i = 0; i < m; ++i) {
        if (i % every == 0 && result(0).value() < least) break;
        before_source += m_source.depths.in_front(back(target[i].position)) > free_depth;
      }
    return result(0);
  }

  const Prepared_scan& m_source;
  const Prepared_scan& m_target;
  double m_spacing;
  std::vector<Surfel> m_source_probes, m_target_probes;
  const Matching_vertices& m_s;
  Vertices m_vertices;
  Surfels m_surface;
  std::vector<Vector> m_points, m_normals; // of the source, to refine with
  std::vector<Surfel> m_fine_source_probes, m_fine_target_probes;
  Vector m_mean = Vector::Zero();
  Matrix m_covariance = Matrix::Zero();
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_MOTION_EVALUATION_H
