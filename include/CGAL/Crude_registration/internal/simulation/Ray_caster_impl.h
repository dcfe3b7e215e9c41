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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_SIMULATION_RAY_CASTER_IMPL_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_SIMULATION_RAY_CASTER_IMPL_H

// The rays of Ray_caster.h, on CGAL's AABB tree.

#include <CGAL/Crude_registration/internal/lookup/Triangle_tree.h>
#include <CGAL/Crude_registration/internal/mesh/mesh_geometry.h>
#include <CGAL/Crude_registration/internal/simulation/Ray_caster.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>
#include <cstddef>
#include <memory>
#include <stdexcept>

namespace CGAL {
namespace Crude_registration {
namespace internal {

struct Ray_caster::Tree
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

  explicit Tree(const Flat_mesh& mesh)
  {
    const auto point = [&](std::int32_t i) {
      const Vector& p = mesh.points[std::size_t(i)];
      return Kernel::Point_3(p.x(), p.y(), p.z());
    };
    triangles.reserve(mesh.faces.size());
    for (const auto& f : mesh.faces) {
      const Kernel::Triangle_3 triangle(point(f[0]), point(f[1]), point(f[2]));
      if (!triangle.is_degenerate()) triangles.push_back(triangle);
    }
    if (triangles.empty()) throw std::invalid_argument("simulate_range_image: mesh has no face of positive area");
    tree.rebuild(triangles.cbegin(), triangles.cend());
    tree.build();
  }

  Triangle_tree<Kernel>::Triangles triangles;
  Triangle_tree<Kernel>::type tree;
};

CGAL_CRUDE_REGISTRATION_INLINE Ray_caster::Ray_caster(const Flat_mesh& mesh) : m_tree(std::make_unique<Tree>(mesh)) {}

CGAL_CRUDE_REGISTRATION_INLINE Ray_caster::~Ray_caster() = default;

CGAL_CRUDE_REGISTRATION_INLINE Ray_caster::Hit Ray_caster::first_hit(const Vector& origin,
                                                                     const Vector& direction) const
{
  using Kernel = Tree::Kernel;
  const Kernel::Ray_3 ray(Kernel::Point_3(origin.x(), origin.y(), origin.z()),
                          Kernel::Vector_3(direction.x(), direction.y(), direction.z()));
  const auto primitive = m_tree->tree.first_intersected_primitive(ray);
  if (!primitive) return {0, 0};
  const auto vertex = [&](int i) { return to_vector((*primitive)->vertex(i)); };
  const Vector a = vertex(0);
  const Vector normal = unit_or_zero(area_vector(a, vertex(1), vertex(2)));
  const double cosine = normal.dot(direction);
  if (!(std::abs(cosine) > 1e-9)) return {0, 0}; // seen edge-on: the depth is not defined
  return {normal.dot(a - origin) / cosine, std::abs(cosine)};
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_SIMULATION_RAY_CASTER_IMPL_H
