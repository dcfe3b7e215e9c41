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

// The part reduction of the compiled core.

#include <CGAL/Crude_registration/internal/reduction/Curvature_tensors_impl.h>
#include <CGAL/Crude_registration/internal/reduction/measure_scan_impl.h>
#include <CGAL/Crude_registration/internal/reduction/reduce_scan_impl.h>
#include <CGAL/Crude_registration/internal/reduction/simplify_by_groups_impl.h>
#include <CGAL/Crude_registration/internal/reduction/simplify_flat_scan_impl.h>
