// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// What is left of the recall where points are thinned before they are registered: pairs of views of generated statues,
// as points, at full density and by voxels of a hundredth, a fiftieth and a thirtieth of their size, with a known
// sensor and without.

#include "command_line.h"
#include "result_tools.h"
#include "thinned_points.h"

#include <CGAL/Crude_registration/compare_points.h>
#include <CGAL/Crude_registration/register_scans.h>
#include <CGAL/Crude_registration/simulation/make_statue.h>
#include <CGAL/Crude_registration/simulation/simulate_range_image.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/centroid.h>

#include <boost/program_options.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <iomanip>
#include <iostream>
#include <vector>

namespace CR = CGAL::Crude_registration;
namespace po = boost::program_options;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Transformation = CGAL::Aff_transformation_3<Kernel>;
using Scan = CR::Scan<Kernel>;

namespace {

struct Options
{
  std::size_t statues = 20;
  unsigned first_seed = 301;
  double minimum_overlap = 0.3;
};

struct View
{
  std::vector<Point> points;
  Transformation scene_from_scan;
};

// From around the upright axis, so that neighbours are 30 and 45 degrees apart, and the outer ones 75; about 13,000
// samples with some noise, as one gets them from a scanner that loses what it sees at a grazing angle.
std::vector<View> views_of_statue(unsigned seed)
{
  Mesh statue;
  CR::make_statue(statue, 72, CR::parameters::random_seed(seed));
  const CR::Simulated_scene scene(statue);
  const CGAL::Bbox_3 box = CGAL::Polygon_mesh_processing::bbox(statue);
  std::vector<View> views;
  for (const double degrees : {0., 30., 75.}) {
    const double angle = degrees * CGAL_PI / 180;
    auto camera =
        CR::Range_camera<Kernel>::framing(box, Kernel::Vector_3(std::cos(angle), std::sin(angle), -0.2), 330, true);
    camera.noise = 0.2;
    camera.drop_out = 0.02;
    camera.grazing_drop_out = 0.8;
    camera.seed = std::uint64_t(seed) * 100 + std::uint64_t(degrees);
    const auto simulated = scene.range_image(camera);
    views.push_back({simulated.image.points(), simulated.scene_from_scan});
  }
  return views;
}

// Of simulated points, which are in the sensor's own frame.
Scan prepared(const std::vector<Point>& points, bool with_sensor)
{
  return with_sensor ? Scan(points, CR::parameters::viewpoint(Point(CGAL::ORIGIN))) : Scan(points);
}

// The share of the source's points that have the target's surface within two sampling distances at the true motion.
double overlap(const View& source, const View& target, const Transformation& truth)
{
  const Scan from = prepared(source.points, true), to = prepared(target.points, true);
  const double reach = 2 * (std::max)(from.spacing(), to.spacing());
  std::size_t near = 0;
  for (const auto& met : CR::compare_points(source.points, from, to, truth)) near += std::abs(met.distance) <= reach;
  return double(near) / double(source.points.size());
}

struct Counts
{
  std::size_t pairs = 0, points = 0, right = 0, first = 0, wrong = 0;
};

void count(const View& source, const View& target, const Transformation& truth, double voxels, bool with_sensor,
           Counts& counts)
{
  const auto thinned = [&](const View& v) {
    return voxels > 0 ? benchmark_tools::thinned_points(v.points, benchmark_tools::diagonal(v.points) / voxels)
                      : v.points;
  };
  const std::vector<Point> from = thinned(source), to = thinned(target);
  const auto result = CR::register_scans(prepared(from, with_sensor), prepared(to, with_sensor));
  const Point middle = CGAL::centroid(source.points.begin(), source.points.end(), CGAL::Dimension_tag<0>());
  const Transformation found = result.transformation();
  const bool is_right = result.status() != CR::NOT_REGISTERED && benchmark_tools::degrees_between(found, truth) < 5 &&
                        std::sqrt(CGAL::squared_distance(middle.transform(found), middle.transform(truth))) <
                            0.05 * benchmark_tools::diagonal(source.points);
  ++counts.pairs;
  counts.points += from.size();
  counts.first += is_right;
  counts.right += is_right && result.status() == CR::REGISTERED;
  counts.wrong += !is_right && result.status() == CR::REGISTERED;
}

int run(const Options& options)
{
  const std::array<double, 4> densities = {0, 100, 50, 30}; // voxels along the diagonal; 0: all points
  std::array<std::array<Counts, 2>, densities.size()> counts = {};
  for (std::size_t k = 0; k < options.statues; ++k) {
    const std::vector<View> views = views_of_statue(options.first_seed + unsigned(k));
    for (std::size_t s = 0; s < views.size(); ++s) {
      const View &source = views[s], &target = views[(s + 1) % views.size()];
      const Transformation truth = target.scene_from_scan.inverse() * source.scene_from_scan;
      if (overlap(source, target, truth) < options.minimum_overlap) continue;
      for (std::size_t d = 0; d < densities.size(); ++d)
        for (const bool with_sensor : {true, false})
          count(source, target, truth, densities[d], with_sensor, counts[d][with_sensor ? 0 : 1]);
    }
  }
  std::cout << "voxel       sensor   points  pairs  right  right first  wrong\n";
  std::size_t wrong = 0;
  for (std::size_t d = 0; d < densities.size(); ++d)
    for (std::size_t sensor = 0; sensor < 2; ++sensor) {
      const Counts& c = counts[d][sensor];
      if (densities[d] > 0) std::cout << "size / " << std::left << std::setw(5) << densities[d];
      else std::cout << "all points  ";
      std::cout << std::left << std::setw(7) << (sensor == 0 ? "known" : "none") << std::right << std::setw(8)
                << c.points / (std::max)(c.pairs, std::size_t(1)) << std::setw(7) << c.pairs << std::setw(7) << c.right
                << std::setw(13) << c.first << std::setw(7) << c.wrong << '\n';
      wrong += c.wrong;
    }
  std::cout << "right: registered within 5 degrees, and 5 % of the diagonal at the centroid; right first: the most "
               "probable motion\nis right, registered or not; wrong: registered and not right\n";
  return wrong == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

} // namespace

int main(int argc, char* argv[])
{
  try {
    Options options;
    po::options_description description("Usage: thinned_scans [OPTION...]\n\n"
                                        "Registers views of generated statues as points, thinned by voxels.\n\n"
                                        "Options");
    description.add_options()("help,h", "print this");
    description.add_options()("statues", po::value(&options.statues)->default_value(options.statues),
                              "of three pairs each");
    description.add_options()("first-seed", po::value(&options.first_seed)->default_value(options.first_seed),
                              "of the statues");
    description.add_options()("minimum-overlap",
                              po::value(&options.minimum_overlap)->default_value(options.minimum_overlap),
                              "least overlap of the pairs that are taken");
    po::variables_map values;
    if (!benchmark_tools::read_options(argc, argv, description, values)) return EXIT_SUCCESS;
    return run(options);
  } catch (const std::exception& e) {
    std::cerr << "thinned_scans: " << e.what() << '\n';
    return EXIT_FAILURE;
  }
}
