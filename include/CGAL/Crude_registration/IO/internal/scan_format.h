// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Author(s)     : The Crude_registration authors

#ifndef CGAL_CRUDE_REGISTRATION_IO_INTERNAL_SCAN_FORMAT_H
#define CGAL_CRUDE_REGISTRATION_IO_INTERNAL_SCAN_FORMAT_H

// The contents of a file of a scan, and its format.

#include <CGAL/Crude_registration/IO/IO_error.h>
#include <CGAL/Crude_registration/IO/internal/read_file.h>
#include <CGAL/Crude_registration/IO/internal/unpack_gzip.h>

#include <charconv>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The number behind the last # of a name, which is taken off; 0 where there is none, or where a file has that name.
inline std::size_t take_off_number(std::string& filename)
{
  const std::size_t mark = filename.rfind('#');
  if (mark == std::string::npos || std::filesystem::exists(filename)) return 0;
  std::size_t number = 0;
  const char *const first = filename.data() + mark + 1, *const last = filename.data() + filename.size();
  const auto r = std::from_chars(first, last, number);
  if (r.ec != std::errc() || r.ptr != last || number == 0) return 0;
  filename.resize(mark);
  return number;
}

inline std::string lower_case_extension(const std::string& filename)
{
  std::string extension = std::filesystem::path(filename).extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return extension;
}

inline constexpr char utf8_mark[] = "\xef\xbb\xbf";

// The contents of a file, and the end of its name, which says the format.
struct Named_contents
{
  std::string data, extension;
  bool is_packed = false, has_mark = false; // was packed by gzip; had the mark of UTF-8, which is taken off
};

inline Named_contents contents_of(const std::string& filename)
{
  Named_contents contents;
  contents.data = read_file(filename);
  contents.extension = lower_case_extension(filename);
  if (contents.data.compare(0, 2, "\x1f\x8b") == 0) {
    contents.data = unpack_gzip(contents.data, filename);
    contents.is_packed = true;
    if (contents.extension == ".gz") contents.extension = lower_case_extension(filename.substr(0, filename.size() - 3));
  }
  contents.has_mark = contents.data.compare(0, 3, utf8_mark) == 0;
  if (contents.has_mark) contents.data.erase(0, 3);
  if (contents.data.empty()) throw IO_error(filename, "the file is empty");
  return contents;
}

enum class Scan_format
{
  PTX,
  PLY,
  OFF,
  PCD,
  NPY,
  PNG,
  LAS,
  E57,
  GLTF,
  OBJ,
  STL,
  GOCAD,
  VTP,
  TEXT
};

// By the first bytes where these are unmistakable, else by the end of the name.
inline Scan_format format_of(const Named_contents& contents)
{
  const std::string& extension = contents.extension;
  const auto starts_with = [&](const char* magic) {
    return contents.data.compare(0, std::string_view(magic).size(), magic) == 0;
  };
  if (extension == ".ptx") return Scan_format::PTX;
  if (extension == ".ply" || starts_with("ply\n") || starts_with("ply\r")) return Scan_format::PLY;
  if (extension == ".off" || starts_with("OFF") || starts_with("COFF") || starts_with("NOFF")) return Scan_format::OFF;
  if (extension == ".pcd" || starts_with("# .PCD")) return Scan_format::PCD;
  if (starts_with("\x93NUMPY")) return Scan_format::NPY;
  if (starts_with("\x89PNG")) return Scan_format::PNG;
  if (extension == ".las" || extension == ".laz" || starts_with("LASF")) return Scan_format::LAS;
  if (extension == ".e57" || starts_with("ASTM-E57")) return Scan_format::E57;
  if (extension == ".glb" || extension == ".gltf" || starts_with("glTF")) return Scan_format::GLTF;
  if (extension == ".obj") return Scan_format::OBJ;
  if (extension == ".stl") return Scan_format::STL;
  if (extension == ".ts") return Scan_format::GOCAD;
  if (extension == ".vtp") return Scan_format::VTP;
  return Scan_format::TEXT;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_INTERNAL_SCAN_FORMAT_H
