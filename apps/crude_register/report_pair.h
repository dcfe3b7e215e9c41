// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CRUDE_REGISTER_REPORT_PAIR_H
#define CRUDE_REGISTER_REPORT_PAIR_H

// The report of two scans: of what a registration found, or of what is to be said of a given motion.

#include "report_page.h"
#include "report_scans.h"
#include "sides.h"

#include <CGAL/Crude_registration/Registration_result.h>
#include <CGAL/Crude_registration/Scan.h>
#include <CGAL/Crude_registration/judge_motion.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

// What is on the page of two scans.
struct Pair_report
{
  std::string command; // register or judge
  std::array<const Scan_of_a_side*, 2> sides;
  std::array<const CR::Scan<Kernel>*, 2> scans; // null where there was no time to prepare one
  Report_verdict verdict;
  std::vector<Report_number> numbers;
  std::vector<Report_pose> poses =
      {};                         // the first is looked at first; of no scans that are not registered there may be none
  bool have_common_frame = false; // the first pose is one that may be believed
  CR::Registration_result<Kernel>::Correspondence correspondence = {}; // that the first pose comes from, if known
};

// Runners-up that say something: more are not shown.
void add_rivals(const CR::Registration_result<Kernel>& result, std::vector<Report_pose>& poses);

// The poses of a registration: the answer, its rivals, and what refinement started from.
std::vector<Report_pose> poses_of(const CR::Registration_result<Kernel>& result);

std::vector<Report_number> numbers_of(const CR::Registration_result<Kernel>& result,
                                      const std::array<const CR::Scan<Kernel>*, 2>& scans);

Report_verdict verdict_of(const CR::Registration_result<Kernel>& result, const std::string& hint);

Report_verdict verdict_of(const CR::Motion_judgement<Kernel>& judgement);

// The page, made in two steps: what takes time, and what is known last.
class Pair_page
{
public:
  explicit Pair_page(Pair_report report) : m_report(std::move(report)) {}

  void prepare();

  // `notes`: how the files were understood, and how what else was written has to be.
  void write(const std::string& file, const std::vector<std::string>& notes);

private:
  void add_data();

  Pair_report m_report;
  std::vector<Report_scan> m_scans;
  Report_bytes m_bytes;
  Json m_data;
  std::string m_pictures;
};

#endif // CRUDE_REGISTER_REPORT_PAIR_H
