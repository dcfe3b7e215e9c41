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

#include <CGAL/Crude_registration/IO/Depth_camera.h>
#include <CGAL/Crude_registration/IO/IO_error.h>
#include <CGAL/Crude_registration/IO/read_scan.h>
#include <CGAL/Crude_registration/IO/write_file.h>

#include <CGAL/IO/Color.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

using Transformation = CGAL::Aff_transformation_3<Kernel>;
using Mesh = CGAL::Surface_mesh<Point>;
using Scan_file = CR::Scan_file<Kernel>;

// The surface of a scan.
Mesh mesh_of(const Scan_file& file, const std::optional<Point>& viewpoint);

constexpr const char* camera_help =
    "fx,fy,cx,cy,scale of a depth image, a PNG file of 16 bits: the focal lengths and the image of the axis in pixels, "
    "and "
    "the depths to a unit of length; or FILE.json or FILE.json,scale, with the camera as Open3D writes it; IMAGE.json "
    "beside IMAGE.png if not given";

// As if the file said nothing of its sensor.
void forget_sensor(Scan_file& file);

// In another unit of length.
void scale(Scan_file& file, double factor);

// The camera of a depth image: that of --camera, or of the file with the same name and the end .json beside it.
CR::Depth_camera camera_of(const po::variables_map& map, const std::string& scan);

Scan_file read_scan(const po::variables_map& map, const std::string& file);

// The viewpoint that is given, or the one that the file says for points or a mesh.
std::optional<Point> viewpoint_of(const Scan_file& file, const std::optional<Point>& given);

std::size_t number_of_samples(const Scan_file& file);

std::string base_name(const std::string& file);

// The end of a file's name, which says its format: in small letters, without that of gzip and the number of a scan.
std::string format_by_name(const std::string& file);

void make_folder(const std::string& folder);

// Told before the work: where a file cannot be written.
void check_output(const std::string& file);

std::string in_folder(const std::string& folder, const std::string& name);

void write_mesh(const std::string& file, const Mesh& mesh);

// Triangles moved, as write_mesh() writes them: a fraction of the time. `colours`: of the points, one each, or none.
void write_triangles(const std::string& file, const std::vector<Point>& points,
                     const std::vector<std::array<std::size_t, 3>>& triangles,
                     const std::vector<CGAL::IO::Color>& colours, const Transformation& motion);

void write_rows(std::ostream& out, const Transformation& motion, const char* indent, const char* end);

// Poses of scans in a common frame: a line each, the name of the file and the rows of the 3 x 4 matrix.
std::map<std::string, Transformation> read_poses(const std::string& file);

#endif // CRUDE_REGISTER_FILES_H
