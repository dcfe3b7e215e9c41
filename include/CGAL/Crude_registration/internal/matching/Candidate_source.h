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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_CANDIDATE_SOURCE_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_CANDIDATE_SOURCE_H

// The second step of a registration, to propose poses, as the pipeline sees it, whatever the method.

#include <CGAL/Crude_registration/internal/base/Run_control.h>
#include <CGAL/Crude_registration/internal/base/for_each_index.h>
#include <CGAL/Crude_registration/internal/judgement/Proposals.h>
#include <CGAL/Crude_registration/internal/reduction/Reduced_scan.h>

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// What a part of a run did: how many items it worked on, and how long it took.
struct Stage_record
{
  std::string name;
  std::size_t count = 0;
  double seconds = 0;
};

// Adds the time of its life to a stage.
class Stage_timer
{
public:
  explicit Stage_timer(Stage_record& stage) : m_stage(stage) {}
  ~Stage_timer()
  {
    m_stage.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - m_start).count();
  }
  Stage_timer(const Stage_timer&) = delete;
  Stage_timer& operator=(const Stage_timer&) = delete;

private:
  Stage_record& m_stage;
  std::chrono::steady_clock::time_point m_start = std::chrono::steady_clock::now();
};

// Proposes poses for two scans, round by round: a next round is asked for as long as nothing is certain.
class Candidate_source
{
public:
  Candidate_source() = default;
  Candidate_source(const Candidate_source&) = delete;
  Candidate_source& operator=(const Candidate_source&) = delete;
  virtual ~Candidate_source() = default;

  // Nothing where there are no more rounds. What is proposed when `control` has said to stop is of no use.
  virtual std::optional<Proposals> next(Run_control& control) = 0;

  // The share of the work that is done before the next round, at most.
  virtual double progress() const { return 0; }

  virtual std::vector<Stage_record> stages() const { return {}; }
};

// Makes the source of candidates for two scans, which it keeps by reference.
using Candidate_factory = std::function<std::unique_ptr<Candidate_source>(const Reduced_scan&, const Reduced_scan&)>;

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MATCHING_CANDIDATE_SOURCE_H
