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

// The part motion of the compiled core.

#include <CGAL/Crude_registration/internal/motion/least_squares_motion_impl.h>
#include <CGAL/Crude_registration/internal/motion/refine_flat_motion_impl.h>
#include <CGAL/Crude_registration/internal/motion/refine_similarity_impl.h>
