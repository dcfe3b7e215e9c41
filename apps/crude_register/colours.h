// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CRUDE_REGISTER_COLOURS_H
#define CRUDE_REGISTER_COLOURS_H

// The colours of a scan's points, where its file has them, on what is written of it.

#include "files.h"

#include <CGAL/IO/Color.h>

#include <vector>

using Colours = std::vector<CGAL::IO::Color>;

// The colours of points that are some of those of the scan, in any order: of its surface. Empty where it has none.
Colours colours_at(const std::vector<Point>& points, const Scan_file& scan);

// As CGAL's writers of PLY and OFF look for them.
void add_colours(const Scan_file& scan, Mesh& mesh);

#endif // CRUDE_REGISTER_COLOURS_H
