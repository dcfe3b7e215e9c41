// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CRUDE_REGISTER_SURFACES_H
#define CRUDE_REGISTER_SURFACES_H

// Scans as they are shown: points with normals, and triangles where the file has them.

#include "files.h"
#include "options.h"

#include <CGAL/Crude_registration/Scan.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

using Direction = Kernel::Vector_3;

struct Colour
{
  int red, green, blue;
};

// Colours that are told apart by people who do not tell red from green, too (from blue to orange first), in turn.
inline Colour colour_of_scan(std::size_t i)
{
  constexpr std::array<Colour, 8> colours = {Colour{230, 145, 40}, {60, 130, 200},  {70, 170, 120}, {200, 90, 150},
                                             {215, 200, 60},       {110, 190, 225}, {200, 80, 40},  {130, 110, 190}};
  return colours[i % colours.size()];
}

// What is shown of a scan.
struct Surface
{
  std::vector<Point> points;
  std::vector<Direction> normals; // of unit length, or null where none is known; as many, or none
  std::vector<std::array<std::size_t, 3>> triangles;
  double spacing = 0; // of the points, about
};

std::vector<Point> points_of(const Scan_file& file);

// All of a scan for a picture: with triangles, but where it is points alone. The prepared scan may be null.
Surface surface_to_show(const Scan_file& file, const CR::Scan<Kernel>* scan);

#endif // CRUDE_REGISTER_SURFACES_H
