// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#define BOOST_TEST_MODULE read_range_image
#include <boost/test/unit_test.hpp>

#include "range_images.h"

#include <CGAL/Crude_registration/IO/read_range_image.h>
#include <CGAL/Crude_registration/IO/write_range_image.h>

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
#include <locale>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using namespace generated;

namespace {

enum Encoding
{
  ASCII,
  LITTLE,
  BIG
};

// Writes one value of a PLY type.
class Writer
{
public:
  explicit Writer(Encoding encoding) : m_encoding(encoding) {}

  template <class T>
  void put(T value)
  {
    if (m_encoding == ASCII) {
      std::ostringstream out;
      out.precision(17);
      out << +value << ' ';
      m_text += out.str();
      return;
    }
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    const std::uint16_t one = 1;
    const bool is_little = *reinterpret_cast<const char*>(&one) == 1;
    if (is_little != (m_encoding == LITTLE)) std::reverse(bytes, bytes + sizeof(T));
    m_text.append(bytes, sizeof(T));
  }

  void end_element()
  {
    if (m_encoding == ASCII) m_text += '\n';
  }
  void line(const std::string& text) { m_text += text + '\n'; }
  const std::string& text() const { return m_text; }

private:
  Encoding m_encoding;
  std::string m_text;
};

const std::array<std::string, 3> format_names = {"ascii", "binary_little_endian", "binary_big_endian"};

// A range image as PLY with other properties and elements around what is wanted, of every type.
template <class Coordinate>
std::string ply_of(const Image& image, Encoding encoding)
{
  Writer w(encoding);
  const std::string type = sizeof(Coordinate) == 4 ? "float" : "double";
  w.line("ply");
  w.line("format " + format_names[std::size_t(encoding)] + " 1.0");
  w.line("comment element vertex 7");
  w.line("obj_info is_cyberware_data 1");
  w.line("obj_info num_cols " + std::to_string(image.columns()));
  w.line("obj_info num_rows " + std::to_string(image.rows()));
  w.line("element camera 2");
  w.line("property list int16 uint16 names");
  w.line("property char c");
  w.line("element vertex " + std::to_string(image.points().size()));
  w.line("property " + type + " confidence");
  w.line("property " + type + " z");
  w.line("property uchar red");
  w.line("property list uchar double extra");
  w.line("property " + type + " x");
  w.line("property short s");
  w.line("property " + type + " y");
  w.line("property uint32 u");
  w.line("element range_grid " + std::to_string(image.grid().size()));
  w.line("property int8 flag");
  w.line("property list uint32 int vertex_indices");
  w.line("element nothing 3");
  w.line("end_header");
  for (int i = 0; i < 2; ++i) {
    w.put(std::int16_t(i));
    for (int k = 0; k < i; ++k) w.put(std::uint16_t(65535));
    w.put(std::int8_t(-3));
    w.end_element();
  }
  int k = 0;
  for (const Point& p : image.points()) {
    w.put(Coordinate(0.5));
    w.put(Coordinate(p.z()));
    w.put(std::uint8_t(200));
    w.put(std::uint8_t(k % 3));
    for (int e = 0; e < k % 3; ++e) w.put(1e300);
    w.put(Coordinate(p.x()));
    w.put(std::int16_t(-1));
    w.put(Coordinate(p.y()));
    w.put(std::uint32_t(4000000000u));
    w.end_element();
    ++k;
  }
  for (Image::Index i : image.grid()) {
    w.put(std::int8_t(1));
    w.put(std::uint32_t(i < 0 ? 0 : 1));
    if (i >= 0) w.put(std::int32_t(i));
    w.end_element();
  }
  return w.text();
}

Image bumpy_image()
{
  return orthographic_image(7, 5, 0.1, 0.3, [](double x, double y) {
    return std::abs(std::sin(20 * x + 10 * y)) < 0.3 ? no_depth : 1e-3 * std::sin(30 * x * y) - 123;
  });
}

Image read(const std::string& ply)
{
  std::istringstream in(ply);
  Image image;
  CR::read_range_image(in, image, "scan.ply");
  return image;
}

const std::string header = "ply\n"                                    // 1
                           "format ascii 1.0\n"                       // 2
                           "obj_info num_cols 2\n"                    // 3
                           "obj_info num_rows 2\n"                    // 4
                           "element vertex 3\n"                       // 5
                           "property float x\n"                       // 6
                           "property float y\n"                       // 7
                           "property float z\n"                       // 8
                           "element range_grid 4\n"                   // 9
                           "property list uchar int vertex_indices\n" // 10
                           "end_header\n";                            // 11
const std::string body = "0 0 1\n"                                    // 12
                         "1 0 1\n"                                    // 13
                         "0 1 1.5\n"                                  // 14
                         "1 0\n"                                      // 15
                         "1 1\n"                                      // 16
                         "1 2\n"                                      // 17
                         "0\n";                                       // 18

std::string replaced(std::string text, const std::string& what, const std::string& by)
{
  const std::size_t at = text.find(what);
  BOOST_REQUIRE(at != std::string::npos);
  return text.replace(at, what.size(), by);
}

// The error that reading gives, "" for none; also that it leaves the image as it was.
std::string error_of(const std::string& ply)
{
  std::istringstream in(ply);
  Image image = bumpy_image();
  const std::size_t samples = image.points().size();
  try {
    CR::read_range_image(in, image, "scan.ply");
  } catch (const CR::IO_error& error) {
    BOOST_TEST_MESSAGE(error.what());
    BOOST_TEST(error.file() == "scan.ply");
    const std::string place = error.line() == 0 ? "scan.ply: " : "scan.ply:" + std::to_string(error.line()) + ": ";
    BOOST_TEST(std::string(error.what()).find(place) == 0);
    BOOST_TEST(image.points().size() == samples);
    return error.what();
  }
  return "";
}

#define CHECK_ERROR(PLY, BEGINNING, PART)                                                                              \
  {                                                                                                                    \
    const std::string error = error_of(PLY);                                                                           \
    BOOST_TEST(error.find(BEGINNING) == 0, error);                                                                     \
    BOOST_TEST(error.find(PART) != std::string::npos, error);                                                          \
  }

} // namespace

BOOST_AUTO_TEST_CASE(every_encoding_and_type_gives_the_same_image)
{
  const Image image = bumpy_image();
  BOOST_TEST(image.points().size() < image.grid().size());
  for (Encoding encoding : {ASCII, LITTLE, BIG}) {
    const Image exact = read(ply_of<double>(image, encoding));
    BOOST_TEST(exact.columns() == 7);
    BOOST_TEST(exact.rows() == 5);
    BOOST_TEST((exact.grid() == image.grid()));
    BOOST_TEST((exact.points() == image.points()));
    const Image rounded = read(ply_of<float>(image, encoding));
    BOOST_TEST((rounded.grid() == image.grid()));
    for (std::size_t i = 0; i < image.points().size(); ++i)
      for (int k = 0; k < 3; ++k) BOOST_TEST(float(rounded.points()[i][k]) == float(image.points()[i][k]));
  }
}

// Three samples with coordinates at the ends of an integer type, and a grid of that type's indices.
template <class Integer>
void check_integers(const std::string& type)
{
  using Limits = std::numeric_limits<Integer>;
  const std::array<std::array<Integer, 3>, 3> samples = {
      {{{Limits::lowest(), 0, 1}}, {{Limits::max(), 2, 3}}, {{4, Limits::max() / 2, 5}}}};
  for (Encoding encoding : {ASCII, LITTLE, BIG}) {
    Writer w(encoding);
    w.line("ply\nformat " + format_names[std::size_t(encoding)] + " 1.0\nobj_info num_cols 2\nobj_info num_rows 2");
    w.line("element vertex 3\nproperty " + type + " x\nproperty " + type + " y\nproperty " + type + " z");
    w.line("element range_grid 4\nproperty list " + type + " " + type + " vertex_indices\nend_header");
    for (const auto& sample : samples) {
      for (const Integer coordinate : sample) w.put(coordinate);
      w.end_element();
    }
    for (int i = 2; i >= -1; --i) {
      w.put(Integer(i < 0 ? 0 : 1));
      if (i >= 0) w.put(Integer(i));
      w.end_element();
    }
    const Image image = read(w.text());
    BOOST_TEST((image.grid() == std::vector<Image::Index>{2, 1, 0, -1}), type);
    BOOST_TEST_REQUIRE(image.points().size() == 3u);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) BOOST_TEST(image.points()[i][int(k)] == double(samples[i][k]), type);
  }
}

BOOST_AUTO_TEST_CASE(integers_of_every_type)
{
  check_integers<std::int8_t>("char");
  check_integers<std::uint8_t>("uint8");
  check_integers<std::int16_t>("int16");
  check_integers<std::uint16_t>("ushort");
  check_integers<std::int32_t>("int");
  check_integers<std::uint32_t>("uint32");
}

BOOST_AUTO_TEST_CASE(the_grid_is_read_row_by_row)
{
  const Image image = read(header + body);
  BOOST_TEST(image.index(0, 0) == 0);
  BOOST_TEST(image.index(1, 0) == 1);
  BOOST_TEST(image.index(0, 1) == 2);
  BOOST_TEST(image.index(1, 1) == -1);
  BOOST_TEST(image.points()[2] == Point(0, 1, 1.5));
}

BOOST_AUTO_TEST_CASE(line_ends_blank_lines_and_spaces_do_not_matter)
{
  const std::string text = header + body;
  std::string crlf, cr, spaced;
  for (char c : text) {
    crlf += c == '\n' ? "\r\n" : std::string(1, c);
    cr += c == '\n' ? '\r' : c;
    spaced += c == '\n' ? "  \n\n" : c == ' ' ? " \t " : std::string(1, c);
  }
  for (const std::string& variant : {crlf, cr, spaced, text.substr(0, text.size() - 1)}) {
    const Image image = read(variant);
    BOOST_TEST((image.grid() == read(text).grid()));
    BOOST_TEST((image.points() == read(text).points()));
  }
}

BOOST_AUTO_TEST_CASE(numbers_may_be_written_in_any_way)
{
  const Image image = read(header + replaced(body, "0 1 1.5", "+0.0 1.E0 1500000e-6"));
  BOOST_TEST(image.points()[2] == Point(0, 1, 1.5));
  // too small for a double
  BOOST_TEST(
      read(header + replaced(body, "0 1 1.5", "1e-999 -1e-320 0." + std::string(400, '0') + "1")).points()[2].x() == 0);
}

BOOST_AUTO_TEST_CASE(the_locale_does_not_matter)
{
  class Comma : public std::numpunct<char>
  {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
  const Image image = read(header + body);
  std::ostringstream out;
  write_range_image(out, bumpy_image());
  const Image written = read(out.str());
  std::locale::global(before);
  BOOST_TEST(image.points()[2] == Point(0, 1, 1.5));
  BOOST_TEST((written.points() == bumpy_image().points()));
}

BOOST_AUTO_TEST_CASE(what_is_written_is_read_back_the_same)
{
  const Temporary_folder folder;
  const std::string name = (folder.path() / "scan.ply").string();
  Random random(1);
  for (int i = 0; i < 3; ++i) {
    Image image = bumpy_image();
    if (i == 1) image.set_sensor(Sensor::perspective(point(random.vector())));
    if (i == 2) image.set_sensor(Sensor::orthographic(Kernel::Vector_3(0.1, 0.2, -0.3)));
    transform(image, aff(random.motion(1e5)));
    CR::write_range_image(name, image); // also over the file before
    Image other;
    CR::read_range_image(name, other);
    BOOST_TEST(other.columns() == image.columns());
    BOOST_TEST((other.grid() == image.grid()));
    BOOST_TEST((other.points() == image.points()));
    if (i == 1) BOOST_TEST(other.sensor().viewpoint() == image.sensor().viewpoint());
    if (i == 2)
      BOOST_TEST((vector(other.sensor().viewing_direction()) - vector(image.sensor().viewing_direction())).norm() <
                 1e-15);
  }
  BOOST_TEST(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 1); // nothing is left behind
}

BOOST_AUTO_TEST_CASE(a_file_is_written_whole_or_not_at_all)
{
  const Temporary_folder folder;
  const std::string name = folder.file("result.txt", "before");
  const auto contents = [&] {
    std::ifstream in(name);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  using CR::write_file;
  BOOST_CHECK_THROW(write_file(name,
                               [](std::ostream& out) {
                                 out << "half";
                                 throw std::runtime_error("no more");
                               }),
                    std::runtime_error);
  BOOST_TEST(contents() == "before");
  BOOST_CHECK_THROW(write_file(name, [](std::ostream& out) { out.setstate(std::ios::badbit); }), CR::IO_error);
  BOOST_TEST(contents() == "before");
  std::filesystem::permissions(name, std::filesystem::perms::owner_all);
  write_file(name, [](std::ostream& out) { out << 0.1 << ' ' << 1234567; });
  BOOST_TEST(contents() == "0.10000000000000001 1234567");
  BOOST_TEST((std::filesystem::status(name).permissions() == std::filesystem::perms::owner_all));
  BOOST_TEST(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 1);

  // a link stays one
  const std::filesystem::path link = folder.path() / "link";
  std::filesystem::create_symlink("result.txt", link);
  write_file(link.string(), [](std::ostream& out) { out << "through"; });
  BOOST_TEST(std::filesystem::is_symlink(link));
  BOOST_TEST(contents() == "through");

  for (const std::string& wrong : {folder.path().string(), (folder.path() / "no" / "folder").string(), std::string()})
    BOOST_CHECK_THROW(write_file(wrong, [](std::ostream&) {}), CR::IO_error);
  BOOST_CHECK_NO_THROW(write_file("/dev/null", [](std::ostream& out) { out << "gone"; }));
  BOOST_TEST(std::filesystem::is_character_file("/dev/null"));
}

BOOST_AUTO_TEST_CASE(files_that_cannot_be_opened)
{
  const Temporary_folder folder;
  Image image;
  for (const std::string& name : {(folder.path() / "missing.ply").string(), folder.path().string(), std::string()})
    BOOST_CHECK_EXCEPTION(CR::read_range_image(name, image), CR::IO_error,
                          [&](const CR::IO_error& error) { return error.file() == name && error.line() == 0; });
}

BOOST_AUTO_TEST_CASE(wrong_headers)
{
  CHECK_ERROR("", "scan.ply:1: ", "not a PLY file");
  CHECK_ERROR("plywood\n", "scan.ply:1: ", "not a PLY file");
  CHECK_ERROR("ply\nformat ascii 1.0\n", "scan.ply:2: ", "end_header");
  CHECK_ERROR(replaced(header + body, "ascii", "utf8"), "scan.ply:2: ", "utf8");
  CHECK_ERROR(replaced(header + body, "format ascii 1.0\n", ""), "scan.ply:10: ", "format");
  CHECK_ERROR(replaced(header + body, "obj_info num_cols 2\n", ""), "scan.ply:10: ", "num_cols");
  CHECK_ERROR(replaced(header + body, "obj_info num_rows 2\n", ""), "scan.ply:10: ", "num_rows");
  CHECK_ERROR(replaced(header + body, "num_cols 2", "num_cols two"), "scan.ply:3: ", "two");
  CHECK_ERROR(replaced(header + body, "num_cols 2", "num_cols"), "scan.ply:3: ", "num_cols");
  CHECK_ERROR(replaced(header + body, "num_cols 2", "num_cols 0"), "scan.ply:3: ", "positive");
  CHECK_ERROR(replaced(header + body, "num_rows 2", "num_rows -2"), "scan.ply:4: ", "positive");
  CHECK_ERROR(replaced(header + body, "num_cols 2", "num_cols 3"), "scan.ply:9: ", "3 times 2");
  CHECK_ERROR(replaced(header + body, "num_cols 2", "num_cols 4294967298"), "scan.ply:9: ", "4 cells");
  CHECK_ERROR(replaced(header + body, "range_grid 4", "range_grid 5"), "scan.ply:9: ", "5 cells");
  CHECK_ERROR(replaced(header + body, "range_grid 4", "range_grid -4"), "scan.ply:9: ", "negative");
  CHECK_ERROR(replaced(header + body, "range_grid 4", "range_grid"), "scan.ply:9: ", "number of elements");
  CHECK_ERROR(replaced(header + body, "range_grid", "face"), "scan.ply: ", "range_grid");
  CHECK_ERROR(replaced(header + body, "element vertex", "element vertices"), "scan.ply:11: ", "element vertex");
  CHECK_ERROR(replaced(header + body, "vertex 3", "vertex 99999999999"), "scan.ply:5: ", "2^31");
  CHECK_ERROR(replaced(header + body, "float x", "float w"), "scan.ply:5: ", "'x'");
  CHECK_ERROR(replaced(header + body, "float z", "list uchar float z"), "scan.ply:5: ", "'z'");
  CHECK_ERROR(replaced(header + body, "float y", "floatish y"), "scan.ply:7: ", "floatish");
  CHECK_ERROR(replaced(header + body, "float y", "float"), "scan.ply:7: ", "no name");
  CHECK_ERROR(replaced(header + body, "element vertex 3\n", ""), "scan.ply:5: ", "before the first element");
  CHECK_ERROR(replaced(header + body, "element range_grid", "element vertex"), "scan.ply:9: ", "twice");
  CHECK_ERROR(replaced(header + body, "list uchar int vertex_indices", "int vertex_indices"), "scan.ply:9: ", "list");
  CHECK_ERROR(replaced(header + body, "list uchar int", "list float int"), "scan.ply:10: ", "integer");
  CHECK_ERROR(replaced(header + body, "list uchar int", "list uchar float"), "scan.ply:9: ", "integers");
}

BOOST_AUTO_TEST_CASE(wrong_sensors)
{
  const auto with = [](const std::string& line) {
    return replaced(header + body, "element vertex", line + "\nelement vertex");
  };
  CHECK_ERROR(with("obj_info viewpoint 1 2"), "scan.ply:5: ", "viewpoint");
  CHECK_ERROR(with("obj_info viewpoint 1 2 inf"), "scan.ply:5: ", "viewpoint");
  CHECK_ERROR(with("obj_info viewing_direction 0 0 0"), "scan.ply:5: ", "viewing_direction is null");
  CHECK_ERROR(with("obj_info viewing_direction 0 nan 0"), "scan.ply:5: ", "viewing_direction");
}

BOOST_AUTO_TEST_CASE(wrong_ascii_bodies)
{
  const std::string text = header + body;
  CHECK_ERROR(replaced(text, "1 0 1\n", "1 0\n"), "scan.ply:13: ", "ends before z");
  CHECK_ERROR(replaced(text, "1 0 1\n", "1 0 1 7\n"), "scan.ply:13: ", "more values");
  CHECK_ERROR(replaced(text, "0 1 1.5", "0 1 abc"), "scan.ply:14: ", "abc");
  CHECK_ERROR(replaced(text, "0 1 1.5", "0 1 1.5.2"), "scan.ply:14: ", "1.5.2");
  CHECK_ERROR(replaced(text, "0 1 1.5", "0 1 1,5"), "scan.ply:14: ", "1,5");
  for (const std::string bad : {"nan", "NaN", "inf", "-inf", "1e999", "-1e999"})
    BOOST_TEST(read(replaced(text, "0 1 1.5", "0 1 " + bad)).points().size() + 1 == read(text).points().size());
  CHECK_ERROR(replaced(text, "0 1 1.5", "0 1 1e90"), "scan.ply: ", "1e75");
  CHECK_ERROR(replaced(text, "1 2\n", "1 3\n"), "scan.ply:17: ", "vertex index 3");
  CHECK_ERROR(replaced(text, "1 2\n", "1 -1\n"), "scan.ply:17: ", "vertex index -1");
  CHECK_ERROR(replaced(text, "1 2\n", "1 99999999999999999999\n"), "scan.ply:17: ", "integer");
  CHECK_ERROR(replaced(text, "1 2\n", "1 2.5\n"), "scan.ply:17: ", "2.5");
  CHECK_ERROR(replaced(text, "1 2\n", "1\n"), "scan.ply:17: ", "ends before vertex_indices");
  CHECK_ERROR(replaced(text, "1 2\n", "-1\n"), "scan.ply:17: ", "negative");
  CHECK_ERROR(replaced(text, "1 2\n", "2 1 2\n"), "scan.ply:17: ", "more than one vertex");
  CHECK_ERROR(replaced(text, "1 2\n", "1 1\n"), "scan.ply: ", "vertex 1 is in two cells");
  // cut off anywhere: never accepted, always with the line behind the last one
  for (std::size_t line = 11; line < 18; ++line) {
    std::size_t end = 0;
    for (std::size_t i = 0; i < line; ++i) end = text.find('\n', end) + 1;
    CHECK_ERROR(text.substr(0, end), "scan.ply:" + std::to_string(line + 1) + ": ", "the file ends after");
  }
}

BOOST_AUTO_TEST_CASE(an_image_without_samples)
{
  CHECK_ERROR(replaced(header, "vertex 3", "vertex 0") + "0\n0\n0\n0\n", "scan.ply: ", "no samples");
}

BOOST_AUTO_TEST_CASE(wrong_binary_bodies)
{
  const Image image = bumpy_image();
  for (Encoding encoding : {LITTLE, BIG}) {
    const std::string text = ply_of<float>(image, encoding);
    const std::size_t begin = text.find("end_header\n") + 11;
    BOOST_TEST(error_of(text) == "");
    for (std::size_t size = begin; size < text.size(); ++size) {
      const std::string error = error_of(text.substr(0, size));
      BOOST_TEST(error.find("scan.ply: byte " + std::to_string(size) + ": the file ends after") == 0, error);
    }
    Writer not_a_number(encoding);
    not_a_number.put(std::numeric_limits<float>::quiet_NaN());
    std::string bad = text;
    // two cameras of 3 and 5 bytes, then the first vertex: confidence, z
    bad.replace(begin + 8 + 4, 4, not_a_number.text());
    BOOST_TEST(read(bad).points().size() + 1 == image.points().size()); // a missing sample
    Writer wrong_index(encoding);
    wrong_index.put(std::int32_t(image.points().size()));
    bad = text;
    // the last cell that has a sample
    std::size_t end = text.size();
    for (std::size_t cell = image.grid().size(); image.grid()[--cell] < 0;) end -= 5;
    bad.replace(end - 4, 4, wrong_index.text());
    CHECK_ERROR(bad, "scan.ply: byte " + std::to_string(end - 9) + ": ", "outside");
  }
}

BOOST_AUTO_TEST_CASE(counts_that_the_file_cannot_hold_take_no_memory)
{
  std::string text = replaced(header + body, "vertex 3", "vertex 2000000000");
  CHECK_ERROR(text, "scan.ply:15: ", "z"); // the first line of the grid, taken for a vertex
  text = replaced(replaced(replaced(header + body, "num_cols 2", "num_cols 40000"), "num_rows 2", "num_rows 50000"),
                  "range_grid 4", "range_grid 2000000000");
  CHECK_ERROR(text, "scan.ply:19: ", "the file ends after 4 of 2000000000");
}

BOOST_AUTO_TEST_CASE(any_bytes_are_read_or_refused)
{
  // flips, cuts and doublings of a good file, in all encodings
  std::mt19937 random(1);
  for (Encoding encoding : {ASCII, LITTLE, BIG}) {
    const std::string good = ply_of<float>(bumpy_image(), encoding);
    for (int i = 0; i < 3000; ++i) {
      std::string text = good;
      for (unsigned k = 0; k <= random() % 3; ++k) {
        const std::size_t at = random() % text.size();
        switch (random() % 3) {
        case 0:
          text[at] = char(random());
          break;
        case 1:
          text.erase(at, random() % 20);
          break;
        default:
          text.insert(at, text.substr(random() % text.size(), random() % 20));
        }
      }
      std::istringstream in(text);
      Image image;
      try {
        CR::read_range_image(in, image);
      } catch (const CR::IO_error&) {
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(real_range_images, *boost::unit_test::label("real_scans") *
                                            boost::unit_test::precondition(generated::real_scans_are_there))
{
  // the size of each, from the header: all samples are in the grid
  for (const std::string set : {"bunny", "dragon_stand", "slambook2_rgbd"}) {
    for (const auto& file : files(real_scans(set), ".ply")) {
      Image image;
      CR::read_range_image(file.string(), image);
      std::size_t samples = 0;
      for (Image::Index i : image.grid()) samples += i >= 0 ? 1 : 0;
      BOOST_TEST(samples == image.points().size());
      BOOST_TEST(samples > 10000);
      BOOST_TEST(image.sensor().is_known());
    }
  }
}
