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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_COLLAPSE_EDGES_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_COLLAPSE_EDGES_H

// CGAL's edge collapse by the mean squared distance to the planes of the original faces.

#include <CGAL/Crude_registration/internal/base/Run_control.h>
#include <CGAL/Crude_registration/internal/reduction/Plane_quadric.h>
#include <CGAL/Crude_registration/internal/reduction/Simplification_limits.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh_simplification/Edge_collapse_visitor_base.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_plane_policies.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <cstddef>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// CGAL's plane policies with the cost divided by the number of planes it sums the squared distances to: the mean
// squared distance of the new vertex to the planes of the faces that it stands for. A plane of unit normal n adds n n^T
// to the quadric, of trace 1. Without a term for the border (discontinuity multiplier 0) the trace of the left upper 3
// x 3 block is the number of planes. No state besides the quadrics, which the copies that edge_collapse() makes of its
// policies share.
template <class Triangle_mesh, class Geom_traits>
class Mean_squared_distance_policies
    : public Surface_mesh_simplification::GarlandHeckbert_plane_policies<Triangle_mesh, Geom_traits>
{
  using Base = Surface_mesh_simplification::GarlandHeckbert_plane_policies<Triangle_mesh, Geom_traits>;

public:
  using Get_cost = Mean_squared_distance_policies;
  using Get_placement = Mean_squared_distance_policies;

  explicit Mean_squared_distance_policies(Triangle_mesh& mesh) : Base(mesh, 0) {}

  const Get_cost& get_cost() const { return *this; }
  const Get_placement& get_placement() const { return *this; }

  template <class Point_map>
  void initialize(const Triangle_mesh& mesh, const Point_map point_map, const Geom_traits& traits) const
  {
    Base::initialize(mesh, point_map, traits);
    replace_empty_quadrics(mesh, point_map);
  }

  // Placement.
  template <class Profile>
  decltype(auto) operator()(const Profile& profile) const
  {
    return Base::operator()(profile);
  }

  // Cost. The optional types are boost's in CGAL 5 and the standard's in CGAL 6.
  template <class Profile, class Optional_point>
  auto operator()(const Profile& profile, const Optional_point& placement) const
  {
    auto cost = Base::operator()(profile, placement);
    const auto planes = number_of_planes(profile.v0()) + number_of_planes(profile.v1());
    if (cost && planes > 0) *cost /= planes;
    return cost;
  }

protected:
  // A vertex all of whose faces have no area has no plane, which the policies do not allow for: it gets the mean of the
  // squared distances to all planes through it, with the weight of one plane.
  template <class Point_map>
  void replace_empty_quadrics(const Triangle_mesh& mesh, const Point_map point_map) const
  {
    for (auto v : vertices(mesh)) {
      if (number_of_planes(v) > 0) continue;
      const auto& p = get(point_map, v);
      typename Base::Mat_4 quadric = Base::Mat_4::Identity();
      quadric.row(3) << -p.x(), -p.y(), -p.z(), p.x() * p.x() + p.y() * p.y() + p.z() * p.z();
      quadric.col(3) = quadric.row(3).transpose().eval();
      put(this->vcm(), v, quadric / 3);
    }
  }

  template <class Vertex>
  typename Geom_traits::FT number_of_planes(Vertex v) const
  {
    const auto& quadric = get(this->vcm(), v);
    return quadric(0, 0) + quadric(1, 1) + quadric(2, 2);
  }
};

// The same where the quadrics are sums that are given, one for each vertex in the order of the vertices. In the
// directions that the planes do not determine, a new vertex is where the two were in the mean over the planes: sums
// over smooth regions are close to singular, and the point of least cost alone would be anywhere in them.
template <class Triangle_mesh, class Geom_traits>
class Given_quadrics_policies : public Mean_squared_distance_policies<Triangle_mesh, Geom_traits>
{
  using Base = Mean_squared_distance_policies<Triangle_mesh, Geom_traits>;

public:
  using Get_cost = Given_quadrics_policies;
  using Get_placement = Given_quadrics_policies;

  Given_quadrics_policies(Triangle_mesh& mesh, const std::vector<Plane_quadric>& quadrics)
      : Base(mesh), m_quadrics(&quadrics)
  {}

  const Get_cost& get_cost() const { return *this; }
  const Get_placement& get_placement() const { return *this; }

  template <class Point_map>
  void initialize(const Triangle_mesh& mesh, const Point_map point_map, const Geom_traits&) const
  {
    auto q = m_quadrics->begin();
    typename Base::Mat_4 matrix;
    for (auto v : vertices(mesh)) {
      matrix << q->xx, q->xy, q->xz, q->x, q->xy, q->yy, q->yz, q->y, q->xz, q->yz, q->zz, q->z, q->x, q->y, q->z, q->c;
      put(this->vcm(), v, matrix);
      ++q;
    }
    this->replace_empty_quadrics(mesh, point_map);
  }

  // Placement.
  template <class Profile>
  auto operator()(const Profile& profile) const
  {
    const Plane_quadric q0 = quadric(profile.v0()), q1 = quadric(profile.v1());
    Plane_quadric sum = q0;
    sum.add(q1);
    const auto &p0 = profile.p0(), &p1 = profile.p1();
    const Vector mean =
        (q0.weight * Vector(p0.x(), p0.y(), p0.z()) + q1.weight * Vector(p1.x(), p1.y(), p1.z())) / sum.weight;
    const Vector p = sum.optimum_near(mean).position;
    return std::decay_t<decltype(Base::operator()(profile))>(typename Geom_traits::Point_3(p.x(), p.y(), p.z()));
  }

  // Cost.
  template <class Profile, class Optional_point>
  auto operator()(const Profile& profile, const Optional_point& placement) const
  {
    return Base::operator()(profile, placement);
  }

private:
  template <class Vertex>
  Plane_quadric quadric(Vertex v) const
  {
    const auto& m = get(this->vcm(), v);
    Plane_quadric q;
    q.xx = m(0, 0);
    q.xy = m(0, 1);
    q.xz = m(0, 2);
    q.yy = m(1, 1);
    q.yz = m(1, 2);
    q.zz = m(2, 2);
    q.x = m(0, 3);
    q.y = m(1, 3);
    q.z = m(2, 3);
    q.c = m(3, 3);
    q.weight = this->number_of_planes(v);
    return q;
  }

  const std::vector<Plane_quadric>* m_quadrics;
};

template <class Triangle_mesh, class Point_map, class Geom_traits>
struct Collapse_counter : Surface_mesh_simplification::Edge_collapse_visitor_base<Triangle_mesh, Point_map, Geom_traits>
{
  using Base = Surface_mesh_simplification::Edge_collapse_visitor_base<Triangle_mesh, Point_map, Geom_traits>;

  // The visitor is copied.
  Collapse_counter(std::size_t& counter, Run_control& run) : vertices_left(&counter), control(&run) {}

  // \throws Run_control::Stopped
  template <class Optional_cost>
  void OnCollected(const typename Base::Profile&, const Optional_cost&)
  {
    control->check(++edges);
  }

  // \throws Run_control::Stopped
  void OnCollapsed(const typename Base::Profile&, const typename Base::vertex_descriptor&)
  {
    control->check(--*vertices_left);
  }

  std::size_t* vertices_left;
  Run_control* control;
  std::size_t edges = 0;
};

struct Simplification_stop
{
  Simplification_limits limits;
  const std::size_t* vertices_left;

  template <class FT, class Profile>
  bool operator()(const FT& cost, const Profile&, std::size_t, std::size_t) const
  {
    return cost > limits.mean_squared_distance || *vertices_left <= limits.number_of_vertices;
  }
};

// Collapses edges in the order of their cost up to the limits; collapses that turn a face over are left out. Returns
// how many of the `number_of_vertices` vertices are left.
template <class Triangle_mesh, class Point_map, class Policies>
std::size_t collapse_edges(Triangle_mesh& mesh, const Point_map& point_map, std::size_t number_of_vertices,
                           const Simplification_limits& limits, const Policies& policies)
{
  namespace SMS = CGAL::Surface_mesh_simplification;
  using Kernel = CGAL::Simple_cartesian<double>;
  std::size_t vertices_left = number_of_vertices;
  SMS::edge_collapse(mesh, Simplification_stop{limits, &vertices_left},
                     CGAL::parameters::vertex_point_map(point_map)
                         .geom_traits(Kernel())
                         .get_cost(policies.get_cost())
                         .get_placement(policies.get_placement())
                         .filter(SMS::Bounded_normal_change_filter<>())
                         .visitor(Collapse_counter<Triangle_mesh, Point_map, Kernel>(vertices_left, *limits.control)));
  return vertices_left;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_COLLAPSE_EDGES_H
