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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_ASSEMBLE_REDUCED_SCANS_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_ASSEMBLE_REDUCED_SCANS_H

// Scans without an order to one pose each, for scans that are reduced.

#include <CGAL/Crude_registration/Assembly_status.h>
#include <CGAL/Crude_registration/internal/assembly/Known_poses.h>
#include <CGAL/Crude_registration/internal/assembly/Pair_answer.h>
#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/internal/base/Run_control.h>
#include <CGAL/Crude_registration/internal/base/compiled.h>
#include <CGAL/Crude_registration/internal/base/for_each_index.h>
#include <CGAL/Crude_registration/internal/matching/Candidate_source.h>
#include <CGAL/Crude_registration/internal/motion/twist.h>
#include <CGAL/Crude_registration/internal/reduction/Reduced_scan.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Registers scans, by their places in the input, in the frames of the input. Called by several threads at a time.
using Pair_registration = std::function<Pair_answer(std::size_t source, std::size_t target, Run_control& control)>;

// Registers surfaces in their own frames: what is fused of many scans. May be empty.
using Surface_registration =
    std::function<Pair_answer(const Reduced_scan& source, const Reduced_scan& target, Run_control& control)>;

// Two scans by their places in the input.
struct Input_pair
{
  std::size_t source, target;
};

// Registers the pairs of a round, whoever does it: the answers in the order of the pairs, each with its motions in the
// frames of the input. What it returns of a run that was stopped is not looked at.
using Round_registration =
    std::function<std::vector<Pair_answer>(const std::vector<Input_pair>& pairs, Run_control& control)>;

struct Assembly_edge
{
  std::size_t source = 0, target = 0;
  Assembly_edge_status status = WITHOUT_OVERLAP;
  std::string reason;
  Registration_status registration = NOT_REGISTERED;
  double confidence = 0, overlap = 0, residual = 0;
};

// How two scans lie on each other in the model.
struct Assembled_pair
{
  std::size_t source = 0, target = 0;
  double overlap = 0;  // the share of the source's surface
  double residual = 0; // RMS, in sampling distances
};

struct Assembly_outcome
{
  std::vector<Rigid_motion> poses; // model from input
  std::vector<std::size_t> components;
  std::size_t number_of_components = 0;
  std::vector<std::string> reasons;    // why a scan is alone
  std::vector<std::string> lost_hints; // why a hint of its pose was dropped
  std::vector<double> residuals;
  std::vector<Matrix_6> covariances;
  std::vector<Assembly_edge> edges;
  std::vector<Assembled_pair> pairs;
  std::vector<Stage_record> stages;
  bool is_interrupted = false;
};

// `known`: of the scans in the frames of the input.
Assembly_outcome assemble_reduced_scans(const std::vector<const Reduced_scan*>& scans,
                                        const Pair_registration& register_pair,
                                        const Surface_registration& register_surfaces, Execution execution,
                                        Run_control& control, const Known_poses& known = {});

// The same, with the pairs of each round registered by what need not be this process.
Assembly_outcome assemble_reduced_scans(const std::vector<const Reduced_scan*>& scans,
                                        const Round_registration& register_round,
                                        const Surface_registration& register_surfaces, Execution execution,
                                        Run_control& control, const Known_poses& known = {});

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#ifndef CGAL_CRUDE_REGISTRATION_COMPILED
#include <CGAL/Crude_registration/internal/assembly/assemble_reduced_scans_impl.h>
#endif

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_ASSEMBLY_ASSEMBLE_REDUCED_SCANS_H
