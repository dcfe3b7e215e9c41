// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// simulate: writes range scans of a generated body, with their poses.

#include "commands.h"
#include "files.h"
#include "options.h"
#include "progress.h"

#include <CGAL/Crude_registration/IO/write_range_image.h>
#include <CGAL/Crude_registration/simulation/make_statue.h>
#include <CGAL/Crude_registration/simulation/simulate_range_image.h>

#include <CGAL/Polygon_mesh_processing/bbox.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <limits>
#include <locale>
#include <sstream>
#include <string>
#include <vector>

int run_simulate(const std::vector<std::string>& arguments)
{
  po::options_description options("options");
  auto add = options.add_options();
  add("output", po::value<std::string>()->required(),
      "folder for scan_0.ply, scan_1.ply, ... and poses.txt; made if "
      "missing");
  add("scans", po::value<int>()->default_value(2), "number of scans");
  add("angle", po::value<double>()->default_value(45), "degrees from one viewpoint to the next, around the body");
  add("samples", po::value<int>()->default_value(400), "columns, and rows, of the grid");
  add("noise", po::value<double>()->default_value(0.1), "standard deviation of the depths, in distances of samples");
  add("quantization", po::value<double>()->default_value(0), "step of the depths, in distances of samples");
  add("drop-out", po::value<double>()->default_value(0.01), "share of samples lost where the surface faces the sensor");
  add("grazing-drop-out", po::value<double>()->default_value(0.8), "share of samples lost at grazing angles");
  add("pedestal", po::value<double>(),
      "side of a square pedestal that the body, which is about 2 tall, stands on; half as high; none if not given");
  add("perspective", "lines of sight from one point, instead of parallel ones");
  add("resolution", po::value<int>()->default_value(96), "cells along the body");
  add("seed", po::value<unsigned>()->default_value(0), "which body, and which noise");
  const Command command = {
      "simulate",
      "--output DIR",
      "Writes range scans of a generated body, each in the frame of its sensor, and their true poses.\n",
      {{"--output scans", "two scans that overlap"},
       {"--output scans --scans 8 --seed 3", "eight scans from all around another body"}},
      {}};
  const auto given = parse(command, options, {}, arguments);
  if (!given) return 0;
  const po::variables_map& map = *given;
  const std::string folder = map["output"].as<std::string>();
  const int scans = map["scans"].as<int>(), samples = map["samples"].as<int>();
  const double angle = map["angle"].as<double>() * CGAL_PI / 180;
  const unsigned seed = map["seed"].as<unsigned>();
  if (scans < 1) throw Usage_error("--scans takes a number above zero");
  if (samples < 2 || samples > 20000) throw Usage_error("--samples takes a number from 2 to 20000");
  if (!std::isfinite(angle)) throw Usage_error("--angle takes a finite number");

  Mesh body;
  CR::make_statue(body, map["resolution"].as<int>(), CR::parameters::random_seed(seed));
  if (const auto side = value_of<double>(map, "pedestal")) {
    if (!(*side > 0 && std::isfinite(*side))) throw Usage_error("--pedestal takes a length above zero");
    // The foot is in it, so that no light falls between.
    const double top = CGAL::Polygon_mesh_processing::bbox(body).zmin() + 0.15;
    CR::make_pedestal(body, *side, top - *side / 2, top);
  }
  watch_for_interruption();
  Progress progress;
  progress.begin_stage("simulating");
  const CR::Simulated_scene scene(body);
  make_folder(folder);
  std::ostringstream poses;
  poses.imbue(std::locale::classic());
  poses.precision(std::numeric_limits<double>::max_digits10);
  for (int i = 0; i < scans && !is_interrupted(); ++i) {
    // From above, a little.
    const Kernel::Vector_3 direction(-std::cos(i * angle), -std::sin(i * angle), -0.25);
    auto camera = CR::Range_camera<Kernel>::framing(CGAL::Polygon_mesh_processing::bbox(body), direction,
                                                    std::size_t(samples), map.count("perspective") > 0);
    camera.noise = map["noise"].as<double>();
    camera.quantization = map["quantization"].as<double>();
    camera.drop_out = map["drop-out"].as<double>();
    camera.grazing_drop_out = map["grazing-drop-out"].as<double>();
    camera.seed = std::uint64_t(seed) * 1000003u + std::uint64_t(i);
    const auto scan = scene.range_image(camera);
    const std::string name = "scan_" + std::to_string(i) + ".ply";
    CR::write_range_image(in_folder(folder, name), scan.image);
    poses << name;
    write_rows(poses, scan.scene_from_scan, " ", "");
    poses << '\n';
    progress.clear();
    std::cout << in_folder(folder, name) << ", " << scan.image.points().size() << " samples\n" << std::flush;
    progress.begin_stage("simulating");
  }
  progress.clear();
  const std::string poses_file = in_folder(folder, "poses.txt");
  CR::write_file(poses_file, [&](std::ostream& out) { out << poses.str(); });
  std::cout << poses_file << '\n';
  return 0;
}
