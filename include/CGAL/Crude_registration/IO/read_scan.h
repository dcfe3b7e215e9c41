// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_IO_READ_SCAN_H
#define CGAL_CRUDE_REGISTRATION_IO_READ_SCAN_H

// Reads a scan from a file of any format, whatever it holds.

#include <CGAL/Crude_registration/IO/IO_error.h>
#include <CGAL/Crude_registration/IO/read_range_image.h>
#include <CGAL/Crude_registration/Range_image.h>
#include <CGAL/Crude_registration/IO/internal/Ply_reader.h>
#include <CGAL/Crude_registration/IO/internal/point_readers.h>
#include <CGAL/Crude_registration/IO/internal/polygon_soup_readers.h>
#include <CGAL/Crude_registration/IO/internal/read_file.h>

#include <CGAL/IO/GOCAD.h>
#include <CGAL/IO/VTK.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Surface_mesh.h>
#ifdef CGAL_LINKED_WITH_LASLIB
#include <CGAL/IO/read_las_points.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {

/*!
\ingroup PkgCrudeRegistrationRef

\brief what `read_scan()` found in a file: a range image, a mesh or points, in the unit and frame of the file. The two
others are empty.

\tparam Kernel a model of `Kernel`
*/
template <class Kernel>
struct Scan_file
{
  typedef typename Kernel::Point_3 Point_3;

  enum Kind
  {
    RANGE_IMAGE,
    MESH,
    POINTS
  };

  Kind kind = POINTS;
  Range_image<Kernel> image;
  CGAL::Surface_mesh<Point_3> mesh;
  std::vector<Point_3> points;
};

namespace internal {

template <class Kernel>
std::vector<typename Kernel::Point_3> to_points(const std::vector<std::array<double, 3>>& coordinates)
{
  std::vector<typename Kernel::Point_3> points;
  points.reserve(coordinates.size());
  for (const auto& p : coordinates) points.emplace_back(p[0], p[1], p[2]);
  return points;
}

// Polygons that name a vertex twice or have fewer than three are left out, as are points without a polygon; where the
// others do not make a manifold with consistent faces, CGAL turns them and splits vertices until they do.
template <class Kernel>
Scan_file<Kernel> to_scan(Polygon_soup&& soup, const std::string& file)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  Scan_file<Kernel> scan;
  if (soup.points.empty()) throw IO_error(file, "the file has no points");
  if (soup.polygons.empty()) {
    scan.points = to_points<Kernel>(soup.points);
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
  std::vector<typename Kernel::Point_3> points;
  for (std::size_t v = 0; v < soup.points.size(); ++v) {
    if (new_index[v] == unused) continue;
    new_index[v] = points.size();
    const auto& p = soup.points[v];
    points.emplace_back(p[0], p[1], p[2]);
  }
  for (auto& polygon : soup.polygons)
    for (std::size_t& v : polygon) v = new_index[v];

  if (!PMP::is_polygon_soup_a_polygon_mesh(soup.polygons)) PMP::orient_polygon_soup(points, soup.polygons);
  scan.kind = Scan_file<Kernel>::MESH;
  PMP::polygon_soup_to_polygon_mesh(points, soup.polygons, scan.mesh);
  return scan;
}

template <class Kernel>
Scan_file<Kernel> to_scan(Ply_contents&& ply, const std::string& file)
{
  if (!ply.has_grid) return to_scan<Kernel>(Polygon_soup{std::move(ply.points), std::move(ply.faces)}, file);
  Scan_file<Kernel> scan;
  scan.kind = Scan_file<Kernel>::RANGE_IMAGE;
  scan.image = to_range_image<Kernel>(std::move(ply), file);
  return scan;
}

// what one of CGAL's readers of polygon soups has read
template <class Kernel>
Scan_file<Kernel> to_scan(const std::vector<typename Kernel::Point_3>& points,
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
  return to_scan<Kernel>(std::move(soup), file);
}

template <class Kernel>
Scan_file<Kernel> read_gocad(const std::string& data, const std::string& file)
{
  std::istringstream in(data);
  in.imbue(std::locale::classic());
  std::pair<std::string, std::string> name_and_color;
  std::vector<typename Kernel::Point_3> points;
  std::vector<std::vector<std::size_t>> polygons;
  if (!CGAL::IO::read_GOCAD(in, name_and_color, points, polygons, CGAL::parameters::default_values()))
    throw IO_error(file, "not a GOCAD file that CGAL can read");
  return to_scan<Kernel>(points, std::move(polygons), file);
}

template <class Kernel>
Scan_file<Kernel> read_vtp([[maybe_unused]] const std::string& file)
{
#ifdef CGAL_USE_VTK
  std::vector<typename Kernel::Point_3> points;
  std::vector<std::vector<std::size_t>> polygons;
  if (!CGAL::IO::read_VTP(file, points, polygons)) throw IO_error(file, "not a VTP file that CGAL can read");
  return to_scan<Kernel>(points, std::move(polygons), file);
#else
  throw IO_error(file, "VTP files are read only where the program was built with VTK");
#endif
}

template <class Kernel>
Scan_file<Kernel> read_las([[maybe_unused]] const std::string& file)
{
#ifdef CGAL_LINKED_WITH_LASLIB
  std::vector<typename Kernel::Point_3> points;
  if (!CGAL::IO::read_LAS(file, std::back_inserter(points))) throw IO_error(file, "not a LAS file that CGAL can read");
  return to_scan<Kernel>(points, {}, file);
#else
  throw IO_error(file, "LAS files are read only where the program was built with LASlib");
#endif
}

} // namespace internal

/*!
\ingroup PkgCrudeRegistrationRef

\brief reads a range scan from a file, whatever it holds.

The format is told by the first bytes of the file where these are unmistakable (PLY, OFF), else by the end of its name:

- `.ply` with an `element range_grid`: a range image, see `read_range_image()`; with faces: a mesh; else points;
- `.off`, `.obj`, `.stl`, `.ts` and, where the program was built with VTK, `.vtp`: a mesh, or points where there is no
face;
- `.ptx` (one scan): a range image, moved to the world as the file says, with a perspective sensor at the scanner's
place;
- `.las`, `.laz`, where the program was built with LASlib: points;
- any other text (`.xyz`, `.txt`, `.pts`, `.csv`, ...): points, one a line. Words are separated by white space, or by
  commas or semicolons if the first line has them; the first three are x, y and z, what follows is passed over. Lines
  that start with `#` or `//` are comments. The first line may name the columns, three of which are `x`, `y` and `z`; a
line before the points may hold their number alone.

Where a mesh's faces do not form an oriented manifold, faces are turned and vertices are split until they do; faces that
name a vertex twice and vertices without a face are left out.

Numbers are read the same whatever the locale of the program is.

\tparam Kernel a model of `Kernel`
\param filename the name of the file

\throws IO_error if the file cannot be opened, does not parse, or has no points; `IO_error::line()` says where, if it is
a text of a format that CGAL does not read for us (`.ts`, `.vtp`, `.las`).
*/
template <class Kernel>
Scan_file<Kernel> read_scan(const std::string& filename)
{
  std::string extension = std::filesystem::path(filename).extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  const std::string data = internal::read_file(filename);
  const std::string_view start = std::string_view(data).substr(0, 4096);
  const auto starts_with = [&](const char* magic) { return start.substr(0, std::string_view(magic).size()) == magic; };

  if (data.empty()) throw IO_error(filename, "the file is empty");
  if (extension == ".ply" || starts_with("ply\n") || starts_with("ply\r"))
    return internal::to_scan<Kernel>(internal::read_ply(data, filename), filename);
  if (extension == ".off" || starts_with("OFF") || starts_with("COFF") || starts_with("NOFF"))
    return internal::to_scan<Kernel>(internal::read_off(data, filename), filename);
  if (extension == ".obj") return internal::to_scan<Kernel>(internal::read_obj(data, filename), filename);
  if (extension == ".stl") return internal::to_scan<Kernel>(internal::read_stl(data, filename), filename);
  if (extension == ".ts") return internal::read_gocad<Kernel>(data, filename);
  if (extension == ".vtp") return internal::read_vtp<Kernel>(filename);
  if (extension == ".las" || extension == ".laz") return internal::read_las<Kernel>(filename);
  Scan_file<Kernel> scan;
  if (extension == ".ptx") {
    scan.kind = Scan_file<Kernel>::RANGE_IMAGE;
    scan.image = internal::read_ptx<Kernel>(data, filename);
    return scan;
  }
  if (start.find('\0') != std::string_view::npos) throw IO_error(filename, "the format of the file is not known");
  scan.points = internal::to_points<Kernel>(internal::Text_point_reader(data, filename).read());
  return scan;
}

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_READ_SCAN_H
