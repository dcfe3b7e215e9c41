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

// The part assembly of the compiled core.

#include <CGAL/Crude_registration/internal/assembly/assemble_reduced_scans_impl.h>
#include <CGAL/Crude_registration/internal/assembly/relax_poses_impl.h>
#include <CGAL/Crude_registration/internal/assembly/fuse_scans_impl.h>
