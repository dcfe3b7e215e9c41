// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_BENCHMARK_PLOT_SCRIPT_H
#define CGAL_CRUDE_REGISTRATION_BENCHMARK_PLOT_SCRIPT_H

#include <string>

namespace benchmark_tools {

// A text in the single quotes of gnuplot, in which a quote is written twice.
inline std::string quoted(const std::string& text)
{
  std::string result = "'";
  for (char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

} // namespace benchmark_tools

#endif // CGAL_CRUDE_REGISTRATION_BENCHMARK_PLOT_SCRIPT_H
