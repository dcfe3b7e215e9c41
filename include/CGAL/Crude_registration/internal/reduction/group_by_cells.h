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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_GROUP_BY_CELLS_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_GROUP_BY_CELLS_H

// Groups the vertices of a dense mesh by cells of a grid and sums their plane quadrics, so that an edge collapse that
// starts from the groups still measures distances to the planes of the dense mesh.

#include <CGAL/Crude_registration/internal/base/Run_control.h>
#include <CGAL/Crude_registration/internal/mesh/Flat_mesh.h>
#include <CGAL/Crude_registration/internal/mesh/flat_mesh_repair.h>
#include <CGAL/Crude_registration/internal/mesh/mesh_geometry.h>
#include <CGAL/Crude_registration/internal/reduction/Plane_quadric.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

struct Grouped_mesh
{
  Flat_mesh mesh;                      // manifold; its first vertices are the groups, the others copies of some
  std::vector<Plane_quadric> quadrics; // of each vertex: the planes of the dense faces at the vertices of its group
  // For each vertex of the dense mesh its group; -1 where that was dropped or the vertex has no face.
  std::vector<std::int32_t> group_of_vertex;
};

// The steps of group_by_cells().
//
// A group is a connected piece of the mesh inside one cell, so that sheets that only pass near each other stay apart.
// Its quadric counts the plane of a face once for each of the face's corners in the group: the sum of the quadrics that
// the vertices have in CGAL's plane policies.
class Cell_grouping
{
public:
  Cell_grouping(const Flat_mesh& dense, double cell) : m_cell(cell)
  {
    group_vertices(dense);
    sum_quadrics(dense);
    relabel(dense.faces, m_group_of_vertex, m_groups.size());
  }

  // Unites the groups of each connected piece of the mesh in a cell of twice the size where the mean squared distance
  // of one vertex to all their planes is at most `error`, its faces are one fan and no neighbour loses its last face:
  // no piece of the surface vanishes, and none is cut off that hung together by more than a vertex. Groups that do not
  // fit into one stay as they are for good. Says whether there are fewer groups now.
  bool unite(double error)
  {
    const std::size_t n = m_groups.size();
    for (Group& g : m_groups) g.cell = cell_of_twice_the_size(g.cell);
    Pieces pieces(n);
    const auto join = [&](std::int32_t i, std::int32_t j) {
      const Group &a = m_groups[std::size_t(i)], &b = m_groups[std::size_t(j)];
      if (a.cell == b.cell && a.may_unite && b.may_unite) pieces.join(i, j);
    };
    for (const Face& f : m_mesh.faces) {
      join(f[0], f[1]);
      join(f[1], f[2]);
      join(f[2], f[0]);
    }
    // The sums are those of the roots.
    std::vector<Group> sums = m_groups;
    std::vector<std::size_t> roots(n);
    std::vector<bool> has_others(n, false), is_one(n, false);
    for (std::size_t i = 0; i < n; ++i) {
      roots[i] = pieces.root(i);
      if (roots[i] == i) continue;
      sums[roots[i]].add(m_groups[i]);
      has_others[roots[i]] = true;
    }
    for (std::size_t i = 0; i < n; ++i)
      is_one[i] = roots[i] == i && m_groups[i].may_unite && sums[i].optimum().mean_squared_distance <= error;

    const std::vector<Face> faces = std::move(m_mesh.faces);
    std::vector<std::int32_t> index(n);
    std::size_t number = 0;
    for (bool is_tried = false; !is_tried;) {
      number = 0;
      for (std::size_t i = 0; i < n; ++i) // a root comes first in its piece
        index[i] = is_one[roots[i]] && roots[i] != i ? index[roots[i]] : std::int32_t(number++);
      relabel(faces, index, number);
      is_tried = true;
      const auto dissolve = [&](std::size_t root) {
        if (!is_one[root] || !has_others[root]) return;
        is_one[root] = false;
        is_tried = false;
      };
      const Index_lists faces_of_groups = faces_of_vertices(m_mesh);
      for (std::size_t i = 0; i < n; ++i)
        if (is_one[i] && has_others[i] && !has_one_fan(faces_of_groups, index[i])) dissolve(i);
      for (const Face& f : faces)
        for (std::int32_t v : f) {
          const auto group = std::size_t(index[std::size_t(v)]);
          if (faces_of_groups.begin(group) != faces_of_groups.end(group)) continue;
          for (std::int32_t w : f) dissolve(roots[std::size_t(w)]);
        }
    }
    std::vector<Group> united;
    united.reserve(number);
    for (std::size_t i = 0; i < n; ++i) {
      const bool is_united = is_one[roots[i]];
      if (is_united && roots[i] != i) continue;
      united.push_back(is_united ? sums[i] : m_groups[i]);
      united.back().may_unite = is_united;
    }
    m_groups = std::move(united);
    for (std::int32_t& group : m_group_of_vertex) group = index[std::size_t(group)];
    return number < n;
  }

  // Leaves out what keeps the mesh from being a manifold, and groups without a face.
  Grouped_mesh grouped_mesh()
  {
    Grouped_mesh result;
    keep_manifold_edges(m_mesh);
    std::vector<std::int32_t> index(m_groups.size(), -1);
    for (const auto& f : m_mesh.faces)
      for (std::int32_t v : f) index[std::size_t(v)] = 0;
    for (std::size_t i = 0; i < m_groups.size(); ++i) {
      if (index[i] < 0) continue;
      index[i] = std::int32_t(result.quadrics.size());
      result.quadrics.push_back(m_groups[i].quadric);
      result.mesh.points.push_back(m_groups[i].position(m_cell));
    }
    result.mesh.faces = std::move(m_mesh.faces);
    for (auto& f : result.mesh.faces)
      for (std::int32_t& v : f) v = index[std::size_t(v)];
    result.group_of_vertex = std::move(m_group_of_vertex);
    for (std::int32_t& v : result.group_of_vertex) v = index[std::size_t(v)];

    for (std::int32_t original : split_non_manifold_vertices(result.mesh)) {
      const Plane_quadric quadric = result.quadrics[std::size_t(original)];
      result.quadrics.push_back(quadric);
    }
    return result;
  }

private:
  using Face = std::array<std::int32_t, 3>;

  struct Group
  {
    Vector first_point = Vector::Zero();
    Plane_quadric quadric;
    Vector centroid = Vector::Zero(); // of the faces' corners in the group, times area
    double area = 0;
    std::uint64_t cell = 0;
    bool may_unite = true;

    void add(const Group& group)
    {
      quadric.add(group.quadric);
      centroid += group.centroid;
      area += group.area;
    }

    Plane_quadric::Optimum optimum() const { return quadric.optimum_near(mean_point()); }

    // Not further from the centroid than a cell's edge.
    Vector position(double cell_size) const
    {
      const Vector shift = optimum().position - mean_point();
      const double length = shift.norm();
      return length > cell_size ? Vector(mean_point() + (cell_size / length) * shift) : Vector(mean_point() + shift);
    }

  private:
    Vector mean_point() const { return area > 0 ? Vector(centroid / area) : first_point; }
  };

  // Connected pieces by union-find; the root of a piece is its first element.
  class Pieces
  {
  public:
    explicit Pieces(std::size_t n) : m_parents(n)
    {
      for (std::size_t i = 0; i < n; ++i) m_parents[i] = std::int32_t(i);
    }

    std::size_t root(std::size_t i)
    {
      while (std::size_t(m_parents[i]) != i) {
        m_parents[i] = m_parents[std::size_t(m_parents[i])];
        i = std::size_t(m_parents[i]);
      }
      return i;
    }

    void join(std::int32_t i, std::int32_t j)
    {
      if (m_parents[std::size_t(i)] == m_parents[std::size_t(j)]) return;
      const std::size_t a = root(std::size_t(i)), b = root(std::size_t(j));
      m_parents[(std::max)(a, b)] = std::int32_t((std::min)(a, b));
    }

  private:
    std::vector<std::int32_t> m_parents;
  };

  // A cell's three coordinates, 21 bits each. Scans are never 2^20 cells wide; what is further out (a spike) goes to
  // the outermost cells.
  static constexpr int bits = 21;

  static std::uint64_t cell_coordinate(double x, double inverse)
  {
    constexpr double limit = 1 << (bits - 1);
    const double t = (std::min)((std::max)(x * inverse, -limit), limit - 1);
    const auto i = std::int64_t(t);
    return std::uint64_t(i - std::int64_t(t < double(i)) + (1 << (bits - 1)));
  }

  static std::uint64_t cell_of_twice_the_size(std::uint64_t cell)
  {
    constexpr std::uint64_t lowest = 1 | std::uint64_t(1) << bits | std::uint64_t(1) << (2 * bits);
    return (cell & ~lowest) >> 1;
  }

  void group_vertices(const Flat_mesh& dense)
  {
    const std::size_t n = dense.points.size();
    const double inverse = (std::min)(1 / m_cell, (std::numeric_limits<double>::max)());
    std::vector<std::uint64_t> cells(n);
    for (std::size_t i = 0; i < n; ++i) {
      const Vector& p = dense.points[i];
      cells[i] = cell_coordinate(p.x(), inverse) << (2 * bits) | cell_coordinate(p.y(), inverse) << bits |
                 cell_coordinate(p.z(), inverse);
    }
    Pieces pieces(n);
    for (const Face& f : dense.faces) {
      const std::uint64_t a = cells[std::size_t(f[0])], b = cells[std::size_t(f[1])], c = cells[std::size_t(f[2])];
      if (a == b) pieces.join(f[0], f[1]);
      if (b == c) pieces.join(f[1], f[2]);
      if (c == a && a != b) pieces.join(f[2], f[0]);
    }
    // Numbered by cell, then by first vertex.
    std::vector<std::pair<std::uint64_t, std::int32_t>> roots;
    for (std::size_t i = 0; i < n; ++i)
      if (pieces.root(i) == i) roots.push_back({cells[i], std::int32_t(i)});
    std::sort(roots.begin(), roots.end());
    m_groups.resize(roots.size());
    m_group_of_vertex.resize(n);
    for (std::size_t i = 0; i < roots.size(); ++i) {
      m_groups[i].cell = roots[i].first;
      m_groups[i].first_point = dense.points[std::size_t(roots[i].second)];
      m_group_of_vertex[std::size_t(roots[i].second)] = std::int32_t(i);
    }
    for (std::size_t i = 0; i < n; ++i) m_group_of_vertex[i] = m_group_of_vertex[pieces.root(i)];
  }

  void sum_quadrics(const Flat_mesh& dense)
  {
    for (const Face& f : dense.faces) {
      const Vector &p0 = dense.points[std::size_t(f[0])], &p1 = dense.points[std::size_t(f[1])],
                   &p2 = dense.points[std::size_t(f[2])];
      const Vector normal = area_vector(p0, p1, p2);
      const double area = normal.norm();
      if (!(area > 0) || !std::isfinite(area)) continue;
      const Plane_quadric quadric(normal / area, p0);
      const auto add = [&](std::int32_t group, double times, const Vector& points) {
        Group& g = m_groups[std::size_t(group)];
        g.quadric.add(quadric, times);
        g.centroid += area * points;
        g.area += times * area;
      };
      const std::int32_t a = m_group_of_vertex[std::size_t(f[0])], b = m_group_of_vertex[std::size_t(f[1])],
                         c = m_group_of_vertex[std::size_t(f[2])];
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
  }

  // Makes the faces of the grouped mesh from those of a finer one. Faces between fewer than three groups vanish; the
  // others are there once, each, in the more frequent orientation; flat folds have none.
  void relabel(const std::vector<Face>& fine, const std::vector<std::int32_t>& group, std::size_t number_of_groups)
  {
    // By first vertex, the smallest (counting), then by the two others, whichever comes first.
    std::vector<Face> faces;
    std::vector<std::size_t> ends(number_of_groups + 1, 0);
    for (const Face& f : fine) {
      std::int32_t a = group[std::size_t(f[0])], b = group[std::size_t(f[1])], c = group[std::size_t(f[2])];
      if (a == b || b == c || c == a) continue;
      while (a > b || a > c) {
        std::swap(a, b);
        std::swap(b, c);
      }
      faces.push_back({a, b, c});
      ++ends[std::size_t(a) + 1];
    }
    for (std::size_t i = 1; i < ends.size(); ++i) ends[i] += ends[i - 1];
    std::vector<Face> sorted(faces.size());
    for (const Face& f : faces) sorted[ends[std::size_t(f[0])]++] = f;
    const auto others = [](const Face& f) { return std::make_pair((std::min)(f[1], f[2]), (std::max)(f[1], f[2])); };
    m_mesh.faces.clear();
    m_mesh.points.resize(number_of_groups);
    std::size_t k = 0;
    for (std::size_t i = 0; i < number_of_groups; ++i) {
      std::sort(sorted.begin() + std::ptrdiff_t(k), sorted.begin() + std::ptrdiff_t(ends[i]),
                [&](const Face& f, const Face& g) { return others(f) < others(g); });
      while (k < ends[i]) {
        const auto face = others(sorted[k]);
        int balance = 0;
        for (; k < ends[i] && others(sorted[k]) == face; ++k) balance += sorted[k][1] == face.first ? 1 : -1;
        if (balance > 0) m_mesh.faces.push_back({std::int32_t(i), face.first, face.second});
        if (balance < 0) m_mesh.faces.push_back({std::int32_t(i), face.second, face.first});
      }
    }
  }

  bool has_one_fan(const Index_lists& faces_of_groups, std::int32_t group) const
  {
    std::vector<Corner> corners;
    for (const std::int32_t* i = faces_of_groups.begin(std::size_t(group));
         i != faces_of_groups.end(std::size_t(group)); ++i) {
      const Face& f = m_mesh.faces[std::size_t(*i)];
      const std::size_t k = f[0] == group ? 0 : f[1] == group ? 1 : 2;
      corners.push_back({3 * std::size_t(*i) + k, f[(k + 1) % 3], f[(k + 2) % 3]});
    }
    if (corners.empty()) return false;
    take_fan(corners);
    return corners.empty();
  }

  double m_cell;
  std::vector<Group> m_groups;
  std::vector<std::int32_t> m_group_of_vertex;
  Flat_mesh m_mesh; // of the groups; where its points lie is found at the end
};

// Groups the vertices of a dense mesh in cubes of edge length `cell`, which meet at the origin of the coordinates, near
// which the mesh should be (the quadrics lose the distances to rounding otherwise). Where one vertex has a mean squared
// distance of at most `error` to the planes of several groups, they unite, in cells of twice, four times ... the size,
// as long as none of the surface is lost or cut off by it.
//
// A group all of whose faces vanish in the first cells is dropped. Linear in the size of the mesh, but for sorting the
// groups. \throws Run_control::Stopped
inline Grouped_mesh group_by_cells(const Flat_mesh& dense, double cell, double error = 0,
                                   Run_control& control = to_the_end())
{
  control.check();
  Cell_grouping grouping(dense, cell);
  control.check();
  while (error > 0 && grouping.unite(error)) control.check();
  return grouping.grouped_mesh();
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_GROUP_BY_CELLS_H
