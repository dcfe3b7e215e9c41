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

#ifndef CGAL_CRUDE_REGISTRATION_SAMPLING_TRIANGULATE_POINTS_H
#define CGAL_CRUDE_REGISTRATION_SAMPLING_TRIANGULATE_POINTS_H

// Triangulates points without a grid.

#include <CGAL/Crude_registration/internal/base/Flat_sensor.h>
#include <CGAL/Crude_registration/internal/mesh/add_flat_mesh.h>
#include <CGAL/Crude_registration/internal/mesh/to_flat_points.h>
#include <CGAL/Crude_registration/internal/sampling/flat_image_triangulation.h>
#include <CGAL/Crude_registration/internal/sampling/flat_point_triangulation.h>
#include <CGAL/Crude_registration/named_parameters.h>

#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/property_map.h>

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Crude_registration {
/*!
\ingroup PkgCrudeRegistrationRef

\brief triangulates the points of a scan that has neither a grid nor faces.

With a known sensor (`viewpoint` or `viewing_direction`), the points are projected along their lines of sight; the
triangles of the Delaunay triangulation of the projections are taken, except those with an edge longer than
`maximum_edge_ratio` times the sampling distance. That is the median length of the Delaunay edges in the image; from a
viewpoint it grows with the range. The faces are counterclockwise seen from the sensor. Of points on the same line of
sight the nearest is taken. Complexity: O(n log n); 40,000 points take about 0.06 seconds.

Without a sensor, the points are joined by `CGAL::advancing_front_surface_reconstruction()`; more than 40,000 are
thinned to about 40,000 first, each the mean of the points in a cell of a grid along their principal axes. The longest
edge is `maximum_edge_ratio` times the spacing of the points that are joined. Each connected part of the result is
turned so that its faces look, in the mean, away from the centroid of all points, as those of an object seen from
outside. But if a place is found from where most of the surface is visible, and looks at less than half of the sphere,
as where a camera moved in a room, and no such place outside of what may be an object, each face is turned to that
place. About two seconds for 300,000 points.

The vertices are in the order of the points (with the thinning: of the grid's cells); where triangles meet that share no
edge, a vertex is repeated, at the end: the result is a manifold. Points in no triangle become no vertices.

\tparam PointRange a model of `ConstRange`
\tparam FaceGraph a model of `MutableFaceGraph`
\tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"

\param points the points, in any order; points may be repeated. Fewer than three, or points on a line, have no triangle.
\param mesh the output; the triangles are added to what it holds
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below

\cgalNamedParamsBegin
  \cgalParamNBegin{viewpoint}
    \cgalParamDescription{where the sensor stood, in the frame of `points`}
    \cgalParamType{a `Point_3`}
    \cgalParamDefault{not known}
    \cgalParamExtra{excludes `viewing_direction`}
  \cgalParamNEnd
  \cgalParamNBegin{viewing_direction}
    \cgalParamDescription{the direction of parallel lines of sight, from the sensor into the scene, in the frame of
                          `points`, of any length}
    \cgalParamType{a `Vector_3`, not null}
    \cgalParamDefault{not known}
    \cgalParamExtra{excludes `viewpoint`}
  \cgalParamNEnd
  \cgalParamNBegin{maximum_edge_ratio}
    \cgalParamDescription{the length of the longest edge, in sampling distances}
    \cgalParamType{`double`, above zero}
    \cgalParamDefault{`5`}
  \cgalParamNEnd
  \cgalParamNBegin{point_map}
    \cgalParamDescription{a property map associating points to the elements of `points`}
    \cgalParamType{a class model of `ReadablePropertyMap` whose value type is a `Point_3`}
    \cgalParamDefault{`CGAL::Identity_property_map`}
  \cgalParamNEnd
  \cgalParamNBegin{vertex_point_map}
    \cgalParamDescription{a property map associating points to the vertices of `mesh`}
    \cgalParamType{a class model of `ReadWritePropertyMap` with `boost::graph_traits<FaceGraph>::%vertex_descriptor`
                   as key type and a `Point_3` as value type}
    \cgalParamDefault{`boost::get(CGAL::vertex_point, mesh)`}
  \cgalParamNEnd
\cgalNamedParamsEnd

\throws std::invalid_argument if a coordinate of `points`, `viewpoint` or `viewing_direction` is not finite,
`viewing_direction` is null, `maximum_edge_ratio` is not a finite number above zero, there are more than 2^31 - 1
points, or their coordinates are above 1e75 or their size is below 1e-75, but not zero.
*/
template <class PointRange, class FaceGraph, class NamedParameters = parameters::Default_named_parameters>
void triangulate_points(const PointRange& points, FaceGraph& mesh,
                        const NamedParameters& np = parameters::default_values())
{
  using Element = typename std::iterator_traits<typename PointRange::const_iterator>::value_type;
  const double ratio =
      internal::positive_parameter(np, internal_np::maximum_edge_ratio, internal::default_maximum_edge_ratio,
                                   "triangulate_points", "maximum_edge_ratio");
  const internal::Flat_sensor sensor = internal::sensor_parameter(np, "triangulate_points");
  const auto point_map = internal::parameter(np, internal_np::point_map, CGAL::Identity_property_map<Element>());
  const std::vector<internal::Vector> flat =
      internal::to_flat_points(points, point_map, "triangulate_points", "points");
  internal::add_flat_mesh(internal::flat_triangulation(flat, sensor, ratio), mesh, np);
}

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_SAMPLING_TRIANGULATE_POINTS_H
