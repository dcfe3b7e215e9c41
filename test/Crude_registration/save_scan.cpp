// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#define BOOST_TEST_MODULE save_scan
#include <boost/test/unit_test.hpp>

#include "statue_views.h"

#include <CGAL/Crude_registration/IO/save_scan.h>
#include <CGAL/Crude_registration/matching/Trihedron_candidates.h>
#include <CGAL/Crude_registration/register_scans.h>

#include <CGAL/Simple_cartesian.h>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>

// Prepared scans as bytes and in files: the same scan, bit by bit, or an error.

namespace {

const std::string& some_bytes()
{
  static const std::string bytes = CR::scan_to_bytes(view(1, 0).scan);
  return bytes;
}

bool is_refused(const std::string& bytes, const std::string& reason)
{
  try {
    CR::scan_from_bytes<Kernel>(bytes, "some bytes");
  } catch (const CR::IO_error& e) {
    return std::string(e.what()).find("some bytes: ") == 0 && std::string(e.what()).find(reason) != std::string::npos;
  }
  return false;
}

} // namespace

BOOST_AUTO_TEST_CASE(a_scan_that_was_read_back_registers_the_same)
{
  const View &source = view(1, 0), &target = view(1, 40);
  const Scan copy = CR::scan_from_bytes<Kernel>(CR::scan_to_bytes(source.scan));
  BOOST_TEST(CR::scan_to_bytes(copy) == CR::scan_to_bytes(source.scan));
  const Result expected = CR::register_scans(source.scan, target.scan);
  check_right(expected, source, target);
  check_same_bits(CR::register_scans(copy, target.scan), expected);
  check_same_bits(CR::register_scans(target.scan, copy), CR::register_scans(target.scan, source.scan));
}

BOOST_AUTO_TEST_CASE(the_simplified_mesh_is_kept)
{
  const auto np = p::candidates(CR::Trihedron_candidates());
  const Scan source(view(1, 0).image, np), target(view(1, 40).image, np);
  const Scan copy = CR::scan_from_bytes<Kernel>(CR::scan_to_bytes(source));
  check_same_bits(CR::register_scans(copy, target, np), CR::register_scans(source, target, np));
}

BOOST_AUTO_TEST_CASE(a_scan_without_a_sensor_and_one_of_another_kernel_are_kept)
{
  using Other = CR::Scan<CGAL::Simple_cartesian<double>>;
  Mesh statue;
  CR::make_statue(statue, 24);
  const Scan scan(statue);
  BOOST_TEST(!scan.has_free_space());
  const Other other = CR::scan_from_bytes<Other::Kernel>(CR::scan_to_bytes(scan));
  BOOST_TEST(!other.has_free_space());
  BOOST_TEST(CR::scan_to_bytes(other) == CR::scan_to_bytes(scan));
}

BOOST_AUTO_TEST_CASE(files_hold_the_bytes)
{
  const std::string file = (std::filesystem::temp_directory_path() / "crude_registration_save_scan").string();
  CR::save_scan(file, view(1, 0).scan);
  std::ifstream in(file, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  BOOST_TEST((bytes == some_bytes()));
  BOOST_TEST((CR::scan_to_bytes(CR::load_scan(file)) == some_bytes()));
  std::filesystem::remove(file);
  BOOST_CHECK_THROW(CR::load_scan(file), CR::IO_error);
}

BOOST_AUTO_TEST_CASE(bytes_that_are_cut_off_or_altered_are_refused)
{
  const std::string& good = some_bytes();
  for (std::size_t size = 0; size < good.size(); size = size < 40 ? size + 1 : size * 5 / 4)
    BOOST_TEST(is_refused(good.substr(0, size), ""));
  BOOST_TEST(is_refused(good.substr(0, good.size() - 1), "cut off"));
  BOOST_TEST(is_refused(good + '\0', "others follow"));
  BOOST_TEST(is_refused("ply\nformat ascii 1.0\n", "save_scan"));
  for (std::size_t i = 0; i < good.size(); i = i < 40 ? i + 1 : i * 5 / 4) {
    std::string bad = good;
    bad[i] = char(bad[i] ^ 4);
    BOOST_TEST(is_refused(bad, i < 8 ? "save_scan" : i < 12 ? "another version" : i < 20 ? "cut off" : "checksum"));
  }
}

BOOST_AUTO_TEST_CASE(both_sides_of_points_are_kept)
{
  const Scan scan(view(1, 0).image.points());
  const Scan copy = CR::scan_from_bytes<Kernel>(CR::scan_to_bytes(scan));
  BOOST_TEST_REQUIRE((scan.other_side() != nullptr) == (copy.other_side() != nullptr));
  BOOST_TEST(CR::scan_to_bytes(copy) == CR::scan_to_bytes(scan));
}
