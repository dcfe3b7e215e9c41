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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_RELAX_POSES_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_RELAX_POSES_H

// Refines the poses of all scans of a part together.

#include <CGAL/Crude_registration/internal/assembly/Placed_scans.h>
#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/internal/base/Run_control.h>
#include <CGAL/Crude_registration/internal/base/compiled.h>
#include <CGAL/Crude_registration/internal/base/for_each_index.h>
#include <CGAL/Crude_registration/internal/motion/twist.h>

#include <cstddef>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// How a scan lies on another one.
struct Relaxed_pair
{
  std::size_t source, target;
  double overlap = 0;  // the share of the source's probes that have a match
  double residual = 0; // RMS along the normals, in sampling distances
};

struct Relaxation
{
  std::vector<Rigid_motion> poses;   // of the scans that were given, in their order
  std::vector<Matrix_6> covariances; // of small motions behind the poses, in the frame of the part
  std::vector<double> residuals;     // of each scan, in sampling distances
  std::vector<Relaxed_pair> pairs;
  std::size_t iterations = 0;
  double objective = 0, initial_objective = 0; // never above that of the start
};

// `scans`: of the part; `poses`: part from own, of each of them; `bodies`: 0 for those that stay as they are, and a
// number from 1 on for each of the others, the same for scans that are fixed to each other. All poses are moved so that
// the surfaces come together wherever two of them overlap: the sum over all pairs of the robust point-to-plane
// distances becomes least. Where it does not become less, the poses stay.
Relaxation relax_poses(const Placed_scans& placed, const std::vector<std::size_t>& scans,
                       const std::vector<Rigid_motion>& poses, const std::vector<std::size_t>& bodies,
                       Execution execution, Run_control& control);

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#ifndef CGAL_CRUDE_REGISTRATION_COMPILED
#include <CGAL/Crude_registration/internal/assembly/relax_poses_impl.h>
#endif

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_RELAX_POSES_H
