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

#ifndef CGAL_CRUDE_REGISTRATION_MATCHING_TRIHEDRON_CANDIDATES_H
#define CGAL_CRUDE_REGISTRATION_MATCHING_TRIHEDRON_CANDIDATES_H

// The way of the paper to propose motions: spatial trihedra of the simplified mesh of the source, in that of the
// target.

#include <CGAL/Crude_registration/internal/base/compiled.h>
#include <CGAL/Crude_registration/internal/base/for_each_index.h>
#include <CGAL/Crude_registration/internal/matching/Candidate_source.h>
#include <CGAL/Crude_registration/internal/matching/Proposed_motions.h>
#include <CGAL/Crude_registration/internal/matching/extents.h>
#include <CGAL/Crude_registration/internal/reduction/simplify_flat_scan.h>
#include <CGAL/Crude_registration/internal/sampling/flat_image_triangulation.h>
#include <CGAL/Crude_registration/internal/sampling/flat_point_triangulation.h>
#include <CGAL/Crude_registration/named_parameters.h>

#include <array>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace CGAL {
namespace Crude_registration {

/*!
\ingroup PkgCrudeRegistrationRef

\brief proposes motions by the method of the paper: spatial trihedra of the simplified mesh of the source, matched
exhaustively in that of the target.

Each scan is simplified by `simplify_scan()` to its \f$ S \f$- or \f$ D \f$-mesh. A `Spatial_trihedron` at each vertex
of \f$ S \f$, with axes from \f$ f_1 M \f$ to \f$ f_2 M \f$, is looked for in the whole of \f$ D \f$
(`match_trihedra()`): on a sphere, on a circle, and at the place of the fourth vertex. Every correspondence gives a
motion, which is applied; those that align \f$ S \f$ best over \f$ D \f$ are proposed. Wider tolerances and more
trihedra follow as long as no motion is certain.

A `Scan` that is to be registered in this way has to be made with this generator as its parameter `candidates`;
`register_meshes()` sees to that.

\cgalModels{CandidateGenerator}
*/
class Trihedron_candidates
{
public:
  /*!
  \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below; where they
         are given to `register_meshes()` or `register_scans()`, those count

  \cgalNamedParamsBegin
    \cgalParamNBegin{minimum_extent}
      \cgalParamDescription{\f$ f_1 \f$: no axis of a trihedron is shorter than this share of the mean extent \f$ M \f$
                            of the scan}
      \cgalParamType{`double`, zero or above}
      \cgalParamDefault{`0`}
    \cgalParamNEnd
    \cgalParamNBegin{maximum_extent}
      \cgalParamDescription{\f$ f_2 \f$: no axis is longer than this share of \f$ M \f$}
      \cgalParamType{`double`, above `minimum_extent`}
      \cgalParamDefault{`0.3`}
    \cgalParamNEnd
    \cgalParamNBegin{tolerance}
      \cgalParamDescription{how far vertices that correspond may lie from the same place of the surface, a length}
      \cgalParamType{`double`, above zero}
      \cgalParamDefault{0.7 times the median edge length of the \f$ D \f$-mesh; 0.8 in the last pass}
    \cgalParamNEnd
    \cgalParamNBegin{use_normals}
      \cgalParamDescription{whether normals take part in the comparison, beside curvatures}
      \cgalParamType{`bool`}
      \cgalParamDefault{`true`}
      \cgalParamExtra{The paper compares curvatures alone, which leaves many more candidates to the noise of a scan.}
    \cgalParamNEnd
  \cgalNamedParamsEnd

  The simplification of each scan is that scan's: its parameters `approximation_error`, `number_of_vertices` and
  `cell_size`, as `simplify_scan()` reads them, are given to `Scan`, or to `register_meshes()` for either mesh.

  \throws std::invalid_argument if not \f$ 0 \le f_1 < f_2 \f$, or a number is not finite or out of its range
  */
  template <class NamedParameters = parameters::Default_named_parameters>
  explicit Trihedron_candidates(const NamedParameters& np = parameters::default_values())
  {
    *this = with(np, "Trihedron_candidates");
  }

  /// starts to propose motions of `source` to `target`, two `Scan`s, which are kept by reference.
  template <class ConcurrencyTag = CGAL::Sequential_tag, class Scan>
  auto rounds(const Scan& source, const Scan& target) const
  {
    return internal::Proposed_motions<typename Scan::Kernel>(
        candidates(source.reduced(), target.reduced(), internal::execution<ConcurrencyTag>()), source.reduced(),
        target.reduced());
  }

  /// \cond SKIP_IN_MANUAL
  // With what the parameters of `function` say.
  template <class NamedParameters>
  Trihedron_candidates with(const NamedParameters& np, const std::string& function) const
  {
    Trihedron_candidates result = *this;
    result.m_extents = internal::extent_parameters(np, function, m_extents);
    if constexpr (internal::is_given<NamedParameters, internal_np::tolerance_t>)
      result.m_tolerance = internal::positive_parameter(np, internal_np::tolerance, 1, function.c_str(), "tolerance");
    result.m_use_normals = internal::parameter(np, internal_np::use_normals, m_use_normals);
    return result;
  }

  // Adds the simplified mesh of a scan to what it was reduced to.
  template <class NamedParameters>
  void prepare(const internal::Flat_mesh& dense, const internal::Flat_sensor& sensor,
               const internal::Flat_range_image* image, const NamedParameters& np, const std::string& name,
               internal::Run_control& control, internal::Reduced_scan& scan) const
  {
    internal::Simplification_options options;
    if constexpr (internal::is_given<NamedParameters, internal_np::approximation_error_t>)
      options.approximation_error = internal::non_negative_parameter(np, internal_np::approximation_error, 0,
                                                                     name.c_str(), "approximation_error");
    if constexpr (internal::is_given<NamedParameters, internal_np::number_of_vertices_t>)
      options.number_of_vertices = internal::count_parameter(np, internal_np::number_of_vertices, std::size_t(0), 0,
                                                             name.c_str(), "number_of_vertices");
    options.cell_size = internal::non_negative_parameter(np, internal_np::cell_size, 0, name.c_str(), "cell_size");
    scan.simplified = internal::simplify_flat_scan(dense, sensor, image, scan, options, control);
  }

  // The same for points, which are triangulated first.
  template <class NamedParameters>
  void prepare(const std::vector<internal::Vector>& points, const internal::Flat_sensor& sensor,
               const NamedParameters& np, const std::string& name, internal::Run_control& control,
               internal::Reduced_scan& scan) const
  {
    prepare(internal::flat_triangulation(points, sensor, internal::default_maximum_edge_ratio, control), sensor,
            nullptr, np, name, control, scan);
  }

  std::unique_ptr<internal::Candidate_source> candidates(const internal::Reduced_scan& source,
                                                         const internal::Reduced_scan& target,
                                                         internal::Execution execution) const;
  /// \endcond

private:
  std::array<double, 2> m_extents{{0, internal::default_maximum_extent}};
  double m_tolerance = 0; // not given
  bool m_use_normals = true;
};

} // namespace Crude_registration
} // namespace CGAL

#ifndef CGAL_CRUDE_REGISTRATION_COMPILED
#include <CGAL/Crude_registration/internal/matching/Trihedron_candidates_impl.h>
#endif

#endif // CGAL_CRUDE_REGISTRATION_MATCHING_TRIHEDRON_CANDIDATES_H
