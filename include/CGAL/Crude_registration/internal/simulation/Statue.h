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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_SIMULATION_STATUE_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_SIMULATION_STATUE_H

// The body of the simulation, as an implicit surface.

#include <CGAL/Crude_registration/internal/base/Counter_random.h>
#include <CGAL/Crude_registration/internal/simulation/marching_tetrahedra.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// An implicit body: a blend of tapered bones (torso, head, horns, limbs, one limb that returns to the body as a handle,
// bumps), hollows carved out of it, and a relief of two wavelengths all over. A bone contributes (1 - d^2/r^2)^3 at
// distance d of its axis, which has compact support and needs no transcendental function: the same bits everywhere.
class Statue
{
  struct Bone
  {
    Vector from, to;
    double radius_from, radius_to;
    double weight;
  };

  static constexpr double iso_value = 0.2;
  static constexpr double relief_wavelengths[2] = {0.31, 0.11};
  static constexpr double relief_amplitudes[2] = {0.13, 0.06}; // their sum is less than iso_value: no islands

  std::vector<Bone> m_bones;
  Counter_random m_relief;

  // Gradient noise on a lattice of unit cubes (Perlin, SIGGRAPH 2002), in about [-1, 1].
  static double gradient_noise(const Counter_random& random, const Vector& p)
  {
    std::array<std::int64_t, 3> cell;
    Vector f;
    std::array<double, 3> s;
    for (int i = 0; i < 3; ++i) {
      const double floor = std::floor(p[i]), x = p[i] - floor;
      cell[static_cast<std::size_t>(i)] = static_cast<std::int64_t>(floor);
      f[i] = x;
      s[static_cast<std::size_t>(i)] = x * x * x * (x * (6 * x - 15) + 10);
    }
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
      double weight = 1;
      std::uint64_t key = 0;
      Vector d;
      for (int i = 0; i < 3; ++i) {
        const int bit = corner >> i & 1;
        const double si = s[static_cast<std::size_t>(i)];
        weight *= bit ? si : 1 - si;
        d[i] = f[i] - bit;
        key = key * 2097152 + static_cast<std::uint64_t>(cell[static_cast<std::size_t>(i)] + bit + 1048576);
      }
      const Counter_random gradient = random.stream(key);
      for (int i = 0; i < 3; ++i) sum += weight * d[i] * (2 * gradient.uniform(static_cast<std::uint64_t>(i)) - 1);
    }
    return 1.5 * sum;
  }

public:
  explicit Statue(std::uint64_t seed) : m_relief(Counter_random(seed).stream(1))
  {
    // The numbers are drawn one after the other: no two in one expression, whose order is the compiler's.
    const Counter_random random = Counter_random(seed).stream(0);
    std::uint64_t counter = 0;
    auto between = [&](double a, double b) { return a + (b - a) * random.uniform(counter++); };
    auto direction = [&]() -> Vector {
      for (;;) {
        Vector v;
        for (int i = 0; i < 3; ++i) v[i] = between(-1, 1);
        const double n = v.squaredNorm();
        if (n <= 1 && n > 0.01) return v / std::sqrt(n);
      }
    };
    auto add = [&](const Vector& from, const Vector& to, double radius_from, double radius_to, double weight = 1) {
      m_bones.push_back({from, to, radius_from, radius_to, weight});
    };

    // Torso and head, upwards along z with some wander, and thinner towards the head.
    std::array<Vector, 4> spine;
    std::array<double, 4> girth;
    for (std::size_t i = 0; i < 4; ++i) {
      spine[i].z() = -0.55 + 0.32 * static_cast<double>(i);
      spine[i].y() = between(-0.13, 0.13);
      spine[i].x() = between(-0.13, 0.13);
      girth[i] = between(0.42, 0.5) - 0.05 * static_cast<double>(i);
      if (i > 0) add(spine[i - 1], spine[i], girth[i - 1], girth[i]);
    }
    Vector lean = direction();
    lean.z() = 0;
    const Vector head = spine[3] + Vector(0, 0, 0.22) + 0.2 * lean;
    add(spine[3], head, girth[3] * 0.7, between(0.28, 0.34));
    auto on_torso = [&](double low, double high) -> Vector {
      const double t = between(low, high) * 3;
      const std::size_t i = (std::min)(static_cast<std::size_t>(t), std::size_t(2));
      return spine[i] + (t - static_cast<double>(i)) * (spine[i + 1] - spine[i]);
    };

    auto beside_torso = [&](double low, double high) -> Vector {
      const Vector out = direction();
      const double distance = between(low, high);
      return on_torso(0, 1) + distance * out;
    };

    // Horns: three bones, each turned away from the one before.
    for (int horn = 0; horn < 3; ++horn) {
      Vector p = head, along = direction();
      along.z() = 0.5 * std::abs(along.z()) + 0.2;
      double radius = between(0.15, 0.2);
      for (int i = 0; i < 3; ++i) {
        const Vector q = p + between(0.13, 0.22) * along.normalized();
        add(p, q, radius, radius * 0.75);
        radius *= 0.75;
        p = q;
        along = along.normalized() + 0.7 * direction();
      }
    }
    // Limbs with an elbow; the last one returns to the torso.
    for (int limb = 0; limb < 5; ++limb) {
      const Vector shoulder = on_torso(0.2 * limb, 0.2 * limb + 0.2);
      Vector out = direction();
      out.z() *= 0.4;
      const Vector elbow = shoulder + between(0.45, 0.55) * out.normalized();
      const double radius = between(0.17, 0.24);
      add(shoulder, elbow, radius * 1.2, radius);
      if (limb < 4) {
        const Vector along = (out + 1.2 * direction()).normalized();
        add(elbow, elbow + between(0.2, 0.4) * along, radius, radius * 0.6);
      } else add(elbow, on_torso(0, 0.3), radius, radius);
    }
    // Bumps and hollows.
    for (int bump = 0; bump < 7; ++bump) {
      const Vector p = beside_torso(0.22, 0.3);
      const double radius = between(0.12, 0.22);
      add(p, p, radius, radius, 0.8);
    }
    for (int hollow = 0; hollow < 5; ++hollow) {
      const Vector p = beside_torso(0.3, 0.4);
      const double radius = between(0.18, 0.28);
      add(p, p, radius, radius, -1.2);
    }
  }

  // Positive inside.
  double operator()(const Vector& p) const
  {
    double sum = -iso_value;
    for (const Bone& bone : m_bones) {
      const Vector axis = bone.to - bone.from;
      const double length = axis.squaredNorm();
      const double t = length > 0 ? std::clamp(axis.dot(p - bone.from) / length, 0., 1.) : 0.;
      const double radius = bone.radius_from + t * (bone.radius_to - bone.radius_from);
      const double k = 1 - (p - bone.from - t * axis).squaredNorm() / (radius * radius);
      if (k > 0) sum += bone.weight * k * k * k;
    }
    if (std::abs(sum) < 2 * iso_value) // farther from the surface the relief cannot change the sign
      for (std::uint64_t i = 0; i < 2; ++i)
        sum += relief_amplitudes[i] * gradient_noise(m_relief.stream(i), p / relief_wavelengths[i]);
    return sum;
  }

  // The body's surface, with `resolution` lattice cubes along its longest side.
  Flat_mesh surface(int resolution) const
  {
    Vector low = m_bones.front().from, high = low;
    for (const Bone& bone : m_bones) {
      if (bone.weight < 0) continue;
      for (const auto& [p, r] : {std::pair(bone.from, bone.radius_from), std::pair(bone.to, bone.radius_to)}) {
        low = low.cwiseMin(p - Vector::Constant(r));
        high = high.cwiseMax(p + Vector::Constant(r));
      }
    }
    const Vector extent = high - low;
    const double size = extent.maxCoeff() / resolution;
    std::array<int, 3> cubes;
    for (int i = 0; i < 3; ++i) cubes[static_cast<std::size_t>(i)] = static_cast<int>(std::ceil(extent[i] / size)) + 1;
    return largest_component(marching_tetrahedra(*this, low - Vector::Constant(size / 2), size, cubes));
  }
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_SIMULATION_STATUE_H
