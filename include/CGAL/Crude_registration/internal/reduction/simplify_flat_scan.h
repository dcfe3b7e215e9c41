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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_SIMPLIFY_FLAT_SCAN_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_SIMPLIFY_FLAT_SCAN_H

// The simplified mesh of a scan, from its dense mesh: sections 4 and 5 of the paper, for the search for trihedra.

#include <CGAL/Crude_registration/internal/base/Run_control.h>
#include <CGAL/Crude_registration/internal/base/compiled.h>
#include <CGAL/Crude_registration/internal/mesh/Flat_mesh.h>
#include <CGAL/Crude_registration/internal/reduction/Reduced_scan.h>
#include <CGAL/Crude_registration/internal/sampling/Flat_range_image.h>

#include <cstddef>
#include <memory>
#include <optional>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// How far: as simplify_scan() reads its parameters. What is not given is the paper's.
struct Simplification_options
{
  std::optional<double> approximation_error;
  std::optional<std::size_t> number_of_vertices;
  double cell_size = 0;
};

// `dense`: the mesh of the scan, in the frame of the input; `image`: the range image that it is the triangulation of,
// or null; `scan`: the same scan, reduced. \throws Run_control::Stopped
std::shared_ptr<const Simplified_scan> simplify_flat_scan(const Flat_mesh& dense, const Flat_sensor& sensor,
                                                          const Flat_range_image* image, const Reduced_scan& scan,
                                                          const Simplification_options& options, Run_control& control);

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#ifndef CGAL_CRUDE_REGISTRATION_COMPILED
#include <CGAL/Crude_registration/internal/reduction/simplify_flat_scan_impl.h>
#endif

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_SIMPLIFY_FLAT_SCAN_H
