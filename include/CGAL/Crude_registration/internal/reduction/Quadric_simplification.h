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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_QUADRIC_SIMPLIFICATION_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_QUADRIC_SIMPLIFICATION_H

#include <CGAL/Crude_registration/internal/mesh/mesh_geometry.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The sum of the squared distances of a point to a number of planes (Garland and Heckbert 1997): x^T A x + 2 b^T x + c.
// Each plane counts once whatever the area of its face, as in CGAL's plane policies; then weight = trace(A) is the
// number of planes and value(x) / weight the mean squared distance.
struct Plane_quadric
{
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0; // A
  double x = 0, y = 0, z = 0;                            // b
  double c = 0;
  double weight = 0;

  Plane_quadric() = default;

  // The plane of unit normal n through p.
  Plane_quadric(const Vector& n, const Vector& p)
      : xx(n.x() * n.x()), xy(n.x() * n.y()), xz(n.x() * n.z()), yy(n.y() * n.y()), yz(n.y() * n.z()),
        zz(n.z() * n.z()), weight(1)
  {
    const double d = -n.dot(p);
    x = d * n.x();
    y = d * n.y();
    z = d * n.z();
    c = d * d;
  }

  void add(const Plane_quadric& q, double times = 1)
  {
    xx += times * q.xx;
    xy += times * q.xy;
    xz += times * q.xz;
    yy += times * q.yy;
    yz += times * q.yz;
    zz += times * q.zz;
    x += times * q.x;
    y += times * q.y;
    z += times * q.z;
    c += times * q.c;
    weight += times * q.weight;
  }

  // The minimiser p of value(p) + stiffness * weight * |p - anchor|^2: the point of least distance to the planes in the
  // directions that the planes determine, the anchor's in the others. Relative to the planes' own weight, so the unit
  // of length does not matter, and never further from the anchor than the anchor's own distance to the planes (root
  // mean square) over sqrt(stiffness).
  struct Optimum
  {
    Vector position;
    double mean_squared_distance;
  };

  Optimum optimum_near(const Vector& anchor, double stiffness) const
  {
    if (!(weight > 0)) return {anchor, 0};
    const double inverse_weight = 1 / weight, s = stiffness * weight;
    // g = A anchor + b, half the gradient; then (A + s I) step = -g, by the adjugate: the condition is at most
    // 1 + 1 / stiffness.
    const Vector g(xx * anchor.x() + xy * anchor.y() + xz * anchor.z() + x,
                   xy * anchor.x() + yy * anchor.y() + yz * anchor.z() + y,
                   xz * anchor.x() + yz * anchor.y() + zz * anchor.z() + z);
    const double m00 = xx + s, m11 = yy + s, m22 = zz + s;
    const double a00 = m11 * m22 - yz * yz, a01 = xz * yz - xy * m22, a02 = xy * yz - xz * m11,
                 a11 = m00 * m22 - xz * xz, a12 = xy * xz - m00 * yz, a22 = m00 * m11 - xy * xy;
    const double scale = -1 / (m00 * a00 + xy * a01 + xz * a02);
    const Vector step = scale * Vector(a00 * g.x() + a01 * g.y() + a02 * g.z(), a01 * g.x() + a11 * g.y() + a12 * g.z(),
                                       a02 * g.x() + a12 * g.y() + a22 * g.z());
    // value(anchor + step) = value(anchor) + 2 g.step + step.A step, where A step = -g - s step.
    const double value = (g + Vector(x, y, z)).dot(anchor) + c + g.dot(step) - s * step.squaredNorm();
    return {anchor + step, (std::max)(value, 0.0) * inverse_weight};
  }
};

// A state of a simplification. `normals`: unit, the sums of the area vectors of the original faces that each vertex
// stands for. `borders`: as of border_flags(). `nearest_group`: the vertex of the mesh that the simplification started
// from (see Quadric_simplification::group_of_vertex()) that is nearest to each vertex among those merged into it.
struct Simplified_mesh
{
  Flat_mesh mesh;
  std::vector<Vector> normals;
  std::vector<std::uint8_t> borders;
  std::vector<std::int32_t> nearest_group;
};

// Simplification of a dense mesh by grouping and edge collapse with plane quadrics, the fast counterpart of
// simplify_scan(): the vertices of one connected piece of mesh in one cell of a grid are merged first, their quadrics
// summed, so that the cost of every later collapse still is the mean squared distance to the planes of the original
// faces.
//
// Grouping is linear in the size of the dense mesh, about 0.2 microseconds a vertex; the collapse n log n in the number
// of groups, 2 microseconds a collapse as long as the groups fit into the cache. Cells of 3 to 4 sampling distances
// leave a tenth of the vertices of a scan; of scans of millions of samples larger ones are better: some ten groups for
// each vertex wanted in the end are enough. The result depends on the frame of the coordinates only by the grid, whose
// cells meet at the origin, and on the order of the vertices only by rounding and where costs tie.
class Quadric_simplification
{
public:
  // Groups the vertices of `dense` in cubes of edge length `cell`; with cell = 0 every vertex is a group of its own.
  // A group all of whose faces vanish is dropped.
  Quadric_simplification(const Flat_mesh& dense, double cell)
  {
    choose_origin(dense);
    const std::int32_t number_of_groups = cell > 0 ? group_by_cell(dense, cell) : group_by_vertex(dense);
    merge_groups(dense, number_of_groups);
    place_groups(cell);
    link_faces();
    collect_edges();
  }

  // For each vertex of the dense mesh its vertex in mesh() before the first collapse; -1 where it was dropped or has no
  // face.
  const std::vector<std::int32_t>& group_of_vertex() const { return m_group_of_vertex; }
  std::int32_t number_of_groups() const { return std::int32_t(m_vertices.size()); }
  std::int32_t number_of_vertices() const { return m_number_of_vertices; }
  // The largest mean squared distance of a collapse so far.
  double error() const { return m_error; }

  // Collapses edges in the order of their cost until `number` vertices are left or no edge can be collapsed.
  void collapse_to_number(std::int32_t number)
  {
    collapse_while([&](double) { return m_number_of_vertices > number; });
  }

  // Collapses edges in the order of their cost while it is at most `mean_squared_distance`.
  void collapse_to_error(double mean_squared_distance)
  {
    collapse_while([&](double cost) { return cost <= mean_squared_distance; });
  }

  Simplified_mesh mesh() const
  {
    Simplified_mesh result;
    std::vector<std::int32_t> index(m_vertices.size(), -1);
    for (std::size_t i = 0; i < m_vertices.size(); ++i) {
      if (m_parents[i] != std::int32_t(i)) continue;
      index[i] = std::int32_t(result.mesh.points.size());
      result.mesh.points.push_back(m_origin + m_vertices[i].position);
      result.normals.push_back(unit_or_zero(m_vertices[i].normal));
    }
    for (const auto& f : m_faces)
      if (f[0] >= 0)
        result.mesh.faces.push_back({index[std::size_t(f[0])], index[std::size_t(f[1])], index[std::size_t(f[2])]});
    result.borders = border_flags(result.mesh);

    result.nearest_group.assign(result.mesh.points.size(), -1);
    std::vector<double> distance2(result.mesh.points.size(), (std::numeric_limits<double>::max)());
    for (std::size_t i = 0; i < m_vertices.size(); ++i) {
      std::size_t root = i;
      while (m_parents[root] != std::int32_t(root)) root = std::size_t(m_parents[root]);
      const auto j = std::size_t(index[root]);
      const double d2 = (m_group_positions[i] - m_vertices[root].position).squaredNorm();
      if (d2 < distance2[j]) {
        distance2[j] = d2;
        result.nearest_group[j] = std::int32_t(i);
      }
    }
    return result;
  }

private:
  // How strongly a placement is held at the centroid of what the vertex stands for, relative to the planes. Below the
  // square of the angles (in radians) by which scan noise tilts faces, the planes of a smooth region would move the
  // vertex along the surface by their noise alone.
  static constexpr double stiffness = 1e-2;
  // Where costs are equal up to rounding (flat regions) short edges go first: a tilt of the planes by a milliradian.
  static constexpr double tilt2 = 1e-6;

  struct Vertex
  {
    Plane_quadric quadric;
    Vector position = Vector::Zero();
    Vector normal = Vector::Zero();   // sum of area vectors
    Vector centroid = Vector::Zero(); // times area
    double area = 0;

    void add(const Vertex& v)
    {
      quadric.add(v.quadric);
      normal += v.normal;
      centroid += v.centroid;
      area += v.area;
    }
  };

  // An edge is out of date when one of its vertices has changed since, which the sum of their versions says: a version
  // grows with each change, and that of a vertex that is gone is below all sums.
  struct Edge
  {
    std::int32_t a, b; // a < b
    std::int32_t version;
  };

  // A priority queue of edges by key, ties by number: a heap of arity four. An entry is the key's bits, as a float
  // (those of numbers >= 0 are ordered like the numbers), and the number of the edge: what comes next is found without
  // a branch.
  class Queue
  {
  public:
    bool empty() const { return m_entries.empty(); }
    std::size_t top() const { return std::size_t(m_entries.front() & 0xffffffffu); }

    void push(double key, std::size_t edge)
    {
      const float rounded = float(key);
      std::uint32_t bits;
      std::memcpy(&bits, &rounded, sizeof bits);
      m_entries.push_back(0);
      rise(m_entries.size() - 1, std::uint64_t(bits) << 32 | std::uint64_t(edge));
    }

    void pop()
    {
      const std::uint64_t last = m_entries.back();
      m_entries.pop_back();
      const std::size_t n = m_entries.size();
      if (n == 0) return;
      // The hole goes to the bottom, where the last entry most likely belongs.
      std::uint64_t* const e = m_entries.data();
      std::size_t hole = 0, child = 1;
      for (; child + 3 < n; child = 4 * hole + 1) {
        const std::size_t i = child + std::size_t(e[child + 1] < e[child]),
                          j = child + 2 + std::size_t(e[child + 3] < e[child + 2]), least = e[j] < e[i] ? j : i;
        e[hole] = e[least];
        hole = least;
      }
      if (child < n) {
        const std::size_t least = std::size_t(std::min_element(e + child, e + n) - e);
        e[hole] = e[least];
        hole = least;
      }
      rise(hole, last);
    }

  private:
    void rise(std::size_t hole, std::uint64_t entry)
    {
      while (hole > 0 && entry < m_entries[(hole - 1) / 4]) {
        m_entries[hole] = m_entries[(hole - 1) / 4];
        hole = (hole - 1) / 4;
      }
      m_entries[hole] = entry;
    }

    std::vector<std::uint64_t> m_entries;
  };

  void choose_origin(const Flat_mesh& dense)
  {
    Vector low = Vector::Constant((std::numeric_limits<double>::max)()), high = -low;
    for (const auto& p : dense.points) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    if (dense.points.empty()) return;
    m_origin = 0.5 * low + 0.5 * high;
    const double size2 = (high - low).squaredNorm();
    m_key_unit = size2 > 0 ? 1 / size2 : 1;
  }

  std::int32_t group_by_vertex(const Flat_mesh& dense)
  {
    m_group_of_vertex.resize(dense.points.size());
    for (std::size_t i = 0; i < dense.points.size(); ++i) m_group_of_vertex[i] = std::int32_t(i);
    return std::int32_t(dense.points.size());
  }

  // One axis of a cell. Scans are never 2^20 cells wide; what is further out (a spike) goes to the outermost cells.
  static std::uint64_t cell_coordinate(double x, double inverse)
  {
    constexpr double limit = 1 << 20;
    const double t = (std::min)((std::max)(x * inverse, -limit), limit - 1);
    const auto i = std::int64_t(t);
    return std::uint64_t(i - std::int64_t(t < double(i)) + (1 << 20));
  }

  // Groups = connected components of the mesh inside each cell, numbered by cell, then by first vertex, so that sheets
  // that only pass near each other stay apart.
  std::int32_t group_by_cell(const Flat_mesh& dense, double cell_size)
  {
    const std::size_t n = dense.points.size();
    // Cells in the order of their first vertex, by open addressing.
    std::vector<std::pair<std::uint64_t, std::int32_t>> cells; // coordinates, number
    std::vector<std::int32_t> cell_of_vertex(n), table(1024, -1);
    std::size_t mask = table.size() - 1;
    const auto slot_of = [&](std::uint64_t c) {
      std::size_t slot = std::size_t((c * 0x9e3779b97f4a7c15u) >> 32) & mask;
      while (table[slot] >= 0 && cells[std::size_t(table[slot])].first != c) slot = (slot + 1) & mask;
      return slot;
    };
    const double inverse = 1 / cell_size;
    for (std::size_t i = 0; i < n; ++i) {
      const Vector& p = dense.points[i];
      const std::uint64_t c = cell_coordinate(p.x(), inverse) << 42 | cell_coordinate(p.y(), inverse) << 21 |
                              cell_coordinate(p.z(), inverse);
      std::size_t slot = slot_of(c);
      if (table[slot] < 0) {
        table[slot] = std::int32_t(cells.size());
        cells.push_back({c, std::int32_t(cells.size())});
        if (2 * cells.size() > table.size()) {
          table.assign(4 * table.size(), -1);
          mask = table.size() - 1;
          for (const auto& cell : cells) table[slot_of(cell.first)] = cell.second;
          slot = slot_of(c);
        }
      }
      cell_of_vertex[i] = table[slot];
    }

    // Components by union-find; the root of a component is its first vertex.
    std::vector<std::int32_t>& root = m_group_of_vertex;
    root.resize(n);
    for (std::size_t i = 0; i < n; ++i) root[i] = std::int32_t(i);
    const auto find = [&](std::int32_t i) {
      while (root[std::size_t(i)] != i) {
        root[std::size_t(i)] = root[std::size_t(root[std::size_t(i)])];
        i = root[std::size_t(i)];
      }
      return i;
    };
    const auto join = [&](std::int32_t i, std::int32_t j) {
      if (root[std::size_t(i)] == root[std::size_t(j)]) return;
      i = find(i);
      j = find(j);
      root[std::size_t((std::max)(i, j))] = (std::min)(i, j);
    };
    for (const auto& f : dense.faces) {
      const std::int32_t a = cell_of_vertex[std::size_t(f[0])], b = cell_of_vertex[std::size_t(f[1])],
                         c = cell_of_vertex[std::size_t(f[2])];
      if (a == b) join(f[0], f[1]);
      if (b == c) join(f[1], f[2]);
      if (c == a && a != b) join(f[2], f[0]);
    }

    // Counting sort of the roots by cell.
    std::sort(cells.begin(), cells.end());
    std::vector<std::int32_t> rank(cells.size()), next_group(cells.size() + 1, 0);
    for (std::size_t i = 0; i < cells.size(); ++i) rank[std::size_t(cells[i].second)] = std::int32_t(i);
    for (std::size_t i = 0; i < n; ++i) {
      cell_of_vertex[i] = rank[std::size_t(cell_of_vertex[i])];
      if (root[i] == std::int32_t(i)) ++next_group[std::size_t(cell_of_vertex[i]) + 1];
    }
    for (std::size_t i = 1; i < next_group.size(); ++i) next_group[i] += next_group[i - 1];
    const std::int32_t number_of_groups = next_group.back();
    // A root comes first in its component: when a vertex is reached, the group of its root is known.
    std::vector<std::int32_t>& group = cell_of_vertex;
    for (std::size_t i = 0; i < n; ++i)
      group[i] =
          root[i] == std::int32_t(i) ? next_group[std::size_t(group[i])]++ : group[std::size_t(find(std::int32_t(i)))];
    m_group_of_vertex = std::move(group);
    return number_of_groups;
  }

  // Sums quadrics, normals and centroids over the faces, makes the grouped mesh's faces and drops groups without one.
  void merge_groups(const Flat_mesh& dense, std::int32_t number_of_groups)
  {
    std::vector<Vertex>& groups = m_vertices;
    groups.resize(std::size_t(number_of_groups));
    std::vector<std::array<std::int32_t, 3>> faces;
    for (const auto& f : dense.faces) {
      const Vector p0 = dense.points[std::size_t(f[0])] - m_origin, p1 = dense.points[std::size_t(f[1])] - m_origin,
                   p2 = dense.points[std::size_t(f[2])] - m_origin;
      const Vector normal = area_vector(p0, p1, p2);
      const double area = normal.norm();
      std::int32_t a = m_group_of_vertex[std::size_t(f[0])], b = m_group_of_vertex[std::size_t(f[1])],
                   c = m_group_of_vertex[std::size_t(f[2])];
      if (area > 0 && std::isfinite(area)) {
        const Plane_quadric quadric(normal / area, p0);
        const auto add = [&](std::int32_t group, double times, const Vector& points) {
          Vertex& v = groups[std::size_t(group)];
          v.quadric.add(quadric, times);
          v.normal += times * normal;
          v.centroid += area * points;
          v.area += times * area;
        };
        if (a == b && b == c) add(a, 3, p0 + p1 + p2);
        else if (a == b) {
          add(a, 2, p0 + p1);
          add(c, 1, p2);
        } else if (b == c) {
          add(b, 2, p1 + p2);
          add(a, 1, p0);
        } else if (c == a) {
          add(c, 2, p2 + p0);
          add(b, 1, p1);
        } else {
          add(a, 1, p0);
          add(b, 1, p1);
          add(c, 1, p2);
        }
      }
      if (a == b || b == c || c == a) continue;
      // The smallest index first, the orientation kept.
      while (a > b || a > c) {
        std::swap(a, b);
        std::swap(b, c);
      }
      faces.push_back({a, b, c});
    }
    unite_faces(number_of_groups, faces);

    std::vector<std::int32_t> index(groups.size(), -1);
    for (const auto& f : m_faces)
      for (std::int32_t v : f) index[std::size_t(v)] = 0;
    for (std::size_t i = 0; i < groups.size(); ++i)
      if (index[i] == 0) {
        index[i] = m_number_of_vertices++;
        groups[std::size_t(index[i])] = groups[i];
      }
    groups.resize(std::size_t(m_number_of_vertices));
    for (auto& f : m_faces)
      for (std::int32_t& v : f) v = index[std::size_t(v)];
    for (std::int32_t& v : m_group_of_vertex) v = index[std::size_t(v)];
  }

  // Each face once. Where a face occurs in both orientations, the more frequent one stays; a flat fold has none.
  void unite_faces(std::int32_t number_of_groups, const std::vector<std::array<std::int32_t, 3>>& faces)
  {
    using Face = std::array<std::int32_t, 3>;
    // By first vertex (counting), then by the two others, whichever comes first.
    std::vector<std::int64_t> offsets(std::size_t(number_of_groups) + 1, 0);
    for (const Face& f : faces) ++offsets[std::size_t(f[0]) + 1];
    for (std::size_t i = 1; i < offsets.size(); ++i) offsets[i] += offsets[i - 1];
    std::vector<Face> sorted(faces.size());
    {
      std::vector<std::int64_t> next(offsets.begin(), offsets.end() - 1);
      for (const Face& f : faces) sorted[std::size_t(next[std::size_t(f[0])]++)] = f;
    }
    const auto key = [](const Face& f) { return std::make_pair((std::min)(f[1], f[2]), (std::max)(f[1], f[2])); };
    for (std::size_t i = 0; i + 1 < offsets.size(); ++i) {
      const auto first = sorted.begin() + offsets[i], last = sorted.begin() + offsets[i + 1];
      std::sort(first, last, [&](const Face& f, const Face& g) { return key(f) < key(g); });
      for (auto it = first; it != last;) {
        const auto k = key(*it);
        int balance = 0;
        for (; it != last && key(*it) == k; ++it) balance += (*it)[1] < (*it)[2] ? 1 : -1;
        if (balance > 0) m_faces.push_back({std::int32_t(i), k.first, k.second});
        if (balance < 0) m_faces.push_back({std::int32_t(i), k.second, k.first});
      }
    }
  }

  static Plane_quadric::Optimum placement(const Plane_quadric& quadric, const Vector& centroid, double area)
  {
    return quadric.optimum_near(area > 0 ? Vector((1 / area) * centroid) : centroid, stiffness);
  }

  void place_groups(double cell)
  {
    m_parents.resize(m_vertices.size());
    m_group_positions.resize(m_vertices.size());
    for (std::size_t i = 0; i < m_vertices.size(); ++i) {
      Vertex& v = m_vertices[i];
      v.position = placement(v.quadric, v.centroid, v.area).position;
      if (v.area > 0 && cell > 0) {
        const Vector centroid = v.centroid / v.area, shift = v.position - centroid;
        const double length = shift.norm();
        if (length > cell) v.position = centroid + (cell / length) * shift;
      }
      m_parents[i] = std::int32_t(i);
      m_group_positions[i] = v.position;
    }
  }

  // The faces at each vertex as lists of corners (3 * face + place) that can be joined.
  void link_faces()
  {
    m_first_corner.assign(m_vertices.size(), -1);
    m_next_corner.assign(3 * m_faces.size(), -1);
    for (std::size_t i = m_next_corner.size(); i-- > 0;) {
      std::int32_t& first = m_first_corner[std::size_t(m_faces[i / 3][i % 3])];
      m_next_corner[i] = first;
      first = std::int32_t(i);
    }
    m_versions.assign(m_vertices.size(), 0);
    m_star_a.count.assign(m_vertices.size(), 0);
    m_star_b.count.assign(m_vertices.size(), 0);
  }

  void collect_edges()
  {
    for (std::size_t i = 0; i < m_vertices.size(); ++i) {
      gather(std::int32_t(i), m_star_a);
      for (std::int32_t j : m_star_a.neighbours)
        if (j > std::int32_t(i)) push_edge(std::int32_t(i), j);
      clear(m_star_a);
    }
  }

  // Where the vertex that replaces a and b goes, and what it costs.
  Plane_quadric::Optimum target(std::int32_t a, std::int32_t b) const
  {
    const Vertex &v = m_vertices[std::size_t(a)], &w = m_vertices[std::size_t(b)];
    Plane_quadric quadric = v.quadric;
    quadric.add(w.quadric);
    return placement(quadric, v.centroid + w.centroid, v.area + w.area);
  }

  void push_edge(std::int32_t a, std::int32_t b)
  {
    const double tie =
        tilt2 * (m_vertices[std::size_t(a)].position - m_vertices[std::size_t(b)].position).squaredNorm();
    m_queue.push(m_key_unit * (target(a, b).mean_squared_distance + tie), m_edges.size());
    m_edges.push_back({(std::min)(a, b), (std::max)(a, b), m_versions[std::size_t(a)] + m_versions[std::size_t(b)]});
  }

  // The faces at a vertex, its neighbours and, for each neighbour, the number of faces at the common edge.
  struct Star
  {
    std::vector<std::int32_t> faces, neighbours;
    std::vector<std::int32_t> count;

    // An edge with other than two faces.
    bool on_border() const
    {
      return std::any_of(neighbours.begin(), neighbours.end(),
                         [&](std::int32_t v) { return count[std::size_t(v)] != 2; });
    }
  };

  void gather(std::int32_t vertex, Star& star) const
  {
    star.faces.clear();
    star.neighbours.clear();
    for (std::int32_t c = m_first_corner[std::size_t(vertex)]; c >= 0; c = m_next_corner[std::size_t(c)]) {
      const auto& f = m_faces[std::size_t(c / 3)];
      if (f[0] < 0) continue;
      star.faces.push_back(c / 3);
      for (std::int32_t v : f)
        if (v != vertex && star.count[std::size_t(v)]++ == 0) star.neighbours.push_back(v);
    }
  }

  static void clear(Star& star)
  {
    for (std::int32_t v : star.neighbours) star.count[std::size_t(v)] = 0;
  }

  // The collapse keeps the mesh a mesh: CGAL's rules for edge_collapse(), on any set of triangles.
  bool is_collapse_valid(std::int32_t a, std::int32_t b) const
  {
    const std::int32_t number_of_faces = m_star_a.count[std::size_t(b)];
    if (number_of_faces == 0) return false;
    // Link condition (Dey et al. 1999): every common neighbour makes a face with a and b ...
    std::int32_t common = 0;
    for (std::int32_t v : m_star_b.neighbours) common += std::int32_t(v != a && m_star_a.count[std::size_t(v)] > 0);
    if (common != number_of_faces) return false;
    // ... two parts of the border do not meet ...
    if (number_of_faces == 2 && m_star_a.on_border() && m_star_b.on_border()) return false;
    for (std::int32_t f : m_star_b.faces) {
      std::array<std::int32_t, 2> others;
      std::size_t k = 0;
      bool shared = false;
      for (std::int32_t v : m_faces[std::size_t(f)]) {
        shared = shared || v == a;
        if (v != a && v != b && k < 2) others[k++] = v;
      }
      if (shared) {
        // ... no vertex loses its last face ...
        if (m_star_a.count[std::size_t(others[0])] == 1 && m_star_b.count[std::size_t(others[0])] == 1) return false;
      } else if (m_star_a.count[std::size_t(others[0])] > 0 && m_star_a.count[std::size_t(others[1])] > 0) {
        // ... and no face comes to lie on another.
        for (std::int32_t g : m_star_a.faces) {
          int n = 0;
          for (std::int32_t v : m_faces[std::size_t(g)]) n += int(v == others[0] || v == others[1]);
          if (n == 2) return false;
        }
      }
    }
    return true;
  }

  // No face that stays turns over.
  bool keeps_orientation(std::int32_t a, std::int32_t b, const Star& star, const Vector& position) const
  {
    for (std::int32_t f : star.faces) {
      const auto& face = m_faces[std::size_t(f)];
      std::array<Vector, 3> moved;
      int n = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const bool moves = face[k] == a || face[k] == b;
        n += int(moves);
        moved[k] = moves ? position : m_vertices[std::size_t(face[k])].position;
      }
      if (n == 2) continue;
      const Vector before =
          area_vector(m_vertices[std::size_t(face[0])].position, m_vertices[std::size_t(face[1])].position,
                      m_vertices[std::size_t(face[2])].position);
      if (!(before.dot(area_vector(moved[0], moved[1], moved[2])) > 0)) return false;
    }
    return true;
  }

  // Merges b into a.
  void merge(std::int32_t a, std::int32_t b, const Vector& position)
  {
    Vertex& v = m_vertices[std::size_t(a)];
    v.add(m_vertices[std::size_t(b)]);
    v.position = position;
    m_parents[std::size_t(b)] = a;
    ++m_versions[std::size_t(a)];
    m_versions[std::size_t(b)] = (std::numeric_limits<std::int32_t>::min)() / 2;
    --m_number_of_vertices;

    std::int32_t* link = &m_first_corner[std::size_t(a)];
    const auto append = [&](std::int32_t f, std::int32_t vertex) {
      auto& face = m_faces[std::size_t(f)];
      for (std::size_t k = 0; k < 3; ++k)
        if (face[k] == vertex) {
          face[k] = a;
          *link = 3 * f + std::int32_t(k);
          link = &m_next_corner[std::size_t(*link)];
        }
    };
    for (std::int32_t f : m_star_b.faces) {
      auto& face = m_faces[std::size_t(f)];
      if (face[0] == a || face[1] == a || face[2] == a) face = {-1, -1, -1};
      else append(f, b);
    }
    for (std::int32_t f : m_star_a.faces)
      if (m_faces[std::size_t(f)][0] >= 0) append(f, a);
    *link = -1;
    m_first_corner[std::size_t(b)] = -1;
  }

  template <class Predicate>
  void collapse_while(const Predicate& go_on)
  {
    while (!m_queue.empty()) {
      const Edge e = m_edges[m_queue.top()];
      const bool current = m_versions[std::size_t(e.a)] + m_versions[std::size_t(e.b)] == e.version;
      if (!current) {
        m_queue.pop();
        continue;
      }
      const Plane_quadric::Optimum t = target(e.a, e.b);
      if (!go_on(t.mean_squared_distance)) return;
      m_queue.pop();

      gather(e.a, m_star_a);
      gather(e.b, m_star_b);
      if (is_collapse_valid(e.a, e.b) && keeps_orientation(e.a, e.b, m_star_a, t.position) &&
          keeps_orientation(e.a, e.b, m_star_b, t.position)) {
        m_error = (std::max)(m_error, t.mean_squared_distance);
        merge(e.a, e.b, t.position);
        for (std::int32_t v : m_star_a.neighbours)
          if (v != e.b) push_edge(e.a, v);
        for (std::int32_t v : m_star_b.neighbours)
          if (v != e.a && m_star_a.count[std::size_t(v)] == 0) push_edge(e.a, v);
      }
      clear(m_star_a);
      clear(m_star_b);
    }
  }

  Vector m_origin = Vector::Zero();
  double m_key_unit = 1; // 1 / (size of the mesh)^2: keys do not depend on the unit of length
  std::vector<std::int32_t> m_group_of_vertex;
  std::vector<Vector> m_group_positions;
  std::vector<Vertex> m_vertices;
  std::vector<std::int32_t> m_parents, m_versions;
  std::vector<std::array<std::int32_t, 3>> m_faces; // a face that is gone starts with -1
  std::vector<std::int32_t> m_first_corner, m_next_corner;
  std::vector<Edge> m_edges;
  Queue m_queue;
  Star m_star_a, m_star_b;
  std::int32_t m_number_of_vertices = 0;
  double m_error = 0;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_QUADRIC_SIMPLIFICATION_H
