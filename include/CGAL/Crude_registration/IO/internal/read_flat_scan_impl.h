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

#include <CGAL/Crude_registration/IO/internal/Pcd_reader.h>
#include <CGAL/Crude_registration/IO/internal/Ply_reader.h>
#include <CGAL/Crude_registration/IO/internal/Text_point_reader.h>
#include <CGAL/Crude_registration/IO/internal/missing_samples.h>
#include <CGAL/Crude_registration/IO/internal/polygon_soup_readers.h>
#include <CGAL/Crude_registration/IO/internal/read_depth_image.h>
#include <CGAL/Crude_registration/IO/internal/read_flat_scan.h>
#include <CGAL/Crude_registration/IO/internal/read_gltf.h>
#include <CGAL/Crude_registration/IO/internal/read_las.h>
#include <CGAL/Crude_registration/IO/internal/read_npy.h>
#include <CGAL/Crude_registration/IO/internal/read_ptx.h>
#include <CGAL/Crude_registration/IO/internal/scan_format.h>
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
#include <limits>
#include <locale>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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

inline std::vector<Vector> to_normals(const std::vector<std::array<double, 3>>& coordinates)
{
  std::vector<Vector> normals;
  normals.reserve(coordinates.size());
  for (const auto& n : coordinates) normals.push_back(unit_normal(Vector(n[0], n[1], n[2])));
  return normals;
}

inline std::vector<Vector> to_vectors(const std::vector<std::array<double, 3>>& coordinates)
{
  std::vector<Vector> vectors;
  vectors.reserve(coordinates.size());
  for (const auto& p : coordinates) vectors.emplace_back(p[0], p[1], p[2]);
  return vectors;
}

// Points alone, without those that are no samples.
inline Flat_scan_file to_scan(Flat_scan_file&& scan, const std::string& file)
{
  take_out_missing(scan, origin_is_missing(scan.points), file);
  return std::move(scan);
}

// The sensor that the grid of a range image tells, if any.
inline Flat_sensor sensor_of_grid(const Flat_scan_file& scan)
{
  return estimated_sensor(Flat_range_image(scan.columns, scan.rows, scan.points, scan.grid.data()));
}

// A grid that some programs write with (0, 0, 0) where there is no sample.
inline Flat_scan_file to_image(Flat_scan_file&& scan, const std::string& file)
{
  take_out_missing(scan, true, file);
  if (scan.sensor.kind == Flat_sensor::UNKNOWN) scan.sensor = sensor_of_grid(scan);
  return std::move(scan);
}

// The viewpoint 0 0 0 of an organised PCD file is that of a camera's frame, but also what remains where the points were
// moved, or where nobody set one. It is believed where the grid does not tell the sensor, or tells one that is nearer
// to it than to any sample.
inline Flat_scan_file read_pcd(const std::string& data, const std::string& file)
{
  bool viewpoint_is_default = false;
  Flat_scan_file scan = Pcd_reader(data, file).read(viewpoint_is_default);
  if (scan.kind != Flat_scan_file::RANGE_IMAGE) return to_scan(std::move(scan), file);
  scan = to_image(std::move(scan), file);
  const Flat_sensor& told = scan.sensor;
  if (!viewpoint_is_default || told.kind == Flat_sensor::ORTHOGRAPHIC) return scan;
  double nearest = (std::numeric_limits<double>::max)();
  if (told.kind == Flat_sensor::PERSPECTIVE)
    for (const Vector& p : scan.points) nearest = (std::min)(nearest, (p - told.vector).norm());
  if (told.kind == Flat_sensor::UNKNOWN || told.vector.norm() < nearest)
    scan.sensor = {Flat_sensor::PERSPECTIVE, Vector::Zero()};
  return scan;
}

// Vertices that are split keep their colour.
struct Color_copier : CGAL::Polygon_mesh_processing::Default_orientation_visitor
{
  std::vector<Color>* colors;
  void duplicated_vertex(std::size_t v, std::size_t)
  {
    if (!colors->empty()) colors->push_back(Color(colors->at(v)));
  }
};

// Polygons that name a vertex that is NaN or infinite, that name one twice or have fewer than three are left out, as
// are points without a polygon; where the others do not make a manifold with consistent faces, CGAL turns them and
// splits vertices until they do.
inline Flat_scan_file to_scan(Polygon_soup&& soup, const std::string& file)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  Flat_scan_file scan;
  scan.missing = soup.missing;
  if (soup.points.empty() && soup.missing == 0) throw IO_error(file, "the file has no points");
  if (soup.polygons.empty()) {
    scan.points = to_vectors(soup.points);
    scan.normals = to_normals(soup.normals);
    scan.colors = std::move(soup.colors);
    return to_scan(std::move(scan), file);
  }
  std::vector<bool> is_missing(soup.points.size(), false);
  for (std::size_t v = 0; v < soup.points.size(); ++v)
    is_missing[v] =
        !std::all_of(soup.points[v].begin(), soup.points[v].end(), [](double c) { return std::isfinite(c); });
  scan.missing += static_cast<std::size_t>(std::count(is_missing.begin(), is_missing.end(), true));
  std::vector<std::size_t> sorted;
  const auto is_degenerate = [&](const std::vector<std::size_t>& polygon) {
    sorted = polygon;
    std::sort(sorted.begin(), sorted.end());
    return sorted.size() < 3 ||
           std::any_of(sorted.begin(), sorted.end(), [&](std::size_t v) { return is_missing[v]; }) ||
           std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
  };
  soup.polygons.erase(std::remove_if(soup.polygons.begin(), soup.polygons.end(), is_degenerate), soup.polygons.end());
  if (soup.polygons.empty())
    throw IO_error(file, scan.missing == 0 ? "all faces are degenerate"
                                           : "all faces are degenerate, or have a vertex that is NaN or infinite");

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
    if (!soup.colors.empty()) scan.colors.push_back(soup.colors[v]);
  }
  for (auto& polygon : soup.polygons)
    for (std::size_t& v : polygon) v = new_index[v];

  if (!PMP::is_polygon_soup_a_polygon_mesh(soup.polygons)) {
    const Color_copier copier{{}, &scan.colors};
    PMP::orient_polygon_soup(points, soup.polygons, CGAL::parameters::visitor(copier));
  }
  scan.kind = Flat_scan_file::MESH;
  for (const Cartesian::Point_3& p : points) scan.points.emplace_back(p.x(), p.y(), p.z());
  scan.polygons = std::move(soup.polygons);
  return scan;
}

inline Flat_sensor sensor_of(const Ply_contents& ply)
{
  const auto to_vector = [](const std::array<double, 3>& v) { return Vector(v[0], v[1], v[2]); };
  if (ply.has_viewpoint) return {Flat_sensor::PERSPECTIVE, to_vector(ply.viewpoint)};
  if (ply.has_viewing_direction) return {Flat_sensor::ORTHOGRAPHIC, unit_or_zero(to_vector(ply.viewing_direction))};
  return {};
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
  scan.normals = to_normals(ply.normals);
  scan.colors = std::move(ply.colors);
  take_out_missing(scan, false, file);
  scan.sensor = sensor_of(ply);
  if (scan.sensor.kind == Flat_sensor::UNKNOWN) scan.sensor = sensor_of_grid(scan);
  return scan;
}

inline Flat_scan_file to_scan(Ply_contents&& ply, const std::string& file)
{
  if (ply.has_grid) return to_flat_range_image(std::move(ply), file);
  Flat_scan_file scan = to_scan(
      Polygon_soup{std::move(ply.points), std::move(ply.faces), std::move(ply.normals), std::move(ply.colors)}, file);
  scan.sensor = sensor_of(ply);
  return scan;
}

// what one of CGAL's readers of polygon soups has read
inline Flat_scan_file to_scan(const std::vector<Cartesian::Point_3>& points,
                              std::vector<std::vector<std::size_t>>&& polygons, const std::string& file)
{
  Polygon_soup soup;
  for (const auto& p : points) soup.points.push_back({p.x(), p.y(), p.z()});
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
  if (!CGAL::IO::read_GOCAD(in, name_and_color, points, polygons, CGAL::parameters::default_values())) {
    // CGAL's reader stops behind the line that it cannot read.
    in.clear();
    const auto read = std::ptrdiff_t(in.tellg());
    if (read < std::ptrdiff_t(data.size()))
      throw IO_error(file, std::size_t(std::count(data.begin(), data.begin() + read, '\n')),
                     "not a vertex or a triangle of a GOCAD file");
    throw IO_error(file, "not a GOCAD file, or cut short: it has no END");
  }
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

inline Flat_scan_file read_text(std::string_view text, const std::string& file)
{
  const auto starts_with = [&](std::string_view start) { return text.substr(0, start.size()) == start; };
  if (starts_with("\xff\xfe") || starts_with("\xfe\xff"))
    throw IO_error(file, "the text is in UTF-16: save it as UTF-8");
  if (text.substr(0, 4096).find('\0') != std::string_view::npos)
    throw IO_error(file, "the format of the file is not known");
  return to_scan(Text_point_reader(text, file).read(), file);
}

CGAL_CRUDE_REGISTRATION_INLINE Flat_scan_file read_flat_scan(const std::string& name, const Depth_camera& camera)
{
  std::string filename = name;
  const std::size_t number = take_off_number(filename);
  const Named_contents contents = contents_of(filename);
  const std::string& data = contents.data;
  const Scan_format format = format_of(contents);
  if (number > 0 && format != Scan_format::PTX) throw IO_error(filename, "only a PTX file has scans with numbers");
  switch (format) {
  case Scan_format::PTX:
    return Ptx_reader(data, filename).read(number);
  case Scan_format::PLY:
    return to_scan(read_ply(data, filename), filename);
  case Scan_format::OFF:
    return to_scan(read_off(data, filename), filename);
  case Scan_format::PCD:
    return read_pcd(data, filename);
  case Scan_format::NPY: {
    Flat_scan_file scan = Npy_reader(data, filename).read();
    return scan.kind == Flat_scan_file::RANGE_IMAGE ? to_image(std::move(scan), filename)
                                                    : to_scan(std::move(scan), filename);
  }
  case Scan_format::PNG:
    return read_depth_image(data, camera, filename);
  case Scan_format::LAS:
    return to_scan(read_las(data, filename), filename);
  case Scan_format::E57:
    throw IO_error(filename,
                   "E57 is not read: convert the scan to PTX or PLY, with CloudCompare or the scanner's program");
  case Scan_format::GLTF:
    return to_scan(read_gltf(data, filename), filename);
  case Scan_format::OBJ:
    return to_scan(read_obj(data, filename), filename);
  case Scan_format::STL:
    return to_scan(read_stl(data, filename), filename);
  case Scan_format::GOCAD:
    return read_gocad(data, filename);
  case Scan_format::VTP:
    return read_vtp(filename);
  case Scan_format::TEXT:
    break;
  }
  return read_text(data, filename);
}

CGAL_CRUDE_REGISTRATION_INLINE std::vector<std::string> names_of_scans(const std::string& filename)
{
  const std::string extension = lower_case_extension(filename);
  if (extension != ".ptx" && extension != ".gz") return {filename};
  const Named_contents contents = contents_of(filename);
  if (contents.extension != ".ptx") return {filename};
  const std::size_t count = Ptx_reader(contents.data, filename).count();
  if (count == 1) return {filename};
  std::vector<std::string> names;
  for (std::size_t i = 1; i <= count; ++i) names.push_back(filename + "#" + std::to_string(i));
  return names;
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
