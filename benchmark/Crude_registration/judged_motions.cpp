// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// What judge_motion() says of true motions, and of the same moved away from the truth: shifted by one to sixteen
// sampling distances, turned by half a degree to eight degrees, and turned by 90 degrees.
//
// Wanted is that the true ones are told to be right, and those that are off by two sampling distances or more not. True
// motions of real scans are known no better than they were published.

#include "command_line.h"
#include "registration_trials.h"

#include <CGAL/Crude_registration/judge_motion.h>

#include <boost/program_options.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <iomanip>
#include <iostream>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace CR = CGAL::Crude_registration;
namespace po = boost::program_options;
using benchmark_tools::Kernel;
using benchmark_tools::Transformation;
using benchmark_tools::Trial_scan;
using Scan = CR::Scan<Kernel>;

namespace {

Scan prepared(const Trial_scan& scan, const std::string& name)
{
  const CR::Scan_file<Kernel>& file = scan.moved.file;
  return scan.viewpoint ? Scan(file, CR::parameters::viewpoint(*scan.viewpoint), name)
                        : Scan(file, CR::parameters::default_values(), name);
}

// The root mean square distance between where two motions map the points.
double displacement(const std::vector<Eigen::Vector3d>& points, const Transformation& a, const Transformation& b)
{
  const Eigen::Matrix3d turn = benchmark_tools::rotation(a) - benchmark_tools::rotation(b);
  const Eigen::Vector3d shift = benchmark_tools::translation(a) - benchmark_tools::translation(b);
  double squares = 0;
  for (const Eigen::Vector3d& p : points) squares += (turn * p + shift).squaredNorm();
  return std::sqrt(squares / double(points.size()));
}

// A direction, evenly drawn.
Eigen::Vector3d direction(std::mt19937_64& random)
{
  const auto next = [&random] { return 2 * (double(random() >> 11) * 0x1p-53) - 1; }; // in [-1, 1)
  Eigen::Vector3d d;
  do {
    for (int i = 0; i < 3; ++i) d[i] = next();
  } while (d.norm() > 1 || d.norm() < 0.1);
  return d.normalized();
}

// Of motions that are about as far from the truth.
struct Counts
{
  std::array<std::size_t, 3> by_status{}; // right, refinable, wrong
  double error = 0; // sum of how far the displacement that was told is from the true one, of the refinable ones

  std::size_t motions() const { return by_status[0] + by_status[1] + by_status[2]; }
};

// By how far a motion is off, in sampling distances: not at all, and up to each of these.
constexpr std::array<double, 7> ends = {0, 1, 2, 4, 8, 16, 1e9};
using Table = std::array<Counts, ends.size()>;

void judge(const Trial_scan& source_scan, const Trial_scan& target_scan, const Scan& source, const Scan& target,
           const benchmark_tools::Motion& in_files, std::mt19937_64& random, Table& table)
{
  const Transformation truth = target_scan.moved.moved_from_file *
                               benchmark_tools::to_motion<Kernel>(in_files.leftCols<3>(), in_files.col(3)) *
                               source_scan.moved.moved_from_file.inverse();
  const std::vector<Eigen::Vector3d>& points = source_scan.samples.points;
  const double spacing = (std::max)(source.spacing(), target.spacing());
  const Eigen::Vector3d middle = benchmark_tools::to_eigen(source_scan.centroid.transform(truth));
  const auto ask = [&](const Transformation& by) {
    const Transformation motion = by * truth;
    const double off = displacement(points, motion, truth) / spacing;
    const auto judgement = CR::judge_motion<CGAL::Parallel_if_available_tag>(source, target, motion);
    constexpr double rounding = 1e-9;
    const auto row = std::find_if(ends.begin(), ends.end(), [&](double end) { return off <= end + rounding; });
    Counts& counts = table[std::size_t(row - ends.begin())];
    ++counts.by_status[std::size_t(judgement.status())];
    if (judgement.status() == CR::REFINABLE_MOTION) counts.error += std::abs(judgement.displacement() - off);
  };
  ask(Transformation(CGAL::IDENTITY));
  for (const double shift : {1., 2., 4., 8., 16.})
    ask(benchmark_tools::to_motion<Kernel>(Eigen::Matrix3d::Identity(),
                                           Eigen::Vector3d(shift * spacing * direction(random))));
  for (const double degrees : {0.5, 1., 2., 4., 8., 90.}) {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(degrees * CGAL_PI / 180, direction(random)).toRotationMatrix();
    ask(benchmark_tools::to_motion<Kernel>(turn, Eigen::Vector3d(middle - turn * middle)));
  }
}

void print(const Table& table)
{
  std::cout << "off by up to  motions   right  refinable  wrong  error\n" << std::fixed;
  Counts off;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const Counts& c = table[i];
    if (i + 1 < ends.size()) std::cout << std::setw(12) << std::setprecision(0) << ends[i];
    else std::cout << std::setw(12) << "more";
    std::cout << std::setw(9) << c.motions();
    for (const std::size_t n : c.by_status) std::cout << std::setw(9) << n;
    std::cout << std::setw(8) << std::setprecision(2) << (c.by_status[1] > 0 ? c.error / double(c.by_status[1]) : 0)
              << '\n';
    constexpr double enough = 2;
    for (std::size_t s = 0; s < 3; ++s) off.by_status[s] += i > 0 && ends[i - 1] >= enough ? c.by_status[s] : 0;
  }
  const auto share = [](std::size_t n, std::size_t of) { return of > 0 ? double(n) / double(of) : 0; };
  std::cout << std::setprecision(4)
            << "true motions that are told to be right: " << share(table.front().by_status[0], table.front().motions())
            << ", right or refinable: " << 1 - share(table.front().by_status[2], table.front().motions())
            << "; off by two sampling distances or more, and told: " << 1 - share(off.by_status[0], off.motions())
            << '\n'
            << "off: root mean square over the source, in sampling distances of the coarser scan; error: the mean, of "
               "the refinable\nones, of how far it is from what was told\n";
}

} // namespace

int main(int argc, char* argv[])
{
  try {
    benchmark_tools::Trial_options options;
    po::options_description description(
        "Usage: judged_motions (--generated N | --pairs FILE --scans DIR) [OPTION...]\n\n"
        "Judges true motions, and the same moved away from the truth.\n\n"
        "Options");
    description.add_options()("help,h", "print this");
    benchmark_tools::add_options(description, options);
    po::variables_map values;
    if (!benchmark_tools::read_options(argc, argv, description, values)) return EXIT_SUCCESS;
    const benchmark_tools::Trials trials(options);
    std::map<std::string, Scan> scans;
    for (const benchmark_tools::Trial_pair& pair : trials.pairs())
      for (const std::string& name : {pair.source, pair.target})
        if (scans.count(name) == 0) scans.emplace(name, prepared(trials.scan(name), name));
    std::mt19937_64 random(1);
    Table table;
    for (const benchmark_tools::Trial_pair& pair : trials.pairs())
      judge(trials.scan(pair.source), trials.scan(pair.target), scans.at(pair.source), scans.at(pair.target),
            pair.truth, random, table);
    print(table);
  } catch (const std::exception& e) {
    std::cerr << "judged_motions: " << e.what() << '\n';
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
