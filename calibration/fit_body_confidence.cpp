// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// Measures the law by which a view and the whole surface of a body are judged, and writes the header that holds it.
//
// Single views of machined parts without symmetry, as points, as points with normals and a sensor, and as meshes, are
// searched in the model of the part, in that of another part, and in similar ones: mirrored, longer, with a hole or a
// piece elsewhere. A model on which nearly all of the view lies, too, is left out: no one can tell. The evidence of the
// distinct poses and the truth give the coefficients by conditional logistic regression (McFadden 1974), as in
// fit_confidence.cpp. Each part is judged by coefficients fitted to the others.

#include "../benchmark/Crude_registration/command_line.h"
#include "conditional_logit.h"
#include "../benchmark/Crude_registration/views_of_parts.h"

#include <CGAL/Crude_registration/IO/write_file.h>
#include <CGAL/Crude_registration/internal/judgement/Pose_judge.h>
#include <CGAL/Crude_registration/internal/matching/Oriented_pair_search.h>
#include <CGAL/Crude_registration/register_scans.h>

#include <boost/program_options.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace po = boost::program_options;
namespace CR = CGAL::Crude_registration;
namespace CRI = CR::internal;
using benchmark_tools::Kernel;
using benchmark_tools::Known_surface;
using benchmark_tools::Machined_part;
using benchmark_tools::Part_mesh;
using benchmark_tools::Pose_of_view;
using benchmark_tools::Prepared;
using benchmark_tools::View;
using Laws = CRI::Evidence_coefficients; // of the judge

namespace {

const std::array<const char*, 5> model_kinds = {"own", "mirrored", "longer", "altered", "foreign"};

// What a search says: of each distinct pose the evidence, and which are right.
struct Choice
{
  std::size_t part, input, kind;
  std::vector<CRI::Pose_evidence> poses;
  std::vector<bool> is_right;

  bool has_right() const { return std::find(is_right.begin(), is_right.end(), true) != is_right.end(); }
};

std::vector<CRI::Judged_pose> judged(const Choice& choice, const Laws& laws)
{
  std::vector<CRI::Judged_pose> poses(choice.poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    poses[i].evidence = choice.poses[i];
    poses[i].log_weight = CRI::log_weight(choice.poses[i], choice.poses[i].usual, laws);
  }
  return poses;
}

struct Model
{
  std::size_t kind;
  const Known_surface* surface;
  Prepared prepared;
};

// Searches as register_scans() does, with each side of the view; nothing is added where another model's surface has the
// view on it.
void search(const Prepared& source, const Model& model, const View& view, double tolerance, Choice choice,
            std::vector<Choice>& choices)
{
  const CR::Scan<Kernel>* const other_side = source.scan.other_side();
  for (const CR::Scan<Kernel>* scan : {&source.scan, other_side}) {
    if (!scan) continue;
    const bool is_swapped = CRI::are_swapped(scan->reduced(), model.prepared.scan.reduced());
    const CRI::Reduced_scan &s = is_swapped ? model.prepared.scan.reduced() : scan->reduced(),
                            &t = is_swapped ? scan->reduced() : model.prepared.scan.reduced();
    CRI::Oriented_pair_search candidates(s, t, CRI::Oriented_pair_parameters(), CRI::Execution::SEQUENTIAL);
    CRI::Pose_judge judge(s, t, CRI::Execution::SEQUENTIAL, CRI::to_the_end());
    if (!judge.has_body()) continue;
    for (;;) {
      std::optional<CRI::Proposals> proposals = candidates.next(CRI::to_the_end());
      if (!proposals) break;
      judge.add_round(std::move(*proposals));
      if (CRI::is_certain(judge.distinct_poses())) break;
    }
    Choice found = choice;
    bool is_alike = false;
    for (CRI::Judged_pose& p : judge.distinct_poses(CRI::Judged_by::BODY)) {
      const CRI::Rigid_motion m = t.own_from_input.inverse() * CRI::to_rigid_motion(p.pose) * s.own_from_input;
      const auto motion = CRI::to_aff_transformation<Kernel>(is_swapped ? m.inverse() : m);
      const Pose_of_view pose =
          benchmark_tools::to_pose(model.prepared.moved_from_file.inverse() * motion * source.moved_from_file);
      judge.add_variety_and_spread(p); // by other coefficients another one may lead
      found.poses.push_back(p.evidence);
      found.is_right.push_back(choice.kind == 0 && model.surface->is_right(pose, view.truth, view.centroid));
      // As registered_parts has it: another motion explains all but a fiftieth of it.
      constexpr double all = 0.98;
      is_alike = is_alike || (choice.kind != 0 && model.surface->share_near(view.points, pose, tolerance) >= all);
    }
    if (!is_alike && !found.poses.empty()) choices.push_back(found);
  }
}

struct Generation : benchmark_tools::Viewing
{
  std::size_t first_part = 0, parts = 25, views = 2;
  std::uint64_t first_view = 500; // others than those of registered_parts
};

std::vector<Choice> choices_of(const Generation& generation)
{
  std::vector<Choice> choices;
  const std::vector<Machined_part> parts = benchmark_tools::machined_parts();
  for (std::size_t k = generation.first_part; k < (std::min)(generation.first_part + generation.parts, parts.size());
       ++k) {
    const Part_mesh whole = benchmark_tools::united(parts[k]);
    const Known_surface surface(whole);
    if (surface.symmetries().size() > 1) continue; // more than one motion is right
    const CR::Simulated_scene scene(whole);
    std::vector<Part_mesh> meshes = benchmark_tools::similar_models(parts[k], whole);
    meshes.insert(meshes.begin(), whole);
    meshes.push_back(benchmark_tools::united(parts[(k + 1) % parts.size()]));
    std::vector<Known_surface> surfaces;
    surfaces.reserve(meshes.size());
    for (const Part_mesh& m : meshes) surfaces.emplace_back(m);
    for (std::size_t v = 0; v < generation.views; ++v) {
      const View view = benchmark_tools::view_of(scene, CGAL::Polygon_mesh_processing::bbox(whole),
                                                 1000 * (k + 1) + generation.first_view + v, generation);
      const double tolerance = (3 * generation.noise + 0.3) * view.spacing;
      std::vector<Model> models;
      for (std::size_t m = 0; m < meshes.size(); ++m) {
        // Of large triangles for one view, and of small ones for the next.
        const Part_mesh mesh = v % 2 == 0 ? meshes[m] : benchmark_tools::finer(meshes[m], 2 * view.spacing);
        models.push_back({m, &surfaces[m], Prepared(benchmark_tools::file_of(mesh), parts[k].name + model_kinds[m])});
      }
      for (std::size_t i = 0; i < view.files.size(); ++i) {
        CR::Scan_file<Kernel> file = view.files[i];
        if (i == 1) file.sensor = view.sensor;
        const Prepared source(file, parts[k].name + std::to_string(v) + benchmark_tools::input_names[i]);
        for (const Model& model : models) search(source, model, view, tolerance, {k, i, model.kind, {}, {}}, choices);
      }
    }
    std::cerr << parts[k].name << ": " << choices.size() << " searches so far\n";
  }
  return choices;
}

constexpr std::size_t no_part = (std::numeric_limits<std::size_t>::max)();

// Fits the law of whether one is right to all parts but one. `held`: the lapse of another law, too seldom seen to be
// fitted to fewer. Neither the root of the evidence nor its lead are in it: beside what is off they say nothing, as
// similar models agree as well.
Laws fit(const std::vector<Choice>& choices, std::size_t without, const Laws* held)
{
  Laws laws = CRI::coefficients_of_body({});
  using Of_any = benchmark_tools::Conditional_logit<4>;
  Of_any of_any;
  for (const Choice& choice : choices) {
    const std::vector<CRI::Judged_pose> poses = judged(choice, laws);
    const auto leading = CRI::leading(poses);
    const CRI::Pose_evidence& e = leading->evidence;
    Of_any::Features f;
    f << e.residual, std::sqrt(e.violations), e.variety, 1;
    of_any.add_choice({f}, choice.is_right[std::size_t(leading - poses.begin())] ? 0 : -1, choice.part);
  }
  Of_any::Estimate any;
  any.lapse = held ? held->usual_any.lapse : 0.01;
  any = of_any.fit(without, any, held != nullptr);
  const auto& b = any.coefficients;
  laws.usual_any = {0, b[0], b[1], b[2], b[3], any.lapse};
  return laws;
}

struct Calibration
{
  double brier = 0;
  std::size_t answers = 0, believed = 0, believed_and_wrong = 0;
};

// Judges each part by the laws that were fitted to the others, and prints what is believed by kind of model and input.
Calibration cross_validation(const std::vector<Choice>& choices, const Laws& all)
{
  Calibration total;
  std::array<std::array<std::array<std::size_t, 4>, 3>, model_kinds.size()> counts{};
  std::array<std::array<double, 3>, 10> bins{}; // answers, right, probability
  for (std::size_t part = 0; part < benchmark_tools::machined_parts().size(); ++part) {
    const Laws laws = fit(choices, part, &all);
    for (const Choice& choice : choices) {
      if (choice.part != part) continue;
      std::vector<CRI::Judged_pose> poses = judged(choice, laws);
      CRI::share_probability(poses, true, true, laws);
      const auto best = std::max_element(poses.begin(), poses.end(),
                                         [](const auto& a, const auto& b) { return a.probability < b.probability; });
      const bool is_right = choice.is_right[std::size_t(best - poses.begin())];
      const bool is_believed = best->probability >= CRI::believed;
      ++total.answers;
      total.brier += std::pow(best->probability - double(is_right), 2);
      total.believed += is_believed;
      total.believed_and_wrong += is_believed && !is_right;
      auto& bin = bins[(std::min)(std::size_t(best->probability * 10), bins.size() - 1)];
      bin = {bin[0] + 1, bin[1] + double(is_right), bin[2] + best->probability};
      auto& n = counts[choice.kind][choice.input];
      ++n[0];
      n[1] += choice.has_right();
      n[2] += is_believed && is_right;
      n[3] += is_believed && !is_right;
      if (is_believed != is_right && (is_believed || choice.kind == 0))
        std::cout << (is_believed ? "wrong: " : "lost: ") << benchmark_tools::machined_parts()[part].name << ", "
                  << benchmark_tools::input_names[choice.input] << ", " << model_kinds[choice.kind] << ": "
                  << best->probability << ", any " << CRI::probability_of_any(poses) << ", off "
                  << best->evidence.violations << ", found " << choice.has_right() << '\n';
    }
  }
  total.brier /= double((std::max)(total.answers, std::size_t(1)));
  std::cout << "model     input                searches   found   right   wrong\n";
  for (std::size_t k = 0; k < counts.size(); ++k)
    for (std::size_t i = 0; i < counts[k].size(); ++i) {
      std::cout << std::left << std::setw(10) << model_kinds[k] << std::setw(21) << benchmark_tools::input_names[i]
                << std::right;
      for (const std::size_t n : counts[k][i]) std::cout << std::setw(8) << n;
      std::cout << '\n';
    }
  for (const auto& bin : bins)
    if (bin[0] > 0)
      std::cout << std::setw(6) << bin[0] << " answers, right " << bin[1] / bin[0] << ", probability "
                << bin[2] / bin[0] << '\n';
  return total;
}

void write_choices(std::ostream& out, const std::vector<Choice>& choices)
{
  out << std::setprecision(9) << "search,part,input,kind,right,usual,residual,violations,surfels,variety\n";
  for (std::size_t i = 0; i < choices.size(); ++i)
    for (std::size_t k = 0; k < choices[i].poses.size(); ++k) {
      const Choice& c = choices[i];
      const CRI::Pose_evidence& e = c.poses[k];
      out << i << ',' << c.part << ',' << c.input << ',' << c.kind << ',' << c.is_right[k] << ',' << e.usual << ','
          << e.residual << ',' << e.violations << ',' << e.surfels << ',' << e.variety << '\n';
    }
}

std::vector<Choice> read_choices(const std::string& path)
{
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line) || line.rfind("search,part,", 0) != 0)
    throw std::runtime_error(path + ": it is no file that --choices wrote");
  std::vector<Choice> choices;
  std::size_t last = (std::numeric_limits<std::size_t>::max)();
  while (std::getline(file, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream in(line);
    std::size_t search;
    Choice c;
    bool is_right;
    CRI::Pose_evidence e;
    if (!(in >> search >> c.part >> c.input >> c.kind >> is_right >> e.usual >> e.residual >> e.violations >>
          e.surfels >> e.variety))
      throw std::runtime_error(path + ": cannot be read: " + line);
    if (search != last) choices.push_back(c);
    last = search;
    choices.back().poses.push_back(e);
    choices.back().is_right.push_back(is_right);
  }
  return choices;
}

void write_header(std::ostream& out, const Laws& laws, const std::string& how)
{
  out << "// Copyright (c) 2026 The Crude_registration authors.\n// All rights reserved.\n//\n"
         "// This file is part of the CGAL package Crude_registration.\n//\n// $"
         "URL$\n// $"
         "Id$\n// SPDX-License-Identifier: GPL-3.0-or-later\n//\n"
         "// Author(s)     : The Crude_registration authors\n\n"
         "#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_BODY_COEFFICIENTS_H\n"
         "#define CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_BODY_COEFFICIENTS_H\n\n"
         "// The law of a view and the whole surface of a body: written by\n"
         "// calibration/fit_body_confidence, and not by hand.\n"
      << how
      << "\n#include <CGAL/Crude_registration/internal/judgement/evidence_coefficients.h>\n\n"
         "namespace CGAL {\nnamespace Crude_registration {\nnamespace internal {\n\n"
         "// As chance is between any two scans; among the violations is what is off the body, as a share of the "
         "view's "
         "probes.\n"
         "struct Body_coefficients\n{\n"
      << std::setprecision(5);
  const auto law = [&](const char* name, const CRI::Evidence_law& l) {
    out << "  Evidence_law " << name << " = {" << l.slope << ", " << l.residual << ", " << l.violations << ", "
        << l.variety << ", " << l.offset << ", " << l.lapse << "};\n";
  };
  out << "  // The log-odds that one of the distinct poses is right.\n";
  law("any", laws.usual_any);
  out << "};\n\n} // namespace internal\n} // namespace Crude_registration\n} // namespace CGAL\n\n"
         "#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_BODY_COEFFICIENTS_H\n";
}

} // namespace

int main(int argc, char* argv[])
{
  try {
    Generation generation;
    std::string output, csv, from;
    po::options_description options("fit_body_confidence: measures the law of a view and the whole surface of a body");
    options.add_options()("help,h", "this text")("views", po::value(&generation.views)->default_value(generation.views),
                                                 "of each part")(
        "first-view", po::value(&generation.first_view)->default_value(generation.first_view), "its number")(
        "first-part", po::value(&generation.first_part)->default_value(generation.first_part),
        "its number")("parts", po::value(&generation.parts)->default_value(generation.parts),
                      "that are taken")("choices", po::value(&csv), "file to write the evidence to, as CSV")(
        "from", po::value(&from), "file that --choices wrote: nothing is searched")("output", po::value(&output),
                                                                                    "the header to write");
    po::variables_map values;
    if (!benchmark_tools::read_options(argc, argv, options, values)) return EXIT_SUCCESS;
    const std::vector<Choice> choices = from.empty() ? choices_of(generation) : read_choices(from);
    if (!csv.empty()) CR::write_file(csv, [&](std::ostream& out) { write_choices(out, choices); });
    const Laws laws = fit(choices, no_part, nullptr);
    const Calibration calibration = cross_validation(choices, laws);
    std::ostringstream how;
    std::vector<std::size_t> parts;
    for (const Choice& choice : choices)
      if (parts.empty() || parts.back() != choice.part) parts.push_back(choice.part);
    how << "// " << parts.size() << " parts, " << generation.views << " views of each from number "
        << generation.first_view << " on, " << choices.size() << " searches. In cross-validation by part the "
        << calibration.answers << "\n// answers have the Brier score " << std::setprecision(3) << calibration.brier
        << ", and of " << calibration.believed << " that were believed " << calibration.believed_and_wrong
        << " were wrong.\n";
    std::cout << how.str();
    if (!output.empty()) CR::write_file(output, [&](std::ostream& out) { write_header(out, laws, how.str()); });
  } catch (const std::exception& e) {
    std::cerr << "fit_body_confidence: " << e.what() << '\n';
    return EXIT_FAILURE;
  }
  return 0;
}
