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

#ifndef CGAL_CRUDE_REGISTRATION_H
#define CGAL_CRUDE_REGISTRATION_H

// The whole package, under both of its names. Where a file system ignores case, CGAL/Crude_registration.h and
// CGAL/crude_registration.h are one file: the two have the same bytes.

#include <CGAL/Crude_registration/all_headers.h>

#endif // CGAL_CRUDE_REGISTRATION_H
