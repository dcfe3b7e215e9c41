// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// Scans in units whose ratio nobody knows: it is found with the motion, or said not to be known.

#define BOOST_TEST_MODULE register_scans_with_scale
#include <boost/test/unit_test.hpp>

#include "statue_views.h"
#include "wrong_use.h"

#include <CGAL/Crude_registration/register_scans_with_scale.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <random>
#include <utility>
#include <vector>

namespace {

using Scaled = CR::Scaled_registration<Kernel>;
using Transformation = CGAL::Aff_transformation_3<Kernel>;

Image in_unit(const Image& image, double factor)
{
  Image scaled = image;
  CR::transform(scaled, Transformation(CGAL::SCALING, factor));
  return scaled;
}

// Registered; the scale to 1 %, and the points of the source to within that and two sampling distances.
void check_right(const Scaled& result, double scale, const View& source, const View& target)
{
  check_proper(result.registration);
  BOOST_TEST(result.registration.status() == CR::REGISTERED);
  BOOST_TEST(std::abs(result.scale / scale - 1) < 0.01);
  BOOST_TEST(result.scale_deviation < 0.01);
  const Rigid_motion truth = true_motion(source, target);
  BOOST_TEST(angle_between(to_rigid_motion(result.registration.transformation()), truth) < 1);
  const Transformation similarity = result.similarity();
  double farthest = 0;
  for (const Point& p : source.image.points()) {
    const Vector moved = to_vector(similarity.transform(Point(p.x() / scale, p.y() / scale, p.z() / scale)));
    farthest = (std::max)(farthest, (moved - truth(to_vector(p))).norm());
  }
  BOOST_TEST(farthest < 0.01 * source.scan.extent() + 2 * target.scan.spacing());
}

// Three rectangles that meet in a corner, of cells of edge 1, n at the longest edge, with some roughness.
Mesh corner(int n)
{
  Mesh mesh;
  std::mt19937 random{std::mt19937::result_type(n)};
  const auto roughness = [&] { return 0.2 * double(random()) / double(std::mt19937::max()); };
  const std::array<int, 3> sizes = {n, 2 * n / 3, n / 2};
  for (int axis = 0; axis < 3; ++axis) {
    const int rows = sizes[std::size_t(axis + 1) % 3], columns = sizes[std::size_t(axis + 2) % 3];
    std::vector<Mesh::Vertex_index> v;
    for (int i = 0; i <= rows; ++i)
      for (int j = 0; j <= columns; ++j) {
        std::array<double, 3> c{};
        c[std::size_t(axis)] = roughness();
        c[std::size_t(axis + 1) % 3] = i;
        c[std::size_t(axis + 2) % 3] = j;
        v.push_back(mesh.add_vertex(Point(c[0], c[1], c[2])));
      }
    const auto at = [&](int i, int j) { return v[std::size_t(i * (columns + 1) + j)]; };
    for (int i = 0; i < rows; ++i)
      for (int j = 0; j < columns; ++j) {
        mesh.add_face(at(i, j), at(i + 1, j), at(i + 1, j + 1));
        mesh.add_face(at(i, j), at(i + 1, j + 1), at(i, j + 1));
      }
  }
  return mesh;
}

} // namespace

BOOST_AUTO_TEST_CASE(a_scan_is_scaled_as_its_input_is)
{
  for (const double factor : {25.4, 0.001}) {
    const View& v = view(0, 45);
    const Scan scaled = CR::scaled(v.scan, factor), expected(in_unit(v.image, factor));
    BOOST_TEST(scaled.number_of_samples() == expected.number_of_samples());
    BOOST_TEST(std::abs(scaled.spacing() / expected.spacing() - 1) < 1e-6);
    BOOST_TEST(std::abs(scaled.extent() / expected.extent() - 1) < 1e-6);
    BOOST_TEST(scaled.has_free_space());
    // the same surface in the same place: all of it overlaps, and nothing is where nothing is
    const Result same = CR::register_scans(scaled, expected);
    BOOST_TEST(same.status() == CR::REGISTERED);
    BOOST_TEST(angle_between(to_rigid_motion(same.transformation()), Rigid_motion()) < 0.01);
    BOOST_TEST(to_rigid_motion(same.transformation()).translation.norm() < 0.1 * expected.spacing());
    BOOST_TEST(same.overlap() > 0.99);
    BOOST_TEST(same.free_space_violations() < 0.01);
    const Result plain = CR::register_scans(v.scan, v.scan);
    BOOST_TEST(std::abs(same.residual() - plain.residual()) < 1e-3);
    BOOST_TEST(std::abs(same.score() - plain.score()) < 0.01 * std::abs(plain.score()));
  }
}

BOOST_AUTO_TEST_CASE(scales_are_found)
{
  // Each view against one of another statue's sides, 45 degrees on: overlaps of about .6.
  const std::array<double, 5> scales = {25.4, 0.001, 1.7, 0.62, 1};
  for (std::size_t i = 0; i < scales.size(); ++i)
    for (const unsigned seed : {1u, 2u}) {
      BOOST_TEST_CONTEXT("scale " << scales[i] << ", statue " << seed)
      {
        const View &source = view(seed, int(45 * i)), &target = view(seed, int(45 * i) + 45);
        const Scan in_other_unit(in_unit(source.image, 1 / scales[i]));
        check_right(CR::register_scans_with_scale<CGAL::Parallel_if_available_tag>(in_other_unit, target.scan),
                    scales[i], source, target);
      }
    }
}

BOOST_AUTO_TEST_CASE(other_objects_are_not_registered)
{
  for (const unsigned seed : {2u, 3u, 4u})
    for (const double scale : {1., 0.62}) {
      const Scan source = CR::scaled(view(1, 45).scan, scale);
      const Scaled result = CR::register_scans_with_scale<CGAL::Parallel_if_available_tag>(source, view(seed, 45).scan);
      check_not_registered(result.registration);
      if (result.registration.status() == CR::NOT_REGISTERED) BOOST_TEST(result.scale == 1);
    }
}

BOOST_AUTO_TEST_CASE(points_without_a_sensor)
{
  const View &source = view(1, 45), &target = view(1, 90);
  const double scale = 25.4;
  const auto points_of = [](const Image& image) { return Scan(image.points()); };
  check_right(CR::register_scans_with_scale<CGAL::Parallel_if_available_tag>(
                  points_of(in_unit(source.image, 1 / scale)), points_of(target.image)),
              scale, source, target);
}

BOOST_AUTO_TEST_CASE(a_corner_has_no_scale)
{
  // Three planes are the same in every unit, whatever their borders suggest; the motion alone is found.
  const Scan source(corner(60)), target(corner(75));
  BOOST_TEST(CR::register_scans(source, target).free_motions().empty());
  const Scaled result = CR::register_scans_with_scale(source, target);
  BOOST_TEST_MESSAGE("scale " << result.scale << " +- " << result.scale_deviation << ": "
                              << result.registration.reason());
  BOOST_TEST(result.registration.status() != CR::REGISTERED);
  BOOST_TEST(result.registration.confidence() <= 0.5);
}

BOOST_AUTO_TEST_CASE(runs_end_when_they_are_told_to)
{
  const Scan source = CR::scaled(view(1, 45).scan, 1 / 1.7);
  const Scaled whole = CR::register_scans_with_scale(source, view(2, 45).scan);
  Impatient patient(1);
  const Scaled watched = CR::register_scans_with_scale(source, view(2, 45).scan, p::visitor(std::ref(patient)));
  check_same_bits(whole.registration, watched.registration);
  BOOST_TEST(whole.scale == watched.scale);
  BOOST_TEST(patient.is_share);
  BOOST_TEST(patient.is_monotone);
  BOOST_TEST(patient.last > 0.5);
  Impatient impatient(0.3);
  const Scaled ended = CR::register_scans_with_scale(source, view(2, 45).scan, p::visitor(std::ref(impatient)));
  BOOST_TEST(ended.registration.status() != CR::REGISTERED);
  BOOST_TEST(ended.registration.reason().find("interrupted") == 0);
  BOOST_TEST(impatient.refused == 1);
  const Scaled late = CR::register_scans_with_scale(source, view(2, 45).scan, p::time_budget(1e-9));
  BOOST_TEST(late.registration.reason().find("interrupted") == 0);
  BOOST_TEST(is_refused([&] { CR::register_scans_with_scale(source, source, p::time_budget(-1)); },
                        "register_scans_with_scale", "time_budget"));
}

BOOST_AUTO_TEST_CASE(threads_do_not_change_the_answer)
{
  const Scan source = CR::scaled(view(1, 45).scan, 1 / 0.62);
  const Scaled one = CR::register_scans_with_scale<CGAL::Sequential_tag>(source, view(1, 90).scan),
               all = CR::register_scans_with_scale<CGAL::Parallel_if_available_tag>(source, view(1, 90).scan);
  check_same_bits(one.registration, all.registration);
  BOOST_TEST(one.scale == all.scale);
  BOOST_TEST(one.scale_deviation == all.scale_deviation);
}
