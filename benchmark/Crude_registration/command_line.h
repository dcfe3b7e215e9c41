// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_BENCHMARK_COMMAND_LINE_H
#define CGAL_CRUDE_REGISTRATION_BENCHMARK_COMMAND_LINE_H

#include <boost/program_options.hpp>

#include <iostream>

namespace benchmark_tools {

// Reads the options that are described, of which one is `help`. False where that is asked for: it is printed.
inline bool read_options(int argc, char* argv[], const boost::program_options::options_description& description,
                         boost::program_options::variables_map& values)
{
  store(boost::program_options::command_line_parser(argc, argv).options(description).run(), values);
  if (values.count("help") != 0) {
    std::cout << description;
    return false;
  }
  notify(values);
  return true;
}

} // namespace benchmark_tools

#endif // CGAL_CRUDE_REGISTRATION_BENCHMARK_COMMAND_LINE_H
