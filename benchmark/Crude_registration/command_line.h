// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_BENCHMARK_COMMAND_LINE_H
#define CGAL_CRUDE_REGISTRATION_BENCHMARK_COMMAND_LINE_H

// The command line of a program, which all of them read in one way.

#include <boost/program_options.hpp>

#include <iostream>

namespace benchmark_tools {

// Reads the options that are described, of which one is `help`. False where that is asked for: it is printed.
// `positional`: the option that what stands without a name is of, up to `most` of them (-1: any number); it is not
// printed where it is not described, but in `hidden`.
inline bool read_options(int argc, char* argv[], const boost::program_options::options_description& description,
                         boost::program_options::variables_map& values,
                         const boost::program_options::options_description& hidden = {},
                         const char* positional = nullptr, int most = -1)
{
  boost::program_options::options_description all;
  all.add(description).add(hidden);
  boost::program_options::positional_options_description positions;
  if (positional != nullptr) positions.add(positional, most);
  store(boost::program_options::command_line_parser(argc, argv).options(all).positional(positions).run(), values);
  if (values.count("help") != 0) {
    std::cout << description;
    return false;
  }
  notify(values);
  return true;
}

} // namespace benchmark_tools

#endif // CGAL_CRUDE_REGISTRATION_BENCHMARK_COMMAND_LINE_H
