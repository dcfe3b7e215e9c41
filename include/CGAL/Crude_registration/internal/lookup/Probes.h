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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_LOOKUP_PROBES_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_LOOKUP_PROBES_H

// Surfels of a scan that are moved to another one, and compared with it, a row of them at a time.

#include <CGAL/Crude_registration/internal/base/Rows.h>
#include <CGAL/Crude_registration/internal/lookup/Surfel_field.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

class Probes
{
public:
  explicit Probes(std::vector<Surfel> surfels) : m_surfels(std::move(surfels))
  {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = Eigen::Index(i);
      // The last ones are looked at with some that are none.
      m_positions[i].resize(size() + std::size_t(row_size));
      m_normals[i].resize(size() + std::size_t(row_size));
      for (std::size_t k = 0; k < size(); ++k) {
        m_positions[i][k] = m_surfels[k].position[axis];
        m_normals[i][k] = m_surfels[k].normal[axis];
      }
    }
  }

  std::size_t size() const { return m_surfels.size(); }
  const Surfel& operator[](std::size_t i) const { return m_surfels[i]; }
  std::vector<Surfel>::const_iterator begin() const { return m_surfels.begin(); }
  std::vector<Surfel>::const_iterator end() const { return m_surfels.end(); }
  const std::vector<Surfel>& surfels() const { return m_surfels; }

  // From the `i`-th on, and what follows them. \pre i <= size()
  Rows positions(std::size_t i) const { return row(m_positions, i); }
  Rows normals(std::size_t i) const { return row(m_normals, i); }

private:
  static Rows row(const std::array<std::vector<float>, 3>& vectors, std::size_t i)
  {
    return {Eigen::Map<const Row>(&vectors[0][i]), Eigen::Map<const Row>(&vectors[1][i]),
            Eigen::Map<const Row>(&vectors[2][i])};
  }

  std::vector<Surfel> m_surfels;
  std::array<std::vector<float>, 3> m_positions, m_normals;
};

// Some of them: `number` in a row. The probes are kept by reference.
struct Some_probes
{
  const Probes& probes;
  std::size_t first, number;

  Some_probes(const Probes& all) : probes(all), first(0), number(all.size()) {}
  // `n`, or all, where there are fewer, from the one that is `from` on, from the front again at the end.
  Some_probes(const Probes& all, std::size_t from, std::size_t n)
      : probes(all), first(0), number((std::min)(n, all.size()))
  {
    if (number > 0) first = from % (all.size() - number + 1);
  }
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_LOOKUP_PROBES_H
