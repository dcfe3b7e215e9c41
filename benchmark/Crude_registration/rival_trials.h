// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_BENCHMARK_RIVAL_TRIALS_H
#define CGAL_CRUDE_REGISTRATION_BENCHMARK_RIVAL_TRIALS_H

// The four pairs of bunny scans of the paper, on which its rivals are tried beside its method.

#include "bunny_pairs.h"
#include "command_line.h"
#include "cpu_time.h"
#include "reference_time.h"

#include <CGAL/Crude_registration/matching/Oriented_pair_candidates.h>

#include <CGAL/bounding_box.h>
#include <CGAL/centroid.h>

#include <boost/program_options.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

namespace benchmark_tools {

inline bool is_right(const bunny::Transformation& found, const bunny::Transformation& truth, const bunny::Mesh& source)
{
  const CGAL::Bbox_3 box = CGAL::bbox_3(source.points().begin(), source.points().end());
  const Eigen::Vector3d diagonal(box.x_span(), box.y_span(), box.z_span());
  const auto middle = CGAL::centroid(source.points().begin(), source.points().end(), CGAL::Dimension_tag<0>());
  const double shift = std::sqrt(CGAL::squared_distance(middle.transform(found), middle.transform(truth)));
  return degrees_between(found, truth) < 5 && shift < 0.05 * diagonal.norm();
}

struct Rival_answer
{
  std::size_t motions = 0; // that were tried; 0: not told
  double overlap = 0;      // the share of the points that the motion takes to the target
  double seconds = 0;      // of CPU
  bunny::Error crude, refined;
  bool is_right = false;

  // Of an answer that comes without a verdict: it is right if it is after ICP.
  void judge(const bunny::Dense_scan& source, const bunny::Dense_scan& target, const bunny::Transformation& motion,
             const bunny::Transformation& truth)
  {
    const auto better =
        CGAL::Crude_registration::refine_motion<CGAL::Sequential_tag>(source.mesh, target.mesh, motion).motion;
    crude = bunny::Error(motion, truth);
    refined = bunny::Error(better, truth);
    is_right = benchmark_tools::is_right(better, truth, source.mesh);
  }
};

// By this package, from the same samples.
template <class Generator>
Rival_answer register_by_package(const bunny::Dense_scan& source, const bunny::Dense_scan& target,
                                 const bunny::Transformation& truth, const Generator& generator)
{
  namespace CR = CGAL::Crude_registration;
  Rival_answer answer;
  const auto np = CR::parameters::candidates(generator);
  const double start = cpu_seconds();
  const auto result =
      CR::register_scans(CR::Scan<bunny::Kernel>(source.image, np), CR::Scan<bunny::Kernel>(target.image, np), np);
  answer.seconds = cpu_seconds() - start;
  answer.crude = bunny::Error(result.crude_transformation(), truth);
  answer.refined = bunny::Error(result.transformation(), truth);
  answer.is_right = result.status() == CR::REGISTERED && is_right(result.transformation(), truth, source.mesh);
  return answer;
}

inline void print(const std::string& pair, const std::string& method, const Rival_answer& a, double reference)
{
  std::ostringstream out;
  out << std::left << std::setw(9) << pair << std::setw(26) << method << std::right << std::fixed;
  if (a.motions > 0) out << std::setw(9) << a.motions << std::setprecision(3) << std::setw(9) << a.overlap;
  else out << std::setw(9) << '-' << std::setw(9) << '-';
  out << std::setprecision(3) << std::setw(9) << a.crude.rotation << std::setw(9) << a.refined.rotation << std::setw(7)
      << (a.is_right ? "yes" : "no") << std::setw(10) << a.seconds << std::setprecision(2) << std::setw(9)
      << a.seconds / reference << '\n';
  std::cout << out.str() << std::flush;
}

// try_rival(source, target, truth, print(method, answer)) on each pair, and then this package. Returns R.
template <class Function>
double for_each_of_the_papers_pairs(const std::string& folder, const Function& try_rival)
{
  namespace CR = CGAL::Crude_registration;
  const std::array<const char*, 4> names = {"000", "090", "180", "270"};
  std::vector<bunny::Dense_scan> scans;
  for (const char* name : names) scans.push_back(bunny::read_scan(folder, "bun" + std::string(name) + ".ply"));
  const double reference = reference_seconds(folder + "/bun000.ply");
  std::cout << "                                             of points   degrees    after                  \n"
            << "pair     method                      motions  overlap    crude      ICP  right   CPU s        R\n";
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const bunny::Dense_scan &source = scans[i], &target = scans[(i + 1) % scans.size()];
    const std::string pair = std::string(names[i]) + '-' + names[(i + 1) % scans.size()];
    const bunny::Transformation truth =
        bunny::published_pose(folder, target.name).inverse() * bunny::published_pose(folder, source.name);
    const auto print_one = [&](const std::string& method, const Rival_answer& a) { print(pair, method, a, reference); };
    try_rival(source, target, truth, print_one);
    print_one("trihedra (the paper)", register_by_package(source, target, truth, CR::Trihedron_candidates()));
    print_one("oriented pairs", register_by_package(source, target, truth, CR::Oriented_pair_candidates()));
  }
  return reference;
}

// The last lines of a rival's output: of how many `trials` (with their noun) it is right, by the criterion of
// is_right().
inline void print_summary(const std::string& rival, std::size_t right, const std::string& trials, double reference)
{
  std::cout << '\n'
            << rival << right << " of " << trials
            << "; right: after ICP within 5 degrees, and the centroid within 5 % of\nthe diagonal; R = " << reference
            << " s\n";
}

// The main function of a rival: reads the folder of the scans and the options that add_options(description) adds, and
// calls run(folder). `by`: what the pairs are registered by.
template <class Add, class Run>
int rival_program(int argc, char* argv[], const std::string& name, const std::string& by, const Add& add_options,
                  const Run& run)
{
  namespace po = boost::program_options;
  try {
    std::string folder = ".";
    po::options_description description(
        "Usage: " + name + " [OPTION...]\n\nRegisters the paper's four pairs of bunny scans by " + by + "\n\nOptions");
    description.add_options()("help,h", "print this");
    description.add_options()("scans", po::value(&folder), "folder of bun000.ply, ... and bun.conf; default: this one");
    add_options(description);
    po::variables_map values;
    if (read_options(argc, argv, description, values)) run(folder);
    return EXIT_SUCCESS;
  } catch (const std::exception& e) {
    std::cerr << name << ": " << e.what() << '\n';
    return EXIT_FAILURE;
  }
}

} // namespace benchmark_tools

#endif // CGAL_CRUDE_REGISTRATION_BENCHMARK_RIVAL_TRIALS_H
