// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_TEST_RANGE_IMAGES_H
#define CGAL_CRUDE_REGISTRATION_TEST_RANGE_IMAGES_H

// Range images whose sensor and surface are known.

#include "generated_surfaces.h"

#include <CGAL/Crude_registration/Range_image.h>

#include <CGAL/Simple_cartesian.h>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

namespace generated {

namespace CR = CGAL::Crude_registration;
using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Image = CR::Range_image<Kernel>;
using Sensor = CR::Sensor<Kernel>;
using Motion = CGAL::Aff_transformation_3<Kernel>;

constexpr double no_depth = std::numeric_limits<double>::quiet_NaN();

inline Vector vector(const Point& p)
{
  return Vector(p.x(), p.y(), p.z());
}
inline Vector vector(const Kernel::Vector_3& v)
{
  return Vector(v.x(), v.y(), v.z());
}
inline Point point(const Vector& v)
{
  return Point(v.x(), v.y(), v.z());
}
inline Motion aff(const Rigid_motion& m)
{
  return CR::internal::to_aff_transformation<Kernel>(m);
}

// The samples position(column, row), where they are finite.
template <class Position>
Image image_of(std::size_t columns, std::size_t rows, const Position& position)
{
  Image image(columns, rows);
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t column = 0; column < columns; ++column) {
      const Vector p = position(double(column), double(row));
      if (p.allFinite()) image.set_sample(column, row, point(p));
    }
  return image;
}

// Seen along -z: sample (c dx, r dy, height(x, y)). The image's sensor is not set.
template <class Height>
Image orthographic_image(std::size_t columns, std::size_t rows, double dx, double dy, const Height& height)
{
  return image_of(columns, rows, [&](double column, double row) {
    const double x = column * dx, y = row * dy;
    return Vector(x, y, height(x, y));
  });
}

// Seen from the origin along +z, by a camera whose pixels are 1 / focal apart at z = 1: sample z(a, b) (a, b, 1). The
// image's sensor is not set.
template <class Depth>
Image perspective_image(std::size_t columns, std::size_t rows, double focal, const Depth& depth)
{
  return image_of(columns, rows, [&](double column, double row) {
    const double a = (column - double(columns) / 2) / focal, b = (row - double(rows) / 2) / focal;
    return Vector(depth(a, b) * Vector(a, b, 1));
  });
}

// The same samples, their columns in reverse order, or rows and columns exchanged.
inline Image mirrored(const Image& image)
{
  std::vector<Image::Index> grid;
  for (std::size_t row = 0; row < image.rows(); ++row)
    for (std::size_t column = 0; column < image.columns(); ++column)
      grid.push_back(image.index(image.columns() - 1 - column, row));
  Image result(image.columns(), image.rows(), image.points(), grid);
  result.set_sensor(image.sensor());
  return result;
}

inline Image transposed(const Image& image)
{
  std::vector<Image::Index> grid;
  for (std::size_t column = 0; column < image.columns(); ++column)
    for (std::size_t row = 0; row < image.rows(); ++row) grid.push_back(image.index(column, row));
  Image result(image.rows(), image.columns(), image.points(), grid);
  result.set_sensor(image.sensor());
  return result;
}

// The image whose points p are factor p + offset; a sensor is not taken along.
inline Image scaled(const Image& image, double factor, const Vector& offset = Vector::Zero())
{
  std::vector<Point> points;
  for (const Point& p : image.points()) points.push_back(point(factor * vector(p) + offset));
  return Image(image.columns(), image.rows(), points, image.grid());
}

inline Image moved(const Image& image, const Rigid_motion& motion)
{
  Image result = image;
  transform(result, aff(motion));
  return result;
}

inline double degrees(const Vector& a, const Vector& b)
{
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / pi;
}

// Whether there are real scans: the precondition of test cases that need them. These have the label `real_scans`, by
// which ctest runs them on their own, and shows them as skipped where this says so.
inline boost::test_tools::assertion_result real_scans_are_there(boost::unit_test::test_unit_id)
{
  const char* data = std::getenv("CRUDE_REGISTRATION_DATA");
  if (data != nullptr && std::filesystem::is_directory(data)) return true;
  std::cout << "skipped: there are no real scans, CRUDE_REGISTRATION_DATA is not set to their folder\n";
  return false;
}

// The folder of a set of real scans; empty, with a message, where this one is missing.
// \pre There are real scans.
inline std::filesystem::path real_scans(const std::string& set)
{
  const std::filesystem::path folder = std::filesystem::path(std::getenv("CRUDE_REGISTRATION_DATA")) / set;
  if (std::filesystem::is_directory(folder)) return folder;
  std::cout << "real scans '" << set << "': not tested, CRUDE_REGISTRATION_DATA has no such folder\n";
  return {};
}

// The files of a folder with an extension, sorted.
inline std::vector<std::filesystem::path> files(const std::filesystem::path& folder, const std::string& extension)
{
  std::vector<std::filesystem::path> result;
  if (!folder.empty())
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      if (entry.path().extension() == extension) result.push_back(entry.path());
  std::sort(result.begin(), result.end());
  return result;
}

// A folder for the files of a test, removed afterwards.
class Temporary_folder
{
public:
  Temporary_folder()
  {
    std::string path = (std::filesystem::temp_directory_path() / "crude_registration_XXXXXX").string();
    BOOST_REQUIRE(mkdtemp(path.data()) != nullptr);
    m_path = path;
  }
  ~Temporary_folder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(m_path, ignored);
  }
  Temporary_folder(const Temporary_folder&) = delete;
  Temporary_folder& operator=(const Temporary_folder&) = delete;

  const std::filesystem::path& path() const { return m_path; }

  // writes a file and returns its name. (Some file systems wait for the disk where a file is written in the place of
  // another one.)
  std::string file(const std::string& name, const std::string& contents) const
  {
    const std::string path = (m_path / name).string();
    std::filesystem::remove(path);
    std::ofstream(path, std::ios::binary) << contents;
    return path;
  }

private:
  std::filesystem::path m_path;
};

} // namespace generated

#endif // CGAL_CRUDE_REGISTRATION_TEST_RANGE_IMAGES_H
