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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_FLAT_IMAGE_TRIANGULATION_IMPL_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_FLAT_IMAGE_TRIANGULATION_IMPL_H

// The triangulation of range images, behind its door.

#include <CGAL/Crude_registration/internal/sampling/Flat_triangulation.h>
#include <CGAL/Crude_registration/internal/sampling/flat_image_triangulation.h>

namespace CGAL {
namespace Crude_registration {
namespace internal {

CGAL_CRUDE_REGISTRATION_INLINE Flat_mesh flat_triangulation(const Flat_range_image& image, const Sampling& sampling,
                                                            double maximum_edge_ratio, Run_control& control)
{
  return Flat_triangulation(image, sampling, maximum_edge_ratio, control)();
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_FLAT_IMAGE_TRIANGULATION_IMPL_H
