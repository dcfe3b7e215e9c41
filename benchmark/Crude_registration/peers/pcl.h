// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_BENCHMARK_PEERS_PCL_H
#define CGAL_CRUDE_REGISTRATION_BENCHMARK_PEERS_PCL_H

// The Point Cloud Library: fast point feature histograms, matched by SampleConsensusPrerejective.

#include "Peer.h"

namespace benchmark_tools {

// As in PCL's tutorial "Robust pose estimation of rigid objects", whose lengths are in leafs of its voxel grid. It does
// not set the viewpoint that normals are oriented to.
inline Peer_setting pcl_documented()
{
  Peer_setting s;
  s.distance = 2.5;
  s.iterations = 50000;
  s.edge_similarity = 0.95;
  s.inlier_fraction = 0.25;
  return s;
}

// Chosen as those of Open3D.
inline Peer_setting pcl_tuned()
{
  Peer_setting s = pcl_documented();
  s.orients_normals = true;
  s.edge_similarity = 0.9;
  return s;
}

Peer_answer register_by_pcl(const Peer_scan& source, const Peer_scan& target, const Peer_setting& setting);

} // namespace benchmark_tools

#endif // CGAL_CRUDE_REGISTRATION_BENCHMARK_PEERS_PCL_H
