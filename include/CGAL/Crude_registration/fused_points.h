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

#ifndef CGAL_CRUDE_REGISTRATION_FUSED_POINTS_H
#define CGAL_CRUDE_REGISTRATION_FUSED_POINTS_H

// The surfaces of assembled scans as one set of oriented points.

#include <CGAL/Crude_registration/Assembly_result.h>
#include <CGAL/Crude_registration/Scan.h>
#include <CGAL/Crude_registration/internal/assembly/Placed_scans.h>
#include <CGAL/Crude_registration/internal/assembly/fuse_scans.h>
#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/internal/base/Run_control.h>

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {

/*!
\ingroup PkgCrudeRegistrationRef

\brief returns the surfaces of the scans of a component as one: points with unit normals, evenly spaced, about as far
apart as those of the scan of median resolution. A reconstruction of the surface can start from them.

\tparam Kernel a model of `Kernel`

\param result what `assemble_scans()` found
\param scans the scans that were assembled, in the same order
\param component the component; of the largest one it is 0

\return the points with their normals, in the frame of the component; always in the same order

\throws std::invalid_argument if the number of scans is not that of `result`
*/
template <class Kernel>
std::vector<std::pair<typename Kernel::Point_3, typename Kernel::Vector_3>>
fused_points(const Assembly_result<Kernel>& result, const std::vector<Scan<Kernel>>& scans, std::size_t component = 0)
{
  if (scans.size() != result.scans().size())
    throw std::invalid_argument("fused_points: scans has " + std::to_string(scans.size()) + " scans, result " +
                                std::to_string(result.scans().size()));
  std::vector<const internal::Reduced_scan*> reduced;
  std::vector<internal::Rigid_motion> poses;
  std::vector<std::size_t> members;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    reduced.push_back(&scans[i].reduced());
    poses.push_back(internal::to_rigid_motion(result.pose(i)) * scans[i].reduced().own_from_input.inverse());
    if (result.component(i) == component) members.push_back(i);
  }
  std::vector<std::pair<typename Kernel::Point_3, typename Kernel::Vector_3>> points;
  if (members.empty()) return points;
  const internal::Reduced_scan fused =
      internal::fuse_scans(internal::Placed_scans(reduced), members, poses, internal::to_the_end());
  points.reserve(fused.fine.surfels.size());
  for (const internal::Surfel& s : fused.fine.surfels)
    points.emplace_back(typename Kernel::Point_3(double(s.position[0]), double(s.position[1]), double(s.position[2])),
                        typename Kernel::Vector_3(double(s.normal[0]), double(s.normal[1]), double(s.normal[2])));
  return points;
}

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_FUSED_POINTS_H
