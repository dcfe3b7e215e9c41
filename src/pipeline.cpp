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

// The part pipeline of the compiled core.

#include <CGAL/Crude_registration/internal/judgement/compare_points_impl.h>
#include <CGAL/Crude_registration/internal/pipeline/Scaled_outcome_impl.h>
#include <CGAL/Crude_registration/internal/pipeline/register_reduced_scans_impl.h>
