// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CRUDE_REGISTER_PREPARED_SCANS_H
#define CRUDE_REGISTER_PREPARED_SCANS_H

// The scans of an assembly, prepared once: kept in the folder of --store, where there is one.

#include "files.h"
#include "options.h"
#include "progress.h"
#include "surfaces.h"

#include <CGAL/Crude_registration/IO/IO_error.h>
#include <CGAL/Crude_registration/IO/save_scan.h>
#include <CGAL/Crude_registration/Scan.h>

#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/uuid_io.hpp>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>

// Of all that a prepared scan depends on: the bytes of its file, which scan of the file it is, and its sensor. What
// version of the package has prepared it is told by the file that it is kept in.
inline std::string hash_of_input(const po::variables_map& map, const std::string& file,
                                 const std::optional<Point>& viewpoint)
{
  std::string all;
  const auto add = [&](const std::string& text) { all += std::to_string(text.size()) + ' ' + text; };
  const auto add_number = [&](double x) { all.append(reinterpret_cast<const char*>(&x), sizeof x); };
  // FILE.ptx#2 is a scan of FILE.ptx.
  const std::size_t mark = std::filesystem::exists(file) ? std::string::npos : file.rfind('#');
  const std::string name = file.substr(0, mark);
  std::ifstream in(name, std::ios::binary);
  if (!in) throw CR::IO_error(name, "the file cannot be opened");
  add(std::string(std::istreambuf_iterator<char>(in), {}));
  add(mark == std::string::npos ? std::string() : file.substr(mark));
  add(std::filesystem::path(name).extension().string());
  const CR::Depth_camera camera = camera_of(map, file);
  for (const double x : {camera.fx, camera.fy, camera.cx, camera.cy, camera.scale}) add_number(x);
  if (viewpoint)
    for (int i = 0; i < 3; ++i) add_number((*viewpoint)[i]);
  return boost::uuids::to_string(boost::uuids::name_generator_sha1(boost::uuids::uuid())(all));
}

// Reads a scan and prepares it, or takes it from the folder, if one is given, where it was kept before.
inline CR::Scan<Kernel> prepared_scan(const po::variables_map& map, const std::string& file,
                                      const std::optional<Point>& viewpoint, const std::optional<std::string>& store)
{
  const auto prepare = [&] {
    const Scan_file contents = read_scan(map, file);
    std::optional<CR::Scan<Kernel>> scan;
    with_viewpoint(viewpoint,
                   [&](const auto& np) { scan.emplace(contents, np.visitor(Interruption_visitor()), file); });
    return *scan;
  };
  if (!store) return prepare();
  const std::string kept = (std::filesystem::path(*store) / (hash_of_input(map, file, viewpoint) + ".scan")).string();
  if (std::filesystem::exists(kept)) {
    try {
      return CR::load_scan<Kernel>(kept);
    } catch (const CR::IO_error&) { // damaged, or of another version
    }
  }
  make_folder(*store);
  const CR::Scan<Kernel> scan = prepare();
  CR::save_scan(kept, scan);
  return scan;
}

#endif // CRUDE_REGISTER_PREPARED_SCANS_H
