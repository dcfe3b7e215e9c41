// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// What the parts of the method are worth: the same pairs of scans without what the public parameters can switch off.

#include "cpu_time.h"
#include "registration_trials.h"

#include <CGAL/Crude_registration/matching/Trihedron_candidates.h>
#include <CGAL/Crude_registration/register_scans.h>
#include <CGAL/Crude_registration/sampling/sampling_distance.h>
#include <CGAL/Crude_registration/sampling/triangulate_range_image.h>

#include <CGAL/Surface_mesh.h>

#include <boost/program_options.hpp>

#include <array>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <iomanip>
#include <iostream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace CR = CGAL::Crude_registration;
namespace po = boost::program_options;
using benchmark_tools::Kernel;
using benchmark_tools::Trial_scan;

namespace {

struct Variant
{
  const char* name;
  bool has_sensor = true;
  bool is_trihedra = false;
  bool use_normals = true;
  double cell_size = 0; // of the samples grouped before the simplification, in sampling distances
  double maximum_extent = 0.3;
};

const std::array<Variant, 9> variants = {{{"oriented pairs, as by default"},
                                          {"  without the sensor", false},
                                          {"  f2 = 0.15", true, false, true, 0, 0.15},
                                          {"  f2 = 0.6", true, false, true, 0, 0.6},
                                          {"trihedra, curvatures and normals", true, true},
                                          {"  without the sensor", false, true},
                                          {"  curvatures alone, as the paper", true, true, false},
                                          {"  samples grouped by 3.5 s", true, true, true, 3.5},
                                          {"  grouped, curvatures alone", true, true, false, 3.5}}};

CR::Scan<Kernel> prepare(const Trial_scan& scan, const Variant& variant)
{
  const CR::Scan_file<Kernel>& file = scan.moved.file;
  const bool is_image = file.kind == CR::Scan_file<Kernel>::RANGE_IMAGE;
  const auto prepared = [&](const auto& np) {
    if (is_image && !variant.has_sensor) {
      CGAL::Surface_mesh<Kernel::Point_3> mesh;
      CR::triangulate_range_image(file.image, mesh);
      return CR::Scan<Kernel>(mesh, np);
    }
    if (scan.viewpoint && variant.has_sensor) return CR::Scan<Kernel>(file, np.viewpoint(*scan.viewpoint));
    return CR::Scan<Kernel>(file, np);
  };
  if (!variant.is_trihedra) return prepared(CR::parameters::maximum_extent(variant.maximum_extent));
  const auto np = CR::parameters::candidates(CR::Trihedron_candidates());
  if (variant.cell_size > 0 && is_image)
    return prepared(np.cell_size(variant.cell_size * CR::sampling_distance(file.image)));
  return prepared(np);
}

CR::Registration_result<Kernel> register_pair(const CR::Scan<Kernel>& source, const CR::Scan<Kernel>& target,
                                              const Variant& variant)
{
  const auto extents = CR::parameters::maximum_extent(variant.maximum_extent);
  if (!variant.is_trihedra) return CR::register_scans(source, target, extents);
  return CR::register_scans(source, target,
                            extents.candidates(CR::Trihedron_candidates()).use_normals(variant.use_normals));
}

struct Sums
{
  std::size_t right = 0, wrong = 0, ambiguous = 0; // right and wrong: of the registered ones
  std::size_t right_low = 0, pairs_low = 0;        // of pairs with little overlap
  std::size_t crude_right = 0, with_free_space = 0;
  std::vector<double> seconds;
};

bool is_right(const CGAL::Aff_transformation_3<Kernel>& motion, const benchmark_tools::Trial_pair& pair,
              const Trial_scan& source, const Trial_scan& target)
{
  double m[3][4];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j) m[i][j] = motion.m(i, j);
  return benchmark_tools::Trial_error(m, pair.truth, source, target).is_small();
}

constexpr double enough_overlap = 0.3;

Sums run(const benchmark_tools::Trials& trials, const Variant& variant)
{
  Sums sums;
  struct Prepared
  {
    std::optional<CR::Scan<Kernel>> scan;
    double seconds;
  };
  std::map<std::string, Prepared> prepared;
  for (const benchmark_tools::Trial_pair& pair : trials.pairs()) {
    for (const std::string& name : {pair.source, pair.target}) {
      if (prepared.count(name) != 0) continue;
      const double start = benchmark_tools::cpu_seconds();
      Prepared scan = {prepare(trials.scan(name), variant), 0};
      scan.seconds = benchmark_tools::cpu_seconds() - start;
      prepared.emplace(name, std::move(scan));
    }
    const Prepared &source = prepared.at(pair.source), &target = prepared.at(pair.target);
    const double start = benchmark_tools::cpu_seconds();
    const auto result = register_pair(*source.scan, *target.scan, variant);
    sums.seconds.push_back(benchmark_tools::cpu_seconds() - start + source.seconds + target.seconds);
    const auto check = [&](const auto& motion) {
      return is_right(motion, pair, trials.scan(pair.source), trials.scan(pair.target));
    };
    const bool is_registered = result.status() == CR::REGISTERED;
    const bool is_low = pair.overlap < enough_overlap, right = is_registered && check(result.transformation());
    sums.right += right;
    sums.wrong += is_registered && !right;
    sums.ambiguous += result.status() == CR::AMBIGUOUS;
    sums.pairs_low += is_low;
    sums.right_low += right && is_low;
    sums.crude_right += right && check(result.crude_transformation());
    sums.with_free_space += result.source_has_free_space() && result.target_has_free_space();
  }
  return sums;
}

int run(const benchmark_tools::Trial_options& options)
{
  const benchmark_tools::Trials trials(options);
  const std::size_t pairs = trials.pairs().size();
  std::cout << "                                    right, overlap                   crude    free  CPU s,  to the\n"
            << "variant                             >= " << enough_overlap
            << "     less   wrong  ambiguous  right   space  "
            << "median  first\n";
  double first = 0;
  for (const Variant& variant : variants) {
    const Sums s = run(trials, variant);
    const double median = benchmark_tools::median(s.seconds);
    if (first == 0) first = median;
    const auto share = [](std::size_t a, std::size_t b) { return std::to_string(a) + '/' + std::to_string(b); };
    std::ostringstream out;
    out << std::left << std::setw(34) << variant.name << std::right << std::setw(8)
        << share(s.right - s.right_low, pairs - s.pairs_low) << std::setw(9) << share(s.right_low, s.pairs_low)
        << std::setw(8) << s.wrong << std::setw(11) << s.ambiguous << std::setw(7) << s.crude_right << std::setw(8)
        << s.with_free_space << std::fixed << std::setprecision(3) << std::setw(8) << median << std::setprecision(2)
        << std::setw(7) << median / first << '\n';
    std::cout << out.str() << std::flush;
  }
  std::cout
      << "\nright, wrong: of the registered ones, as compare_with_peers counts; crude right: answers that were so\n"
         "before they were refined; free space: pairs where it is known of both scans\n";
  return EXIT_SUCCESS;
}

} // namespace

int main(int argc, char* argv[])
{
  try {
    benchmark_tools::Trial_options options;
    po::options_description description(
        "Usage: ablation (--pairs PAIRS.csv --scans DIR | --generated N) [OPTION...]\n\n"
        "Registers pairs of scans without parts of the method, one at a time, by one thread.\n\n"
        "Options");
    description.add_options()("help,h", "print this");
    benchmark_tools::add_options(description, options);
    po::variables_map values;
    po::store(po::parse_command_line(argc, argv, description), values);
    if (values.count("help") != 0) {
      std::cout << description;
      return EXIT_SUCCESS;
    }
    po::notify(values);
    return run(options);
  } catch (const std::exception& e) {
    std::cerr << "ablation: " << e.what() << '\n';
    return EXIT_FAILURE;
  }
}
