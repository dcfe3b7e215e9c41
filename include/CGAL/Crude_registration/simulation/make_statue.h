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

#ifndef CGAL_CRUDE_REGISTRATION_SIMULATION_MAKE_STATUE_H
#define CGAL_CRUDE_REGISTRATION_SIMULATION_MAKE_STATUE_H

// Makes a body to be scanned, and what it may stand on.

#include <CGAL/Crude_registration/internal/simulation/statue_mesh.h>
#include <CGAL/Crude_registration/internal/mesh/add_flat_mesh.h>
#include <CGAL/Crude_registration/named_parameters.h>

#include <cstdint>
#include <stdexcept>

namespace CGAL {
namespace Crude_registration {

/*!
\ingroup PkgCrudeRegistrationRef

\brief makes a body without any symmetry, as the object of simulated scans: torso, head, horns, bent limbs, bumps,
hollows and a fine relief, all of which occlude each other.

The mesh is closed, oriented outwards, connected and made of triangles. It is about 2 units tall along the z-axis, and
its center is near the origin. The number of faces grows as the square of `resolution`: about 95,000 for 96. The mesh is
the same, bit by bit, for the same `resolution` and seed.

\tparam FaceGraph a model of `MutableFaceGraph`
\tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"

\param mesh the output; the body is added to what it holds
\param resolution the number of lattice cells along the longest side of the body, from 8 to 1000. The time is its cube
(0.3 seconds for 96), the memory its square.
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below

\cgalNamedParamsBegin
  \cgalParamNBegin{random_seed}
    \cgalParamDescription{says which of the bodies to make}
    \cgalParamType{`unsigned int`}
    \cgalParamDefault{`0`}
  \cgalParamNEnd
  \cgalParamNBegin{vertex_point_map}
    \cgalParamDescription{a property map associating points to the vertices of `mesh`}
    \cgalParamType{a class model of `ReadWritePropertyMap` with `boost::graph_traits<FaceGraph>::%vertex_descriptor`
                   as key type and a `Point_3` as value type}
    \cgalParamDefault{`boost::get(CGAL::vertex_point, mesh)`}
  \cgalParamNEnd
\cgalNamedParamsEnd

\throws std::invalid_argument if `resolution` is out of range.
*/
template <class FaceGraph, class NamedParameters = parameters::Default_named_parameters>
void make_statue(FaceGraph& mesh, int resolution, const NamedParameters& np = parameters::default_values())
{
  if (resolution < 8 || resolution > 1000)
    throw std::invalid_argument("make_statue: resolution has to be from 8 to 1000");
  const auto seed = static_cast<std::uint64_t>(internal::parameter(np, internal_np::random_seed, 0u));
  internal::add_flat_mesh(internal::statue_mesh(seed, resolution), mesh, np);
}

/*!
\ingroup PkgCrudeRegistrationRef

\brief makes a pedestal: a closed box with a square base about the z-axis. Alone it fits itself in several ways, with
more surface than what stands on it may have.

\tparam FaceGraph a model of `MutableFaceGraph`
\tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"

\param mesh the output; the box is added to what it holds
\param side the side of the base
\param bottom, top the z-coordinates of its lower and its upper side
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters": `vertex_point_map` as of `make_statue()`

\throws std::invalid_argument unless `side` is above zero and `top` above `bottom`.
*/
template <class FaceGraph, class NamedParameters = parameters::Default_named_parameters>
void make_pedestal(FaceGraph& mesh, double side, double bottom, double top,
                   const NamedParameters& np = parameters::default_values())
{
  if (!(side > 0 && top > bottom))
    throw std::invalid_argument("make_pedestal: side has to be above zero, and top above bottom");
  internal::Flat_mesh box;
  for (int k = 0; k < 8; ++k)
    box.points.push_back(
        internal::Vector((k & 1 ? 0.5 : -0.5) * side, (k & 2 ? 0.5 : -0.5) * side, k & 4 ? top : bottom));
  box.faces = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
               {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  internal::add_flat_mesh(box, mesh, np);
}

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_SIMULATION_MAKE_STATUE_H
