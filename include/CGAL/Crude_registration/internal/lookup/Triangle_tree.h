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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_LOOKUP_TRIANGLE_TREE_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_LOOKUP_TRIANGLE_TREE_H

// CGAL's tree of triangles, under the names that its versions have for it.

#include <CGAL/AABB_tree.h>
#include <CGAL/version.h>
#if CGAL_VERSION_NR >= CGAL_VERSION_NUMBER(6, 0, 0)
#include <CGAL/AABB_traits_3.h>
#include <CGAL/AABB_triangle_primitive_3.h>
#else
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_triangle_primitive.h>
#endif

#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// CGAL's AABB tree of triangles in a vector, which has to stay where it is. (CGAL 6 has other names for its parts.)
template <class Kernel>
struct Triangle_tree
{
  using Triangles = std::vector<typename Kernel::Triangle_3>;
#if CGAL_VERSION_NR >= CGAL_VERSION_NUMBER(6, 0, 0)
  using Primitive = CGAL::AABB_triangle_primitive_3<Kernel, typename Triangles::const_iterator>;
  using type = CGAL::AABB_tree<CGAL::AABB_traits_3<Kernel, Primitive>>;
#else
  using Primitive = CGAL::AABB_triangle_primitive<Kernel, typename Triangles::const_iterator>;
  using type = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
#endif
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_LOOKUP_TRIANGLE_TREE_H
