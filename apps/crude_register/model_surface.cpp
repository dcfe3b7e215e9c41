// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// Meshes of an assembled model, by the reconstructions of CGAL.

#include "model_surface.h"

#include <CGAL/Crude_registration/IO/write_file.h>
#include <CGAL/Crude_registration/fused_points.h>
#include <CGAL/Crude_registration/sampling/join_points.h>

#include <CGAL/IO/PLY.h>
#include <CGAL/Point_set_3.h>
#include <CGAL/Random.h>
#include <CGAL/Scale_space_surface_reconstruction_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/compute_average_spacing.h>
#include <CGAL/poisson_surface_reconstruction.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <ostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

using Vector = Kernel::Vector_3;
using Oriented_point = std::pair<Point, Vector>;
using Face = std::array<std::size_t, 3>;

struct Soup
{
  std::vector<Point> points;
  std::vector<Face> faces;
};

// Faces that look the way of most of their points' normals.
void turn_outward(const std::vector<Oriented_point>& points, std::vector<Face>& faces)
{
  for (Face& f : faces) {
    const Vector normal = CGAL::normal(points[f[0]].first, points[f[1]].first, points[f[2]].first);
    if (normal * (points[f[0]].second + points[f[1]].second + points[f[2]].second) < 0) std::swap(f[1], f[2]);
  }
}

Soup by_advancing_front(const std::vector<Oriented_point>& points)
{
  Soup soup;
  for (const Oriented_point& p : points) soup.points.push_back(p.first);
  soup.faces = CR::join_points(soup.points);
  turn_outward(points, soup.faces);
  return soup;
}

Soup by_scale_space(const std::vector<Oriented_point>& points)
{
  Soup soup;
  for (const Oriented_point& p : points) soup.points.push_back(p.first);
  CGAL::Scale_space_surface_reconstruction_3<Kernel> reconstruction(soup.points.begin(), soup.points.end());
  constexpr std::size_t iterations = 4; // of the smoothing: the default of CGAL's examples
  reconstruction.increase_scale(iterations);
  reconstruction.reconstruct_surface();
  for (auto f = reconstruction.facets_begin(); f != reconstruction.facets_end(); ++f)
    soup.faces.push_back({(*f)[0], (*f)[1], (*f)[2]});
  turn_outward(points, soup.faces);
  return soup;
}

Soup by_poisson(const std::vector<Oriented_point>& points)
{
  const auto point_map = CGAL::First_of_pair_property_map<Oriented_point>();
  const auto normal_map = CGAL::Second_of_pair_property_map<Oriented_point>();
  constexpr unsigned neighbours = 6; // as CGAL's examples have it
  const double spacing =
      CGAL::compute_average_spacing<CGAL::Sequential_tag>(points, neighbours, CGAL::parameters::point_map(point_map));
  CGAL::Surface_mesh<Point> mesh;
  if (!CGAL::poisson_surface_reconstruction_delaunay(points.begin(), points.end(), point_map, normal_map, mesh,
                                                     spacing))
    throw std::runtime_error("Poisson's reconstruction finds no surface");
  Soup soup;
  for (const auto v : mesh.vertices()) soup.points.push_back(mesh.point(v));
  for (const auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    soup.faces.push_back(
        {std::size_t(mesh.source(h)), std::size_t(mesh.target(h)), std::size_t(mesh.target(mesh.next(h)))});
  }
  return soup;
}

} // namespace

void check_surface_method(const std::string& method)
{
  if (method != "advancing-front" && method != "scale-space" && method != "poisson")
    throw Usage_error("--surface takes " + std::string(surface_methods));
}

void write_model_surface(const std::string& file, const std::string& method, const CR::Assembly_result<Kernel>& result,
                         const std::vector<CR::Scan<Kernel>>& scans)
{
  CGAL::get_default_random() = CGAL::Random(0); // the same mesh every time
  const std::vector<Oriented_point> points = CR::fused_points(result, scans);
  Soup soup = method == "poisson"       ? by_poisson(points)
              : method == "scale-space" ? by_scale_space(points)
                                        : by_advancing_front(points);
  // CGAL's order of the faces depends on where they lie in memory.
  for (Face& f : soup.faces) std::rotate(f.begin(), std::min_element(f.begin(), f.end()), f.end());
  std::sort(soup.faces.begin(), soup.faces.end());
  CR::write_file(file, [&](std::ostream& out) {
    CGAL::IO::set_binary_mode(out);
    CGAL::IO::write_PLY(out, soup.points, soup.faces);
  });
}
