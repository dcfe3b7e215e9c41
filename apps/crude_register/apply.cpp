// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "apply.h"

#include <CGAL/Crude_registration/IO/apply_motion.h>

#include <cstddef>
#include <filesystem>
#include <iomanip>
#include <locale>
#include <set>
#include <sstream>
#include <system_error>

namespace {

// The name of a scan in a folder: its own, where scan.ptx#2 is scan_2.ptx.
std::string name_in_folder(const std::string& folder, const std::string& scan)
{
  const std::string name = base_name(scan);
  const std::size_t mark = name.rfind('#');
  if (mark == std::string::npos || std::filesystem::exists(scan)) return in_folder(folder, name);
  const std::filesystem::path file(name.substr(0, mark));
  return in_folder(folder, file.stem().string() + "_" + name.substr(mark + 1) + file.extension().string());
}

} // namespace

void check_apply(const std::string& scan)
{
  CR::check_motion_can_be_applied(scan);
}

void check_apply(const std::string& scan, const std::string& output)
{
  check_output(output);
  check_apply(scan);
  const std::string format = format_by_name(scan);
  if (format_by_name(output) != format)
    throw CR::IO_error(output, "--apply writes the format of " + scan + ": give a name that ends " +
                                   (format.empty() ? "without one, as that does" : "in " + format));
  std::error_code error;
  if (std::filesystem::equivalent(scan, output, error))
    throw CR::IO_error(output, "--apply does not write over the scan it moves: give another name");
}

std::optional<std::string> apply_option(const po::variables_map& map, const std::string& scan)
{
  std::optional<std::string> output = value_of<std::string>(map, "apply");
  if (!output) return std::nullopt;
  std::error_code error;
  if (std::filesystem::is_directory(*output, error)) output = name_in_folder(*output, scan);
  check_apply(scan, *output);
  return output;
}

std::string apply(const std::string& scan, const std::string& output, const Transformation& motion, double spacing)
{
  constexpr double worth_telling = 0.01;
  const double rounding = CR::apply_motion(scan, output, motion);
  if (!(rounding > worth_telling * spacing)) return "";
  std::ostringstream note;
  note.imbue(std::locale::classic());
  note << output << " keeps the floats of the scan, which are up to " << std::setprecision(2) << rounding / spacing
       << " sampling distances from where its points were moved to";
  return note.str();
}

std::vector<std::string> applied_names(const std::string& folder, const std::vector<std::string>& scans)
{
  std::vector<std::string> names;
  std::set<std::string> distinct;
  for (const std::string& scan : scans) {
    names.push_back(name_in_folder(folder, scan));
    if (!distinct.insert(names.back()).second)
      throw CR::IO_error(names.back(), "--apply would write two scans of this name: give them other names");
  }
  return names;
}
