// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// A rival of the paper's, spin images, by PCL, on its four pairs of bunny scans, beside the paper's method.
//
// A spin image is a histogram of where the points around a point lie: how far from its normal, and how far along it.
// Points with similar images correspond; triples of correspondences that keep their distances give motions. It takes
// the normals to be right: they are turned to the known sensor.

#include "bunny_pairs.h"
#include "peers/spin_images.h"
#include "rival_trials.h"

#include <CGAL/Crude_registration/sampling/estimate_sensor.h>

#include <boost/program_options.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <string>

namespace po = boost::program_options;
using benchmark_tools::Peer_scan;
using benchmark_tools::Peer_setting;
using benchmark_tools::Rival_answer;

namespace {

Peer_scan to_peer_scan(const bunny::Dense_scan& scan)
{
  Peer_scan result;
  CGAL::Bbox_3 box;
  for (const auto& p : scan.image.points()) {
    result.points.emplace_back(p.x(), p.y(), p.z());
    box += p.bbox();
  }
  result.diagonal = Eigen::Vector3d(box.x_span(), box.y_span(), box.z_span()).norm();
  auto sensor = scan.image.sensor();
  if (!sensor.is_known()) sensor = CGAL::Crude_registration::estimate_sensor(scan.image);
  const auto to_eigen = [](const auto& v) { return Eigen::Vector3d(v.x(), v.y(), v.z()); };
  if (sensor.is_perspective()) result.viewpoint = to_eigen(sensor.viewpoint());
  if (sensor.is_orthographic()) result.viewing_direction = to_eigen(sensor.viewing_direction());
  return result;
}

Rival_answer register_by_spin_images(const bunny::Dense_scan& source, const bunny::Dense_scan& target,
                                     const bunny::Transformation& truth, const Peer_setting& setting)
{
  const benchmark_tools::Peer_answer found =
      benchmark_tools::register_by_spin_images(to_peer_scan(source), to_peer_scan(target), setting);
  Rival_answer answer;
  answer.seconds = found.seconds;
  const auto& m = found.matrix;
  const bunny::Transformation motion(m[0][0], m[0][1], m[0][2], m[0][3], m[1][0], m[1][1], m[1][2], m[1][3], m[2][0],
                                     m[2][1], m[2][2], m[2][3]);
  answer.judge(source, target, motion, truth);
  answer.is_right = answer.is_right && found.is_found;
  return answer;
}

void run(const std::string& folder, const Peer_setting& setting)
{
  std::size_t right = 0;
  const double reference = benchmark_tools::for_each_of_the_papers_pairs(
      folder, [&](const bunny::Dense_scan& source, const bunny::Dense_scan& target, const bunny::Transformation& truth,
                  const auto& print) {
        const Rival_answer answer = register_by_spin_images(source, target, truth, setting);
        right += answer.is_right;
        print("spin images", answer);
      });
  benchmark_tools::print_summary("spin images are right on ", right, "4 pairs", reference);
}

} // namespace

int main(int argc, char* argv[])
{
  Peer_setting s = benchmark_tools::spin_image_setting();
  const auto add_options = [&](po::options_description& description) {
    description.add_options()("voxel", po::value(&s.voxel)->default_value(s.voxel),
                              "that leaves one point, in shares of the diagonal of the scan");
    description.add_options()("radius", po::value(&s.feature_radius)->default_value(s.feature_radius),
                              "of a spin image, in voxels");
    description.add_options()("similarity", po::value(&s.edge_similarity)->default_value(s.edge_similarity),
                              "of the sides of triangles that correspond");
    description.add_options()("iterations", po::value(&s.iterations)->default_value(s.iterations), "of the RANSAC");
  };
  return benchmark_tools::rival_program(argc, argv, "rival_spin_images",
                                        "PCL's spin images and its\nRANSAC with prerejection, and by this package.",
                                        add_options, [&](const std::string& folder) { run(folder, s); });
}
