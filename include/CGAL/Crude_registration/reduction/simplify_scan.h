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

// Simplification of a scan's mesh to the vertices that registration works with.

#include <CGAL/Crude_registration/internal/mesh/add_flat_mesh.h>
#include <CGAL/Crude_registration/internal/mesh/mesh_geometry.h>
#include <CGAL/Crude_registration/internal/mesh/to_flat_mesh.h>
#include <CGAL/Crude_registration/internal/reduction/collapse_edges.h>
#include <CGAL/Crude_registration/internal/reduction/simplify_by_groups.h>
#include <CGAL/Crude_registration/named_parameters.h>
#include <CGAL/Crude_registration/reduction/approximation_error.h>

#include <CGAL/Simple_cartesian.h>

#include <cstddef>
#include <limits>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Crude_registration {
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
 * With `cell_size` the vertices of each connected piece of `mesh` inside a cell of a grid are grouped into one vertex
 * first, with the sum of their quadrics: the cost of a collapse still is the mean squared distance to the planes of the
 * faces of `mesh`. Groups unite to larger ones where the mean squared distance of one vertex to the planes of all is at
 * most half of `approximation_error` (not if a number of vertices is given), and no piece of the surface is cut off by
 * it. The grid moves along with the scan. Where the groups are no manifold, a face of an edge of three is left out and
 * a vertex where parts of the surface touch is repeated for each of them. Pieces of the surface within one or two cells
 * vanish, closed surfaces stay closed. What `mesh` holds is replaced: a `vertex_point_map` has to take the vertices
 * that are added then, as the property maps of a mesh do, and other property maps get no values.
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
 *   \cgalParamNBegin{cell_size}
 *     \cgalParamDescription{the edge length of the cells in which vertices are grouped before the collapse}
 *     \cgalParamType{`double`, a length, zero or above}
 *     \cgalParamDefault{`0`: no grouping}
 *     \cgalParamExtra{cells of three to four sampling distances leave about as many vertices as no grouping, in a
 *                      fraction of the time}
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
  using internal::is_given;
  using Point = CGAL::Simple_cartesian<double>::Point_3;
  using Local_map = typename boost::property_map<TriangleMesh, CGAL::dynamic_vertex_property_t<Point>>::type;

  const internal::Flat_mesh flat = internal::to_flat_mesh(mesh, np, "simplify_scan", "mesh");
  constexpr bool has_number = is_given<NamedParameters, internal_np::number_of_vertices_t>;
  constexpr bool has_error = is_given<NamedParameters, internal_np::approximation_error_t>;
  internal::Simplification_limits limits;
  limits.number_of_vertices = internal::count_parameter(np, internal_np::number_of_vertices, std::size_t(0), 0,
                                                        "simplify_scan", "number_of_vertices");
  limits.mean_squared_distance = (std::numeric_limits<double>::max)();
  if constexpr (has_error)
    limits.mean_squared_distance = internal::non_negative_parameter(np, internal_np::approximation_error, 0.0,
                                                                    "simplify_scan", "approximation_error");
  else if constexpr (!has_number)
    limits.mean_squared_distance = internal::approximation_error(flat, np, "simplify_scan");
  if constexpr (is_given<NamedParameters, internal_np::cell_size_t>) {
    const double cell = internal::non_negative_parameter(np, internal_np::cell_size, 0.0, "simplify_scan", "cell_size");
    if (cell > 0) {
      const internal::Flat_mesh simplified = internal::simplify_by_groups(flat, cell, limits);
      internal::remove_all_elements(mesh);
      internal::add_flat_mesh(simplified, mesh, np);
      return simplified.points.size();
    }
  }

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
  const internal::Mean_squared_distance_policies<TriangleMesh, CGAL::Simple_cartesian<double>> policies(mesh);
  const std::size_t vertices_left =
      internal::collapse_edges(mesh, local_map, flat.points.size() - isolated.size(), limits, policies);

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
