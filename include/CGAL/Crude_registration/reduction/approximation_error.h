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

#ifndef CGAL_CRUDE_REGISTRATION_REDUCTION_APPROXIMATION_ERROR_H
#define CGAL_CRUDE_REGISTRATION_REDUCTION_APPROXIMATION_ERROR_H

// How far the simplification of a scan may leave its surface: section 4 of the paper.

#include <CGAL/Crude_registration/Range_image.h>
#include <CGAL/Crude_registration/internal/base/Flat_sensor.h>
#include <CGAL/Crude_registration/internal/mesh/mesh_geometry.h>
#include <CGAL/Crude_registration/internal/mesh/to_flat_mesh.h>
#include <CGAL/Crude_registration/internal/reduction/measure_scan.h>
#include <CGAL/Crude_registration/named_parameters.h>

#include <algorithm>
#include <limits>
#include <string>

namespace CGAL {
namespace Crude_registration {
namespace internal {

template <class NamedParameters>
double approximation_error(const Flat_mesh& mesh, const NamedParameters& np, const std::string& function)
{
  const double s = positive_parameter(np, internal_np::sampling_distance,
                                      // An empty or degenerate mesh has an error of 0.
                                      (std::max)(median_edge_length(mesh), (std::numeric_limits<double>::min)()),
                                      function.c_str(), "sampling_distance");
  const Vector extent = extent_of_mesh(mesh, sensor_parameter(np, function));
  return approximation_error(s, (std::max)(extent.x(), extent.y()), percent_smooth(mesh));
}

} // namespace internal

/*!
 * \ingroup PkgCrudeRegistrationRef
 *
 * \brief the paper's approximation error \f$ \epsilon = 0.15 \, s \, A / \%smooth \f$ of a scan: how far, as a mean
 * squared distance, `simplify_scan()` may leave the original surface. A squared length.
 *
 * \f$ s \f$ is the sampling distance, \f$ A \f$ the larger extent in the image plane (`scan_extent()`), \f$ \%smooth
 * \f$ the share of the vertices that are not hyperbolic (`surface_types()`).
 *
 * \tparam FaceGraph a model of `FaceListGraph`
 * \tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"
 *
 * \param mesh a triangle mesh
 * \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below
 *
 * \cgalNamedParamsBegin
 *   \cgalParamNBegin{vertex_point_map}
 *     \cgalParamDescription{a property map associating points to the vertices of `mesh`}
 *     \cgalParamType{a class model of `ReadablePropertyMap` with `boost::graph_traits<FaceGraph>::%vertex_descriptor`
 *                    as key type and a `Point_3` as value type}
 *     \cgalParamDefault{`get(CGAL::vertex_point, mesh)`}
 *   \cgalParamNEnd
 *   \cgalParamNBegin{sampling_distance}
 *     \cgalParamDescription{the sampling distance \f$ s \f$}
 *     \cgalParamType{`double`, above zero}
 *     \cgalParamDefault{the median length of the edges}
 *   \cgalParamNEnd
 *   \cgalParamNBegin{viewing_direction}
 *     \cgalParamDescription{as for `scan_extent()`}
 *     \cgalParamType{a `Vector_3`, not null}
 *     \cgalParamDefault{not known}
 *     \cgalParamExtra{excludes `viewpoint`}
 *   \cgalParamNEnd
 *   \cgalParamNBegin{viewpoint}
 *     \cgalParamDescription{as for `scan_extent()`}
 *     \cgalParamType{a `Point_3`}
 *     \cgalParamDefault{not known}
 *     \cgalParamExtra{excludes `viewing_direction`}
 *   \cgalParamNEnd
 * \cgalNamedParamsEnd
 *
 * \throws std::invalid_argument if a face of `mesh` is not a triangle, a coordinate is not finite, or the sampling
 * distance is not a finite number above zero.
 */
template <class FaceGraph, class NamedParameters = parameters::Default_named_parameters>
double approximation_error(const FaceGraph& mesh, const NamedParameters& np = parameters::default_values())
{
  return internal::approximation_error(internal::to_flat_mesh(mesh, np, "approximation_error", "mesh"), np,
                                       "approximation_error");
}

/*!
 * \ingroup PkgCrudeRegistrationRef
 *
 * \brief the paper's approximation error of a range image, with its sampling distance, its extent along the axes of its
 * grid, and the surface types of its triangulation. This is the paper's own case.
 */
template <class Kernel>
double approximation_error(const Range_image<Kernel>& image)
{
  const internal::Flat_range_mesh scan{internal::Flat_range_image(image)};
  const internal::Vector extent = internal::extent_of_image(scan.image, scan.mesh);
  return internal::approximation_error(scan.samples.distance, (std::max)(extent.x(), extent.y()),
                                       internal::percent_smooth(scan.mesh));
}

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_REDUCTION_APPROXIMATION_ERROR_H
