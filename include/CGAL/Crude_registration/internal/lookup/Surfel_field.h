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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_LOOKUP_SURFEL_FIELD_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_LOOKUP_SURFEL_FIELD_H

// The nearest surfel to any place, by one look-up.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/internal/base/Rows.h>

#include <boost/config.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// A small piece of surface: the mean of the samples in one cell, with their mean normal and the principal curvatures of
// the neighbourhood times the spacing of the surfels, so that they have no unit.
struct Surfel
{
  Vector_f position;
  Vector_f normal;
  float minimal_curvature = 0;
  float maximal_curvature = 0;
  float variance = 0; // of the place along the normal, as the surface bends within the surfel
};

// Whether a place is within `distance` of the plane of a surfel, and a normal is near that one's. Without a branch:
// which of the two fails cannot be foretold.
inline bool is_like(const Surfel& surfel, const Vector_f& place, const Vector_f& normal, float distance,
                    float minimal_cosine)
{
  return (int(std::abs(surfel.normal.dot(place - surfel.position)) <= distance) &
          int(normal.dot(surfel.normal) >= minimal_cosine)) != 0;
}

// The nearest surfel to any place near the surface, by one look-up: voxels in blocks of 4 x 4 x 4, of which only those
// near the surface exist. Memory is linear in the number of surfels.
class Surfel_field
{
public:
  static constexpr int none = -1;
  static constexpr std::size_t maximum_size = 65535; // indices are stored in 16 bits

  Surfel_field() = default;

  // Every voxel of edge length `voxel` whose centre is within `reach` of a surfel knows the surfel nearest to its
  // centre, the first of equally near ones.
  Surfel_field(const std::vector<Surfel>& surfels, float voxel, float reach) : m_scale(1 / voxel)
  {
    if (surfels.empty()) return;
    Vector_f low = surfels.front().position, high = low;
    for (const Surfel& s : surfels) {
      low = low.cwiseMin(s.position);
      high = high.cwiseMax(s.position);
    }
    const float margin = reach + voxel;
    for (int i = 0; i < 3; ++i) {
      // What is more than maximum_blocks wide (a spike) is represented around the median.
      const float limit = 0.5f * float(maximum_blocks) * 4 * voxel;
      float middle = 0.5f * (low[i] + high[i]);
      if (high[i] - low[i] + 2 * margin > 2 * limit) middle = median(surfels, i);
      m_low[i] = (std::max)(low[i] - margin, middle - limit);
      const float top = (std::min)(high[i] + margin, middle + limit);
      m_blocks[std::size_t(i)] = (std::min)(maximum_blocks, int((top - m_low[i]) * m_scale * 0.25f) + 1);
      m_size[i] = float(4 * m_blocks[std::size_t(i)]);
    }
    m_block_of.assign(std::size_t(m_blocks[0]) * std::size_t(m_blocks[1]) * std::size_t(m_blocks[2]), 0);
    const float reach_in_voxels = reach * m_scale, reach2 = reach_in_voxels * reach_in_voxels;
    Nearest out_of_reach;
    std::fill_n(out_of_reach.distances, 64, bits_of(reach2) + 1);
    std::fill_n(out_of_reach.surfels, 64, std::int32_t(empty));
    std::vector<Nearest> blocks(1, out_of_reach);
    std::vector<std::array<float, 4>> z_distances; // squared, of the voxels of each block that is met
    for (std::size_t i = 0; i < surfels.size(); ++i) {
      const auto surfel = std::int32_t(i);
      const Vector_f p = (surfels[i].position - m_low) * m_scale;
      if (!((p.array() >= 0).all() && (p.array() < m_size.array()).all())) continue; // far away, or not a number
      int from[3], to[3];
      for (int k = 0; k < 3; ++k) {
        from[k] = (std::max)(1, int(std::ceil(p[k] - reach_in_voxels - 0.5f))); // the outermost ones stay empty
        to[k] = (std::min)(int(m_size[k]) - 2, int(std::floor(p[k] + reach_in_voxels - 0.5f)));
      }
      // The voxels of a block follow each other along z: four at a time, without a branch.
      from[2] &= ~3;
      z_distances.clear();
      for (int z = from[2]; z <= to[2]; z += 4) {
        std::array<float, 4> dz;
        for (int k = 0; k < 4; ++k) dz[std::size_t(k)] = float(z + k) + 0.5f - p[2];
        for (float& d : dz) d *= d;
        z_distances.push_back(dz);
      }
      for (int x = from[0]; x <= to[0]; ++x) {
        const float dx = float(x) + 0.5f - p[0];
        for (int y = from[1]; y <= to[1]; ++y) {
          const float dy = float(y) + 0.5f - p[1], dxy = dx * dx + dy * dy;
          if (dxy > reach2) continue;
          std::int32_t* block = m_block_of.data() + block_index(x, y, from[2]);
          const std::size_t first = voxel_index(x, y, 0);
          for (const std::array<float, 4>& dz : z_distances) {
            std::int32_t& here = *block++;
            if (dxy + (std::min)((std::min)(dz[0], dz[1]), (std::min)(dz[2], dz[3])) > reach2) continue;
            if (here == 0) {
              here = std::int32_t(blocks.size());
              blocks.push_back(out_of_reach);
            }
            blocks[std::size_t(here)].offer(surfel, first, dxy, dz);
          }
        }
      }
    }
    m_voxels.clear();
    m_voxels.reserve(64 * blocks.size());
    for (const Nearest& b : blocks)
      std::transform(b.surfels, b.surfels + 64, std::back_inserter(m_voxels),
                     [](std::int32_t i) { return std::uint16_t(i); });
  }

  // The index of the surfel nearest to the centre of the voxel of `p`, or `none`. Without a branch: which voxels are
  // empty cannot be foretold, and a wrong guess costs more than the look-up. What is outside, and what is not a number,
  // falls on the outermost voxels, which are empty.
  int nearest(const Vector_f& p) const { return nearest(coordinate(p, 0), coordinate(p, 1), coordinate(p, 2)); }

  // The same for a row of places.
  Index_row nearest(const Rows& places) const
  {
    std::array<Index_row, 3> c;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = Eigen::Index(i);
      c[i] = clamped((places[i] - m_low[axis]) * m_scale, m_size[axis] - 1);
    }
    Index_row surfels;
    for (int k = 0; k < row_size; ++k) surfels[k] = nearest(c[0][k], c[1][k], c[2][k]);
    return surfels;
  }

  // That of the surfels in another unit of length.
  void scale(float factor)
  {
    m_low *= factor;
    m_scale /= factor;
  }

  // All that it consists of, `field` being it: f(part), for a writer and a reader.
  template <class Field, class Function>
  static void for_each_part(Field& field, const Function& f)
  {
    f(field.m_low);
    f(field.m_size);
    f(field.m_scale);
    for (auto& blocks : field.m_blocks) f(blocks);
    f(field.m_block_of);
    f(field.m_voxels);
  }

  // Whether it can be looked into, and leads to surfels of which there are so many.
  bool is_consistent(std::size_t surfels) const
  {
    const auto is_side = [](int n) { return n > 0 && n <= maximum_blocks; };
    if (!std::all_of(m_blocks.begin(), m_blocks.end(), is_side)) return false;
    for (int i = 0; i < 3; ++i)
      if (!(m_size[i] >= 1 && m_size[i] <= float(4 * m_blocks[std::size_t(i)]))) return false;
    const std::size_t blocks = m_voxels.size() / 64;
    const auto is_block = [blocks](std::int32_t b) { return b >= 0 && std::size_t(b) < blocks; };
    const auto is_surfel = [surfels](std::uint16_t s) { return s == empty || s < surfels; };
    return m_voxels.size() % 64 == 0 &&
           m_block_of.size() == std::size_t(m_blocks[0]) * std::size_t(m_blocks[1]) * std::size_t(m_blocks[2]) &&
           std::all_of(m_block_of.begin(), m_block_of.end(), is_block) &&
           std::all_of(m_voxels.begin(), m_voxels.end(), is_surfel);
  }

private:
  static constexpr std::uint16_t empty = 65535;
  static constexpr int maximum_blocks = 256;

  // In the order of the numbers, as far as these are positive.
  static std::int32_t bits_of(float x)
  {
    std::int32_t bits;
    static_assert(sizeof bits == sizeof x, "float is a number of 32 bits");
    std::memcpy(&bits, &x, sizeof bits);
    return bits;
  }

  // What is known of a block while it is built: the nearest surfels, and the bits of their squared distances. The first
  // of equally near ones is the nearest: a later one has to be nearer.
  struct Nearest
  {
    std::int32_t distances[64];
    std::int32_t surfels[64];

    // A surfel to four voxels. (By itself it is compiled to instructions for four of them, within the loops not.)
    BOOST_NOINLINE void offer(std::int32_t surfel, std::size_t voxel, float dxy, const std::array<float, 4>& dz)
    {
      std::int32_t bits[4], is_nearer[4]; // all bits or none
      for (std::size_t k = 0; k < 4; ++k) bits[k] = bits_of(dxy + dz[k]);
      for (std::size_t k = 0; k < 4; ++k) is_nearer[k] = (bits[k] - distances[voxel + k]) >> 31;
      for (std::size_t k = 0; k < 4; ++k) distances[voxel + k] ^= (distances[voxel + k] ^ bits[k]) & is_nearer[k];
      for (std::size_t k = 0; k < 4; ++k) surfels[voxel + k] ^= (surfels[voxel + k] ^ surfel) & is_nearer[k];
    }
  };

  static float median(const std::vector<Surfel>& surfels, int axis)
  {
    std::vector<float> values;
    values.reserve(surfels.size());
    for (const Surfel& s : surfels) values.push_back(s.position[axis]);
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  }

  int coordinate(const Vector_f& p, int axis) const
  {
    return clamped((p[axis] - m_low[axis]) * m_scale, m_size[axis] - 1);
  }

  // Of a voxel.
  int nearest(int i, int j, int k) const
  {
    const auto block = std::size_t(m_block_of[block_index(i, j, k)]);
    const std::uint16_t s = m_voxels[block * 64 + voxel_index(i, j, k)];
    return int(s) | -int(s == empty); // `none` has all bits
  }

  std::size_t block_index(int x, int y, int z) const
  {
    return (std::size_t(x >> 2) * std::size_t(m_blocks[1]) + std::size_t(y >> 2)) * std::size_t(m_blocks[2]) +
           std::size_t(z >> 2);
  }
  static std::size_t voxel_index(int x, int y, int z) { return std::size_t(((x & 3) << 4) | ((y & 3) << 2) | (z & 3)); }

  Vector_f m_low = Vector_f::Zero();
  Vector_f m_size = Vector_f::Constant(4); // in voxels
  float m_scale = 1;
  std::array<int, 3> m_blocks{1, 1, 1};
  std::vector<std::int32_t> m_block_of{0};
  std::vector<std::uint16_t> m_voxels = std::vector<std::uint16_t>(64, empty); // the first block is that of nothing
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_LOOKUP_SURFEL_FIELD_H
