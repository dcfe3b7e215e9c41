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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_TRIHEDRON_MATCHING_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_TRIHEDRON_MATCHING_H

// Searches points exhaustively for what may correspond to a spatial trihedron: section 6 of the paper.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/internal/lookup/Near_points.h>
#include <CGAL/Crude_registration/internal/lookup/Vertex_pair_index.h>
#include <CGAL/Crude_registration/internal/lookup/pair_angles.h>
#include <CGAL/Crude_registration/internal/matching/Fourth_vertex.h>
#include <CGAL/Crude_registration/internal/matching/exact_rigidity.h>
#include <CGAL/Crude_registration/internal/matching/trihedron_options.h>
#include <CGAL/Crude_registration/internal/reduction/Matching_vertices.h>

#include <CGAL/number_type_config.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The points of a curvature class: of each principal curvature the multiple of a step below it, from 0 to 127.
class Curvature_classes
{
public:
  explicit Curvature_classes(double tolerance) : m_tolerance(tolerance), m_scale(8 / tolerance) {}

  Vertex_classes operator()(double minimum, double maximum) const { return {{level(minimum), level(maximum)}}; }

  // The classes of what is within the tolerance, and a little more than that: the comparison itself rounds.
  std::array<Vertex_classes, 2> around(double minimum, double maximum) const
  {
    const auto slack = [&](double k) { return m_tolerance + 1e-9 * (m_tolerance + std::abs(k)); };
    return {(*this)(minimum - slack(minimum), maximum - slack(maximum)),
            (*this)(minimum + slack(minimum), maximum + slack(maximum))};
  }

private:
  std::uint8_t level(double k) const
  {
    return std::uint8_t((std::min)((std::max)(std::floor(k * m_scale) + 64, 0.), 127.));
  }

  double m_tolerance, m_scale;
};

inline bool is_within(const Vertex_classes& c, const std::array<Vertex_classes, 2>& limits)
{
  return c[0] >= limits[0][0] && c[0] <= limits[1][0] && c[1] >= limits[0][1] && c[1] <= limits[1][1];
}

// The exhaustive search of section 6 of the paper for the trihedra of S in the vertices of D: each vertex of D with
// matching curvatures is tried for V, each on the sphere around it for v1, each on the circle around both for v2
// (DARCES: two distances), each near the place that v3 has relative to the triangle for v3.
//
// With normals the pairs for (V, v1) are those of similar signed angles, too, the two normals tell the part of the
// circle on which c2 lies, and the normals of c2 and c3 have to agree with those of v2 and v3 as turned by the frames
// of the pair and of the triangle.
//
// The indices only leave out what is no match, by more than float or a cell may be off. What is left is decided in
// double where the measured is compared with a tolerance: curvatures, angles of normals, the distances to the circle
// and to the place of the fourth vertex, which are no polynomials of the coordinates. It is decided exactly where the
// shape of the match is in question: the six lengths, the side of the triangle, and whether there is a triangle at all.
class Trihedron_matching
{
public:
  // What a thread needs for itself.
  class Workspace
  {
    friend class Trihedron_matching;
    std::vector<std::uint64_t> tried_for; // the pair for which each vertex of D was last tried as c2
    std::uint64_t pairs = 0;
    std::vector<std::array<double, 2>> turns;
  };

  // `shortest`, `longest`: of the arms of the trihedra that will be asked for. `s` is kept by reference. Vertices of D
  // take part if they are described, on the border or not: the border of D may run through the inside of S.
  Trihedron_matching(const Matching_vertices& s, const Matching_vertices& d, double shortest, double longest,
                     const Match_tolerances& tolerances)
      : m_s(s), m_tolerances(tolerances), m_least_cosine(std::cos((std::min)(tolerances.angle, CGAL_PI))),
        m_classes(tolerances.curvature)
  {
    const double tolerance = tolerances.length;
    std::vector<Vertex_classes> classes;
    std::vector<Classed_point> classed_points;
    std::vector<Vector> points_in_tolerances;
    for (std::size_t i = 0; i < d.points.size(); ++i) {
      if (d.normals[i].isZero(0)) continue;
      classes.push_back(m_classes(d.minimum_curvatures[i], d.maximum_curvatures[i]));
      classed_points.push_back({std::uint32_t(m_vertices.size()), classes.back()});
      points_in_tolerances.push_back(d.points[i] / tolerance);
      m_vertices.push_back(std::int32_t(i));
      m_points.push_back(d.points[i]);
      m_normals.push_back(d.normals[i]);
      m_curvatures.push_back({d.minimum_curvatures[i], d.maximum_curvatures[i]});
    }
    // In tolerances, which float holds whatever the unit of length is, and from a little less to a little more.
    constexpr double slack = 1e-9;
    const double least = (1 - slack) * shortest / tolerance - (1 + slack),
                 most = (1 + slack) * (longest / tolerance + 1);
    m_index = Vertex_pair_index(points_in_tolerances, tolerances.use_normals ? m_normals : std::vector<Vector>(),
                                (std::max)(0., least), most, 0.5,
                                tolerances.use_normals ? tolerances.angle / 2 : CGAL_PI, classes);
    // A little more than sqrt(2) tolerances, see operator().
    m_near = Near_points<Classed_point>(m_points, classed_points, tolerance, 1.4143 * tolerance);
    for (const Vertex_classes& c : classes) ++m_counts[c[0] + 1u][c[1] + 1u];
    for (std::size_t i = 1; i < 129; ++i)
      for (std::size_t j = 1; j < 129; ++j)
        m_counts[i][j] += m_counts[i - 1][j] + m_counts[i][j - 1] - m_counts[i - 1][j - 1];
  }

  // A trihedron with its ends in the order in which its search costs least: the pairs of D that may correspond to the
  // first arm are tried one by one, so that arm is the first one that may be expected to have fewest.
  Spatial_trihedron rarest_first(Spatial_trihedron t) const
  {
    std::array<double, 3> pairs;
    for (std::size_t i = 0; i < 3; ++i) {
      const Source_pair pair(*this, t.origin, t.ends[i]);
      pairs[i] = double(m_index.number_of_looks(pair.descriptor, pair.tolerance)) * double(number_of_alike(t.ends[i]));
    }
    const auto rarest = std::size_t(std::min_element(pairs.begin(), pairs.end()) - pairs.begin());
    const std::array<std::int32_t, 3> ends = t.ends;
    for (std::size_t i = 0; i < 3; ++i) t.ends[i] = ends[(rarest + i) % 3];
    return t;
  }

  // output(vertices of D, places of the trihedron's vertices, places of those of D) for each correspondence.
  template <class Output>
  void operator()(const Spatial_trihedron& trihedron, Workspace& work, Output&& output) const
  {
    work.tried_for.resize(m_points.size(), 0);
    const std::array<std::int32_t, 4> s = {trihedron.origin, trihedron.ends[0], trihedron.ends[1], trihedron.ends[2]};
    std::array<Vector, 4> x, normal;
    for (std::size_t i = 0; i < 4; ++i) {
      x[i] = m_s.points[std::size_t(s[i])];
      normal[i] = m_s.normals[std::size_t(s[i])];
    }
    if (handedness(x) == COPLANAR) return;
    const double tolerance = m_tolerances.length;

    // The frame of the pair (V, v1), and v2 in it: how far along the line from its middle, and where around it.
    const Source_pair source_pair(*this, s[0], s[1]);
    const Pair_frame frame(x[0], normal[0], x[1], normal[1], m_tolerances.use_normals);
    const Vector a1 = x[1] - x[0], a2 = x[2] - x[0];
    const double along = frame.u.dot(a2 - a1 / 2), across_v = frame.v.dot(a2), across_w = frame.w.dot(a2);
    const double radius = std::hypot(across_v, across_w);
    const Vector second_normal = frame.local(normal[2]);
    // The part of the circle that is in question, in steps so short that what is within the tolerance of a step's part
    // is within sqrt(2) times the tolerance of its middle.
    const double uncertainty = frame.uncertainty(m_tolerances.angle);
    const double least_cosine = uncertainty < CGAL_PI ? std::cos(uncertainty) : -2;
    const double steps = std::ceil(uncertainty * (radius + tolerance) / tolerance);
    work.turns.clear();
    for (std::size_t i = 0; double(i) < steps; ++i) {
      const double turn = uncertainty * ((2 * double(i) + 1) / steps - 1);
      work.turns.push_back({std::cos(turn), std::sin(turn)});
    }

    const Fourth_vertex fourth(x, tolerance);
    const Vector third_normal = frame_of_triangle(frame.u, fourth.normal()).transpose() * normal[3];

    const auto limits0 = limits(s[0]), limits1 = limits(s[1]), limits2 = limits(s[2]), limits3 = limits(s[3]);
    std::array<Vector, 4> y;
    m_index.for_each_match(
        source_pair.descriptor, source_pair.tolerance, {limits0[0], limits0[1], limits1[0], limits1[1]},
        [&](const Vertex_pair_index::Pair& pair) {
          const auto c0 = std::size_t(pair.first), c1 = std::size_t(pair.second);
          if (!curvatures_agree(s[0], c0) || !curvatures_agree(s[1], c1)) return;
          y[0] = m_points[c0];
          y[1] = m_points[c1];
          const Pair_frame image(y[0], m_normals[c0], y[1], m_normals[c1], m_tolerances.use_normals);
          const Vector foot = 0.5 * (y[0] + y[1]) + along * image.u;
          const Vector towards = across_v * image.v + across_w * image.w,
                       sideways = across_v * image.w - across_w * image.v;
          const Vector expected_second = image.world(second_normal);
          ++work.pairs;
          for (const auto& [cosine, sine] : work.turns) {
            const Vector place = foot + cosine * towards + sine * sideways;
            m_near.for_each_near(place, [&](const Classed_point& near_second) {
              const std::size_t c2 = near_second.point;
              if (!is_within(near_second.classes, limits2) || work.tried_for[c2] == work.pairs) return;
              work.tried_for[c2] = work.pairs;
              y[2] = m_points[c2];
              // Within the tolerance of the circle, and in its part that is in question.
              const Vector e = y[2] - foot;
              const double axial = e.dot(image.u), radial = std::sqrt((std::max)(0., e.squaredNorm() - axial * axial));
              if (axial * axial + (radial - radius) * (radial - radius) > tolerance * tolerance ||
                  !(e.dot(towards) >= least_cosine * radial * radius))
                return;
              if (!normals_agree(c2, expected_second) || !curvatures_agree(s[2], c2)) return;
              const Triangle_normal n(y[0], y[1], y[2]);
              if (n.vector.isZero(0)) return;
              const Vector p = fourth.place(y, n);
              const Vector expected_third = frame_of_triangle(image.u, n.vector) * third_normal;
              m_near.for_each_near(p, [&](const Classed_point& near_third) {
                const std::size_t c3 = near_third.point;
                if (!is_within(near_third.classes, limits3)) return;
                if (!((m_points[c3] - p).squaredNorm() <= tolerance * tolerance)) return;
                if (!normals_agree(c3, expected_third) || !curvatures_agree(s[3], c3)) return;
                y[3] = m_points[c3];
                if (m_tolerances.use_normals && !source_pair.agrees(image, m_normals[c0], m_normals[c1])) return;
                if (!fourth.is_on_its_side(y) || !are_rigid(x, y, tolerance)) return;
                output(std::array<std::int32_t, 4>{m_vertices[c0], m_vertices[c1], m_vertices[c2], m_vertices[c3]}, x,
                       y);
              });
            });
          }
        });
  }

private:
  // A described vertex of D by its position among them.
  struct Classed_point
  {
    std::uint32_t point;
    Vertex_classes classes;
  };

  // Axes on a pair of points: u along the line, v towards the mean of the normals, w = u x v; without normals v is
  // any.
  struct Pair_frame
  {
    Pair_frame(const Vector& p, const Vector& np, const Vector& q, const Vector& nq, bool use_normals)
    {
      u = q - p;
      u *= 1 / u.norm();
      if (use_normals) {
        const double cp = np.dot(u), cq = nq.dot(u);
        v = np + nq - (cp + cq) * u;
        spread = v.norm();
      }
      if (spread > 1e-6) v *= 1 / spread;
      else v = u.unitOrthogonal();
      w = u.cross(v);
    }

    Vector local(const Vector& a) const { return Vector(u.dot(a), v.dot(a), w.dot(a)); }
    Vector world(const Vector& a) const { return a[0] * u + a[1] * v + a[2] * w; }

    // By how much v may be turned about u when the normals are off by `angle`.
    double uncertainty(double angle) const { return 2 * angle < CGAL_PI * spread ? 2 * angle / spread : CGAL_PI; }

    Vector u, v, w;
    double spread = 0;
  };

  // Axes on a triangle with the first axis along its first edge and the last one along its normal.
  static Matrix frame_of_triangle(const Vector& u, const Vector& normal)
  {
    Matrix m;
    m << u, normal.cross(u), normal;
    return m;
  }

  // A pair of S, and which pairs of D may correspond to it. Angles are compared by their cosines, without an arc
  // cosine.
  struct Source_pair
  {
    Source_pair(const Trihedron_matching& matching, std::int32_t v, std::int32_t w)
    {
      const Match_tolerances& tolerances = matching.m_tolerances;
      const Vector d = matching.m_s.points[std::size_t(w)] - matching.m_s.points[std::size_t(v)];
      const double length = d.norm();
      double sine = 0;
      if (tolerances.use_normals) {
        cosines = pair_cosines(Vector(d / length), matching.m_s.normals[std::size_t(v)],
                               matching.m_s.normals[std::size_t(w)]);
        descriptor.angles = cosines.angles();
        const double most = (std::max)(cosines.first * cosines.first, cosines.second * cosines.second);
        sine = std::sqrt((std::max)(0., 1 - most));
      }
      descriptor.length = float(length / tolerances.length);
      // A normal that is off by an angle makes another turn by that angle over the sine of its angle with the line.
      const double turn = tolerances.angle < CGAL_PI * sine ? tolerances.angle / sine : CGAL_PI;
      tolerance = {1, float(tolerances.angle), float(turn)};
      least_cosine = matching.m_least_cosine;
      least_cosine_of_turn = std::cos(turn);
    }

    // Whether the angles of a pair of D are within the tolerances.
    bool agrees(const Pair_frame& image, const Vector& n, const Vector& m) const
    {
      const Pair_cosines<double> c = pair_cosines(image.u, n, m);
      return cosine_of_difference(cosines.first, c.first) >= least_cosine &&
             cosine_of_difference(cosines.second, c.second) >= least_cosine &&
             cosines.turn * c.turn + cosines.sine_of_turn * c.sine_of_turn >=
                 least_cosine_of_turn *
                     (std::hypot(cosines.turn, cosines.sine_of_turn) * std::hypot(c.turn, c.sine_of_turn));
    }

    static double cosine_of_difference(double a, double b)
    {
      return a * b + std::sqrt((std::max)(0., 1 - a * a) * (std::max)(0., 1 - b * b));
    }

    Pair_cosines<double> cosines{0, 0, 0, 0};
    Vertex_pair_descriptor descriptor{0, {0, 0, 0}};
    Vertex_pair_tolerance tolerance;
    double least_cosine, least_cosine_of_turn;
  };

  std::array<Vertex_classes, 2> limits(std::int32_t s) const
  {
    return m_classes.around(m_s.minimum_curvatures[std::size_t(s)], m_s.maximum_curvatures[std::size_t(s)]);
  }

  // The vertices of D in the curvature classes of a vertex of S.
  std::int32_t number_of_alike(std::int32_t s) const
  {
    const auto [low, high] = limits(s);
    return m_counts[high[0] + 1u][high[1] + 1u] - m_counts[low[0]][high[1] + 1u] - m_counts[high[0] + 1u][low[1]] +
           m_counts[low[0]][low[1]];
  }

  bool curvatures_agree(std::int32_t s, std::size_t d) const
  {
    return std::abs(m_s.minimum_curvatures[std::size_t(s)] - m_curvatures[d][0]) <= m_tolerances.curvature &&
           std::abs(m_s.maximum_curvatures[std::size_t(s)] - m_curvatures[d][1]) <= m_tolerances.curvature;
  }

  bool normals_agree(std::size_t d, const Vector& expected) const
  {
    return !m_tolerances.use_normals || m_normals[d].dot(expected) >= m_least_cosine;
  }

  const Matching_vertices& m_s;
  Match_tolerances m_tolerances;
  double m_least_cosine;
  // The described vertices of D.
  std::vector<std::int32_t> m_vertices;
  std::vector<Vector> m_points, m_normals;
  std::vector<std::array<double, 2>> m_curvatures;
  Curvature_classes m_classes;
  Vertex_pair_index m_index;
  Near_points<Classed_point> m_near;
  std::array<std::array<std::int32_t, 129>, 129> m_counts{}; // of vertices of D in all lower classes
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_TRIHEDRON_MATCHING_H
