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

// The part sampling of the compiled core.

#include <CGAL/Crude_registration/internal/sampling/estimate_flat_sensor_impl.h>
#include <CGAL/Crude_registration/internal/sampling/flat_image_triangulation_impl.h>
#include <CGAL/Crude_registration/internal/sampling/flat_point_triangulation_impl.h>
#include <CGAL/Crude_registration/internal/sampling/join_points_impl.h>
#include <CGAL/Crude_registration/internal/sampling/orient_points_impl.h>
