// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// Prints the unit of times, R: see reference_time.h.

#include "command_line.h"
#include "reference_time.h"

#include <boost/program_options.hpp>

#include <cstddef>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

namespace po = boost::program_options;

namespace {

struct Options
{
  std::string scan;
  std::size_t vertices = benchmark_tools::Reference_time::default_vertices;
  std::size_t runs = 5;
  bool verbose = false;
};

int run(const Options& options)
{
  const benchmark_tools::Reference_time reference(options.scan, options.vertices);
  std::vector<double> seconds;
  for (std::size_t i = 0; i < options.runs; ++i) {
    const auto run = reference.run();
    seconds.push_back(run.seconds);
    if (options.verbose)
      std::cerr << "run " << i + 1 << ": " << reference.dense_mesh().number_of_vertices() << " to " << run.vertices_left
                << " vertices in " << run.seconds << " s\n";
  }
  std::cout << benchmark_tools::median(seconds) << '\n';
  return EXIT_SUCCESS;
}

} // namespace

int main(int argc, char* argv[])
{
  try {
    Options options;
    po::options_description description("Usage: reference_time [OPTION...] SCAN\n\n"
                                        "Prints R, the seconds of CPU time (median of some runs, one thread) that\n"
                                        "CGAL's edge collapse takes from the scan's dense mesh to a few hundred\n"
                                        "vertices.\n\nOptions");
    po::options_description hidden;
    description.add_options()("help,h", "print this");
    description.add_options()("vertices", po::value(&options.vertices)->default_value(options.vertices),
                              "number of vertices to stop at");
    description.add_options()("runs", po::value(&options.runs)->default_value(options.runs), "number of runs");
    description.add_options()("verbose,v", po::bool_switch(&options.verbose), "print each run to standard error");
    hidden.add_options()("scan", po::value(&options.scan));
    po::variables_map values;
    if (!benchmark_tools::read_options(argc, argv, description, values, hidden, "scan", 1)) return EXIT_SUCCESS;
    if (options.scan.empty()) throw po::error("no scan is given");
    if (options.runs == 0) throw po::error("runs has to be at least 1");
    return run(options);
  } catch (const std::exception& e) {
    std::cerr << "reference_time: " << e.what() << '\n';
    return EXIT_FAILURE;
  }
}
