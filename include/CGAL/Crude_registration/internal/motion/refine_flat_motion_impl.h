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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_REFINE_FLAT_MOTION_IMPL_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_REFINE_FLAT_MOTION_IMPL_H

// The refinement of a motion, with the target's vertices in a Kd tree of CGAL.

#include <CGAL/Crude_registration/internal/mesh/mesh_geometry.h>
#include <CGAL/Crude_registration/internal/motion/point_to_plane.h>
#include <CGAL/Crude_registration/internal/motion/refine_flat_motion.h>

#include <CGAL/Kd_tree.h>
#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/Search_traits_adapter.h>
#include <CGAL/Simple_cartesian.h>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The vertices of a mesh in a Kd tree of CGAL, as a target of Point_to_plane.
class Vertex_tree
{
  using Kernel = Simple_cartesian<double>;
  using Point = Kernel::Point_3;

  struct Point_map
  {
    using key_type = std::int32_t;
    using value_type = Point;
    using reference = const Point&;
    using category = boost::lvalue_property_map_tag;
    const std::vector<Point>* points;

    const Point& operator[](key_type i) const { return (*points)[std::size_t(i)]; }
    friend const Point& get(const Point_map& map, key_type i) { return map[i]; }
  };

  using Traits_3 = Search_traits_3<Kernel>;
  using Traits = Search_traits_adapter<std::int32_t, Point_map, Traits_3>;
  using Search = Orthogonal_k_neighbor_search<Traits>;

public:
  explicit Vertex_tree(const Flat_mesh& mesh)
      : m_normals(vertex_normals(mesh)), m_is_border(border_flags(mesh)), m_points(to_points(mesh.points)),
        m_distance(Point_map{&m_points}), m_tree(Search::Splitter(), Traits(Point_map{&m_points}))
  {
    for (std::size_t i = 0; i < m_points.size(); ++i)
      if (!m_normals[i].isZero()) m_tree.insert(std::int32_t(i));
    if (!m_tree.empty()) m_tree.build();
  }

  Vertex_tree(const Vertex_tree&) = delete;
  Vertex_tree& operator=(const Vertex_tree&) = delete;

  bool empty() const { return m_tree.empty(); }

  bool closest(const Vector& query, double reach, Surface_point& answer) const
  {
    const Search search(m_tree, Point(query.x(), query.y(), query.z()), 1, 0, true, m_distance);
    if (search.begin() == search.end() || !(search.begin()->second <= reach * reach)) return false;
    const std::size_t i = std::size_t(search.begin()->first);
    answer = {Vector(m_points[i].x(), m_points[i].y(), m_points[i].z()), m_normals[i], m_is_border[i] != 0};
    return true;
  }

private:
  static std::vector<Point> to_points(const std::vector<Vector>& vectors)
  {
    std::vector<Point> points;
    points.reserve(vectors.size());
    for (const Vector& v : vectors) points.emplace_back(v.x(), v.y(), v.z());
    return points;
  }

  std::vector<Vector> m_normals;
  std::vector<std::uint8_t> m_is_border;
  std::vector<Point> m_points;
  typename Search::Distance m_distance;
  typename Search::Tree m_tree;
};

CGAL_CRUDE_REGISTRATION_INLINE double rms_radius(const std::vector<Vector>& points)
{
  if (points.empty()) return 0;
  Vector mean = Vector::Zero();
  for (const Vector& p : points) mean += (p - points.front()) / double(points.size());
  mean += points.front();
  double sum = 0;
  for (const Vector& p : points) sum += (p - mean).squaredNorm() / double(points.size());
  return std::sqrt(sum);
}

CGAL_CRUDE_REGISTRATION_INLINE Matrix nearest_rotation(const Matrix& matrix)
{
  const Eigen::JacobiSVD<Matrix> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

CGAL_CRUDE_REGISTRATION_INLINE Refinement refine_flat_motion(const Flat_mesh& source, const Flat_mesh& target,
                                                             const Rigid_motion& initial,
                                                             const Refinement_options& options, Execution execution)
{
  const std::vector<Vector> normals = vertex_normals(source);
  const Vertex_tree tree(target);
  if (std::all_of(normals.begin(), normals.end(), [](const Vector& n) { return n.isZero(); }))
    throw std::invalid_argument("refine_motion: source has no face with an area");
  if (tree.empty()) throw std::invalid_argument("refine_motion: target has no face with an area");
  return Point_to_plane<Vertex_tree>(source.points, normals, tree, options, execution)(initial);
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MOTION_REFINE_FLAT_MOTION_IMPL_H
