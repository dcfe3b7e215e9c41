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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_PAIR_ANSWER_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_PAIR_ANSWER_H

// What the registration of two of many scans has said, without a kernel.

#include <CGAL/Crude_registration/Registration_status.h>
#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// A motion that a pair may have, and how probable it is.
struct Ranked_motion
{
  Rigid_motion motion; // to the second scan of the pair from the first
  double probability = 0;
  bool is_registered = false; // the pair alone is certain of it
};

struct Pair_answer
{
  Registration_status status = NOT_REGISTERED;
  std::string reason;
  double overlap = 0; // share of the smaller surface, of the first motion
  double residual = 0;
  std::vector<Ranked_motion> motions; // distinct, the most probable first
};

// The index of a scan is its place in the canonical order; first < second.
struct Scan_pair
{
  std::size_t first, second;

  friend bool operator<(const Scan_pair& a, const Scan_pair& b)
  {
    return a.first != b.first ? a.first < b.first : a.second < b.second;
  }
  friend bool operator==(const Scan_pair& a, const Scan_pair& b) { return a.first == b.first && a.second == b.second; }
};

// A pair that was registered; the motions are between the scans' own frames.
struct Tried_pair
{
  Scan_pair scans;
  Pair_answer answer;
  bool is_fused = false; // not the scans themselves were registered but surfaces fused of many, they among them
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_PAIR_ANSWER_H
