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

#ifndef CGAL_CRUDE_REGISTRATION_REDUCTION_PRINCIPAL_CURVATURES_H
#define CGAL_CRUDE_REGISTRATION_REDUCTION_PRINCIPAL_CURVATURES_H

// The principal curvatures at the vertices of a mesh.

#include <CGAL/Crude_registration/internal/reduction/Curvature_tensors.h>
#include <CGAL/Crude_registration/internal/mesh/to_flat_mesh.h>
#include <CGAL/Crude_registration/named_parameters.h>

#include <CGAL/Origin.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Crude_registration {

/*!
 * \ingroup PkgCrudeRegistrationRef
 *
 * \brief the minimal and maximal curvature of a surface at a point, in 1/length, and their directions.
 *
 * Curvatures are positive where the surface is convex seen from outside (from the side the faces are counterclockwise
 * from, that of the sensor): a sphere of radius r with outward faces has 1/r twice. `minimum <= maximum` as signed
 * numbers. The directions are perpendicular unit vectors in the tangent plane, their signs arbitrary; null vectors at a
 * vertex that has no face of positive area, whose curvatures are 0.
 *
 * \tparam Kernel a model of `Kernel`
 */
template <class Kernel>
struct Principal_curvatures
{
  typedef typename Kernel::FT FT;
  typedef typename Kernel::Vector_3 Vector_3;

  FT minimum = 0;
  FT maximum = 0;
  Vector_3 minimum_direction = CGAL::NULL_VECTOR;
  Vector_3 maximum_direction = CGAL::NULL_VECTOR;
};

/*!
 * \ingroup PkgCrudeRegistrationRef
 *
 * \brief computes the principal curvatures at the vertices of a triangle mesh.
 *
 * The method is that of Rusinkiewicz (Estimating curvatures and their derivatives on triangle meshes, 3DPVT 2004): on
 * each face the second fundamental form that explains the differences of the vertices' normals along the edges best,
 * averaged at each vertex with the areas of the face's corners. It needs no neighbourhood beyond the faces at a vertex,
 * is linear in the size of the mesh, and its error shrinks with the length of the edges. On a border the normals are
 * one-sided and the curvatures unreliable. At the resolution of a scan curvatures are mostly noise: `neighbor_radius`
 * averages the tensors over a neighbourhood.
 *
 * \tparam FaceGraph a model of `FaceListGraph`
 * \tparam VertexCurvatureMap a model of `WritablePropertyMap` with `boost::graph_traits<FaceGraph>::%vertex_descriptor`
 * as key type and `Principal_curvatures<Kernel>`, for any kernel with inexact constructions, as value type
 * \tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"
 *
 * \param mesh the mesh
 * \param curvature_map receives the curvatures of every vertex
 * \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below
 *
 * \cgalNamedParamsBegin
 *   \cgalParamNBegin{vertex_point_map}
 *     \cgalParamDescription{a property map associating points to the vertices of `mesh`}
 *     \cgalParamType{a class model of `ReadablePropertyMap` with `boost::graph_traits<FaceGraph>::%vertex_descriptor`
 *                    as key type and a `Point_3` as value type}
 *     \cgalParamDefault{`get(CGAL::vertex_point, mesh)`}
 *   \cgalParamNEnd
 *   \cgalParamNBegin{neighbor_radius}
 *     \cgalParamDescription{a length: the tensors of the vertices connected to a vertex within this distance are
 *                           averaged, the distance being cut off, down to its half, at the border of the mesh. The
 *                           cost is proportional to the number of vertices within it}
 *     \cgalParamType{`double`, zero or above}
 *     \cgalParamDefault{`0`: no average}
 *     \cgalParamExtra{a name of `CGAL::parameters`}
 *   \cgalParamNEnd
 * \cgalNamedParamsEnd
 *
 * \throws std::invalid_argument if a face of `mesh` is not a triangle, a coordinate is not finite, or the radius is
 * negative or not finite.
 */
template <class FaceGraph, class VertexCurvatureMap, class NamedParameters = parameters::Default_named_parameters>
void principal_curvatures(const FaceGraph& mesh, VertexCurvatureMap curvature_map,
                          const NamedParameters& np = parameters::default_values())
{
  using Curvatures = typename boost::property_traits<VertexCurvatureMap>::value_type;
  using FT = typename Curvatures::FT;
  using Vector_3 = typename Curvatures::Vector_3;

  const internal::Flat_mesh flat = internal::to_flat_mesh(mesh, np, "principal_curvatures", "mesh");
  const double radius = internal::non_negative_parameter(np, internal_np::neighbor_radius, 0.0, "principal_curvatures",
                                                         "neighbor_radius");
  internal::Curvature_field field = internal::curvature_tensors(flat);
  if (radius > 0) field.tensors = internal::average_tensors(flat, field, radius);

  std::size_t i = 0;
  for (auto v : vertices(mesh)) {
    Curvatures result;
    if (field.areas[i] > 0) {
      const internal::Curvature_tensor& t = field.tensors[i];
      const internal::Tangent_frame frame(field.normals[i]);
      const std::array<double, 2> d = t.direction_of_maximum();
      const internal::Vector maximum = d[0] * frame.u + d[1] * frame.v, minimum = d[0] * frame.v - d[1] * frame.u;
      result.minimum = FT(t.minimum());
      result.maximum = FT(t.maximum());
      result.minimum_direction = Vector_3(minimum.x(), minimum.y(), minimum.z());
      result.maximum_direction = Vector_3(maximum.x(), maximum.y(), maximum.z());
    }
    put(curvature_map, v, result);
    ++i;
  }
}

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_REDUCTION_PRINCIPAL_CURVATURES_H
