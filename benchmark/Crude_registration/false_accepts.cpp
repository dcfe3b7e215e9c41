// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// How often scans that do not belong together are registered, with the 95 % bound of the rate: 3 / n where it was never
// seen in n trials (the rule of three; Hanley and Lippman-Hand 1983).
//
// Bodies, bodies on pedestals, parts and rooms, each seen once by one of the sensors, and once in a mirror from a side
// that shares some of it: every scan is tried against those of all other scenes and against all mirrored ones. A scene
// that is its own mirror image is seen by a mirrored view as it is: where that lies on the scene's surface as closely
// as the view does that was not mirrored, the two do belong together, and it is no trial.

#include "command_line.h"
#include "../../calibration/simulated_set.h"

#include <CGAL/Crude_registration/register_scans.h>

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>

#include <boost/program_options.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

namespace CR = CGAL::Crude_registration;
namespace po = boost::program_options;
using Kernel = benchmark_tools::Simulated_set::Kernel;
using Scan = CR::Scan<Kernel>;

namespace {

// The scene of that number, from two sides.
benchmark_tools::Simulated_set scene(std::size_t number, unsigned first_seed)
{
  const std::array<const char*, 5> kinds = {"statue", "pedestal", "plinth", "part", "room"};
  const std::vector<benchmark_tools::Sensor_model> sensors = benchmark_tools::all_sensors();
  constexpr double degrees = 30;
  return {kinds[number % kinds.size()], first_seed + unsigned(number), 2, degrees, sensors[number % sensors.size()]};
}

struct Trial_scans
{
  std::vector<Scan> plain, mirrored; // one of either a scene
};

Trial_scans make_scans(std::size_t scenes, unsigned first_seed)
{
  Trial_scans scans;
  for (std::size_t k = 0; k < scenes; ++k) {
    const benchmark_tools::Simulated_set set = scene(k, first_seed);
    const bool with_sensor = k % 3 != 2;
    scans.plain.push_back(benchmark_tools::scan_of(set.views()[0].image, with_sensor));
    scans.mirrored.push_back(benchmark_tools::scan_of(benchmark_tools::mirrored(set.views()[1].image), with_sensor));
  }
  return scans;
}

// Whether the mirrored view of a scene, moved to the plain one, lies on the scene: the root mean square distance of all
// its points from the surface, seen or not, is at most two sampling distances, from which on a motion is told to be
// wrong. `motion`: of the plain one to the mirrored one.
bool is_own_mirror_image(const benchmark_tools::Simulated_set& set, const Kernel::Aff_transformation_3& motion)
{
  using Primitive = CGAL::AABB_face_graph_triangle_primitive<benchmark_tools::Simulated_set::Mesh>;
  const auto& mesh = set.mesh();
  const CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree(faces(mesh).first, faces(mesh).second, mesh);
  const Kernel::Aff_transformation_3 scene_from_mirrored = set.views()[0].scene_from_scan * motion.inverse();
  const auto mirrored = benchmark_tools::mirrored(set.views()[1].image);
  double sum = 0;
  for (const Kernel::Point_3& p : mirrored.points())
    sum += CGAL::to_double(tree.squared_distance(scene_from_mirrored(p)));
  const double most = 2 * set.spacing(1);
  return sum <= most * most * double(mirrored.points().size());
}

// Trials of one kind.
struct Tally
{
  const char* what;
  std::size_t trials = 0, registered = 0;
};

// The bound of a rate of `count` in `n`: of a Poisson number, at 95 %, by its normal approximation beyond none.
double bound(std::size_t count, std::size_t n)
{
  const auto c = double(count);
  return (count == 0 ? 3 : c + 1.645 * std::sqrt(c) + 2) / double(n);
}

} // namespace

int main(int argc, char** argv)
{
  try {
    std::size_t trials, scenes;
    unsigned first_seed;
    po::options_description options("false_accepts: registers scans that do not belong together");
    options.add_options()("help,h", "this text")("trials", po::value(&trials)->default_value(30000), "at most")(
        "scenes", po::value(&scenes)->default_value(150),
        "of which each is tried with each")("first-seed", po::value(&first_seed)->default_value(5001), "of the scenes");
    po::variables_map values;
    if (!benchmark_tools::read_options(argc, argv, options, values)) return EXIT_SUCCESS;
    const Trial_scans scans = make_scans(scenes, first_seed);
    std::array<Tally, 3> tallies = {{{"other scenes"}, {"other scenes in a mirror"}, {"the same scene in a mirror"}}};
    std::size_t n = 0, registered = 0, ambiguous = 0, right = 0;
    double largest = 0;
    // `mirrored`: the number of the scene whose mirrored view `b` is of, where `a` is of the same one.
    const auto attempt = [&](const Scan& a, const Scan& b, const std::string& what, std::size_t kind,
                             std::optional<std::size_t> mirrored) {
      if (n + right == trials) return;
      const auto result = CR::register_scans<CGAL::Parallel_if_available_tag>(a, b);
      if (result.status() == CR::REGISTERED && mirrored &&
          is_own_mirror_image(scene(*mirrored, first_seed), result.transformation())) {
        ++right;
        std::cout << what << " is no trial: it is its own mirror image, and registered so" << std::endl;
        return;
      }
      ++n;
      ++tallies[kind].trials;
      largest = (std::max)(largest, result.confidence());
      ambiguous += result.status() == CR::AMBIGUOUS;
      constexpr std::size_t often = 1000;
      if (n % often == 0) std::cerr << n << " trials so far, " << registered << " registered\n";
      if (result.status() != CR::REGISTERED) return;
      ++registered;
      ++tallies[kind].registered;
      std::cout << what << " is registered, confidence " << result.confidence() << std::endl;
    };
    // By distance in the list, so that the first trials are of all kinds.
    for (std::size_t d = 0; d < scenes; ++d)
      for (std::size_t i = 0; i < scenes; ++i) {
        const std::size_t j = (i + d) % scenes;
        const std::string name = std::to_string(i) + " to " + std::to_string(j);
        attempt(scans.plain[i], scans.mirrored[j], name + " in a mirror", i == j ? 2 : 1,
                i == j ? std::optional(i) : std::nullopt);
        if (i < j) attempt(scans.plain[i], scans.plain[j], name, 0, std::nullopt);
      }
    for (const Tally& t : tallies)
      if (t.trials > 0)
        std::cout << t.what << ": " << t.registered << " of " << t.trials << " registered, at 95 % below "
                  << bound(t.registered, t.trials) << '\n';
    std::cout << n << " trials, " << registered << " registered, " << ambiguous << " ambiguous, largest confidence "
              << largest << "; at 95 % the rate of false accepts is below " << bound(registered, n) << '\n';
    return registered == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
  } catch (const std::exception& e) {
    std::cerr << "false_accepts: " << e.what() << '\n';
    return EXIT_FAILURE;
  }
}
