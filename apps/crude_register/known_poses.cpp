// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "known_poses.h"

#include <fstream>
#include <locale>
#include <sstream>

namespace {

// The scan of a name, with or without its folders; nothing if there is none.
std::optional<std::size_t> found(const std::string& name, const std::vector<std::string>& names)
{
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == name || base_name(names[i]) == base_name(name)) return i;
  return std::nullopt;
}

} // namespace

std::size_t place_of(const std::string& name, const std::vector<std::string>& names, const std::string& option)
{
  const std::optional<std::size_t> place = found(name, names);
  if (!place) throw Usage_error(option + " names no scan: " + name);
  return *place;
}

Known known_of(const std::optional<std::string>& file, const std::vector<std::string>& names)
{
  Known known;
  known.poses.resize(names.size());
  known.groups.resize(names.size(), 0);
  if (!file) return known;
  std::ifstream in(*file);
  if (!in) throw CR::IO_error(*file, "the file cannot be opened");
  std::size_t line_number = 0, group = 0;
  for (std::string line; std::getline(in, line);) {
    ++line_number;
    if (line.rfind("# component", 0) == 0) ++group;
    if (line.find_first_not_of(" \t\r") == std::string::npos || line[0] == '#') continue;
    // The name may hold spaces: the numbers are the last twelve words.
    std::size_t end = line.find_last_not_of(" \t\r") + 1;
    for (int word = 0; word < 12 && end != std::string::npos; ++word) {
      const std::size_t gap = line.find_last_of(" \t", end - 1);
      const std::size_t last = gap == std::string::npos ? gap : line.find_last_not_of(" \t", gap);
      end = last == std::string::npos ? last : last + 1;
    }
    double m[12];
    std::istringstream words(end == std::string::npos ? std::string() : line.substr(end));
    words.imbue(std::locale::classic());
    for (double& x : m) words >> x;
    if (end == std::string::npos || !words)
      throw CR::IO_error(*file, "line " + std::to_string(line_number) + ": a name and 12 numbers are expected");
    const std::optional<std::size_t> scan = found(line.substr(0, end), names);
    if (!scan) continue;
    known.poses[*scan] = Transformation(m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8], m[9], m[10], m[11]);
    known.groups[*scan] = group;
  }
  return known;
}
