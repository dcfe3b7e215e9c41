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

#ifndef CGAL_CRUDE_REGISTRATION_MOTION_REFINE_MOTION_H
#define CGAL_CRUDE_REGISTRATION_MOTION_REFINE_MOTION_H

// Refines a rigid motion that is nearly right.

#include <CGAL/Crude_registration/internal/base/for_each_index.h>
#include <CGAL/Crude_registration/internal/mesh/mesh_geometry.h>
#include <CGAL/Crude_registration/internal/mesh/to_flat_mesh.h>
#include <CGAL/Crude_registration/internal/motion/refine_flat_motion.h>
#include <CGAL/Crude_registration/named_parameters.h>

#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace CGAL {
namespace Crude_registration {

/*!
\ingroup PkgCrudeRegistrationRef

What refine_motion() returns.
*/
template <class Kernel>
struct Refined_motion
{
  /// The rigid motion that maps the source into the frame of the target.
  Aff_transformation_3<Kernel> motion;
  /// Number of iterations: searches for correspondences followed by a step.
  std::size_t iterations;
  /// Whether the last step was shorter than the tolerance; `false` where the iterations ran out or fewer than six
  /// correspondences were left.
  bool is_converged;
  /// The sampling distance \f$ s \f$ used, in the unit of the coordinates.
  double sampling_distance;
  /// RMS distance of the corresponding points along their normals, in sampling distances.
  double residual;
  /// Share of the source's vertices that have the target within two sampling distances and its normal within 45
  /// degrees.
  double overlap;
  /// Number of independent small motions that the correspondences leave free: 3 on a plane or a sphere, 2 on a
  /// cylinder, 1 on a surface of revolution, 0 where the motion is determined.
  int number_of_free_motions;
  /// Covariance of the small motion \f$ x \rightarrow x + \omega \times x + v \f$ that follows `motion`, in the order
  /// \f$ (\omega, v) \f$: radians about the axes through the target's origin, and its displacement. It takes the errors
  /// of the correspondences as independent; systematic errors of the scanner are not in it. Along a free motion the
  /// standard deviation is the RMS radius of the matched points; infinite on the diagonal where there are none.
  std::array<std::array<double, 6>, 6> covariance;
};

namespace internal {

// The rigid motion next to an affine transformation that was written with three digits or more.
template <class Kernel>
Rigid_motion rigid_argument(const Aff_transformation_3<Kernel>& transformation, const std::string& function,
                            const std::string& argument)
{
  const Rigid_motion motion = to_rigid_motion(transformation);
  const Matrix& r = motion.rotation;
  const bool is_rigid = motion.translation.allFinite() && r.allFinite() &&
                        (r.transpose() * r - Matrix::Identity()).cwiseAbs().maxCoeff() < 1e-3 && r.determinant() > 0;
  if (!is_rigid) throw std::invalid_argument(function + ": " + argument + " is not a rigid motion");
  return {nearest_rotation(r), motion.translation};
}

} // namespace internal

/*!
\ingroup PkgCrudeRegistrationRef

Refines a rigid motion that already maps `source` close to `target`, by robust point-to-plane registration.

Each iteration pairs every vertex of the source with the closest vertex of the target (in a Kd tree), leaves out
pairs that are too far apart, whose normals differ by more than 45 degrees or whose target vertex lies on the border
(Rusinkiewicz and Levoy 2001), weighs the rest by Tukey's biweight at the scale of the median residual, and takes one
Gauss-Newton step on the distances of the pairs along their common normals: Chen and Medioni's point-to-plane
distance in the symmetric form of Rusinkiewicz 2019, which needs fewer iterations on curved surfaces. The reach of
the correspondences shrinks with their median distance from `maximum_distance` down to two sampling distances.

The iteration stops as soon as a step displaces the corresponding points by no more than `tolerance` sampling
distances (RMS). Motions about which the correspondences say nothing, such as sliding along a plane, are left as they
are in `initial_motion`.

\tparam ConcurrencyTag `CGAL::Sequential_tag` (default), `CGAL::Parallel_tag` or `CGAL::Parallel_if_available_tag`;
the result is the same, bit for bit
\tparam SourceGraph, TargetGraph models of `FaceListGraph` with triangle faces
\tparam NamedParameters1, NamedParameters2 sequences of \ref bgl_namedparameters "Named Parameters"

\param source the mesh to be moved
\param target the mesh that stays; faces of both are oriented alike, outwards or towards the sensor
\param initial_motion maps `source` into the frame of `target`
\param np_source, np_target optional sequences of \ref bgl_namedparameters "Named Parameters" among the ones listed
below

\cgalNamedParamsBegin
  \cgalParamNBegin{vertex_point_map}
    \cgalParamDescription{a property map associating points to the vertices of the mesh; read from both sequences}
    \cgalParamType{a class model of `ReadablePropertyMap` with `boost::graph_traits<Graph>::%vertex_descriptor` as key
                   type and a `Point_3` as value type}
    \cgalParamDefault{`boost::get(CGAL::vertex_point, graph)`}
  \cgalParamNEnd
  \cgalParamNBegin{maximum_distance}
    \cgalParamDescription{how far apart corresponding points may lie under `initial_motion`, in the unit of the
                          coordinates; not below two sampling distances; read from `np_source`}
    \cgalParamType{`double`, above zero}
    \cgalParamDefault{a fifth of the RMS radius of the target}
  \cgalParamNEnd
  \cgalParamNBegin{sampling_distance}
    \cgalParamDescription{the sampling distance of the coarser mesh, in the unit of the coordinates; read from
                          `np_source`}
    \cgalParamType{`double`, above zero}
    \cgalParamDefault{the larger one of the median edge lengths}
  \cgalParamNEnd
  \cgalParamNBegin{tolerance}
    \cgalParamDescription{the step, in sampling distances, that ends the iteration; read from `np_source`}
    \cgalParamType{`double`, above zero}
    \cgalParamDefault{`0.05`, a fraction of what range scanners resolve}
  \cgalParamNEnd
  \cgalParamNBegin{number_of_iterations}
    \cgalParamDescription{the largest number of iterations; read from `np_source`}
    \cgalParamType{an integer, 1 or above}
    \cgalParamDefault{`50`}
  \cgalParamNEnd
\cgalNamedParamsEnd

\return the refined motion, which maps `source` into the frame of `target`, with what tells how good it is

\throws std::invalid_argument if a mesh has no face with an area, a face that is not a triangle or a coordinate that
is not finite, if `initial_motion` is not rigid, or if a parameter is not a positive number

For \f$ n \f$ vertices, \f$ O(n \log n) \f$ an iteration.
*/
template <class ConcurrencyTag = Sequential_tag, class SourceGraph, class TargetGraph, class Kernel,
          class NamedParameters1 = parameters::Default_named_parameters,
          class NamedParameters2 = parameters::Default_named_parameters>
Refined_motion<Kernel> refine_motion(const SourceGraph& source, const TargetGraph& target,
                                     const Aff_transformation_3<Kernel>& initial_motion,
                                     const NamedParameters1& np_source = parameters::default_values(),
                                     const NamedParameters2& np_target = parameters::default_values())
{
  const char* const function = "refine_motion";
  const internal::Flat_mesh source_mesh =
      internal::to_flat_mesh(source, internal::cgal_parameters(np_source), function, "source");
  const internal::Flat_mesh target_mesh =
      internal::to_flat_mesh(target, internal::cgal_parameters(np_target), function, "target");
  const internal::Rigid_motion initial = internal::rigid_argument(initial_motion, function, "initial_motion");

  if (!internal::has_area(source_mesh)) throw std::invalid_argument("refine_motion: source has no face with an area");
  if (!internal::has_area(target_mesh)) throw std::invalid_argument("refine_motion: target has no face with an area");
  internal::Refinement_options options;
  options.sampling_distance = internal::positive_parameter(
      np_source, internal_np::sampling_distance,
      (std::max)(internal::median_edge_length(source_mesh), internal::median_edge_length(target_mesh)), function,
      "sampling_distance");
  options.reach =
      internal::positive_parameter(np_source, internal_np::maximum_distance,
                                   internal::rms_radius(target_mesh.points) / 5, function, "maximum_distance");
  options.tolerance =
      internal::positive_parameter(np_source, internal_np::tolerance, options.tolerance, function, "tolerance");
  options.maximum_number_of_iterations =
      internal::count_parameter(np_source, internal_np::number_of_iterations, options.maximum_number_of_iterations, 1,
                                function, "number_of_iterations");

  const internal::Refinement r =
      internal::refine_flat_motion(source_mesh, target_mesh, initial, options, internal::execution<ConcurrencyTag>());
  return {internal::to_aff_transformation<Kernel>(r.motion),
          r.iterations,
          r.is_converged,
          options.sampling_distance,
          r.residual / options.sampling_distance,
          r.overlap,
          int(r.free_motions.size()),
          internal::rows_of(r.covariance)};
}

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_MOTION_REFINE_MOTION_H
