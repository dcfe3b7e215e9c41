// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// What the parts of the method are worth: the same pairs of scans without them, one at a time. What no public parameter
// can switch off is taken from the scans when they are prepared, or from the judgement.

#include "ablated_scan.h"
#include "../benchmark/Crude_registration/command_line.h"
#include "../benchmark/Crude_registration/cpu_time.h"
#include "other_judgement.h"
#include "../benchmark/Crude_registration/registration_trials.h"

#include <CGAL/Crude_registration/IO/triangulate_scan.h>
#include <CGAL/Crude_registration/matching/Oriented_pair_candidates.h>
#include <CGAL/Crude_registration/matching/Trihedron_candidates.h>
#include <CGAL/Crude_registration/register_scans.h>
#include <CGAL/Crude_registration/sampling/sampling_distance.h>
#include <CGAL/Crude_registration/sampling/triangulate_range_image.h>

#include <CGAL/Surface_mesh.h>

#include <boost/program_options.hpp>

#include <cstddef>
#include <cstdlib>
#include <exception>
#include <iomanip>
#include <iostream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace CR = CGAL::Crude_registration;
namespace po = boost::program_options;
using benchmark_tools::Judgement;
using benchmark_tools::Kernel;
using benchmark_tools::Trial_scan;

namespace {

struct Variant
{
  const char* name;
  enum Method
  {
    PAIRS,
    TRIHEDRA
  } method = PAIRS;
  enum Part
  {
    NONE,
    SENSOR,
    CURVATURES,
    NORMALS,
    BOTH_CURVATURES_AND_NORMALS,
    FREE_SPACE,
    VISIBILITY,
    CHOSEN_VERTICES
  } missing = NONE;
  Judgement judgement = Judgement::DEFAULT;
  double maximum_extent = 0.3;
  double cell_size = 0; // of the samples grouped before the simplification, in sampling distances

  bool is_trihedra() const { return method == TRIHEDRA; }
  bool use_normals() const { return missing != NORMALS && missing != BOTH_CURVATURES_AND_NORMALS; }
};

using V = Variant;
using J = Judgement;

const std::vector<Variant> variants = {{"oriented pairs, as by default"},
                                       {"  without curvatures", V::PAIRS, V::CURVATURES},
                                       {"  without free space", V::PAIRS, V::FREE_SPACE},
                                       {"  without \"would have been seen\"", V::PAIRS, V::VISIBILITY},
                                       {"  without both (no sensor)", V::PAIRS, V::SENSOR},
                                       {"  evidence, free motions not asked", V::PAIRS, V::NONE, J::EVIDENCE},
                                       {"  the same, judged unrefined", V::PAIRS, V::NONE, J::UNREFINED},
                                       {"  area instead of evidence", V::PAIRS, V::NONE, J::AREA},
                                       {"  f2 = 0.15", V::PAIRS, V::NONE, J::DEFAULT, 0.15},
                                       {"  f2 = 0.6", V::PAIRS, V::NONE, J::DEFAULT, 0.6},
                                       {"trihedra, curvatures and normals", V::TRIHEDRA},
                                       {"  without curvatures", V::TRIHEDRA, V::CURVATURES},
                                       {"  without normals, as the paper", V::TRIHEDRA, V::NORMALS},
                                       {"  without either", V::TRIHEDRA, V::BOTH_CURVATURES_AND_NORMALS},
                                       {"  random vertices", V::TRIHEDRA, V::CHOSEN_VERTICES},
                                       {"  without free space", V::TRIHEDRA, V::FREE_SPACE},
                                       {"  without \"would have been seen\"", V::TRIHEDRA, V::VISIBILITY},
                                       {"  without both (no sensor)", V::TRIHEDRA, V::SENSOR},
                                       {"  evidence, free motions not asked", V::TRIHEDRA, V::NONE, J::EVIDENCE},
                                       {"  the same, judged unrefined", V::TRIHEDRA, V::NONE, J::UNREFINED},
                                       {"  area instead of evidence", V::TRIHEDRA, V::NONE, J::AREA},
                                       {"  samples grouped by 3.5 s", V::TRIHEDRA, V::NONE, J::DEFAULT, 0.3, 3.5}};

using Scan = CR::Scan<Kernel>;

Scan prepare_whole(const Trial_scan& scan, const Variant& variant)
{
  const CR::Scan_file<Kernel>& file = scan.moved.file;
  const bool is_image = file.kind == CR::Scan_file<Kernel>::RANGE_IMAGE, has_sensor = variant.missing != V::SENSOR;
  const auto prepared = [&](const auto& np) {
    if (is_image && !has_sensor) {
      CGAL::Surface_mesh<Kernel::Point_3> mesh;
      CR::triangulate_range_image(file.image, mesh);
      return Scan(mesh, np);
    }
    if (scan.viewpoint && has_sensor) return Scan(file, np.viewpoint(*scan.viewpoint));
    return Scan(file, np);
  };
  if (!variant.is_trihedra()) return prepared(CR::parameters::maximum_extent(variant.maximum_extent));
  const auto np = CR::parameters::candidates(CR::Trihedron_candidates());
  if (variant.cell_size > 0 && is_image)
    return prepared(np.cell_size(variant.cell_size * CR::sampling_distance(file.image)));
  return prepared(np);
}

Scan prepare(const Trial_scan& scan, const Variant& variant)
{
  const Scan whole = prepare_whole(scan, variant);
  if (variant.missing == V::NONE || variant.missing == V::SENSOR || variant.missing == V::NORMALS) return whole;
  benchmark_tools::CRI::Reduced_scan reduced = whole.reduced();
  switch (variant.missing) {
  case V::FREE_SPACE:
    benchmark_tools::take_free_space(reduced);
    break;
  case V::VISIBILITY:
    benchmark_tools::take_visibility(reduced);
    break;
  case V::CHOSEN_VERTICES: {
    const CR::Scan_file<Kernel>& file = scan.moved.file;
    benchmark_tools::take_random_vertices(scan.viewpoint
                                              ? CR::triangulate_scan(file, CR::parameters::viewpoint(*scan.viewpoint))
                                              : CR::triangulate_scan(file),
                                          reduced);
    break;
  }
  default:
    benchmark_tools::take_curvatures(reduced);
  }
  return Scan(std::move(reduced));
}

struct Answer
{
  CR::Registration_status status;
  CGAL::Aff_transformation_3<Kernel> motion, crude;
};

template <class Generator>
Answer register_by(const Generator& generator, const Scan& source, const Scan& target, Judgement judgement)
{
  if (judgement == Judgement::DEFAULT) {
    const auto result = CR::register_scans(source, target, CR::parameters::candidates(generator));
    return {result.status(), result.transformation(), result.crude_transformation()};
  }
  const auto answer = benchmark_tools::register_otherwise(source.reduced(), target.reduced(), generator, judgement);
  using benchmark_tools::CRI::to_aff_transformation;
  return {answer.status, to_aff_transformation<Kernel>(answer.motion), to_aff_transformation<Kernel>(answer.crude)};
}

Answer register_pair(const Scan& source, const Scan& target, const Variant& variant)
{
  const auto extents = CR::parameters::maximum_extent(variant.maximum_extent);
  if (!variant.is_trihedra())
    return register_by(CR::Oriented_pair_candidates(extents), source, target, variant.judgement);
  return register_by(CR::Trihedron_candidates(extents.use_normals(variant.use_normals())), source, target,
                     variant.judgement);
}

struct Options
{
  benchmark_tools::Trial_options trials;
  bool are_pairs_only = false, is_slow_too = false;
};

struct Sums
{
  std::size_t right = 0, wrong = 0, ambiguous = 0; // right and wrong: of the registered ones
  std::size_t right_low = 0, pairs_low = 0;        // of pairs with little overlap
  std::size_t crude_right = 0;
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
    const Answer result = register_pair(*source.scan, *target.scan, variant);
    sums.seconds.push_back(benchmark_tools::cpu_seconds() - start + source.seconds + target.seconds);
    const auto check = [&](const auto& motion) {
      return is_right(motion, pair, trials.scan(pair.source), trials.scan(pair.target));
    };
    const bool is_registered = result.status == CR::REGISTERED;
    const bool is_low = pair.overlap < enough_overlap, right = is_registered && check(result.motion);
    sums.right += right;
    sums.wrong += is_registered && !right;
    sums.ambiguous += result.status == CR::AMBIGUOUS;
    sums.pairs_low += is_low;
    sums.right_low += right && is_low;
    sums.crude_right += right && check(result.crude);
  }
  return sums;
}

int run(const Options& options)
{
  const benchmark_tools::Trials trials(options.trials);
  const std::size_t pairs = trials.pairs().size();
  std::cout << "                                    right, overlap                   crude  CPU s,  to the\n"
            << "variant                             >= " << enough_overlap
            << "     less   wrong  ambiguous  right  median   first\n";
  double first = 0;
  for (const Variant& variant : variants) {
    if (variant.is_trihedra() && options.are_pairs_only) break;
    if (variant.missing == V::BOTH_CURVATURES_AND_NORMALS && !options.is_slow_too) continue;
    const Sums s = run(trials, variant);
    const double median = benchmark_tools::median(s.seconds);
    if (first == 0) first = median;
    const auto share = [](std::size_t a, std::size_t b) { return std::to_string(a) + '/' + std::to_string(b); };
    std::ostringstream out;
    out << std::left << std::setw(35) << variant.name << std::right << std::setw(7)
        << share(s.right - s.right_low, pairs - s.pairs_low) << std::setw(9) << share(s.right_low, s.pairs_low)
        << std::setw(8) << s.wrong << std::setw(11) << s.ambiguous << std::setw(7) << s.crude_right << std::fixed
        << std::setprecision(3) << std::setw(8) << median << std::setprecision(2) << std::setw(7) << median / first
        << '\n';
    std::cout << out.str() << std::flush;
  }
  std::cout
      << "\nright, wrong: of the registered ones, as compare_with_peers counts; crude right: answers that were so\n"
         "before they were refined; area: there is always an answer\n";
  return EXIT_SUCCESS;
}

} // namespace

int main(int argc, char* argv[])
{
  try {
    Options options;
    po::options_description description(
        "Usage: ablation (--pairs PAIRS.csv --scans DIR | --generated N) [OPTION...]\n\n"
        "Registers pairs of scans without parts of the method, one at a time, by one thread.\n\n"
        "Options");
    description.add_options()("help,h", "print this");
    benchmark_tools::add_options(description, options.trials);
    description.add_options()("pairs-only", po::bool_switch(&options.are_pairs_only),
                              "leave out trihedra, which take most of the time");
    description.add_options()("slow", po::bool_switch(&options.is_slow_too),
                              "with trihedra that neither curvatures nor normals tell apart: minutes a pair");
    po::variables_map values;
    if (!benchmark_tools::read_options(argc, argv, description, values)) return EXIT_SUCCESS;
    return run(options);
  } catch (const std::exception& e) {
    std::cerr << "ablation: " << e.what() << '\n';
    return EXIT_FAILURE;
  }
}
