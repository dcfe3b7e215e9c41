// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_TEST_MESH_OF_H
#define CGAL_CRUDE_REGISTRATION_TEST_MESH_OF_H

// A flat mesh as a model of FaceGraph, and back.

#include <CGAL/Crude_registration/internal/mesh/add_flat_mesh.h>
#include <CGAL/Crude_registration/internal/mesh/to_flat_mesh.h>

template <class FaceGraph>
FaceGraph mesh_of(const CGAL::Crude_registration::internal::Flat_mesh& flat)
{
  FaceGraph mesh;
  CGAL::Crude_registration::internal::add_flat_mesh(flat, mesh, CGAL::parameters::default_values());
  return mesh;
}

template <class FaceGraph>
CGAL::Crude_registration::internal::Flat_mesh flat_mesh_of(const FaceGraph& mesh)
{
  return CGAL::Crude_registration::internal::to_flat_mesh(mesh, CGAL::parameters::default_values(), "flat_mesh_of",
                                                          "mesh");
}

#endif // CGAL_CRUDE_REGISTRATION_TEST_MESH_OF_H
