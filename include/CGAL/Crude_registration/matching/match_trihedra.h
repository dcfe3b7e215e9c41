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

// Searches a simplified mesh for what may correspond to the spatial trihedra of another one.

#include <CGAL/Crude_registration/internal/base/Flat_sensor.h>
#include <CGAL/Crude_registration/internal/matching/extents.h>
#include <CGAL/Crude_registration/internal/matching/flat_trihedra.h>
#include <CGAL/Crude_registration/internal/mesh/mesh_geometry.h>
#include <CGAL/Crude_registration/internal/mesh/to_flat_mesh.h>
#include <CGAL/Crude_registration/internal/reduction/Curvature_tensors.h>
#include <CGAL/Crude_registration/internal/reduction/measure_scan.h>
#include <CGAL/Crude_registration/matching/Spatial_trihedron.h>
#include <CGAL/Crude_registration/matching/spatial_trihedra.h>
#include <CGAL/Crude_registration/named_parameters.h>
#include <CGAL/Crude_registration/reduction/principal_curvatures.h>

#include <CGAL/Aff_transformation_3.h>
#include <CGAL/Kernel_traits.h>
#include <CGAL/number_utils.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

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

// The kernel that a parameter gives, or that of the points of a graph.
template <class Graph, class NamedParameters>
using Kernel_of_graph = std::remove_cv_t<std::remove_reference_t<decltype(parameter(
    std::declval<const NamedParameters&>(), internal_np::geom_traits,
    typename Kernel_traits<typename boost::property_traits<decltype(const_vertex_point_map(
        std::declval<const Graph&>(), std::declval<const NamedParameters&>()))>::value_type>::Kernel()))>>;

} // namespace internal

/*!
\ingroup PkgCrudeRegistrationRef

\brief a trihedron of the source and the four vertices of the target that may correspond to its own.

\tparam SourceVertex, TargetVertex the types of the vertices of the two meshes
\tparam Kernel a model of `Kernel`
*/
template <class SourceVertex, class TargetVertex, class Kernel>
struct Trihedron_match
{
  Spatial_trihedron<SourceVertex> source;      ///< \f$ V, v_1, v_2, v_3 \f$
  Spatial_trihedron<TargetVertex> target;      ///< \f$ C, c_1, c_2, c_3 \f$
  Aff_transformation_3<Kernel> transformation; ///< maps the source into the frame of the target: least squares
  double residual;                             ///< root mean square distance of the four pairs under it
};

/*!
\ingroup PkgCrudeRegistrationRef

\brief searches the vertices of a simplified mesh exhaustively for what may correspond to the spatial trihedra of
another one: section 6 of the paper.

For each trihedron of `source` (see `spatial_trihedra()`) every vertex of `target` is tried for \f$ V \f$, those on the
sphere around it for \f$ v_1 \f$, those on the circle at the distances of \f$ v_2 \f$ from both for \f$ v_2 \f$, and
those near \f$ p = x_2 + n_2 d \f$ for \f$ v_3 \f$: the place with the barycentric coordinates and the height that
\f$ v_3 \f$ has relative to the triangle \f$ V v_1 v_2 \f$. Corresponding vertices have similar minimal and maximal
curvatures. As curvatures alone leave many candidates to a scan's noise, their normals agree, too: those of the pair
\f$ (V, v_1) \f$ by their signed angles with the line between them, those of \f$ v_2 \f$ and \f$ v_3 \f$ by where the
vertices found before would turn them.

What makes a match rigid is decided exactly, on the coordinates as they are: the length of \f$ V v_1 \f$ differs from
that of its counterpart by at most the tolerance, the other five lengths by at most twice that; neither trihedron is
degenerate, and none is the mirror image of the other; and where \f$ v_3 \f$ is further than twice the tolerance from
the plane over an edge of the triangle its counterpart is on the same side of that edge.

\tparam SourceGraph, TargetGraph models of `FaceListGraph`
\tparam NamedParameters1, NamedParameters2 sequences of \ref bgl_namedparameters "Named Parameters"

\param source the \f$ S \f$-mesh, simplified
\param target the \f$ D \f$-mesh, simplified
\param np_source an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below
\param np_target an optional sequence of those among them that are read from both

\cgalNamedParamsBegin
  \cgalParamNBegin{vertex_point_map}
    \cgalParamDescription{a property map associating points to the vertices of the mesh; read from both}
    \cgalParamType{a class model of `ReadablePropertyMap` with `boost::graph_traits<Graph>::%vertex_descriptor` as key
                   type and a `Point_3` as value type}
    \cgalParamDefault{`boost::get(CGAL::vertex_point, graph)`}
  \cgalParamNEnd
  \cgalParamNBegin{vertex_normal_map}
    \cgalParamDescription{the normals of the vertices, of any length, best those of the dense mesh; read from both}
    \cgalParamType{a class model of `ReadablePropertyMap` with `boost::graph_traits<Graph>::%vertex_descriptor` as key
                   type and a `Vector_3` as value type}
    \cgalParamDefault{the normals of the simplified mesh}
    \cgalParamExtra{A vertex with a null normal takes no part.}
  \cgalParamNEnd
  \cgalParamNBegin{curvature_map}
    \cgalParamDescription{the curvatures of the vertices, best those of the dense mesh averaged over a neighbourhood;
                          read from both}
    \cgalParamType{a class model of `ReadablePropertyMap` with `boost::graph_traits<Graph>::%vertex_descriptor` as key
                   type and `Principal_curvatures` as value type}
    \cgalParamDefault{the curvatures of the simplified mesh}
  \cgalParamNEnd
  \cgalParamNBegin{minimum_extent}
    \cgalParamDescription{\f$ f_1 \f$: no arm is shorter than this share of the mean extent \f$ M \f$}
    \cgalParamType{`double`, zero or above}
    \cgalParamDefault{`0`}
  \cgalParamNEnd
  \cgalParamNBegin{maximum_extent}
    \cgalParamDescription{\f$ f_2 \f$: no arm is longer than this share of \f$ M \f$}
    \cgalParamType{`double`, above `minimum_extent`}
    \cgalParamDefault{`0.3`}
    \cgalParamExtra{About the share of the scan that the other one is expected to show.}
  \cgalParamNEnd
  \cgalParamNBegin{viewing_direction}
    \cgalParamDescription{the direction of the lines of sight, from the sensor into the scene, in which \f$ M \f$ is
                          measured, see `scan_extent()`}
    \cgalParamType{a `Vector_3`, not null}
    \cgalParamDefault{none: the frame is found from the mesh}
    \cgalParamExtra{excludes `viewpoint`}
  \cgalParamNEnd
  \cgalParamNBegin{viewpoint}
    \cgalParamDescription{the place of the sensor, instead of the direction}
    \cgalParamType{a `Point_3`}
    \cgalParamDefault{none}
    \cgalParamExtra{excludes `viewing_direction`}
  \cgalParamNEnd
  \cgalParamNBegin{tolerance}
    \cgalParamDescription{how far vertices that correspond may lie from the same place of the surface, a length}
    \cgalParamType{`double`, between 1e-5 and 1 times the mean extent of `source`}
    \cgalParamDefault{0.7 times the median edge length of `target`}
    \cgalParamExtra{Normals may differ by 15 degrees, curvatures by 0.15 divided by this tolerance.}
  \cgalParamNEnd
  \cgalParamNBegin{use_normals}
    \cgalParamDescription{whether normals take part in the comparison, beside curvatures. The paper compares curvatures
                          alone}
    \cgalParamType{`bool`}
    \cgalParamDefault{`true`}
  \cgalParamNEnd
  \cgalParamNBegin{geom_traits}
    \cgalParamDescription{the kernel of the transformations}
    \cgalParamType{a model of `Kernel`}
    \cgalParamDefault{that of the points of `source`}
  \cgalParamNEnd
\cgalNamedParamsEnd

\return the matches, `Trihedron_match` of the vertices of the two meshes, in a `std::vector` in the order of the
trihedra

\throws std::invalid_argument if a face of a mesh is not a triangle, a coordinate, normal or curvature is not finite,
`source` has fewer than four vertices off its border or `target` fewer than four vertices (those without a normal do not
count), the tolerance is not between 1e-5 and 1 times the mean extent of `source`, or not \f$ 0 \le f_1 < f_2 \f$.
*/
template <class SourceGraph, class TargetGraph, class NamedParameters1 = parameters::Default_named_parameters,
          class NamedParameters2 = parameters::Default_named_parameters>
auto match_trihedra(const SourceGraph& source, const TargetGraph& target,
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
  tolerances.angle = 15 * CGAL_PI / 180;
  tolerances.curvature = 0.15 / tolerances.length;
  tolerances.use_normals = internal::parameter(np_source, internal_np::use_normals, true);
  const std::vector<internal::Spatial_trihedron> trihedra =
      internal::spatial_trihedra(s.points, s.inside, internal::trihedron_options(shares, extent));

  const internal::Vertices_of<SourceGraph> source_vertices(source);
  const internal::Vertices_of<TargetGraph> target_vertices(target);
  using Kernel = internal::Kernel_of_graph<SourceGraph, NamedParameters1>;
  std::vector<Trihedron_match<typename boost::graph_traits<SourceGraph>::vertex_descriptor,
                              typename boost::graph_traits<TargetGraph>::vertex_descriptor, Kernel>>
      matches;
  for (const internal::Candidate_motion& c : internal::match_trihedra(s, trihedra, d, tolerances))
    matches.push_back({source_vertices(trihedra[std::size_t(c.trihedron)]),
                       target_vertices({c.vertices[0], {c.vertices[1], c.vertices[2], c.vertices[3]}}),
                       internal::to_aff_transformation<Kernel>(c.motion), c.residual});
  return matches;
}

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_MATCHING_MATCH_TRIHEDRA_H
