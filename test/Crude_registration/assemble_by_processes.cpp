// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// An assembly whose pairs are registered elsewhere is the same as one that does it itself; so is a scan that is
// prepared of the triangles of its range image.

#define BOOST_TEST_MODULE assemble_by_processes

#include "generated_surfaces.h"
#include "statue_views.h"

#include <CGAL/Crude_registration/IO/save_scan.h>
#include <CGAL/Crude_registration/assemble_by_processes.h>
#include <CGAL/Crude_registration/sampling/triangulate_range_image.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

std::vector<Scan> scans_around(unsigned seed)
{
  std::vector<Scan> scans;
  for (const int degrees : {0, 45, 90, 180}) scans.push_back(view(seed, degrees).scan);
  return scans;
}

// All that is told of the scans and the pairs.
void check_same(const CR::Assembly_result<Kernel>& a, const CR::Assembly_result<Kernel>& b)
{
  BOOST_REQUIRE(a.number_of_scans() == b.number_of_scans());
  BOOST_TEST(a.number_of_components() == b.number_of_components());
  for (std::size_t i = 0; i < a.number_of_scans(); ++i) {
    BOOST_TEST(a.component(i) == b.component(i));
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 4; ++c) BOOST_TEST(a.pose(i).m(r, c) == b.pose(i).m(r, c));
  }
  BOOST_REQUIRE(a.edges().size() == b.edges().size());
  for (std::size_t i = 0; i < a.edges().size(); ++i) {
    BOOST_TEST(a.edges()[i].source == b.edges()[i].source);
    BOOST_TEST(a.edges()[i].target == b.edges()[i].target);
    BOOST_TEST(a.edges()[i].confidence == b.edges()[i].confidence);
  }
}

} // namespace

BOOST_AUTO_TEST_CASE(the_same_by_others)
{
  const std::vector<Scan> scans = scans_around(3);
  std::size_t asked = 0;
  const CR::Pair_executor executor = [&](const std::vector<CR::Scan_places>& pairs,
                                         const std::function<bool()>& go_on) {
    BOOST_TEST(go_on());
    std::vector<std::string> answers(pairs.size());
    for (std::size_t i = pairs.size(); i-- > 0;) answers[i] = CR::registered_pair(scans, pairs[i]); // in any order
    asked += pairs.size();
    return answers;
  };
  const auto alone = CR::assemble_scans(scans);
  BOOST_TEST(alone.number_of_components() == 1u);
  check_same(alone, CR::assemble_scans_by(executor, scans));
  BOOST_TEST(asked == alone.edges().size());
}

BOOST_AUTO_TEST_CASE(a_store_keeps_what_was_registered)
{
  const std::vector<Scan> scans = {view(3, 0).scan, view(3, 45).scan};
  const std::string folder = "assemble_by_processes_store";
  std::filesystem::remove_all(folder);
  const std::string once = CR::registered_pair(scans, {0, 1}, p::store(folder));
  BOOST_TEST((once == CR::registered_pair(scans, {0, 1})));
  BOOST_TEST((once == CR::registered_pair(scans, {0, 1}, p::store(folder))));
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++files;
  BOOST_TEST(files == 1u);
  std::filesystem::remove_all(folder);
}

BOOST_AUTO_TEST_CASE(what_is_refused)
{
  const std::vector<Scan> scans = {view(3, 0).scan, view(3, 45).scan};
  BOOST_CHECK_THROW(CR::registered_pair(scans, {0, 2}), std::out_of_range);
  const CR::Pair_executor broken = [](const std::vector<CR::Scan_places>& pairs, const std::function<bool()>&) {
    return std::vector<std::string>(pairs.size(), "no answer");
  };
  BOOST_CHECK_THROW(CR::assemble_scans_by(broken, scans), std::runtime_error);
  const CR::Pair_executor failing = [](const std::vector<CR::Scan_places>&,
                                       const std::function<bool()>&) -> std::vector<std::string> {
    throw std::domain_error("as it is");
  };
  BOOST_CHECK_THROW(CR::assemble_scans_by(failing, scans), std::domain_error);
}

BOOST_AUTO_TEST_CASE(triangles_of_a_range_image)
{
  const Image& image = view(3, 0).image;
  BOOST_REQUIRE(image.sensor().is_known());
  std::vector<Point> points;
  std::vector<std::array<std::size_t, 3>> triangles;
  CR::triangulate_range_image(image, points, triangles);
  const auto surfels_of = [](const Scan& scan) {
    std::vector<double> numbers = {scan.spacing(), scan.extent(), double(scan.number_of_samples()),
                                   double(scan.has_free_space())};
    for (const Point& q : scan.points())
      for (int k = 0; k < 3; ++k) numbers.push_back(q[k]);
    return numbers;
  };
  BOOST_TEST((surfels_of(Scan(image)) == surfels_of(Scan(points, triangles, image.sensor()))));
  BOOST_TEST(!Scan(points, triangles, CR::Sensor<Kernel>()).has_free_space());
  triangles.back()[2] = points.size();
  BOOST_CHECK_THROW(Scan(points, triangles, image.sensor()), std::invalid_argument);
  triangles.clear();
  BOOST_CHECK_THROW(Scan(points, triangles, image.sensor()), std::invalid_argument);
}
