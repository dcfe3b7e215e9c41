// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_BENCHMARK_BUNNY_PAIRS_H
#define CGAL_CRUDE_REGISTRATION_BENCHMARK_BUNNY_PAIRS_H

// What tables 2 and 3 have in common: pairs of the Stanford bunny's scans registered by the paper's method, and how far
// that is from the published poses.

#include <CGAL/Crude_registration/IO/read_range_image.h>
#include <CGAL/Crude_registration/reduction/approximation_error.h>
#include <CGAL/Crude_registration/internal/reduction/Reduced_scan.h>
#include <CGAL/Crude_registration/internal/matching/Trihedron_search.h>
#include <CGAL/Crude_registration/motion/refine_motion.h>
#include <CGAL/Crude_registration/reduction/simplify_scan.h>
#include <CGAL/Crude_registration/sampling/triangulate_range_image.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <Eigen/Geometry>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace bunny {

namespace CR = CGAL::Crude_registration;
using CR::internal::Rigid_motion;
using CR::internal::Vector;
using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

// A scan as far as it is prepared once.
struct Dense_scan
{
  std::string name;
  Mesh mesh;
  CR::internal::Flat_mesh flat;
  std::vector<Vector> normals;
  CR::internal::Reduced_scan prepared;
  double approximation_error = 0;
  double extent = 0; // M
};

inline Dense_scan read_scan(const std::string& folder, const std::string& name)
{
  Dense_scan scan;
  scan.name = name;
  CR::Range_image<Kernel> image;
  CR::read_range_image(folder + "/" + name, image);
  CR::triangulate_range_image(image, scan.mesh);
  scan.approximation_error = CR::approximation_error(image);
  scan.extent = CR::scan_extent(image).mean();
  scan.flat = CR::internal::to_flat_mesh(scan.mesh, CR::parameters::default_values(), "read_scan", "mesh");
  scan.normals = CR::internal::vertex_normals(scan.flat);
  scan.prepared = CR::internal::reduce_scan(scan.flat, CR::internal::to_flat_sensor(image.sensor()));
  return scan;
}

// The S- or D-mesh: by the paper's approximation error, or to a number of vertices.
template <class NamedParameters>
CR::internal::Simplified_scan simplify(const Dense_scan& scan, const NamedParameters& stop)
{
  Mesh mesh = scan.mesh;
  CR::simplify_scan(mesh, stop);
  mesh.collect_garbage();
  CR::internal::Simplified_scan result = CR::internal::simplified_scan(
      scan.prepared, CR::internal::to_flat_mesh(mesh, CR::parameters::default_values(), "simplify", "mesh"), scan.flat,
      scan.normals);
  result.extent = scan.extent;
  return result;
}

// The published pose of a scan, from the lines "bmesh FILE tx ty tz qx qy qz qw" of bun.conf: it maps p to R(q)^T p +
// t.
inline Rigid_motion published_pose(const std::string& folder, const std::string& name)
{
  const std::string file = folder + "/bun.conf";
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file + ": the file cannot be read");
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string key, scan;
    double tx, ty, tz, qx, qy, qz, qw;
    if (!(words >> key >> scan >> tx >> ty >> tz >> qx >> qy >> qz >> qw) || key != "bmesh" || scan != name) continue;
    Rigid_motion pose;
    pose.rotation = Eigen::Quaterniond(qw, -qx, -qy, -qz).normalized().toRotationMatrix();
    pose.translation = Vector(tx, ty, tz);
    return pose;
  }
  throw std::runtime_error(file + ": no pose of " + name);
}

constexpr double degrees = 180 / 3.14159265358979323846;

// The part of a rotation that is about the y axis (the turn table's), without its sign, in degrees.
inline double turn_about_y(const CR::internal::Matrix& rotation)
{
  const Eigen::Quaterniond q(rotation);
  return degrees * 2 * std::atan2(std::abs(q.y()), std::abs(q.w()));
}

struct Error
{
  double rotation = 0;    // the angle of the rotation left over, degrees
  double turn = 0;        // difference of the turns about y, degrees: what the paper counts
  double translation = 0; // length of the difference of the translation vectors

  Error() = default;
  Error(const Rigid_motion& found, const Rigid_motion& wanted)
      : rotation(degrees * Eigen::AngleAxisd(found.rotation * wanted.rotation.transpose()).angle()),
        turn(std::abs(turn_about_y(found.rotation) - turn_about_y(wanted.rotation))),
        translation((found.translation - wanted.translation).norm())
  {}
};

struct Options
{
  double minimum_extent = 0, maximum_extent = 0.3;
  bool use_normals = true;
  int threads = 1;
};

struct Registration
{
  std::size_t s_vertices = 0, d_vertices = 0;
  CR::internal::Trihedron_search_result search;
  Rigid_motion truth, trihedron, crude, refined; // in the frames of the files
  Error trihedron_error, crude_error, refined_error;
  std::size_t iterations = 0;
};

template <class ConcurrencyTag>
Registration register_pair(const Dense_scan& source, const CR::internal::Simplified_scan& s, const Dense_scan& target,
                           const CR::internal::Simplified_scan& d, const std::string& folder, const Options& options)
{
  CR::internal::Trihedron_search_parameters parameters;
  parameters.minimum_extent = options.minimum_extent;
  parameters.maximum_extent = options.maximum_extent;
  parameters.use_normals = options.use_normals;

  Registration r;
  r.s_vertices = s.vertices.points.size();
  r.d_vertices = d.vertices.points.size();
  r.search = CR::internal::Trihedron_search<ConcurrencyTag>(source.prepared, s, target.prepared, d, parameters)();
  const auto in_frames_of_files = [&](const Rigid_motion& m) {
    return target.prepared.own_from_input.inverse() * m * source.prepared.own_from_input;
  };
  r.trihedron = in_frames_of_files(r.search.trihedron_motion);
  r.crude = in_frames_of_files(r.search.crude_motion);
  const auto fine =
      CR::refine_motion<ConcurrencyTag>(source.mesh, target.mesh, CR::internal::to_aff_transformation<Kernel>(r.crude));
  r.refined = CR::internal::to_rigid_motion(fine.motion);
  r.iterations = fine.iterations;
  r.truth = published_pose(folder, target.name).inverse() * published_pose(folder, source.name);
  r.trihedron_error = Error(r.trihedron, r.truth);
  r.crude_error = Error(r.crude, r.truth);
  r.refined_error = Error(r.refined, r.truth);
  return r;
}

inline Registration register_pair(const Dense_scan& source, const CR::internal::Simplified_scan& s,
                                  const Dense_scan& target, const CR::internal::Simplified_scan& d,
                                  const std::string& folder, const Options& options)
{
#ifdef CGAL_LINKED_WITH_TBB
  if (options.threads > 1) {
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, std::size_t(options.threads));
    return register_pair<CGAL::Parallel_tag>(source, s, target, d, folder, options);
  }
#endif
  return register_pair<CGAL::Sequential_tag>(source, s, target, d, folder, options);
}

} // namespace bunny

#endif // CGAL_CRUDE_REGISTRATION_BENCHMARK_BUNNY_PAIRS_H
