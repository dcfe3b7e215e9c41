// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// glTF, as text and binary: what the nodes of its scene place.

#define BOOST_TEST_MODULE read_gltf
#include <boost/test/unit_test.hpp>

#include "scan_files.h"

#ifdef CGAL_CRUDE_REGISTRATION_USE_JSON
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string>
#include <vector>

using namespace generated;
using Json = nlohmann::json;
using Direction = Kernel::Vector_3;

namespace {

// The machine is little-endian, as the numbers of glTF are.
template <class T>
std::string bytes(std::initializer_list<T> values)
{
  std::string result;
  for (const T value : values) {
    std::string of_one(sizeof value, '\0');
    std::memcpy(of_one.data(), &value, sizeof value);
    result += of_one;
  }
  return result;
}

std::string base64(const std::string& data)
{
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string result;
  for (std::size_t i = 0; i < data.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < data.size() ? static_cast<unsigned char>(data[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) result += i + k > data.size() ? '=' : letters[bits >> (18 - 6 * k) & 63];
  }
  return result;
}

// Accessors are added one by one, each with a view of its own.
struct Gltf
{
  Json json = {{"asset", {{"version", "2.0"}}}};
  std::string buffer;

  int add(const std::string& data, int component, const char* type, std::size_t count)
  {
    buffer.resize((buffer.size() + 3) / 4 * 4);
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", data.size()}});
    buffer += data;
    json["accessors"].push_back({{"bufferView", json["bufferViews"].size() - 1},
                                 {"componentType", component},
                                 {"type", type},
                                 {"count", count}});
    return int(json["accessors"].size()) - 1;
  }
  int floats(std::initializer_list<float> values) { return add(bytes(values), 5126, "VEC3", values.size() / 3); }
  int indices(std::initializer_list<std::uint16_t> values) { return add(bytes(values), 5123, "SCALAR", values.size()); }

  std::string text() const
  {
    Json whole = json;
    whole["buffers"] = {
        {{"byteLength", buffer.size()}, {"uri", "data:application/octet-stream;base64," + base64(buffer)}}};
    return whole.dump();
  }
  std::string text_with(const std::string& uri) const
  {
    Json whole = json;
    whole["buffers"] = {{{"byteLength", buffer.size()}, {"uri", uri}}};
    return whole.dump();
  }
  std::string binary() const
  {
    Json whole = json;
    whole["buffers"] = {{{"byteLength", buffer.size()}}};
    std::string head = whole.dump(), body = buffer;
    head.resize((head.size() + 3) / 4 * 4, ' ');
    body.resize((body.size() + 3) / 4 * 4);
    const std::uint32_t length = std::uint32_t(12 + 8 + head.size() + 8 + body.size());
    return "glTF" + bytes({std::uint32_t(2), length, std::uint32_t(head.size()), std::uint32_t(0x4e4f534a)}) + head +
           bytes({std::uint32_t(body.size()), std::uint32_t(0x004e4942)}) + body;
  }
};

// A mesh of one primitive, placed by a node.
Gltf square(const char* mode_and_indices)
{
  Gltf gltf;
  const int positions = gltf.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0.5f});
  Json primitive = {{"attributes", {{"POSITION", positions}}}};
  const std::string what = mode_and_indices;
  if (what == "triangles") primitive["indices"] = gltf.indices({0, 1, 2, 2, 1, 3});
  if (what == "strip") primitive["mode"] = 5;
  if (what == "fan") {
    primitive["mode"] = 6;
    primitive["indices"] = gltf.add(bytes<std::uint8_t>({1, 3, 2, 0}), 5121, "SCALAR", 4);
  }
  if (what == "points") primitive["mode"] = 0;
  if (what == "lines") primitive["mode"] = 1;
  gltf.json["meshes"] = {{{"primitives", {primitive}}}};
  gltf.json["nodes"] = {{{"mesh", 0}}};
  gltf.json["scenes"] = {{{"nodes", {0}}}};
  gltf.json["scene"] = 0;
  return gltf;
}

// twice the area, as a vector
Direction area_of(const Scan& scan)
{
  Direction sum(0, 0, 0);
  for (const auto f : scan.mesh.faces()) {
    std::vector<Point> p;
    for (const auto v : scan.mesh.vertices_around_face(scan.mesh.halfedge(f))) p.push_back(scan.mesh.point(v));
    BOOST_TEST(p.size() == 3);
    sum = sum + CGAL::cross_product(p[1] - p[0], p[2] - p[0]);
  }
  return sum;
}

std::vector<Point> points_of_mesh(const Scan& scan)
{
  return std::vector<Point>(scan.mesh.points().begin(), scan.mesh.points().end());
}

const std::vector<Point> corners = {Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(1, 1, 0.5)};

} // namespace

BOOST_AUTO_TEST_CASE(triangles_strips_and_fans_are_the_same_surface)
{
  for (const char* what : {"triangles", "strip", "fan"})
    for (const bool is_binary : {false, true}) {
      BOOST_TEST_CONTEXT(what << (is_binary ? ".glb" : ".gltf"))
      {
        const Gltf gltf = square(what);
        const Scan scan = read(is_binary ? "a.glb" : "a.gltf", is_binary ? gltf.binary() : gltf.text());
        BOOST_TEST((scan.kind == Scan::MESH));
        BOOST_TEST(scan.mesh.number_of_faces() == 2);
        BOOST_TEST((points_of_mesh(scan) == corners));
        const Direction area = area_of(scan); // upwards: no face is turned
        BOOST_TEST(std::abs(area.z() - 2) < 1e-12);
      }
    }
  // told by the first bytes, whatever the name
  BOOST_TEST((read("a.dat", square("triangles").binary()).kind == Scan::MESH));
}

BOOST_AUTO_TEST_CASE(points_have_normals_and_their_numbers_may_be_whole)
{
  Gltf gltf = square("points");
  gltf.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
      gltf.floats({0, 0, 1, 0, 0, 1, 0, 1, 0, 0.6f, 0, 0.8f});
  gltf.json["nodes"][0]["scale"] = {1, 1, 2};
  const Scan scan = read("a.glb", gltf.binary());
  BOOST_TEST((scan.kind == Scan::POINTS));
  BOOST_TEST((scan.points == std::vector<Point>{Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(1, 1, 1)}));
  BOOST_REQUIRE(scan.normals.size() == 4);
  // normals stay normal to what is stretched: (0.6, 0, 0.8) to (0.6, 0, 0.4), made of length 1
  BOOST_TEST((scan.normals[3] - Direction(3 / std::sqrt(13.), 0, 2 / std::sqrt(13.))).squared_length() < 1e-12);

  // shorts as they are, with a stride; and as fractions
  for (const bool normalized : {false, true}) {
    Gltf whole;
    const int positions =
        whole.add(bytes<std::int16_t>({0, 0, 0, 99, 32767, 0, 0, 99, -32768, 7, 0, 99}), 5122, "VEC3", 3);
    whole.json["bufferViews"][0]["byteStride"] = 8;
    whole.json["accessors"][0]["normalized"] = normalized;
    whole.json["meshes"] = {{{"primitives", {{{"mode", 0}, {"attributes", {{"POSITION", positions}}}}}}}};
    const Scan read_whole = read("a.gltf", whole.text()); // without nodes: all meshes
    BOOST_REQUIRE(read_whole.points.size() == 3);
    BOOST_TEST(read_whole.points[1].x() == (normalized ? 1 : 32767));
    BOOST_TEST(read_whole.points[2].x() == (normalized ? -1 : -32768));
    BOOST_TEST(read_whole.points[2].y() == (normalized ? 7 / 32767. : 7));
  }
}

BOOST_AUTO_TEST_CASE(vertices_have_colors)
{
  const std::vector<CGAL::IO::Color> expected = {CGAL::IO::Color(255, 0, 51), CGAL::IO::Color(0, 255, 0),
                                                 CGAL::IO::Color(0, 0, 255), CGAL::IO::Color(255, 255, 255)};
  for (const char* mode : {"points", "triangles"}) {
    Gltf gltf = square(mode);
    Json& attributes = gltf.json["meshes"][0]["primitives"][0]["attributes"];
    const int floats = gltf.floats({1, 0, 0.2f, 0, 1, 0, 0, 0, 1, 1, 1, 1});
    attributes["COLOR_0"] = floats;
    BOOST_TEST((read("a.glb", gltf.binary()).colors == expected));
    gltf = square(mode);
    const int of_bytes =
        gltf.add(bytes<std::uint8_t>({255, 0, 51, 9, 0, 255, 0, 9, 0, 0, 255, 9, 255, 255, 255, 9}), 5121, "VEC4", 4);
    gltf.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = of_bytes;
    BOOST_TEST((read("a.glb", gltf.binary()).colors == expected));
    gltf.json["accessors"][std::size_t(of_bytes)]["count"] = 3;
    CHECK_ERROR("a.glb", gltf.binary(), ": mesh 0, primitive 0: ", "as many colours as positions");
  }
}

BOOST_AUTO_TEST_CASE(nodes_place_meshes)
{
  // a quarter turn about z, then a shift; a child that is stretched; the same mesh twice
  Gltf gltf = square("triangles");
  const double half = std::sqrt(0.5);
  gltf.json["nodes"] = {{{"children", {1, 2}}, {"rotation", {0, 0, half, half}}, {"translation", {10, 20, 30}}},
                        {{"mesh", 0}, {"scale", {1, 3, 1}}},
                        {{"mesh", 0}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1}}},
                        {{"mesh", 0}}}; // in no scene
  const Scan scan = read("a.glb", gltf.binary());
  BOOST_TEST(scan.mesh.number_of_faces() == 4);
  const std::vector<Point> points = points_of_mesh(scan);
  BOOST_REQUIRE(points.size() == 8);
  for (std::size_t i = 0; i < 4; ++i) {
    const Point &c = corners[i], first(10 - 3 * c.y(), 20 + c.x(), 30 + c.z()),
                second(10 - c.y() - 6, 20 + c.x() + 5, 30 + c.z() + 7);
    BOOST_TEST(CGAL::squared_distance(points[i], first) < 1e-20);
    BOOST_TEST(CGAL::squared_distance(points[i + 4], second) < 1e-20);
  }
  // without scenes: the nodes that are no children
  gltf.json.erase("scenes");
  gltf.json.erase("scene");
  BOOST_TEST(read("a.glb", gltf.binary()).mesh.number_of_faces() == 6);

  // a mirror image keeps its outside: its triangles are turned
  Gltf mirrored = square("triangles");
  mirrored.json["nodes"][0]["scale"] = {1, 1, -1};
  BOOST_TEST(std::abs(area_of(read("a.glb", mirrored.binary())).z() + 2) < 1e-12);

  // coordinates in double, far from the origin
  Gltf far = square("points");
  far.json["nodes"][0]["translation"] = {500000.0001, 5000000.0002, 0};
  BOOST_TEST(read("a.gltf", far.text()).points[1].x() == 500000.0001 + 1);
}

BOOST_AUTO_TEST_CASE(vertices_that_stand_twice_are_one)
{
  // as they stand where the coordinates of a texture differ
  Gltf gltf;
  const int positions = gltf.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0.5f});
  gltf.json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", positions}}}}}}}};
  const Scan scan = read("a.gltf", gltf.text());
  BOOST_TEST((points_of_mesh(scan) == corners));
  BOOST_TEST(scan.mesh.number_of_faces() == 2);

  // points beside triangles, and lines, are passed over
  Gltf mixed = square("triangles");
  mixed.json["meshes"][0]["primitives"].push_back(
      {{"mode", 0}, {"attributes", {{"POSITION", mixed.floats({9, 9, 9})}}}});
  mixed.json["meshes"][0]["primitives"].push_back(
      {{"mode", 3}, {"attributes", {{"POSITION", mixed.floats({8, 8, 8})}}}});
  BOOST_TEST((points_of_mesh(read("a.glb", mixed.binary())) == corners));
}

BOOST_AUTO_TEST_CASE(buffers_may_be_files)
{
  const Gltf gltf = square("triangles");
  folder().file("the points.bin", gltf.buffer + "more than is said");
  BOOST_TEST(read("a.gltf", gltf.text_with("the%20points.bin")).mesh.number_of_faces() == 2);
  folder().file("short.bin", gltf.buffer.substr(1));
  CHECK_ERROR("a.gltf", gltf.text_with("short.bin"), ": buffer 0: ", "'short.bin' has 59 of its 60 bytes");
  CHECK_ERROR("a.gltf", gltf.text_with("absent.bin"), ": buffer 0: ", "there is no file 'absent.bin'");
  CHECK_ERROR("a.gltf", gltf.text_with("."), ": buffer 0: ", "there is no file");
  CHECK_ERROR("a.gltf", gltf.text_with("/dev/zero"), ": buffer 0: ", "does not name a file beside");
  CHECK_ERROR("a.gltf", gltf.text_with("https://host/a.bin"), ": buffer 0: ", "does not name a file beside");
  CHECK_ERROR("a.gltf", gltf.text_with("data:text/plain,abc"), ": buffer 0: ", "base64");
  CHECK_ERROR("a.gltf", gltf.text_with("data:;base64,ab!c"), ": buffer 0: ", "base64");
  CHECK_ERROR("a.gltf", gltf.text_with("data:;base64,abcd"), ": buffer 0: ", "3 of its 60 bytes");
}

BOOST_AUTO_TEST_CASE(wrong_files_are_told)
{
  const Gltf good = square("triangles");
  const auto with = [&](const char* pointer, const Json& value) {
    Gltf changed = good;
    changed.json[Json::json_pointer(pointer)] = value;
    return changed.binary();
  };
  const std::string file = good.binary();
  CHECK_ERROR("a.glb", file.substr(0, 10), ": byte 10: ", "within the header");
  CHECK_ERROR("a.glb", file.substr(0, file.size() - 1), ": byte " + std::to_string(file.size() - 1), "ends after");
  CHECK_ERROR("a.glb", std::string(file).replace(4, 1, "\1"), ": byte 4: ", "glTF 1 is not read");
  CHECK_ERROR("a.glb", std::string(file).replace(12, 4, "\xff\xff\xff\x7f"), ": byte 20: ", "beyond the end");
  CHECK_ERROR("a.glb", std::string(file).replace(16, 1, "x"), ": byte 16: ", "is JSON");
  CHECK_ERROR("a.glb", std::string(file).replace(8, 4, bytes({std::uint32_t(12)})), ": byte 12: ", "no chunk of JSON");
  CHECK_ERROR("a.glb", std::string(file).replace(20, 1, "x"), ": byte 21: ", "not JSON");
  CHECK_ERROR("a.gltf", "{\"asset\":\n{\"version\":\n]}", ":3: ", "not JSON");
  CHECK_ERROR("a.gltf", "{\"asset\":1e999}", ": ", "out of range");
  CHECK_ERROR("a.gltf", "[]", ": the file: ", "version");
  CHECK_ERROR("a.gltf", "{\"asset\":{\"version\":\"1.0\"}}", ": the file: ", "glTF 1.0 is not read");
  CHECK_ERROR("a.gltf", "{\"asset\":{\"version\":\"2.0\"}}", ": ", "no points");
  // deeper than any stack
  CHECK_ERROR("a.gltf", std::string(1000000, '['), ":1: ", "not JSON");
  CHECK_ERROR("a.gltf",
              "{\"asset\":{\"version\":\"2.0\"},\"extras\":" + std::string(500000, '[') + std::string(500000, ']') +
                  "}",
              ": ", "no points");

  CHECK_ERROR("a.glb", with("/accessors/0/count", 5), ": accessor 0: ", "48 bytes is too short for its 5 elements");
  CHECK_ERROR("a.glb", with("/accessors/0/count", 1e15), ": accessor 0: ", "too short");
  CHECK_ERROR("a.glb", with("/accessors/0/count", 18446744073709551615u), ": accessor 0: ", "too short");
  CHECK_ERROR("a.glb", with("/accessors/0/count", 1.5), ": accessor 0: ", "'count' is not a whole number");
  CHECK_ERROR("a.glb", with("/accessors/0/count", -1), ": accessor 0: ", "'count' is not a whole number");
  CHECK_ERROR("a.glb", with("/accessors/0/byteOffset", 18446744073709551600u), ": accessor 0: ", "too short");
  CHECK_ERROR("a.glb", with("/accessors/0/type", "VEC2"), ": accessor 0: ", "not VEC3, as mesh 0, primitive 0 needs");
  CHECK_ERROR("a.glb", with("/accessors/0/componentType", 5124), ": accessor 0: ", "componentType");
  CHECK_ERROR("a.glb", with("/accessors/0/bufferView", 9), ": accessor 0: ", "'bufferViews' has no number 9");
  CHECK_ERROR("a.glb", with("/accessors/0/bufferView", nullptr), ": accessor 0: ", "no bufferView");
  CHECK_ERROR("a.glb", with("/accessors/0/sparse", Json::object()), ": accessor 0: ", "sparse");
  CHECK_ERROR("a.glb", with("/accessors/1/componentType", 5126), ": accessor 1: ", "too short");
  CHECK_ERROR("a.glb", with("/accessors/1/componentType", 5122), ": mesh 0, primitive 0: ", "no whole numbers");
  CHECK_ERROR("a.glb", with("/accessors/1/count", 5), ": mesh 0, primitive 0: ", "5, no multiple of 3");
  CHECK_ERROR("a.glb", with("/accessors/0/count", 3), ": mesh 0, primitive 0: ", "index 3 is outside the 3 vertices");
  CHECK_ERROR("a.glb", with("/bufferViews/0/byteLength", 1000), ": bufferView 0: ", "beyond its buffer of 60 bytes");
  CHECK_ERROR("a.glb", with("/bufferViews/0/byteOffset", 18446744073709551615u), ": bufferView 0: ", "beyond");
  CHECK_ERROR("a.glb", with("/bufferViews/0/byteStride", 4), ": accessor 0: ", "byteStride");
  CHECK_ERROR("a.glb", with("/bufferViews/0/buffer", 1), ": bufferView 0: ", "'buffers' has no number 1");
  CHECK_ERROR("a.glb", with("/bufferViews/0/extensions", {{"EXT_meshopt_compression", {{"buffer", 0}}}}),
              ": bufferView 0: ", "compressed by meshopt is not read");
  CHECK_ERROR("a.glb", with("/meshes/0/primitives/0/mode", 7), ": mesh 0, primitive 0: ", "mode");
  CHECK_ERROR("a.glb", with("/meshes/0/primitives/0/attributes/POSITION", 7),
              ": mesh 0, primitive 0: ", "'accessors' has no number 7");
  CHECK_ERROR("a.glb", with("/nodes/0/mesh", 3), ": node 0: ", "'meshes' has no number 3");
  CHECK_ERROR("a.glb", with("/nodes/0/children", {0}), ": node 0: ", "ancestor");
  CHECK_ERROR("a.glb", with("/nodes/0/children", {4}), ": the scene: ", "'nodes' has no number 4");
  CHECK_ERROR("a.glb", with("/nodes/0/rotation", {0, 0, 0, 0}), ": node 0: ", "'rotation' is null");
  CHECK_ERROR("a.glb", with("/nodes/0/matrix", {1, 2}), ": node 0: ", "16 numbers");
  CHECK_ERROR("a.glb", with("/nodes/0/scale", {1, "2", 3}), ": node 0: ", "3 numbers");
  CHECK_ERROR("a.glb", with("/scene", 5), ": the file: ", "'scenes' has no number 5");
  CHECK_ERROR("a.glb", square("lines").binary(), ": ", "no points");

  Gltf draco = good;
  draco.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0}};
  BOOST_TEST(read("a.glb", draco.binary()).mesh.number_of_faces() == 2); // the same without compression is there
  draco.json["accessors"][0].erase("bufferView");
  CHECK_ERROR("a.glb", draco.binary(), ": mesh 0, primitive 0: ", "compressed by Draco is not read");

  Gltf no_chunk = good; // a buffer that is nowhere
  no_chunk.json["bufferViews"][0]["buffer"] = 0;
  Json text = no_chunk.json;
  text["buffers"] = {{{"byteLength", 60}}};
  CHECK_ERROR("a.gltf", text.dump(), ": buffer 0: ", "not in the file, and has no uri");
}

BOOST_AUTO_TEST_CASE(small_files_do_not_make_large_scans)
{
  // a thousand nodes, each of a mesh of a thousand primitives of the same points
  Gltf gltf = square("triangles");
  const Json primitive = gltf.json["meshes"][0]["primitives"][0];
  for (int i = 0; i < 1000; ++i) gltf.json["meshes"][0]["primitives"].push_back(primitive);
  for (std::size_t i = 1; i <= 1000; ++i) {
    gltf.json["nodes"].push_back({{"mesh", 0}});
    gltf.json["scenes"][0]["nodes"].push_back(i);
  }
  CHECK_ERROR("a.glb", gltf.binary(), ": mesh 0, primitive ", "too many times");
}

BOOST_AUTO_TEST_CASE(damaged_files_are_read_or_refused)
{
  // Any byte changed, any end cut off: no crash, and errors that name the file.
  const Gltf gltf = square("fan");
  for (const bool is_binary : {false, true}) {
    const std::string name = is_binary ? "b.glb" : "b.gltf", good = is_binary ? gltf.binary() : gltf.text();
    for (std::size_t i = 0; i < good.size(); i += 3) {
      error_of(name, good.substr(0, i));
      for (const char c : {'\0', '9', '[', '\xff'}) {
        std::string changed = good;
        changed[i] = c;
        error_of(name, changed);
      }
    }
  }
}
#else
BOOST_AUTO_TEST_CASE(gltf_needs_nlohmann_json)
{
  using namespace generated;
  CHECK_ERROR("a.glb", "glTF", ": ", "only where the program was built with nlohmann-json");
}
#endif
