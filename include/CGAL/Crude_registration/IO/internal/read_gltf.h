// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Author(s)     : The Crude_registration authors

#ifndef CGAL_CRUDE_REGISTRATION_IO_INTERNAL_READ_GLTF_H
#define CGAL_CRUDE_REGISTRATION_IO_INTERNAL_READ_GLTF_H

// Reads the triangles or the points of glTF files.

#include <CGAL/Crude_registration/IO/IO_error.h>
#include <CGAL/Crude_registration/IO/internal/polygon_soup_readers.h>

#ifdef CGAL_CRUDE_REGISTRATION_USE_JSON
#include <CGAL/Crude_registration/IO/internal/Gltf_file.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Vertices that are equal become the first of them.
inline void weld(Polygon_soup& soup)
{
  std::vector<std::size_t> order(soup.points.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  order.erase(std::remove_if(order.begin(), order.end(),
                             [&](std::size_t v) { // NaN has no place in an order
                               const auto& p = soup.points[v];
                               return std::any_of(p.begin(), p.end(), [](double c) { return std::isnan(c); });
                             }),
              order.end());
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t v, std::size_t w) { return soup.points[v] < soup.points[w]; });
  std::vector<std::size_t> first(soup.points.size());
  std::iota(first.begin(), first.end(), std::size_t(0));
  for (std::size_t i = 1; i < order.size(); ++i)
    if (soup.points[order[i]] == soup.points[order[i - 1]]) first[order[i]] = first[order[i - 1]];
  for (auto& polygon : soup.polygons)
    for (std::size_t& v : polygon) v = first[v];
}

#ifdef CGAL_CRUDE_REGISTRATION_USE_JSON

// What the nodes of the scene place: triangles, which go before points. A vertex that stands several times, as it does
// where normals or the coordinates of a texture differ, is one.
class Gltf_reader
{
public:
  Gltf_reader(std::string_view data, const std::string& file) : m_file(data, file) {}

  Polygon_soup read()
  {
    place_nodes();
    if (!m_has_normals) m_soup.normals.clear();
    if (!m_has_colors) m_soup.colors.clear();
    if (!m_soup.polygons.empty()) {
      m_soup.normals.clear();
      weld(m_soup);
    }
    return std::move(m_soup);
  }

private:
  using Json = Gltf_file::Json;
  using Map = Eigen::Affine3d;

  // The roots of the scene that is shown; without scenes, the nodes that are no children; without nodes, all meshes.
  void place_nodes()
  {
    const Json &nodes = Gltf_file::member(m_file.root(), "nodes"), &scenes = Gltf_file::member(m_file.root(), "scenes");
    if (!nodes.is_array() || nodes.empty()) {
      const Json& meshes = Gltf_file::member(m_file.root(), "meshes");
      for (std::size_t i = 0; meshes.is_array() && i < meshes.size(); ++i) place_mesh(i, Map::Identity(), "the file");
      return;
    }
    std::vector<std::size_t> roots;
    if (scenes.is_array() && !scenes.empty()) {
      const std::size_t scene = m_file.whole(m_file.root(), "scene", "the file").value_or(0);
      const std::string where = "scene " + std::to_string(scene);
      roots = list_of(Gltf_file::member(m_file.element("scenes", scene, "the file"), "nodes"), "nodes", where);
    } else {
      std::vector<bool> is_child(nodes.size(), false);
      for (std::size_t i = 0; i < nodes.size(); ++i)
        for (const std::size_t child : children_of(i))
          if (child < nodes.size()) is_child[child] = true;
      for (std::size_t i = 0; i < nodes.size(); ++i)
        if (!is_child[i]) roots.push_back(i);
    }
    place_trees(roots, nodes.size());
  }

  // The nodes are trees: none is met twice.
  void place_trees(const std::vector<std::size_t>& roots, std::size_t number_of_nodes)
  {
    std::vector<bool> was_met(number_of_nodes, false);
    std::vector<std::pair<std::size_t, Map>> open; // the next one last
    for (auto root = roots.rbegin(); root != roots.rend(); ++root) open.emplace_back(*root, Map::Identity());
    while (!open.empty()) {
      const auto [i, parent] = open.back();
      open.pop_back();
      const Json& node = m_file.element("nodes", i, "the scene");
      const std::string where = "node " + std::to_string(i);
      if (was_met[i]) m_file.fail(where, "it has two parents, or is its own ancestor");
      was_met[i] = true;
      const Map map = parent * map_of(node, where);
      if (const auto mesh = m_file.whole(node, "mesh", where)) place_mesh(*mesh, map, where);
      const std::vector<std::size_t> children = children_of(i);
      for (auto child = children.rbegin(); child != children.rend(); ++child) open.emplace_back(*child, map);
    }
  }

  std::vector<std::size_t> children_of(std::size_t i) const
  {
    return list_of(Gltf_file::member(m_file.element("nodes", i, "the scene"), "children"), "children",
                   "node " + std::to_string(i));
  }

  std::vector<std::size_t> list_of(const Json& list, const char* key, const std::string& where) const
  {
    std::vector<std::size_t> numbers;
    if (list.is_array())
      for (const Json& number : list) numbers.push_back(m_file.to_whole(number, key, where));
    return numbers;
  }

  template <std::size_t N>
  bool read_numbers(const Json& object, const char* key, std::array<double, N>& numbers, const std::string& where) const
  {
    const Json& list = Gltf_file::member(object, key);
    if (list.is_null()) return false;
    if (!list.is_array() || list.size() != N ||
        !std::all_of(list.begin(), list.end(), [](const Json& n) { return n.is_number(); }))
      m_file.fail(where, "'" + std::string(key) + "' is not a list of " + std::to_string(N) + " numbers");
    for (std::size_t k = 0; k < N; ++k) numbers[k] = list[k].get<double>();
    return true;
  }

  // A matrix, column by column, or a scaling, a turn by a quaternion (x, y, z, w) and a shift, in this order.
  Map map_of(const Json& node, const std::string& where) const
  {
    Map map = Map::Identity();
    std::array<double, 16> m{};
    if (read_numbers(node, "matrix", m, where)) {
      for (std::size_t column = 0; column < 4; ++column)
        for (std::size_t row = 0; row < 3; ++row) map(Eigen::Index(row), Eigen::Index(column)) = m[4 * column + row];
      return map;
    }
    std::array<double, 3> shift = {0, 0, 0}, factors = {1, 1, 1};
    std::array<double, 4> q = {0, 0, 0, 1};
    read_numbers(node, "translation", shift, where);
    read_numbers(node, "rotation", q, where);
    read_numbers(node, "scale", factors, where);
    const Eigen::Quaterniond turn(q[3], q[0], q[1], q[2]);
    if (!(turn.norm() > 0)) m_file.fail(where, "'rotation' is null");
    map.linear() =
        turn.normalized().toRotationMatrix() * Eigen::Vector3d(factors[0], factors[1], factors[2]).asDiagonal();
    map.translation() = Eigen::Vector3d(shift[0], shift[1], shift[2]);
    return map;
  }

  void place_mesh(std::size_t i, const Map& map, const std::string& user)
  {
    const Json& primitives = Gltf_file::member(m_file.element("meshes", i, user), "primitives");
    for (std::size_t k = 0; primitives.is_array() && k < primitives.size(); ++k)
      place_primitive(primitives[k], map, "mesh " + std::to_string(i) + ", primitive " + std::to_string(k));
  }

  // One without positions, or of lines, is passed over.
  void place_primitive(const Json& primitive, const Map& map, const std::string& where)
  {
    enum Mode : std::size_t
    {
      POINTS = 0,
      TRIANGLES = 4,
      STRIP = 5,
      FAN = 6
    };
    const std::size_t mode = m_file.whole(primitive, "mode", where).value_or(TRIANGLES);
    const Json& attributes = Gltf_file::member(primitive, "attributes");
    const auto positions = m_file.whole(attributes, "POSITION", where),
               normals = m_file.whole(attributes, "NORMAL", where), colors = m_file.whole(attributes, "COLOR_0", where),
               indices = m_file.whole(primitive, "indices", where);
    if (mode > FAN) m_file.fail(where, "its mode is not known: " + std::to_string(mode));
    if (!positions || (mode != POINTS && mode < TRIANGLES)) return;
    if (!Gltf_file::member(Gltf_file::member(primitive, "extensions"), "KHR_draco_mesh_compression").is_null() &&
        Gltf_file::member(m_file.element("accessors", *positions, where), "bufferView").is_null())
      m_file.fail(where, "what is compressed by Draco is not read: save the file without compression");

    const Gltf_numbers points = m_file.numbers(*positions, "VEC3", where);
    const std::size_t before = m_soup.points.size();
    allow(points.count, where);
    for (std::size_t v = 0; v < points.count; ++v) {
      const Eigen::Vector3d p = map * Eigen::Vector3d(points.at(v, 0), points.at(v, 1), points.at(v, 2));
      m_soup.points.push_back({p.x(), p.y(), p.z()});
    }
    m_soup.normals.resize(m_soup.points.size(), {0, 0, 0});
    m_soup.colors.resize(m_soup.points.size(), {255, 255, 255}); // what is not said is white
    if (colors) place_colors(m_file.numbers(*colors, "VEC3 VEC4", where), before, where);
    if (normals) place_normals(m_file.numbers(*normals, "VEC3", where), before, map, where);

    std::vector<std::size_t> corners(points.count);
    if (indices) corners = indices_of(*indices, points.count, where);
    else std::iota(corners.begin(), corners.end(), std::size_t(0));
    if (mode == POINTS) return;
    const std::size_t n = corners.size();
    if (mode == TRIANGLES && n % 3 != 0)
      m_file.fail(where, "the corners of its triangles are " + std::to_string(n) + ", no multiple of 3");
    allow(mode == TRIANGLES ? n : 3 * n, where);
    // A mirror image shows its triangles from the other side (section 3.7.2.1 of the specification).
    const bool is_mirrored = map.linear().determinant() < 0;
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
      if (is_mirrored) std::swap(b, c);
      m_soup.polygons.push_back({before + corners[a], before + corners[b], before + corners[c]});
    };
    for (std::size_t t = 0; t + 2 < n; t += mode == TRIANGLES ? 3 : 1)
      if (mode == TRIANGLES) add(t, t + 1, t + 2);
      else if (mode == FAN) add(t + 1, t + 2, 0);
      else add(t, t + 1 + t % 2, t + 2 - t % 2);
  }

  void place_normals(const Gltf_numbers& normals, std::size_t before, const Map& map, const std::string& where)
  {
    if (normals.count != m_soup.points.size() - before) m_file.fail(where, "it has not as many normals as positions");
    const Eigen::Matrix3d m = map.linear();
    Eigen::Matrix3d cofactors; // of the matrix; the inverse of its transpose, up to a factor
    for (int k = 0; k < 3; ++k) cofactors.col(k) = m.col((k + 1) % 3).cross(m.col((k + 2) % 3));
    if (m.determinant() < 0) cofactors = -cofactors;
    for (std::size_t v = 0; v < normals.count; ++v) {
      const Eigen::Vector3d n = cofactors * Eigen::Vector3d(normals.at(v, 0), normals.at(v, 1), normals.at(v, 2));
      m_soup.normals[before + v] = {n.x(), n.y(), n.z()};
    }
    m_has_normals = true;
  }

  // Whole numbers are shares of the largest, said or not.
  void place_colors(Gltf_numbers colors, std::size_t before, const std::string& where)
  {
    if (colors.count != m_soup.points.size() - before) m_file.fail(where, "it has not as many colours as positions");
    colors.normalized = !colors.is_float();
    for (std::size_t v = 0; v < colors.count; ++v)
      m_soup.colors[before + v] = {part_of_color(colors.at(v, 0), 1), part_of_color(colors.at(v, 1), 1),
                                   part_of_color(colors.at(v, 2), 1)};
    m_has_colors = true;
  }

  std::vector<std::size_t> indices_of(std::size_t accessor, std::size_t vertices, const std::string& where)
  {
    const Gltf_numbers numbers = m_file.numbers(accessor, "SCALAR", where);
    if (!numbers.is_unsigned() || numbers.normalized) m_file.fail(where, "its indices are no whole numbers");
    allow(numbers.count, where);
    std::vector<std::size_t> indices;
    indices.reserve(numbers.count);
    for (std::size_t i = 0; i < numbers.count; ++i) {
      const std::size_t v = static_cast<std::size_t>(numbers.at(i, 0));
      if (v >= vertices)
        m_file.fail(where,
                    "the index " + std::to_string(v) + " is outside the " + std::to_string(vertices) + " vertices");
      indices.push_back(v);
    }
    return indices;
  }

  // Nodes may place a mesh many times: as much as gzip unpacks of a file (see unpack_gzip()), no more.
  void allow(std::size_t numbers, const std::string& where)
  {
    constexpr std::size_t growth = 1032, bytes_of_each = 32; // about
    m_numbers += numbers;
    if (m_numbers / growth > m_file.bytes_read() / bytes_of_each)
      m_file.fail(where, "the nodes place the meshes of the file too many times");
  }

  Gltf_file m_file;
  Polygon_soup m_soup;
  bool m_has_normals = false, m_has_colors = false;
  std::size_t m_numbers = 0; // vertices and corners so far
};

#endif

inline Polygon_soup read_gltf([[maybe_unused]] std::string_view data, const std::string& file)
{
#ifdef CGAL_CRUDE_REGISTRATION_USE_JSON
  return Gltf_reader(data, file).read();
#else
  throw IO_error(file, "glTF is read only where the program was built with nlohmann-json");
#endif
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_INTERNAL_READ_GLTF_H
