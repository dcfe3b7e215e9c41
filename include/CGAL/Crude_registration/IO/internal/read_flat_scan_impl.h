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

#ifndef CGAL_CRUDE_REGISTRATION_IO_INTERNAL_READ_FLAT_SCAN_IMPL_H
#define CGAL_CRUDE_REGISTRATION_IO_INTERNAL_READ_FLAT_SCAN_IMPL_H

// The format of a file told, and its contents put in order.

#include <CGAL/Crude_registration/IO/internal/Ply_reader.h>
#include <CGAL/Crude_registration/IO/internal/point_readers.h>
#include <CGAL/Crude_registration/IO/internal/polygon_soup_readers.h>
#include <CGAL/Crude_registration/IO/internal/read_flat_scan.h>
#include <CGAL/Crude_registration/internal/sampling/Flat_range_image.h>
#include <CGAL/Crude_registration/internal/sampling/estimate_flat_sensor.h>

#include <CGAL/IO/GOCAD.h>
#include <CGAL/IO/VTK.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <locale>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#ifdef CGAL_LINKED_WITH_LASLIB
#include <CGAL/IO/read_las_points.h>
#endif

namespace CGAL {
namespace Crude_registration {
namespace internal {

CGAL_CRUDE_REGISTRATION_INLINE std::string read_file(const std::string& filename)
{
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(filename.c_str(), "rb"), &std::fclose);
  if (!file) throw IO_error(filename, "the file cannot be opened");
  std::string data;
  const std::size_t chunk = std::size_t(1) << 20;
  for (;;) {
    const std::size_t size = data.size();
    data.resize(size + (size < chunk ? chunk : size));
    const std::size_t got = std::fread(&data[size], 1, data.size() - size, file.get());
    const bool at_end = size + got < data.size();
    data.resize(size + got);
    if (std::ferror(file.get())) throw IO_error(filename, "the file cannot be read");
    if (at_end) return data;
  }
}

using Cartesian = CGAL::Simple_cartesian<double>;

inline std::vector<Vector> to_vectors(const std::vector<std::array<double, 3>>& coordinates)
{
  std::vector<Vector> vectors;
  vectors.reserve(coordinates.size());
  for (const auto& p : coordinates) vectors.emplace_back(p[0], p[1], p[2]);
  return vectors;
}

// Polygons that name a vertex twice or have fewer than three are left out, as are points without a polygon; where the
// others do not make a manifold with consistent faces, CGAL turns them and splits vertices until they do.
inline Flat_scan_file to_scan(Polygon_soup&& soup, const std::string& file)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  Flat_scan_file scan;
  if (soup.points.empty()) throw IO_error(file, "the file has no points");
  if (soup.polygons.empty()) {
    scan.points = to_vectors(soup.points);
    return scan;
  }
  std::vector<std::size_t> sorted;
  const auto is_degenerate = [&](const std::vector<std::size_t>& polygon) {
    sorted = polygon;
    std::sort(sorted.begin(), sorted.end());
    return sorted.size() < 3 || std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
  };
  soup.polygons.erase(std::remove_if(soup.polygons.begin(), soup.polygons.end(), is_degenerate), soup.polygons.end());
  if (soup.polygons.empty()) throw IO_error(file, "all faces are degenerate");

  constexpr std::size_t unused = static_cast<std::size_t>(-1);
  std::vector<std::size_t> new_index(soup.points.size(), unused);
  for (const auto& polygon : soup.polygons)
    for (std::size_t v : polygon) new_index[v] = 0;
  std::vector<Cartesian::Point_3> points;
  for (std::size_t v = 0; v < soup.points.size(); ++v) {
    if (new_index[v] == unused) continue;
    new_index[v] = points.size();
    const auto& p = soup.points[v];
    points.emplace_back(p[0], p[1], p[2]);
  }
  for (auto& polygon : soup.polygons)
    for (std::size_t& v : polygon) v = new_index[v];

  if (!PMP::is_polygon_soup_a_polygon_mesh(soup.polygons)) PMP::orient_polygon_soup(points, soup.polygons);
  scan.kind = Flat_scan_file::MESH;
  for (const Cartesian::Point_3& p : points) scan.points.emplace_back(p.x(), p.y(), p.z());
  scan.polygons = std::move(soup.polygons);
  return scan;
}

// The sensor as the file says, or estimated from the grid.
inline Flat_scan_file to_flat_range_image(Ply_contents&& ply, const std::string& file)
{
  if (ply.points.empty()) throw IO_error(file, "the range image has no samples");
  Flat_scan_file scan;
  scan.kind = Flat_scan_file::RANGE_IMAGE;
  scan.points = to_vectors(ply.points);
  scan.columns = ply.columns;
  scan.rows = ply.rows;
  scan.grid = std::move(ply.grid);
  const auto to_vector = [](const std::array<double, 3>& v) { return Vector(v[0], v[1], v[2]); };
  if (ply.has_viewpoint) scan.sensor = {Flat_sensor::PERSPECTIVE, to_vector(ply.viewpoint)};
  else if (ply.has_viewing_direction)
    scan.sensor = {Flat_sensor::ORTHOGRAPHIC, unit_or_zero(to_vector(ply.viewing_direction))};
  else scan.sensor = estimated_sensor(Flat_range_image(scan.columns, scan.rows, scan.points, scan.grid.data()));
  return scan;
}

inline Flat_scan_file to_scan(Ply_contents&& ply, const std::string& file)
{
  if (ply.has_grid) return to_flat_range_image(std::move(ply), file);
  return to_scan(Polygon_soup{std::move(ply.points), std::move(ply.faces)}, file);
}

// what one of CGAL's readers of polygon soups has read
inline Flat_scan_file to_scan(const std::vector<Cartesian::Point_3>& points,
                              std::vector<std::vector<std::size_t>>&& polygons, const std::string& file)
{
  Polygon_soup soup;
  for (const auto& p : points) {
    soup.points.push_back({CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())});
    for (double coordinate : soup.points.back())
      if (!std::isfinite(coordinate))
        throw IO_error(file, "a coordinate of point " + std::to_string(soup.points.size() - 1) + " is NaN or infinite");
  }
  for (const auto& polygon : polygons)
    for (std::size_t v : polygon)
      if (v >= points.size()) throw IO_error(file, "a face has a vertex that does not exist");
  soup.polygons = std::move(polygons);
  return to_scan(std::move(soup), file);
}

inline Flat_scan_file read_gocad(const std::string& data, const std::string& file)
{
  std::istringstream in(data);
  in.imbue(std::locale::classic());
  std::pair<std::string, std::string> name_and_color;
  std::vector<Cartesian::Point_3> points;
  std::vector<std::vector<std::size_t>> polygons;
  if (!CGAL::IO::read_GOCAD(in, name_and_color, points, polygons, CGAL::parameters::default_values()))
    throw IO_error(file, "not a GOCAD file that CGAL can read");
  return to_scan(points, std::move(polygons), file);
}

inline Flat_scan_file read_vtp([[maybe_unused]] const std::string& file)
{
#ifdef CGAL_USE_VTK
  std::vector<Cartesian::Point_3> points;
  std::vector<std::vector<std::size_t>> polygons;
  if (!CGAL::IO::read_VTP(file, points, polygons)) throw IO_error(file, "not a VTP file that CGAL can read");
  return to_scan(points, std::move(polygons), file);
#else
  throw IO_error(file, "VTP files are read only where the program was built with VTK");
#endif
}

inline Flat_scan_file read_las([[maybe_unused]] const std::string& file)
{
#ifdef CGAL_LINKED_WITH_LASLIB
  std::vector<Cartesian::Point_3> points;
  if (!CGAL::IO::read_LAS(file, std::back_inserter(points))) throw IO_error(file, "not a LAS file that CGAL can read");
  return to_scan(points, {}, file);
#else
  throw IO_error(file, "LAS files are read only where the program was built with LASlib");
#endif
}

CGAL_CRUDE_REGISTRATION_INLINE Flat_scan_file read_flat_scan(const std::string& filename)
{
  std::string extension = std::filesystem::path(filename).extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  const std::string data = read_file(filename);
  const std::string_view start = std::string_view(data).substr(0, 4096);
  const auto starts_with = [&](const char* magic) { return start.substr(0, std::string_view(magic).size()) == magic; };

  if (data.empty()) throw IO_error(filename, "the file is empty");
  if (extension == ".ply" || starts_with("ply\n") || starts_with("ply\r"))
    return to_scan(read_ply(data, filename), filename);
  if (extension == ".off" || starts_with("OFF") || starts_with("COFF") || starts_with("NOFF"))
    return to_scan(read_off(data, filename), filename);
  if (extension == ".obj") return to_scan(read_obj(data, filename), filename);
  if (extension == ".stl") return to_scan(read_stl(data, filename), filename);
  if (extension == ".ts") return read_gocad(data, filename);
  if (extension == ".vtp") return read_vtp(filename);
  if (extension == ".las" || extension == ".laz") return read_las(filename);
  if (extension == ".ptx") return read_ptx(data, filename);
  if (start.find('\0') != std::string_view::npos) throw IO_error(filename, "the format of the file is not known");
  Flat_scan_file scan;
  scan.points = to_vectors(Text_point_reader(data, filename).read());
  return scan;
}

CGAL_CRUDE_REGISTRATION_INLINE Flat_scan_file parse_flat_range_image(const std::string& data, const std::string& name)
{
  Ply_contents ply = read_ply(data, name);
  if (!ply.has_grid) throw IO_error(name, "not a range image: the file has no 'element range_grid'");
  return to_flat_range_image(std::move(ply), name);
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_INTERNAL_READ_FLAT_SCAN_IMPL_H
