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

#ifndef CGAL_CRUDE_REGISTRATION_MATCHING_SPATIAL_TRIHEDRA_H
#define CGAL_CRUDE_REGISTRATION_MATCHING_SPATIAL_TRIHEDRA_H

// Chooses the spatial trihedra of a simplified mesh.

#include <CGAL/Crude_registration/internal/base/Flat_sensor.h>
#include <CGAL/Crude_registration/internal/matching/extents.h>
#include <CGAL/Crude_registration/internal/matching/flat_trihedra.h>
#include <CGAL/Crude_registration/internal/mesh/mesh_geometry.h>
#include <CGAL/Crude_registration/internal/mesh/to_flat_mesh.h>
#include <CGAL/Crude_registration/internal/reduction/measure_scan.h>
#include <CGAL/Crude_registration/matching/Spatial_trihedron.h>
#include <CGAL/Crude_registration/named_parameters.h>

#include <boost/graph/graph_traits.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// One trihedron a vertex, with arms from f1 M to f2 M.
inline Trihedron_options trihedron_options(const std::array<double, 2>& shares, double extent)
{
  Trihedron_options options;
  options.minimum_length = shares[0] * extent;
  options.maximum_length = shares[1] * extent;
  return options;
}

// The vertices of a graph by their position in vertices(graph).
template <class Graph>
class Vertices_of
{
public:
  using Vertex = typename boost::graph_traits<Graph>::vertex_descriptor;

  explicit Vertices_of(const Graph& graph)
  {
    for (const Vertex v : vertices(graph)) m_vertices.push_back(v);
  }

  Crude_registration::Spatial_trihedron<Vertex> operator()(const Spatial_trihedron& t) const
  {
    return {at(t.origin), {at(t.ends[0]), at(t.ends[1]), at(t.ends[2])}};
  }

private:
  Vertex at(std::int32_t i) const { return m_vertices[std::size_t(i)]; }

  std::vector<Vertex> m_vertices;
};

} // namespace internal

/*!
\ingroup PkgCrudeRegistrationRef

\brief chooses one spatial trihedron for each vertex of a simplified mesh, where there is one.

The arms have lengths between \f$ f_1 M \f$ and \f$ f_2 M \f$, \f$ M \f$ being the mean extent of the mesh
(`scan_extent()`); within these limits they are chosen long and as near to orthogonal as the surface allows. All four
vertices lie inside the mesh, none on its border. Lengths are compared exactly, and trihedra are never degenerate:
%CGAL's exact predicates decide.

\tparam FaceGraph a model of `FaceListGraph`
\tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"

\param mesh a triangle mesh, usually the result of `simplify_scan()`
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below

\cgalNamedParamsBegin
  \cgalParamNBegin{vertex_point_map}
    \cgalParamDescription{a property map associating points to the vertices of `mesh`}
    \cgalParamType{a class model of `ReadablePropertyMap` with `boost::graph_traits<FaceGraph>::%vertex_descriptor` as
key type and a `Point_3` as value type} \cgalParamDefault{`boost::get(CGAL::vertex_point, mesh)`} \cgalParamNEnd
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
\cgalNamedParamsEnd

\return the trihedra, sorted by the position of their origin in `vertices(mesh)`

\throws std::invalid_argument if a face of `mesh` is not a triangle, a coordinate is not finite, or not
\f$ 0 \le f_1 < f_2 \f$.

The time is proportional to the number of vertices in reach of each other.
*/
template <class FaceGraph, class NamedParameters = parameters::Default_named_parameters>
std::vector<Spatial_trihedron<typename boost::graph_traits<FaceGraph>::vertex_descriptor>>
spatial_trihedra(const FaceGraph& mesh, const NamedParameters& np = parameters::default_values())
{
  const std::array<double, 2> shares = internal::extent_parameters(np, "spatial_trihedra");
  const internal::Flat_mesh flat = internal::to_flat_mesh(mesh, np, "spatial_trihedra", "mesh");
  const double extent = internal::extent_of_mesh(flat, internal::sensor_parameter(np, "spatial_trihedra")).sum() / 3;
  const std::vector<std::uint8_t> borders = internal::border_flags(flat);
  std::vector<std::uint8_t> inside(flat.points.size(), 0);
  for (const auto& f : flat.faces)
    for (std::int32_t v : f) inside[std::size_t(v)] = !borders[std::size_t(v)];
  const internal::Vertices_of<FaceGraph> vertices_of(mesh);
  std::vector<Spatial_trihedron<typename boost::graph_traits<FaceGraph>::vertex_descriptor>> trihedra;
  for (const internal::Spatial_trihedron& t :
       internal::spatial_trihedra(flat.points, inside, internal::trihedron_options(shares, extent)))
    trihedra.push_back(vertices_of(t));
  return trihedra;
}

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_MATCHING_SPATIAL_TRIHEDRA_H
