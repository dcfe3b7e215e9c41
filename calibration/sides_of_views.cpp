// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// How often the sides go together that orient_points() gives to views of which no sensor is known: of generated views
// of bodies, machined parts and rooms as points, how many look to their sensor, and of how many pairs of views of one
// scene both do, or neither. Where neither does, each motion fits as well as before.

#include "../benchmark/Crude_registration/command_line.h"
#include "simulated_set.h"

#include <CGAL/Crude_registration/internal/sampling/orient_points.h>

#include <boost/program_options.hpp>

#include <cstddef>
#include <cstdlib>
#include <exception>
#include <iomanip>
#include <iostream>
#include <string>
#include <vector>

namespace CR = CGAL::Crude_registration;
namespace po = boost::program_options;
using benchmark_tools::Simulated_set;
using CR::internal::Flat_sensor;
using CR::internal::Oriented_points;
using CR::internal::Vector;

namespace {

// The share of the samples that look to the sensor of the image, of which orient_points() is told the points alone.
double share_towards_sensor(const CR::Range_image<Simulated_set::Kernel>& image)
{
  std::vector<Vector> points;
  for (const auto& p : image.points()) points.emplace_back(p.x(), p.y(), p.z());
  const Oriented_points samples = CR::internal::orient_points(points, {}, {});
  const Flat_sensor sensor = CR::internal::to_flat_sensor(image.sensor());
  double towards = 0;
  for (std::size_t i = 0; i < samples.points.size(); ++i)
    towards += double(samples.normals[i].dot(sensor.towards(samples.points[i])) < 0);
  return samples.points.empty() ? 0 : towards / double(samples.points.size());
}

struct Counts
{
  double views = 0, towards = 0, mixed = 0, pairs = 0, together = 0;
};

} // namespace

int main(int argc, char* argv[])
{
  try {
    unsigned first_seed = 401;
    std::size_t views = 6;
    po::options_description options("sides_of_views: how often the sides of views without a sensor go together");
    options.add_options()("help,h", "this text")("first-seed", po::value(&first_seed)->default_value(first_seed),
                                                 "of the scenes")("views", po::value(&views)->default_value(views),
                                                                  "of each scene");
    po::variables_map values;
    if (!benchmark_tools::read_options(argc, argv, options, values)) return EXIT_SUCCESS;
    const auto sensors = benchmark_tools::all_sensors();
    double together = 0, kinds = 0;
    std::cout << std::fixed << std::setprecision(3)
              << "kind       views  towards  mixed  pairs overlapping  of these together\n";
    for (const std::string kind : {"statue", "pedestal", "plinth", "part", "room"}) {
      Counts n;
      for (std::size_t k = 0; k < sensors.size(); ++k) {
        const Simulated_set set(kind, first_seed + unsigned(k), views, 360. / double(views), std::vector{sensors[k]});
        std::vector<double> shares;
        for (std::size_t i = 0; i < views; ++i) {
          shares.push_back(share_towards_sensor(set.views()[i].image));
          ++n.views;
          n.towards += shares.back() > 0.9;
          n.mixed += shares.back() > 0.1 && shares.back() <= 0.9;
        }
        for (std::size_t i = 0; i < views; ++i)
          for (std::size_t j = i + 1; j < views; ++j) {
            if (!(set.overlap(i, j) > 0)) continue;
            ++n.pairs;
            n.together += (shares[i] > 0.5) == (shares[j] > 0.5);
          }
      }
      together += n.together / n.pairs;
      ++kinds;
      std::cout << std::left << std::setw(8) << kind << std::right << std::setw(8) << int(n.views) << std::setw(9)
                << n.towards / n.views << std::setw(7) << n.mixed / n.views << std::setw(19) << int(n.pairs)
                << std::setw(19) << n.together / n.pairs << '\n';
    }
    std::cout << "The mean of the kinds: " << together / kinds
              << "\ntowards: nine of ten samples look to the sensor; mixed: neither these nor one of ten or fewer\n";
    return EXIT_SUCCESS;
  } catch (const std::exception& e) {
    std::cerr << "sides_of_views: " << e.what() << '\n';
    return EXIT_FAILURE;
  }
}
