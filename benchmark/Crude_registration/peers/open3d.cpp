// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "open3d.h"

#include "../cpu_time.h"

#include <open3d/geometry/KDTreeSearchParam.h>
#include <open3d/geometry/PointCloud.h>
#include <open3d/pipelines/registration/CorrespondenceChecker.h>
#include <open3d/pipelines/registration/FastGlobalRegistration.h>
#include <open3d/pipelines/registration/Feature.h>
#include <open3d/pipelines/registration/Registration.h>
#include <open3d/utility/Random.h>

#include <functional>
#include <memory>
#include <vector>

namespace benchmark_tools {

namespace registration = open3d::pipelines::registration;
using open3d::geometry::PointCloud;

namespace {

struct Described
{
  std::shared_ptr<PointCloud> points;
  std::shared_ptr<registration::Feature> features;

  Described(const PointCloud& all, const Peer_scan& scan, double voxel, const Peer_setting& setting)
      : points(all.VoxelDownSample(voxel))
  {
    using open3d::geometry::KDTreeSearchParamHybrid;
    points->EstimateNormals(KDTreeSearchParamHybrid(setting.normal_radius * voxel, 30));
    if (setting.orients_normals)
      for (std::size_t i = 0; i < points->points_.size(); ++i)
        if (scan.faces_away(points->points_[i], points->normals_[i])) points->normals_[i] *= -1;
    features = registration::ComputeFPFHFeature(*points, KDTreeSearchParamHybrid(setting.feature_radius * voxel, 100));
  }
};

// match(source, target, voxel) of the described scans
template <class Match>
Peer_answer describe_and_match(const Peer_scan& source, const Peer_scan& target, const Peer_setting& setting,
                               const Match& match)
{
  open3d::utility::random::Seed(1);
  const PointCloud source_points(source.points), target_points(target.points);

  Peer_answer answer;
  const double start = cpu_seconds();
  const double voxel = setting.voxel * 0.5 * (source.diagonal + target.diagonal);
  const registration::RegistrationResult result =
      match(Described(source_points, source, voxel, setting), Described(target_points, target, voxel, setting), voxel);
  answer.seconds = cpu_seconds() - start;
  answer.is_found = !result.transformation_.isIdentity(0);
  answer.set_motion(result.transformation_);
  return answer;
}

} // namespace

Peer_answer register_by_open3d_ransac(const Peer_scan& source, const Peer_scan& target, const Peer_setting& setting)
{
  return describe_and_match(source, target, setting, [&](const Described& a, const Described& b, double voxel) {
    const double distance = setting.distance * voxel;
    const registration::CorrespondenceCheckerBasedOnEdgeLength edges(setting.edge_similarity);
    const registration::CorrespondenceCheckerBasedOnDistance distances(distance);
    const std::vector<std::reference_wrapper<const registration::CorrespondenceChecker>> checkers = {edges, distances};
    return registration::RegistrationRANSACBasedOnFeatureMatching(
        *a.points, *b.points, *a.features, *b.features, setting.is_mutual, distance,
        registration::TransformationEstimationPointToPoint(false), 3, checkers,
        registration::RANSACConvergenceCriteria(setting.iterations, setting.confidence));
  });
}

Peer_answer register_by_open3d_fgr(const Peer_scan& source, const Peer_scan& target, const Peer_setting& setting)
{
  return describe_and_match(source, target, setting, [&](const Described& a, const Described& b, double voxel) {
    registration::FastGlobalRegistrationOption option;
    option.maximum_correspondence_distance_ = setting.distance * voxel;
    return registration::FastGlobalRegistrationBasedOnFeatureMatching(*a.points, *b.points, *a.features, *b.features,
                                                                      option);
  });
}

} // namespace benchmark_tools
