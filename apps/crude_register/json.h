// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CRUDE_REGISTER_JSON_H
#define CRUDE_REGISTER_JSON_H

// The answer of a registration as JSON.

#include <CGAL/Crude_registration/Registration_result.h>

#include <CGAL/number_utils.h>

#include <nlohmann/json.hpp>

#include <sstream>
#include <string>

// Members stay in the order in which they are added.
using Json = nlohmann::ordered_json;

// The text of a value: the same values give the same bytes, whatever the locale. Doubles are read back the same; those
// that are not finite become null, and bytes of a file's name that are not UTF-8 the replacement character.
inline std::string to_text(const Json& json)
{
  constexpr int indent = 2;
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

// The answer of a command, as yet empty: crude_register.schema.json describes it. The version is to be raised where
// members change or go, not where some are added.
inline Json answer_of(const std::string& command)
{
  constexpr int schema_version = 1;
  return {{"schema_version", schema_version}, {"command", command}};
}

// The three rows of the matrix of a motion.
template <class Kernel>
Json to_json(const CGAL::Aff_transformation_3<Kernel>& motion)
{
  Json rows = Json::array();
  for (int i = 0; i < 3; ++i) {
    Json row = Json::array();
    for (int j = 0; j < 4; ++j) row.push_back(CGAL::to_double(motion.m(i, j)));
    rows.push_back(row);
  }
  return rows;
}

// Points of the source, each with the one of the target that it was matched with.
template <class Point>
Json to_json(const std::vector<std::pair<Point, Point>>& correspondence)
{
  Json points = Json::array();
  for (const auto& [s, t] : correspondence) points.push_back({{s.x(), s.y(), s.z()}, {t.x(), t.y(), t.z()}});
  return points;
}

// Adds the members of a result to an object. The times, which differ from run to run, are left out unless asked for:
// all else is the same, byte for byte, for the same input.
template <class Kernel>
void add_result(Json& json, const CGAL::Crude_registration::Registration_result<Kernel>& result, bool with_times)
{
  std::ostringstream status;
  status << result.status();
  json["status"] = status.str();
  json["reason"] = result.reason();
  json["confidence"] = result.confidence();
  json["score"] = result.score();
  json["overlap"] = result.overlap();
  json["residual"] = result.residual();
  json["free_space_violations"] = result.free_space_violations();
  json["source_has_free_space"] = result.source_has_free_space();
  json["target_has_free_space"] = result.target_has_free_space();
  json["target_from_source"] = to_json(result.transformation());
  json["crude_target_from_source"] = to_json(result.crude_transformation());
  json["correspondence"] = to_json(result.correspondence());
  json["covariance"] = result.covariance();
  json["free_motions"] = result.free_motions();
  Json& runners_up = json["runners_up"] = Json::array();
  for (const auto& runner_up : result.runners_up())
    runners_up.push_back({{"score", runner_up.score},
                          {"probability", runner_up.probability},
                          {"target_from_source", to_json(runner_up.transformation)}});
  Json& statistics = json["statistics"] = Json::array();
  for (const auto& stage : result.statistics()) {
    Json& entry = statistics.emplace_back(Json{{"stage", stage.name}, {"count", stage.count}});
    if (with_times) entry["seconds"] = stage.seconds;
  }
}

#endif // CRUDE_REGISTER_JSON_H
