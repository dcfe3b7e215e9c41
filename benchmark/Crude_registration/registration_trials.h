// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_BENCHMARK_REGISTRATION_TRIALS_H
#define CGAL_CRUDE_REGISTRATION_BENCHMARK_REGISTRATION_TRIALS_H

// Pairs of scans with their true motions, from files or simulated, that different methods are tried on.

#include "csv_table.h"
#include "moved_scan.h"
#include "result_tools.h"
#include "../../calibration/simulated_set.h"
#include "peers/Peer.h"

#include <CGAL/Crude_registration/sampling/estimate_sensor.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <boost/program_options.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace benchmark_tools {

struct Trial_options
{
  std::string pairs, scans, viewpoint;
  double minimum_overlap = 0;
  std::size_t generated = 0, every = 1;
  std::vector<std::size_t> sensors; // of the generated ones; empty: all
  bool one_direction = false;
};

inline void add_options(boost::program_options::options_description& description, Trial_options& options)
{
  namespace po = boost::program_options;
  description.add_options()("pairs", po::value(&options.pairs),
                            "CSV file with the columns source, target, overlap and m00 to m23, the true motion");
  description.add_options()("scans", po::value(&options.scans), "folder the file names in the pairs are relative to");
  description.add_options()("viewpoint", po::value(&options.viewpoint),
                            "x,y,z: where scans without a grid were seen from, in their own frame");
  description.add_options()("generated", po::value(&options.generated),
                            "instead of those: so many pairs of simulated scans");
  description.add_options()("sensors", po::value(&options.sensors)->multitoken(),
                            "numbers of their sensors, from 0; default: all");
  description.add_options()("minimum-overlap", po::value(&options.minimum_overlap)->default_value(0),
                            "least overlap of the pairs that are taken");
  description.add_options()("one-direction", po::bool_switch(&options.one_direction),
                            "of a pair and the same one exchanged take that whose source comes first by name");
  description.add_options()("every", po::value(&options.every)->default_value(1), "take one of so many pairs");
}

// A scan in memory, moved by a rigid motion of its own.
struct Trial_scan
{
  Moved_file moved;
  std::optional<Kernel::Point_3> viewpoint; // of what is no range image
  Peer_scan samples;                        // the same, for what sees no more
  Kernel::Point_3 centroid = CGAL::ORIGIN;
};

template <class Point_or_vector>
Eigen::Vector3d to_eigen(const Point_or_vector& p)
{
  return {p.x(), p.y(), p.z()};
}

inline Trial_scan to_trial_scan(const Moved_file& moved, const std::optional<Kernel::Point_3>& viewpoint,
                                const std::string& path)
{
  Trial_scan scan;
  scan.moved = moved;
  const CR::Scan_file<Kernel>& file = scan.moved.file;
  const Transformation file_from_moved = scan.moved.moved_from_file.inverse();
  CGAL::Bbox_3 box; // of what is in the file
  Kernel::Vector_3 sum = CGAL::NULL_VECTOR;
  const auto add = [&](const Kernel::Point_3& p) {
    scan.samples.points.emplace_back(p.x(), p.y(), p.z());
    sum = sum + (p - CGAL::ORIGIN);
    box += p.transform(file_from_moved).bbox();
  };
  for (const auto& p : file.image.points()) add(p);
  for (const auto& p : file.points) add(p);
  for (const auto& p : file.mesh.points()) add(p);
  if (scan.samples.points.empty()) throw std::runtime_error(path + ": the scan has no samples");
  scan.centroid = CGAL::ORIGIN + sum / double(scan.samples.points.size());
  const Kernel::Vector_3 diagonal(box.x_span(), box.y_span(), box.z_span());
  scan.samples.diagonal = std::sqrt(diagonal.squared_length());
  if (file.kind == CR::Scan_file<Kernel>::RANGE_IMAGE) {
    CR::Sensor<Kernel> sensor = file.image.sensor();
    if (!sensor.is_known()) sensor = CR::estimate_sensor(file.image);
    if (sensor.is_perspective()) scan.samples.viewpoint = to_eigen(sensor.viewpoint());
    if (sensor.is_orthographic()) scan.samples.viewing_direction = to_eigen(sensor.viewing_direction());
  } else if (viewpoint) {
    scan.viewpoint = scan.moved.moved(*viewpoint);
    scan.samples.viewpoint = to_eigen(*scan.viewpoint);
  }
  return scan;
}

struct Trial_pair
{
  std::string source, target;
  double overlap;
  Motion truth; // of the scans in their files
};

class Trials
{
public:
  explicit Trials(const Trial_options& options)
  {
    if (options.every == 0) throw std::invalid_argument("--every has to be at least 1");
    const bool has_files = !options.pairs.empty() && !options.scans.empty();
    if (has_files == (options.generated > 0))
      throw std::invalid_argument("either --pairs and --scans or --generated has to be given");
    if (has_files) read(options);
    else generate(options);
  }

  const std::vector<Trial_pair>& pairs() const { return m_pairs; }
  const Trial_scan& scan(const std::string& name) const { return m_scans.at(name); }

private:
  void read(const Trial_options& options)
  {
    const std::optional<Kernel::Point_3> viewpoint = read_point(options.viewpoint);
    std::size_t number_of_pair = 0;
    for (const Row& row : read_table(options.pairs)) {
      const Trial_pair pair = {row.at("source"), row.at("target"), number(row, "overlap"), motion(row)};
      if (pair.overlap < options.minimum_overlap || (options.one_direction && pair.target < pair.source)) continue;
      if (number_of_pair++ % options.every == 0) m_pairs.push_back(pair);
    }
    if (m_pairs.empty()) throw std::runtime_error(options.pairs + ": no pair is left");
    for (const Trial_pair& pair : m_pairs)
      for (const std::string& name : {pair.source, pair.target}) {
        const std::string path = options.scans + "/" + name;
        if (m_scans.count(name) == 0) m_scans.emplace(name, to_trial_scan(read_and_move(path, name), viewpoint, path));
      }
  }

  // Two views each of bodies, bodies on pedestals, parts and rooms, by sensors from fine to coarse and clean to noisy.
  // Their seeds are none of those that the confidence is fitted to.
  void generate(const Trial_options& options)
  {
    const std::array<const char*, 5> kinds = {"statue", "pedestal", "plinth", "part", "room"};
    const std::array<double, 4> turns = {25, 40, 55, 70}; // degrees
    constexpr unsigned first_seed = 9001;
    std::vector<Sensor_model> sensors = all_sensors();
    if (!options.sensors.empty()) {
      std::vector<Sensor_model> chosen;
      for (const std::size_t i : options.sensors) chosen.push_back(sensors.at(i));
      sensors = chosen;
    }
    std::size_t number_of_pair = 0;
    for (std::size_t i = 0; m_pairs.size() < options.generated; ++i) {
      const std::string kind = kinds[i % kinds.size()], name = kind + std::to_string(i);
      const Simulated_set set(kind, first_seed + unsigned(i), 2, turns[i % turns.size()], sensors[i % sensors.size()]);
      Trial_pair pair = {name + "_0", name + "_1", set.overlap(0, 1), {}};
      if (pair.overlap < options.minimum_overlap || number_of_pair++ % options.every != 0) continue;
      const Simulated_set::Rigid_motion truth = set.motion(0, 1);
      pair.truth << truth.rotation, truth.translation;
      m_pairs.push_back(pair);
      for (std::size_t view = 0; view < 2; ++view) {
        const std::string& scan_name = view == 0 ? pair.source : pair.target;
        CR::Scan_file<Kernel> file;
        file.kind = CR::Scan_file<Kernel>::RANGE_IMAGE;
        file.image = set.views()[view].image;
        m_scans.emplace(scan_name, to_trial_scan(moved_file(file, scan_name), std::nullopt, scan_name));
      }
    }
  }

  std::vector<Trial_pair> m_pairs;
  std::map<std::string, Trial_scan> m_scans;
};

// How far a motion of the moved scans is from the true one.
struct Trial_error
{
  double degrees = 0, centroid = 0; // the latter in diagonals of the source

  Trial_error(const double (&m)[3][4], const Motion& truth, const Trial_scan& source, const Trial_scan& target)
  {
    const Transformation moved(m[0][0], m[0][1], m[0][2], m[0][3], m[1][0], m[1][1], m[1][2], m[1][3], m[2][0], m[2][1],
                               m[2][2], m[2][3]);
    const Transformation found = target.moved.moved_from_file.inverse() * moved * source.moved.moved_from_file;
    const Kernel::Point_3 middle = source.centroid.transform(source.moved.moved_from_file.inverse());
    const Eigen::Vector3d wanted = truth.leftCols<3>() * to_eigen(middle) + truth.col(3);
    degrees = degrees_between(rotation(found), truth.leftCols<3>());
    centroid = (to_eigen(middle.transform(found)) - wanted).norm() / source.samples.diagonal;
  }

  bool is_small() const { return degrees < 5 && centroid < 0.05; }
};

} // namespace benchmark_tools

#endif // CGAL_CRUDE_REGISTRATION_BENCHMARK_REGISTRATION_TRIALS_H
