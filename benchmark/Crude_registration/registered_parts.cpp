// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// Registers single views of machined parts, as points, points with normals and meshes, with their models: of triangles
// as large as the faces, of small ones, of slivers, and as files have them that were never one surface. Counts the
// answers by whether the view determines the pose, which is judged by the truth, see rival_motions.h.

#include "command_line.h"
#include "views_of_parts.h"

#include <CGAL/Crude_registration/IO/write_file.h>
#include <CGAL/Crude_registration/register_scans.h>

#include <CGAL/Polygon_mesh_processing/bbox.h>

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
using benchmark_tools::Prepared;
using benchmark_tools::Transformation;
using benchmark_tools::View;
namespace CR = CGAL::Crude_registration;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

namespace {

struct Options : benchmark_tools::Viewing
{
  std::size_t views = 2; // of each part
  std::string csv, part;
  bool foreign = false, rows = false;
};

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

Answer answer_of(const Prepared& source, const Prepared& target, const View& view, const Known_surface& surface)
{
  const auto result = CR::register_scans(source.scan, target.scan);
  const auto is_right = [&](const Transformation& found) {
    return surface.is_right(benchmark_tools::to_pose(target.moved_from_file.inverse() * found * source.moved_from_file),
                            view.truth, view.centroid);
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
      std::cout << std::left << std::setw(21) << benchmark_tools::input_names[i] << std::setw(16)
                << benchmark_tools::model_names[m] << std::right << std::setw(7) << sum;
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
    const Mesh whole = benchmark_tools::united(part);
    const Known_surface surface(whole);
    const CR::Simulated_scene scene(whole);
    std::vector<View> views;
    for (std::size_t v = 0; v < options.views; ++v)
      views.push_back(benchmark_tools::view_of(scene, PMP::bbox(whole), first_seed + v, options));
    std::vector<Prepared> models;
    const std::vector<Mesh> meshes = benchmark_tools::models_of(part, whole, views.front().spacing);
    for (std::size_t m = 0; m < meshes.size(); ++m)
      models.emplace_back(benchmark_tools::file_of(meshes[m]), part.name + benchmark_tools::model_names[m]);
    for (std::size_t v = 0; v < views.size(); ++v) {
      const View& view = views[v];
      // What noise leaves, and a little of what the nearest point of an edge adds.
      const double tolerance = (3 * options.noise + 0.3) * view.spacing;
      // What is not joined to a surface is in the file of points alone. Of a symmetric part none is asked for.
      Known_surface::Rivals rivals_of_points, rivals_of_joined;
      if (surface.symmetries().size() == 1) {
        rivals_of_points = surface.rivals(view.points, view.truth, tolerance);
        rivals_of_joined = surface.rivals(view.joined, view.truth, tolerance);
      }
      for (std::size_t i = 0; i < view.files.size(); ++i) {
        const Prepared source(view.files[i], part.name + std::to_string(v) + benchmark_tools::input_names[i]);
        const auto& rivals = i == 0 ? rivals_of_points : rivals_of_joined;
        // Of nearly all points, as far as noise leaves them there at the true pose.
        const double rival = i == 0 ? rivals.share : rivals.share_with_normals;
        // Decided, not measured: a view that another motion explains but for a fiftieth of it does not tell.
        const bool is_determined = rival < 0.98 * rivals.share_of_truth && surface.symmetries().size() == 1;
        for (std::size_t m = 0; m < models.size(); ++m) {
          const Answer answer = answer_of(source, models[m], view, surface);
          ++(is_determined ? determined : others)[i][m][answer.outcome];
          std::ostringstream row;
          row << part.name << ',' << v << ',' << view.points.size() << ',' << surface.symmetries().size() << ','
              << rivals.share << ',' << rivals.share_with_normals << ',' << benchmark_tools::input_names[i] << ','
              << benchmark_tools::model_names[m] << ',' << outcome_names[answer.outcome] << ',' << answer.confidence
              << '\n';
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
