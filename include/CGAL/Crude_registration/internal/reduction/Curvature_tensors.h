// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_CURVATURE_TENSORS_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_CURVATURE_TENSORS_H

#include <CGAL/Crude_registration/internal/mesh/mesh_geometry.h>

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

// Two unit vectors u, v with u x v = n for a unit vector n (Duff et al., "Building an orthonormal basis, revisited",
// 2017): the frame in which a Curvature_tensor at a vertex of normal n is written.
struct Tangent_frame
{
  Vector u, v;

  explicit Tangent_frame(const Vector& n)
  {
    const double sign = std::copysign(1.0, n.z());
    const double a = -1.0 / (sign + n.z());
    const double b = n.x() * n.y() * a;
    u = Vector(1.0 + sign * n.x() * n.x() * a, sign * b, -sign * n.x());
    v = Vector(b, sign + n.y() * n.y() * a, -n.y());
  }
};

// A second fundamental form in a tangent frame (u, v): a unit tangent vector x u + y v bends the surface by
// uu x^2 + 2 uv x y + vv y^2, in 1/length, positive where the surface is convex seen from outside.
struct Curvature_tensor
{
  double uu = 0, uv = 0, vv = 0;

  double mean() const { return 0.5 * (uu + vv); }
  double gaussian() const { return uu * vv - uv * uv; }
  double deviation() const { return std::hypot(0.5 * (uu - vv), uv); }
  double minimum() const { return mean() - deviation(); }
  double maximum() const { return mean() + deviation(); }

  // The direction of the maximal curvature as its components along u and v; that of the minimal one is (-y, x).
  std::array<double, 2> direction_of_maximum() const
  {
    const double angle = 0.5 * std::atan2(2 * uv, uu - vv);
    return {std::cos(angle), std::sin(angle)};
  }

  Curvature_tensor& operator+=(const Curvature_tensor& t)
  {
    uu += t.uu;
    uv += t.uv;
    vv += t.vv;
    return *this;
  }
  friend Curvature_tensor operator*(double w, const Curvature_tensor& t)
  {
    Curvature_tensor r;
    r.uu = w * t.uu;
    r.uv = w * t.uv;
    r.vv = w * t.vv;
    return r;
  }
  friend Curvature_tensor operator/(const Curvature_tensor& t, double w)
  {
    Curvature_tensor r;
    r.uu = t.uu / w;
    r.uv = t.uv / w;
    r.vv = t.vv / w;
    return r;
  }
};

// The second fundamental form W that explains best, in the least squares sense, how normals differ from place to place,
// y = W x: a place x = (xu, xv) further in a tangent frame the normal is y = (yu, yv) more. Equation 6 of Rusinkiewicz
// 2004, over the edges of a face or any neighbourhood. Its normal equations have the matrix [a b 0; b a+c b; 0 b c].
struct Second_fundamental_form_fit
{
  double a = 0, b = 0, c = 0, r0 = 0, r1 = 0, r2 = 0;

  void add(double xu, double xv, double yu, double yv)
  {
    a += xu * xu;
    b += xu * xv;
    c += xv * xv;
    r0 += xu * yu;
    r1 += xu * yv + xv * yu;
    r2 += xv * yv;
  }

  // The square of an area: zero where all places lie on a line, and determine no form.
  double minor() const { return a * c - b * b; }
  double trace() const { return a + c; }

  // `minor`: that of above, or what it is known to be with more digits; above zero.
  Curvature_tensor solved(double minor) const
  {
    const double scale = 1 / (trace() * minor);
    Curvature_tensor form;
    form.uu = ((minor + c * c) * r0 - b * c * r1 + b * b * r2) * scale;
    form.uv = (a * c * r1 - b * (c * r0 + a * r2)) * scale;
    form.vv = ((minor + a * a) * r2 - a * b * r1 + b * b * r0) * scale;
    return form;
  }
};

// `t`, written in the frame of first vector `u` of the plane of normal n, rotated about n x m into the plane of normal
// m and written in that plane's Tangent_frame (Rusinkiewicz 2004, section 3.2). False, and `result` untouched, where n
// and m are so nearly opposite that the rotation has no meaning.
inline bool rotate_tensor(const Curvature_tensor& t, const Vector& u, const Vector& n, const Vector& m,
                          Curvature_tensor& result)
{
  const double denominator = 1 + n.dot(m);
  if (!(denominator > 1e-3)) return false;
  const Vector rotated = u - ((u.dot(m) / denominator) * (n + m));
  const Tangent_frame frame(m);
  const double c = rotated.dot(frame.u), s = rotated.dot(frame.v);
  const double cc = c * c, cs = c * s, ss = s * s;
  result.uu = cc * t.uu - 2 * cs * t.uv + ss * t.vv;
  result.uv = cs * (t.uu - t.vv) + (cc - ss) * t.uv;
  result.vv = ss * t.uu + 2 * cs * t.uv + cc * t.vv;
  return true;
}

// One curvature tensor a vertex. `areas` are the parts of the faces that are nearest to each vertex (Voronoi areas, cut
// off at obtuse angles): what the tensors are to be weighted with. 0 where no face of positive area is incident.
struct Curvature_field
{
  std::vector<Vector> normals;
  std::vector<Curvature_tensor> tensors;
  std::vector<double> areas;
};

// The parts of a face that are nearest to each of its corners: from the barycentric coordinates of the circumcentre,
// cut off where that is outside (Meyer et al., "Discrete differential-geometry operators for triangulated 2-manifolds",
// 2003). Edge i is opposite to corner i, none is null.
inline std::array<double, 3> nearest_parts(const std::array<Vector, 3>& edge, double area)
{
  std::array<double, 3> length2, dot, part; // dot: of the two edges at a corner, away from it
  for (std::size_t i = 0; i < 3; ++i) {
    length2[i] = edge[i].squaredNorm();
    dot[i] = -edge[(i + 1) % 3].dot(edge[(i + 2) % 3]);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (dot[i] > 0) continue;
    // dot[j] = length2[k] - dot[i], a sum of positive numbers: the dot product itself can be rounded to 0 on a needle.
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    part[j] = 0.25 * area * length2[k] / (length2[k] - dot[i]);
    part[k] = 0.25 * area * length2[j] / (length2[j] - dot[i]);
    part[i] = area - part[j] - part[k];
    return part;
  }
  const std::array<double, 3> b = {length2[0] * dot[0], length2[1] * dot[1], length2[2] * dot[2]};
  const double scale = 0.5 * area / (b[0] + b[1] + b[2]);
  return {scale * (b[1] + b[2]), scale * (b[2] + b[0]), scale * (b[0] + b[1])};
}

// The curvature tensors of a mesh whose vertices have the given unit normals.
// S. Rusinkiewicz, "Estimating curvatures and their derivatives on triangle meshes", 3DPVT 2004, section 3: on each
// face the second fundamental form that explains the differences of the normals along the three edges best (least
// squares, equation 6), rotated into the tangent plane of each corner and averaged there by corner areas. Linear time.
// Faces without area and corners without a normal do not count. On a border the normals are one-sided and the tensors
// unreliable.
inline Curvature_field curvature_tensors(const Flat_mesh& mesh, std::vector<Vector> normals)
{
  Curvature_field field;
  field.tensors.resize(mesh.points.size());
  field.areas.assign(mesh.points.size(), 0.0);

  for (const auto& f : mesh.faces) {
    const std::array<std::size_t, 3> corner = {std::size_t(f[0]), std::size_t(f[1]), std::size_t(f[2])};
    // A normal is zero where faces cancel.
    if (normals[corner[0]].isZero(0) || normals[corner[1]].isZero(0) || normals[corner[2]].isZero(0)) continue;
    // Edge i is opposite to corner i.
    std::array<Vector, 3> edge = {mesh.points[corner[2]] - mesh.points[corner[1]],
                                  mesh.points[corner[0]] - mesh.points[corner[2]],
                                  mesh.points[corner[1]] - mesh.points[corner[0]]};
    // In units of the longest edge, as products of six lengths follow; along it, as least cancels there on a needle.
    const double length = (std::max)({edge[0].norm(), edge[1].norm(), edge[2].norm()});
    if (!(length > 0) || !std::isfinite(length)) continue;
    for (Vector& e : edge) e /= length;
    const Vector cross = edge[0].cross(edge[1]);
    const double double_area = cross.norm();
    if (!(double_area > 0)) continue;
    const Vector n = cross / double_area;
    const Vector u = std::max_element(edge.begin(), edge.end(), [](const Vector& e, const Vector& g) {
                       return e.squaredNorm() < g.squaredNorm();
                     })->normalized();
    const Vector v = n.cross(u);

    Second_fundamental_form_fit fit;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector dn = normals[corner[(i + 2) % 3]] - normals[corner[(i + 1) % 3]];
      fit.add(edge[i].dot(u), edge[i].dot(v), dn.dot(u), dn.dot(v));
    }
    // As the edges sum to zero, written so nothing cancels.
    const double minor = 3 * double_area * double_area;
    if (!std::isfinite(1 / (fit.trace() * minor))) continue;
    const Curvature_tensor form = fit.solved(minor) / length;

    const std::array<double, 3> part = nearest_parts(edge, 0.5 * double_area * length * length);
    for (std::size_t i = 0; i < 3; ++i) {
      Curvature_tensor rotated;
      if (!rotate_tensor(form, u, n, normals[corner[i]], rotated)) continue;
      field.tensors[corner[i]] += part[i] * rotated;
      field.areas[corner[i]] += part[i];
    }
  }
  for (std::size_t i = 0; i < field.tensors.size(); ++i)
    if (field.areas[i] > 0) field.tensors[i] = field.tensors[i] / field.areas[i];
  field.normals = std::move(normals);
  return field;
}

inline Curvature_field curvature_tensors(const Flat_mesh& mesh)
{
  return curvature_tensors(mesh, vertex_normals(mesh));
}

// Averages of the tensors of a field over the vertices around a vertex. At the resolution of a scan the curvature is
// mostly noise; its average over a neighbourhood is what another scan of the surface shows, too.
class Curvature_average
{
public:
  // The arguments are kept by reference. `borders`: flags as of border_flags().
  Curvature_average(const Flat_mesh& mesh, const Index_lists& neighbours, const Curvature_field& field,
                    const std::vector<std::uint8_t>& borders)
      : m_mesh(mesh), m_neighbours(neighbours), m_field(field), m_borders(borders), m_seen_from(mesh.points.size(), -1)
  {}

  struct Result
  {
    Curvature_tensor tensor; // in the Tangent_frame of the vertex's normal
    double radius = 0;       // of the neighbourhood that was used, 0 for an isolated vertex
  };

  // The average over the vertices that are connected to `vertex` inside the ball of the given radius around it,
  // weighted by area and by 1 - (distance / radius)^2. The neighbourhood ends at the nearest border vertex, where the
  // tensors become one-sided, but not below half the radius: there it takes what lies inside the border, and the border
  // itself only where there is nothing else. The cost is proportional to the number of vertices in the ball.
  Result operator()(std::size_t vertex, double radius)
  {
    const Vector& centre = m_mesh.points[vertex];
    m_found.clear();
    m_found.push_back({std::int32_t(vertex), 0.0});
    m_seen_from[vertex] = std::int32_t(vertex);
    double border_distance2 = radius * radius;
    for (std::size_t i = 0; i < m_found.size(); ++i) {
      const auto [w, distance2] = m_found[i];
      if (m_borders[std::size_t(w)]) border_distance2 = (std::min)(border_distance2, distance2);
      for (const std::int32_t* x = m_neighbours.begin(std::size_t(w)); x != m_neighbours.end(std::size_t(w)); ++x) {
        if (m_seen_from[std::size_t(*x)] == std::int32_t(vertex)) continue;
        m_seen_from[std::size_t(*x)] = std::int32_t(vertex);
        const double d2 = (m_mesh.points[std::size_t(*x)] - centre).squaredNorm();
        if (d2 < radius * radius) m_found.push_back({*x, d2});
      }
    }
    // A vertex is found once a call; without this a second call for it would find nothing.
    for (const Found& found : m_found) m_seen_from[std::size_t(found.vertex)] = -1;

    const double end2 = (std::max)(border_distance2, 0.25 * radius * radius);
    Result result;
    if (!sum(vertex, end2, false, result.tensor) && !sum(vertex, end2, true, result.tensor)) {
      result.tensor = m_field.tensors[vertex];
      return result;
    }
    result.radius = std::sqrt(end2);
    return result;
  }

private:
  struct Found
  {
    std::int32_t vertex;
    double distance2;
  };

  bool sum(std::size_t vertex, double end2, bool with_borders, Curvature_tensor& average) const
  {
    const Vector& normal = m_field.normals[vertex];
    Curvature_tensor total;
    double weights = 0;
    for (const Found& found : m_found) {
      const auto w = std::size_t(found.vertex);
      if (found.distance2 >= end2 || (m_borders[w] && !with_borders)) continue;
      const double weight = m_field.areas[w] * (1 - found.distance2 / end2);
      Curvature_tensor rotated;
      if (!(weight > 0) ||
          !rotate_tensor(m_field.tensors[w], Tangent_frame(m_field.normals[w]).u, m_field.normals[w], normal, rotated))
        continue;
      total += weight * rotated;
      weights += weight;
    }
    if (!(weights > 0)) return false;
    average = total / weights;
    return true;
  }

  const Flat_mesh& m_mesh;
  const Index_lists& m_neighbours;
  const Curvature_field& m_field;
  const std::vector<std::uint8_t>& m_borders;
  std::vector<std::int32_t> m_seen_from;
  std::vector<Found> m_found;
};

// The averages at all vertices.
inline std::vector<Curvature_tensor> average_tensors(const Flat_mesh& mesh, const Curvature_field& field, double radius)
{
  const Index_lists neighbours = neighbours_of_vertices(mesh);
  const std::vector<std::uint8_t> borders = border_flags(mesh);
  Curvature_average average(mesh, neighbours, field, borders);
  std::vector<Curvature_tensor> tensors(mesh.points.size());
  for (std::size_t i = 0; i < tensors.size(); ++i) tensors[i] = average(i, radius).tensor;
  return tensors;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_CURVATURE_TENSORS_H
