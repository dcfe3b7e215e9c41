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

#include <CGAL/Crude_registration/IO/internal/Pair_store.h>
#include <CGAL/Crude_registration/IO/internal/read_flat_scan.h>
#include <CGAL/Crude_registration/IO/save_scan.h>
#include <CGAL/Crude_registration/Scan.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>

// Of all that a prepared scan depends on: the bytes of its file, which scan of the file it is, and its sensor. What
// version of the package has prepared it is told by the file that it is kept in.
inline std::string hash_of_input(const po::variables_map& map, const std::string& file,
                                 const std::optional<Point>& viewpoint)
{
  CR::internal::Content_hash hash;
  const auto add = [&](const std::string& text) {
    hash.add(std::uint64_t(text.size()));
    for (std::size_t i = 0; i < text.size(); i += sizeof(std::uint64_t)) {
      std::uint64_t word = 0;
      std::memcpy(&word, text.data() + i, (std::min)(sizeof word, text.size() - i));
      hash.add(word);
    }
  };
  // FILE.ptx#2 is a scan of FILE.ptx.
  const std::size_t mark = std::filesystem::exists(file) ? std::string::npos : file.rfind('#');
  add(CR::internal::read_file(file.substr(0, mark)));
  add(mark == std::string::npos ? std::string() : file.substr(mark));
  add(std::filesystem::path(file.substr(0, mark)).extension().string());
  const CR::Depth_camera camera = camera_of(map, file);
  for (const double x : {camera.fx, camera.fy, camera.cx, camera.cy, camera.scale}) hash.add(x);
  hash.add(std::uint64_t(viewpoint.has_value()));
  if (viewpoint)
    for (int i = 0; i < 3; ++i) hash.add((*viewpoint)[i]);
  return hash.text();
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
