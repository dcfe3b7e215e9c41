// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// Registers single views of machined parts, as points, points with normals and meshes, with their models: of triangles
// as large as the faces, of small ones, of slivers, and as files have them that were never one surface. Counts the
// answers by whether the view determines the pose, which is judged by the truth, see rival_motions.h.

#include "../../calibration/package_random.h"
#include "command_line.h"
#include "machined_parts.h"
#include "moved_scan.h"
#include "result_tools.h"
#include "rival_motions.h"

#include <CGAL/Crude_registration/IO/write_file.h>
#include <CGAL/Crude_registration/register_scans.h>
#include <CGAL/Crude_registration/sampling/triangulate_range_image.h>
#include <CGAL/Crude_registration/simulation/simulate_range_image.h>

#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>

#include <boost/program_options.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <iomanip>
#include <iostream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace po = boost::program_options;
namespace PMP = CGAL::Polygon_mesh_processing;
using benchmark_tools::Kernel;
using benchmark_tools::Known_surface;
using benchmark_tools::Machined_part;
using benchmark_tools::Pose_of_view;
using benchmark_tools::Transformation;
using benchmark_tools::CR::Scan_file;
namespace CR = CGAL::Crude_registration;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using File = CR::Scan_file<Kernel>;

namespace {

const std::array<const char*, 3> input_names = {"points", "points with normals", "mesh"};
const std::array<const char*, 4> model_names = {"large triangles", "small triangles", "slivers", "loose pieces"};

struct Options
{
  std::size_t views = 2; // of each part
  double samples = 5000, noise = 0.1;
  std::string csv, part;
  bool foreign = false, rows = false;
};

// All pieces as one surface.
Mesh united(const Machined_part& part)
{
  Mesh mesh = Machined_part::solid(part.pieces.front());
  for (std::size_t i = 1; i < part.pieces.size(); ++i) {
    Mesh piece = Machined_part::solid(part.pieces[i]), both;
    if (!PMP::corefine_and_compute_union(mesh, piece, both))
      throw std::runtime_error(part.name + ": the pieces have no common surface");
    mesh = std::move(both);
    mesh.collect_garbage();
  }
  return mesh;
}

using Triangle = std::array<Kernel::Point_3, 3>;

std::vector<Triangle> triangles(const Mesh& mesh)
{
  std::vector<Triangle> result;
  for (const auto f : mesh.faces()) {
    Triangle t;
    std::size_t k = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) t[k++] = mesh.point(v);
    result.push_back(t);
  }
  return result;
}

// Each triangle with corners of its own, or with common ones.
Mesh mesh_of(const std::vector<Triangle>& soup, bool is_joined)
{
  Mesh mesh;
  std::map<Kernel::Point_3, Mesh::Vertex_index> known;
  const auto vertex = [&](const Kernel::Point_3& p) {
    if (!is_joined) return mesh.add_vertex(p);
    const auto [at, is_new] = known.emplace(p, Mesh::Vertex_index());
    if (is_new) at->second = mesh.add_vertex(p);
    return at->second;
  };
  for (const Triangle& t : soup) {
    const auto a = vertex(t[0]), b = vertex(t[1]), c = vertex(t[2]);
    if (mesh.add_face(a, b, c) == Mesh::null_face())
      mesh.add_face(mesh.add_vertex(t[0]), mesh.add_vertex(t[1]), mesh.add_vertex(t[2]));
  }
  return mesh;
}

// Halved at their longest edge, until that is short; an edge is halved on both its sides.
std::vector<Triangle> small_triangles(std::vector<Triangle> open, double longest)
{
  std::vector<Triangle> done;
  while (!open.empty()) {
    Triangle t = open.back();
    open.pop_back();
    std::size_t k = 0;
    for (std::size_t i = 1; i < 3; ++i)
      if (CGAL::squared_distance(t[i], t[(i + 1) % 3]) > CGAL::squared_distance(t[k], t[(k + 1) % 3])) k = i;
    if (CGAL::squared_distance(t[k], t[(k + 1) % 3]) <= longest * longest) {
      done.push_back(t);
      continue;
    }
    const Kernel::Point_3 middle = CGAL::midpoint(t[k], t[(k + 1) % 3]);
    open.push_back({t[k], middle, t[(k + 2) % 3]});
    open.push_back({middle, t[(k + 1) % 3], t[(k + 2) % 3]});
  }
  return done;
}

// Each triangle four alike.
std::vector<Triangle> quartered(const std::vector<Triangle>& soup)
{
  std::vector<Triangle> result;
  for (const Triangle& t : soup) {
    const auto a = CGAL::midpoint(t[1], t[2]), b = CGAL::midpoint(t[2], t[0]), c = CGAL::midpoint(t[0], t[1]);
    for (const Triangle& q : {Triangle{t[0], c, b}, Triangle{c, t[1], a}, Triangle{b, a, t[2]}, Triangle{a, b, c}})
      result.push_back(q);
  }
  return result;
}

// The models, in the order of their names.
std::vector<Mesh> models_of(const Machined_part& part, const Mesh& whole, double spacing)
{
  const std::vector<Triangle> large = triangles(whole);
  std::vector<Triangle> loose;
  const std::vector<Triangle> pieces = triangles(part.assembly());
  // One of three is halved, and its neighbours not: corners on their edges.
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Triangle& t = pieces[i];
    if (i % 3 != 0) {
      loose.push_back(t);
      continue;
    }
    const auto middle = CGAL::midpoint(t[0], t[1]);
    loose.push_back({t[0], middle, t[2]});
    loose.push_back({middle, t[1], t[2]});
  }
  return {whole, mesh_of(small_triangles(large, 2 * spacing), true),
          mesh_of(quartered(quartered(quartered(large))), true), mesh_of(loose, false)};
}

File file_of(const Mesh& mesh)
{
  File file;
  file.kind = File::MESH;
  file.mesh = mesh;
  return file;
}

struct View
{
  std::array<File, 3> files;
  Pose_of_view truth; // model from view
  std::vector<Eigen::Vector3d> points;
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  double spacing = 0;
};

Pose_of_view to_pose(const Transformation& motion)
{
  return {benchmark_tools::rotation(motion), benchmark_tools::translation(motion)};
}

// From a direction drawn evenly from all.
View view_of(const CR::Simulated_scene& scene, const CGAL::Bbox_3& box, std::uint64_t seed, const Options& options)
{
  const benchmark_tools::Package_random random(seed);
  Kernel::Vector_3 direction(random.normal(0), random.normal(1), random.normal(2));
  auto camera = CR::Range_camera<Kernel>::framing(box, direction, 200, true);
  const auto sketch = scene.range_image(camera);
  const double scale = std::sqrt(double(sketch.image.points().size()) / options.samples);
  camera.spacing *= scale;
  camera.columns = camera.rows = std::size_t(std::ceil(200 / scale));
  camera.noise = options.noise;
  camera.drop_out = 0.01;
  camera.grazing_drop_out = 0.5;
  camera.seed = seed;
  const auto image = scene.range_image(camera);
  View view;
  view.spacing = camera.spacing;
  view.truth = to_pose(image.scene_from_scan);
  for (const auto& p : image.image.points()) view.points.emplace_back(p.x(), p.y(), p.z());
  for (const auto& p : view.points) view.centroid += p / double(view.points.size());
  Mesh mesh;
  CR::triangulate_range_image(image.image, mesh);
  auto& [points, with_normals, as_mesh] = view.files;
  points.kind = with_normals.kind = File::POINTS;
  points.points = image.image.points();
  for (const auto v : mesh.vertices()) {
    with_normals.points.push_back(mesh.point(v));
    with_normals.normals.push_back(PMP::compute_vertex_normal(v, mesh));
  }
  as_mesh = file_of(mesh);
  return view;
}

// What an answer is.
enum Outcome
{
  RIGHT,
  FIRST,
  LATER,
  LOST,
  NONE,
  WRONG,
  number_of_outcomes
};
const std::array<const char*, number_of_outcomes> outcome_names = {"right", "first", "later", "lost", "none", "wrong"};

struct Answer
{
  Outcome outcome;
  double confidence;
};

CR::Scan<Kernel> prepared(const File& file, const std::string& name, Transformation& moved_from_file)
{
  benchmark_tools::Moved_file moved = benchmark_tools::moved_file(file, name);
  moved_from_file = moved.moved_from_file;
  return CR::Scan<Kernel>(moved.file, CR::parameters::default_values(), name);
}

struct Prepared
{
  Transformation moved_from_file = Transformation(CGAL::IDENTITY);
  CR::Scan<Kernel> scan;

  Prepared(const File& file, const std::string& name) : scan(prepared(file, name, moved_from_file)) {}
};

Answer answer_of(const Prepared& source, const Prepared& target, const View& view, const Known_surface& surface)
{
  const auto result = CR::register_scans(source.scan, target.scan);
  const auto is_right = [&](const Transformation& found) {
    return surface.is_right(to_pose(target.moved_from_file.inverse() * found * source.moved_from_file), view.truth,
                            view.centroid);
  };
  const bool is_answer = result.status() != CR::NOT_REGISTERED;
  const bool right = is_answer && is_right(result.transformation());
  if (result.status() == CR::REGISTERED) return {right ? RIGHT : WRONG, result.confidence()};
  if (right) return {FIRST, result.confidence()};
  bool is_listed = false;
  for (const auto& r : result.runners_up()) is_listed = is_listed || is_right(r.transformation);
  return {is_listed ? LATER : is_answer ? LOST : NONE, result.confidence()};
}

// The counts of a kind of input and a kind of model.
using Counts = std::array<std::size_t, number_of_outcomes>;

void print(const std::string& title, const std::array<std::array<Counts, 4>, 3>& counts)
{
  std::cout << title << "\ninput                model             pairs";
  for (const char* name : outcome_names) std::cout << std::setw(7) << name;
  std::cout << '\n';
  for (std::size_t i = 0; i < counts.size(); ++i)
    for (std::size_t m = 0; m < counts[i].size(); ++m) {
      std::size_t sum = 0;
      for (const std::size_t n : counts[i][m]) sum += n;
      std::cout << std::left << std::setw(21) << input_names[i] << std::setw(16) << model_names[m] << std::right
                << std::setw(7) << sum;
      for (const std::size_t n : counts[i][m]) std::cout << std::setw(7) << n;
      std::cout << '\n';
    }
  std::cout << '\n';
}

int run(const Options& options)
{
  std::array<std::array<Counts, 4>, 3> determined = {}, others = {}, foreign = {};
  std::vector<Prepared> models_before;
  std::ostringstream csv;
  csv << "part,view,samples,symmetries,rival,rival_with_normals,input,model,outcome,confidence\n";
  std::uint64_t seed = 0;
  for (const Machined_part& part : benchmark_tools::machined_parts()) {
    const std::uint64_t first_seed = 1000 * ++seed;
    if (!options.part.empty() && part.name != options.part) continue;
    const Mesh whole = united(part);
    const Known_surface surface(whole);
    const CR::Simulated_scene scene(whole);
    std::vector<View> views;
    for (std::size_t v = 0; v < options.views; ++v)
      views.push_back(view_of(scene, PMP::bbox(whole), first_seed + v, options));
    std::vector<Prepared> models;
    const std::vector<Mesh> meshes = models_of(part, whole, views.front().spacing);
    for (std::size_t m = 0; m < meshes.size(); ++m) models.emplace_back(file_of(meshes[m]), part.name + model_names[m]);
    for (std::size_t v = 0; v < views.size(); ++v) {
      const View& view = views[v];
      // What noise leaves, and a little of what the nearest point of an edge adds.
      const double tolerance = (3 * options.noise + 0.3) * view.spacing;
      const auto rivals = surface.rivals(view.points, view.truth, tolerance);
      for (std::size_t i = 0; i < view.files.size(); ++i) {
        const Prepared source(view.files[i], part.name + std::to_string(v) + input_names[i]);
        // Of nearly all points, as far as noise leaves them there at the true pose.
        const double rival = i == 0 ? rivals.share : rivals.share_with_normals;
        // Decided, not measured: a view that another motion explains but for a fiftieth of it does not tell.
        const bool is_determined = rival < 0.98 * rivals.share_of_truth && surface.symmetries().size() == 1;
        for (std::size_t m = 0; m < models.size(); ++m) {
          const Answer answer = answer_of(source, models[m], view, surface);
          ++(is_determined ? determined : others)[i][m][answer.outcome];
          std::ostringstream row;
          row << part.name << ',' << v << ',' << view.points.size() << ',' << surface.symmetries().size() << ','
              << rivals.share << ',' << rivals.share_with_normals << ',' << input_names[i] << ',' << model_names[m]
              << ',' << outcome_names[answer.outcome] << ',' << answer.confidence << '\n';
          csv << row.str();
          if (options.rows) std::cout << row.str() << std::flush;
          if (!options.foreign || models_before.empty()) continue;
          const auto result = CR::register_scans(source.scan, models_before[m].scan);
          ++foreign[i][m][result.status() == CR::REGISTERED ? WRONG : result.status() == CR::AMBIGUOUS ? LOST : NONE];
        }
      }
    }
    models_before = std::move(models);
  }
  if (!options.csv.empty()) CR::write_file(options.csv, [&](std::ostream& out) { out << csv.str(); });
  print("The part has no symmetry, and the view determines the pose", determined);
  print("The others", others);
  if (options.foreign) print("Views of a part with the models of the one before", foreign);
  std::cout
      << "right, wrong: registered, by 5 degrees, and 5 % of the diagonal at the centroid, up to symmetry; first: "
         "not\nregistered, and the right motion the most probable one; later: listed; lost: not listed; none: "
         "nothing found\n";
  return EXIT_SUCCESS;
}

} // namespace

int main(int argc, char* argv[])
{
  try {
    Options options;
    po::options_description description("Usage: registered_parts [OPTION...]\n\n"
                                        "Registers single views of 25 machined parts with their models.\n\nOptions");
    description.add_options()("help,h", "print this");
    description.add_options()("views", po::value(&options.views)->default_value(options.views), "views of each part");
    description.add_options()("samples", po::value(&options.samples)->default_value(options.samples),
                              "of a view, about");
    description.add_options()("noise", po::value(&options.noise)->default_value(options.noise),
                              "standard deviation along the line of sight, in sampling distances");
    description.add_options()("part", po::value(&options.part), "the name of one, which alone is taken");
    description.add_options()("foreign", po::bool_switch(&options.foreign),
                              "try the views of each part with the models of the one before, too");
    description.add_options()("rows", po::bool_switch(&options.rows), "print each answer");
    description.add_options()("output", po::value(&options.csv), "file to write the answers to, as CSV");
    po::variables_map values;
    if (!benchmark_tools::read_options(argc, argv, description, values)) return EXIT_SUCCESS;
    return run(options);
  } catch (const std::exception& e) {
    std::cerr << "registered_parts: " << e.what() << '\n';
    return EXIT_FAILURE;
  }
}
