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

#ifndef CGAL_CRUDE_REGISTRATION_REGISTER_MESHES_H
#define CGAL_CRUDE_REGISTRATION_REGISTER_MESHES_H

// Registers two meshes: the generic call.

#include <CGAL/Crude_registration/Registration_result.h>
#include <CGAL/Crude_registration/Scan.h>
#include <CGAL/Crude_registration/internal/base/Run_control.h>
#include <CGAL/Crude_registration/internal/mesh/to_flat_mesh.h>
#include <CGAL/Crude_registration/named_parameters.h>
#include <CGAL/Crude_registration/register_scans.h>

#include <CGAL/Kernel_traits.h>
#include <CGAL/boost/graph/named_params_helper.h>

#include <string>
#include <type_traits>
#include <utility>

namespace CGAL {
namespace Crude_registration {

/*!
\ingroup PkgCrudeRegistrationRef

\brief registers two triangle meshes: finds the rigid motion that maps the source into the frame of the target, with no
knowledge of how they lie, and says whether it is to be believed.

The steps are those of the method: *reduce* each mesh to what registration looks at (a `Scan`), *propose* motions (the
parameter `candidates`), *judge* them by what agrees and by the free space of both, *refine* the best one, and
*conclude* how certain it is.

\tparam ConcurrencyTag `CGAL::Sequential_tag` (default), `CGAL::Parallel_tag` or `CGAL::Parallel_if_available_tag`; the
        answer is the same, bit by bit, with any number of threads
\tparam Source, Target models of `FaceListGraph`, not necessarily the same
\tparam Source_parameters, Target_parameters sequences of \ref bgl_namedparameters "Named Parameters"

\param source, target the meshes, faces counterclockwise seen from outside (from the sensor)
\param np_source, np_target optional sequences of \ref bgl_namedparameters "Named Parameters" among the ones listed
       below; those of `Scan` are read from both, those of the registration from `np_source`

\cgalNamedParamsBegin
  \cgalParamNBegin{vertex_point_map}
    \cgalParamDescription{a property map associating points to the vertices of the mesh; read from both}
    \cgalParamType{a class model of `ReadablePropertyMap` with `boost::graph_traits<Graph>::%vertex_descriptor` as key
                   type and a `Point_3` as value type}
    \cgalParamDefault{`boost::get(CGAL::vertex_point, graph)`}
  \cgalParamNEnd
  \cgalParamNBegin{viewpoint}
    \cgalParamDescription{where the sensor stood, in the frame of the mesh; read from both}
    \cgalParamType{a `Point_3`}
    \cgalParamDefault{not known, and with it what is free space}
    \cgalParamExtra{excludes `viewing_direction`}
  \cgalParamNEnd
  \cgalParamNBegin{viewing_direction}
    \cgalParamDescription{the direction of parallel lines of sight, from the sensor into the scene, of any length; read
                          from both}
    \cgalParamType{a `Vector_3`, not null}
    \cgalParamDefault{not known}
  \cgalParamNEnd
  \cgalParamNBegin{geom_traits}
    \cgalParamDescription{the kernel of the result; read from `np_source`}
    \cgalParamType{a model of `Kernel`}
    \cgalParamDefault{that of the points of `source`}
  \cgalParamNEnd
  \cgalParamNBegin{candidates}
    \cgalParamDescription{the way to propose motions: `Oriented_pair_candidates`, `Trihedron_candidates` (the method of
                          the paper), or a generator of your own}
    \cgalParamType{a model of `CandidateGenerator`}
    \cgalParamDefault{`Oriented_pair_candidates()`}
    \cgalParamExtra{The parameters of its constructor are read, too: `minimum_extent` and `maximum_extent`, of
                    `Trihedron_candidates` `tolerance` and `use_normals`.}
  \cgalParamNEnd
  \cgalParamNBegin{minimum_extent}
    \cgalParamDescription{\f$ f_1 \f$ of the paper: what is matched lies no closer to each other than this share of the
                          scan's mean extent \f$ M \f$}
    \cgalParamType{`double`, zero or above}
    \cgalParamDefault{`0`}
  \cgalParamNEnd
  \cgalParamNBegin{maximum_extent}
    \cgalParamDescription{\f$ f_2 \f$ of the paper: and no further away from each other than this share}
    \cgalParamType{`double`, above `minimum_extent`}
    \cgalParamDefault{`0.3`}
  \cgalParamNEnd
  \cgalParamNBegin{time_budget}
    \cgalParamDescription{seconds after which the run ends}
    \cgalParamType{`double`, above zero}
    \cgalParamDefault{none}
  \cgalParamNEnd
  \cgalParamNBegin{visitor}
    \cgalParamDescription{is told how far the run is, and may end it}
    \cgalParamType{a model of `RegistrationVisitor`, or a `std::reference_wrapper` of one}
    \cgalParamDefault{none}
    \cgalParamExtra{It is called by the calling thread, about once a millisecond.}
  \cgalParamNEnd
  \cgalParamNBegin{approximation_error, number_of_vertices, cell_size}
    \cgalParamDescription{how far `Trihedron_candidates` simplifies the mesh, see `simplify_scan()`; read from both}
    \cgalParamType{`double`; an integer; `double`}
    \cgalParamDefault{`approximation_error()` of the mesh; no limit; no grouping}
  \cgalParamNEnd
\cgalNamedParamsEnd

\return the answer; a failure is a status with its reason. `transformation()` maps the source to the target; source and
         target exchanged give the inverse.

\throws std::invalid_argument if a mesh has no face of positive area, a face that is not a triangle or a coordinate that
        is not finite, or a parameter is out of its range; the text names the argument

A time budget and a visitor are those of the whole run: where they end the reduction of the meshes the answer is
`NOT_REGISTERED`, and the reason says so. What is thrown by the visitor is passed on.

Complexity: linear in the size of the meshes (with `Trihedron_candidates`: \f$ O(n \log n) \f$), and the bounded time of
`register_scans()`.
*/
template <class ConcurrencyTag = CGAL::Sequential_tag, class Source, class Target,
          class Source_parameters = parameters::Default_named_parameters,
          class Target_parameters = parameters::Default_named_parameters>
auto register_meshes(const Source& source, const Target& target,
                     const Source_parameters& np_source = parameters::default_values(),
                     const Target_parameters& np_target = parameters::default_values())
{
  using Point =
      typename boost::property_traits<decltype(internal::const_vertex_point_map(source, np_source))>::value_type;
  using Default_kernel = typename Kernel_traits<Point>::Kernel;
  using Kernel = std::remove_cv_t<
      std::remove_reference_t<decltype(internal::parameter(np_source, internal_np::geom_traits, Default_kernel()))>>;
  const auto generator = internal::candidate_generator(np_source, "register_meshes");
  internal::Run_control control(internal::visitor_parameter(np_source),
                                internal::time_budget_parameter(np_source, "register_meshes"));
  try {
    const Scan<Kernel> reduced_source(source, np_source, generator, "register_meshes: source", control);
    const Scan<Kernel> reduced_target(target, np_target, generator, "register_meshes: target", control);
    return internal::register_scans<ConcurrencyTag>(reduced_source, reduced_target, generator, control);
  } catch (const internal::Run_control::Stopped&) {
    typename Registration_result<Kernel>::Parts parts;
    parts.reason = Preparation_interrupted("the scans").what();
    return Registration_result<Kernel>(std::move(parts));
  }
}

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_REGISTER_MESHES_H
