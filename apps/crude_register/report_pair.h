// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CRUDE_REGISTER_REPORT_PAIR_H
#define CRUDE_REGISTER_REPORT_PAIR_H

// The report of two scans: of what a registration found, or of what is to be said of a given motion.

#include "report_page.h"
#include "report_scans.h"
#include "sides.h"
#include "surfaces.h"

#include <CGAL/Crude_registration/Judgement_limits.h>
#include <CGAL/Crude_registration/Registration_result.h>
#include <CGAL/Crude_registration/Scan.h>
#include <CGAL/Crude_registration/judge_motion.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

// What is on the page of two scans.
struct Pair_report
{
  std::string command; // register or judge
  std::array<const Scan_of_a_side*, 2> sides;
  std::array<const CR::Scan<Kernel>*, 2> scans; // null where there was no time to prepare one
  Report_verdict verdict;
  std::vector<Report_number> numbers;
  std::vector<Report_pose> poses =
      {};                         // the first is looked at first; of no scans that are not registered there may be none
  bool have_common_frame = false; // the first pose is one that may be believed
  CR::Registration_result<Kernel>::Correspondence correspondence = {}; // that the first pose comes from, if known
};

inline double coarser_spacing(const std::array<const CR::Scan<Kernel>*, 2>& scans)
{
  double spacing = 0;
  for (const auto* scan : scans)
    if (scan != nullptr) spacing = (std::max)(spacing, scan->spacing());
  return spacing;
}

// Runners-up that say something: more are not shown.
inline void add_rivals(const CR::Registration_result<Kernel>& result, std::vector<Report_pose>& poses)
{
  constexpr std::size_t most = 6;
  const auto& rivals = result.runners_up();
  for (std::size_t i = 0; i < (std::min)(most, rivals.size()); ++i)
    poses.push_back(
        {"Runner-up " + std::to_string(i + 1),
         "A distinct motion that was looked at closely, too, with the probability that it is the right one.",
         rivals[i].probability, rivals[i].transformation});
}

// The poses of a registration: the answer, its rivals, and what refinement started from.
inline std::vector<Report_pose> poses_of(const CR::Registration_result<Kernel>& result)
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

// What independent noise leaves of a motion: of its turn, and of the place of a point of the target's frame.
struct Motion_scatter
{
  double degrees, displacement;
};

inline Motion_scatter scatter_of(const CR::Registration_result<Kernel>::Covariance& covariance, const Point& place)
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

inline Point middle_of(const CR::Scan<Kernel>& scan)
{
  const std::vector<Point> points = scan.points();
  CGAL::Vector_3<Kernel> sum = CGAL::NULL_VECTOR;
  for (const Point& p : points) sum = sum + (p - CGAL::ORIGIN);
  return CGAL::ORIGIN + sum / double((std::max)(points.size(), std::size_t(1)));
}

inline std::vector<Report_number> numbers_of(const CR::Registration_result<Kernel>& result,
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

inline Report_verdict verdict_of(const CR::Registration_result<Kernel>& result, const std::string& hint)
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

inline Report_verdict verdict_of(const CR::Motion_judgement<Kernel>& judgement)
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

// The page, made in two steps: what takes time, and what is known last.
class Pair_page
{
public:
  explicit Pair_page(Pair_report report) : m_report(std::move(report)) {}

  void prepare()
  {
    for (std::size_t i = 0; i < 2; ++i) {
      Report_scan scan{base_name(m_report.sides[i]->file), m_report.scans[i]};
      scan.points = points_of(m_report.sides[i]->contents);
      m_scans.push_back(std::move(scan));
    }
    thin_out(m_scans, m_report.poses.size());
    add_data();
    m_blocks = m_bytes.html();
    m_pictures = static_pictures([&](bool is_after) {
      std::vector<Surface> surfaces;
      for (std::size_t i = 0; i < 2; ++i)
        surfaces.push_back(surface_to_show(m_report.sides[i]->contents, m_report.scans[i]));
      const bool is_together = is_after && m_report.have_common_frame;
      if (is_together) move(surfaces[0], m_report.poses.front().motion);
      return std::make_pair(std::move(surfaces), is_together);
    });
  }

  // `notes`: how the files were understood, and how what else was written has to be.
  void write(const std::string& file, const std::vector<std::string>& notes)
  {
    m_data["notes"] = notes;
    write_report(file, m_scans[0].name + " to " + m_scans[1].name, m_report.verdict, m_data, m_blocks, m_pictures);
  }

private:
  void add_data()
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
      Json scan = add_scan(m_scans[i], i, m_bytes);
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
        m_bytes.add("met_" + std::to_string(k) + "_" + std::to_string(i), [this, &pose, reach, i] {
          const Other_scan other{m_scans[1 - i].scan, i == 0 ? pose.motion : pose.motion.inverse()};
          return packed_meetings(meetings_of(m_scans[i], {other}), reach);
        });
    }
  }

  Pair_report m_report;
  std::vector<Report_scan> m_scans;
  Report_bytes m_bytes;
  Json m_data;
  std::string m_blocks, m_pictures;
};

#endif // CRUDE_REGISTER_REPORT_PAIR_H
