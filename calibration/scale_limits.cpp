// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// What the limits of register_scans_with_scale() are chosen by: at which wrong scales a motion is still found, how far
// the scales are apart that are found from there, and how well scans agree at scales other than the best one, those
// whose scale is determined and those whose scale is free.

#include "../benchmark/Crude_registration/command_line.h"
#include "../benchmark/Crude_registration/result_tools.h"
#include "simulated_set.h"

#include <CGAL/Crude_registration/internal/motion/Nearest_surfel.h>
#include <CGAL/Crude_registration/register_scans_with_scale.h>

#include <boost/program_options.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <iomanip>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace CR = CGAL::Crude_registration;
namespace po = boost::program_options;
using benchmark_tools::Simulated_set;
using Kernel = Simulated_set::Kernel;
using Mesh = Simulated_set::Mesh;
using Scan = CR::Scan<Kernel>;
using CR::internal::Rigid_motion;

namespace {

using Agreement = CR::internal::Agreement_at_other_scales;

// Of two scans at their true scale and motion, which is refined first.
std::optional<Agreement> agreement(const Scan& source, const Scan& target, const Rigid_motion& truth)
{
  const CR::internal::Reduced_scan &a = source.reduced(), &b = target.reduced();
  const CR::internal::Nearest_surfel surface{b.fine.surfels, b.fine.field, double(b.fine.spacing)};
  CR::internal::Similarity_refiner refiner(a.fine.surfels, a.fine.probes, surface, (std::max)(a.spacing, b.spacing));
  const Rigid_motion initial = b.own_from_input * truth * a.own_from_input.inverse();
  const CR::internal::Similarity_refinement best = refiner(initial);
  if (best.matches == 0) return std::nullopt;
  return Agreement(refiner, initial, best);
}

// n faces that meet in a corner, of cells of edge 1, with some roughness, as far as `size` from it along each edge.
Scan corner(std::size_t faces, std::size_t size, std::uint64_t seed)
{
  const CR::internal::Counter_random random(seed);
  std::uint64_t k = 0;
  Mesh mesh;
  for (std::size_t f = 0; f < faces; ++f) {
    const auto edge = [&](std::size_t i) {
      const double angle = 2 * CGAL_PI * double(i % faces) / double(faces) + 0.3 * double(i % faces % 2);
      return CR::internal::Vector(std::cos(angle), std::sin(angle), 0.7).normalized();
    };
    const CR::internal::Vector u = edge(f), v = edge(f + 1), n = u.cross(v).normalized();
    std::vector<std::vector<Mesh::Vertex_index>> rows;
    for (std::size_t i = 0; i <= size; ++i) {
      rows.emplace_back();
      for (std::size_t j = 0; i + j <= size; ++j) {
        const CR::internal::Vector p = double(i) * u + double(j) * v + 0.2 * random.normal(k++) * n;
        rows.back().push_back(mesh.add_vertex(Kernel::Point_3(p.x(), p.y(), p.z())));
      }
    }
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t j = 0; i + j < size; ++j) {
        mesh.add_face(rows[i][j], rows[i + 1][j], rows[i][j + 1]);
        if (i + j + 1 < size) mesh.add_face(rows[i + 1][j], rows[i + 1][j + 1], rows[i][j + 1]);
      }
  }
  return Scan(mesh);
}

void print(const std::string& title, std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) { return values[std::size_t(share * double(values.size() - 1))]; };
  std::cout << std::left << std::setw(52) << title << std::right << std::fixed << std::setprecision(3);
  if (values.empty()) std::cout << " none\n";
  else
    std::cout << std::setw(5) << values.size() << std::setw(9) << values.front() << std::setw(9) << at(0.05)
              << std::setw(9) << at(0.5) << std::setw(9) << at(0.95) << std::setw(9) << values.back() << '\n';
}

struct Of_pairs
{
  std::vector<double> matches, growth;

  void add(const std::optional<Agreement>& a)
  {
    if (!a) return;
    matches.push_back(a->matches);
    growth.push_back(a->growth);
  }

  // How many agree as well elsewhere, by other limits than those of is_as_good().
  std::size_t number_as_good(double fewest_matches, double largest_growth) const
  {
    std::size_t n = 0;
    for (std::size_t i = 0; i < matches.size(); ++i) n += matches[i] >= fewest_matches && growth[i] <= largest_growth;
    return n;
  }
};

int run(unsigned first_seed, std::size_t seeds)
{
  constexpr double degrees = 35, least_overlap = 0.4;
  const std::array<const char*, 4> kinds = {"statue", "pedestal", "part", "room"};
  const std::array<std::size_t, 3> sensors = {1, 3, 5}; // 30,000, 15,000 and 2,000 samples, with noise of .3, 1 and .2
  const std::vector<double> errors = {0, 0.02, 0.035, 0.05, 0.07, 0.1};
  Of_pairs determined, free;
  std::vector<std::size_t> found(errors.size(), 0);
  std::size_t pairs = 0;
  std::vector<double> apart; // of the scales found, from the one found at the true scale
  for (const char* kind : kinds)
    for (const std::size_t sensor : sensors)
      for (std::size_t k = 0; k < seeds; ++k) {
        const Simulated_set set(kind, first_seed + unsigned(k), 2, degrees, benchmark_tools::all_sensors()[sensor]);
        if (set.overlap(0, 1) < least_overlap) continue;
        const Scan source(set.views()[0].image), target(set.views()[1].image);
        const Rigid_motion truth = set.motion(0, 1);
        determined.add(agreement(source, target, truth));
        // A room's views do not hold the same: their scales are not looked for by their sizes.
        if (std::string(kind) == "room") continue;
        ++pairs;
        std::optional<double> best;
        for (std::size_t e = 0; e < errors.size(); ++e) {
          CR::internal::Run_control control;
          const auto outcome = CR::internal::registered_at<CGAL::Parallel_if_available_tag>(
              1 + errors[e], source, target, CR::Oriented_pair_candidates(), control);
          const double turn = benchmark_tools::degrees_between(Eigen::Matrix3d(outcome.motion.rotation),
                                                               Eigen::Matrix3d(truth.rotation));
          if (outcome.verdict.status == CR::NOT_REGISTERED || turn > 5) continue;
          ++found[e];
          if (!best) best = outcome.scale;
          else apart.push_back(std::abs(std::log(outcome.scale / *best)));
        }
      }
  for (const std::size_t faces : {3u, 4u, 5u})
    for (std::size_t k = 0; k < 4 * seeds; ++k) {
      const std::size_t size = 40 + 5 * (k % 8);
      free.add(agreement(corner(faces, size, 2 * k), corner(faces, size + 10, 2 * k + 1), Rigid_motion()));
    }
  std::cout << pairs << " pairs at a scale that is wrong by a share of it: how many have the right motion first\n";
  for (std::size_t e = 0; e < errors.size(); ++e)
    std::cout << std::fixed << std::setprecision(3) << "  " << errors[e] << ": " << found[e] << '\n';
  std::cout
      << "\n                                                    pairs    least      5 %   median     95 %  largest\n";
  print("scales found from wrong ones, apart, log", apart);
  print("matches elsewhere, scale determined", determined.matches);
  print("matches elsewhere, scale free", free.matches);
  print("growth of the median, scale determined", determined.growth);
  print("growth of the median, scale free", free.growth);
  std::cout << "\nby matches and growth: of " << determined.matches.size() << " that are determined and "
            << free.matches.size() << " that are free, agree as well elsewhere\n";
  for (const double matches : {0.8, 0.85, 0.9, 0.95})
    for (const double growth : {1., 1.1, 1.25, 1.5})
      std::cout << std::setprecision(2) << "  " << matches << ", " << growth << ": "
                << determined.number_as_good(matches, growth) << " and " << free.number_as_good(matches, growth)
                << '\n';
  return EXIT_SUCCESS;
}

} // namespace

int main(int argc, char* argv[])
{
  try {
    unsigned first_seed;
    std::size_t seeds;
    po::options_description description("Usage: scale_limits [OPTION...]\n\n"
                                        "Measures what the limits of register_scans_with_scale() are chosen by.\n\n"
                                        "Options");
    description.add_options()("help,h", "print this");
    description.add_options()("first-seed", po::value(&first_seed)->default_value(401), "of the scenes");
    description.add_options()("seeds", po::value(&seeds)->default_value(4), "scenes of each kind and sensor");
    po::variables_map values;
    if (!benchmark_tools::read_options(argc, argv, description, values)) return EXIT_SUCCESS;
    return run(first_seed, seeds);
  } catch (const std::exception& e) {
    std::cerr << "scale_limits: " << e.what() << '\n';
    return EXIT_FAILURE;
  }
}
