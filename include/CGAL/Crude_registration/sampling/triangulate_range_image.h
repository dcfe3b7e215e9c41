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

#ifndef CGAL_CRUDE_REGISTRATION_SAMPLING_TRIANGULATE_RANGE_IMAGE_H
#define CGAL_CRUDE_REGISTRATION_SAMPLING_TRIANGULATE_RANGE_IMAGE_H

// Triangulates a range image over its grid.

#include <CGAL/Crude_registration/Range_image.h>
#include <CGAL/Crude_registration/internal/sampling/estimate_flat_sensor.h>
#include <CGAL/Crude_registration/internal/sampling/Flat_range_image.h>
#include <CGAL/Crude_registration/internal/sampling/flat_image_triangulation.h>
#include <CGAL/Crude_registration/internal/mesh/add_flat_mesh.h>
#include <CGAL/Crude_registration/named_parameters.h>

#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

template <class Kernel, class NamedParameters>
Flat_mesh flat_triangulation_of(const Range_image<Kernel>& image, const NamedParameters& np)
{
  const double ratio = positive_parameter(np, internal_np::maximum_edge_ratio, default_maximum_edge_ratio,
                                          "triangulate_range_image", "maximum_edge_ratio");
  Flat_range_image flat(image);
  if (!image.sensor().is_known()) flat.sensor = estimated_sensor(flat);
  return flat_triangulation(flat, sampling(flat), ratio);
}

} // namespace internal

/*!
\ingroup PkgCrudeRegistrationRef

\brief triangulates a range image over its grid.

Four samples of adjacent columns and rows give two triangles over their shorter diagonal, three give one. A triangle
with an edge longer than `maximum_edge_ratio` times the sampling distance is left out: it would join what is apart in
depth (section 4 of the paper). Under a perspective sensor the sampling distance is the one at the range of the edge's
nearer end, else it is `sampling_distance(image)`.

The faces are counterclockwise seen from the sensor of `image`, or, if that is unknown, from the one that
`estimate_sensor()` finds; if it finds none, columns x rows is taken to point to the sensor.

The vertices are in the order of the cells, row by row. A sample that is in no triangle becomes no vertex. A sample at
which triangles meet that share no edge becomes one vertex for each group of triangles that do, all at the same point:
the result is a manifold.

\tparam Kernel a model of `Kernel`
\tparam FaceGraph a model of `MutableFaceGraph`
\tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"

\param image the range image
\param mesh the output; the triangles are added to what it holds
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below

\cgalNamedParamsBegin
  \cgalParamNBegin{maximum_edge_ratio}
    \cgalParamDescription{the length of the longest edge, in sampling distances}
    \cgalParamType{`double`, above zero}
    \cgalParamDefault{`5`}
  \cgalParamNEnd
  \cgalParamNBegin{vertex_point_map}
    \cgalParamDescription{a property map associating points to the vertices of `mesh`}
    \cgalParamType{a class model of `ReadWritePropertyMap` with `boost::graph_traits<FaceGraph>::%vertex_descriptor`
                   as key type and a `Point_3` as value type}
    \cgalParamDefault{`boost::get(CGAL::vertex_point, mesh)`}
  \cgalParamNEnd
\cgalNamedParamsEnd

\throws std::invalid_argument if `maximum_edge_ratio` is not a finite number above zero.

Complexity: linear in the number of cells.
*/
template <class Kernel, class FaceGraph, class NamedParameters = parameters::Default_named_parameters>
void triangulate_range_image(const Range_image<Kernel>& image, FaceGraph& mesh,
                             const NamedParameters& np = parameters::default_values())
{
  internal::add_flat_mesh(internal::flat_triangulation_of(image, np), mesh, np);
}

/*!
\ingroup PkgCrudeRegistrationRef

\brief triangulates a range image over its grid, like the function above, to a polygon soup: points and, for each
triangle, the indices of its three points. It takes a fraction of the time.

\tparam Kernel a model of `Kernel`
\tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"

\param image the range image
\param points the points; they are replaced
\param triangles the triangles; they are replaced
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters": `maximum_edge_ratio` as above

\throws std::invalid_argument if `maximum_edge_ratio` is not a finite number above zero.
*/
template <class Kernel, class NamedParameters = parameters::Default_named_parameters>
void triangulate_range_image(const Range_image<Kernel>& image, std::vector<typename Kernel::Point_3>& points,
                             std::vector<std::array<std::size_t, 3>>& triangles,
                             const NamedParameters& np = parameters::default_values())
{
  const internal::Flat_mesh mesh = internal::flat_triangulation_of(image, np);
  points.clear();
  points.reserve(mesh.points.size());
  for (const internal::Vector& p : mesh.points) points.emplace_back(p.x(), p.y(), p.z());
  triangles.clear();
  triangles.reserve(mesh.faces.size());
  for (const auto& f : mesh.faces)
    triangles.push_back(
        {static_cast<std::size_t>(f[0]), static_cast<std::size_t>(f[1]), static_cast<std::size_t>(f[2])});
}

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_SAMPLING_TRIANGULATE_RANGE_IMAGE_H
