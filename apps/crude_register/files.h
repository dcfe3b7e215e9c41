// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CRUDE_REGISTER_FILES_H
#define CRUDE_REGISTER_FILES_H

// The files that commands read and write: scans, meshes, motions and poses.

#include "options.h"

#include <CGAL/Crude_registration/IO/IO_error.h>
#include <CGAL/Crude_registration/IO/read_scan.h>
#include <CGAL/Crude_registration/IO/triangulate_scan.h>
#include <CGAL/Crude_registration/IO/write_file.h>

#include <CGAL/Surface_mesh.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <locale>
#include <map>
#include <optional>
#include <ostream>
#include <sstream>
#include <string>
#include <system_error>

using Transformation = CGAL::Aff_transformation_3<Kernel>;
using Mesh = CGAL::Surface_mesh<Point>;
using Scan_file = CR::Scan_file<Kernel>;

// The surface of a scan.
inline Mesh mesh_of(const Scan_file& file, const std::optional<Point>& viewpoint)
{
  return with_viewpoint(viewpoint, [&](const auto& np) { return CR::triangulate_scan(file, np); });
}

// As if the file said nothing of its sensor.
inline void forget_sensor(Scan_file& file)
{
  file.image.set_sensor(CR::Sensor<Kernel>());
}

inline std::size_t number_of_samples(const Scan_file& file)
{
  switch (file.kind) {
  case Scan_file::RANGE_IMAGE:
    return file.image.points().size();
  case Scan_file::MESH:
    return file.mesh.number_of_vertices();
  case Scan_file::POINTS:
    break;
  }
  return file.points.size();
}

inline std::string base_name(const std::string& file)
{
  return std::filesystem::path(file).filename().string();
}

inline void make_folder(const std::string& folder)
{
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw CR::IO_error(folder, "the folder cannot be made: " + error.message());
}

inline std::string in_folder(const std::string& folder, const std::string& name)
{
  return (std::filesystem::path(folder) / name).string();
}

inline void write_mesh(const std::string& file, const Mesh& mesh)
{
  CR::write_file(file, [&](std::ostream& out) {
    CGAL::IO::set_binary_mode(out);
    CGAL::IO::write_PLY(out, mesh);
  });
}

inline void write_rows(std::ostream& out, const Transformation& motion, const char* indent, const char* end)
{
  for (int i = 0; i < 3; ++i) {
    out << indent;
    for (int j = 0; j < 4; ++j) out << motion.m(i, j) << (j < 3 ? " " : end);
  }
}

// Poses of scans in a common frame: a line each, the name of the file and the rows of the 3 x 4 matrix.
inline std::map<std::string, Transformation> read_poses(const std::string& file)
{
  std::ifstream in(file);
  if (!in) throw CR::IO_error(file, "the file cannot be opened");
  std::map<std::string, Transformation> poses;
  std::string line;
  for (std::size_t number = 1; std::getline(in, line); ++number) {
    std::istringstream words(line);
    words.imbue(std::locale::classic());
    std::string name;
    if (!(words >> name) || name[0] == '#') continue;
    std::array<double, 12> m{};
    for (double& x : m)
      if (!(words >> x)) throw CR::IO_error(file, number, "the name of a file and 12 numbers are expected");
    poses[name] = Transformation(m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8], m[9], m[10], m[11]);
  }
  return poses;
}

#endif // CRUDE_REGISTER_FILES_H
