// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// register: finds the motion that maps one scan onto another.

#include "apply.h"
#include "colours.h"
#include "commands.h"
#include "files.h"
#include "json.h"
#include "options.h"
#include "picture.h"
#include "progress.h"
#include "report_pair.h"
#include "run_limits.h"
#include "sides.h"
#include "surfaces.h"

#include <CGAL/Crude_registration/Registration_result.h>
#include <CGAL/Crude_registration/Scan.h>
#include <CGAL/Crude_registration/matching/Oriented_pair_candidates.h>
#include <CGAL/Crude_registration/matching/Trihedron_candidates.h>
#include <CGAL/Crude_registration/register_scans.h>
#include <CGAL/Crude_registration/register_scans_with_scale.h>
#include <CGAL/Crude_registration/sampling/estimate_sensor.h>

#include <CGAL/Polygon_mesh_processing/transform.h>
#include <CGAL/for_each.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <exception>
#include <functional>
#include <iomanip>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace {

using Scan = CR::Scan<Kernel>;
using Result = CR::Registration_result<Kernel>;

struct Side : Scan_of_a_side
{
  std::unique_ptr<const Scan> scan;
  Surface shown; // of a range image what was registered, where it is asked for; else as yet empty
  double seconds = 0;
  std::string interruption;   // the time budget's end, before there was a scan
  std::exception_ptr failure; // of both sides', the first is reported
};

struct Answer
{
  Result result;
  bool is_scale_estimated = false;
  double scale = 1, scale_deviation = 0; // of the source, estimated
  double preparation_seconds = 0;
  double search_seconds = 0;
};

// The generator of candidates with the bounds that are given; it has defaults for the others.
template <class Generator>
Generator generator_with(const std::optional<double>& f1, const std::optional<double>& f2)
{
  namespace p = CR::parameters;
  try {
    if (f1 && f2) return Generator(p::minimum_extent(*f1).maximum_extent(*f2));
    if (f1) return Generator(p::minimum_extent(*f1));
    if (f2) return Generator(p::maximum_extent(*f2));
    return Generator();
  } catch (const std::invalid_argument& e) {
    throw Usage_error(std::string("--f1, --f2: ") + e.what());
  }
}

// From here on the source is as large as it was found to be.
void take_scale(double factor, Side& source)
{
  if (factor == 1) return;
  scale(source.contents, factor);
  for (Point& p : source.shown.points) p = p.transform(Transformation(CGAL::SCALING, factor));
  if (source.viewpoint) source.viewpoint = source.viewpoint->transform(Transformation(CGAL::SCALING, factor));
  source.scan = std::make_unique<const Scan>(CR::scaled(*source.scan, factor));
  source.unit *= factor;
}

// Triangulates what was read of a range image, so that what is registered and what is shown of it are computed once.
void triangulate(Side& side)
{
  CR::Range_image<Kernel>& image = side.contents.image;
  if (!image.sensor().is_known())
    image.set_sensor(side.viewpoint ? CR::Sensor<Kernel>::perspective(*side.viewpoint) : CR::estimate_sensor(image));
  side.shown = surface_to_show(side.contents, nullptr);
}

template <class Parameters>
std::unique_ptr<const Scan> scan_of(const Side& side, const Parameters& np)
{
  if (!side.shown.triangles.empty())
    return std::make_unique<const Scan>(side.shown.points, side.shown.triangles, side.contents.image.sensor(), np,
                                        side.file);
  return side.viewpoint ? std::make_unique<const Scan>(side.contents, np.viewpoint(*side.viewpoint), side.file)
                        : std::make_unique<const Scan>(side.contents, np, side.file);
}

// Reads, prepares and registers the two scans. `are_shown`: their surfaces, too, are asked for.
template <class Generator>
Answer register_files(std::array<Side, 2>& sides, const Generator& generator, double time_budget, bool estimate_scale,
                      bool are_shown, Progress& progress)
{
  const auto left = [&, begin = Clock::now()] { // of the time budget
    constexpr double shortest = 1e-9;
    return (std::max)(shortest, time_budget - seconds_since(begin));
  };
  const Terminal_visitor visitor(progress);
  progress.begin_stage("reading and preparing the scans");
  CGAL::for_each<CGAL::Parallel_if_available_tag>(sides, [&](Side& side) {
    try {
      side.read();
      const auto start = Clock::now();
      constexpr bool needs_image = std::is_same_v<Generator, CR::Trihedron_candidates>;
      if (are_shown && !needs_image && side.contents.kind == Scan_file::RANGE_IMAGE) triangulate(side);
      side.scan = scan_of(side, CR::parameters::time_budget(left()).candidates(generator).visitor(visitor));
      side.seconds = seconds_since(start);
    } catch (const CR::Preparation_interrupted& interrupted) {
      side.interruption = interrupted.what();
    } catch (...) {
      side.failure = std::current_exception();
    }
    return true;
  });
  for (const Side& side : sides)
    if (side.failure) std::rethrow_exception(side.failure);

  Answer answer;
  answer.is_scale_estimated = estimate_scale;
  answer.preparation_seconds = sides[0].seconds + sides[1].seconds;
  const auto start = Clock::now();
  if (sides[0].scan && sides[1].scan) {
    progress.begin_stage("registering");
    const auto np = CR::parameters::time_budget(left()).candidates(generator).visitor(visitor);
    if (estimate_scale) {
      const auto scaled =
          CR::register_scans_with_scale<CGAL::Parallel_if_available_tag>(*sides[0].scan, *sides[1].scan, np);
      answer.result = scaled.registration;
      answer.scale = scaled.scale;
      answer.scale_deviation = scaled.scale_deviation;
      take_scale(answer.scale, sides[0]);
    } else {
      answer.result = CR::register_scans<CGAL::Parallel_if_available_tag>(*sides[0].scan, *sides[1].scan, np);
    }
  } else {
    Result::Parts parts;
    parts.reason = sides[0].scan ? sides[1].interruption : sides[0].interruption;
    answer.result = Result(std::move(parts));
  }
  answer.search_seconds = seconds_since(start);
  return answer;
}

// What the sizes of two scans that are not registered, or ambiguous, suggest, or nothing. The ratio is compared with 1
// and those of units that are often mixed up: it has to be nearer to one of these than to 1, by its logarithm.
std::string hint_of(const std::array<Side, 2>& sides)
{
  if (!sides[0].scan || !sides[1].scan) return "";
  const double sizes[2] = {sides[0].scan->extent(), sides[1].scan->extent()};
  const bool source_is_larger = sizes[0] > sizes[1];
  const double ratio = source_is_larger ? sizes[0] / sizes[1] : sizes[1] / sizes[0];
  const std::array<std::pair<const char*, const char*>, 4> pairs = {
      {{"m", "ft"}, {"in", "mm"}, {"m", "cm"}, {"m", "mm"}}}; // of growing ratios
  const std::pair<const char*, const char*>* nearest = nullptr;
  double distance = std::abs(std::log(ratio));
  for (const auto& pair : pairs) {
    const double d = std::abs(std::log(ratio / (units.at(pair.first) / units.at(pair.second))));
    if (d < distance) {
      distance = d;
      nearest = &pair;
    }
  }
  if (nearest == nullptr) return "";
  const char *const large = source_is_larger ? "source" : "target", *const small =
                                                                        source_is_larger ? "target" : "source";
  std::ostringstream text;
  text << "the " << large << " is " << std::setprecision(3) << ratio << " times as large as the " << small
       << ": if their units differ, say them, as by --" << large << "-unit " << nearest->second << " --" << small
       << "-unit " << nearest->first << ", or try --estimate-scale; if the " << small << " is a part of the " << large
       << ", cut that to about it";
  return text.str();
}

// What the truth says about an answer.
struct Error
{
  double degrees;      // of rotation
  double displacement; // RMS of the source's vertices
};

Eigen::Matrix3d rotation_of(const Transformation& motion)
{
  Eigen::Matrix3d rotation;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) rotation(i, j) = motion.m(i, j);
  return rotation;
}

Error error_of(const Transformation& answer, const Transformation& truth, const std::vector<Point>& source)
{
  double sum = 0;
  for (const Point& p : source)
    sum += CGAL::squared_distance(answer.transform(p), truth.transform(p)) / double(source.size());
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(rotation_of(answer) * rotation_of(truth).transpose()));
  return {turn.angle() * 180 / CGAL_PI, std::sqrt(sum)};
}

// What is written besides the answer. The files are made at the same time; what fails is told in the order in which
// they were added.
class Outputs
{
public:
  void add(const std::string& file, std::function<void()> write) { m_outputs.push_back({file, std::move(write), {}}); }

  // The names of the files.
  std::vector<std::string> write()
  {
    CGAL::for_each<CGAL::Parallel_if_available_tag>(m_outputs, [](Output& output) {
      try {
        output.write();
      } catch (...) {
        output.failure = std::current_exception();
      }
      return true;
    });
    std::vector<std::string> files;
    for (const Output& output : m_outputs) {
      if (output.failure) std::rethrow_exception(output.failure);
      if (!output.file.empty()) files.push_back(output.file);
    }
    return files;
  }

private:
  struct Output
  {
    std::string file;
    std::function<void()> write;
    std::exception_ptr failure;
  };
  std::vector<Output> m_outputs;
};

// The vertices of the surface of a scan.
std::vector<Point> vertices_of(const Side& side)
{
  if (side.contents.kind != Scan_file::POINTS) return side.shown.points;
  const Mesh mesh = mesh_of(side.contents, side.viewpoint);
  return std::vector<Point>(mesh.points().begin(), mesh.points().end());
}

// A surface as it is written: as the file has it if it is a mesh, else triangulated, moved; with the colours of the
// file.
void write_surface(const std::string& file, const Side& side, const Transformation& motion)
{
  const Surface& shown = side.shown;
  if (side.contents.kind == Scan_file::RANGE_IMAGE) {
    write_triangles(file, shown.points, shown.triangles, colours_at(shown.points, side.contents), motion);
  } else {
    Mesh mesh = mesh_of(side.contents, side.viewpoint);
    add_colours(side.contents, mesh);
    CGAL::Polygon_mesh_processing::transform(motion, mesh);
    write_mesh(file, mesh);
  }
}

// Both surfaces in the frame of the target, and the motion.
void add_output(const std::string& folder, const std::array<Side, 2>& sides, const Transformation& motion,
                Outputs& outputs)
{
  make_folder(folder);
  const std::string names[2] = {in_folder(folder, "source_moved.ply"), in_folder(folder, "target.ply")};
  for (std::size_t i = 0; i < 2; ++i)
    outputs.add(names[i], [&sides, &motion, i, name = names[i]] {
      write_surface(name, sides[i], i == 0 ? motion : Transformation(CGAL::IDENTITY));
    });
  outputs.add(in_folder(folder, "motion.txt"), [&motion, name = in_folder(folder, "motion.txt")] {
    CR::write_file(name, [&](std::ostream& out) {
      write_rows(out, motion, "", "\n");
      out << "0 0 0 1\n";
    });
  });
}

// How the files were understood.
std::vector<std::string> notes_of(const std::array<Side, 2>& sides)
{
  std::vector<std::string> notes;
  for (const Side& side : sides)
    for (const std::string& note : side.contents.notes) notes.push_back(side.file + ": " + note);
  return notes;
}

void print_json(const std::array<Side, 2>& sides, const Answer& answer, const std::optional<Error>& error,
                const std::vector<std::string>& written, const std::string& hint, bool with_times)
{
  Json json = answer_of("register");
  json["source"] = sides[0].file;
  json["target"] = sides[1].file;
  add_result(json, answer.result, with_times);
  json["hint"] = hint;
  if (answer.is_scale_estimated) {
    json["estimated_scale"] = answer.scale;
    json["estimated_scale_deviation"] = answer.scale_deviation;
  }
  json["notes"] = notes_of(sides);
  if (error) json["error"] = {{"rotation_in_degrees", error->degrees}, {"rms_displacement", error->displacement}};
  if (with_times) {
    json["preparation_seconds"] = answer.preparation_seconds;
    json["search_seconds"] = answer.search_seconds;
  }
  json["written"] = written;
  std::cout << to_text(json) << '\n';
}

void print_text(const std::array<Side, 2>& sides, const Answer& answer, const std::optional<Error>& error,
                const std::vector<std::string>& written, const std::string& hint)
{
  const Result& result = answer.result;
  std::cout << "source:     " << sides[0].file << ", " << number_of_samples(sides[0].contents) << " samples\n"
            << "target:     " << sides[1].file << ", " << number_of_samples(sides[1].contents) << " samples\n"
            << "status:     " << result.status() << '\n';
  for (const std::string& note : notes_of(sides)) std::cout << "note:       " << note << '\n';
  if (!result.reason().empty()) std::cout << "reason:     " << result.reason() << '\n';
  if (!hint.empty()) std::cout << "hint:       " << hint << '\n';
  std::cout << std::setprecision(4) << "confidence: " << result.confidence() << '\n';
  for (const std::string& name : result.free_motions()) std::cout << "free:       " << name << '\n';
  if (answer.is_scale_estimated && result.status() != CR::NOT_REGISTERED)
    std::cout << "scale:      " << std::setprecision(6) << answer.scale
              << ", estimated: the source was multiplied by it, " << std::setprecision(1)
              << 100 * answer.scale_deviation << " % standard deviation\n"
              << std::setprecision(4);
  if (result.status() != CR::NOT_REGISTERED) {
    std::cout << "overlap:    " << 100 * result.overlap() << " % of the source\n"
              << "residual:   " << result.residual() << " sampling distances\n";
    if (error)
      std::cout << "error:      " << error->degrees << " degrees, " << error->displacement
                << " RMS displacement of the source\n";
    std::cout << "motion, from the frame of the source to that of the target:\n" << std::setprecision(12);
    write_rows(std::cout, result.transformation(), "  ", "\n");
    std::cout << "  0 0 0 1\n";
  }
  std::cout << std::setprecision(3) << "seconds:    " << answer.preparation_seconds << " preparation, "
            << answer.search_seconds << " search\n";
  for (const std::string& file : written) std::cout << "written:    " << file << '\n';
}

// The answer on a page to look at.
Pair_report report_of(const std::array<Side, 2>& sides, const Answer& answer, const std::optional<Error>& error,
                      const std::string& hint)
{
  const Result& result = answer.result;
  const std::array<const Scan*, 2> scans = {sides[0].scan.get(), sides[1].scan.get()};
  Pair_report report{"register", {&sides[0], &sides[1]}, scans, verdict_of(result, hint), numbers_of(result, scans)};
  if (answer.is_scale_estimated)
    report.numbers.push_back({"Scale", number_text(answer.scale),
                              "By how much the source was multiplied: an estimate, found with the motion."});
  if (error)
    report.numbers.push_back({"Error",
                              number_text(error->degrees) + " degrees, " + number_text(error->displacement) +
                                  " root mean square displacement",
                              "How far the answer is from the true motion of the file of poses."});
  report.poses = poses_of(result);
  report.have_common_frame = result.status() != CR::NOT_REGISTERED;
  report.correspondence = result.correspondence();
  return report;
}

std::optional<po::variables_map> parse_register(const std::vector<std::string>& arguments)
{
  po::options_description options("options");
  auto add = options.add_options();
  add("method", po::value<std::string>()->default_value("pairs"),
      "how motions are proposed: by pairs of oriented points of the reduced surfaces (pairs), or by spatial trihedra "
      "of the simplified meshes, the method of the paper (trihedra)");
  add("f1", po::value<double>(),
      "what is matched, pairs or the axes of trihedra, is no shorter than this share of the scan's size M; 0 if not "
      "given");
  add("f2", po::value<double>(),
      "and no longer than this share, about the least share of the scan that overlaps; 0.3 if not given");
  add("output", po::value<std::string>(),
      "folder for source_moved.ply, target.ply and motion.txt (the 4 x 4 matrix); "
      "made if missing, written unless the scans are not registered; with the colours of the scans");
  add("apply", po::value<std::string>(), apply_help);
  add("picture", po::value<std::string>(),
      "file (PNG) for a picture of both scans as they were registered, the source orange and the target blue; side by "
      "side if they are not");
  add("report", po::value<std::string>(),
      "file (HTML) for a page to look at the scans in, before and after, with all numbers explained and a section to "
      "move; it needs a browser and nothing else");
  add_options_of_sides(options);
  add("estimate-scale",
      "find the factor between the units of the two files, too, where nobody knows it: the source is multiplied by it, "
      "and the answer says so; slower, and less sure than the units are");
  add("poses", po::value<std::string>(), "file of true poses (FILE and a 3 x 4 matrix a line): print the error, too");
  add("time-budget", po::value<double>(),
      "seconds from the start after which preparation and search end, with the best so far");
  add("threads", po::value<int>(), "largest number of threads; the answer does not depend on it");
  add("json", "print JSON, the same bytes for the same scans");
  add("times", "add the times to the JSON");
  const Command command = {
      "register",
      "SOURCE TARGET",
      "Finds the rigid motion that maps SOURCE onto TARGET, and says whether it can be believed.\n"
      "Exit code: 0 registered, 2 ambiguous, 3 not registered, 1 error, 130 ended by Ctrl-C.\n",
      {{"source.ply target.ply", "prints the motion, and whether it can be believed"},
       {"source.obj target.obj --apply moved.obj", "writes the file of the source moved, with all that is in it"},
       {"a.xyz b.xyz --viewpoint 0,0,0 --json", "points that a sensor at the origin saw; the answer for programs"}},
      {{"method", "pairs trihedra"}, {"source-unit", "mm cm m in ft"}, {"target-unit", "mm cm m in ft"}}};
  return parse(command, options, {"SOURCE", "TARGET"}, arguments);
}

} // namespace

int run_register(const std::vector<std::string>& arguments)
{
  const auto given = parse_register(arguments);
  if (!given) return 0;
  const po::variables_map& map = *given;

  limit_threads(map);
  const double time_budget = time_budget_of(map);
  const std::optional<double> f1 = value_of<double>(map, "f1"), f2 = value_of<double>(map, "f2");
  const std::string method = map["method"].as<std::string>();
  const auto poses_file = value_of<std::string>(map, "poses"), output = value_of<std::string>(map, "output");
  const auto picture = value_of<std::string>(map, "picture");
  check_picture(picture);
  const auto report = value_of<std::string>(map, "report");
  if (report) check_output(*report);
  const auto poses = poses_file ? read_poses(*poses_file) : std::map<std::string, Transformation>();

  const bool estimate_scale = map.count("estimate-scale") > 0;
  if (estimate_scale && map.count("source-unit") > 0)
    throw Usage_error("--estimate-scale finds what --source-unit and --target-unit say: give the one or the others");
  std::array<Side, 2> sides;
  const std::array<Scan_of_a_side, 2> given_sides = sides_of(map);
  for (std::size_t i = 0; i < 2; ++i) static_cast<Scan_of_a_side&>(sides[i]) = given_sides[i];
  const auto applied = apply_option(map, sides[0].file);
  const bool are_shown = picture || output || poses_file;
  watch_for_interruption();
  Progress progress;
  const Answer answer = [&] {
    if (method == "pairs")
      return register_files(sides, generator_with<CR::Oriented_pair_candidates>(f1, f2), time_budget, estimate_scale,
                            are_shown, progress);
    if (method == "trihedra")
      return register_files(sides, generator_with<CR::Trihedron_candidates>(f1, f2), time_budget, estimate_scale,
                            are_shown, progress);
    throw Usage_error("--method takes pairs or trihedra, not '" + method + "'");
  }();
  const Result& result = answer.result;

  progress.begin_stage("writing");
  const bool is_registered = result.status() != CR::NOT_REGISTERED;
  const Transformation& motion = result.transformation();
  const std::string hint = result.status() == CR::REGISTERED || estimate_scale ? "" : hint_of(sides);
  if (picture || (is_registered && (output || poses_file)))
    CGAL::for_each<CGAL::Parallel_if_available_tag>(sides, [&](Side& side) {
      if (side.shown.points.empty()) side.shown = surface_to_show(side.contents, side.scan.get());
      return true;
    });
  std::optional<Error> error;
  if (is_registered && poses_file) {
    const auto s = poses.find(base_name(sides[0].file)), t = poses.find(base_name(sides[1].file));
    if (s == poses.end() || t == poses.end()) throw CR::IO_error(*poses_file, "a pose of the two scans is missing");
    error = error_of(motion, t->second.inverse() * s->second, vertices_of(sides[0]));
  }

  Outputs outputs;
  if (output && is_registered) add_output(*output, sides, motion, outputs);
  std::string note;
  if (applied && is_registered)
    outputs.add(*applied, [&] {
      const Transformation in_unit(CGAL::SCALING, sides[0].unit);
      note = apply(sides[0].file, *applied, motion * in_unit, sides[0].scan->spacing());
    });
  if (picture)
    outputs.add(*picture, [&] {
      write_picture(*picture, {{&sides[0].shown, motion}, {&sides[1].shown, Transformation(CGAL::IDENTITY)}},
                    is_registered);
    });
  std::optional<Pair_page> page;
  if (report) {
    page.emplace(report_of(sides, answer, error, hint));
    outputs.add("", [&] {
      page->prepare();
      if (!applied) page->write(*report, notes_of(sides)); // else there may be one note more
    });
  }
  std::vector<std::string> written = outputs.write();
  progress.clear();
  if (!note.empty()) sides[0].contents.notes.push_back(note);
  if (page) {
    if (applied) page->write(*report, notes_of(sides));
    written.push_back(*report);
  }
  if (map.count("json") > 0) print_json(sides, answer, error, written, hint, map.count("times") > 0);
  else print_text(sides, answer, error, written, hint);
  switch (result.status()) {
  case CR::REGISTERED:
    return EXIT_REGISTERED;
  case CR::AMBIGUOUS:
    return EXIT_AMBIGUOUS;
  case CR::NOT_REGISTERED:
    break;
  }
  return EXIT_NOT_REGISTERED;
}
