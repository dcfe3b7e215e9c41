// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// Whether the confidence means what it says: of the answers of all_pairs, by their confidence, the share that is right.
//
// confidence_calibration RESULTS.csv SET_DIR [RESULTS.csv SET_DIR ...]
//
// SET_DIR holds pairs.csv (source,target,overlap,m00..m23, the true motion of the source to the target) and scans.csv
// (per scan: diagonal, centroid and covariance). An answer is right if its rotation is within 5 degrees and the root
// mean square displacement of the source's points within 5 % of the source's diagonal.

#include "csv_table.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <iomanip>
#include <iostream>
#include <map>
#include <string>
#include <utility>
#include <vector>

using benchmark_tools::motion;
using benchmark_tools::Motion;
using benchmark_tools::number;
using benchmark_tools::read_table;
using benchmark_tools::Row;

namespace {

bool has_motion(const Row& row)
{
  const auto field = row.find("m00");
  return field != row.end() && !field->second.empty();
}

bool is_right(const Motion& found, const Motion& wanted, const Row& scan)
{
  const Eigen::Matrix3d turn = found.leftCols<3>() * wanted.leftCols<3>().transpose();
  if (Eigen::AngleAxisd(turn).angle() >= 5 * EIGEN_PI / 180) return false;
  const Eigen::Vector3d centroid(number(scan, "cx"), number(scan, "cy"), number(scan, "cz"));
  Eigen::Matrix3d covariance;
  covariance << number(scan, "c00"), number(scan, "c01"), number(scan, "c02"), number(scan, "c01"), number(scan, "c11"),
      number(scan, "c12"), number(scan, "c02"), number(scan, "c12"), number(scan, "c22");
  const Motion d = found - wanted;
  const Eigen::Matrix3d r = d.leftCols<3>();
  const double squared = (r * centroid + d.col(3)).squaredNorm() + (r * covariance * r.transpose()).trace();
  return std::sqrt((std::max)(squared, 0.)) < 0.05 * number(scan, "diagonal");
}

struct Bin
{
  std::size_t answers = 0, right = 0;
  double confidence = 0;
};

} // namespace

int main(int argc, char** argv)
{
  if (argc < 3 || argc % 2 == 0) {
    std::cerr << "usage: confidence_calibration RESULTS.csv SET_DIR [RESULTS.csv SET_DIR ...]\n";
    return EXIT_FAILURE;
  }
  try {
    const std::array<double, 8> edges = {0, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 1};
    std::array<Bin, 7> bins;
    Bin believed;
    for (int a = 1; a < argc; a += 2) {
      const std::string set = argv[a + 1];
      std::map<std::string, Row> scans;
      for (const Row& row : read_table(set + "/scans.csv")) scans[row.at("scan")] = row;
      std::map<std::pair<std::string, std::string>, Motion> truth;
      for (const Row& row : read_table(set + "/pairs.csv")) truth[{row.at("source"), row.at("target")}] = motion(row);
      for (const Row& row : read_table(argv[a])) {
        if (!has_motion(row)) continue;
        const bool right =
            is_right(motion(row), truth.at({row.at("source"), row.at("target")}), scans.at(row.at("source")));
        const double confidence = number(row, "confidence");
        std::size_t b = 0;
        while (b + 1 < bins.size() && confidence >= edges[b + 1]) ++b;
        const auto count = [&](Bin& bin) {
          ++bin.answers;
          bin.right += right;
          bin.confidence += confidence;
        };
        count(bins[b]);
        if (confidence >= 0.9) count(believed);
      }
    }
    std::cout << "confidence   answers   right   share right   mean confidence\n" << std::fixed;
    const auto print = [](double from, double to, const Bin& bin) {
      const auto n = double(bin.answers);
      std::cout << std::setprecision(2) << from << "-" << to << std::setw(12) << bin.answers << std::setw(8)
                << bin.right << std::setprecision(4) << std::setw(14) << (bin.answers > 0 ? double(bin.right) / n : 0)
                << std::setw(18) << (bin.answers > 0 ? bin.confidence / n : 0) << '\n';
    };
    for (std::size_t b = 0; b < bins.size(); ++b) print(edges[b], edges[b + 1], bins[b]);
    std::cout << "believed:\n";
    print(0.9, 1, believed);
  } catch (const std::exception& e) {
    std::cerr << "confidence_calibration: " << e.what() << '\n';
    return EXIT_FAILURE;
  }
}
