// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_BENCHMARK_MACHINED_PARTS_H
#define CGAL_CRUDE_REGISTRATION_BENCHMARK_MACHINED_PARTS_H

// Machined parts as a CAD system would export them, of few large triangles: prisms, steps, brackets, flanges and plates
// with holes, with and without symmetry.

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace benchmark_tools {

// A closed line in a plane.
using Loop = std::vector<std::array<double, 2>>;

inline Loop circle(double x, double y, double radius, int corners = 48)
{
  Loop loop;
  for (int i = 0; i < corners; ++i) {
    const double a = 2 * CGAL_PI * (i + 0.5) / corners;
    loop.push_back({x + radius * std::cos(a), y + radius * std::sin(a)});
  }
  return loop;
}

inline Loop rectangle(double x, double y, double width, double height)
{
  return {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
}

// Two half circles, and what is between them.
inline Loop slot(double x, double y, double length, double radius)
{
  constexpr int corners = 24; // of a half circle
  Loop loop;
  for (int i = 0; i <= 2 * corners + 1; ++i) {
    const bool is_left = i > corners;
    const double a = CGAL_PI * ((is_left ? i - 1 : i) / double(corners) - 0.5);
    loop.push_back({x + (is_left ? -0.5 : 0.5) * length + radius * std::cos(a), y + radius * std::sin(a)});
  }
  return loop;
}

inline double signed_area(const Loop& loop)
{
  double area = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const auto &p = loop[i], &q = loop[(i + 1) % loop.size()];
    area += 0.5 * (p[0] * q[1] - q[0] * p[1]);
  }
  return area;
}

inline bool is_inside(const Loop& loop, double x, double y)
{
  bool inside = false;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const auto &p = loop[i], &q = loop[(i + 1) % loop.size()];
    if ((p[1] > y) != (q[1] > y) && x < p[0] + (y - p[1]) / (q[1] - p[1]) * (q[0] - p[0])) inside = !inside;
  }
  return inside;
}

// What is between two parallel planes and the loops, of which the first is the outer one.
struct Extrusion
{
  enum Axis
  {
    Z,
    X,
    Y
  }; // the loops are in the plane of x and y, of y and z, or of z and x
  std::vector<Loop> loops;
  double from, to; // along the axis
  Axis axis = Z;
};

class Machined_part
{
public:
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

  std::string name;
  std::vector<Extrusion> pieces; // that reach into each other

  // Without new corners: triangles as large as the faces.
  static Mesh solid(const Extrusion& piece)
  {
    using Vertex_base = CGAL::Triangulation_vertex_base_with_info_2<std::size_t, Kernel>;
    using Face_base = CGAL::Constrained_triangulation_face_base_2<Kernel>;
    using Triangulation =
        CGAL::Constrained_Delaunay_triangulation_2<Kernel,
                                                   CGAL::Triangulation_data_structure_2<Vertex_base, Face_base>>;
    const auto point = [&](const std::array<double, 2>& p, double height) {
      switch (piece.axis) {
      case Extrusion::X:
        return Kernel::Point_3(height, p[0], p[1]);
      case Extrusion::Y:
        return Kernel::Point_3(p[1], height, p[0]);
      default:
        return Kernel::Point_3(p[0], p[1], height);
      }
    };
    Mesh mesh;
    Triangulation triangulation;
    std::vector<Mesh::Vertex_index> low, high;
    for (std::size_t k = 0; k < piece.loops.size(); ++k) {
      Loop loop = piece.loops[k];
      if ((signed_area(loop) > 0) != (k == 0)) std::reverse(loop.begin(), loop.end());
      std::vector<Triangulation::Vertex_handle> handles;
      for (const auto& p : loop) {
        handles.push_back(triangulation.insert(Kernel::Point_2(p[0], p[1])));
        handles.back()->info() = low.size();
        low.push_back(mesh.add_vertex(point(p, piece.from)));
        high.push_back(mesh.add_vertex(point(p, piece.to)));
      }
      const std::size_t n = loop.size();
      for (std::size_t i = 0; i < n; ++i) {
        triangulation.insert_constraint(handles[i], handles[(i + 1) % n]);
        const std::size_t a = handles[i]->info(), b = handles[(i + 1) % n]->info();
        mesh.add_face(low[a], low[b], high[b]);
        mesh.add_face(low[a], high[b], high[a]);
      }
    }
    for (const auto& face : triangulation.finite_face_handles()) {
      const auto middle = CGAL::centroid(face->vertex(0)->point(), face->vertex(1)->point(), face->vertex(2)->point());
      bool inside = false;
      for (const Loop& loop : piece.loops)
        if (is_inside(loop, middle.x(), middle.y())) inside = !inside;
      if (!inside) continue;
      const std::size_t a = face->vertex(0)->info(), b = face->vertex(1)->info(), c = face->vertex(2)->info();
      mesh.add_face(high[a], high[b], high[c]);
      mesh.add_face(low[a], low[c], low[b]);
    }
    return mesh;
  }

  // All pieces, each with its faces inside the others.
  Mesh assembly() const
  {
    Mesh mesh;
    for (const Extrusion& piece : pieces) CGAL::copy_face_graph(solid(piece), mesh);
    return mesh;
  }
};

// 25 of them, of about one and a half units.
inline std::vector<Machined_part> machined_parts()
{
  using E = Extrusion;
  const auto polygon = [](std::initializer_list<std::array<double, 2>> points) { return Loop(points); };
  const Loop ell = polygon({{0, 0}, {1.3, 0}, {1.3, 0.25}, {0.3, 0.25}, {0.3, 0.9}, {0, 0.9}});
  std::vector<Machined_part> parts;
  const auto add = [&](const char* name, std::vector<Extrusion> pieces) { parts.push_back({name, std::move(pieces)}); };
  // Prisms.
  add("block", {{{rectangle(0, 0, 1.4, 0.9)}, 0, 0.55}});
  add("angle", {{{ell}, 0, 0.7}});
  add("tee", {{{polygon({{-0.7, 0}, {0.7, 0}, {0.7, 0.3}, {0.2, 0.3}, {0.2, 1}, {-0.2, 1}, {-0.2, 0.3}, {-0.7, 0.3}})},
               0,
               0.6}});
  add("channel",
      {{{polygon({{0, 0}, {1.2, 0}, {1.2, 0.8}, {1, 0.8}, {1, 0.25}, {0.2, 0.25}, {0.2, 0.5}, {0, 0.5}})}, 0, 1}});
  add("hexagon", {{{circle(0, 0, 0.6, 6)}, 0, 0.8}});
  add("pentagon", {{{polygon({{0, 0}, {1.2, 0.1}, {1.4, 0.7}, {0.6, 1.1}, {0.1, 0.6}})}, 0, 0.5}});
  add("wedge", {{{polygon({{0, 0}, {1.3, 0}, {0, 0.8}})}, 0, 0.6}});
  add("zed",
      {{{polygon({{0, 0}, {0.8, 0}, {0.8, 0.7}, {1.4, 0.7}, {1.4, 0.9}, {0.6, 0.9}, {0.6, 0.2}, {0, 0.2}})}, 0, 0.6}});
  add("cross", {{{polygon({{-0.2, -0.6},
                           {0.2, -0.6},
                           {0.2, -0.2},
                           {0.6, -0.2},
                           {0.6, 0.2},
                           {0.2, 0.2},
                           {0.2, 0.6},
                           {-0.2, 0.6},
                           {-0.2, 0.2},
                           {-0.6, 0.2},
                           {-0.6, -0.2},
                           {-0.2, -0.2}})},
                 0,
                 0.5}});
  // Steps.
  add("stairs", {{{polygon({{0, 0},
                            {1.4, 0},
                            {1.4, 0.2},
                            {1.05, 0.2},
                            {1.05, 0.45},
                            {0.65, 0.45},
                            {0.65, 0.75},
                            {0.3, 0.75},
                            {0.3, 1},
                            {0, 1}})},
                  0,
                  0.8}});
  add("step in a corner", {{{rectangle(0, 0, 1.4, 1)}, 0, 0.35}, {{rectangle(0, 0, 0.6, 0.45)}, 0.1, 0.8}});
  add("stepped shaft",
      {{{circle(0, 0, 0.5)}, 0, 0.35}, {{circle(0, 0, 0.3)}, 0.1, 0.9}, {{circle(0, 0, 0.2)}, 0.5, 1.4}});
  // Brackets.
  add("bracket", {{{rectangle(0, 0, 1.2, 0.9), circle(0.45, 0.3, 0.1), circle(0.85, 0.6, 0.1)}, 0, 0.12},
                  {{rectangle(0, 0, 0.9, 0.8), circle(0.35, 0.5, 0.14)}, 0, 0.12, E::X}});
  add("bracket with a rib", {{{rectangle(0, 0, 1.2, 0.8), circle(0.9, 0.2, 0.1)}, 0, 0.14},
                             {{rectangle(0, 0, 0.8, 0.9)}, 0, 0.14, E::X},
                             {{polygon({{0.05, 0.05}, {0.7, 0.05}, {0.05, 0.8}})}, 0.5, 0.62, E::Y}});
  add("fork", {{{rectangle(-0.6, -0.4, 1.2, 0.8)}, 0, 0.2},
               {{rectangle(-0.4, 0.05, 0.8, 0.85), circle(0, 0.6, 0.15)}, -0.6, -0.42, E::X},
               {{rectangle(-0.4, 0.05, 0.8, 0.85), circle(0, 0.6, 0.15)}, 0.42, 0.6, E::X}});
  add("corner", {{{rectangle(0, 0, 1.2, 0.9), circle(0.8, 0.5, 0.12)}, 0, 0.1},
                 {{rectangle(0, 0, 0.9, 0.7)}, 0, 0.1, E::X},
                 {{rectangle(0, 0, 0.7, 1.2), circle(0.4, 0.4, 0.1)}, 0, 0.1, E::Y}});
  // Flanges.
  const auto holes = [](Loop outline, int number, double on, double radius, double other) {
    std::vector<Loop> loops = {std::move(outline)};
    for (int i = 0; i < number; ++i) {
      const double a = 2 * CGAL_PI * i / number;
      loops.push_back(circle(on * std::cos(a), on * std::sin(a), i == 0 ? other : radius));
    }
    return loops;
  };
  const Loop flat = polygon({{-0.3, -0.3}, {0.3, -0.3}, {0.3, 0.3}, {-0.1, 0.3}, {-0.3, 0.1}});
  const auto bored = [](std::vector<Loop> loops, double radius) {
    loops.push_back(circle(0, 0, radius));
    return loops;
  };
  add("flange of four holes", {{bored(holes(circle(0, 0, 0.7), 4, 0.52, 0.09, 0.09), 0.2), 0, 0.15},
                               {bored({circle(0, 0, 0.35)}, 0.2), 0, 0.5}});
  add("flange with a flat hub", {{holes(circle(0, 0, 0.7), 6, 0.55, 0.07, 0.07), 0, 0.15}, {{flat}, 0.05, 0.6}});
  add("square flange", {{bored(holes(rectangle(-0.6, -0.6, 1.2, 1.2), 4, 0.48, 0.08, 0.08), 0.2), 0, 0.15},
                        {bored({circle(0, 0, 0.32)}, 0.2), 0, 0.45}});
  add("oval flange", {{bored({slot(0, 0, 0.8, 0.35), circle(0.48, 0, 0.1), circle(-0.48, 0, 0.1)}, 0.15), 0, 0.18},
                      {bored({circle(0, 0, 0.25)}, 0.15), 0, 0.45}});
  add("flange with an odd hole",
      {{holes(circle(0, 0, 0.75), 5, 0.5, 0.08, 0.16), 0, 0.15}, {{circle(0, 0, 0.3)}, 0.05, 0.5}});
  // Plates.
  add("plate of three holes",
      {{{rectangle(0, 0, 1.4, 0.9), circle(0.3, 0.3, 0.12), circle(0.7, 0.6, 0.18), circle(1.15, 0.25, 0.1)}, 0, 0.2}});
  add("plate of four holes", {{{rectangle(-0.7, -0.45, 1.4, 0.9), circle(0.5, 0.3, 0.1), circle(-0.5, 0.3, 0.1),
                                circle(0.5, -0.3, 0.1), circle(-0.5, -0.3, 0.1)},
                               0,
                               0.2}});
  add("plate with a slot", {{{polygon({{0, 0}, {1.4, 0}, {1.4, 0.6}, {1.1, 0.9}, {0, 0.9}}), slot(0.5, 0.6, 0.4, 0.1),
                              circle(1.1, 0.35, 0.15)},
                             0,
                             0.25}});
  add("base with bosses", {{{rectangle(0, 0, 1.4, 1), circle(1.1, 0.75, 0.12)}, 0, 0.2},
                           {{circle(0.3, 0.3, 0.18)}, 0.1, 0.7},
                           {{circle(0.9, 0.3, 0.14)}, 0.1, 0.45},
                           {{rectangle(0.15, 0.65, 0.4, 0.2)}, 0.1, 0.55}});
  return parts;
}

} // namespace benchmark_tools

#endif // CGAL_CRUDE_REGISTRATION_BENCHMARK_MACHINED_PARTS_H
