// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "pcl.h"

#include "pcl_points.h"
#include "pcl_registration.h"

#include <pcl/features/fpfh.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>

namespace benchmark_tools {

namespace {

struct Described
{
  using Feature = pcl::FPFHSignature33;

  Pcl_points::Ptr points{new Pcl_points};
  pcl::PointCloud<pcl::FPFHSignature33>::Ptr features{new pcl::PointCloud<pcl::FPFHSignature33>};

  Described(const Pcl_points::ConstPtr& all, const Peer_scan& scan, double voxel, const Peer_setting& setting)
  {
    *points = *thinned_with_normals(all, scan, voxel, setting);
    pcl::FPFHEstimation<pcl::PointNormal, pcl::PointNormal, pcl::FPFHSignature33> estimation;
    estimation.setRadiusSearch(setting.feature_radius * voxel);
    estimation.setInputCloud(points);
    estimation.setInputNormals(points);
    estimation.compute(*features);
  }
};

} // namespace

Peer_answer register_by_pcl(const Peer_scan& source, const Peer_scan& target, const Peer_setting& setting)
{
  return register_by_features<Described>(source, target, setting);
}

} // namespace benchmark_tools
