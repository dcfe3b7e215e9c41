// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "report_assembly.h"

#include "report_page.h"
#include "report_scans.h"

#include <CGAL/Crude_registration/Judgement_limits.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace {

Report_verdict verdict_of(const Assembly& result)
{
  const std::size_t scans = result.number_of_scans(), components = result.number_of_components();
  std::size_t together = 0, alone = 0;
  for (std::size_t i = 0; i < scans; ++i) {
    together += result.component(i) == 0;
    alone += !result.scans()[i].reason.empty();
  }
  const std::string interrupted =
      result.is_interrupted() ? " The run was ended before it was done: this is what had been found." : "";
  if (scans == 1) return {"good", "There is one scan", "It is the whole model." + interrupted};
  if (components <= 1)
    return {result.is_interrupted() ? "doubtful" : "good", "All scans are connected",
            "The " + std::to_string(scans) + " scans lie in one frame." + interrupted};
  if (together <= 1)
    return {"bad", "No scans are connected",
            "None of the " + std::to_string(scans) +
                " scans could be connected with another one with certainty: see below why." + interrupted};
  std::string text =
      std::to_string(together) + " of the " + std::to_string(scans) +
      " scans are connected; what could not be connected with certainty stays apart: " + std::to_string(components) +
      " components, ";
  text += alone == 1 ? "one scan alone." : std::to_string(alone) + " scans alone.";
  return {"doubtful", "Some scans are connected", text + interrupted};
}

std::vector<Report_number> numbers_of(const Assembly& result, const std::vector<CR::Scan<Kernel>>& scans)
{
  std::size_t used = 0, together = 0, pairs = 0;
  for (const auto& e : result.edges()) used += e.status == CR::USED;
  double squares = 0, weights = 0, largest = 0;
  for (std::size_t i = 0; i < result.number_of_scans(); ++i) together += result.component(i) == 0;
  for (const auto& o : result.overlaps()) {
    squares += o.overlap * o.residual * o.residual;
    weights += o.overlap;
    largest = (std::max)(largest, o.residual);
    ++pairs;
  }
  std::vector<double> spacings;
  for (const auto& scan : scans) spacings.push_back(scan.spacing());
  const auto [least, most] = std::minmax_element(spacings.begin(), spacings.end());
  std::vector<Report_number> numbers = {
      {"Scans", std::to_string(result.number_of_scans()), "How many were given."},
      {"Components", std::to_string(result.number_of_components()),
       "Groups of scans that lie in a frame of their own, the largest first; the frame is that of the first of the "
       "scans."},
      {"Largest component", std::to_string(together) + " scans", "What the view shows at first."},
      {"Pairs registered", std::to_string(result.edges().size()) + ", of which " + std::to_string(used) + " are used",
       "A pair is used where a motion that its registration found is that of the model."}};
  if (pairs > 0)
    numbers.push_back(
        {"Residual",
         number_text(std::sqrt(squares / weights)) + " sampling distances, the largest of a pair " +
             number_text(largest),
         "The root mean square distance along the normals between scans where they overlap. What is left is noise, and "
         "how far apart the samples are; a pair that is far above the others is worth a look."});
  if (!spacings.empty())
    numbers.push_back({"Sampling distance", number_text(*least) + " to " + number_text(*most),
                       "The root of the area per sample, in the unit of the coordinates."});
  return numbers;
}

// What the points of a scan meet in the others of its component.
std::vector<Other_scan> others_of(std::size_t scan, const Assembly& result, const std::vector<CR::Scan<Kernel>>& scans)
{
  std::vector<Other_scan> others;
  for (std::size_t j = 0; j < scans.size(); ++j)
    if (j != scan && result.component(j) == result.component(scan))
      others.push_back({&scans[j], result.pose(j).inverse() * result.pose(scan)});
  return others;
}

} // namespace

void write_assembly_report(const std::string& file, const Assembly& result, const std::vector<CR::Scan<Kernel>>& scans,
                           const std::vector<std::string>& names,
                           const std::function<std::vector<Point>(std::size_t)>& points,
                           const std::function<Surface(std::size_t)>& surface)
{
  std::vector<Report_scan> shown;
  double spacing = 0;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    shown.push_back({names[i], &scans[i]});
    shown.back().points = points(i);
    spacing = (std::max)(spacing, scans[i].spacing());
  }
  thin_out(shown, 1);
  const double reach = CR::Judgement_limits::residual_reach * spacing;
  const Report_verdict verdict = verdict_of(result);
  Report_bytes bytes;
  Json data = {{"kind", "assembly"}, {"command", "assemble"}, {"verdict", to_json(verdict)}};
  data["spacing"] = spacing;
  data["reach_in_spacings"] = CR::Judgement_limits::residual_reach;
  data["free_space_depth_in_spacings"] = CR::Judgement_limits::free_space_depth;
  data["steps_of_reach"] = steps_of_reach;
  data["have_common_frame"] = true;
  data["notes"] = Json::array();
  data["numbers"] = to_json(numbers_of(result, scans));
  data["components"] = result.number_of_components();
  Json pose = {{"name", "Model"}, {"meaning", "All scans in the frames of their components."}};
  for (std::size_t i = 0; i < scans.size(); ++i) {
    Json scan = bytes.add_scan(shown[i], i);
    const auto& placed = result.scans()[i];
    scan["component"] = placed.component;
    scan["residual"] = placed.residual;
    scan["reason"] = placed.reason;
    data["scans"].push_back(scan);
    pose["motions"].push_back(to_json(placed.pose));
    bytes.add_meetings(
        0, i, shown[i], [&result, &scans, i] { return others_of(i, result, scans); }, reach);
  }
  data["poses"] = {pose};
  data["edges"] = rows_of_edges(result);
  data["overlaps"] = rows_of_overlaps(result);

  bytes.make();
  std::vector<Surface> surfaces;
  const std::string pictures = static_pictures([&](bool is_after) {
    std::vector<Placed_surface> placed;
    surfaces.clear();
    surfaces.reserve(scans.size());
    for (std::size_t i = 0; i < scans.size(); ++i) {
      if (result.component(i) != 0) continue;
      surfaces.push_back(surface(i));
      placed.push_back({&surfaces.back(), is_after ? result.pose(i) : Transformation(CGAL::IDENTITY)});
    }
    return Report_picture(std::move(placed), is_after);
  });
  write_report(file, "Assembly of " + std::to_string(scans.size()) + " scans", verdict, data, bytes, pictures);
}
