// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "report_pair.h"

#include "files.h"
#include "surfaces.h"

#include <CGAL/Crude_registration/Judgement_limits.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace {

double coarser_spacing(const std::array<const CR::Scan<Kernel>*, 2>& scans)
{
  double spacing = 0;
  for (const auto* scan : scans)
    if (scan != nullptr) spacing = (std::max)(spacing, scan->spacing());
  return spacing;
}

// What independent noise leaves of a motion: of its turn, and of the place of a point of the target's frame.
struct Motion_scatter
{
  double degrees, displacement;
};

Motion_scatter scatter_of(const CR::Registration_result<Kernel>::Covariance& covariance, const Point& place)
{
  Eigen::Matrix<double, 6, 6> c;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) c(i, j) = covariance[std::size_t(i)][std::size_t(j)];
  Eigen::Matrix<double, 3, 6> moves; // x -> x + w x p + v
  moves << 0, place.z(), -place.y(), 1, 0, 0, -place.z(), 0, place.x(), 0, 1, 0, place.y(), -place.x(), 0, 0, 0, 1;
  constexpr double degrees = 180 / CGAL_PI;
  return {degrees * std::sqrt((std::max)(0., c.topLeftCorner<3, 3>().trace())),
          std::sqrt((std::max)(0., (moves * c * moves.transpose()).trace()))};
}

Point middle_of(const CR::Scan<Kernel>& scan)
{
  const std::vector<Point> points = scan.points();
  CGAL::Vector_3<Kernel> sum = CGAL::NULL_VECTOR;
  for (const Point& p : points) sum = sum + (p - CGAL::ORIGIN);
  return CGAL::ORIGIN + sum / double((std::max)(points.size(), std::size_t(1)));
}

} // namespace

void add_rivals(const CR::Registration_result<Kernel>& result, std::vector<Report_pose>& poses)
{
  constexpr std::size_t most = 6;
  const auto& rivals = result.runners_up();
  for (std::size_t i = 0; i < (std::min)(most, rivals.size()); ++i)
    poses.push_back(
        {"Runner-up " + std::to_string(i + 1),
         "A distinct motion that was looked at closely, too, with the probability that it is the right one.",
         rivals[i].probability, rivals[i].transformation});
}

std::vector<Report_pose> poses_of(const CR::Registration_result<Kernel>& result)
{
  std::vector<Report_pose> poses;
  const bool has_answer = result.status() != CR::NOT_REGISTERED;
  if (has_answer)
    poses.push_back({"Answer", "The most probable motion, refined.", result.confidence(), result.transformation()});
  add_rivals(result, poses);
  if (has_answer)
    poses.push_back({"As proposed", "The answer before refinement: how the search found it.", std::nullopt,
                     result.crude_transformation()});
  return poses;
}

std::vector<Report_number> numbers_of(const CR::Registration_result<Kernel>& result,
                                      const std::array<const CR::Scan<Kernel>*, 2>& scans)
{
  std::vector<Report_number> numbers;
  const auto add = [&](const std::string& name, const std::string& value, const std::string& meaning) {
    numbers.push_back({name, value, meaning});
  };
  const double spacing = coarser_spacing(scans);
  add("Confidence", per_cent(result.confidence()),
      "The probability that the motion is right. From " + per_cent(CR::Judgement_limits::believed) +
          " on it is called registered; if the probability that any motion is right is below " +
          per_cent(CR::Judgement_limits::plausible) + ", none is given.");
  if (result.status() != CR::NOT_REGISTERED) {
    add("Overlap", per_cent(result.overlap()),
        "The share of the source's surface that has the target close by, facing the same way.");
    add("Residual",
        number_text(result.residual()) + " sampling distances (" + number_text(result.residual() * spacing) + ")",
        "The root mean square distance of the surfaces, along their normals, where one is within " +
            number_text(CR::Judgement_limits::residual_reach) +
            " sampling distances of the other. What is left is noise, and how far apart the samples are.");
    add("In free space", per_cent(result.free_space_violations()),
        "The share of the source that lies where the target's sensor saw that there is nothing (more than " +
            number_text(CR::Judgement_limits::free_space_depth) +
            " sampling distances in front of what it saw), plus that of the target before the source's sensor. Of a "
            "right motion it is next to nothing.");
    const Transformation& m = result.transformation();
    Eigen::Matrix3d rotation;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) rotation(i, j) = m.m(i, j);
    add("Turn", number_text(Eigen::AngleAxisd(rotation).angle() * 180 / CGAL_PI, 4) + " degrees",
        "By how much the motion turns the source.");
    if (scans[0] != nullptr) {
      const Point middle = m.transform(middle_of(*scans[0]));
      const Motion_scatter scatter = scatter_of(result.covariance(), middle);
      add("Scatter",
          number_text(scatter.degrees, 2) + " degrees, " + number_text(scatter.displacement, 2) +
              " at the middle of the source",
          "How well the motion is known as far as independent noise of the samples goes (one standard deviation); "
          "errors that a scanner makes in all of its scans are not in it.");
    }
  }
  add("Score", number_text(result.score()),
      "The natural logarithm of the odds that the best motion is right, against none being right.");
  const char* const names[2] = {"source", "target"};
  for (std::size_t i = 0; i < 2; ++i) {
    const CR::Scan<Kernel>* scan = scans[i];
    if (scan == nullptr) continue;
    add(std::string("Sampling of the ") + names[i],
        std::to_string(scan->number_of_samples()) + " samples, " + number_text(scan->spacing()) + " apart",
        std::string("The sampling distance is the root of the area per sample, in the unit of the coordinates. What ") +
            "the sensor saw to be empty is " + (scan->has_free_space() ? "known." : "not known."));
  }
  return numbers;
}

Report_verdict verdict_of(const CR::Registration_result<Kernel>& result, const std::string& hint)
{
  const std::string end = hint.empty() ? "" : " Hint: " + hint + ".";
  std::string free;
  for (const std::string& name : result.free_motions()) free += (free.empty() ? " Free: " : "; ") + name;
  if (!free.empty()) free += ".";
  switch (result.status()) {
  case CR::REGISTERED:
    return {"good", "Registered",
            "One motion brings the scans together, and it can be believed: it is right with a probability of " +
                per_cent(result.confidence()) + "." + end};
  case CR::AMBIGUOUS:
    return {"doubtful", "Ambiguous",
            "The best motion is right with a probability of " + per_cent(result.confidence()) +
                " only: " + result.reason() + "." + free + " Look at the poses, and judge by eye." + end};
  case CR::NOT_REGISTERED:
    break;
  }
  return {"bad", "Not registered", "No motion is given: " + result.reason() + "." + end};
}

Report_verdict verdict_of(const CR::Motion_judgement<Kernel>& judgement)
{
  const auto& refined = judgement.refined();
  const std::string off = number_text(judgement.displacement()) + " sampling distances";
  std::string reason = refined.reason().empty() ? "" : " But mind: " + refined.reason() + ".";
  switch (judgement.status()) {
  case CR::RIGHT_MOTION:
    return {refined.status() == CR::REGISTERED ? "good" : "doubtful", "The motion is right",
            "It brings the scans together: refinement moves the overlap by no more than " + off +
                ", and what it leads to is right with a probability of " + per_cent(judgement.confidence()) + "." +
                reason};
  case CR::REFINABLE_MOTION:
    return {"doubtful", "The motion is refinable",
            "It is " + off + " off from what refinement makes of it, which is right with a probability of " +
                per_cent(judgement.confidence()) + ". Take the refined motion." + reason};
  case CR::WRONG_MOTION:
    break;
  }
  return {"bad", "The motion is wrong",
          "Neither it nor what refinement makes of it can be told from chance: " + refined.reason() + "."};
}

void Pair_page::prepare()
{
  for (std::size_t i = 0; i < 2; ++i) {
    Report_scan scan{base_name(m_report.sides[i]->file), m_report.scans[i]};
    scan.points = points_of(m_report.sides[i]->contents);
    m_scans.push_back(std::move(scan));
  }
  thin_out(m_scans, m_report.poses.size());
  add_data();
  m_bytes.make();
  std::array<Surface, 2> surfaces;
  m_pictures = static_pictures([&](bool is_after) -> Report_picture {
    for (std::size_t i = 0; i < 2; ++i) surfaces[i] = surface_to_show(m_report.sides[i]->contents, m_report.scans[i]);
    const bool is_together = is_after && m_report.have_common_frame;
    const Transformation identity(CGAL::IDENTITY);
    return {{{&surfaces[0], is_together ? m_report.poses.front().motion : identity}, {&surfaces[1], identity}},
            is_together};
  });
}

void Pair_page::write(const std::string& file, const std::vector<std::string>& notes)
{
  m_data["notes"] = notes;
  write_report(file, m_scans[0].name + " to " + m_scans[1].name, m_report.verdict, m_data, m_bytes, m_pictures);
}

void Pair_page::add_data()
{
  const double spacing = coarser_spacing(m_report.scans), reach = CR::Judgement_limits::residual_reach * spacing;
  m_data = {{"kind", "pair"}, {"command", m_report.command}, {"verdict", to_json(m_report.verdict)}};
  m_data["spacing"] = spacing;
  m_data["reach_in_spacings"] = CR::Judgement_limits::residual_reach;
  m_data["free_space_depth_in_spacings"] = CR::Judgement_limits::free_space_depth;
  m_data["steps_of_reach"] = steps_of_reach;
  m_data["have_common_frame"] = m_report.have_common_frame;
  m_data["numbers"] = to_json(m_report.numbers);
  m_data["correspondence"] = to_json(m_report.correspondence);
  for (std::size_t i = 0; i < 2; ++i) {
    Json scan = m_bytes.add_scan(m_scans[i], i);
    scan["role"] = i == 0 ? "source" : "target";
    m_data["scans"].push_back(scan);
  }
  m_data["poses"] = Json::array();
  for (std::size_t k = 0; k < m_report.poses.size(); ++k) {
    const Report_pose& pose = m_report.poses[k];
    m_data["poses"].push_back(
        {{"name", pose.name}, {"meaning", pose.meaning}, {"motions", {to_json(pose.motion), nullptr}}});
    if (pose.probability) m_data["poses"].back()["probability"] = *pose.probability;
    for (std::size_t i = 0; i < 2; ++i)
      m_bytes.add_meetings(
          k, i, m_scans[i],
          [this, &pose, i] {
            return std::vector<Other_scan>{{m_scans[1 - i].scan, i == 0 ? pose.motion : pose.motion.inverse()}};
          },
          reach);
  }
}
