// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_BENCHMARK_PEERS_OPEN3D_H
#define CGAL_CRUDE_REGISTRATION_BENCHMARK_PEERS_OPEN3D_H

// Open3D: fast point feature histograms, matched by RANSAC or by fast global registration.

#include "Peer.h"

namespace benchmark_tools {

// Global registration as in Open3D's tutorial of that name: of RANSAC the setting of its first releases, with 4,000,000
// iterations. The tutorial does not orient normals.
inline Peer_setting open3d_ransac_documented()
{
  Peer_setting s;
  s.iterations = 4000000;
  s.confidence = 0.999;
  s.edge_similarity = 0.9;
  return s;
}

inline Peer_setting open3d_fgr_documented()
{
  Peer_setting s;
  s.distance = 0.5;
  return s;
}

// Of the settings that compare_with_peers --tune compares, on a third of the bunny's pairs with an overlap of 0.1 or
// more, normals oriented towards the sensor: those with the most right answers, the fastest first.
inline Peer_setting open3d_ransac_tuned()
{
  Peer_setting s = open3d_ransac_documented();
  s.orients_normals = true;
  s.voxel = 0.01;
  s.feature_radius = 8;
  return s;
}

inline Peer_setting open3d_fgr_tuned()
{
  Peer_setting s = open3d_fgr_documented();
  s.orients_normals = true;
  s.voxel = 0.01;
  return s;
}

// The fastest one that still has nine of ten answers right where the overlap is 0.3 or more, at the cost of the others.
inline Peer_setting open3d_fgr_tuned_for_speed()
{
  Peer_setting s = open3d_fgr_documented();
  s.orients_normals = true;
  s.voxel = 0.02;
  s.feature_radius = 8;
  return s;
}

Peer_answer register_by_open3d_ransac(const Peer_scan& source, const Peer_scan& target, const Peer_setting& setting);
Peer_answer register_by_open3d_fgr(const Peer_scan& source, const Peer_scan& target, const Peer_setting& setting);

} // namespace benchmark_tools

#endif // CGAL_CRUDE_REGISTRATION_BENCHMARK_PEERS_OPEN3D_H
