// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_BENCHMARK_PEERS_SPIN_IMAGES_H
#define CGAL_CRUDE_REGISTRATION_BENCHMARK_PEERS_SPIN_IMAGES_H

// Registration by PCL's spin images (A. E. Johnson, M. Hebert, IEEE Transactions on Pattern Analysis and Machine
// Intelligence 21, 1999), whose correspondences its prerejective RANSAC searches.

#include "Peer.h"

namespace benchmark_tools {

inline Peer_setting spin_image_setting()
{
  Peer_setting s;
  s.orients_normals = true;
  s.feature_radius = 8; // an image of 8 bins, each as wide as a voxel
  s.distance = 1.5;
  s.iterations = 50000;
  s.edge_similarity = 0.9;
  s.inlier_fraction = 0.25;
  return s;
}

Peer_answer register_by_spin_images(const Peer_scan& source, const Peer_scan& target, const Peer_setting& setting);

} // namespace benchmark_tools

#endif // CGAL_CRUDE_REGISTRATION_BENCHMARK_PEERS_SPIN_IMAGES_H
