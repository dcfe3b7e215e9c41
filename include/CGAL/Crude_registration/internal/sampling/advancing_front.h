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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_ADVANCING_FRONT_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_ADVANCING_FRONT_H

// CGAL's advancing front, whose answer depends on the points alone.

#include <CGAL/Crude_registration/internal/base/Run_control.h>

#include <CGAL/Advancing_front_surface_reconstruction.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>
#include <CGAL/tags.h>

#include <array>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <tuple>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// CGAL's front takes the edge of the best candidate next, and of edges that are as good, which two edges of one facet
// are, the one that is at the lower address in memory: its surface depends on what was allocated before. Here it is the
// one of the lower numbers of points.
template <class Traits, class Base = Triangulation_vertex_base_3<Traits>>
struct Front_vertex_base : Advancing_front_surface_reconstruction_vertex_base_3<Traits, Base>
{
  using Front_base = Advancing_front_surface_reconstruction_vertex_base_3<Traits, Base>;
  using Front_base::Front_base;

  template <class TDS>
  struct Rebind_TDS
  {
    using Other = Front_vertex_base<Traits, typename Base::template Rebind_TDS<TDS>::Other>;
  };

  // An edge of the front in the queue: what CGAL's algorithm builds from its value and its address, and compares.
  struct Radius_ptr_type
  {
    typename Front_base::criteria first;
    typename Front_base::IO_edge_type* second;
    std::array<std::size_t, 2> points;

    Radius_ptr_type(typename Front_base::criteria value, typename Front_base::IO_edge_type* edge)
        : first(value), second(edge)
    {
      const auto& [cell, from, to] = edge->first.first;
      points = {cell->vertex(from)->info(), cell->vertex(to)->info()};
    }

    friend bool operator<(const Radius_ptr_type& a, const Radius_ptr_type& b)
    {
      return std::tie(a.first, a.points) < std::tie(b.first, b.points);
    }
  };
};

// A cell that knows when it was made: a facet is given by the older one of its cells, not by that of the lower address.
template <class Traits, class Base = Delaunay_triangulation_cell_base_3<Traits>>
class Front_cell_base : public Advancing_front_surface_reconstruction_cell_base_3<Traits, Base>
{
  using Front_base = Advancing_front_surface_reconstruction_cell_base_3<Traits, Base>;

public:
  using Front_base::Front_base;
  using Has_timestamp = Tag_true;

  template <class TDS>
  struct Rebind_TDS
  {
    using Other = Front_cell_base<Traits, typename Base::template Rebind_TDS<TDS>::Other>;
  };

  std::size_t time_stamp() const { return m_time_stamp; }
  void set_time_stamp(std::size_t t) { m_time_stamp = t; }

private:
  std::size_t m_time_stamp = std::size_t(-1);
};

// CGAL::advancing_front_surface_reconstruction(), the same for the same points. The faces are triples of indices.
// \throws Run_control::Stopped
template <class Priority>
std::vector<std::array<std::size_t, 3>>
advancing_front(const std::vector<Exact_predicates_inexact_constructions_kernel::Point_3>& points,
                const Priority& priority, Run_control& control)
{
  using Kernel = Exact_predicates_inexact_constructions_kernel;
  using Triangulation =
      Delaunay_triangulation_3<Kernel,
                               Triangulation_data_structure_3<Front_vertex_base<Kernel>, Front_cell_base<Kernel>>>;
  // As the triangulation inserts a range, but that it can be stopped.
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  const auto point_map = make_property_map(points);
  spatial_sort(order.begin(), order.end(), Spatial_sort_traits_adapter_3<Kernel, decltype(point_map)>(point_map));
  Triangulation triangulation;
  typename Triangulation::Vertex_handle last;
  for (const std::size_t i : order) {
    control.check();
    last = triangulation.insert(points[i], last);
    last->info() = i;
  }
  Advancing_front_surface_reconstruction<Triangulation, Priority> front(triangulation, priority);
  front.run();
  std::vector<std::array<std::size_t, 3>> faces;
  write_triple_indices(std::back_inserter(faces), front);
  return faces;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_SAMPLING_ADVANCING_FRONT_H
