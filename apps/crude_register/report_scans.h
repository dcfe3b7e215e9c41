// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CRUDE_REGISTER_REPORT_SCANS_H
#define CRUDE_REGISTER_REPORT_SCANS_H

// Scans as a report carries them: points, normals and what they meet, in few bytes, as text.

#include "json.h"
#include "surfaces.h"

#include <CGAL/Crude_registration/Scan.h>

#include <cstddef>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

// A scan on a page. The prepared scan is null where there was no time to prepare it.
struct Report_scan
{
  std::string name;
  const CR::Scan<Kernel>* scan = nullptr;
  std::size_t samples = 0;
  std::vector<Point> points = {}; // of the samples, those that are shown, in the frame of the file and in its order
};

// The points that are shown of scans that have bytes for `poses` poses: of each scan evenly from the first to the last.
void thin_out(std::vector<Report_scan>& scans, std::size_t poses);

std::string to_base64(const std::string& bytes);

// Another scan, and the motion to its frame from that of the points that are looked at.
struct Other_scan
{
  const CR::Scan<Kernel>* scan;
  Transformation motion;
};

// The distances of points are told in so many steps to either side, which are `reach`.
constexpr int steps_of_reach = 63;

// Blocks of base64 of a page, by the identifiers that they have there. On the page the points of a scan are in an order
// of which each beginning is spread over all of them.
class Report_bytes
{
public:
  // The places and normals of a scan, of which there are so many before; with what is said of it. The scan outlives
  // make().
  Json add_scan(const Report_scan& scan, std::size_t index);

  // What the points of a scan meet in the others under a pose: the nearest surface, and any free space. The others are
  // asked for by make().
  void add_meetings(std::size_t pose, std::size_t index, const Report_scan& scan,
                    std::function<std::vector<Other_scan>()> others, double reach);

  // Computes all, on several threads.
  void make();

  // As elements of HTML.
  void write(std::ostream& out) const;

private:
  struct Block
  {
    std::string id;
    std::function<std::string()> bytes;
    std::string text = {};
  };
  std::vector<Block> m_blocks;
};

#endif // CRUDE_REGISTER_REPORT_SCANS_H
