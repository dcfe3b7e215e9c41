// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_BENCHMARK_PEERS_PCL_REGISTRATION_H
#define CGAL_CRUDE_REGISTRATION_BENCHMARK_PEERS_PCL_REGISTRATION_H

// PCL's RANSAC with prerejection, by whichever features describe the points.

#include "../cpu_time.h"
#include "Peer.h"
#include "pcl_points.h"

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/registration/sample_consensus_prerejective.h>

#include <cstdlib>

namespace benchmark_tools {

// `Described`: made of the points of a scan, the scan, the width of a voxel and the setting; has `points`, and of each
// one of the `features`, which are of type `Described::Feature`.
template <class Described>
Peer_answer register_by_features(const Peer_scan& source, const Peer_scan& target, const Peer_setting& setting)
{
  std::srand(1);
  const Pcl_points::Ptr source_points = to_pcl_points(source), target_points = to_pcl_points(target);

  Peer_answer answer;
  const double start = cpu_seconds();
  const double voxel = setting.voxel * 0.5 * (source.diagonal + target.diagonal);
  const Described a(source_points, source, voxel, setting), b(target_points, target, voxel, setting);
  pcl::SampleConsensusPrerejective<pcl::PointNormal, pcl::PointNormal, typename Described::Feature> align;
  align.setInputSource(a.points);
  align.setSourceFeatures(a.features);
  align.setInputTarget(b.points);
  align.setTargetFeatures(b.features);
  align.setMaximumIterations(setting.iterations);
  align.setNumberOfSamples(3);
  align.setCorrespondenceRandomness(5);
  align.setSimilarityThreshold(float(setting.edge_similarity));
  align.setMaxCorrespondenceDistance(setting.distance * voxel);
  align.setInlierFraction(float(setting.inlier_fraction));
  pcl::PointCloud<pcl::PointNormal> aligned;
  align.align(aligned);
  answer.seconds = cpu_seconds() - start;
  answer.is_found = align.hasConverged();
  answer.set_motion(align.getFinalTransformation());
  return answer;
}

} // namespace benchmark_tools

#endif // CGAL_CRUDE_REGISTRATION_BENCHMARK_PEERS_PCL_REGISTRATION_H
