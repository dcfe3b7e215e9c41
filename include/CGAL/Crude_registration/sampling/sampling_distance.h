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

#ifndef CGAL_CRUDE_REGISTRATION_SAMPLING_SAMPLING_DISTANCE_H
#define CGAL_CRUDE_REGISTRATION_SAMPLING_SAMPLING_DISTANCE_H

// The distance of neighbouring samples of a scan.

#include <CGAL/Crude_registration/Range_image.h>
#include <CGAL/Crude_registration/internal/mesh/to_flat_mesh.h>
#include <CGAL/Crude_registration/internal/sampling/Flat_range_image.h>
#include <CGAL/Crude_registration/named_parameters.h>

namespace CGAL {
namespace Crude_registration {

/*!
\ingroup PkgCrudeRegistrationRef

\brief returns the sampling distance \f$ s \f$ of a range image, in the unit of its points.

It is the larger of the two medians, along rows and along columns, of the distances between adjacent samples, measured
in the image plane: perpendicular to the lines of sight of the image's sensor. The distances of a perspective sensor
grow with the range; \f$ s \f$ is then the distance at the median range. Where the sensor is unknown, the distances are
measured in space.

\return \f$ s \f$; 0 if no two adjacent cells have samples apart from each other

Complexity: linear in the number of cells.
*/
template <class Kernel>
double sampling_distance(const Range_image<Kernel>& image)
{
  return internal::sampling(internal::Flat_range_image(image)).distance;
}

/*!
\ingroup PkgCrudeRegistrationRef

\brief returns the sampling distance of a triangle mesh whose vertices are samples, in the unit of its points.

It is the median length of the edges. On the triangulation of a range image this is close to the larger one of the
distances along rows and along columns.

\tparam FaceGraph a model of `FaceListGraph`
\tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"

\param mesh a triangle mesh
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below

\cgalNamedParamsBegin
  \cgalParamNBegin{vertex_point_map}
    \cgalParamDescription{a property map associating points to the vertices of `mesh`}
    \cgalParamType{a class model of `ReadablePropertyMap` with `boost::graph_traits<FaceGraph>::%vertex_descriptor`
                   as key type and a `Point_3` as value type}
    \cgalParamDefault{`get(CGAL::vertex_point, mesh)`}
  \cgalParamNEnd
\cgalNamedParamsEnd

\return the median length; 0 for a mesh without faces

\throws std::invalid_argument if a face of `mesh` is not a triangle or a coordinate is not finite

Complexity: linear in the number of faces.
*/
template <class FaceGraph, class NamedParameters = parameters::Default_named_parameters>
double sampling_distance(const FaceGraph& mesh, const NamedParameters& np = parameters::default_values())
{
  return internal::median_edge_length(internal::to_flat_mesh(mesh, np, "sampling_distance", "mesh"));
}

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_SAMPLING_SAMPLING_DISTANCE_H
