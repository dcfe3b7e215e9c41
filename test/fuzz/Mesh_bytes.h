// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_FUZZ_MESH_BYTES_H
#define CGAL_CRUDE_REGISTRATION_FUZZ_MESH_BYTES_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

// Two small meshes as bytes: the exponent of the unit, then for each mesh the number of vertices and of faces (at most
// 255), three bytes a vertex, three a face, each taken modulo what is possible.
struct Byte_mesh
{
  std::vector<std::array<std::int8_t, 3>> points;
  std::vector<std::array<std::uint8_t, 3>> faces;
};

class Byte_reader
{
public:
  Byte_reader(const std::uint8_t* data, std::size_t size) : m_data(data), m_end(data + size) {}

  std::uint8_t next() { return m_data == m_end ? std::uint8_t(0) : *m_data++; } // 0 where there are no more

  Byte_mesh mesh()
  {
    Byte_mesh mesh;
    const std::size_t points = next(), faces = next();
    for (std::size_t i = 0; i < points; ++i) {
      mesh.points.emplace_back();
      for (std::int8_t& x : mesh.points.back()) x = std::int8_t(next());
    }
    for (std::size_t i = 0; i < faces && points > 0; ++i) {
      mesh.faces.emplace_back();
      for (std::uint8_t& v : mesh.faces.back()) v = std::uint8_t(next() % points);
    }
    return mesh;
  }

private:
  const std::uint8_t* m_data;
  const std::uint8_t* m_end;
};

inline void append(const Byte_mesh& mesh, std::vector<std::uint8_t>& bytes)
{
  bytes.push_back(std::uint8_t(mesh.points.size()));
  bytes.push_back(std::uint8_t(mesh.faces.size()));
  for (const auto& p : mesh.points)
    for (const std::int8_t x : p) bytes.push_back(std::uint8_t(x));
  for (const auto& f : mesh.faces) bytes.insert(bytes.end(), f.begin(), f.end());
}

#endif // CGAL_CRUDE_REGISTRATION_FUZZ_MESH_BYTES_H
