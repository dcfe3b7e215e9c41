// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CRUDE_REGISTER_SIDES_H
#define CRUDE_REGISTER_SIDES_H

// The two scans of a command that takes a source and a target, with what its options say of each.

#include "files.h"
#include "options.h"
#include "scan_arguments.h"

#include <CGAL/Crude_registration/IO/Depth_camera.h>

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>

// The units of length that files have, in metres.
inline const std::map<std::string, double> units = {
    {"mm", 0.001}, {"cm", 0.01}, {"m", 1}, {"in", 0.0254}, {"ft", 0.3048}};

// The viewpoint of a side, "source" or "target": its own option's, or the one of --viewpoint, which is for both.
inline std::optional<Point> viewpoint_of(const po::variables_map& map, const std::string& side)
{
  const std::string own = side + "-viewpoint";
  const std::optional<Point> both = point_of(map, "viewpoint"), given = point_of(map, own);
  if (both && given) throw Usage_error("--viewpoint is for both scans: --" + own + " excludes it");
  if (map.count("no-viewpoint") > 0 && (both || given))
    throw Usage_error(std::string("--no-viewpoint excludes --") + (both ? "viewpoint" : own));
  return both ? both : given;
}

// How many units of length of the target one of the source is.
inline double ratio_of_units(const po::variables_map& map)
{
  std::array<double, 2> metres = {1, 1};
  std::size_t given = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string option = i == 0 ? "source-unit" : "target-unit";
    const auto unit = value_of<std::string>(map, option.c_str());
    if (!unit) continue;
    const auto found = units.find(*unit);
    if (found == units.end()) throw Usage_error("--" + option + " takes mm, cm, m, in or ft, not '" + *unit + "'");
    metres[i] = found->second;
    ++given;
  }
  if (given == 1) throw Usage_error("--source-unit and --target-unit are given together");
  return metres[0] / metres[1];
}

struct Scan_of_a_side
{
  std::string file;
  std::optional<Point> viewpoint; // in the unit of the file, until it is read
  CR::Depth_camera camera;
  double unit = 1;                // of the file, in that of the answer
  bool without_viewpoint = false; // what the file says of its sensor is passed over
  Scan_file contents;

  void read()
  {
    contents = CR::read_scan<Kernel>(file, camera);
    if (without_viewpoint) forget_sensor(contents);
    viewpoint = viewpoint_of(contents, viewpoint);
    if (unit == 1) return;
    scale(contents, unit);
    if (viewpoint) viewpoint = viewpoint->transform(Transformation(CGAL::SCALING, unit));
  }
};

inline void add_options_of_sides(po::options_description& options)
{
  auto add = options.add_options();
  add("source-viewpoint", po::value<std::string>(),
      "x,y,z of the sensor that saw the source, in the source's frame, where its file does not tell it");
  add("target-viewpoint", po::value<std::string>(), "the same for the target, in the target's frame");
  add("viewpoint", po::value<std::string>(), "both: the same numbers in each scan's own frame");
  add("no-viewpoint", "pass over what the files say of their sensors");
  add("source-unit", po::value<std::string>(),
      "mm, cm, m, in or ft: the source is scaled to the unit of the target, which the answer is in");
  add("target-unit", po::value<std::string>(), "the unit of the target, given with the other");
  add("camera", po::value<std::string>(), camera_help);
}

// As the arguments say; nothing is read.
inline std::array<Scan_of_a_side, 2> sides_of(const po::variables_map& map)
{
  std::array<Scan_of_a_side, 2> sides;
  for (std::size_t i = 0; i < 2; ++i) {
    sides[i].file = scan_of_argument(map[i == 0 ? "SOURCE" : "TARGET"].as<std::string>());
    sides[i].viewpoint = viewpoint_of(map, i == 0 ? "source" : "target");
    sides[i].camera = camera_of(map, sides[i].file);
    sides[i].without_viewpoint = map.count("no-viewpoint") > 0;
  }
  sides[0].unit = ratio_of_units(map);
  return sides;
}

#endif // CRUDE_REGISTER_SIDES_H
