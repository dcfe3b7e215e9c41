// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_BENCHMARK_PEERS_PEER_H
#define CGAL_CRUDE_REGISTRATION_BENCHMARK_PEERS_PEER_H

// What the peers of compare_with_peers have in common.

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace benchmark_tools {

struct Peer_scan
{
  std::vector<Eigen::Vector3d> points;
  std::optional<Eigen::Vector3d> viewpoint, viewing_direction; // the sensor: one of them at most is known
  double diagonal = 0;                                         // of the points' box

  bool faces_away(const Eigen::Vector3d& p, const Eigen::Vector3d& normal) const
  {
    if (viewpoint) return (p - *viewpoint).dot(normal) > 0;
    return viewing_direction && viewing_direction->dot(normal) > 0;
  }
};

// Lengths but the voxel's are in voxels.
struct Peer_setting
{
  double voxel = 0.015; // in diagonals, the mean of the two scans
  double normal_radius = 2, feature_radius = 5;
  double distance = 1.5;        // of correspondences
  bool orients_normals = false; // towards the sensor
  int iterations = 0;
  double edge_similarity = 0;
  double confidence = 0;      // Open3D's RANSAC
  bool is_mutual = true;      // Open3D's RANSAC: correspondences both ways
  double inlier_fraction = 0; // PCL
};

// As bytes from process to process.
struct Peer_answer
{
  bool is_found = false;
  double seconds = 0;         // of CPU
  double matrix[3][4] = {{}}; // target from source

  template <class Matrix>
  void set_motion(const Matrix& m)
  {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 4; ++j) matrix[i][j] = double(m(i, j));
  }
};

} // namespace benchmark_tools

#endif // CGAL_CRUDE_REGISTRATION_BENCHMARK_PEERS_PEER_H
