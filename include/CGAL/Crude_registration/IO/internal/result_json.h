// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_IO_INTERNAL_RESULT_JSON_H
#define CGAL_CRUDE_REGISTRATION_IO_INTERNAL_RESULT_JSON_H

#include <CGAL/Crude_registration/Registration_result.h>
#include <CGAL/Crude_registration/IO/internal/Json_writer.h>

#include <array>
#include <sstream>
#include <string>

namespace CGAL {
namespace Crude_registration {
namespace internal {

inline std::string to_string(Registration_status status)
{
  std::ostringstream out;
  out << status;
  return out.str();
}

// The three rows of the matrix of a motion.
template <class Kernel>
void write_json(Json_writer& json, const Aff_transformation_3<Kernel>& motion)
{
  json.begin_array();
  for (int i = 0; i < 3; ++i) {
    std::array<double, 4> row{};
    for (int j = 0; j < 4; ++j) row[std::size_t(j)] = CGAL::to_double(motion.m(i, j));
    json.row(row);
  }
  json.end_array();
}

// The members of an object that has been begun. The times, which differ from run to run, are left out unless asked for:
// all else is the same, byte for byte, for the same input.
template <class Kernel>
void write_json(Json_writer& json, const Registration_result<Kernel>& result, bool with_times)
{
  json.member("status", to_string(result.status()));
  json.member("reason", result.reason());
  json.member("confidence", result.confidence());
  json.member("score", result.score());
  json.member("overlap", result.overlap());
  json.member("residual", result.residual());
  json.member("free_space_violations", result.free_space_violations());
  json.member("source_has_free_space", result.source_has_free_space());
  json.member("target_has_free_space", result.target_has_free_space());
  write_json(json.key("target_from_source"), result.transformation());
  write_json(json.key("crude_target_from_source"), result.crude_transformation());
  json.key("covariance").begin_array();
  for (const auto& row : result.covariance()) json.row(row);
  json.end_array();
  json.key("free_motions").begin_array();
  for (const std::string& name : result.free_motions()) json.value(name);
  json.end_array();
  json.key("runners_up").begin_array();
  for (const auto& runner_up : result.runners_up()) {
    json.begin_object().member("score", runner_up.score);
    write_json(json.key("target_from_source"), runner_up.transformation);
    json.end_object();
  }
  json.end_array();
  json.key("statistics").begin_array();
  for (const auto& stage : result.statistics()) {
    json.begin_object().member("stage", stage.name).member("count", stage.count);
    if (with_times) json.member("seconds", stage.seconds);
    json.end_object();
  }
  json.end_array();
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_INTERNAL_RESULT_JSON_H
