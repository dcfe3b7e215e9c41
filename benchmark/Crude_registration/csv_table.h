// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_BENCHMARK_CSV_TABLE_H
#define CGAL_CRUDE_REGISTRATION_BENCHMARK_CSV_TABLE_H

#include <Eigen/Core>

#include <cstddef>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace benchmark_tools {

// The fields of a line of a CSV file by the names in its first line.
using Row = std::map<std::string, std::string>;
using Motion = Eigen::Matrix<double, 3, 4>;

inline std::vector<Row> read_table(const std::string& path)
{
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + ": the file cannot be read");
  const auto fields = [](const std::string& line) {
    std::vector<std::string> result;
    std::stringstream in(line.substr(0, line.find('\r')));
    for (std::string field; std::getline(in, field, ',');) result.push_back(field);
    return result;
  };
  std::string line;
  std::getline(file, line);
  const std::vector<std::string> names = fields(line);
  std::vector<Row> rows;
  while (std::getline(file, line)) {
    const std::vector<std::string> values = fields(line);
    Row row;
    for (std::size_t i = 0; i < names.size() && i < values.size(); ++i) row[names[i]] = values[i];
    rows.push_back(row);
  }
  return rows;
}

inline double number(const Row& row, const std::string& name)
{
  const auto field = row.find(name);
  if (field == row.end() || field->second.empty()) throw std::runtime_error("a row has no " + name);
  return std::stod(field->second);
}

// The columns m00 .. m23.
inline Motion motion(const Row& row)
{
  Motion m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j) m(i, j) = number(row, "m" + std::to_string(i) + std::to_string(j));
  return m;
}

} // namespace benchmark_tools

#endif // CGAL_CRUDE_REGISTRATION_BENCHMARK_CSV_TABLE_H
