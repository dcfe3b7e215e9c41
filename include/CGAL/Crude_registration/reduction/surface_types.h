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

#ifndef CGAL_CRUDE_REGISTRATION_REDUCTION_SURFACE_TYPES_H
#define CGAL_CRUDE_REGISTRATION_REDUCTION_SURFACE_TYPES_H

// The types of the surface at the vertices of a mesh.

#include <CGAL/Crude_registration/internal/reduction/classify_vertices.h>
#include <CGAL/Crude_registration/internal/mesh/to_flat_mesh.h>
#include <CGAL/Crude_registration/named_parameters.h>
#include <CGAL/Crude_registration/reduction/Surface_type.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Crude_registration {

/*!
 * \ingroup PkgCrudeRegistrationRef
 *
 * \brief finds the surface type of every vertex of a triangle mesh, and counts them.
 *
 * On scans the types are those of the sign of the Gaussian curvature, elliptic and hyperbolic: noise leaves no
 * curvature within the default tolerance, which only keeps rounding from giving exact planes and cylinders random
 * types. To find the planes and cylinders of measured data, average the curvatures (`neighbor_radius`) and give a
 * tolerance above what noise is left. Linear in the size of the mesh.
 *
 * \tparam FaceGraph a model of `FaceListGraph`
 * \tparam VertexTypeMap a model of `WritablePropertyMap` with `boost::graph_traits<FaceGraph>::%vertex_descriptor` as
 * key type and `Surface_type` as value type
 * \tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"
 *
 * \param mesh the mesh
 * \param type_map receives the type of every vertex; `PLANAR` for those without a face of positive area, which are not
 * counted
 * \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below
 *
 * \cgalNamedParamsBegin
 *   \cgalParamNBegin{vertex_point_map}
 *     \cgalParamDescription{a property map associating points to the vertices of `mesh`}
 *     \cgalParamType{a class model of `ReadablePropertyMap` with `boost::graph_traits<FaceGraph>::%vertex_descriptor`
 *                    as key type and a `Point_3` as value type}
 *     \cgalParamDefault{`get(CGAL::vertex_point, mesh)`}
 *   \cgalParamNEnd
 *   \cgalParamNBegin{tolerance}
 *     \cgalParamDescription{the absolute value, in 1/length, up to which a curvature counts as zero}
 *     \cgalParamType{`double`, zero or above}
 *     \cgalParamDefault{that of a radius of a million times the size of the mesh (twice the root mean square distance
 *                       of the vertices from their centroid)}
 *   \cgalParamNEnd
 *   \cgalParamNBegin{neighbor_radius}
 *     \cgalParamDescription{as for `principal_curvatures()`}
 *     \cgalParamType{`double`, zero or above}
 *     \cgalParamDefault{`0`}
 *     \cgalParamExtra{a name of `CGAL::parameters`}
 *   \cgalParamNEnd
 * \cgalNamedParamsEnd
 *
 * \return how many vertices are of which type
 *
 * \throws std::invalid_argument as `principal_curvatures()`, and if the tolerance is negative or not finite.
 */
template <class FaceGraph, class VertexTypeMap, class NamedParameters = parameters::Default_named_parameters>
Surface_type_counts surface_types(const FaceGraph& mesh, VertexTypeMap type_map,
                                  const NamedParameters& np = parameters::default_values())
{
  const internal::Flat_mesh flat = internal::to_flat_mesh(mesh, np, "surface_types", "mesh");
  const double tolerance = internal::non_negative_parameter(np, internal_np::tolerance, internal::flat_curvature(flat),
                                                            "surface_types", "tolerance");
  const double radius =
      internal::non_negative_parameter(np, internal_np::neighbor_radius, 0.0, "surface_types", "neighbor_radius");
  internal::Curvature_field field = internal::curvature_tensors(flat);
  if (radius > 0) field.tensors = internal::average_tensors(flat, field, radius);
  std::size_t i = 0;
  for (auto v : vertices(mesh)) {
    const internal::Curvature_tensor& t = field.tensors[i++];
    put(type_map, v, surface_type(t.minimum(), t.maximum(), tolerance));
  }
  return internal::count_surface_types(field, tolerance);
}

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_REDUCTION_SURFACE_TYPES_H
