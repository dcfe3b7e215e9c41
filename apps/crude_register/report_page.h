// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CRUDE_REGISTER_REPORT_PAGE_H
#define CRUDE_REGISTER_REPORT_PAGE_H

// A report: one page of HTML that needs nothing but itself.

#include "json.h"
#include "picture.h"
#include "report_scans.h"

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

// What a page says on top. `level`: good, doubtful or bad.
struct Report_verdict
{
  std::string level, headline, text;
};

// A number with what it means.
struct Report_number
{
  std::string name, value, meaning;
};

// A motion that can be looked at: of the source of a pair.
struct Report_pose
{
  std::string name, meaning;
  std::optional<double> probability;
  Transformation motion;
};

std::string number_text(double x, int digits = 3);

// Never rounded to certainty.
std::string per_cent(double share);

Json to_json(const Report_verdict& verdict);
Json to_json(const std::vector<Report_number>& numbers);

// Surfaces to draw, and whether they lie in a common frame.
using Report_picture = std::pair<std::vector<Placed_surface>, bool>;

// Where no view can be turned: pictures, after and before, of what `surfaces(is_after)` gives.
std::string static_pictures(const std::function<Report_picture(bool is_after)>& surfaces);

void write_report(const std::string& file, const std::string& title, const Report_verdict& verdict, const Json& data,
                  const Report_bytes& bytes, const std::string& pictures);

#endif // CRUDE_REGISTER_REPORT_PAGE_H
