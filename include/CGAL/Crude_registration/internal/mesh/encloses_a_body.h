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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_MESH_ENCLOSES_A_BODY_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_MESH_ENCLOSES_A_BODY_H

// Whether a mesh is the whole surface of a body, as a CAD model is and a view is not.

#include <CGAL/Crude_registration/internal/base/Run_control.h>
#include <CGAL/Crude_registration/internal/mesh/Flat_mesh.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Of the lines along z through the centres of a grid's cells over the mesh, in a frame: how many meet it, and how many
// of these go into it through another number of faces than they come out through.
struct Met_lines
{
  std::size_t number = 0, unbalanced = 0;
};

inline Met_lines lines_through(const Flat_mesh& mesh, const Matrix& frame, Run_control& control)
{
  constexpr int side = 64; // of the grid: 4096 lines tell of holes of a thousandth of what is seen of the body
  using Place = Eigen::Vector2d;
  std::vector<Place> places;
  places.reserve(mesh.points.size());
  Place low = Place::Constant(HUGE_VAL), high = -low;
  for (const auto& f : mesh.faces)
    for (const std::int32_t v : f) {
      const Place p = (frame * mesh.points[std::size_t(v)]).head<2>();
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  const double cell = (high - low).maxCoeff() / side;
  if (!(cell > 0)) return {};
  // In cells, centres at whole numbers.
  for (const Vector& p : mesh.points) places.push_back(((frame * p).head<2>() - low) / cell - Place::Constant(0.5));
  // Whether q is left of the line from a to b: the same of the line from b to a is the contrary, to the last bit, so
  // that a line between two faces meets one of them.
  const auto is_left = [](const Place& a, const Place& b, const Place& q) {
    const auto area = [&q](const Place& from, const Place& to) {
      return (to[0] - from[0]) * (q[1] - from[1]) - (to[1] - from[1]) * (q[0] - from[0]);
    };
    const bool is_forward = a[0] != b[0] ? a[0] < b[0] : a[1] < b[1];
    return is_forward ? area(a, b) > 0 : !(area(b, a) > 0);
  };
  std::vector<std::int32_t> balance(std::size_t(side) * side, 0);
  std::vector<std::uint8_t> is_met(balance.size(), 0);
  std::size_t faces = 0;
  for (const auto& f : mesh.faces) {
    control.check(faces++);
    const Place &a = places[std::size_t(f[0])], &b = places[std::size_t(f[1])], &c = places[std::size_t(f[2])];
    const auto first = [&](int k) { return (std::max)(0, int(std::ceil((std::min)({a[k], b[k], c[k]})))); };
    const auto last = [&](int k) { return (std::min)(side - 1, int(std::floor((std::max)({a[k], b[k], c[k]})))); };
    const int from_x = first(0), to_x = last(0), from_y = first(1), to_y = last(1);
    for (int x = from_x; x <= to_x; ++x)
      for (int y = from_y; y <= to_y; ++y) {
        const Place q(x, y);
        const bool ab = is_left(a, b, q), bc = is_left(b, c, q), ca = is_left(c, a, q);
        if (ab != bc || bc != ca) continue;
        const std::size_t line = std::size_t(x) * side + std::size_t(y);
        balance[line] += ab ? 1 : -1;
        is_met[line] = 1;
      }
  }
  Met_lines lines;
  for (std::size_t i = 0; i < balance.size(); ++i) {
    lines.number += is_met[i];
    lines.unbalanced += std::size_t(balance[i] != 0);
  }
  return lines;
}

// Whether the faces enclose a body: along hardly any line one goes in more often than one comes out, whatever corners
// the faces have in common, and however often the surface crosses itself. `own`: axes that turn with the mesh; lines
// are oblique to them, as what is open at its ends is seen to be open along none that is square to its axis.
inline bool encloses_a_body(const Flat_mesh& mesh, const Matrix& own, Run_control& control = to_the_end())
{
  // Decided: a hundredth of the lines. What is scanned and fused has holes where no sensor looked, which are larger.
  constexpr double most = 0.01;
  const Matrix oblique = (Matrix() << 0.36, 0.48, -0.8, -0.8, 0.6, 0, 0.48, 0.64, 0.6).finished();
  const Matrix turn = (Matrix() << 0, 1, 0, 0, 0, 1, 1, 0, 0).finished();
  Matrix frame = oblique * own;
  for (int i = 0; i < 3; ++i, frame = oblique * turn * (oblique.transpose() * frame)) {
    const Met_lines lines = lines_through(mesh, frame, control);
    if (lines.number == 0 || double(lines.unbalanced) > most * double(lines.number)) return false;
  }
  return true;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_MESH_ENCLOSES_A_BODY_H
