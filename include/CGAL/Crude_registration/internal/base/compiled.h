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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_COMPILED_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_COMPILED_H

// Whether the core of the package, what does not depend on a kernel, is compiled in a library or with each program.

// With CGAL_CRUDE_REGISTRATION_COMPILED, which the target CGAL::Crude_registration_compiled defines, the headers
// declare the functions of the core, and src/ compiles what the files `..._impl.h` define; without it each header
// includes its
// `..._impl.h` itself, and the functions are inline, as in CGAL.
#ifdef CGAL_CRUDE_REGISTRATION_COMPILED
#define CGAL_CRUDE_REGISTRATION_INLINE
#else
#define CGAL_CRUDE_REGISTRATION_INLINE inline
#endif

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_COMPILED_H
