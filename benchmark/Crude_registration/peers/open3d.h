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

inline Peer_setting open3d_ransac_tuned()
{
  Peer_setting s = open3d_ransac_documented();
  s.orients_normals = true;
  return s;
}

inline Peer_setting open3d_fgr_tuned()
{
  Peer_setting s = open3d_fgr_documented();
  s.orients_normals = true;
  return s;
}

Peer_answer register_by_open3d_ransac(const Peer_scan& source, const Peer_scan& target, const Peer_setting& setting);
Peer_answer register_by_open3d_fgr(const Peer_scan& source, const Peer_scan& target, const Peer_setting& setting);

} // namespace benchmark_tools

#endif // CGAL_CRUDE_REGISTRATION_BENCHMARK_PEERS_OPEN3D_H
