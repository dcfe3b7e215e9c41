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

#ifndef CGAL_CRUDE_REGISTRATION_MATCHING_MATCH_TRIHEDRA_H
#define CGAL_CRUDE_REGISTRATION_MATCHING_MATCH_TRIHEDRA_H

#include <CGAL/Crude_registration/matching/Spatial_trihedron.h>
#include <CGAL/Crude_registration/internal/lookup/Vertex_pair_index.h>
#include <CGAL/Crude_registration/internal/reduction/Curvature_tensors.h>
#include <CGAL/Crude_registration/internal/reduction/Matching_vertices.h>
#include <CGAL/Crude_registration/internal/reduction/scan_frame.h>
#include <CGAL/Crude_registration/named_parameters.h>
#include <CGAL/Crude_registration/reduction/principal_curvatures.h>
#include <CGAL/Crude_registration/motion/rigid_motion.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
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

// The points within a reach of any place, and some others near, by one look-up: each cell of a grid lists the points
// within the reach of a place in it. Cells get larger than asked for where they would outnumber the points 512 to one.
class Near_points
{
public:
  struct Entry
  {
    std::int32_t point;
    Vertex_classes classes;
  };

  Near_points() = default;

  Near_points(const std::vector<Vector>& points, const std::vector<Vertex_classes>& classes, double cell, double reach)
  {
    if (points.empty()) return;
    Vector low = points.front(), high = low;
    for (const Vector& p : points) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    m_low = low.array() - reach;
    const Vector size = high - low + Vector::Constant(2 * reach);
    while (((size / cell).array().floor() + 1).prod() > 512. * double(points.size())) cell *= 1.25;
    m_scale = 1 / cell;
    for (int i = 0; i < 3; ++i) m_cells[std::size_t(i)] = int(size[i] * m_scale) + 1;
    const std::size_t cells = std::size_t(m_cells[0]) * std::size_t(m_cells[1]) * std::size_t(m_cells[2]);
    m_is_near.assign(cells / 64 + 1, 0);
    m_begin.assign(cells + 1, 0);
    // A little less than the distance of a cell, so that rounding leaves none out.
    const double most = 1.000002 * (reach * m_scale) * (reach * m_scale);
    std::vector<std::pair<std::uint32_t, std::int32_t>> found;
    for (std::size_t j = 0; j < points.size(); ++j) {
      const Vector p = (points[j] - m_low) * m_scale;
      int first[3], last[3];
      for (int i = 0; i < 3; ++i) {
        first[i] = (std::max)(0, int(std::floor(p[i] - reach * m_scale)));
        last[i] = (std::min)(m_cells[std::size_t(i)] - 1, int(p[i] + reach * m_scale));
      }
      const auto off = [&](int i, int c) { return (std::max)({0., c - p[i], p[i] - (c + 1)}); };
      for (int z = first[2]; z <= last[2]; ++z) {
        const double dz = off(2, z);
        for (int y = first[1]; y <= last[1]; ++y) {
          const double dy = off(1, y);
          for (int x = first[0]; x <= last[0]; ++x) {
            const double dx = off(0, x);
            if (dx * dx + dy * dy + dz * dz > most) continue;
            const std::size_t c = cell_index(x, y, z);
            ++m_begin[c + 1];
            m_is_near[c >> 6] |= std::uint64_t(1) << (c & 63);
            found.push_back({std::uint32_t(c), std::int32_t(j)});
          }
        }
      }
    }
    for (std::size_t c = 1; c < m_begin.size(); ++c) m_begin[c] += m_begin[c - 1];
    std::vector<std::uint32_t> next(m_begin.begin(), m_begin.end() - 1);
    m_entries.resize(found.size());
    for (const auto& [c, j] : found) m_entries[next[c]++] = {j, classes[std::size_t(j)]};
  }

  // f(point) for all points of some classes within the reach of p, and others near, in the order of their index.
  template <class Function>
  void for_each_near(const Vector& p, const std::array<Vertex_classes, 2>& limits, Function&& f) const
  {
    const double x = (p[0] - m_low[0]) * m_scale, y = (p[1] - m_low[1]) * m_scale, z = (p[2] - m_low[2]) * m_scale;
    if (!(x >= 0 && y >= 0 && z >= 0 && x < m_cells[0] && y < m_cells[1] && z < m_cells[2])) return;
    const std::size_t c = cell_index(int(x), int(y), int(z));
    // Most places are near nothing: one bit says so, and all bits are in the cache.
    if (!((m_is_near[c >> 6] >> (c & 63)) & 1)) return;
    for (std::size_t i = m_begin[c]; i < m_begin[c + 1]; ++i)
      if (is_within(m_entries[i].classes, limits)) f(std::size_t(m_entries[i].point));
  }

private:
  std::size_t cell_index(int x, int y, int z) const
  {
    return (std::size_t(z) * std::size_t(m_cells[1]) + std::size_t(y)) * std::size_t(m_cells[0]) + std::size_t(x);
  }

  Vector m_low = Vector::Zero();
  double m_scale = 1;
  std::array<int, 3> m_cells{};
  std::vector<std::uint64_t> m_is_near; // a bit for each cell
  std::vector<std::uint32_t> m_begin;   // of each cell in m_entries
  std::vector<Entry> m_entries;
};

struct Match_tolerances
{
  double length = 0;       // of a vertex's place: about the distance of neighbouring vertices
  double angle = 0;        // of a normal, radians
  double curvature = 0;    // of either curvature, 1/length
  bool use_normals = true; // false: the paper's descriptor, curvatures alone
};

// A trihedron of S and the vertices C, c1, c2, c3 of D that may correspond to its V, v1, v2, v3. `motion` maps S to D
// in the least squares sense over the four pairs, with the root mean square distance `residual`.
struct Candidate_motion
{
  Rigid_motion motion;
  std::int32_t trihedron; // position in the range of trihedra
  std::array<std::int32_t, 4> vertices;
  double residual;
};

// The exhaustive search of section 6 of the paper for the trihedra of S in the vertices of D: each vertex of D with
// matching curvatures is tried for V, each on the sphere around it for v1, each on the circle around both for v2
// (DARCES: two distances), each near the place that v3 has relative to the triangle for v3.
//
// With normals the pairs for (V, v1) are those of similar signed angles, too, the two normals tell the part of the
// circle on which c2 lies, and the normals of c2 and c3 have to agree with those of v2 and v3 as turned by the frames
// of the pair and of the triangle.
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
    std::vector<Vertex_classes> classes;
    for (std::size_t i = 0; i < d.points.size(); ++i) {
      if (d.normals[i].isZero(0)) continue;
      m_vertices.push_back(std::int32_t(i));
      m_points.push_back(d.points[i]);
      m_normals.push_back(d.normals[i]);
      m_curvatures.push_back({d.minimum_curvatures[i], d.maximum_curvatures[i]});
      classes.push_back(m_classes(d.minimum_curvatures[i], d.maximum_curvatures[i]));
    }
    const double least = (std::max)(0., shortest - tolerances.length), most = longest + tolerances.length;
    m_index =
        Vertex_pair_index(m_points, tolerances.use_normals ? m_normals : std::vector<Vector>(), least, most,
                          tolerances.length / 2, tolerances.use_normals ? tolerances.angle / 2 : CGAL_PI, classes);
    m_near = Near_points(m_points, classes, tolerances.length, 1.4143 * tolerances.length);
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
    for (std::size_t i = 0; i < 3; ++i)
      pairs[i] = double(m_index.number_of_looks(descriptor(t.origin, t.ends[i]), pair_tolerance(t.origin, t.ends[i]))) *
                 double(number_of_alike(t.ends[i]));
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
    const Orientation hand = handedness(x);
    if (hand == COPLANAR) return;
    const double tolerance = m_tolerances.length;
    const Vector a1 = x[1] - x[0], a2 = x[2] - x[0], a3 = x[3] - x[0];

    // The frame of the pair (V, v1), and v2 in it: how far along the line from its middle, and where around it.
    const Pair_frame frame(x[0], normal[0], x[1], normal[1], m_tolerances.use_normals);
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

    // v3 relative to the triangle (V, v1, v2): barycentric coordinates of its projection, and signed height.
    const Vector cross = a1.cross(a2);
    const double area = cross.norm();
    const double beta = cross.dot(a3.cross(a2)) / (area * area), gamma = cross.dot(a1.cross(a3)) / (area * area);
    const double height = cross.dot(a3) / area;
    Matrix triangle_frame;
    triangle_frame << frame.u, (cross / area).cross(frame.u), cross / area;
    const Vector third_normal = triangle_frame.transpose() * normal[3];

    const auto limits0 = limits(s[0]), limits1 = limits(s[1]), limits2 = limits(s[2]), limits3 = limits(s[3]);
    std::array<Vector, 4> y;
    m_index.for_each_match(
        descriptor(s[0], s[1]), pair_tolerance(s[0], s[1]), {limits0[0], limits0[1], limits1[0], limits1[1]},
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
          const Vector b1 = y[1] - y[0];
          ++work.pairs;
          for (const auto& [cosine, sine] : work.turns) {
            const Vector place = foot + cosine * towards + sine * sideways;
            m_near.for_each_near(place, limits2, [&](std::size_t c2) {
              if (work.tried_for[c2] == work.pairs) return;
              work.tried_for[c2] = work.pairs;
              y[2] = m_points[c2];
              // Within the tolerance of the circle, and in its part that is in question.
              const Vector e = y[2] - foot;
              const double axial = e.dot(image.u), radial = std::sqrt((std::max)(0., e.squaredNorm() - axial * axial));
              if (axial * axial + (radial - radius) * (radial - radius) > tolerance * tolerance ||
                  !(e.dot(towards) >= least_cosine * radial * radius))
                return;
              if (!normals_agree(c2, expected_second) || !curvatures_agree(s[2], c2)) return;
              const Vector b2 = y[2] - y[0];
              const Vector image_cross = b1.cross(b2);
              const double image_area = image_cross.norm();
              if (!(image_area > 0)) return;
              // p = x2 + n2 d
              const Vector n = image_cross / image_area;
              const Vector p = y[0] + beta * b1 + gamma * b2 + height * n;
              Matrix image_frame;
              image_frame << image.u, n.cross(image.u), n;
              const Vector expected_third = image_frame * third_normal;
              m_near.for_each_near(p, limits3, [&](std::size_t c3) {
                if (!((m_points[c3] - p).squaredNorm() <= tolerance * tolerance)) return;
                if (!normals_agree(c3, expected_third) || !curvatures_agree(s[3], c3)) return;
                y[3] = m_points[c3];
                // A small trihedron's place for v3 may reach to the other side of the plane: a mirror image.
                if (handedness(y) != hand) return;
                output(std::array<std::int32_t, 4>{m_vertices[c0], m_vertices[c1], m_vertices[c2], m_vertices[c3]}, x,
                       y);
              });
            });
          }
        });
  }

private:
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

  Vertex_pair_descriptor descriptor(std::int32_t v, std::int32_t w) const
  {
    const Vector &p = m_s.points[std::size_t(v)], &q = m_s.points[std::size_t(w)];
    if (!m_tolerances.use_normals) return {float((q - p).norm()), 0, 0, 0};
    return Vertex_pair_index::describe(p, m_s.normals[std::size_t(v)], q, m_s.normals[std::size_t(w)]);
  }

  // A normal that is off by an angle turns the torsion by that angle over the sine of the normal's angle with the line.
  Vertex_pair_tolerance pair_tolerance(std::int32_t v, std::int32_t w) const
  {
    const double angle = m_tolerances.angle;
    double sine = 0;
    if (m_tolerances.use_normals) {
      const Vector u = (m_s.points[std::size_t(w)] - m_s.points[std::size_t(v)]).normalized();
      const double cv = u.dot(m_s.normals[std::size_t(v)]), cw = u.dot(m_s.normals[std::size_t(w)]);
      sine = std::sqrt((std::max)(0., 1 - (std::max)(cv * cv, cw * cw)));
    }
    return {float(m_tolerances.length), float(angle), float(angle < CGAL_PI * sine ? angle / sine : CGAL_PI)};
  }

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
  Near_points m_near;
  std::array<std::array<std::int32_t, 129>, 129> m_counts{}; // of vertices of D in all lower classes
};

inline std::array<double, 2> range_of_arms(const std::vector<Vector>& points,
                                           const std::vector<Spatial_trihedron>& trihedra)
{
  double least = (std::numeric_limits<double>::max)(), most = 0;
  for (const Spatial_trihedron& t : trihedra) {
    const double squared = (points[std::size_t(t.ends[0])] - points[std::size_t(t.origin)]).squaredNorm();
    least = (std::min)(least, squared);
    most = (std::max)(most, squared);
  }
  return {std::sqrt((std::min)(least, most)), std::sqrt(most)};
}

// The candidate of a correspondence; false where its points determine no motion.
inline bool candidate_motion(std::int32_t trihedron, const std::array<std::int32_t, 4>& vertices,
                             const std::array<Vector, 4>& x, const std::array<Vector, 4>& y,
                             Candidate_motion& candidate)
{
  const auto motion = least_squares_motion(x.data(), y.data(), nullptr, 4);
  if (!motion) return false;
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) sum += ((*motion)(x[i]) - y[i]).squaredNorm();
  candidate = {*motion, trihedron, vertices, std::sqrt(sum / 4)};
  return true;
}

// All candidates for some trihedra of S, in the order of the trihedra.
inline std::vector<Candidate_motion> match_trihedra(const Matching_vertices& s,
                                                    const std::vector<Spatial_trihedron>& trihedra,
                                                    const Matching_vertices& d, const Match_tolerances& tolerances)
{
  std::vector<Candidate_motion> candidates;
  const std::array<double, 2> arms = range_of_arms(s.points, trihedra);
  const Trihedron_matching matching(s, d, arms[0], arms[1], tolerances);
  Trihedron_matching::Workspace work;
  for (std::size_t i = 0; i < trihedra.size(); ++i)
    matching(trihedra[i], work, [&](const auto& vertices, const auto& x, const auto& y) {
      Candidate_motion candidate;
      if (candidate_motion(std::int32_t(i), vertices, x, y, candidate)) candidates.push_back(candidate);
    });
  return candidates;
}

// The vertices of a simplified mesh as the parameters describe them, or as the mesh itself does.
template <class FaceGraph, class NamedParameters>
Matching_vertices given_matching_vertices(const FaceGraph& graph, const Flat_mesh& mesh, const NamedParameters& np,
                                          const char* function, const char* argument)
{
  Matching_vertices result;
  result.points = mesh.points;
  const std::size_t n = mesh.points.size();
  if constexpr (is_given<NamedParameters, internal_np::vertex_normal_map_t>) {
    const auto map = parameter(np, internal_np::vertex_normal_map, 0);
    for (auto v : vertices(graph)) {
      const auto& m = get(map, v);
      const Vector normal(to_double(m.x()), to_double(m.y()), to_double(m.z()));
      result.normals.push_back(normal.allFinite() ? unit_or_zero(normal) : normal);
    }
  } else result.normals = vertex_normals(mesh);
  if constexpr (is_given<NamedParameters, internal_np::curvature_map_t>) {
    const auto map = parameter(np, internal_np::curvature_map, 0);
    for (auto v : vertices(graph)) {
      const auto& c = get(map, v);
      result.minimum_curvatures.push_back(to_double(c.minimum));
      result.maximum_curvatures.push_back(to_double(c.maximum));
    }
  } else {
    const Curvature_field field = curvature_tensors(mesh, result.normals);
    for (const Curvature_tensor& t : field.tensors) {
      result.minimum_curvatures.push_back(t.minimum());
      result.maximum_curvatures.push_back(t.maximum());
    }
  }
  for (std::size_t i = 0; i < n; ++i)
    if (!result.normals[i].allFinite() || !std::isfinite(result.minimum_curvatures[i]) ||
        !std::isfinite(result.maximum_curvatures[i]))
      throw std::invalid_argument(std::string(function) + ": vertex " + std::to_string(i) + " of " + argument +
                                  " has a normal or a curvature that is not finite");
  const std::vector<std::uint8_t> borders = border_flags(mesh);
  result.inside.resize(n);
  for (std::size_t i = 0; i < n; ++i) result.inside[i] = !borders[i] && !result.normals[i].isZero(0);
  return result;
}

} // namespace internal

/*!
 * \ingroup PkgCrudeRegistrationRef
 *
 * \brief a trihedron of the source and the four vertices of the target that may correspond to its own.
 *
 * \tparam Kernel a model of `Kernel`
 */
template <class Kernel>
struct Trihedron_match
{
  Spatial_trihedron source;                    ///< \f$ V, v_1, v_2, v_3 \f$
  Spatial_trihedron target;                    ///< \f$ C, c_1, c_2, c_3 \f$
  Aff_transformation_3<Kernel> transformation; ///< maps the source into the frame of the target: least squares
  double residual;                             ///< root mean square distance of the four pairs under it
};

/*!
 * \ingroup PkgCrudeRegistrationRef
 *
 * \brief searches the vertices of a simplified mesh exhaustively for what may correspond to the spatial trihedra of
 * another one: section 6 of the paper.
 *
 * For each trihedron of `source` (see `spatial_trihedra()`) every vertex of `target` is tried for \f$ V \f$, those on
 * the sphere around it for \f$ v_1 \f$, those on the circle at the distances of \f$ v_2 \f$ from both for
 * \f$ v_2 \f$, and those near \f$ p = x_2 + n_2 d \f$ for \f$ v_3 \f$: the place with the barycentric coordinates and
 * the height that \f$ v_3 \f$ has relative to the triangle \f$ V v_1 v_2 \f$. Corresponding vertices have similar
 * minimal and maximal curvatures. As curvatures alone leave many candidates to a scan's noise, their normals agree,
 * too: those of the pair \f$ (V, v_1) \f$ by their signed angles with the line between them, those of \f$ v_2 \f$ and
 * \f$ v_3 \f$ by where the vertices found before would turn them. Whether a correspondence is the mirror image of the
 * trihedron is decided by CGAL's exact predicates.
 *
 * \tparam SourceGraph, TargetGraph models of `FaceListGraph`
 * \tparam NamedParameters1, NamedParameters2 sequences of \ref bgl_namedparameters "Named Parameters"
 *
 * \param source the \f$ S \f$-mesh, simplified
 * \param target the \f$ D \f$-mesh, simplified
 * \param np_source, np_target optional sequences of named parameters among the ones listed below:
 *   - `vertex_point_map`, in either: default `get(CGAL::vertex_point, mesh)`
 *   - `vertex_normal_map`, in either: normals of the vertices, best those of the dense mesh; default: of the mesh
 *   - `curvature_map`, in either: a map from vertices to `Principal_curvatures`, best those of the dense mesh averaged
 *     over a neighbourhood; default: of the mesh
 *   - `minimum_extent`, `maximum_extent`, `viewing_direction`, `viewpoint`, in `np_source`: as for `spatial_trihedra()`
 *   - `tolerance`, in `np_source`: how far vertices that correspond may lie from the same place of the surface, a
 *     length; default: 0.7 times the median edge length of `target`. Normals may differ by 15 degrees, curvatures by
 *     0.15 divided by this tolerance
 *
 * \return the matches in the order of the trihedra
 *
 * \throws std::invalid_argument if a face of a mesh is not a triangle, a coordinate, normal or curvature is not finite,
 * `source` has fewer than four vertices off its border or `target` fewer than four vertices (those without a normal do
 * not count), the tolerance is not between 1e-5 and 1 times the mean extent of `source`, or not
 * \f$ 0 \le f_1 < f_2 \f$.
 */
template <class Kernel = Exact_predicates_inexact_constructions_kernel, class SourceGraph, class TargetGraph,
          class NamedParameters1 = parameters::Default_named_parameters,
          class NamedParameters2 = parameters::Default_named_parameters>
std::vector<Trihedron_match<Kernel>> match_trihedra(const SourceGraph& source, const TargetGraph& target,
                                                    const NamedParameters1& np_source = parameters::default_values(),
                                                    const NamedParameters2& np_target = parameters::default_values())
{
  const std::array<double, 2> shares = internal::extent_parameters(np_source, "match_trihedra");
  const internal::Flat_mesh s_mesh = internal::to_flat_mesh(source, np_source, "match_trihedra", "source");
  const internal::Flat_mesh d_mesh = internal::to_flat_mesh(target, np_target, "match_trihedra", "target");
  const internal::Matching_vertices s =
      internal::given_matching_vertices(source, s_mesh, np_source, "match_trihedra", "source");
  const internal::Matching_vertices d =
      internal::given_matching_vertices(target, d_mesh, np_target, "match_trihedra", "target");
  if (std::count(s.inside.begin(), s.inside.end(), 1) < 4)
    throw std::invalid_argument("match_trihedra: source has fewer than four vertices off its border with a normal");
  if (std::count_if(d.normals.begin(), d.normals.end(), [](const internal::Vector& n) { return !n.isZero(0); }) < 4)
    throw std::invalid_argument("match_trihedra: target has fewer than four vertices with a normal");
  const double extent =
      internal::extent_of_mesh(s_mesh, internal::sensor_parameter(np_source, "match_trihedra")).sum() / 3;
  internal::Match_tolerances tolerances;
  tolerances.length = internal::positive_parameter(
      np_source, internal_np::tolerance, 0.7 * internal::median_edge_length(d_mesh), "match_trihedra", "tolerance");
  if (!(tolerances.length < extent && tolerances.length > 1e-5 * extent))
    throw std::invalid_argument(
        "match_trihedra: tolerance (0.7 edges of target if not given) is not between 1e-5 and 1 "
        "times the extent of source");
  const std::vector<Spatial_trihedron> trihedra =
      internal::spatial_trihedra(s.points, s.inside, internal::trihedron_options(shares, extent));
  tolerances.angle = 15 * CGAL_PI / 180;
  tolerances.curvature = 0.15 / tolerances.length;

  std::vector<Trihedron_match<Kernel>> matches;
  for (const internal::Candidate_motion& c : internal::match_trihedra(s, trihedra, d, tolerances))
    matches.push_back({trihedra[std::size_t(c.trihedron)],
                       {c.vertices[0], {c.vertices[1], c.vertices[2], c.vertices[3]}},
                       internal::to_aff_transformation<Kernel>(c.motion),
                       c.residual});
  return matches;
}

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_MATCHING_MATCH_TRIHEDRA_H
