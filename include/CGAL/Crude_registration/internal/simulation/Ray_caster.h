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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_SIMULATION_RAY_CASTER_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_SIMULATION_RAY_CASTER_H

// A triangle mesh that says where a line of sight meets it first.

#include <CGAL/Crude_registration/internal/base/compiled.h>
#include <CGAL/Crude_registration/internal/mesh/Flat_mesh.h>

#include <memory>

namespace CGAL {
namespace Crude_registration {
namespace internal {

class Ray_caster
{
public:
  struct Hit
  {
    double distance; // zero: none
    double cosine;   // between normal and line of sight, in [0, 1]
  };

  // \throws std::invalid_argument where the mesh has no face of positive area
  explicit Ray_caster(const Flat_mesh& mesh);
  ~Ray_caster();
  Ray_caster(const Ray_caster&) = delete;
  Ray_caster& operator=(const Ray_caster&) = delete;

  // `direction`: unit
  Hit first_hit(const Vector& origin, const Vector& direction) const;

private:
  struct Tree;
  std::unique_ptr<const Tree> m_tree;
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#ifndef CGAL_CRUDE_REGISTRATION_COMPILED
#include <CGAL/Crude_registration/internal/simulation/Ray_caster_impl.h>
#endif

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_SIMULATION_RAY_CASTER_H
