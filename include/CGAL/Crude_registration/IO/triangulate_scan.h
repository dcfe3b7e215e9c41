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

#ifndef CGAL_CRUDE_REGISTRATION_IO_TRIANGULATE_SCAN_H
#define CGAL_CRUDE_REGISTRATION_IO_TRIANGULATE_SCAN_H

// The surface of what was found in a file.

#include <CGAL/Crude_registration/IO/read_scan.h>
#include <CGAL/Crude_registration/named_parameters.h>
#include <CGAL/Crude_registration/sampling/triangulate_points.h>
#include <CGAL/Crude_registration/sampling/triangulate_range_image.h>

#include <CGAL/Surface_mesh.h>

namespace CGAL {
namespace Crude_registration {

/*!
\ingroup PkgCrudeRegistrationRef

\brief returns the surface of what `read_scan()` found in a file: a range image is triangulated by
`triangulate_range_image()`, points by `triangulate_points()`, a mesh is copied.

\tparam Kernel a model of `Kernel`
\tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"

\param file what was found
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below

\cgalNamedParamsBegin
  \cgalParamNBegin{viewpoint}
    \cgalParamDescription{where the sensor stood, in the frame of the file; read for points}
    \cgalParamType{a `Point_3`}
    \cgalParamDefault{not known}
    \cgalParamExtra{excludes `viewing_direction`}
  \cgalParamNEnd
  \cgalParamNBegin{viewing_direction}
    \cgalParamDescription{the direction of parallel lines of sight, from the sensor into the scene, of any length; read
                          for points}
    \cgalParamType{a `Vector_3`, not null}
    \cgalParamDefault{not known}
  \cgalParamNEnd
  \cgalParamNBegin{maximum_edge_ratio}
    \cgalParamDescription{the length of the longest edge, in sampling distances; read for range images and points}
    \cgalParamType{`double`}
    \cgalParamDefault{`5`}
  \cgalParamNEnd
\cgalNamedParamsEnd

\return the surface, in the unit and frame of the file; without a face where no three samples can be joined

\throws std::invalid_argument as the two functions do
*/
template <class Kernel, class NamedParameters = parameters::Default_named_parameters>
CGAL::Surface_mesh<typename Kernel::Point_3> triangulate_scan(const Scan_file<Kernel>& file,
                                                              const NamedParameters& np = parameters::default_values())
{
  if (file.kind == Scan_file<Kernel>::MESH) return file.mesh;
  CGAL::Surface_mesh<typename Kernel::Point_3> mesh;
  if (file.kind == Scan_file<Kernel>::RANGE_IMAGE) triangulate_range_image(file.image, mesh, np);
  else triangulate_points(file.points, mesh, np);
  return mesh;
}

#ifdef CGAL_CRUDE_REGISTRATION_COMPILED
// The kernel that most programs use is compiled with the core.
extern template CGAL::Surface_mesh<Exact_predicates_inexact_constructions_kernel::Point_3>
triangulate_scan(const Scan_file<Exact_predicates_inexact_constructions_kernel>&,
                 const parameters::Default_named_parameters&);
#endif

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_TRIANGULATE_SCAN_H
