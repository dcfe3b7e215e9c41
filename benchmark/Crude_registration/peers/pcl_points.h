// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_BENCHMARK_PEERS_PCL_POINTS_H
#define CGAL_CRUDE_REGISTRATION_BENCHMARK_PEERS_PCL_POINTS_H

// The samples of a scan as PCL has them, thinned and with normals.

#include "Peer.h"

#include <pcl/features/normal_3d.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

namespace benchmark_tools {

using Pcl_points = pcl::PointCloud<pcl::PointNormal>;

inline Pcl_points::Ptr to_pcl_points(const Peer_scan& scan)
{
  Pcl_points::Ptr points(new Pcl_points);
  points->reserve(scan.points.size());
  for (const Eigen::Vector3d& p : scan.points) {
    pcl::PointNormal q;
    q.x = float(p.x());
    q.y = float(p.y());
    q.z = float(p.z());
    points->push_back(q);
  }
  return points;
}

// One point a voxel.
inline Pcl_points::Ptr thinned_with_normals(const Pcl_points::ConstPtr& all, const Peer_scan& scan, double voxel,
                                            const Peer_setting& setting)
{
  Pcl_points::Ptr points(new Pcl_points);
  pcl::VoxelGrid<pcl::PointNormal> grid;
  const auto leaf = float(voxel);
  grid.setLeafSize(leaf, leaf, leaf);
  grid.setInputCloud(all);
  grid.filter(*points);
  pcl::NormalEstimation<pcl::PointNormal, pcl::PointNormal> normals;
  normals.setRadiusSearch(setting.normal_radius * voxel);
  normals.setInputCloud(points);
  normals.compute(*points);
  if (setting.orients_normals)
    for (auto& p : *points)
      if (scan.faces_away(p.getVector3fMap().cast<double>(), p.getNormalVector3fMap().cast<double>()))
        p.getNormalVector3fMap() *= -1;
  return points;
}

} // namespace benchmark_tools

#endif // CGAL_CRUDE_REGISTRATION_BENCHMARK_PEERS_PCL_POINTS_H
