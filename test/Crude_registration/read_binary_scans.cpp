// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// The formats of points and range images that are bytes: PCD, NPY, LAS.

#define BOOST_TEST_MODULE read_binary_scans
#include <boost/test/unit_test.hpp>

#include "scan_files.h"

#include <CGAL/Crude_registration/IO/internal/lzf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

using namespace generated;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

template <class T>
std::string bytes(T value, bool big_endian = false)
{
  std::string result(sizeof value, '\0');
  std::memcpy(result.data(), &value, sizeof value);
  const std::uint16_t one = 1;
  if ((*reinterpret_cast<const unsigned char*>(&one) == 1) == big_endian) std::reverse(result.begin(), result.end());
  return result;
}

// Packs as LZF does: bytes as they are, and references to the same bytes before; looks for them among all of three.
std::string packed_lzf(const std::string& data)
{
  std::string result, literals;
  const auto write_literals = [&] {
    if (literals.empty()) return;
    result += char(literals.size() - 1);
    result += literals;
    literals.clear();
  };
  std::map<std::string, std::size_t> last;
  for (std::size_t i = 0; i < data.size();) {
    std::size_t length = 0, distance = 0;
    const auto found = last.find(data.substr(i, 3));
    if (i + 3 <= data.size() && found != last.end() && i - found->second <= 8192) {
      distance = i - found->second;
      while (length < 264 && i + length < data.size() && data[i + length] == data[i + length - distance]) ++length;
    }
    const std::size_t step = length < 3 ? 1 : length;
    if (length < 3) {
      literals += data[i];
      if (literals.size() == 32) write_literals();
    } else {
      write_literals();
      const std::size_t l = length - 2, d = distance - 1;
      result += char((l < 7 ? l : 7) << 5 | d >> 8);
      if (l >= 7) result += char(l - 7);
      result += char(d & 255);
    }
    for (std::size_t k = 0; k < step; ++k, ++i)
      if (i + 3 <= data.size()) last[data.substr(i, 3)] = i;
  }
  write_literals();
  return result;
}

// A PCD file of points with a normal in float, a colour between, and the viewpoint.
enum Encoding
{
  ASCII,
  BINARY,
  PACKED
};
using Row = std::array<double, 6>;
std::string pcd(const std::vector<Row>& rows, Encoding encoding, std::size_t width,
                const std::string& viewpoint = "0 0 0 1 0 0 0")
{
  const std::size_t height = rows.size() / width;
  const char* names[] = {"ascii", "binary", "binary_compressed"};
  std::string file =
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z rgb label normal_x normal_y normal_z\n"
      "SIZE 8 8 8 4 1 4 4 4\nTYPE F F F U I F F F\nCOUNT 1 1 1 1 3 1 1 1\nWIDTH " +
      std::to_string(width) + "\nHEIGHT " + std::to_string(height) + "\nVIEWPOINT " + viewpoint + "\nPOINTS " +
      std::to_string(rows.size()) + "\nDATA " + names[encoding] + "\n";
  const auto field = [&](const Row& r, int f) { // as bytes
    if (f < 3) return bytes(r[std::size_t(f)]);
    if (f == 3) return bytes(std::uint32_t(0xff8040));
    if (f == 4) return std::string("\1\2\3");
    return bytes(float(r[std::size_t(f - 2)]));
  };
  if (encoding == ASCII) {
    for (const Row& r : rows) {
      std::ostringstream line;
      line.precision(17);
      line << r[0] << ' ' << r[1] << ' ' << r[2] << " 16744512 1 2 3 " << r[3] << ' ' << r[4] << ' ' << r[5] << '\n';
      file += line.str();
    }
    return file;
  }
  std::string body;
  if (encoding == BINARY) {
    for (const Row& r : rows)
      for (int f = 0; f < 8; ++f) body += field(r, f);
    return file + body;
  }
  for (int f = 0; f < 8; ++f)
    for (const Row& r : rows) body += field(r, f);
  const std::string packed = packed_lzf(body);
  return file + bytes(std::uint32_t(packed.size())) + bytes(std::uint32_t(body.size())) + packed;
}

const std::vector<Row> three_rows = {
    {1, 2, 3, 0, 0, 1}, {-4, 5.5, 6, 0, -1, 0}, {0.1, 0, -1e-3, not_a_number, not_a_number, not_a_number}};
const std::vector<Kernel::Vector_3> three_normals = {Kernel::Vector_3(0, 0, 1), Kernel::Vector_3(0, -1, 0),
                                                     Kernel::Vector_3(0, 0, 0)};

std::string replaced(std::string text, const std::string& what, const std::string& by)
{
  const std::size_t at = text.find(what);
  BOOST_REQUIRE(at != std::string::npos);
  return text.replace(at, what.size(), by);
}

// NumPy's file of an array.
std::string npy(const std::string& type, bool fortran, const std::string& shape, const std::string& body,
                int version = 1)
{
  std::string header =
      "{'descr': '" + type + "', 'fortran_order': " + (fortran ? "True" : "False") + ", 'shape': " + shape + ", }\n";
  const std::string length = version == 1 ? bytes(std::uint16_t(header.size())) : bytes(std::uint32_t(header.size()));
  return std::string("\x93NUMPY") + char(version) + '\0' + length + header + body;
}

std::string las(const std::vector<std::array<std::int32_t, 3>>& points, int minor, unsigned char format,
                const std::array<double, 3>& scale, const std::array<double, 3>& offset)
{
  const std::size_t header = minor == 4 ? 375 : minor == 3 ? 235 : 227, record = format < 6 ? 28 : 36;
  std::string file(header + 10, '\0'); // and ten bytes of other things
  file.replace(0, 4, "LASF");
  file[24] = 1;
  file[25] = char(minor);
  file.replace(94, 2, bytes(std::uint16_t(header)));
  file.replace(96, 4, bytes(std::uint32_t(file.size())));
  file[104] = char(format);
  file.replace(105, 2, bytes(std::uint16_t(record)));
  if (minor < 4) file.replace(107, 4, bytes(std::uint32_t(points.size())));
  else file.replace(247, 8, bytes(std::uint64_t(points.size())));
  for (std::size_t i = 0; i < 3; ++i) {
    file.replace(131 + 8 * i, 8, bytes(scale[i]));
    file.replace(155 + 8 * i, 8, bytes(offset[i]));
  }
  for (const auto& p : points) {
    std::string r;
    for (const std::int32_t c : p) r += bytes(c);
    r.resize(record, '\7');
    file += r;
  }
  return file;
}

// Any of the bytes changed, taken out or doubled: read, or refused by an IO_error.
void check_changed(const std::string& name, const std::string& good)
{
  std::mt19937 random(3);
  BOOST_TEST(error_of(name, good) == "");
  for (int i = 0; i < 600; ++i) {
    std::string bad = good;
    for (unsigned k = 0; k <= random() % 3; ++k) {
      const std::size_t at = random() % bad.size();
      const std::size_t kind = random() % 4;
      if (kind == 0) bad[at] = char(random());
      else if (kind == 1) bad[at] = "0123456789-+. \n"[random() % 15];
      else if (kind == 2) bad.erase(at, random() % 8);
      else bad.insert(at, bad.substr(random() % bad.size(), random() % 12));
      if (bad.empty()) bad = " ";
    }
    try {
      const Scan scan = read(name, bad);
      BOOST_TEST(!(scan.points.empty() && scan.image.points().empty()));
    } catch (const CR::IO_error&) {
    }
  }
}

} // namespace

BOOST_AUTO_TEST_CASE(pcd_files)
{
  for (const Encoding encoding : {ASCII, BINARY, PACKED}) {
    BOOST_TEST_CONTEXT("encoding " << encoding)
    {
      const Scan scan = read("a.pcd", pcd(three_rows, encoding, 3));
      BOOST_TEST(are(scan, three));
      BOOST_TEST((scan.normals == three_normals));
      BOOST_TEST(!scan.sensor.is_known()); // 0 0 0 1 0 0 0 is written where nobody knows
      BOOST_TEST(are(read("noname", pcd(three_rows, encoding, 3)), three)); // by its content
      const Scan seen = read("a.pcd", pcd(three_rows, encoding, 3, "7 8 9.5 1 0 0 0"));
      BOOST_TEST(seen.sensor.viewpoint() == Point(7, 8, 9.5));
      std::vector<Row> holed = three_rows;
      holed.insert(holed.begin() + 1, Row{not_a_number, not_a_number, not_a_number, 1, 0, 0});
      const Scan without = read("a.pcd", pcd(holed, encoding, 4));
      BOOST_TEST(are(without, three));
      BOOST_TEST((without.normals == three_normals));
      BOOST_TEST(without.missing == 1);
      CHECK_ERROR("a.pcd", pcd({Row{not_a_number, 0, 0, 0, 0, 0}}, encoding, 1), ": ", "none of the 1 points");
    }
  }
  BOOST_TEST(are(
      read("a.pcd",
           "VERSION .7\nFIELDS y z x\nSIZE 4 4 4\nTYPE F F F\nPOINTS 3\nDATA ascii\n2 3 1\n5.5 6 -4\n0 -1e-3 0.1\n"),
      three));
  const Scan whole = read("a.pcd", "FIELDS x y z\nSIZE 2 1 8\nTYPE I U I\nWIDTH 1\nDATA binary\n" +
                                       bytes(std::int16_t(-300)) + bytes(std::uint8_t(200)) + bytes(std::int64_t(-5)));
  BOOST_TEST(whole.points.at(0) == Point(-300, 200, -5));
}

BOOST_AUTO_TEST_CASE(organised_pcd_files)
{
  // a bent surface before a pinhole camera at the origin, with holes of three kinds
  std::vector<Row> rows;
  for (int v = 0; v < 30; ++v)
    for (int u = 0; u < 40; ++u) {
      const double x = (u - 20) / 50., y = (v - 15) / 50., z = 2 + 0.3 * std::sin(3 * x) + 0.2 * y * y + 0.1 * x * y;
      rows.push_back({x * z, y * z, z, 0, 0, -1});
    }
  rows[5] = {not_a_number, not_a_number, not_a_number, not_a_number, not_a_number, not_a_number};
  rows[77] = {0, 0, 0, 0, 0, 0};
  rows[500] = {0, 0, std::numeric_limits<double>::infinity(), 0, 0, 0};
  for (const Encoding encoding : {ASCII, BINARY, PACKED}) {
    const Scan scan = read("a.pcd", pcd(rows, encoding, 40));
    BOOST_TEST((scan.kind == Scan::RANGE_IMAGE));
    const Image& image = scan.image;
    BOOST_TEST(image.columns() == 40);
    BOOST_TEST(image.rows() == 30);
    BOOST_TEST(image.points().size() == 1197);
    BOOST_TEST(scan.normals.size() == 1197);
    BOOST_TEST(scan.missing == 3);
    BOOST_TEST(image.index(5, 0) == -1);
    BOOST_TEST(image.index(37, 1) == -1);
    const Row& r = rows[7 * 40 + 21];
    BOOST_TEST(image.points()[std::size_t(image.index(21, 7))] == Point(r[0], r[1], r[2]));
    BOOST_TEST(image.sensor().viewpoint() == Point(0, 0, 0)); // the grid agrees with it
    const Scan seen = read("a.pcd", pcd(rows, encoding, 40, "0.5 0 0 1 0 0 0"));
    BOOST_TEST(seen.image.sensor().viewpoint() == Point(0.5, 0, 0));
  }
  // Moved, with the viewpoint left as it was: the grid knows better.
  for (Row& r : rows) r[2] += 10;
  rows[77] = {not_a_number, 0, 0, 0, 0, 0};
  const Scan moved = read("a.pcd", pcd(rows, BINARY, 40));
  BOOST_REQUIRE(moved.image.sensor().is_perspective());
  BOOST_TEST(std::abs(moved.image.sensor().viewpoint().z() - 10) < 0.1);
}

BOOST_AUTO_TEST_CASE(wrong_pcd_files)
{
  const std::string text = pcd(three_rows, ASCII, 3), binary = pcd(three_rows, BINARY, 3),
                    packed = pcd(three_rows, PACKED, 3);
  CHECK_ERROR("a.pcd", "hello\n", ":1: ", "unknown word in the header: 'hello'");
  CHECK_ERROR("a.pcd", "# .PCD v0.7\n", ":1: ", "ends before 'DATA'");
  CHECK_ERROR("a.pcd", replaced(text, "FIELDS x", "FIELDS w"), ":11: ", "no fields x, y and z");
  CHECK_ERROR("a.pcd", replaced(text, "FIELDS x y z", "FIELDS x x z"), ":11: ", "'x' stands twice");
  CHECK_ERROR("a.pcd", replaced(text, "COUNT 1", "COUNT 2"), ":11: ", "is not one number");
  CHECK_ERROR("a.pcd", replaced(text, "SIZE 8", "SIZE 3"), ":11: ", "'x' has no size");
  CHECK_ERROR("a.pcd", replaced(text, "SIZE 8 8", "SIZE 8"), ":4: ", "fewer words");
  CHECK_ERROR("a.pcd", replaced(text, "TYPE F F", "TYPE F F F"), ":5: ", "more words");
  CHECK_ERROR("a.pcd", replaced(text, "TYPE F", "TYPE D"), ":5: ", "unknown type: 'D'");
  CHECK_ERROR("a.pcd", replaced(text, "COUNT 1", "COUNT 99999999999"), ":6: ", "above 2^31");
  CHECK_ERROR("a.pcd", replaced(text, "WIDTH 3", "WIDTH -3"), ":7: ", "negative");
  CHECK_ERROR("a.pcd", replaced(text, "WIDTH 3", "WIDTH 4"), ":11: ", "POINTS is 3, but WIDTH times HEIGHT is 4");
  CHECK_ERROR("a.pcd", replaced(text, "HEIGHT 1", "HEIGHT 2000000000"), ":11: ", "2^31");
  CHECK_ERROR("a.pcd", replaced(text, "VIEWPOINT 0", "VIEWPOINT inf"), ":9: ", "not finite");
  CHECK_ERROR("a.pcd", replaced(text, "DATA ascii", "DATA text"), ":11: ", "'text'");
  CHECK_ERROR("a.pcd", replaced(text, "1 2 3 16744512", "1 2 c 16744512"), ":12: ", "z is not a number: 'c'");
  CHECK_ERROR("a.pcd", replaced(text, "1 2 3 16744512", "1 2 3 1 16744512"), ":12: ", "more values");
  CHECK_ERROR("a.pcd", replaced(text, " 1 2 3 0 0 1\n", " 1 2 3\n"), ":12: ", "ends before normal_x");
  CHECK_ERROR("a.pcd", text.substr(0, text.rfind("0.1")), ":14: ", "after 2 of 3 points");
  CHECK_ERROR("a.pcd", replaced(replaced(text, "POINTS 3", "POINTS 2000000000"), "WIDTH 3", "WIDTH 2000000000"),
              ":15: ", "after 3 of");
  const auto huge = [](const std::string& file) {
    return replaced(replaced(file, "POINTS 3", "POINTS 2000000000"), "WIDTH 3", "WIDTH 2000000000");
  };
  CHECK_ERROR("a.pcd", huge(binary), ": byte ", "after 3 of 2000000000 points");
  CHECK_ERROR("a.pcd", huge(packed), ": byte ", "declares 2000000000 points");
  CHECK_ERROR("a.pcd", binary.substr(0, binary.size() - 1), ": byte " + std::to_string(binary.size() - 1),
              "after 2 of 3");
  CHECK_ERROR("a.pcd", packed.substr(0, packed.size() - 1), ": byte " + std::to_string(packed.size() - 1),
              "within the packed data");
  CHECK_ERROR("a.pcd", packed.substr(0, packed.find("_compressed\n") + 14), ": byte ", "before the sizes");
  const std::size_t body = packed.find("_compressed\n") + 12;
  std::string damaged = packed;
  damaged[body + 8] = '\xff'; // a reference to before the beginning
  CHECK_ERROR("a.pcd", damaged, ": byte " + std::to_string(body + 8), "damaged");
  check_changed("a.pcd", text);
  check_changed("a.pcd", binary);
  check_changed("a.pcd", packed);
}

BOOST_AUTO_TEST_CASE(lzf_packs_and_unpacks)
{
  std::mt19937 random(7);
  for (int i = 0; i < 300; ++i) {
    std::string data;
    const std::size_t letters = 1 + random() % 9;
    const std::size_t size = random() % 3000;
    while (data.size() < size) data += char(random() % letters);
    const std::string packed = packed_lzf(data);
    std::string unpacked;
    BOOST_TEST(CR::internal::unpack_lzf(packed, data.size(), unpacked));
    BOOST_TEST(unpacked == data);
    BOOST_TEST(!CR::internal::unpack_lzf(packed, data.size() + 1, unpacked));
    if (data.empty()) continue;
    BOOST_TEST(!CR::internal::unpack_lzf(packed, data.size() - 1, unpacked));
    BOOST_TEST(!CR::internal::unpack_lzf(packed.substr(0, packed.size() - 1), data.size(), unpacked));
  }
  std::string unpacked;
  BOOST_TEST(!CR::internal::unpack_lzf("a", std::size_t(1) << 60, unpacked)); // before the memory is asked for
}

BOOST_AUTO_TEST_CASE(npy_files)
{
  for (const bool fortran : {false, true})
    for (const bool big : {false, true}) {
      std::string three_columns, six_columns, single;
      const auto rows = [&](int width, const auto& put) {
        for (int i = 0; i < 3 * width; ++i)
          put(fortran ? three_rows[std::size_t(i % 3)][std::size_t(i / 3)]
                      : three_rows[std::size_t(i / width)][std::size_t(i % width)]);
      };
      rows(3, [&](double x) { three_columns += bytes(x, big); });
      rows(6, [&](double x) { six_columns += bytes(x, big); });
      rows(3, [&](double x) { single += bytes(float(x), big); });
      const std::string order = big ? ">" : "<";
      BOOST_TEST(are(read("a.npy", npy(order + "f8", fortran, "(3, 3)", three_columns)), three));
      BOOST_TEST(are(read("noname", npy(order + "f8", fortran, "(3, 3)", three_columns, 2)), three));
      const Scan with_normals = read("a.npy", npy(order + "f8", fortran, "(3, 6)", six_columns));
      BOOST_TEST(are(with_normals, three));
      BOOST_TEST((with_normals.normals == three_normals));
      const Scan scan = read("a.npy", npy(order + "f4", fortran, "(3, 3)", single));
      BOOST_TEST(scan.points.at(2) == Point(double(0.1f), 0, double(-1e-3f)));
    }
  // colours are no normals, NaN no sample
  std::string body;
  for (const double x : {1., 2., 3., 255., 0., 9., not_a_number, 2., 3., 0., 0., 0., 4., 5., 6., 0., 1., 0.})
    body += bytes(x);
  const Scan coloured = read("a.npy", npy("<f8", false, "(3, 6)", body));
  BOOST_TEST(coloured.points.size() == 2);
  BOOST_TEST(coloured.missing == 1);
  BOOST_TEST(coloured.normals.empty());
  // rows x columns x 3
  for (const bool fortran : {false, true}) {
    std::string grid;
    for (int i = 0; i < 2 * 4 * 3; ++i) {
      const int c = fortran ? i / 8 : i % 3, row = fortran ? i % 2 : i / 12, column = fortran ? i / 2 % 4 : i / 3 % 4;
      grid += bytes(row == 1 && column == 2 ? 0. : c == 0 ? column : c == 1 ? row : 5.);
    }
    const Scan image = read("a.npy", npy("<f8", fortran, "(2, 4, 3)", grid));
    BOOST_TEST((image.kind == Scan::RANGE_IMAGE));
    BOOST_TEST(image.image.columns() == 4);
    BOOST_TEST(image.image.rows() == 2);
    BOOST_TEST(image.image.points().at(std::size_t(image.image.index(3, 1))) == Point(3, 1, 5));
    BOOST_TEST(image.image.index(2, 1) == -1);
    BOOST_TEST(image.missing == 1);
  }
}

BOOST_AUTO_TEST_CASE(wrong_npy_files)
{
  std::string body;
  for (int i = 0; i < 9; ++i) body += bytes(double(i * i % 5));
  const std::string good = npy("<f8", false, "(3, 3)", body);
  CHECK_ERROR("a.npy", good.substr(0, 9), ": byte 9: ", "header");
  CHECK_ERROR("a.npy", good.substr(0, 40), ": byte 40: ", "header");
  CHECK_ERROR("a.npy", good.substr(0, good.size() - 1), ": byte " + std::to_string(good.size() - 1),
              "too short for the shape");
  CHECK_ERROR("a.npy", npy("<f8", false, "(4000000000000000000, 3)", body), ": byte ", "too short for the shape");
  CHECK_ERROR("a.npy", npy("<f8", false, "(9,)", body), ": byte ", "neither of n x 3");
  CHECK_ERROR("a.npy", npy("<f8", false, "(4, 2)", body), ": byte ", "neither of n x 3");
  CHECK_ERROR("a.npy", npy("<f8", false, "(0, 3)", body), ": ", "no points");
  CHECK_ERROR("a.npy", npy("<f8", false, "(0, 0, 3)", body), ": ", "no points");
  CHECK_ERROR("a.npy", npy("<f8", false, "(x, 3)", body), ": byte ", "no size");
  CHECK_ERROR("a.npy", npy("<i4", false, "(3, 3)", body), ": byte ", "f4 or f8");
  CHECK_ERROR("a.npy", npy("<f2", false, "(3, 3)", body), ": byte ", "f4 or f8");
  CHECK_ERROR("a.npy", replaced(good, "False", "Maybe"), ": byte ", "neither True nor False");
  CHECK_ERROR("a.npy", replaced(good, "'shape'", "'shade'"), ": byte ", "'shape'");
  check_changed("a.npy", good);
}

BOOST_AUTO_TEST_CASE(las_files)
{
  const std::vector<std::array<std::int32_t, 3>> whole = {{100, 200, 300}, {-400, 550, 600}, {10, 0, 0}};
  for (const auto& [minor, format] :
       {std::pair(0, 0), std::pair(1, 1), std::pair(2, 3), std::pair(3, 4), std::pair(4, 6), std::pair(4, 3)}) {
    const Scan scan =
        read("a.las", las(whole, minor, static_cast<unsigned char>(format), {0.01, 0.01, 0.01}, {0, 0, 0}));
    BOOST_TEST((scan.kind == Scan::POINTS));
    BOOST_TEST(scan.points.size() == 3);
    BOOST_TEST(CGAL::squared_distance(scan.points[1], Point(-4, 5.5, 6)) < 1e-20);
  }
  // the offset is added in double: a tenth of a millimetre at five million
  const Scan far = read("a.LAS", las(whole, 2, 0, {1e-4, 1e-4, 1e-4}, {500000, 5000000, 100}));
  BOOST_TEST(std::abs(far.points[1].x() - 499999.96) < 1e-9);
  BOOST_TEST(std::abs(far.points[1].y() - 5000000.055) < 1e-8);

  const std::string good = las(whole, 2, 0, {0.01, 0.01, 0.01}, {0, 0, 0});
  CHECK_ERROR("a.las", good.substr(0, 100), ": byte 100: ", "within the header");
  CHECK_ERROR("a.las", "x" + good, ": byte 0: ", "LASF");
  CHECK_ERROR("a.las", good.substr(0, good.size() - 1), ": byte " + std::to_string(good.size() - 1), "after 2 of 3");
  const auto with = [&](std::size_t at, const std::string& what) {
    std::string file = good;
    return file.replace(at, what.size(), what);
  };
  CHECK_ERROR("a.las", with(25, "\5"), ": byte 24: ", "LAS 1.5");
  CHECK_ERROR("a.las", with(104, "\x83"), ": ", "compressed (LAZ)");
  CHECK_ERROR("a.laz", with(104, "\x83"), ": ", "compressed (LAZ)");
  CHECK_ERROR("a.las", with(104, "\x0b"), ": byte 104: ", "11");
  CHECK_ERROR("a.las", with(105, std::string("\0\0", 2)), ": byte 105: ", "too few");
  CHECK_ERROR("a.las", with(107, "\xff\xff\xff\xff"), ": byte ", "after 3 of 4294967295");
  CHECK_ERROR("a.las", with(96, "\xff\xff\xff\xff"), ": byte 96: ", "start");
  CHECK_ERROR("a.las", with(131, bytes(not_a_number)), ": byte 131: ", "scale");
  CHECK_ERROR("a.las", with(107, std::string(4, '\0')), ": ", "no points");
  CHECK_ERROR("a.e57", "ASTM-E57", ": ", "E57 is not read: convert");
  CHECK_ERROR("a.dat", "ASTM-E57", ": ", "E57 is not read: convert");
  check_changed("a.las", good);
}
