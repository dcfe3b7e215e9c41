// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// The colours of files: each with its point, whatever becomes of the points.

#define BOOST_TEST_MODULE colors
#include <boost/test/unit_test.hpp>

#include "scan_files.h"

#include <CGAL/Crude_registration/IO/write_range_image.h>

#include <CGAL/IO/Color.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

using namespace generated;
using Color = CGAL::IO::Color;
using Colors = std::vector<Color>;

namespace {

template <class T>
std::string bytes(T value) // of little-endian machines, as the tests' files are
{
  std::string result(sizeof value, '\0');
  std::memcpy(result.data(), &value, sizeof value);
  return result;
}

const Colors expected = {Color(255, 0, 10), Color(0, 128, 20), Color(7, 8, 255)};

bool are_equal(const Colors& colors, const Colors& others)
{
  return colors == others;
}

} // namespace

BOOST_AUTO_TEST_CASE(points_of_ply)
{
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string plain = head +
                            "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n"
                            "end_header\n1 2 3 255 0 10 9\n4 5 6 0 128 20 9\n7 8 9 7 8 255 9\n";
  BOOST_TEST(are_equal(read("a.ply", plain).colors, expected));
  const std::string shares = head + "property float blue\nproperty float green\nproperty float red\nend_header\n"
                                    "1 2 3 0 0.5 1\n4 5 6 2 -1 nan\n7 8 9 1 1 0.002\n";
  BOOST_TEST(are_equal(read("a.ply", shares).colors, {Color(255, 128, 0), Color(0, 0, 255), Color(1, 255, 255)}));
  const std::string of_16_bits = head + "property ushort red\nproperty ushort green\nproperty ushort blue\nend_header\n"
                                        "1 2 3 65535 0 2570\n4 5 6 0 32896 5140\n7 8 9 1799 2056 65535\n";
  BOOST_TEST(are_equal(read("a.ply", of_16_bits).colors, expected));
  // two parts are no colour
  BOOST_TEST(
      read("a.ply", head + "property uchar red\nproperty uchar green\nend_header\n1 2 3 1 1\n4 5 6 1 1\n7 8 9 1 1\n")
          .colors.empty());
}

BOOST_AUTO_TEST_CASE(vertices_that_go_or_are_split)
{
  // The second vertex is in no face; two triangles meet in one vertex only, which is split.
  const std::string file =
      "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 2\n"
      "property list uchar int vertex_indices\nend_header\n"
      "0 0 0 1 1 1\n9 9 9 2 2 2\n1 0 0 3 3 3\n0 1 0 4 4 4\n-1 0 0 5 5 5\n0 -1 0 6 6 6\n3 0 2 3\n3 0 4 5\n";
  const Scan scan = read("a.ply", file);
  BOOST_REQUIRE(scan.colors.size() == scan.mesh.number_of_vertices());
  BOOST_TEST(scan.colors.size() == 6);
  for (const auto v : scan.mesh.vertices()) {
    const Point p = scan.mesh.point(v);
    const int part = p.x() > 0 ? 3 : p.y() > 0 ? 4 : p.x() < 0 ? 5 : p.y() < 0 ? 6 : 1;
    BOOST_TEST(int(scan.colors[std::size_t(v)].green()) == part);
  }
}

BOOST_AUTO_TEST_CASE(pcd_packs_them)
{
  for (const std::string type : {"U", "F"}) {
    const std::string head =
        "FIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F " + type + "\nCOUNT 1 1 1 1\nWIDTH 4\nHEIGHT 1\n";
    std::string binary, text;
    const float coordinates[4] = {1, std::stof("nan"), 2, 3};
    const Colors packed = {expected[0], Color(1, 1, 1), expected[1], expected[2]};
    for (std::size_t i = 0; i < 4; ++i) {
      const std::uint32_t bits = std::uint32_t(packed[i].red()) << 16 | std::uint32_t(packed[i].green()) << 8 |
                                 std::uint32_t(packed[i].blue());
      float as_float;
      std::memcpy(&as_float, &bits, sizeof bits);
      for (int k = 0; k < 3; ++k) binary += bytes(coordinates[i]);
      binary += bytes(bits);
      std::ostringstream line;
      line.precision(9);
      line << coordinates[i] << " 5 6 ";
      if (type == "F") line << as_float << '\n';
      else line << bits << '\n';
      text += line.str();
    }
    // the point that is no sample takes its colour with it
    const Scan scan = read("a.pcd", head + "DATA binary\n" + binary);
    BOOST_TEST(scan.points.size() == 3);
    BOOST_TEST(are_equal(scan.colors, expected));
    BOOST_TEST(are_equal(read("a.pcd", head + "DATA ascii\n" + text).colors, expected));
  }
}

BOOST_AUTO_TEST_CASE(ptx_has_them_behind_the_intensity)
{
  const std::string head = "2\n2\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
  const Scan scan =
      read("a.ptx", head + "1 0 9 0.5 255 0 10\n1 1 9 0.5 0 128 20\n0 0 0 0.5 1 1 1\n2 1 9 0.5 7 8 255\n");
  BOOST_TEST(scan.image.points().size() == 3);
  BOOST_TEST(are_equal(scan.colors, expected));
  BOOST_TEST(read("a.ptx", head + "1 0 9 0.5\n1 1 9 0.5\n0 0 0 0.5\n2 1 9 0.5\n").colors.empty());
  BOOST_TEST(read("a.ptx", head + "1 0 9 0.5 1 1 1\n1 1 9 0.5\n0 0 0 0.5\n2 1 9 0.5\n").colors.empty());
}

BOOST_AUTO_TEST_CASE(las_has_them_in_some_formats)
{
  const auto las = [](char format, std::size_t record, std::size_t at, std::uint16_t unit) {
    std::string file(227, '\0');
    file.replace(0, 4, "LASF");
    file[24] = 1;
    file[25] = 2;
    file.replace(96, 4, bytes(std::uint32_t(227)));
    file[104] = format;
    file.replace(105, 2, bytes(std::uint16_t(record)));
    file.replace(107, 4, bytes(std::uint32_t(3)));
    for (std::size_t i = 0; i < 3; ++i) file.replace(131 + 8 * i, 8, bytes(0.01));
    for (std::size_t i = 0; i < 3; ++i) {
      std::string point(record, '\0');
      for (std::size_t k = 0; k < 3; ++k) point.replace(4 * k, 4, bytes(std::int32_t(1 + i * 7 + k)));
      for (int k = 0; k < 3; ++k)
        point.replace(at + 2 * std::size_t(k), 2, bytes(std::uint16_t(unit * expected[i][std::size_t(k)])));
      file += point;
    }
    return file;
  };
  for (const std::uint16_t unit : {std::uint16_t(257), std::uint16_t(1)}) { // of 16 bits, and those filled up to 255
    BOOST_TEST(are_equal(read("a.las", las(2, 26, 20, unit)).colors, expected));
    BOOST_TEST(are_equal(read("a.las", las(3, 34, 28, unit)).colors, expected));
    BOOST_TEST(are_equal(read("a.las", las(7, 40, 30, unit)).colors, expected)); // longer than it need be
  }
  BOOST_TEST(read("a.las", las(1, 34, 28, 257)).colors.empty());
  BOOST_TEST(read("a.las", las(3, 34, 28, 0)).colors.empty());
}

BOOST_AUTO_TEST_CASE(text_has_them_behind_the_points)
{
  BOOST_TEST(are_equal(read("a.xyz", "1 2 3 255 0 10\n4 5 6 0 128 20\n0 8 9.5 7 8 255\n").colors, expected));
  BOOST_TEST(are_equal(read("a.csv", "1;2;3;255;0;10\n4;5;6;0;128;20\n0;8;9,5;7;8;255\n").colors, expected));
  // a point that is none takes its colour along
  const auto file = read("a.xyz", "1 2 3 255 0 10\nnan nan nan 1 1 1\n4 5 6 0 128 20\n7 8 9.5 7 8 255\n");
  BOOST_TEST(are_equal(file.colors, expected));
  BOOST_TEST(file.normals.empty());
  // PTS: the intensity, then the colour; behind a number of the point, too
  BOOST_TEST(are_equal(read("a.pts", "3\n1 2 3 7 255 0 10\n4 5 6 8 0 128 20\n7 8 9.5 9 7 8 255\n").colors, expected));
  BOOST_TEST(are_equal(read("a.PTS", "3\n1 2 3 -7 255 0 10\n4 5 6 8 0 128 20\n7 8 9.5 9 7 8 255\n").colors, expected));
  BOOST_TEST(are_equal(read("a.txt", "1 2 2 3 255 0 10\n2 4 5 6 0 128 20\n3 7 8 9.5 7 8 255\n").colors, expected));
  // a value behind the colour, which is no part of one; where both might be the colour there is none
  BOOST_TEST(are_equal(read("a.txt", "1 2 3 255 0 10 .5\n4 5 6 0 128 20 .5\n0 8 9.5 7 8 255 .5\n").colors, expected));
  BOOST_TEST(read("a.txt", "1 2 3 255 0 10 5\n4 5 6 0 128 20 5\n0 8 9.5 7 8 255 5\n").colors.empty());
  // with normals, in either order
  for (const char* text : {"1 2 3 255 0 10 1 0 0\n4 5 6 0 128 20 0 1 0\n0 8 9.5 7 8 255 0 0 1\n",
                           "1 2 3 1 0 0 255 0 10\n4 5 6 0 1 0 0 128 20\n0 8 9.5 0 0 1 7 8 255\n"}) {
    const auto both = read("a.xyz", text);
    BOOST_TEST(are_equal(both.colors, expected));
    BOOST_TEST_REQUIRE(both.normals.size() == 3u);
    BOOST_TEST((both.normals[0] == Kernel::Vector_3(1, 0, 0) && both.normals[2] == Kernel::Vector_3(0, 0, 1)));
  }
  // by the names of the columns, as shares and as numbers of 16 bits as well
  BOOST_TEST(are_equal(read("a.csv", "Red,x,y,z,Blue,Green\n255,1,2,3,10,0\n0,4,5,6,20,128\n7,7,8,9,255,8\n").colors,
                       expected));
  BOOST_TEST(are_equal(read("a.csv", "x,y,z,r,g,b\n1,2,3,0,.5,1\n4,5,6,1,1,0\n").colors,
                       {Color(0, 128, 255), Color(255, 255, 0)}));
  BOOST_TEST(are_equal(read("a.csv", "x,y,z,r,g,b\n1,2,3,0,65535,32768\n").colors, {Color(0, 255, 128)}));
  BOOST_TEST(read("a.csv", "x,y,z,r,g,b\n1,2,3,-1,0,0\n").colors.empty());
  // neither colours nor normals: other values, or not in all lines
  BOOST_TEST(read("a.xyz", "1 2 3 256 0 10\n4 5 6 0 128 20\n").colors.empty());
  BOOST_TEST(read("a.xyz", "1 2 3 2.5 0 10\n4 5 6 0 128 20\n").colors.empty());
  BOOST_TEST(read("a.xyz", "1 2 3 255 0 10\n4 5 6\n").colors.empty());
}

BOOST_AUTO_TEST_CASE(arrays_have_them_behind_the_points)
{
  const auto npy = [](const std::string& shape, const std::vector<double>& numbers) {
    const std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (" + shape + "), }\n";
    std::string text = std::string("\x93NUMPY\1\0", 8) + bytes(std::uint16_t(header.size())) + header;
    for (const double x : numbers) text += bytes(x);
    return text;
  };
  BOOST_TEST(are_equal(
      read("a.npy", npy("3, 6", {1, 2, 3, 255, 0, 10, 4, 5, 6, 0, 128, 20, 7, 8, 9, 7, 8, 255})).colors, expected));
  for (const bool colors_first : {true, false}) {
    const std::vector<double> table =
        colors_first ? std::vector<double>{1, 2, 3, 9, 0, 10, 1, 0, 0, 4, 5, 7, 0, 128, 20, 0, 0, 1}
                     : std::vector<double>{1, 2, 3, 1, 0, 0, 9, 0, 10, 4, 5, 7, 0, 0, 1, 0, 128, 20};
    const auto file = read("a.npy", npy("2, 9", table));
    BOOST_TEST(are_equal(file.colors, {Color(9, 0, 10), Color(0, 128, 20)}));
    BOOST_TEST_REQUIRE(file.normals.size() == 2u);
    BOOST_TEST((file.normals[1] == Kernel::Vector_3(0, 0, 1)));
  }
  BOOST_TEST(read("a.npy", npy("1, 6", {1, 2, 3, 0, 0, 256})).colors.empty());
}

BOOST_AUTO_TEST_CASE(obj_and_off)
{
  const std::string faces = "f 1 2 3\n";
  BOOST_TEST(are_equal(read("a.obj", "v 0 0 0 1 0 0.04\nv 1 0 0 0 0.502 0.08\nv 0 1 0 0.028 0.031 1\n" + faces).colors,
                       {Color(255, 0, 10), Color(0, 128, 20), Color(7, 8, 255)}));
  BOOST_TEST(read("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + faces).colors.empty());
  BOOST_TEST(read("a.obj", "v 0 0 0 1 1 1\nv 1 0 0\nv 0 1 0\n" + faces).colors.empty());
  BOOST_TEST(are_equal(
      read("a.off", "COFF\n3 1 0\n0 0 0 255 0 10 255\n1 0 0 0 128 20 255\n0 1 0 7 8 255 255\n3 0 1 2\n").colors,
      expected));
  BOOST_TEST(are_equal(
      read("a.off", "CNOFF\n3 1 0\n0 0 0 0 0 1 255 0 10\n1 0 0 0 0 1 0 128 20\n0 1 0 0 0 1 7 8 255\n3 0 1 2\n").colors,
      expected));
  BOOST_TEST(read("a.off", "OFF\n3 1 0\n0 0 0 1 1 1\n1 0 0 1 1 1\n0 1 0 1 1 1\n3 0 1 2\n").colors.empty());
}

BOOST_AUTO_TEST_CASE(range_images_are_read_back_with_them)
{
  CR::Range_image<Kernel> image(2, 2);
  image.set_sample(0, 0, Point(0, 0, 1));
  image.set_sample(1, 1, Point(1, 1, 1.5));
  image.set_sample(0, 1, Point(0, 1, 1));
  std::ostringstream file;
  CR::write_range_image(file, image, expected);
  const Scan scan = read("a.ply", file.str());
  BOOST_TEST((scan.kind == Scan::RANGE_IMAGE));
  BOOST_TEST((scan.image.points() == image.points()));
  BOOST_TEST(are_equal(scan.colors, expected));
  BOOST_CHECK_THROW(CR::write_range_image(file, image, Colors(2)), std::invalid_argument);
}
