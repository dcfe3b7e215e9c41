// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// convert: writes a scan in another format.

#include "commands.h"
#include "files.h"
#include "options.h"
#include "scan_arguments.h"
#include "colours.h"
#include "surfaces.h"

#include <CGAL/Crude_registration/IO/write_range_image.h>

#include <CGAL/IO/write_ply_points.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iostream>
#include <limits>
#include <optional>
#include <ostream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace {

// The samples as they stand in a grid, NaN where there is none, or one behind the other.
struct Table
{
  std::size_t columns = 0, rows = 1;
  bool is_grid = false, has_normals = false;
  std::vector<std::array<double, 6>> samples; // a point and its normal
  Colours colours;                            // as many, or none
};

Table table_of(const Scan_file& scan)
{
  Table table;
  const std::vector<Point> points = points_of(scan);
  table.has_normals = !scan.normals.empty();
  const auto sample = [&](std::size_t i) {
    const Direction n = table.has_normals ? scan.normals[i] : CGAL::NULL_VECTOR;
    return std::array<double, 6>{points[i].x(), points[i].y(), points[i].z(), n.x(), n.y(), n.z()};
  };
  table.is_grid = scan.kind == Scan_file::RANGE_IMAGE;
  if (!table.is_grid) {
    table.columns = points.size();
    for (std::size_t i = 0; i < points.size(); ++i) table.samples.push_back(sample(i));
    table.colours = scan.colors;
    return table;
  }
  table.columns = scan.image.columns();
  table.rows = scan.image.rows();
  std::array<double, 6> missing;
  missing.fill(std::numeric_limits<double>::quiet_NaN());
  for (const auto i : scan.image.grid()) {
    const bool is_missing = i == CR::Range_image<Kernel>::no_sample;
    table.samples.push_back(is_missing ? missing : sample(std::size_t(i)));
    if (!scan.colors.empty()) table.colours.push_back(is_missing ? CGAL::IO::black() : scan.colors[std::size_t(i)]);
  }
  return table;
}

void write_numbers(std::ostream& out, const std::array<double, 6>& numbers, std::size_t count, char separator)
{
  std::array<char, 32> text;
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) out.put(separator);
    out.write(text.data(), std::to_chars(text.data(), text.data() + text.size(), numbers[i]).ptr - text.data());
  }
}

// A colour as PCL writes it: the bytes 0, red, green and blue as those of a float.
void write_packed(std::ostream& out, const CGAL::IO::Color& c)
{
  const std::uint32_t bits = std::uint32_t(c.red()) << 16 | std::uint32_t(c.green()) << 8 | std::uint32_t(c.blue());
  float number;
  std::memcpy(&number, &bits, sizeof number);
  std::array<char, 32> text;
  out.write(text.data(), std::to_chars(text.data(), text.data() + text.size(), number).ptr - text.data());
}

// Samples that are there, one a line.
void write_text(std::ostream& out, const Table& table, char separator)
{
  const std::size_t count = table.has_normals ? 6 : 3;
  if (separator == ',') out << (table.has_normals ? "x,y,z,nx,ny,nz\n" : "x,y,z\n");
  for (const auto& s : table.samples)
    if (s[0] == s[0]) {
      write_numbers(out, s, count, separator);
      out.put('\n');
    }
}

void write_pcd(std::ostream& out, const Table& table, const CR::Sensor<Kernel>& sensor)
{
  const bool normals = table.has_normals, colours = !table.colours.empty();
  out << "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z"
      << (normals ? " normal_x normal_y normal_z" : "") << (colours ? " rgb" : "") << "\nSIZE 4 4 4"
      << (normals ? " 4 4 4" : "") << (colours ? " 4" : "") << "\nTYPE F F F" << (normals ? " F F F" : "")
      << (colours ? " F" : "") << "\nCOUNT 1 1 1" << (normals ? " 1 1 1" : "") << (colours ? " 1" : "") << "\nWIDTH "
      << table.columns << "\nHEIGHT " << table.rows << "\nVIEWPOINT ";
  if (sensor.is_perspective()) {
    const Point p = sensor.viewpoint();
    out << p.x() << ' ' << p.y() << ' ' << p.z();
  } else {
    out << "0 0 0";
  }
  out << " 1 0 0 0\nPOINTS " << table.samples.size() << "\nDATA ascii\n";
  for (std::size_t i = 0; i < table.samples.size(); ++i) {
    write_numbers(out, table.samples[i], normals ? 6 : 3, ' ');
    if (colours) write_packed(out << ' ', table.colours[i]);
    out.put('\n');
  }
}

// An array of f8, little-endian: rows x columns x 3 of a range image, n x 3 or n x 6 of points.
void write_npy(std::ostream& out, const Table& table)
{
  const std::size_t width = table.is_grid || !table.has_normals ? 3 : 6;
  const std::string shape = table.is_grid ? std::to_string(table.rows) + ", " + std::to_string(table.columns) + ", 3"
                                          : std::to_string(table.columns) + ", " + std::to_string(width);
  std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (" + shape + "), }";
  constexpr std::size_t fixed = 10, alignment = 64; // as NumPy does
  header.append(alignment - 1 - (fixed + header.size()) % alignment, ' ');
  header += '\n';
  out << "\x93NUMPY" << '\1' << '\0' << char(header.size() & 255) << char(header.size() >> 8) << header;
  for (const auto& s : table.samples)
    for (std::size_t k = 0; k < width; ++k) {
      std::uint64_t bits;
      std::memcpy(&bits, &s[k], sizeof bits);
      for (std::size_t b = 0; b < sizeof bits; ++b) out.put(char(bits >> 8 * b & 255));
    }
}

void write_ply_points(std::ostream& out, const Scan_file& scan)
{
  using Part = unsigned char; // of a colour
  using Sample = std::tuple<Point, Direction, Part, Part, Part>;
  std::vector<Sample> samples;
  const bool normals = !scan.normals.empty(), colours = !scan.colors.empty();
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const CGAL::IO::Color c = colours ? scan.colors[i] : CGAL::IO::white();
    samples.emplace_back(scan.points[i], normals ? scan.normals[i] : CGAL::NULL_VECTOR, c.red(), c.green(), c.blue());
  }
  CGAL::IO::set_binary_mode(out);
  const auto point = [] { return CGAL::make_ply_point_writer(CGAL::Nth_of_tuple_property_map<0, Sample>()); };
  const auto normal = [] { return CGAL::make_ply_normal_writer(CGAL::Nth_of_tuple_property_map<1, Sample>()); };
  const auto red = [] {
    return std::make_pair(CGAL::Nth_of_tuple_property_map<2, Sample>(), CGAL::PLY_property<Part>("red"));
  };
  const auto green = [] {
    return std::make_pair(CGAL::Nth_of_tuple_property_map<3, Sample>(), CGAL::PLY_property<Part>("green"));
  };
  const auto blue = [] {
    return std::make_pair(CGAL::Nth_of_tuple_property_map<4, Sample>(), CGAL::PLY_property<Part>("blue"));
  };
  if (normals && colours) CGAL::IO::write_PLY_with_properties(out, samples, point(), normal(), red(), green(), blue());
  else if (normals) CGAL::IO::write_PLY_with_properties(out, samples, point(), normal());
  else if (colours) CGAL::IO::write_PLY_with_properties(out, samples, point(), red(), green(), blue());
  else CGAL::IO::write_PLY(out, scan.points);
}

constexpr const char* written_formats = ".ply, .off, .obj, .stl, .pcd, .npy, .xyz, .txt, .asc or .csv";

void write_scan(const std::string& file, const Scan_file& scan, const std::optional<Point>& viewpoint)
{
  const std::string format = format_by_name(file);
  const bool is_surface = format == ".off" || format == ".obj" || format == ".stl";
  const auto& sensor = scan.kind == Scan_file::RANGE_IMAGE ? scan.image.sensor() : scan.sensor;
  if (format == ".ply" && scan.kind == Scan_file::RANGE_IMAGE) {
    CR::write_range_image(file, scan.image, scan.colors);
    return;
  }
  if (is_surface || (format == ".ply" && scan.kind == Scan_file::MESH)) {
    Mesh mesh = mesh_of(scan, viewpoint);
    add_colours(scan, mesh);
    if (mesh.number_of_faces() == 0) throw CR::IO_error(file, "the scan has no surface that could be written");
    CR::write_file(file, [&](std::ostream& out) {
      if (format == ".ply" || format == ".stl") CGAL::IO::set_binary_mode(out);
      if (format == ".ply") CGAL::IO::write_PLY(out, mesh);
      if (format == ".stl") CGAL::IO::write_STL(out, mesh);
      if (format == ".off") CGAL::IO::write_OFF(out, mesh);
      if (format == ".obj") CGAL::IO::write_OBJ(out, mesh);
    });
    return;
  }
  const Table table = table_of(scan);
  CR::write_file(file, [&](std::ostream& out) {
    if (format == ".ply") write_ply_points(out, scan);
    else if (format == ".pcd") write_pcd(out, table, sensor);
    else if (format == ".npy") write_npy(out, table);
    else write_text(out, table, format == ".csv" ? ',' : ' ');
  });
}

} // namespace

int run_convert(const std::vector<std::string>& arguments)
{
  po::options_description options("options");
  auto add = options.add_options();
  add("viewpoint", po::value<std::string>(),
      "x,y,z of the sensor, for a surface of points whose file does not tell it");
  add("camera", po::value<std::string>(), camera_help);
  const Command command = {
      "convert",
      "SCAN OUTPUT",
      "Writes what is read of a scan (points, normals, faces, the grid and the sensor of a range image) to a file "
      "whose\n"
      "name ends in .ply, .off, .obj, .stl, .pcd, .npy, .xyz, .txt, .asc or .csv. Range images and points become a "
      "surface for\n.off, .obj and .stl, meshes points for .pcd, .npy and text. Colours are kept in .ply, .off and "
      ".pcd.\n",
      {{"depth.png scan.ply", "a depth image as a range image in PLY"},
       {"scan.ptx#2 scan.obj", "the second scan of a PTX file as a surface"}},
      {}};
  const auto given = parse(command, options, {"SCAN", "OUTPUT"}, arguments);
  if (!given) return 0;
  const po::variables_map& map = *given;
  const std::string name = scan_of_argument(map["SCAN"].as<std::string>()), output = map["OUTPUT"].as<std::string>();
  const std::optional<Point> viewpoint = point_of(map, "viewpoint");
  check_output(output);
  static constexpr std::array<const char*, 10> known = {".ply", ".off", ".obj", ".stl", ".pcd",
                                                        ".npy", ".xyz", ".txt", ".asc", ".csv"};
  const bool is_known = std::find(known.begin(), known.end(), format_by_name(output)) != known.end();
  if (!is_known || std::filesystem::path(output).extension() == ".gz")
    throw CR::IO_error(output, std::string("the name of what is written has to end in ") + written_formats);
  const Scan_file scan = read_scan(map, name);
  write_scan(output, scan, viewpoint_of(scan, viewpoint));
  std::cout << "written: " << output << '\n';
  return 0;
}
