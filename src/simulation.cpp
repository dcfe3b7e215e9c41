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

// The part simulation of the compiled core.

#include <CGAL/Crude_registration/internal/simulation/Ray_caster_impl.h>
#include <CGAL/Crude_registration/internal/simulation/statue_mesh_impl.h>
