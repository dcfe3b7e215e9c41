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

#ifndef CGAL_CRUDE_REGISTRATION_REDUCTION_SIMPLIFY_SCAN_H
#define CGAL_CRUDE_REGISTRATION_REDUCTION_SIMPLIFY_SCAN_H

#include <CGAL/Crude_registration/reduction/approximation_error.h>
#include <CGAL/Crude_registration/internal/mesh/to_flat_mesh.h>
#include <CGAL/Crude_registration/named_parameters.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh_simplification/Edge_collapse_visitor_base.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_plane_policies.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <cstddef>
#include <limits>
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

  // A vertex all of whose faces have no area has no plane, which the policies do not allow for: it gets the mean of the
  // squared distances to all planes through it, with the weight of one plane.
  template <class Point_map>
  void initialize(const Triangle_mesh& mesh, const Point_map point_map, const Geom_traits& traits) const
  {
    Base::initialize(mesh, point_map, traits);
    for (auto v : vertices(mesh)) {
      if (number_of_planes(v) > 0) continue;
      const auto& p = get(point_map, v);
      typename Base::Mat_4 quadric = Base::Mat_4::Identity();
      quadric.row(3) << -p.x(), -p.y(), -p.z(), p.x() * p.x() + p.y() * p.y() + p.z() * p.z();
      quadric.col(3) = quadric.row(3).transpose().eval();
      put(this->vcm(), v, quadric / 3);
    }
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

private:
  template <class Vertex>
  typename Geom_traits::FT number_of_planes(Vertex v) const
  {
    const auto& quadric = get(this->vcm(), v);
    return quadric(0, 0) + quadric(1, 1) + quadric(2, 2);
  }
};

template <class Triangle_mesh, class Point_map, class Geom_traits>
struct Collapse_counter : Surface_mesh_simplification::Edge_collapse_visitor_base<Triangle_mesh, Point_map, Geom_traits>
{
  using Base = Surface_mesh_simplification::Edge_collapse_visitor_base<Triangle_mesh, Point_map, Geom_traits>;

  // The visitor is copied.
  explicit Collapse_counter(std::size_t& counter) : vertices_left(&counter) {}

  void OnCollapsed(const typename Base::Profile&, const typename Base::vertex_descriptor&) { --*vertices_left; }

  std::size_t* vertices_left;
};

struct Simplification_stop
{
  double mean_squared_distance;
  std::size_t number_of_vertices;
  const std::size_t* vertices_left;

  template <class FT, class Profile>
  bool operator()(const FT& cost, const Profile&, std::size_t, std::size_t) const
  {
    return cost > mean_squared_distance || *vertices_left <= number_of_vertices;
  }
};

} // namespace internal

/*!
 * \ingroup PkgCrudeRegistrationRef
 *
 * \brief simplifies the mesh of a scan to the few vertices that registration works with.
 *
 * Edges are collapsed by `CGAL::Surface_mesh_simplification::edge_collapse()` with the quadrics of Garland and Heckbert
 * (`GarlandHeckbert_plane_policies`), in the order of the *mean* squared distance of the new vertex to the planes of
 * the faces of `mesh` that it stands for. This is how the paper's approximation error \f$ \epsilon \f$, a squared
 * length, is to be read: compared with the sum of the squared distances, which is what the policies return, it leaves
 * twenty times the number of vertices that the paper reports. Borders have no cost of their own (discontinuity
 * multiplier 0): where a scan ends says nothing about the surface. Collapses that turn a face over are left out
 * (`Bounded_normal_change_filter`).
 *
 * The simplification stops as soon as the next collapse would cost more than `approximation_error` or
 * `number_of_vertices` are left. If neither is given, `approximation_error(mesh, np)` is used.
 *
 * Vertices without a face are removed. The computations are done in `double`, in coordinates relative to the centre of
 * the mesh's bounding box, whatever the mesh's kernel; vertices that take part in no collapse keep their coordinates.
 * As after any use of `edge_collapse()`, removed elements of a `Surface_mesh` stay until `collect_garbage()` is called.
 * The time is that of `edge_collapse()`, n log n in the number of edges.
 *
 * \tparam TriangleMesh a model of `MutableFaceGraph` and `HalfedgeListGraph`
 * \tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"
 *
 * \param mesh the mesh, changed in place
 * \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below
 *
 * \cgalNamedParamsBegin
 *   \cgalParamNBegin{vertex_point_map}
 *     \cgalParamDescription{a property map associating points to the vertices of `mesh`}
 *     \cgalParamType{a class model of `ReadWritePropertyMap` with
 *                    `boost::graph_traits<TriangleMesh>::%vertex_descriptor` as key type and a `Point_3` as value
 *                    type}
 *     \cgalParamDefault{`get(CGAL::vertex_point, mesh)`}
 *   \cgalParamNEnd
 *   \cgalParamNBegin{approximation_error}
 *     \cgalParamDescription{the largest mean squared distance of a collapse, a squared length}
 *     \cgalParamType{`double`, zero or above}
 *     \cgalParamDefault{`approximation_error(mesh, np)` if `number_of_vertices` is not given either, else no limit}
 *     \cgalParamExtra{the parameters of that function are read, too}
 *   \cgalParamNEnd
 *   \cgalParamNBegin{number_of_vertices}
 *     \cgalParamDescription{the number of vertices to stop at}
 *     \cgalParamType{an integer}
 *     \cgalParamDefault{`0`}
 *   \cgalParamNEnd
 * \cgalNamedParamsEnd
 *
 * \return the number of vertices left
 *
 * \throws std::invalid_argument if a face of `mesh` is not a triangle, a coordinate is not finite, or a parameter is
 * out of its range.
 */
template <class TriangleMesh, class NamedParameters = parameters::Default_named_parameters>
std::size_t simplify_scan(TriangleMesh& mesh, const NamedParameters& np = parameters::default_values())
{
  namespace SMS = CGAL::Surface_mesh_simplification;
  using internal::is_given;
  using Kernel = CGAL::Simple_cartesian<double>;
  using Point = Kernel::Point_3;
  using Local_map = typename boost::property_map<TriangleMesh, CGAL::dynamic_vertex_property_t<Point>>::type;

  const internal::Flat_mesh flat = internal::to_flat_mesh(mesh, np, "simplify_scan", "mesh");
  constexpr bool has_number = is_given<NamedParameters, internal_np::number_of_vertices_t>;
  constexpr bool has_error = is_given<NamedParameters, internal_np::approximation_error_t>;
  std::size_t vertices_left = 0;
  internal::Simplification_stop stop;
  stop.vertices_left = &vertices_left;
  stop.number_of_vertices = internal::count_parameter(np, internal_np::number_of_vertices, std::size_t(0), 0,
                                                      "simplify_scan", "number_of_vertices");
  stop.mean_squared_distance = (std::numeric_limits<double>::max)();
  if constexpr (has_error)
    stop.mean_squared_distance = internal::non_negative_parameter(np, internal_np::approximation_error, 0.0,
                                                                  "simplify_scan", "approximation_error");
  else if constexpr (!has_number) stop.mean_squared_distance = internal::approximation_error(flat, np, "simplify_scan");

  // Far from the origin the quadrics of the original coordinates would lose the distances to rounding.
  const internal::Vector centre = internal::centre_of_box(flat.points);
  const auto point_map = internal::mutable_vertex_point_map(mesh, np);
  Local_map local_map = get(CGAL::dynamic_vertex_property_t<Point>(), mesh);
  std::vector<typename boost::graph_traits<TriangleMesh>::vertex_descriptor> isolated;
  std::size_t i = 0;
  for (auto v : vertices(mesh)) {
    const internal::Vector p = flat.points[i++] - centre;
    put(local_map, v, Point(p.x(), p.y(), p.z()));
    if (halfedge(v, mesh) == boost::graph_traits<TriangleMesh>::null_halfedge()) isolated.push_back(v);
  }
  for (auto v : isolated) remove_vertex(v, mesh);
  vertices_left = flat.points.size() - isolated.size();

  const internal::Mean_squared_distance_policies<TriangleMesh, Kernel> policies(mesh);
  SMS::edge_collapse(mesh, stop,
                     CGAL::parameters::vertex_point_map(local_map)
                         .geom_traits(Kernel())
                         .get_cost(policies.get_cost())
                         .get_placement(policies.get_placement())
                         .filter(SMS::Bounded_normal_change_filter<>())
                         .visitor(internal::Collapse_counter<TriangleMesh, Local_map, Kernel>(vertices_left)));

  using Target_point = typename boost::property_traits<std::decay_t<decltype(point_map)>>::value_type;
  for (auto v : vertices(mesh)) {
    const Point& p = get(local_map, v);
    const auto& q = get(point_map, v);
    // What `p` was before.
    const internal::Vector before = internal::Vector(to_double(q.x()), to_double(q.y()), to_double(q.z())) - centre;
    if (p != Point(before.x(), before.y(), before.z()))
      put(point_map, v, Target_point(p.x() + centre.x(), p.y() + centre.y(), p.z() + centre.z()));
  }
  return vertices_left;
}

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_REDUCTION_SIMPLIFY_SCAN_H
