// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CRUDE_REGISTER_PICTURE_H
#define CRUDE_REGISTER_PICTURE_H

// Pictures of surfaces, drawn without a graphics card.

#include "options.h"
#include "png_file.h"
#include "surfaces.h"

#include <optional>
#include <string>
#include <vector>

// A surface, which outlives this, and the motion to the frame that it is drawn in.
struct Placed_surface
{
  const Surface* surface;
  Transformation motion;
};

// Told before the work: that there is no libpng, or no folder to write to.
void check_picture(const std::optional<std::string>& file);

// The surfaces, which lie in a common frame or, where there is none, are set apart, as the bytes of a PNG file; none
// where the program was built without libpng.
std::string picture_of(const std::vector<Placed_surface>& surfaces, bool have_common_frame);

void write_picture(const std::string& file, const std::vector<Placed_surface>& surfaces, bool have_common_frame);

#endif // CRUDE_REGISTER_PICTURE_H
