// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// crude_register judge: says of a motion that somebody found whether it brings two scans together.

#include "apply.h"
#include "commands.h"
#include "files.h"
#include "json.h"
#include "options.h"
#include "progress.h"
#include "report_pair.h"
#include "sides.h"

#include <CGAL/Crude_registration/judge_motion.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <iterator>
#include <limits>
#include <locale>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using Scan = CR::Scan<Kernel>;

// The motion of a file: the rows of a 3 x 4 or a 4 x 4 matrix, or what register --json has printed.
Transformation read_motion(const std::string& file)
{
  std::ifstream in(file);
  if (!in) throw CR::IO_error(file, "the file cannot be opened");
  const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  std::vector<double> m;
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first != std::string::npos && text[first] == '{') {
    try {
      const Json json = Json::parse(text); // outlives the loop
      for (const Json& row : json.at("target_from_source"))
        for (const Json& x : row) m.push_back(x.get<double>());
    } catch (const Json::exception& e) {
      throw CR::IO_error(file, std::string("the JSON has no motion target_from_source: ") + e.what());
    }
  } else {
    std::istringstream words(text);
    words.imbue(std::locale::classic());
    for (double x = 0; words >> x;) m.push_back(x);
    if (!words.eof()) throw CR::IO_error(file, "12 or 16 numbers are expected, the rows of a matrix, and nothing else");
  }
  const bool has_last_row = m.size() == 16;
  if (!has_last_row && m.size() != 12)
    throw CR::IO_error(file, "12 or 16 numbers are expected, the rows of a matrix, not " + std::to_string(m.size()));
  if (has_last_row && !(m[12] == 0 && m[13] == 0 && m[14] == 0 && m[15] == 1))
    throw CR::IO_error(file, "the last row of the matrix is not 0 0 0 1");
  return Transformation(m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8], m[9], m[10], m[11]);
}

Scan scan_of(Scan_of_a_side& side, Progress& progress)
{
  side.read();
  return with_viewpoint(side.viewpoint, [&](const auto& np) {
    return Scan(side.contents, np.visitor(Terminal_visitor(progress)), side.file);
  });
}

int exit_code_of(CR::Motion_status status)
{
  switch (status) {
  case CR::RIGHT_MOTION:
    return EXIT_REGISTERED;
  case CR::REFINABLE_MOTION:
    return EXIT_AMBIGUOUS;
  case CR::WRONG_MOTION:
    break;
  }
  return EXIT_NOT_REGISTERED;
}

// The given motion and what refinement makes of it, to look at, and the rivals.
void write_page(const std::string& file, const std::array<Scan_of_a_side, 2>& sides,
                const std::array<const Scan*, 2>& scans, const Transformation& motion,
                const CR::Motion_judgement<Kernel>& judgement)
{
  const auto& refined = judgement.refined();
  Pair_report report{"judge", {&sides[0], &sides[1]}, scans, verdict_of(judgement), numbers_of(refined, scans)};
  report.numbers.insert(report.numbers.begin(),
                        {"Displacement", number_text(judgement.displacement()) + " sampling distances",
                         "How far the motion is from what refinement makes of it, root mean square where the scans "
                         "overlap. The numbers that follow are those of the refined motion."});
  report.have_common_frame = true;
  report.poses.push_back({"Given", "The motion that was given.", std::nullopt, motion});
  if (judgement.status() != CR::WRONG_MOTION)
    report.poses.push_back({"Refined", "What refinement makes of it.", refined.confidence(), refined.transformation()});
  add_rivals(refined, report.poses);
  Pair_page page(std::move(report));
  page.prepare();
  page.write(file, {});
}

} // namespace

int run_judge(const std::vector<std::string>& arguments)
{
  po::options_description options("options");
  auto add = options.add_options();
  add("motion", po::value<std::string>()->required(),
      "file of the motion that maps SOURCE onto TARGET: the rows of a 3 x 4 or 4 x 4 matrix, or the JSON of register");
  add("apply", po::value<std::string>(),
      (apply_help + std::string("; by what refinement makes of the motion, written unless it is wrong")).c_str());
  add("report", po::value<std::string>(),
      "file (HTML) for a page to look at the scans as the motion moves them; it needs a browser and nothing else");
  add_options_of_sides(options);
  add("json", "print JSON, the same bytes for the same scans");
  const Command command = {
      "judge",
      "SOURCE TARGET --motion FILE",
      "Says of a motion that somebody found whether it maps SOURCE onto TARGET.\n"
      "Exit code: 0 right, 2 refinable, 3 wrong, 1 error, 130 ended by Ctrl-C.\n",
      {{"source.ply target.ply --motion motion.txt", "says whether a matrix of another program is right"},
       {"source.ply target.ply --motion answer.json", "the same of what register --json has printed"}},
      {{"source-unit", "mm cm m in ft"}, {"target-unit", "mm cm m in ft"}}};
  const auto given = parse(command, options, {"SOURCE", "TARGET"}, arguments);
  if (!given) return 0;
  const po::variables_map& map = *given;
  std::array<Scan_of_a_side, 2> sides = sides_of(map);
  const std::string source = sides[0].file, target = sides[1].file, file = map["motion"].as<std::string>();
  const auto page = value_of<std::string>(map, "report");
  if (page) check_output(*page);
  const Transformation motion = read_motion(file);
  const auto applied = apply_option(map, source);
  watch_for_interruption();
  Progress progress;
  progress.begin_stage("reading and preparing the scans");
  const Scan source_scan = scan_of(sides[0], progress), target_scan = scan_of(sides[1], progress);
  progress.begin_stage("judging");
  const auto judged = [&] {
    try {
      return CR::judge_motion<CGAL::Parallel_if_available_tag>(source_scan, target_scan, motion,
                                                               CR::parameters::visitor(Terminal_visitor(progress)));
    } catch (const std::invalid_argument& e) {
      throw CR::IO_error(file, e.what());
    }
  };
  const CR::Motion_judgement<Kernel> judgement = judged();
  progress.clear();
  if (is_interrupted()) throw std::runtime_error("interrupted before the motion was judged");
  const auto& refined = judgement.refined();
  if (page) write_page(*page, sides, {&source_scan, &target_scan}, motion, judgement);
  std::ostringstream status;
  status << judgement.status();
  std::string note;
  if (applied && judgement.status() != CR::WRONG_MOTION)
    note = apply(source, *applied, refined.transformation() * Transformation(CGAL::SCALING, sides[0].unit),
                 source_scan.spacing());
  if (map.count("json") > 0) {
    Json json = answer_of("judge");
    json["source"] = source;
    json["target"] = target;
    json["motion"] = file;
    json["verdict"] = status.str();
    json["displacement"] = judgement.displacement();
    add_result(json["refined"], refined, false);
    json["notes"] = note.empty() ? Json::array() : Json::array({note});
    json["written"] = Json::array();
    if (applied && judgement.status() != CR::WRONG_MOTION) json["written"].push_back(*applied);
    std::cout << to_text(json) << '\n';
    return exit_code_of(judgement.status());
  }
  std::cout << "verdict:      " << status.str() << '\n' << std::setprecision(4);
  if (!refined.reason().empty()) std::cout << "reason:       " << refined.reason() << '\n';
  std::cout << "confidence:   " << judgement.confidence() << '\n';
  for (const std::string& name : refined.free_motions()) std::cout << "free:         " << name << '\n';
  if (judgement.status() != CR::WRONG_MOTION) {
    std::cout << "displacement: " << judgement.displacement()
              << " sampling distances from what refinement makes of it\n"
              << "overlap:      " << 100 * refined.overlap() << " % of the source\n"
              << "residual:     " << refined.residual() << " sampling distances\n"
              << "violations:   " << 100 * refined.free_space_violations() << " % in free space\n"
              << "refined, from the frame of the source to that of the target:\n"
              << std::setprecision(12);
    write_rows(std::cout, refined.transformation(), "  ", "\n");
    std::cout << "  0 0 0 1\n";
    if (!note.empty()) std::cout << "note:         " << note << '\n';
    if (applied) std::cout << "written:      " << *applied << '\n';
  }
  return exit_code_of(judgement.status());
}
