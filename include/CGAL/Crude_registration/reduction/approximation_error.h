// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_REDUCTION_APPROXIMATION_ERROR_H
#define CGAL_CRUDE_REGISTRATION_REDUCTION_APPROXIMATION_ERROR_H

#include <CGAL/Crude_registration/Range_image.h>
#include <CGAL/Crude_registration/sampling/estimate_sensor.h>
#include <CGAL/Crude_registration/internal/reduction/Curvature_tensors.h>
#include <CGAL/Crude_registration/internal/reduction/flat_approximation_error.h>
#include <CGAL/Crude_registration/internal/sampling/Flat_range_image.h>
#include <CGAL/Crude_registration/internal/sampling/Flat_triangulation.h>
#include <CGAL/Crude_registration/internal/mesh/mesh_geometry.h>
#include <CGAL/Crude_registration/internal/reduction/scan_frame.h>
#include <CGAL/Crude_registration/named_parameters.h>
#include <CGAL/Crude_registration/reduction/surface_types.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

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

namespace internal {

template <class NamedParameters>
Scan_extent scan_extent(const Flat_mesh& mesh, const NamedParameters& np, const std::string& function)
{
  const Vector d = extent_in_own_frame(mesh, np, function);
  return {d.x(), d.y(), d.z()};
}

// The frame of the grid: z towards the sensor, x along the columns' mean direction in the image plane. `mesh`: the
// triangulation, whose own frame stands in for what the grid does not say.
inline Rigid_motion grid_frame(const Flat_range_image& image, const Flat_mesh& mesh)
{
  Rigid_motion own = scan_frame(mesh);
  const Vector centroid = own.inverse().translation;
  const Vector z = image.sensor.kind == Flat_sensor::UNKNOWN ? Vector(own.rotation.row(2))
                                                             : Vector(-unit_or_zero(image.sensor.towards(centroid)));
  if (z.isZero(0)) return own;
  Vector x = Vector::Zero();
  for (std::size_t row = 0; row < image.rows; ++row)
    for (std::size_t column = 0; column + 1 < image.columns; ++column) {
      const std::int32_t i = image.index(column, row), j = image.index(column + 1, row);
      if (i >= 0 && j >= 0) x += image.point(j) - image.point(i);
    }
  x = unit_or_zero(x - z * z.dot(x));
  return x.isZero(0) ? scan_frame(mesh, -z) : frame_of_axes(x, z, centroid);
}

// A range image of known or estimated sensor with its triangulation.
struct Flat_range_mesh
{
  Flat_range_image image;
  Sampling samples;
  Flat_mesh mesh;

  template <class Kernel>
  explicit Flat_range_mesh(const Range_image<Kernel>& source) : image(source)
  {
    if (image.sensor.kind == Flat_sensor::UNKNOWN) image.sensor = Sensor_estimation(image)();
    samples = sampling(image);
    mesh = flat_triangulation(image, samples, 5);
  }

  Scan_extent extent() const
  {
    const Vector d = extent_in_frame(mesh, grid_frame(image, mesh));
    return {d.x(), d.y(), d.z()};
  }
};

} // namespace internal

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
 *     \cgalParamType{`Vector_3`, not null}
 *     \cgalParamDefault{none: the frame is found from the mesh}
 *   \cgalParamNEnd
 *   \cgalParamNBegin{viewpoint}
 *     \cgalParamDescription{the place of the sensor; the depth axis goes through it and the centroid of the surface.
 *                           Not read where `viewing_direction` is given}
 *     \cgalParamType{`Point_3`}
 *     \cgalParamDefault{none}
 *   \cgalParamNEnd
 * \cgalNamedParamsEnd
 *
 * \throws std::invalid_argument if a face of `mesh` is not a triangle or a coordinate is not finite.
 */
template <class FaceGraph, class NamedParameters = parameters::Default_named_parameters>
Scan_extent scan_extent(const FaceGraph& mesh, const NamedParameters& np = parameters::default_values())
{
  return internal::scan_extent(internal::to_flat_mesh(mesh, np, "scan_extent", "mesh"), np, "scan_extent");
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
  return internal::Flat_range_mesh(image).extent();
}

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
 *     \cgalParamType{`Vector_3`}
 *     \cgalParamDefault{none}
 *   \cgalParamNEnd
 *   \cgalParamNBegin{viewpoint}
 *     \cgalParamDescription{as for `scan_extent()`}
 *     \cgalParamType{`Point_3`}
 *     \cgalParamDefault{none}
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
  const internal::Flat_range_mesh scan(image);
  return internal::approximation_error(
      scan.samples.distance, scan.extent().image_size(),
      internal::count_surface_types(internal::curvature_tensors(scan.mesh), internal::flat_curvature(scan.mesh))
          .percent_smooth());
}

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_REDUCTION_APPROXIMATION_ERROR_H
