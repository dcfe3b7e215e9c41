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

#ifndef CGAL_CRUDE_REGISTRATION_REDUCTION_SCAN_EXTENT_H
#define CGAL_CRUDE_REGISTRATION_REDUCTION_SCAN_EXTENT_H

// The size of a scan along the axes of its image plane and along its depth axis.

#include <CGAL/Crude_registration/Range_image.h>
#include <CGAL/Crude_registration/internal/base/Flat_sensor.h>
#include <CGAL/Crude_registration/internal/mesh/to_flat_mesh.h>
#include <CGAL/Crude_registration/internal/reduction/measure_scan.h>
#include <CGAL/Crude_registration/named_parameters.h>

#include <algorithm>

namespace CGAL {
namespace Crude_registration {

/*!
 * \ingroup PkgCrudeRegistrationRef
 *
 * \brief the edge lengths of the box that contains a scan, along the axes of the image plane and along the depth axis.
 */
struct Scan_extent
{
  double horizontal = 0; ///< \f$ D_x \f$
  double vertical = 0;   ///< \f$ D_y \f$
  double depth = 0;      ///< \f$ D_z \f$

  /// \f$ A = \max(D_x, D_y) \f$
  double image_size() const { return (std::max)(horizontal, vertical); }
  /// \f$ M = (D_x + D_y + D_z) / 3 \f$
  double mean() const { return (horizontal + vertical + depth) / 3; }
};

/*!
 * \ingroup PkgCrudeRegistrationRef
 *
 * \brief measures a scan along the axes of its image plane and along its depth axis, as the paper does.
 *
 * The axes move with the scan, so that a moved scan has the same extent. The depth axis is the sensor's where it is
 * known (`viewing_direction` or `viewpoint`), the mean normal of the surface where it is not, and, for closed meshes,
 * whose normals cancel, the axis of least variance. The image plane is perpendicular to it; its horizontal axis is that
 * of the largest variance. For a range image, whose grid says what the axes are, see the overload.
 *
 * \tparam FaceGraph a model of `FaceListGraph`
 * \tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"
 *
 * \param mesh a triangle mesh; vertices without a face do not count
 * \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below
 *
 * \cgalNamedParamsBegin
 *   \cgalParamNBegin{vertex_point_map}
 *     \cgalParamDescription{a property map associating points to the vertices of `mesh`}
 *     \cgalParamType{a class model of `ReadablePropertyMap` with `boost::graph_traits<FaceGraph>::%vertex_descriptor`
 *                    as key type and a `Point_3` as value type}
 *     \cgalParamDefault{`get(CGAL::vertex_point, mesh)`}
 *   \cgalParamNEnd
 *   \cgalParamNBegin{viewing_direction}
 *     \cgalParamDescription{the direction of the lines of sight, from the sensor into the scene}
 *     \cgalParamType{a `Vector_3`, not null}
 *     \cgalParamDefault{none: the frame is found from the mesh}
 *   \cgalParamNEnd
 *   \cgalParamNBegin{viewpoint}
 *     \cgalParamDescription{the place of the sensor; the depth axis goes through it and the centroid of the surface}
 *     \cgalParamType{a `Point_3`}
 *     \cgalParamDefault{not known}
 *     \cgalParamExtra{excludes `viewing_direction`}
 *   \cgalParamNEnd
 * \cgalNamedParamsEnd
 *
 * \throws std::invalid_argument if a face of `mesh` is not a triangle or a coordinate is not finite.
 */
template <class FaceGraph, class NamedParameters = parameters::Default_named_parameters>
Scan_extent scan_extent(const FaceGraph& mesh, const NamedParameters& np = parameters::default_values())
{
  const internal::Vector d = internal::extent_of_mesh(internal::to_flat_mesh(mesh, np, "scan_extent", "mesh"),
                                                      internal::sensor_parameter(np, "scan_extent"));
  return {d.x(), d.y(), d.z()};
}

/*!
 * \ingroup PkgCrudeRegistrationRef
 *
 * \brief measures a range image along the axes of its grid.
 *
 * The depth axis is that of the sensor (or of what `estimate_sensor()` finds; the mean normal if it finds none), the
 * horizontal axis that of the columns, wherever the image has been moved. Samples that are in no triangle of
 * `triangulate_range_image()` do not count.
 */
template <class Kernel>
Scan_extent scan_extent(const Range_image<Kernel>& image)
{
  const internal::Flat_range_mesh scan{internal::Flat_range_image(image)};
  const internal::Vector d = internal::extent_of_image(scan.image, scan.mesh);
  return {d.x(), d.y(), d.z()};
}

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_REDUCTION_SCAN_EXTENT_H
