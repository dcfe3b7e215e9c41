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

#include "result_tools.h"

#include <CGAL/Crude_registration/IO/read_range_image.h>
#include <CGAL/Crude_registration/matching/Trihedron_candidates.h>
#include <CGAL/Crude_registration/motion/refine_motion.h>
#include <CGAL/Crude_registration/reduction/approximation_error.h>
#include <CGAL/Crude_registration/reduction/simplify_scan.h>
#include <CGAL/Crude_registration/register_scans.h>
#include <CGAL/Crude_registration/sampling/triangulate_range_image.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#endif

#include <chrono>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace bunny {

namespace CR = CGAL::Crude_registration;
using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Transformation = CGAL::Aff_transformation_3<Kernel>;

struct Dense_scan
{
  std::string name;
  CR::Range_image<Kernel> image;
  Mesh mesh;
};

inline Dense_scan read_scan(const std::string& folder, const std::string& name)
{
  Dense_scan scan;
  scan.name = name;
  CR::read_range_image(folder + "/" + name, scan.image);
  CR::triangulate_range_image(scan.image, scan.mesh);
  return scan;
}

// A scan prepared for the paper's method.
struct Prepared_scan
{
  CR::Scan<Kernel> scan;
  std::size_t vertices; // of its simplified mesh, the S- or D-mesh
};

// `stop`: the approximation error or the number of vertices that the mesh is simplified to.
template <class NamedParameters>
Prepared_scan prepare(const Dense_scan& dense, const NamedParameters& stop)
{
  Mesh mesh = dense.mesh;
  const std::size_t vertices = CR::simplify_scan(mesh, stop);
  return {CR::Scan<Kernel>(dense.image, stop.candidates(CR::Trihedron_candidates()), dense.name), vertices};
}

// The published pose of a scan, from the lines "bmesh FILE tx ty tz qx qy qz qw" of bun.conf: it maps p to R(q)^T p +
// t.
inline Transformation published_pose(const std::string& folder, const std::string& name)
{
  const std::string file = folder + "/bun.conf";
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file + ": the file cannot be read");
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string key, scan;
    double tx, ty, tz, qx, qy, qz, qw;
    if (!(words >> key >> scan >> tx >> ty >> tz >> qx >> qy >> qz >> qw) || key != "bmesh" || scan != name) continue;
    return benchmark_tools::to_motion<Kernel>(Eigen::Quaterniond(qw, -qx, -qy, -qz).normalized().toRotationMatrix(),
                                              Eigen::Vector3d(tx, ty, tz));
  }
  throw std::runtime_error(file + ": no pose of " + name);
}

constexpr double degrees = 180 / CGAL_PI;

// The part of a rotation that is about the y axis (the turn table's), without its sign, in degrees.
inline double turn_about_y(const Transformation& motion)
{
  const Eigen::Quaterniond q(benchmark_tools::rotation(motion));
  return degrees * 2 * std::atan2(std::abs(q.y()), std::abs(q.w()));
}

struct Error
{
  double rotation = 0;    // the angle of the rotation left over, degrees
  double turn = 0;        // difference of the turns about y, degrees: what the paper counts
  double translation = 0; // length of the difference of the translation vectors

  Error() = default;
  Error(const Transformation& found, const Transformation& wanted)
      : rotation(benchmark_tools::degrees_between(found, wanted)),
        turn(std::abs(turn_about_y(found) - turn_about_y(wanted))),
        translation((benchmark_tools::translation(found) - benchmark_tools::translation(wanted)).norm())
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
  CR::Registration_result<Kernel> result;
  double seconds = 0;            // of register_scans()
  Transformation truth, refined; // the latter: the crude motion, refined on the dense meshes
  Error crude_error, result_error, refined_error;
  std::size_t iterations = 0;

  const Transformation& crude() const { return result.crude_transformation(); }
  double search_seconds() const { return benchmark_tools::stage(result, "propose").seconds; }
  std::size_t passes() const { return benchmark_tools::stage(result, "propose").count; }
  std::size_t trihedra() const { return benchmark_tools::stage(result, "propose: trihedra").count; }
  std::size_t candidates() const { return benchmark_tools::stage(result, "propose: matches").count; }
};

template <class ConcurrencyTag>
Registration register_pair(const Dense_scan& source, const Prepared_scan& s, const Dense_scan& target,
                           const Prepared_scan& d, const std::string& folder, const Options& options)
{
  Registration r;
  r.s_vertices = s.vertices;
  r.d_vertices = d.vertices;
  const auto start = std::chrono::steady_clock::now();
  r.result = CR::register_scans<ConcurrencyTag>(s.scan, d.scan,
                                                CR::parameters::candidates(CR::Trihedron_candidates())
                                                    .minimum_extent(options.minimum_extent)
                                                    .maximum_extent(options.maximum_extent)
                                                    .use_normals(options.use_normals));
  r.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (r.result.status() == CR::NOT_REGISTERED)
    throw std::runtime_error(source.name + " and " + target.name + ": " + r.result.reason());
  const auto fine = CR::refine_motion<ConcurrencyTag>(source.mesh, target.mesh, r.crude());
  r.refined = fine.motion;
  r.iterations = fine.iterations;
  r.truth = published_pose(folder, target.name).inverse() * published_pose(folder, source.name);
  r.crude_error = Error(r.crude(), r.truth);
  r.result_error = Error(r.result.transformation(), r.truth);
  r.refined_error = Error(r.refined, r.truth);
  return r;
}

inline Registration register_pair(const Dense_scan& source, const Prepared_scan& s, const Dense_scan& target,
                                  const Prepared_scan& d, const std::string& folder, const Options& options)
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
