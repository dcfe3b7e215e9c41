// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_TEST_SCAN_FILES_H
#define CGAL_CRUDE_REGISTRATION_TEST_SCAN_FILES_H

// Files that are written to be read as scans, and what reading them says.

#include "range_images.h"

#include <CGAL/Crude_registration/IO/read_scan.h>

#include <boost/test/unit_test.hpp>

#include <string>
#include <vector>

namespace generated {

using Scan = CR::Scan_file<Kernel>;

inline const Temporary_folder& folder()
{
  static const Temporary_folder f;
  return f;
}

inline Scan read(const std::string& name, const std::string& contents)
{
  return CR::read_scan<Kernel>(folder().file(name, contents));
}

// What reading says behind the name of the file, "" if it does not complain.
inline std::string error_of(const std::string& name, const std::string& contents)
{
  const std::string file = folder().file(name, contents);
  try {
    CR::read_scan<Kernel>(file);
  } catch (const CR::IO_error& error) {
    BOOST_TEST_MESSAGE(error.what());
    BOOST_TEST(std::string(error.what()).find(file) == 0);
    return std::string(error.what()).substr(file.size());
  }
  return "";
}

#define CHECK_ERROR(NAME, CONTENTS, BEGINNING, PART)                                                                   \
  {                                                                                                                    \
    const std::string error = error_of(NAME, CONTENTS);                                                                \
    BOOST_TEST(error.find(BEGINNING) == 0, error);                                                                     \
    BOOST_TEST(error.find(PART) != std::string::npos, error);                                                          \
  }

inline bool are(const Scan& scan, const std::vector<Point>& points)
{
  return scan.kind == Scan::POINTS && scan.points == points && scan.mesh.is_empty() && scan.image.points().empty();
}

inline const std::vector<Point> three = {Point(1, 2, 3), Point(-4, 5.5, 6), Point(0.1, 0, -1e-3)};

} // namespace generated

#endif // CGAL_CRUDE_REGISTRATION_TEST_SCAN_FILES_H
