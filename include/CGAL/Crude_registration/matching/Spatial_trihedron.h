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

#ifndef CGAL_CRUDE_REGISTRATION_MATCHING_SPATIAL_TRIHEDRON_H
#define CGAL_CRUDE_REGISTRATION_MATCHING_SPATIAL_TRIHEDRON_H

// The shape descriptor of the paper: four vertices that span a trihedron.

#include <array>

namespace CGAL {
namespace Crude_registration {

/*!
\ingroup PkgCrudeRegistrationRef

\brief the shape descriptor of section 5 of the paper: a vertex \f$ V \f$ of a simplified mesh and three more, at the
ends of three linearly independent, preferably orthogonal axes.

What is compared of a trihedron, besides its edge lengths and its handedness, belongs to its vertices: curvatures and
normals.

\tparam VertexDescriptor a type of vertices: `boost::graph_traits<Graph>::%vertex_descriptor` of the mesh
*/
template <class VertexDescriptor>
struct Spatial_trihedron
{
  VertexDescriptor origin;              ///< \f$ V \f$
  std::array<VertexDescriptor, 3> ends; ///< \f$ v_1, v_2, v_3 \f$

  friend bool operator==(const Spatial_trihedron& a, const Spatial_trihedron& b)
  {
    return a.origin == b.origin && a.ends == b.ends;
  }
  friend bool operator!=(const Spatial_trihedron& a, const Spatial_trihedron& b) { return !(a == b); }
};

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_MATCHING_SPATIAL_TRIHEDRON_H
