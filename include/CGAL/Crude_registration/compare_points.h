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

#ifndef CGAL_CRUDE_REGISTRATION_COMPARE_POINTS_H
#define CGAL_CRUDE_REGISTRATION_COMPARE_POINTS_H

// What points of one scan meet where another one lies.

#include <CGAL/Crude_registration/Scan.h>
#include <CGAL/Crude_registration/internal/judgement/compare_points.h>

#include <CGAL/Aff_transformation_3.h>

#include <cstddef>
#include <iterator>
#include <limits>
#include <vector>

namespace CGAL {
namespace Crude_registration {

/*!
\ingroup PkgCrudeRegistrationRef

What a point of one scan meets in another scan, see `compare_points()`.
*/
template <class Kernel>
struct Compared_point
{
  /// The distance from the other scan's surface along its normal, above zero in front of it, in the unit of the
  /// coordinates; infinite where no surface is near: neither within two sampling distances nor within what the other
  /// scan is reduced to.
  double distance = (std::numeric_limits<double>::infinity)();

  /// The unit normal of that surface, in the frame of the other scan; null where there is none near.
  typename Kernel::Vector_3 normal = NULL_VECTOR;

  /// Whether the point lies where the other scan's sensor saw that there is nothing: more than three sampling distances
  /// in front of what was seen, and not on its surface.
  bool is_in_free_space = false;
};

/*!
\ingroup PkgCrudeRegistrationRef

\brief says of points of one scan what they meet in another one: how far they are from its surface, and whether they lie
in its free space. This is what the judge asks of the samples that it looks at.

\tparam PointRange a model of `Range` whose value type is a `Point_3`

\param points points in the frame of `scan`'s input
\param scan the scan that the points are of
\param other the other scan; it may be the same one, which tells the normals at the points
\param motion a rigid motion (not checked), from the frame of `scan` to that of `other`

\return for each point what it meets, in their order
*/
template <class PointRange, class Kernel>
std::vector<Compared_point<Kernel>> compare_points(const PointRange& points, const Scan<Kernel>& scan,
                                                   const Scan<Kernel>& other,
                                                   const Aff_transformation_3<Kernel>& motion)
{
  std::vector<internal::Vector> positions;
  positions.reserve(static_cast<std::size_t>(std::distance(std::begin(points), std::end(points))));
  for (const auto& point : points) positions.push_back(internal::to_vector(point));
  std::vector<Compared_point<Kernel>> met;
  met.reserve(positions.size());
  for (const internal::Met_surface& surface :
       internal::compare_points(positions, scan.reduced(), other.reduced(), internal::to_rigid_motion(motion))) {
    const internal::Vector& n = surface.normal;
    met.push_back({surface.distance, typename Kernel::Vector_3(n.x(), n.y(), n.z()), surface.is_in_free_space});
  }
  return met;
}

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_COMPARE_POINTS_H
