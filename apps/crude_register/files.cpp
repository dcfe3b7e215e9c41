// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "files.h"

#include "json.h"

#include <CGAL/Crude_registration/IO/triangulate_scan.h>

#include <CGAL/IO/PLY.h>
#include <CGAL/IO/io.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <ios>
#include <locale>
#include <sstream>
#include <system_error>

namespace {

// The camera of a JSON file as Open3D writes it: the intrinsic matrix, column by column. `scale`: what stands behind
// the name of the file, a comma and the scale, or nothing; then it is the file's `depth_scale`, or millimetres are
// meant for metres, as there.
CR::Depth_camera read_camera(const std::string& file, const std::string& scale)
{
  std::ifstream in(file);
  if (!in) throw CR::IO_error(file, "the file cannot be opened");
  CR::Depth_camera camera;
  try {
    const Json json = Json::parse(in);
    const std::vector<double> matrix = json.at("intrinsic_matrix").get<std::vector<double>>();
    if (matrix.size() != 9)
      throw CR::IO_error(file, "intrinsic_matrix has " + std::to_string(matrix.size()) + " numbers, not 9");
    constexpr double millimetres_in_a_metre = 1000;
    camera = {matrix[0], matrix[4], matrix[6], matrix[7], json.value("depth_scale", millimetres_in_a_metre)};
  } catch (const Json::exception& e) {
    throw CR::IO_error(file, std::string("not a camera as Open3D writes it: ") + e.what());
  }
  if (!scale.empty()) camera.scale = numbers_of("camera", "0" + scale, 2, "FILE.json,scale").at(1);
  return camera;
}

} // namespace

Mesh mesh_of(const Scan_file& file, const std::optional<Point>& viewpoint)
{
  return with_viewpoint(viewpoint, [&](const auto& np) { return CR::triangulate_scan(file, np); });
}

void forget_sensor(Scan_file& file)
{
  file.image.set_sensor(CR::Sensor<Kernel>());
  file.sensor = CR::Sensor<Kernel>();
}

void scale(Scan_file& file, double factor)
{
  const Transformation scaling(CGAL::SCALING, factor);
  CR::transform(file.image, scaling);
  for (const auto v : file.mesh.vertices()) file.mesh.point(v) = file.mesh.point(v).transform(scaling);
  for (Point& p : file.points) p = p.transform(scaling);
  file.sensor = file.sensor.transformed(scaling);
}

CR::Depth_camera camera_of(const po::variables_map& map, const std::string& scan)
{
  const std::optional<std::string> given = value_of<std::string>(map, "camera");
  const std::filesystem::path path(scan);
  if (path.extension() != ".png" && path.extension() != ".PNG") return CR::Depth_camera();
  const std::filesystem::path beside = std::filesystem::path(path).replace_extension(".json");
  if (!given) return std::filesystem::exists(beside) ? read_camera(beside.string(), "") : CR::Depth_camera();
  const std::size_t json = given->find(".json");
  if (json != std::string::npos) return read_camera(given->substr(0, json + 5), given->substr(json + 5));
  const std::vector<double> numbers = numbers_of("camera", *given, 5, "fx,fy,cx,cy,scale");
  return {numbers[0], numbers[1], numbers[2], numbers[3], numbers[4]};
}

Scan_file read_scan(const po::variables_map& map, const std::string& file)
{
  return CR::read_scan<Kernel>(file, camera_of(map, file));
}

std::optional<Point> viewpoint_of(const Scan_file& file, const std::optional<Point>& given)
{
  return given || !file.sensor.is_perspective() ? given : file.sensor.viewpoint();
}

std::size_t number_of_samples(const Scan_file& file)
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

std::string base_name(const std::string& file)
{
  return std::filesystem::path(file).filename().string();
}

std::string format_by_name(const std::string& file)
{
  std::filesystem::path path(file);
  std::string extension = path.extension().string();
  if (extension == ".gz") extension = path.stem().extension().string();
  extension = extension.substr(0, extension.find('#'));
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  return extension;
}

void make_folder(const std::string& folder)
{
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw CR::IO_error(folder, "the folder cannot be made: " + error.message());
}

void check_output(const std::string& file)
{
  namespace fs = std::filesystem;
  std::error_code error;
  if (fs::is_directory(file, error)) throw CR::IO_error(file, "the file cannot be written: it is a folder");
  const fs::path folder = fs::path(file).parent_path();
  if (!folder.empty() && !fs::is_directory(folder, error))
    throw CR::IO_error(file, "the file cannot be written: there is no folder " + folder.string());
}

std::string in_folder(const std::string& folder, const std::string& name)
{
  return (std::filesystem::path(folder) / name).string();
}

void write_mesh(const std::string& file, const Mesh& mesh)
{
  CR::write_file(file, [&](std::ostream& out) {
    CGAL::IO::set_binary_mode(out);
    CGAL::IO::write_PLY(out, mesh);
  });
}

void write_triangles(const std::string& file, const std::vector<Point>& points,
                     const std::vector<std::array<std::size_t, 3>>& triangles,
                     const std::vector<CGAL::IO::Color>& colours, const Transformation& motion)
{
  const std::uint32_t one = 1;
  std::uint8_t first_byte = 0;
  std::memcpy(&first_byte, &one, 1);
  std::string bytes = std::string("ply\nformat ") + (first_byte == 1 ? "binary_little_endian" : "binary_big_endian") +
                      " 1.0\nelement vertex " + std::to_string(points.size()) +
                      "\nproperty double x\nproperty double y\nproperty double z" +
                      (colours.empty() ? "" : "\nproperty uchar red\nproperty uchar green\nproperty uchar blue") +
                      "\nelement face " + std::to_string(triangles.size()) +
                      "\nproperty list uchar int vertex_indices\nend_header\n";
  const std::size_t bytes_of_colour = colours.empty() ? 0 : 3;
  constexpr std::size_t bytes_of_point = 3 * sizeof(double), bytes_of_triangle = 1 + 3 * sizeof(std::int32_t);
  std::size_t at = bytes.size();
  bytes.resize(at + (bytes_of_point + bytes_of_colour) * points.size() + bytes_of_triangle * triangles.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point p = points[i].transform(motion);
    const std::array<double, 3> x = {p.x(), p.y(), p.z()};
    std::memcpy(&bytes[at], x.data(), bytes_of_point);
    at += bytes_of_point;
    for (std::size_t k = 0; k < bytes_of_colour; ++k) bytes[at++] = char(colours[i][k]);
  }
  for (const auto& t : triangles) {
    const std::array<std::int32_t, 3> corners = {std::int32_t(t[0]), std::int32_t(t[1]), std::int32_t(t[2])};
    bytes[at] = char(3);
    std::memcpy(&bytes[at + 1], corners.data(), 3 * sizeof(std::int32_t));
    at += bytes_of_triangle;
  }
  CR::write_file(file, [&](std::ostream& out) { out.write(bytes.data(), std::streamsize(bytes.size())); });
}

void write_rows(std::ostream& out, const Transformation& motion, const char* indent, const char* end)
{
  for (int i = 0; i < 3; ++i) {
    out << indent;
    for (int j = 0; j < 4; ++j) out << motion.m(i, j) << (j < 3 ? " " : end);
  }
}

std::map<std::string, Transformation> read_poses(const std::string& file)
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
