// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// Files that are written moved: all else in them stays, byte by byte.

#define BOOST_TEST_MODULE apply_motion
#include <boost/test/unit_test.hpp>

#include "scan_files.h"

#include <CGAL/Crude_registration/IO/apply_motion.h>
#include <CGAL/Crude_registration/IO/internal/lzf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using namespace generated;

namespace {

// x, y, z to 10 - y, 20 + x, 30 + z, of which nothing is rounded.
const Motion quarter_turn(0, -1, 0, 10, 1, 0, 0, 20, 0, 0, 1, 30);

// By Rodrigues' formula, and no library.
Motion general_motion()
{
  const double a[3] = {2. / 7, -3. / 7, 6. / 7}, c = std::cos(2.), s = std::sin(2.);
  const double k[3][3] = {{0, -a[2], a[1]}, {a[2], 0, -a[0]}, {-a[1], a[0], 0}};
  double r[3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) r[i][j] = (i == j ? c : 0) + s * k[i][j] + (1 - c) * a[i] * a[j];
  return Motion(r[0][0], r[0][1], r[0][2], 0.3, r[1][0], r[1][1], r[1][2], -7, r[2][0], r[2][1], r[2][2], 123);
}

std::string contents_of(const std::string& file)
{
  std::ifstream in(file, std::ios::binary);
  return std::string((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
}

// The file with these contents, moved.
std::string moved(const std::string& name, const std::string& contents, const Motion& motion = quarter_turn)
{
  const std::string out = folder().file("moved_" + name, "");
  CR::apply_motion(folder().file(name, contents), out, motion);
  return contents_of(out);
}

std::string refusal_of(const std::string& name, const std::string& contents)
{
  const std::string file = folder().file(name, contents), out = (folder().path() / "refused").string();
  std::string text;
  try {
    CR::check_motion_can_be_applied(file);
  } catch (const CR::IO_error& error) {
    text = error.what();
  }
  BOOST_CHECK_THROW(CR::apply_motion(file, out, quarter_turn), CR::IO_error);
  BOOST_TEST(!std::filesystem::exists(out));
  BOOST_TEST(text.find(file + ":") == 0, text);
  BOOST_TEST(text.find('\n') == std::string::npos);
  return text;
}

template <class T>
std::string bytes(T value, bool big_endian = false)
{
  unsigned char b[sizeof(T)];
  std::memcpy(b, &value, sizeof(T));
  const std::uint16_t one = 1;
  if ((*reinterpret_cast<const unsigned char*>(&one) == 1) == big_endian) std::reverse(b, b + sizeof(T));
  return std::string(b, b + sizeof(T));
}

constexpr double nan_ = std::numeric_limits<double>::quiet_NaN();
using Numbers = std::vector<double>;

// Three points and normals, for what follows, and the same moved by the quarter turn.
const std::vector<Numbers> given = {{1, 2, 3, 0, 0, 1}, {-4, 5.5, 6, 0, -1, 0}, {0.5, 0, -0.25, 1, 0, 0}};
const std::vector<Numbers> given_moved = {{8, 21, 33, 0, 0, 1}, {4.5, 16, 36, 1, 0, 0}, {10, 20.5, 29.75, 0, 1, 0}};

std::string ply(const std::vector<Numbers>& rows, bool big_endian, bool doubles)
{
  const std::string type = doubles ? "double" : "float";
  std::string file = std::string("ply\nformat binary_") + (big_endian ? "big" : "little") +
                     "_endian 1.0\ncomment x y z\nelement extra 2\nproperty list uchar short values\nelement vertex 3\n"
                     "property uchar red\nproperty float x\nproperty list uchar int marks\nproperty " +
                     type + " y\nproperty " + type +
                     " z\nproperty float nx\nproperty float ny\nproperty double nz\nproperty int intensity\n"
                     "element face 1\nproperty uchar flag\nproperty list uchar int vertex_indices\nend_header\n";
  const auto real = [&](double x) { return doubles ? bytes(x, big_endian) : bytes(float(x), big_endian); };
  file += "\2" + bytes(std::int16_t(-3), big_endian) + bytes(std::int16_t(7), big_endian) + std::string(1, '\0');
  for (std::size_t i = 0; i < 3; ++i) {
    const Numbers& r = rows[i];
    file += char(200 + i);
    file += bytes(float(r[0]), big_endian);
    file += char(i);
    for (std::size_t k = 0; k < i; ++k) file += bytes(std::int32_t(1000 + k), big_endian);
    file += real(r[1]) + real(r[2]) + bytes(float(r[3]), big_endian) + bytes(float(r[4]), big_endian) +
            bytes(r[5], big_endian) + bytes(std::int32_t(i * 70000), big_endian);
  }
  file += "\5\3";
  for (std::int32_t i = 0; i < 3; ++i) file += bytes(i, big_endian);
  return file + "and more";
}

enum Encoding
{
  ASCII,
  BINARY,
  PACKED
};
// Without what LZF packs, which is not unique.
std::string pcd_head(Encoding encoding, std::size_t points, std::size_t width, const std::string& viewpoint)
{
  const char* names[] = {"ascii", "binary", "binary_compressed"};
  return "# .PCD v0.7\n# VIEWPOINT 1 2 3\nVERSION 0.7\nFIELDS rgb x y z label normal_x normal_y normal_z\n"
         "SIZE 4 4 4 8 1 4 4 4\nTYPE U F F F I F F F\nCOUNT 1 1 1 1 3 1 1 1\nWIDTH " +
         std::to_string(width) + "\nHEIGHT " + std::to_string(points / width) + "\nVIEWPOINT " + viewpoint +
         "\nPOINTS " + std::to_string(points) + "\nDATA " + names[encoding] + "\n";
}
std::string pcd_body(const std::vector<Numbers>& rows, bool fields_apart)
{
  const auto field = [&](const Numbers& r, std::size_t f) {
    if (f == 0) return bytes(std::uint32_t(0xff8040 + r[0] * 0));
    if (f == 3) return bytes(r[2]);
    if (f == 4) return std::string("\1\2\3");
    return bytes(float(r[f < 3 ? f - 1 : f - 2]));
  };
  std::string body;
  if (fields_apart)
    for (std::size_t f = 0; f < 8; ++f)
      for (const Numbers& r : rows) body += field(r, f);
  else
    for (const Numbers& r : rows)
      for (std::size_t f = 0; f < 8; ++f) body += field(r, f);
  return body;
}
std::string packed_body(const std::string& body)
{
  const std::string packed = CR::internal::pack_lzf(body);
  return bytes(std::uint32_t(packed.size())) + bytes(std::uint32_t(body.size())) + packed;
}

std::string npy(const std::string& type, bool fortran, const std::string& shape, const std::string& body)
{
  const std::string header =
      "{'descr': '" + type + "', 'fortran_order': " + (fortran ? "True" : "False") + ", 'shape': " + shape + ", }\n";
  return std::string("\x93NUMPY\1") + '\0' + bytes(std::uint16_t(header.size())) + header + body;
}
std::string npy_of(const std::vector<Numbers>& rows, const std::string& type, bool fortran)
{
  const bool big = type[0] == '>', doubles = type[2] == '8';
  std::string body;
  const std::size_t n = rows.size(), width = rows[0].size();
  for (std::size_t k = 0; k < n * width; ++k) {
    const double x = fortran ? rows[k % n][k / n] : rows[k / width][k % width];
    body += doubles ? bytes(x, big) : bytes(float(x), big);
  }
  return npy(type, fortran, "(" + std::to_string(n) + ", " + std::to_string(width) + ")", body);
}

std::string stl(const std::vector<Numbers>& rows)
{
  std::string file(80, '#');
  file += bytes(std::uint32_t(2));
  for (const char attribute : {'\7', '\0'}) {
    for (const float x : {float(rows[1][3]), float(rows[1][4]), float(rows[1][5])}) file += bytes(x);
    for (const Numbers& r : rows)
      for (std::size_t k = 0; k < 3; ++k) file += bytes(float(r[k]));
    file += std::string(1, attribute) + "\1";
  }
  return file;
}

// A file of each kind, for what holds for all.
std::vector<std::pair<std::string, std::string>> a_file_of_each_kind()
{
  std::vector<std::pair<std::string, std::string>> files = {
      {"a.xyz", "1 2 3\n-4 5.5 6\n0.1 0 -1e-3\n7 7 7.25\n"},
      {"a.csv", "id;\"Z\";\"X\";name;\"Y\";w\n9;3,5;1;a b;2,25\n9;6;-4;;5,5\n9;-1e-3;0,1;c;0;2\n"},
      {"a.txt", "7 1 2 3 0 0 1\n9 -4 5.5 6 0 -1 0\n23 0.1 0 -1e-3 0.6 0 0.8\n"},
      {"a.off", "NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0.5 0 0 1\n3 0 1 2\n"},
      {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0.5\nvn 0 0 1\nf 1//1 2//1 3//1\n"},
      {"a.stl",
       "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0.5\nendloop\nendfacet\n"
       "endsolid a\n"},
      {"b.stl", stl(given)},
      {"a.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
                "property float nx\nproperty float ny\nproperty float nz\nend_header\n1 2 3 0 0 1\n4 5 6 0.6 0.8 0\n"
                "7 8 9.5 1 0 0\n"},
      {"a.ptx", "2\n1\n1 2 3\n1 0 0\n0 1 0\n0 0 1\n0 1 0 0\n-1 0 0 0\n0 0 1 0\n1 2 3 1\n0.5 1 2 0.5\n3 4 5.5 0.25\n"}};
  for (const bool big : {false, true})
    for (const bool doubles : {false, true}) files.emplace_back("b.ply", ply(given, big, doubles));
  for (const char* viewpoint : {"0 0 0 1 0 0 0", "1 2 3 0 1 0 0"}) {
    files.emplace_back("b.pcd", pcd_head(BINARY, 3, 3, viewpoint) + pcd_body(given, false));
    files.emplace_back("c.pcd", pcd_head(PACKED, 3, 3, viewpoint) + packed_body(pcd_body(given, true)));
    files.emplace_back("a.pcd", pcd_head(ASCII, 1, 1, viewpoint) + "7 1 2 3 1 2 3 0 0 1\n");
  }
  for (const char* type : {"<f4", ">f4", "<f8", ">f8"})
    for (const bool fortran : {false, true}) files.emplace_back("a.npy", npy_of(given, type, fortran));
  return files;
}

std::vector<Point> points_of(const Scan& scan)
{
  if (scan.kind == Scan::POINTS) return scan.points;
  if (scan.kind == Scan::RANGE_IMAGE) return scan.image.points();
  return std::vector<Point>(scan.mesh.points().begin(), scan.mesh.points().end());
}

bool are_near(const std::vector<Point>& a, const std::vector<Point>& b, double tolerance)
{
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!(CGAL::squared_distance(a[i], b[i]) <= tolerance * tolerance)) return false;
  return true;
}

} // namespace

BOOST_AUTO_TEST_CASE(text_keeps_its_separators_columns_and_comments)
{
  BOOST_TEST(moved("a.xyz", "1 2 3\n-4 5.5 6\n0.5 0 -1e-3\n") == "8 21 33\n4.5 16 36\n10 20.5 29.999\n");
  BOOST_TEST(moved("a.txt", "1\t2\t3\r\n\r\n-4  5.5 6\r\n0.5 0 -0.25") ==
             "8\t21\t33\r\n\r\n4.5  16 36\r\n10 20.5 29.75");
  BOOST_TEST(moved("a.xyz", "# a scan\n1 2 3 17 0xff # 1 2 3\n % 4 5 6\n-4 5.5 6 18.50 abc\n") ==
             "# a scan\n8 21 33 17 0xff # 1 2 3\n % 4 5 6\n4.5 16 36 18.50 abc\n");
  BOOST_TEST(moved("a.pts", "2\n1 2 3 7 8 9 10\n-4 5.5 6 1\n") == "2\n8 21 33 7 8 9 10\n4.5 16 36 1\n");
  BOOST_TEST(moved("a.csv", "id,\"Z\",\"X\",name,\"Y\",w\n9,\"3\",1,\"a, b\",2\n9, 6 ,-4,,5.5,1\n") ==
             "id,\"Z\",\"X\",name,\"Y\",w\n9,\"33\",8,\"a, b\",21\n9, 36 ,4.5,,16,1\n");
  BOOST_TEST(moved("a.csv", "1;2;3\n-4;5,5;6\n") == "8;21;33\n4,5;16;36\n");
  BOOST_TEST(moved("a.csv", "1;2;3\n-4;5.5;6\n") == "8;21;33\n4.5;16;36\n");
  BOOST_TEST(moved("a.txt", "1,0 2,0 3,0\n-4 5,5 6\n") == "8 21 33\n4,5 16 36\n");
  // a first column that counts
  BOOST_TEST(moved("a.txt", "0 1 2 3\n1 -4 5.5 6\n2 0.5 0 -0.25\n") == "0 8 21 33\n1 4.5 16 36\n2 10 20.5 29.75\n");
  // the mark of UTF-8
  BOOST_TEST(moved("a.txt", "\xef\xbb\xbf 1 2 3\n4 5 6\n") == "\xef\xbb\xbf 8 21 33\n5 24 36\n");
}

BOOST_AUTO_TEST_CASE(normals_of_text_are_turned_and_colours_are_not)
{
  BOOST_TEST(moved("a.xyz", "1 2 3 0 0 1\n-4 5.5 6 0 -1 0\n") == "8 21 33 0 0 1\n4.5 16 36 1 0 0\n");
  BOOST_TEST(moved("a.xyz", "1 2 3 10 0 1\n-4 5.5 6 0 -1 0\n") == "8 21 33 10 0 1\n4.5 16 36 0 -1 0\n");
  BOOST_TEST(moved("a.csv", "nx,ny,nz,x,y,z,nx2\n0,-2,0,1,2,3,4\n") == "nx,ny,nz,x,y,z,nx2\n2,0,0,8,21,33,4\n");
  BOOST_TEST(moved("a.csv", "nx,ny,x,y,z\n0,-2,1,2,3\n") == "nx,ny,x,y,z\n0,-2,8,21,33\n");
  BOOST_TEST(moved("a.csv", "r,g,b,x,y,z\n9,0,255,1,2,3\n") == "r,g,b,x,y,z\n9,0,255,8,21,33\n");
  BOOST_TEST(moved("a.xyz", "1 2 3 9 0 10 0 0 1\n-4 5.5 6 8 0 1 0 -1 0\n") ==
             "8 21 33 9 0 10 0 0 1\n4.5 16 36 8 0 1 1 0 0\n");
}

BOOST_AUTO_TEST_CASE(ply_as_text_keeps_all_else)
{
  const std::string head =
      "ply\nformat ascii 1.0\ncomment viewpoint 1 2 3\nobj_info viewpoint 1 2 3\nobj_info viewing_direction 0 -1 0\n"
      "element vertex 3\nproperty uchar red\nproperty float x\nproperty float y\nproperty double z\nproperty list "
      "uchar "
      "int marks\nproperty float nx\nproperty float ny\nproperty float nz\nproperty float s\nelement face 1\nproperty "
      "list uchar int vertex_indices\nproperty list uchar float texcoord\nend_header\n";
  const std::string body = "255 1 2 3 2 7 8 0 0 1 0.125\n\n1 -4 5.5  6 0 0 -1 0 0.10\n2 0.5 0 0.1 1 9 nan 0 0 1e3\n"
                           "3 0 1 2 6 0.1 0.2 0.3 0.4 0.5 0.60\n";
  std::string expected = head;
  expected.replace(expected.find("obj_info viewpoint 1 2 3"), 24, "obj_info viewpoint 8 21 33");
  expected.replace(expected.find("direction 0 -1 0"), 16, "direction 1 0 0");
  expected += "255 8 21 33 2 7 8 0 0 1 0.125\n\n1 4.5 16  36 0 1 0 0 0.10\n2 10 20.5 30.1 1 9 nan 0 0 1e3\n"
              "3 0 1 2 6 0.1 0.2 0.3 0.4 0.5 0.60\n";
  BOOST_TEST(moved("a.ply", head + body) == expected);
  // a float has the digits of one
  const std::string floats = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty "
                             "double z\nend_header\n";
  BOOST_TEST(moved("a.ply", floats + "0.1 0.2 0.3\n", Motion(1, 0, 0, 0.2, 0, 1, 0, 0, 0, 0, 1, 0.1)) ==
             floats + "0.3 0.2 0.4\n");
}

BOOST_AUTO_TEST_CASE(ply_as_bytes_keeps_all_else)
{
  for (const bool big : {false, true})
    for (const bool doubles : {false, true})
      BOOST_TEST((moved("a.ply", ply(given, big, doubles)) == ply(given_moved, big, doubles)));
}

BOOST_AUTO_TEST_CASE(meshes_keep_all_else)
{
  BOOST_TEST(moved("a.obj",
                   "# v 1 2 3\nmtllib a.mtl\no a\nv 1 2 3 255 128 0\nvt 0.5 0.25\nvn 0 -1 0\nv  -4 5.5 6\nv 0 0 "
                   "0\nvp 1 2\nusemtl m\ns off\nf 1/1/1 2/1/1 -1/1/1\n") ==
             "# v 1 2 3\nmtllib a.mtl\no a\nv 8 21 33 255 128 0\nvt 0.5 0.25\nvn 1 0 0\nv  4.5 16 36\nv 10 20 30\nvp 1 "
             "2\nusemtl m\ns off\nf 1/1/1 2/1/1 -1/1/1\n");
  BOOST_TEST(moved("a.off", "# an OFF\nCNOFF\n3 1 0\n\n1 2 3  0 -1 0 255 0 0\n# 1 2 3\n-4 5.5 6 0 0 1 9\n0 0 0 1 0 "
                            "0\n3 0 1 2 0.5 0.5 0.5\n") ==
             "# an OFF\nCNOFF\n3 1 0\n\n8 21 33  1 0 0 255 0 0\n# 1 2 3\n4.5 16 36 0 0 1 9\n10 20 30 0 1 0\n3 0 1 2 "
             "0.5 0.5 0.5\n");
  BOOST_TEST(moved("a.off", "OFF 3 1 0\n1 2 3 0 -1 0\n-4 5.5 6\n0 0 0\n3 0 1 2") ==
             "OFF 3 1 0\n8 21 33 0 -1 0\n4.5 16 36\n10 20 30\n3 0 1 2");
  BOOST_TEST(
      moved("a.stl", "solid a 1 2 3\n facet normal 0 -1 0\n  outer loop\n   vertex 1 2 3\n   vertex -4 5.5 6\n   "
                     "vertex 0 0 0\n  endloop\n endfacet\nendsolid a\n") ==
      "solid a 1 2 3\n facet normal 1 0 0\n  outer loop\n   vertex 8 21 33\n   vertex 4.5 16 36\n   vertex 10 20 "
      "30\n  endloop\n endfacet\nendsolid a\n");
  BOOST_TEST((moved("b.stl", stl(given)) == stl(given_moved)));
}

BOOST_AUTO_TEST_CASE(pcd_keeps_all_else)
{
  // a half turn, as the quaternion of it has no square roots
  const Motion half_turn(-1, 0, 0, 10, 0, -1, 0, 20, 0, 0, 1, 30);
  const std::vector<Numbers> turned = {{9, 18, 33, 0, 0, 1}, {14, 14.5, 36, 0, 1, 0}, {9.5, 20, 29.75, -1, 0, 0}};
  const std::string view = "1 2 3 1 0 0 0", view_moved = "9 18 33 0 0 0 1";
  BOOST_TEST(
      moved("a.pcd", pcd_head(ASCII, 2, 2, view) + "7 1 2 3 1 2 3 0 0 1\n8 -4 5.5 6 0 0 0 0 -1 0\n", half_turn) ==
      pcd_head(ASCII, 2, 2, view_moved) + "7 9 18 33 1 2 3 0 0 1\n8 14 14.5 36 0 0 0 0 1 0\n");
  BOOST_TEST((moved("a.pcd", pcd_head(BINARY, 3, 3, view) + pcd_body(given, false) + "more", half_turn) ==
              pcd_head(BINARY, 3, 3, view_moved) + pcd_body(turned, false) + "more"));
  BOOST_TEST((moved("a.pcd", pcd_head(PACKED, 3, 3, view) + packed_body(pcd_body(given, true)), half_turn) ==
              pcd_head(PACKED, 3, 3, view_moved) + packed_body(pcd_body(turned, true))));
  // the viewpoint of points that nobody set is none
  const std::string none = "0 0 0 1 0 0 0";
  BOOST_TEST((moved("a.pcd", pcd_head(BINARY, 3, 3, none) + pcd_body(given, false)) ==
              pcd_head(BINARY, 3, 3, none) + pcd_body(given_moved, false)));
}

BOOST_AUTO_TEST_CASE(what_is_packed_by_lzf_is_unpacked_the_same)
{
  std::mt19937 random(5);
  for (std::size_t size = 0; size < 40000; size = size < 40 ? size + 1 : size * 3)
    for (const int letters : {1, 2, 256}) {
      std::string data;
      for (std::size_t i = 0; i < size; ++i) data += char(random() % unsigned(letters));
      const std::string packed = CR::internal::pack_lzf(data);
      std::string unpacked;
      BOOST_TEST((CR::internal::unpack_lzf(packed, size, unpacked) && unpacked == data));
      BOOST_TEST(packed.size() <= size + size / 32 + 1);
      if (letters == 1 && size > 100) BOOST_TEST(packed.size() < size / 20);
    }
}

BOOST_AUTO_TEST_CASE(arrays_keep_all_else)
{
  for (const char* type : {"<f4", ">f4", "<f8", ">f8"})
    for (const bool fortran : {false, true}) {
      BOOST_TEST((moved("a.npy", npy_of(given, type, fortran)) == npy_of(given_moved, type, fortran)));
      // four columns, and six that are no normals
      std::vector<Numbers> rows = given, expected = given_moved;
      for (std::size_t i = 0; i < 3; ++i) {
        rows[i][3] = expected[i][3] = 17;
        expected[i][4] = rows[i][4];
        expected[i][5] = rows[i][5];
      }
      BOOST_TEST((moved("a.npy", npy_of(rows, type, fortran)) == npy_of(expected, type, fortran)));
      // normals behind colours
      std::vector<Numbers> wide = given, wide_moved = given_moved;
      for (std::size_t i = 0; i < 3; ++i) {
        const Numbers color = {9, 0, 255};
        wide[i].insert(wide[i].begin() + 3, color.begin(), color.end());
        wide_moved[i].insert(wide_moved[i].begin() + 3, color.begin(), color.end());
      }
      BOOST_TEST((moved("a.npy", npy_of(wide, type, fortran)) == npy_of(wide_moved, type, fortran)));
      for (std::size_t i = 0; i < 3; ++i) {
        rows[i].resize(4);
        expected[i].resize(4);
      }
      BOOST_TEST((moved("a.npy", npy_of(rows, type, fortran)) == npy_of(expected, type, fortran)));
    }
}

BOOST_AUTO_TEST_CASE(ptx_files_move_their_scanner)
{
  const std::string first = "2\n1\n1 2 3\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n1 2 3 1\n",
                    first_moved = "2\n1\n8 21 33\n0 1 0\n-1 0 0\n0 0 1\n0 1 0 0\n-1 0 0 0\n0 0 1 0\n8 21 33 1\n";
  const std::string samples = "0 0 0 0.5 1 2 3\n3 4 5.50 0.25\n";
  BOOST_TEST(moved("a.ptx", first + samples) == first_moved + samples);
  const std::string two = folder().file("two.ptx", first + samples + first + "1 1 1 0\n2 2 2 0\n"),
                    out = folder().file("out.ptx", "");
  CR::apply_motion(two + "#2", out, quarter_turn);
  BOOST_TEST(contents_of(out) == first_moved + "1 1 1 0\n2 2 2 0\n");
  CR::apply_motion(two + "#1", out, quarter_turn);
  BOOST_TEST(contents_of(out) == first_moved + samples);
  // another unit of length: the samples, too
  BOOST_TEST(
      moved("a.ptx", first + samples, Motion(0, -2, 0, 10, 2, 0, 0, 20, 0, 0, 2, 30)) ==
      "2\n1\n6 22 36\n0 1 0\n-1 0 0\n0 0 1\n0 1 0 0\n-1 0 0 0\n0 0 1 0\n6 22 36 1\n0 0 0 0.5 1 2 3\n6 8 11 0.25\n");
}

BOOST_AUTO_TEST_CASE(samples_that_are_missing_stay)
{
  BOOST_TEST(moved("a.xyz", "1 2 3 0 0 1\nNaN nan 1 0 1 0\n-4 5.5 6 nan nan nan\n9 9 9 0 0 0\n") ==
             "8 21 33 0 0 1\nNaN nan 1 0 1 0\n4.5 16 36 nan nan nan\n1 29 39 0 0 0\n");
  // the origin, where it stands more than once and away from the others
  BOOST_TEST(moved("a.xyz", "1 2 3\n0 0 0\n0.0 0 0\n4 5 6\n") == "8 21 33\n0 0 0\n0.0 0 0\n5 24 36\n");
  BOOST_TEST(moved("a.xyz", "1 2 3\n0 0 0\n4 5 6\n") == "8 21 33\n10 20 30\n5 24 36\n");
  std::vector<Numbers> image = {{1, 2, 3}, {0, 0, 0}, {nan_, 2, 3}, {4, 5, 6}},
                       expected = {{8, 21, 33}, {0, 0, 0}, {nan_, 2, 3}, {5, 24, 36}};
  std::string body, body_moved;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      body += bytes(float(image[i][k]));
      body_moved += bytes(float(expected[i][k]));
    }
  BOOST_TEST((moved("a.npy", npy("<f4", false, "(2, 2, 3)", body)) == npy("<f4", false, "(2, 2, 3)", body_moved)));
  // the viewpoint of a range image, which is the origin where nobody set it
  const std::string view = "0 0 0 1 0 0 0", rest = " 1 2 3 nan nan nan\n",
                    none = "7 0 0 0" + rest + "7 nan nan 1" + rest;
  BOOST_TEST(moved("a.pcd", pcd_head(ASCII, 4, 2, view) + "7 1 2 3" + rest + none + "7 4 5 6" + rest,
                   Motion(-1, 0, 0, 10, 0, -1, 0, 20, 0, 0, 1, 30)) ==
             pcd_head(ASCII, 4, 2, "10 20 30 0 0 0 1") + "7 9 18 33" + rest + none + "7 6 15 36" + rest);
}

BOOST_AUTO_TEST_CASE(what_is_read_back_has_moved)
{
  const Motion motion = general_motion();
  for (const auto& [name, contents] : a_file_of_each_kind()) {
    BOOST_TEST_CONTEXT(name)
    {
      const std::string file = folder().file(name, contents), out = folder().file("moved_" + name, "");
      const Scan before = CR::read_scan<Kernel>(file);
      CR::check_motion_can_be_applied(file);
      const double rounding = CR::apply_motion(file, out, motion);
      const Scan after = CR::read_scan<Kernel>(out);
      BOOST_TEST(before.kind == after.kind);
      BOOST_TEST(before.missing == after.missing);
      std::vector<Point> expected = points_of(before);
      for (Point& p : expected) p = p.transform(motion);
      const double of_doubles = 1e-13; // coordinates below 256, given products and given sums
      BOOST_TEST(rounding < 1e-5);
      BOOST_TEST(are_near(points_of(after), expected, 2 * rounding + of_doubles));
      if (rounding > 0) BOOST_TEST(!are_near(points_of(after), expected, rounding / 2));
      BOOST_TEST(before.mesh.number_of_faces() == after.mesh.number_of_faces());
      BOOST_TEST_REQUIRE(before.normals.size() == after.normals.size());
      for (std::size_t i = 0; i < before.normals.size(); ++i)
        BOOST_TEST((before.normals[i].transform(motion) - after.normals[i]).squared_length() < 1e-12);
      const auto sensor_of = [](const Scan& s) { return s.kind == Scan::RANGE_IMAGE ? s.image.sensor() : s.sensor; };
      const Sensor sensor = sensor_of(before), moved_sensor = sensor_of(after);
      BOOST_TEST(sensor.is_perspective() == moved_sensor.is_perspective());
      if (sensor.is_perspective())
        BOOST_TEST(CGAL::squared_distance(sensor.viewpoint().transform(motion), moved_sensor.viewpoint()) < 1e-20);
    }
  }
}

BOOST_AUTO_TEST_CASE(moved_there_and_back_doubles_are_nearly_what_they_were)
{
  const Motion motion = general_motion();
  const std::string text = "1 2 3 a\n-4 5.5 6 b\n0.1 0 -1e-3 c\n";
  const Scan back = read("back.xyz", moved("there.xyz", moved("a.xyz", text, motion), motion.inverse()));
  BOOST_TEST(are_near(back.points, read("a.xyz", text).points, 1e-13));
}

BOOST_AUTO_TEST_CASE(what_cannot_be_written_moved_is_told)
{
  const std::string ints = "ply\nformat ascii 1.0\nelement vertex 1\nproperty int x\nproperty float y\nproperty float "
                           "z\nend_header\n1 2 3\n";
  BOOST_TEST(refusal_of("a.ply", ints).find("numbers x are whole ones") != std::string::npos);
  std::string pcd = pcd_head(ASCII, 1, 1, "0 0 0 1 0 0 0") + "7 1 2 3 1 2 3 0 0 1\n";
  pcd.replace(pcd.find("TYPE U F"), 8, "TYPE U I");
  BOOST_TEST(refusal_of("a.pcd", pcd).find("numbers x are whole ones") != std::string::npos);
  BOOST_TEST(refusal_of("a.las", "LASF").find("LAS") != std::string::npos);
  BOOST_TEST(refusal_of("a.png", "\x89PNG").find("depth image") != std::string::npos);
  BOOST_TEST(refusal_of("a.ts", "GOCAD TSurf 1").find("not written") != std::string::npos);
  BOOST_TEST(refusal_of("a.gltf", "{\"asset\": {\"version\": \"2.0\"}}").find("not written") != std::string::npos);
  BOOST_TEST(refusal_of("a.vtp", "<VTKFile>").find("not written") != std::string::npos);
  // of a large file the beginning is looked at, or all of it
  const std::string large = std::string(std::size_t(1) << 21, ' ');
  BOOST_TEST(refusal_of("large.ply", ints + large).find("numbers x are whole ones") != std::string::npos);
  BOOST_TEST(refusal_of("large.ply", "ply\ncomment" + large + ints.substr(3)).find("numbers x are whole ones") !=
             std::string::npos);
  BOOST_TEST(refusal_of("large.ply", "ply\ncomment" + large).find("ends before 'end_header'") != std::string::npos);
  CR::check_motion_can_be_applied(folder().file("large.xyz", "1 2 3\n" + large + "4 5 6\n"));
  BOOST_TEST(refusal_of("empty.xyz", "").find("empty") != std::string::npos);
  BOOST_CHECK_THROW(CR::check_motion_can_be_applied("nowhere.xyz"), CR::IO_error);
  // motions that are none: a mirror, a shear, no number
  for (const Motion& m : {Motion(-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0), Motion(1, 0.1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0),
                          Motion(1, 0, 0, nan_, 0, 1, 0, 0, 0, 0, 1, 0), Motion(0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0)})
    BOOST_CHECK_THROW(moved("a.xyz", "1 2 3\n", m), std::invalid_argument);
  // a float that would overflow
  const std::string floats = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty "
                             "float z\nend_header\n3e38 3e38 3e38\n";
  BOOST_CHECK_THROW(moved("a.ply", floats, general_motion()), CR::IO_error);
}

BOOST_AUTO_TEST_CASE(another_unit_of_length)
{
  const Motion motion(0, -1000, 0, 10, 1000, 0, 0, 20, 0, 0, 1000, 30);
  BOOST_TEST(moved("a.xyz", "0.001 0.002 0.003 0 0 1\n0.5 0 0 0 -1 0\n", motion) == "8 21 33 0 0 1\n10 520 30 1 0 0\n");
}

#ifdef CGAL_CRUDE_REGISTRATION_USE_GZIP
BOOST_AUTO_TEST_CASE(packed_by_gzip_where_the_name_says_so)
{
  const std::string text = "1 2 3 a\n-4 5.5 6 b\n", plain = folder().file("a.xyz", text),
                    packed = folder().file("packed.xyz.gz", ""), out = folder().file("out.xyz", "");
  CR::apply_motion(plain, packed, quarter_turn);
  BOOST_TEST(contents_of(packed).substr(0, 2) == "\x1f\x8b");
  CR::apply_motion(packed, out, quarter_turn.inverse());
  BOOST_TEST(contents_of(out) == text);
}
#endif

BOOST_AUTO_TEST_CASE(a_file_may_be_moved_in_its_place)
{
  const std::string file = folder().file("a.xyz", "1 2 3\n4 5 6\n");
  CR::apply_motion(file, file, quarter_turn);
  BOOST_TEST(contents_of(file) == "8 21 33\n5 24 36\n");
}

// Whatever is in a file: moved, or refused by an IO_error that leaves nothing.
BOOST_AUTO_TEST_CASE(damaged_files_are_moved_or_refused)
{
  std::mt19937 random(7);
  const std::string out = (folder().path() / "damaged").string();
  std::size_t done = 0;
  for (const auto& [name, contents] : a_file_of_each_kind()) {
    for (int i = 0; i < 200; ++i) {
      std::string data = contents;
      for (unsigned k = 0; k <= random() % 3; ++k) {
        const std::size_t at = random() % data.size();
        if (random() % 2 == 0) data[at] = char(random());
        else if (random() % 2 == 0) data.erase(at, random() % 9);
        else data.insert(at, data.substr(at, random() % 9));
        if (data.empty()) data = "0";
      }
      const std::string file = folder().file(name, data);
      bool is_read = true;
      try {
        CR::read_scan<Kernel>(file);
      } catch (const CR::IO_error&) {
        is_read = false;
      }
      std::filesystem::remove(out);
      try {
        CR::apply_motion(file, out, general_motion());
        ++done;
      } catch (const CR::IO_error& error) {
        BOOST_TEST(!std::filesystem::exists(out));
        BOOST_TEST(std::string(error.what()).find(file) == 0);
        BOOST_TEST((!is_read || std::string(error.what()).find("whole ones") != std::string::npos ||
                    std::string(error.what()).find("too large") != std::string::npos),
                   error.what());
      }
    }
  }
  BOOST_TEST(done > 1000);
}
