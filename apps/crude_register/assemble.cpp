// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// assemble: puts many scans together.

#include "apply.h"
#include "assembly_files.h"
#include "commands.h"
#include "files.h"
#include "json.h"
#include "known_poses.h"
#include "model_surface.h"
#include "options.h"
#include "picture.h"
#include "prepared_scans.h"
#include "progress.h"
#include "report_assembly.h"
#include "run_limits.h"
#include "scan_arguments.h"
#include "surfaces.h"
#include "workers.h"

#include <CGAL/Crude_registration/Scan.h>
#include <CGAL/Crude_registration/assemble_by_processes.h>
#include <CGAL/Crude_registration/assemble_scans.h>

#include <CGAL/for_each.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <exception>
#include <functional>
#include <iomanip>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

using Scan = CR::Scan<Kernel>;
using Result = CR::Assembly_result<Kernel>;

struct Input
{
  std::string file;
  std::optional<Scan> scan;
  std::exception_ptr failure;
};

// Prepares the scans; of several failures the first is reported.
template <class Prepare>
std::vector<Scan> prepared(const std::vector<std::string>& files, const Prepare& prepare, Progress& progress)
{
  progress.begin_stage("reading and preparing " + std::to_string(files.size()) + " scans");
  std::atomic<std::size_t> done{0};
  std::vector<Input> inputs;
  for (const std::string& file : files) inputs.push_back({file, {}, {}});
  CGAL::for_each<CGAL::Parallel_if_available_tag>(inputs, [&](Input& input) {
    try {
      if (is_interrupted()) return true;
      input.scan.emplace(prepare(input.file));
      progress.set_share(double(++done) / double(inputs.size()));
    } catch (const CR::Preparation_interrupted&) {
    } catch (...) {
      input.failure = std::current_exception();
    }
    return true;
  });
  std::vector<Scan> scans;
  for (Input& input : inputs) {
    if (input.failure) std::rethrow_exception(input.failure);
    if (!input.scan) throw std::runtime_error("interrupted while the scans were prepared: nothing is assembled");
    scans.push_back(std::move(*input.scan));
  }
  return scans;
}

// The same by the workers, who get all of them.
std::vector<Scan> prepared_by(Workers& workers, std::size_t n)
{
  std::vector<std::string> tasks;
  for (std::size_t i = 0; i < n; ++i) tasks.push_back("prepare " + std::to_string(i));
  const std::vector<std::string> bytes = workers.answers(tasks, [] { return true; });
  workers.give(bytes);
  std::vector<Scan> scans;
  for (const std::string& b : bytes) scans.push_back(CR::scan_from_bytes<Kernel>(b));
  return scans;
}

// The pairs of a round by the workers.
CR::Pair_executor executor_of(Workers& workers)
{
  return [&workers](const std::vector<CR::Scan_places>& pairs, const std::function<bool()>& go_on) {
    std::vector<std::string> tasks;
    for (const CR::Scan_places& p : pairs)
      tasks.push_back("register " + std::to_string(p.source) + ' ' + std::to_string(p.target));
    return workers.answers(tasks, go_on);
  };
}

// Does what the planner asks for, to the end.
template <class Prepare>
void serve(Workers& workers, const std::vector<std::string>& files, const Prepare& prepare,
           const std::optional<std::string>& store)
{
  std::vector<Scan> scans;
  const auto np = CR::parameters::store(store.value_or(""));
  workers.serve({[&](std::size_t i) { return CR::scan_to_bytes(prepare(files[i])); },
                 [&](const std::string& bytes) { scans.push_back(CR::scan_from_bytes<Kernel>(bytes)); },
                 [&](std::size_t i, std::size_t j) {
                   return CR::registered_pair(scans, {i, j}, np);
                 }});
}

Json to_json(const Result& result, const std::vector<std::string>& files, const std::vector<std::string>& notes,
             bool with_times)
{
  Json json = answer_of("assemble");
  json["components"] = result.number_of_components();
  json["interrupted"] = result.is_interrupted();
  Json& scans = json["scans"] = Json::array();
  for (std::size_t i = 0; i < files.size(); ++i) {
    const auto& s = result.scans()[i];
    scans.push_back({{"file", files[i]},
                     {"component", s.component},
                     {"reason", s.reason},
                     {"residual", s.residual},
                     {"pose", ::to_json(s.pose)},
                     {"covariance", s.covariance}});
    if (!s.lost_hint.empty()) scans.back()["lost_hint"] = s.lost_hint;
  }
  json["edges"] = rows_of_edges(result);
  json["overlaps"] = rows_of_overlaps(result);
  Json& statistics = json["statistics"] = Json::array();
  for (const auto& stage : result.statistics()) {
    Json& entry = statistics.emplace_back(Json{{"stage", stage.name}, {"count", stage.count}});
    if (with_times) entry["seconds"] = stage.seconds;
  }
  json["notes"] = notes;
  return json;
}

void print_text(const Result& result, const std::vector<std::string>& names)
{
  std::cout << std::setprecision(3);
  for (std::size_t c = 0; c < result.number_of_components(); ++c) {
    std::cout << "component " << c << '\n';
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto& s = result.scans()[i];
      if (s.component != c) continue;
      std::cout << "  " << names[i];
      if (s.reason.empty()) std::cout << ", residual " << s.residual << " sampling distances\n";
      else std::cout << ", alone: " << s.reason << '\n';
      if (!s.lost_hint.empty()) std::cout << "    its known pose was dropped: " << s.lost_hint << '\n';
    }
  }
  std::size_t used = 0;
  for (const auto& e : result.edges()) used += e.status == CR::USED;
  std::cout << result.edges().size() << " pairs were registered, " << used << " of them are used\n";
  for (const auto& e : result.edges())
    if (e.status == CR::DROPPED || e.status == CR::NOT_CONNECTING)
      std::cout << "  " << names[e.source] << " - " << names[e.target] << ' ' << e.status << ": " << e.reason << '\n';
}

// `workers`: the processes that do the tasks; none: this one does them all.
int assemble(const std::vector<std::string>& arguments, Workers* workers)
{
  po::options_description options("options");
  auto add = options.add_options();
  add("poses", po::value<std::string>(),
      "file for the poses: a line a scan, its name and the rows of its 3 x 4 matrix, which maps it into the frame of "
      "the first scan of its component; a line '# component' before each component. A name that ends in .conf "
      "(Stanford) or .aln (MeshLab): a file of that form, of the largest component");
  add("output", po::value<std::string>(),
      "file (PLY) for the points of the largest component in one frame, each with the number of its scan and its "
      "distance from the other ones, -1 where they are not near; with their colours if the scans have any");
  add("apply", po::value<std::string>(),
      "folder, made if missing, for the files of the largest component as they are but moved to its frame: in their "
      "own "
      "formats, with all that is in them (colours, intensities, texture, faces, comments), normals turned");
  add("mesh", po::value<std::string>(),
      "file (PLY) for the surface of the largest component as one mesh, of the points of its scans together, one for "
      "each cell of about two sampling distances");
  add("surface", po::value<std::string>()->default_value("advancing-front"),
      "how the mesh is made: advancing-front, which takes the points as they are, scale-space, which smoothes them, or "
      "poisson, which closes the surface where it was not seen");
  add("table", po::value<std::string>(), "file for the overlaps and the residuals of all pairs, as text");
  add("picture", po::value<std::string>(), "file (PNG) for a picture of the largest component, a colour a scan");
  add("report", po::value<std::string>(),
      "file (HTML) for a page to look at the model in, with the graph, the overlaps, the residuals and what was left "
      "out; it needs a browser and nothing else");
  add("viewpoint", po::value<std::string>(),
      "x,y,z of the sensor, in each scan's own frame, for scans whose files do not tell it");
  add("graph", po::value<std::string>(), "file for the graph of the pairs, for GraphViz");
  add("known", po::value<std::string>(),
      "file of poses that are known beforehand, of some scans or of all, of the form that --poses writes: hints, which "
      "are tried first and decide where a pair does not; those of each component are in one frame");
  add("fix", "take the known poses as they are: what they place stays where it is");
  add("reference", po::value<std::string>(), "the scan whose frame is that of its component; default: the first one");
  add("store", po::value<std::string>(),
      "folder that keeps each prepared scan and the answer of each pair: a run that was ended, or has more scans, does "
      "none again; several runs may share it");
  add("time-budget", po::value<double>(), "seconds after which the search ends, with what has been found");
  add("threads", po::value<int>(), "largest number of threads; the answer does not depend on it");
  add("json", "print JSON, the same bytes for the same scans");
  add("times", "add the times to the JSON, or to the text");
  const Command command = {
      "assemble",
      "SCAN...",
      "Puts scans together, in any order: finds a pose for each. What cannot be connected with certainty stays apart,\n"
      "as a component of its own. A folder stands for all scans in it.\n"
      "Exit code: 0 some scans are connected, 3 none are, 1 error, 130 ended by Ctrl-C.\n",
      {{"scans/ --poses poses.txt", "a pose for each scan in a folder"},
       {"'scan_*.ply' --output model.ply --picture model.png", "all points in one frame, and a picture of them"},
       {"scans/ --apply moved", "each scan moved, with all that is in its file"}},
      {}};
  const auto given = parse(command, options, {}, arguments, "SCAN");
  if (!given) return 0;
  const po::variables_map& map = *given;
  const std::optional<Point> viewpoint = point_of(map, "viewpoint");
  limit_threads(map);
  const double time_budget = time_budget_of(map);

  const auto files = scans_of_arguments(map["SCAN"].as<std::vector<std::string>>());
  const auto store = value_of<std::string>(map, "store");
  const auto prepare = [&](const std::string& file) { return prepared_scan(map, file, viewpoint, store); };
  if (workers && !workers->is_planner()) {
    serve(*workers, files, prepare, store);
    return 0;
  }

  for (const char* option : {"poses", "output", "mesh", "table", "graph", "report"})
    if (const auto file = value_of<std::string>(map, option)) check_output(*file);
  const std::string surface = map["surface"].as<std::string>();
  check_surface_method(surface);
  const auto picture = value_of<std::string>(map, "picture");
  check_picture(picture);

  const std::vector<std::string> names = names_of(files);
  if (map.count("fix") > 0 && map.count("known") == 0) throw Usage_error("--fix needs --known");
  Known known = known_of(value_of<std::string>(map, "known"), names);
  if (const auto reference = value_of<std::string>(map, "reference"))
    known.reference = place_of(*reference, names, "--reference");
  const auto apply_folder = value_of<std::string>(map, "apply");
  std::vector<std::string> applied;
  if (apply_folder) {
    applied = applied_names(*apply_folder, files);
    for (const std::string& file : files) check_apply(file);
    make_folder(*apply_folder);
    for (std::size_t i = 0; i < files.size(); ++i) check_apply(files[i], applied[i]);
  }
  watch_for_interruption();
  Progress progress;
  const auto start = Clock::now();
  const std::vector<Scan> scans = workers ? prepared_by(*workers, files.size()) : prepared(files, prepare, progress);
  const double preparation = seconds_since(start);
  constexpr double shortest = 1e-9;
  progress.begin_stage("assembling");
  const auto np = CR::parameters::time_budget((std::max)(shortest, time_budget - preparation))
                      .visitor(Terminal_visitor(progress))
                      .known_poses(std::cref(known.poses))
                      .known_groups(std::cref(known.groups))
                      .known_poses_are_fixed(map.count("fix") > 0);
  const auto run = [&](const auto& given_parameters) {
    const auto parameters = given_parameters.store(store.value_or(""));
    return workers ? CR::assemble_scans_by<CGAL::Parallel_if_available_tag>(executor_of(*workers), scans, parameters)
                   : CR::assemble_scans<CGAL::Parallel_if_available_tag>(scans, parameters);
  };
  const Result result = known.reference ? run(np.reference_scan(*known.reference)) : run(np);

  progress.begin_stage("writing");
  if (const auto file = value_of<std::string>(map, "poses")) write_poses(*file, result, names);
  if (const auto file = value_of<std::string>(map, "graph"))
    CR::write_file(*file, [&](std::ostream& out) { write_graph(out, result, names); });
  if (const auto file = value_of<std::string>(map, "table"))
    CR::write_file(*file, [&](std::ostream& out) { write_tables(out, result, names); });
  if (const auto file = value_of<std::string>(map, "output")) write_points(*file, map, result, scans, files);
  std::vector<std::string> notes;
  for (std::size_t i = 0; i < applied.size(); ++i) {
    if (result.component(i) != 0) continue;
    const std::string note = apply(files[i], applied[i], result.pose(i), scans[i].spacing());
    if (!note.empty()) notes.push_back(note);
  }
  const auto surface_of = [&](std::size_t i) {
    const Scan_file contents = read_scan(map, files[i]);
    return surface_to_show(contents, &scans[i]);
  };
  if (const auto file = value_of<std::string>(map, "report"))
    write_assembly_report(
        *file, result, scans, names, [&](std::size_t i) { return points_of(read_scan(map, files[i])); }, surface_of);
  if (const auto file = value_of<std::string>(map, "mesh")) write_model_surface(*file, surface, result, scans);
  if (picture) {
    std::vector<Surface> surfaces;
    std::vector<Placed_surface> placed;
    surfaces.reserve(files.size());
    for (std::size_t i = 0; i < files.size(); ++i) {
      if (result.component(i) != 0) continue;
      surfaces.push_back(surface_of(i));
      placed.push_back({&surfaces.back(), result.pose(i)});
    }
    write_picture(*picture, placed, true);
  }
  progress.clear();
  const bool with_times = map.count("times") > 0;
  if (map.count("json") > 0) std::cout << to_text(to_json(result, files, notes, with_times)) << '\n';
  else {
    print_text(result, names);
    for (const std::string& note : notes) std::cout << "note: " << note << '\n';
  }
  if (with_times && map.count("json") == 0) {
    std::cout << "seconds: " << preparation << " to read and prepare, " << seconds_since(start) << " in all\n";
    for (const auto& stage : result.statistics())
      std::cout << "  " << stage.name << ' ' << stage.count << ' ' << stage.seconds << '\n';
  }
  return files.size() == 1 || result.number_of_components() < files.size() ? EXIT_REGISTERED : EXIT_NOT_REGISTERED;
}

} // namespace

int run_assemble(const std::vector<std::string>& arguments)
{
  return assemble(arguments, nullptr);
}

int run_assemble_by(Workers& workers, const std::vector<std::string>& arguments)
{
  return assemble(arguments, &workers);
}
