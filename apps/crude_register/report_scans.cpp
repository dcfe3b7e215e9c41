// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "report_scans.h"

#include <CGAL/Crude_registration/compare_points.h>

#include <CGAL/for_each.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string_view>
#include <utility>

namespace {

// Measured: so many points are shown at once by a browser that draws without a graphics card.
constexpr std::size_t most_points = 1200000;
// What the points take of a page, three bytes of which are four characters: with three.js a page of 12 MB at most.
constexpr std::size_t most_bytes = 8000000;
constexpr std::size_t bytes_of_place = 6, bytes_of_normal = 2;

// How many points of each scan are shown if each has at most the same number, and all of them at most `most`.
std::size_t fair_share(std::vector<std::size_t> sizes, std::size_t most)
{
  std::sort(sizes.begin(), sizes.end());
  std::size_t share = most;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    share = most / (sizes.size() - i);
    if (sizes[i] > share) return share;
    most -= sizes[i];
  }
  return (std::max)(share, sizes.empty() ? 0 : sizes.back());
}

// Items of so many bytes each in an order of which each beginning is spread over all of them: steps of the golden
// section.
std::string spread(const std::string& bytes, std::size_t bytes_of_item)
{
  const std::size_t n = bytes.size() / bytes_of_item;
  constexpr double golden_section = 0.6180339887498949; // (sqrt(5) - 1) / 2
  std::size_t step = std::size_t(golden_section * double(n)) + 1;
  while (std::gcd(step, n) > 1) ++step; // so that all are met
  std::string result(bytes.size(), 0);
  char* to = &result[0];
  for (std::size_t i = 0, at = 0; i < n; ++i) {
    to = std::copy_n(bytes.data() + bytes_of_item * at, bytes_of_item, to);
    at += step;
    if (at >= n) at -= n;
  }
  return result;
}

// The box of points: its least corner, and its edges.
struct Report_box
{
  std::array<double, 3> low{}, size{};
};

Report_box box_of(const std::vector<Point>& points)
{
  Report_box box;
  if (points.empty()) return box;
  for (int k = 0; k < 3; ++k) {
    double low = points.front()[k], high = low;
    for (const Point& p : points) {
      low = (std::min)(low, p[k]);
      high = (std::max)(high, p[k]);
    }
    box.low[std::size_t(k)] = low;
    box.size[std::size_t(k)] = high - low;
  }
  return box;
}

// The places, 16 bits each, from 0 to 65535 along each edge of the box.
std::string packed_places(const std::vector<Point>& points, const Report_box& box)
{
  std::string bytes(bytes_of_place * points.size(), 0);
  char* at = &bytes[0];
  constexpr double most = 65535;
  std::array<double, 3> factor{};
  for (std::size_t k = 0; k < 3; ++k) factor[k] = box.size[k] > 0 ? most / box.size[k] : 0;
  for (const Point& p : points)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto x = std::uint32_t((std::min)(most, factor[k] * (p[int(k)] - box.low[k]) + 0.5)); // rounded
      *at++ = char(x & 255);
      *at++ = char(x >> 8);
    }
  return bytes;
}

using Meeting = CR::Compared_point<Kernel>;

// Calls f(meeting) for what each point meets in the others: in lots, so that the memory for these is small.
template <class Function>
void for_each_meeting(const Report_scan& scan, const std::vector<Other_scan>& others, const Function& f)
{
  constexpr std::size_t lot = 2048;
  for (std::size_t begin = 0; begin < scan.points.size(); begin += lot) {
    const std::size_t end = (std::min)(begin + lot, scan.points.size());
    const std::vector<Point> points(scan.points.begin() + std::ptrdiff_t(begin),
                                    scan.points.begin() + std::ptrdiff_t(end));
    std::vector<Meeting> nearest(points.size());
    for (const Other_scan& other : others) {
      if (other.scan == nullptr || scan.scan == nullptr) continue;
      const std::vector<Meeting> met = CR::compare_points(points, *scan.scan, *other.scan, other.motion);
      for (std::size_t i = 0; i < met.size(); ++i) {
        if (std::abs(met[i].distance) < std::abs(nearest[i].distance)) {
          nearest[i].distance = met[i].distance;
          nearest[i].normal = met[i].normal;
        }
        nearest[i].is_in_free_space = nearest[i].is_in_free_space || met[i].is_in_free_space;
      }
    }
    for (const Meeting& m : nearest) f(m);
  }
}

// The normals, two bytes each: the octahedron |x| + |y| + |z| = 1 folded out on a square. (0, 0): none is known.
std::string packed_normals(const Report_scan& scan)
{
  std::string bytes;
  bytes.reserve(bytes_of_normal * scan.points.size());
  for_each_meeting(scan, {{scan.scan, Transformation(CGAL::IDENTITY)}}, [&](const Meeting& m) {
    const double sum = std::abs(m.normal.x()) + std::abs(m.normal.y()) + std::abs(m.normal.z());
    std::array<int, 2> coded = {0, 0};
    if (sum > 0) {
      std::array<double, 2> p = {m.normal.x() / sum, m.normal.y() / sum};
      if (m.normal.z() < 0) p = {std::copysign(1 - std::abs(p[1]), p[0]), std::copysign(1 - std::abs(p[0]), p[1])};
      for (std::size_t k = 0; k < 2; ++k) coded[k] = int((p[k] + 1) * 127.5 + 0.5); // rounded
      if (coded[0] == 0 && coded[1] == 0) coded = {255, 255};                       // all corners are one direction
    }
    for (const int c : coded) bytes += char(c);
  });
  return bytes;
}

// What points meet, a byte each: the distance in steps, from 1 for `reach` behind the other surface or more over 64 on
// it to 127 for `reach` in front of it; 0 where none is near; 128 more in free space.
std::string packed_meetings(const Report_scan& scan, const std::vector<Other_scan>& others, double reach)
{
  std::string bytes;
  bytes.reserve(scan.points.size());
  for_each_meeting(scan, others, [&](const Meeting& m) {
    int code = 0;
    if (std::isfinite(m.distance)) {
      const double share = (std::min)((std::max)(m.distance / reach, -1.), 1.);
      code = int(1.5 + steps_of_reach * (1 + share)); // rounded
    }
    bytes += char(code + (m.is_in_free_space ? 128 : 0));
  });
  return bytes;
}

} // namespace

void thin_out(std::vector<Report_scan>& scans, std::size_t poses)
{
  std::vector<std::size_t> sizes;
  for (const Report_scan& s : scans) sizes.push_back(s.points.size());
  const std::size_t share =
      fair_share(sizes, (std::min)(most_points, most_bytes / (bytes_of_place + bytes_of_normal + poses)));
  for (Report_scan& s : scans) {
    s.samples = s.points.size();
    if (s.samples > share) {
      for (std::size_t i = 0; i < share; ++i) s.points[i] = s.points[i * s.samples / share];
      s.points.resize(share);
    }
  }
}

std::string to_base64(const std::string& bytes)
{
  static constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  static const std::vector<std::array<char, 2>> pairs = [] { // of all twelve bits
    std::vector<std::array<char, 2>> all;
    for (const char first : digits)
      for (const char second : digits) all.push_back({first, second});
    return all;
  }();
  std::string text(4 * ((bytes.size() + 2) / 3), '=');
  const auto byte = [&](std::size_t i) { return i < bytes.size() ? std::uint32_t(std::uint8_t(bytes[i])) : 0; };
  char* to = &text[0];
  for (std::size_t i = 0; i < bytes.size(); i += 3, to += 4) {
    const std::uint32_t three = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    std::copy_n(pairs[three >> 12].data(), 2, to);
    std::copy_n(pairs[three & 4095].data(), 2, to + 2);
  }
  // One or two bytes at the end are two or three characters.
  for (std::size_t left = bytes.size() % 3; left > 0 && left < 3; ++left) *(--to) = '=';
  return text;
}

Json Report_bytes::add_scan(const Report_scan& scan, std::size_t index)
{
  const Report_box box = box_of(scan.points);
  const std::string number = std::to_string(index);
  m_blocks.push_back(
      {"places_" + number, [&scan, box] { return spread(packed_places(scan.points, box), bytes_of_place); }});
  m_blocks.push_back({"normals_" + number, [&scan] { return spread(packed_normals(scan), bytes_of_normal); }});
  const Colour colour = colour_of_scan(index);
  return {{"name", scan.name},
          {"samples", scan.samples},
          {"shown", scan.points.size()},
          {"low", box.low},
          {"size", box.size},
          {"colour", {colour.red, colour.green, colour.blue}},
          {"spacing", scan.scan == nullptr ? 0 : scan.scan->spacing()},
          {"has_free_space", scan.scan != nullptr && scan.scan->has_free_space()}};
}

void Report_bytes::add_meetings(std::size_t pose, std::size_t index, const Report_scan& scan,
                                std::function<std::vector<Other_scan>()> others, double reach)
{
  m_blocks.push_back(
      {"met_" + std::to_string(pose) + "_" + std::to_string(index),
       [&scan, others = std::move(others), reach] { return spread(packed_meetings(scan, others(), reach), 1); }});
}

void Report_bytes::make()
{
  CGAL::for_each<CGAL::Parallel_if_available_tag>(m_blocks, [](Block& block) {
    block.text = to_base64(block.bytes());
    return true;
  });
}

void Report_bytes::write(std::ostream& out) const
{
  for (const Block& block : m_blocks)
    out << "<script type=\"text/plain\" id=\"" << block.id << "\">" << block.text << "</script>\n";
}
