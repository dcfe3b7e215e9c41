// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "spin_images.h"

#include "pcl_points.h"
#include "pcl_registration.h"

#include <pcl/common/io.h>
#include <pcl/features/spin_image.h>
// PCL's library does not have these templates for points with normals and for spin images.
#include <pcl/features/impl/spin_image.hpp>
#include <pcl/kdtree/impl/kdtree_flann.hpp>
#include <pcl/registration/impl/sample_consensus_prerejective.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>

// All bins are compared: of what PCL does not know it would compare the first three.
namespace pcl {
template <>
class DefaultPointRepresentation<Histogram<153>> : public PointRepresentation<Histogram<153>>
{
public:
  DefaultPointRepresentation() { nr_dimensions_ = Histogram<153>::descriptorSize(); }
  void copyToFloatArray(const Histogram<153>& image, float* out) const override
  {
    std::copy(image.histogram, image.histogram + nr_dimensions_, out);
  }
};
} // namespace pcl

namespace benchmark_tools {

namespace {

using Spin_image = pcl::Histogram<153>; // 9 x 17: of 8 bins to the side and 8 up and down

// One of the points of each voxel.
pcl::IndicesPtr chosen(const Pcl_points& points, double voxel)
{
  pcl::IndicesPtr indices(new pcl::Indices);
  std::set<std::array<int, 3>> taken;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const pcl::PointNormal& p = points[i];
    if (!std::isfinite(p.normal_x)) continue;
    const auto cell = [&](float x) { return int(std::floor(double(x) / voxel)); };
    if (taken.insert({cell(p.x), cell(p.y), cell(p.z)}).second) indices->push_back(int(i));
  }
  return indices;
}

// Images of some points, made of many more.
struct Described
{
  using Feature = Spin_image;

  Pcl_points::Ptr points{new Pcl_points};
  pcl::PointCloud<Spin_image>::Ptr features{new pcl::PointCloud<Spin_image>};

  Described(const Pcl_points::ConstPtr& all, const Peer_scan& scan, double voxel, Peer_setting setting)
  {
    constexpr double finer = 3;
    setting.normal_radius *= finer;
    const Pcl_points::Ptr surface = thinned_with_normals(all, scan, voxel / finer, setting);
    const pcl::IndicesPtr indices = chosen(*surface, voxel);
    constexpr unsigned width = 8;
    constexpr double support_cosine = 0.5; // 60 degrees, as Johnson has it
    pcl::SpinImageEstimation<pcl::PointNormal, pcl::PointNormal, Spin_image> estimation(width, support_cosine, 0);
    estimation.setRadiusSearch(setting.feature_radius * voxel);
    estimation.setInputCloud(surface);
    estimation.setInputNormals(surface);
    estimation.setIndices(indices);
    estimation.compute(*features);
    pcl::copyPointCloud(*surface, *indices, *points);
  }
};

} // namespace

Peer_answer register_by_spin_images(const Peer_scan& source, const Peer_scan& target, const Peer_setting& setting)
{
  return register_by_features<Described>(source, target, setting);
}

} // namespace benchmark_tools
