// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_BENCHMARK_MOVED_SCAN_H
#define CGAL_CRUDE_REGISTRATION_BENCHMARK_MOVED_SCAN_H

// Pairs of scans in files, each scan moved by a rigid motion of its own, so that no start and no axis helps.

#include "result_tools.h"

#include <CGAL/Crude_registration/IO/read_scan.h>
#include <CGAL/Crude_registration/Range_image.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/transform.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <optional>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace benchmark_tools {

namespace CR = CGAL::Crude_registration;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Transformation = CGAL::Aff_transformation_3<Kernel>;

struct Pair
{
  std::string source, target;
};

inline std::vector<Pair> read_pairs(const std::string& path)
{
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot open " + path);
  std::string line;
  std::getline(file, line);
  if (line.rfind("source,target", 0) != 0)
    throw std::runtime_error(path + ":1: the first line has to name the columns, source and target first");
  std::vector<Pair> pairs;
  for (std::size_t number = 2; std::getline(file, line); ++number) {
    if (line.empty()) continue;
    std::stringstream fields(line);
    Pair pair;
    std::getline(fields, pair.source, ',');
    std::getline(fields, pair.target, ',');
    if (pair.source.empty() || pair.target.empty())
      throw std::runtime_error(path + ":" + std::to_string(number) + ": no source and target");
    pairs.push_back(pair);
  }
  return pairs;
}

// "x,y,z" of the option --viewpoint; none if it is empty.
inline std::optional<Kernel::Point_3> read_point(const std::string& text)
{
  if (text.empty()) return std::nullopt;
  std::istringstream in(text);
  double x, y, z;
  char comma_1, comma_2;
  if (!(in >> x >> comma_1 >> y >> comma_2 >> z) || comma_1 != ',' || comma_2 != ',' || !(in >> std::ws).eof())
    throw std::runtime_error("--viewpoint has to be x,y,z, not " + text);
  return Kernel::Point_3(x, y, z);
}

// A rigid motion that depends on the name and the size alone: a turn drawn evenly from all, a shift of up to the size.
inline Transformation motion_of_name(const std::string& name, double size)
{
  std::uint64_t hash = 14695981039346656037u; // FNV-1a
  for (char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  // The standard says which numbers the engine gives; those of its distributions differ from library to library.
  std::mt19937_64 random(hash);
  const auto next = [&random] { return 2 * (double(random() >> 11) * 0x1p-53) - 1; }; // in [-1, 1)
  Eigen::Quaterniond q;
  do {
    const double w = next(), x = next(), y = next(), z = next();
    q = Eigen::Quaterniond(w, x, y, z);
  } while (q.norm() > 1 || q.norm() < 0.1);
  Eigen::Vector3d shift;
  for (int i = 0; i < 3; ++i) shift[i] = size * next();
  return to_motion<Kernel>(q.normalized().toRotationMatrix(), shift);
}

struct Moved_file
{
  CR::Scan_file<Kernel> file;
  Transformation moved_from_file = Transformation(CGAL::IDENTITY);

  Kernel::Point_3 moved(const Kernel::Point_3& p) const { return p.transform(moved_from_file); }
};

inline Moved_file moved_file(CR::Scan_file<Kernel> scan, const std::string& name)
{
  Moved_file moved;
  moved.file = std::move(scan);
  CR::Scan_file<Kernel>& file = moved.file;
  CGAL::Bbox_3 box;
  for (const auto& p : file.image.points()) box += p.bbox();
  for (const auto& p : file.points) box += p.bbox();
  for (const auto& p : file.mesh.points()) box += p.bbox();
  moved.moved_from_file =
      motion_of_name(name, (std::max)({box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin()}));
  const Transformation& motion = moved.moved_from_file;
  CR::transform(file.image, motion);
  for (auto& p : file.points) p = p.transform(motion);
  for (auto& n : file.normals) n = n.transform(motion);
  file.sensor = file.sensor.transformed(motion);
  CGAL::Polygon_mesh_processing::transform(motion, file.mesh);
  return moved;
}

inline Moved_file read_and_move(const std::string& path, const std::string& name)
{
  return moved_file(CR::read_scan<Kernel>(path), name);
}

} // namespace benchmark_tools

#endif // CGAL_CRUDE_REGISTRATION_BENCHMARK_MOVED_SCAN_H
