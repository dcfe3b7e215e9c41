// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// The unit in which this project gives times: R, the time of CGAL's plain edge collapse of a scan's dense mesh.
// Machines differ and change their speed from hour to hour; R, measured in the same run, makes times comparable.

// g++ takes the default value that CGAL gives a property of a type of Eigen's for a use of uninitialised memory.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include <CGAL/Crude_registration/IO/read_scan.h>
#include <CGAL/Crude_registration/simplify_scan.h>
#include <CGAL/Crude_registration/triangulate_range_image.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <boost/program_options.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

namespace CR = CGAL::Crude_registration;
namespace po = boost::program_options;

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

namespace {

struct Options
{
  std::string scan;
  std::size_t vertices = 404;
  std::size_t runs = 5;
  bool verbose = false;
};

// The time that this process has computed for: others on the machine do not count.
double cpu_seconds()
{
  return double(std::clock()) / CLOCKS_PER_SEC;
}

int run(const Options& options)
{
  CR::Scan_file<Kernel> scan = CR::read_scan<Kernel>(options.scan);
  Mesh dense;
  if (scan.kind == CR::Scan_file<Kernel>::RANGE_IMAGE) CR::triangulate_range_image(scan.image, dense);
  if (scan.kind == CR::Scan_file<Kernel>::MESH) dense = std::move(scan.mesh);
  if (scan.kind == CR::Scan_file<Kernel>::POINTS)
    throw std::runtime_error(options.scan + ": points without a grid or faces have no mesh to simplify");

  std::vector<double> seconds;
  for (std::size_t i = 0; i < options.runs; ++i) {
    Mesh mesh = dense;
    const double start = cpu_seconds();
    const std::size_t left = CR::simplify_scan(mesh, CR::parameters::number_of_vertices(options.vertices));
    seconds.push_back(cpu_seconds() - start);
    if (options.verbose)
      std::cerr << "run " << i + 1 << ": " << dense.number_of_vertices() << " to " << left << " vertices in "
                << seconds.back() << " s\n";
  }
  std::nth_element(seconds.begin(), seconds.begin() + std::ptrdiff_t(seconds.size() / 2), seconds.end());
  std::cout << seconds[seconds.size() / 2] << '\n';
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
    po::options_description hidden, all;
    description.add_options()("help,h", "print this");
    description.add_options()("vertices", po::value(&options.vertices)->default_value(options.vertices),
                              "number of vertices to stop at");
    description.add_options()("runs", po::value(&options.runs)->default_value(options.runs), "number of runs");
    description.add_options()("verbose,v", po::bool_switch(&options.verbose), "print each run to standard error");
    hidden.add_options()("scan", po::value(&options.scan));
    all.add(description).add(hidden);
    po::positional_options_description positional;
    positional.add("scan", 1);
    po::variables_map values;
    po::store(po::command_line_parser(argc, argv).options(all).positional(positional).run(), values);
    if (values.count("help") != 0) {
      std::cout << description;
      return EXIT_SUCCESS;
    }
    po::notify(values);
    if (options.scan.empty()) throw po::error("no scan is given");
    if (options.runs == 0) throw po::error("runs has to be at least 1");
    return run(options);
  } catch (const std::exception& e) {
    std::cerr << "reference_time: " << e.what() << '\n';
    return EXIT_FAILURE;
  }
}
