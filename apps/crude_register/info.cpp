// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// info: says what is in a scan, and what the method makes of it.

#include "commands.h"
#include "files.h"
#include "json.h"
#include "options.h"
#include "scan_arguments.h"

#include <CGAL/Crude_registration/Sensor.h>
#include <CGAL/Crude_registration/reduction/approximation_error.h>
#include <CGAL/Crude_registration/reduction/scan_extent.h>
#include <CGAL/Crude_registration/reduction/simplify_scan.h>
#include <CGAL/Crude_registration/reduction/surface_types.h>
#include <CGAL/Crude_registration/sampling/estimate_sensor.h>
#include <CGAL/Crude_registration/sampling/sampling_distance.h>

#include <cstddef>
#include <iomanip>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

std::string name_of(const CR::Sensor<Kernel>& sensor)
{
  return sensor.is_perspective() ? "perspective" : sensor.is_orthographic() ? "orthographic" : "unknown";
}

// How many of the file's normals are there, and how many of these are turned to the sensor.
struct Normals
{
  std::size_t given = 0, towards = 0;
};

Normals normals_of(const Scan_file& file, const CR::Sensor<Kernel>& sensor)
{
  Normals normals;
  const std::vector<Point>& points = file.kind == Scan_file::RANGE_IMAGE ? file.image.points() : file.points;
  for (std::size_t i = 0; i < file.normals.size(); ++i) {
    if (file.normals[i] == CGAL::NULL_VECTOR) continue;
    ++normals.given;
    if (sensor.is_known() && sensor.line_of_sight(points[i]) * file.normals[i] < 0) ++normals.towards;
  }
  return normals;
}

} // namespace

int run_info(const std::vector<std::string>& arguments)
{
  po::options_description options("options");
  auto add = options.add_options();
  add("viewpoint", po::value<std::string>(), "x,y,z of the sensor, for scans whose files do not tell it");
  add("camera", po::value<std::string>(), camera_help);
  add("json", "print JSON");
  const Command command = {
      "info",
      "SCAN",
      "Says what is in a scan, and what sections 4 and 5 of the method make of it: the sampling distance s,\nthe "
      "extent A "
      "in the image plane and the mean extent M, the share of smooth vertices, the approximation\nerror epsilon, and "
      "the "
      "vertices that the simplification leaves.\n",
      {{"scan.ply", "what is in a scan"}, {"scan.xyz --viewpoint 0,0,0", "of points that a sensor at the origin saw"}},
      {}};
  const auto given = parse(command, options, {"SCAN"}, arguments);
  if (!given) return 0;
  const po::variables_map& map = *given;
  const std::string name = scan_of_argument(map["SCAN"].as<std::string>());
  const Scan_file file = read_scan(map, name);
  const std::optional<Point> viewpoint = viewpoint_of(file, point_of(map, "viewpoint"));
  Mesh mesh = mesh_of(file, viewpoint);
  if (mesh.number_of_faces() == 0) throw std::invalid_argument(name + ": the scan has no surface: no face is left");

  const bool is_image = file.kind == Scan_file::RANGE_IMAGE;
  CR::Sensor<Kernel> sensor;
  CR::Scan_extent extent;
  double s = 0, epsilon = 0;
  if (is_image) {
    sensor = file.image.sensor().is_known() ? file.image.sensor() : CR::estimate_sensor(file.image);
    s = CR::sampling_distance(file.image);
    extent = CR::scan_extent(file.image);
    epsilon = CR::approximation_error(file.image);
  } else {
    if (viewpoint) sensor = CR::Sensor<Kernel>::perspective(*viewpoint);
    s = CR::sampling_distance(mesh);
    with_viewpoint(viewpoint, [&](const auto& np) {
      extent = CR::scan_extent(mesh, np);
      epsilon = CR::approximation_error(mesh, np);
    });
  }
  const auto types = mesh.add_property_map<Mesh::Vertex_index, CR::Surface_type>("v:type").first;
  const CR::Surface_type_counts counts = CR::surface_types(mesh, types);
  const std::size_t faces = mesh.number_of_faces();
  const std::size_t simplified = CR::simplify_scan(mesh, CR::parameters::approximation_error(epsilon));
  const Normals normals = normals_of(file, sensor);
  const char* const kind = is_image ? "range image" : file.kind == Scan_file::MESH ? "mesh" : "points";

  if (map.count("json") > 0) {
    Json json = answer_of("info");
    json["scan"] = name;
    json["kind"] = kind;
    json["samples"] = number_of_samples(file);
    if (is_image) {
      json["columns"] = file.image.columns();
      json["rows"] = file.image.rows();
    }
    json["missing"] = file.missing;
    json["sensor"] = name_of(sensor);
    json["normals"] = normals.given;
    if (normals.given > 0 && sensor.is_known()) json["normals_towards_sensor"] = normals.towards;
    json["notes"] = file.notes;
    json["faces"] = faces;
    json["sampling_distance"] = s;
    json["extent"] = {extent.horizontal, extent.vertical, extent.depth};
    json["image_size"] = extent.image_size();
    json["mean_extent"] = extent.mean();
    json["vertices"] = {{"planar", counts.planar},
                        {"parabolic", counts.parabolic},
                        {"elliptic", counts.elliptic},
                        {"hyperbolic", counts.hyperbolic}};
    json["percent_smooth"] = counts.percent_smooth();
    json["approximation_error"] = epsilon;
    json["simplified_vertices"] = simplified;
    std::cout << to_text(json) << '\n';
    return 0;
  }
  std::cout << "scan:       " << name << ", " << kind << '\n' << "samples:    " << number_of_samples(file);
  if (is_image) std::cout << " in a grid of " << file.image.columns() << " x " << file.image.rows();
  if (file.missing > 0) std::cout << "\nmissing:    " << file.missing << " more, NaN, infinite or at range zero";
  std::cout << "\nsensor:     " << name_of(sensor);
  if (normals.given > 0) {
    std::cout << "\nnormals:    " << normals.given << " in the file";
    if (sensor.is_known()) std::cout << ", " << normals.towards << " of them towards the sensor";
  }
  for (const std::string& note : file.notes) std::cout << "\nnote:       " << note;
  std::cout << "\nfaces:      " << faces << std::setprecision(6) << "\ns:          " << s
            << "\nextent:     " << extent.horizontal << " x " << extent.vertical << " x " << extent.depth
            << ", A = " << extent.image_size() << ", M = " << extent.mean() << "\nvertices:   " << counts.planar
            << " planar, " << counts.parabolic << " parabolic, " << counts.elliptic << " elliptic, "
            << counts.hyperbolic << " hyperbolic\nsmooth:     " << counts.percent_smooth()
            << " %\nepsilon:    " << epsilon << " (mean squared distance)\nsimplified: " << simplified << " vertices\n";
  return 0;
}
