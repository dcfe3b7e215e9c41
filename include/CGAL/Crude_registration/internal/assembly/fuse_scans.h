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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_FUSE_SCANS_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_FUSE_SCANS_H

// The surface of many scans as one, to register others with.

#include <CGAL/Crude_registration/internal/assembly/Placed_scans.h>
#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/internal/base/Run_control.h>
#include <CGAL/Crude_registration/internal/base/compiled.h>
#include <CGAL/Crude_registration/internal/reduction/Reduced_scan.h>

#include <cstddef>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The surfaces of some scans as they lie, `poses` by the indices of the scans, at the resolutions of the median one.
// What their sensors saw to be empty is not part of it.
Reduced_scan fuse_scans(const Placed_scans& placed, const std::vector<std::size_t>& scans,
                        const std::vector<Rigid_motion>& poses, Run_control& control);

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#ifndef CGAL_CRUDE_REGISTRATION_COMPILED
#include <CGAL/Crude_registration/internal/assembly/fuse_scans_impl.h>
#endif

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_FUSE_SCANS_H
