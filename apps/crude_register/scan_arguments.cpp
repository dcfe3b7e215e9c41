// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scan_arguments.h"

#include "files.h"

#include <CGAL/Crude_registration/IO/IO_error.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <system_error>

#include <glob.h>

namespace {

// Whether a PNG file is a depth image, not a picture: one channel (colour type 0) of 16 bits.
bool is_depth_image(const std::string& file)
{
  std::array<char, 26> head{}; // up to the size and the type of the colours
  std::ifstream(file, std::ios::binary).read(head.data(), head.size());
  return head[24] == 16 && head[25] == 0;
}

// Whether a file in a folder is one of its scans, by its name. What this program writes beside scans is none.
bool is_scan(const std::filesystem::path& path)
{
  static constexpr std::array<const char*, 17> known = {".ply", ".off", ".obj", ".stl", ".ptx", ".pcd",
                                                        ".npy", ".png", ".las", ".xyz", ".txt", ".asc",
                                                        ".pts", ".csv", ".ts",  ".glb", ".gltf"};
  const std::string name = path.filename().string(), extension = format_by_name(name);
  if (name == "poses.txt" || name == "motion.txt" || name.front() == '.') return false;
  if (std::find(known.begin(), known.end(), extension) == known.end()) return false;
  return extension != ".png" || is_depth_image(path.string());
}

std::vector<std::string> scans_in_folder(const std::string& folder)
{
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.is_regular_file() && is_scan(entry.path())) files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  if (files.empty()) throw CR::IO_error(folder, "there is no scan in the folder");
  return files;
}

// The files that a pattern with * or ? fits, in their order; the pattern itself if it fits none.
std::vector<std::string> files_of_pattern(const std::string& pattern)
{
  glob_t found = {};
  std::vector<std::string> files;
  if (glob(pattern.c_str(), 0, nullptr, &found) == 0) files.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  globfree(&found);
  std::sort(files.begin(), files.end());
  if (files.empty()) files.push_back(pattern);
  return files;
}

} // namespace

std::vector<std::string> scans_of_arguments(const std::vector<std::string>& arguments)
{
  std::vector<std::string> scans;
  for (const std::string& argument : arguments) {
    std::vector<std::string> more = {argument};
    std::error_code error;
    if (std::filesystem::is_directory(argument, error)) more = scans_in_folder(argument);
    else if (!std::filesystem::exists(argument, error) && argument.find_first_of("*?[") != std::string::npos)
      more = files_of_pattern(argument);
    scans.insert(scans.end(), more.begin(), more.end());
  }
  return scans;
}

std::string scan_of_argument(const std::string& argument)
{
  const std::vector<std::string> scans = scans_of_arguments({argument});
  if (scans.size() == 1) return scans.front();
  throw CR::IO_error(argument, "one scan is expected, but this stands for " + std::to_string(scans.size()));
}
