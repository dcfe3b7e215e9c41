// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// The stages of a registration of two generated scans, as numbers that a program can draw: the manual's figures are
// made of them (doc/Crude_registration/make_figures.py).

#include "../benchmark/Crude_registration/command_line.h"

#include <CGAL/Crude_registration/IO/write_file.h>
#include <CGAL/Crude_registration/internal/judgement/Pose_judge.h>
#include <CGAL/Crude_registration/matching/match_trihedra.h>
#include <CGAL/Crude_registration/matching/Oriented_pair_candidates.h>
#include <CGAL/Crude_registration/matching/spatial_trihedra.h>
#include <CGAL/Crude_registration/reduction/approximation_error.h>
#include <CGAL/Crude_registration/reduction/simplify_scan.h>
#include <CGAL/Crude_registration/reduction/surface_types.h>
#include <CGAL/Crude_registration/register_scans.h>
#include <CGAL/Crude_registration/sampling/triangulate_range_image.h>
#include <CGAL/Crude_registration/simulation/make_statue.h>
#include <CGAL/Crude_registration/simulation/simulate_range_image.h>

#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <boost/program_options.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <iomanip>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <optional>
#include <vector>

namespace CR = CGAL::Crude_registration;
namespace CRI = CR::internal;
namespace po = boost::program_options;

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Transformation = CGAL::Aff_transformation_3<Kernel>;
using View = CR::Simulated_range_image<Kernel>;

namespace {

struct Options
{
  std::string output;
  unsigned seed = 9;
  std::size_t samples = 200; // columns, and rows
  double degrees = 90;
  bool are_scans_only = false;
};

template <class Range, class Function>
void write_list(std::ostream& out, const Range& range, const Function& write)
{
  out << '[';
  const char* separator = "";
  for (const auto& item : range) {
    out << separator;
    write(item);
    separator = ",";
  }
  out << ']';
}

void write_point(std::ostream& out, const Kernel::Point_3& p)
{
  out << '[' << p.x() << ',' << p.y() << ',' << p.z() << ']';
}

void write_points(std::ostream& out, const std::vector<Kernel::Point_3>& points)
{
  write_list(out, points, [&](const auto& p) { write_point(out, p); });
}

void write_motion(std::ostream& out, const Transformation& m)
{
  out << '[';
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j) out << (i + j > 0 ? "," : "") << m.m(i, j);
  out << ']';
}

void write_mesh(std::ostream& out, const Mesh& mesh)
{
  out << "{\"points\":";
  write_list(out, mesh.vertices(), [&](auto v) { write_point(out, mesh.point(v)); });
  out << ",\"faces\":";
  write_list(out, mesh.faces(), [&](auto f) {
    write_list(out, mesh.vertices_around_face(mesh.halfedge(f)), [&](auto v) { out << std::size_t(v); });
  });
  out << '}';
}

struct Stages
{
  CR::Range_image<Kernel> image;
  Mesh dense, simple;
  std::vector<CR::Surface_type> types; // of the dense vertices

  explicit Stages(const CR::Range_image<Kernel>& image_of_scan) : image(image_of_scan)
  {
    CR::triangulate_range_image(image, dense);
    auto map = dense.add_property_map<Mesh::Vertex_index, CR::Surface_type>("v:type").first;
    CR::surface_types(dense, map);
    for (const auto v : dense.vertices()) types.push_back(map[v]);
    add_flat(dense, simple);
    CR::simplify_scan(simple, CR::parameters::approximation_error(CR::approximation_error(image)));
    simple.collect_garbage();
  }

  void write(std::ostream& out) const
  {
    out << "{\"samples\":";
    write_points(out, image.points());
    out << ",\"dense\":";
    write_mesh(out, dense);
    out << ",\"types\":";
    write_list(out, types, [&](CR::Surface_type t) { out << int(t); });
    out << ",\"simple\":";
    write_mesh(out, simple);
    out << '}';
  }

private:
  static void add_flat(const Mesh& from, Mesh& to)
  {
    for (const auto v : from.vertices()) to.add_vertex(from.point(v));
    for (const auto f : from.faces()) {
      std::vector<Mesh::Vertex_index> corners;
      for (const auto v : from.vertices_around_face(from.halfedge(f))) corners.push_back(v);
      to.add_face(corners);
    }
  }
};

// The match of a trihedron that is nearest to the truth, the trihedron being of those with the longest arms.
void write_match(std::ostream& out, const Stages& source, const Stages& target, const Transformation& truth)
{
  const auto sensor = CR::parameters::viewing_direction(Kernel::Vector_3(0, 0, -1));
  const auto matches = CR::match_trihedra(source.simple, target.simple, sensor.maximum_extent(0.45), sensor);
  const CR::Trihedron_match<Mesh::Vertex_index, Mesh::Vertex_index, Kernel>* best = nullptr;
  double least = 0;
  for (const auto& m : matches) {
    double cost = 0, arms = 0;
    for (int i = 0; i < 4; ++i) {
      const Kernel::Point_3 p = source.simple.point(i == 0 ? m.source.origin : m.source.ends[std::size_t(i - 1)]);
      const Kernel::Point_3 q = target.simple.point(i == 0 ? m.target.origin : m.target.ends[std::size_t(i - 1)]);
      cost += CGAL::squared_distance(p.transform(truth), q);
      arms += CGAL::squared_distance(p, source.simple.point(m.source.origin));
    }
    cost /= arms;
    if (best == nullptr || cost < least) {
      best = &m;
      least = cost;
    }
  }
  if (best == nullptr) throw std::runtime_error("no trihedron has a match");
  const auto write = [&](const Mesh& mesh, const auto& t) {
    write_points(out, {mesh.point(t.origin), mesh.point(t.ends[0]), mesh.point(t.ends[1]), mesh.point(t.ends[2])});
  };
  out << "{\"number\":" << matches.size() << ",\"source\":";
  write(source.simple, best->source);
  out << ",\"target\":";
  write(target.simple, best->target);
  out << '}';
}

// What the judge sees of the source's surfels under a motion: 0 agrees, 1 disagrees, 2 in free space, 3 missing, -1
// unknown.
void write_judged(std::ostream& out, const CR::Scan<Kernel>& source, const CR::Scan<Kernel>& target,
                  const CRI::Judged_pose& judged, const CRI::Pose& pose)
{
  const CRI::Reduced_scan &s = source.reduced(), &t = target.reduced();
  const float free_depth = float(CR::Judgement_limits::free_space_depth * (std::max)(s.spacing, t.spacing));
  std::vector<std::uint8_t> outcomes(s.fine.surfels.size());
  CRI::probe_outcomes(CRI::Probes(s.fine.surfels), t, pose, CRI::probe_tolerance(s.fine, t.fine, free_depth),
                      outcomes.data());
  out << "{\"probability\":" << judged.probability << ",\"motion\":";
  write_motion(out, CRI::to_aff_transformation<Kernel>(t.own_from_input.inverse() * CRI::to_rigid_motion(pose) *
                                                       s.own_from_input));
  std::vector<Kernel::Point_3> points;
  const CRI::Rigid_motion input = t.own_from_input.inverse() * CRI::to_rigid_motion(pose);
  for (const CRI::Surfel& surfel : s.fine.surfels) {
    const CRI::Vector p = input(surfel.position.cast<double>());
    points.emplace_back(p.x(), p.y(), p.z());
  }
  out << ",\"points\":";
  write_points(out, points);
  out << ",\"outcomes\":";
  write_list(out, outcomes, [&](std::uint8_t o) { out << (o == CRI::Outcome::UNKNOWN ? -1 : CRI::Outcome::kind(o)); });
  out << '}';
}

// The probes that agree under a pose.
std::ptrdiff_t number_that_agree(const CRI::Pose_judge& judge, const CRI::Pose& pose)
{
  const std::vector<std::uint8_t> outcomes = judge.outcomes(pose);
  return std::count_if(outcomes.begin(), outcomes.end(),
                       [](std::uint8_t o) { return o != CRI::Outcome::UNKNOWN && CRI::Outcome::kind(o) == 0; });
}

// All rounds are made, though the first one may be enough: what agrees most of all that they have tried elsewhere is
// the rival.
void write_candidates(std::ostream& out, const CR::Scan<Kernel>& source, const CR::Scan<Kernel>& target)
{
  const CRI::Reduced_scan &s = source.reduced(), &t = target.reduced();
  const auto candidates = CR::Oriented_pair_candidates().candidates(s, t, CRI::Execution::SEQUENTIAL);
  CRI::Pose_judge judge(s, t, CRI::Execution::SEQUENTIAL, CRI::to_the_end());
  std::size_t tried = 0;
  while (std::optional<CRI::Proposals> proposals = candidates->next(CRI::to_the_end())) {
    tried += proposals->tried.size();
    judge.add_round(std::move(*proposals));
  }
  std::vector<CRI::Judged_pose> poses = judge.distinct_poses();
  if (poses.empty()) throw std::runtime_error("nothing is proposed");
  const CRI::Judged_pose best = poses.front();
  std::vector<CRI::Judged_pose> both = {best};
  std::ptrdiff_t most = -1;
  for (const CRI::Pose& pose : judge.candidates()) {
    const std::ptrdiff_t number = judge.are_same(pose, best.pose) ? -1 : number_that_agree(judge, pose);
    if (number <= most) continue;
    most = number;
    both.resize(1);
    both.push_back(judge.weighed(pose));
  }
  if (both.size() == 1) throw std::runtime_error("there is no rival");
  judge.share_probability(both, CRI::Judged_by::PAIR);
  out << "{\"tried\":" << tried << ",\"distinct\":" << judge.candidates().size() << ",\"rival\":";
  write_judged(out, source, target, both[1], both[1].pose);
  out << ",\"proposed\":";
  write_judged(out, source, target, best, best.proposed);
  out << ",\"refined\":";
  write_judged(out, source, target, best, best.pose);
  out << '}';
}

int run(const Options& options)
{
  if (options.output.empty()) throw std::invalid_argument("--output has to be given");
  Mesh body;
  CR::make_statue(body, 128, CR::parameters::random_seed(options.seed));
  const CR::Simulated_scene scene(body);
  const CGAL::Bbox_3 box = CGAL::Polygon_mesh_processing::bbox(body);
  std::vector<View> views;
  for (std::size_t i = 0; i < 2; ++i) {
    const double angle = double(i) * options.degrees * CGAL_PI / 180;
    auto camera = CR::Range_camera<Kernel>::framing(box, Kernel::Vector_3(std::cos(angle), std::sin(angle), -0.2),
                                                    options.samples);
    camera.noise = 0.1;
    camera.seed = options.seed + i;
    views.push_back(scene.range_image(camera));
  }
  const Transformation truth = views[1].scene_from_scan.inverse() * views[0].scene_from_scan;
  const Stages source(views[0].image), target(views[1].image);
  CR::write_file(options.output, [&](std::ostream& out) {
    out << std::setprecision(5) << "{\"source\":";
    source.write(out);
    out << ",\"target\":";
    target.write(out);
    if (!options.are_scans_only) {
      const CR::Scan<Kernel> s(source.image), t(target.image);
      const auto result = CR::register_scans(s, t);
      out << ",\"match\":";
      write_match(out, source, target, truth);
      out << ",\"candidates\":";
      write_candidates(out, s, t);
      out << ",\"confidence\":" << result.confidence() << ",\"motion\":";
      write_motion(out, result.transformation());
    }
    out << "}\n";
  });
  return EXIT_SUCCESS;
}

} // namespace

int main(int argc, char* argv[])
{
  try {
    Options options;
    po::options_description description("Usage: method_stages --output FILE.json [OPTION...]\n\n"
                                        "Writes the stages of a registration of two generated scans.\n\nOptions");
    description.add_options()("help,h", "print this");
    description.add_options()("output", po::value(&options.output), "JSON file to write");
    description.add_options()("seed", po::value(&options.seed)->default_value(options.seed), "which body");
    description.add_options()("samples", po::value(&options.samples)->default_value(options.samples),
                              "columns, and rows, of the grid");
    description.add_options()("degrees", po::value(&options.degrees)->default_value(options.degrees),
                              "from the one viewpoint to the other");
    description.add_options()("scans-only", po::bool_switch(&options.are_scans_only), "write the scans, and no match");
    po::variables_map values;
    if (!benchmark_tools::read_options(argc, argv, description, values)) return EXIT_SUCCESS;
    return run(options);
  } catch (const std::exception& e) {
    std::cerr << "method_stages: " << e.what() << '\n';
  } catch (const CRI::Run_control::Stopped&) { // nothing here stops a run
    std::cerr << "method_stages: stopped\n";
  }
  return EXIT_FAILURE;
}
