// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CRUDE_REGISTER_REPORT_SCANS_H
#define CRUDE_REGISTER_REPORT_SCANS_H

// Scans as a report carries them: points, normals and what they meet, in few bytes, as text.

#include "json.h"
#include "surfaces.h"

#include <CGAL/Crude_registration/Scan.h>
#include <CGAL/Crude_registration/compare_points.h>

#include <CGAL/for_each.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// A scan on a page. The prepared scan is null where there was no time to prepare it.
struct Report_scan
{
  std::string name;
  const CR::Scan<Kernel>* scan = nullptr;
  std::size_t samples = 0;
  std::vector<Point> points = {}; // of the samples, those that are shown, in the frame of the file
};

// Measured: so many points are shown at once by a browser that draws without a graphics card.
constexpr std::size_t most_points = 1200000;
// What the points take of a page, three bytes of which are four characters: with three.js a page of 12 MB at most.
constexpr std::size_t most_bytes = 8000000;
constexpr std::size_t bytes_of_place = 6, bytes_of_normal = 2;

// How many points of each scan are shown if each has at most the same number, and all of them at most `most`.
inline std::size_t fair_share(std::vector<std::size_t> sizes, std::size_t most)
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

// The same points in an order of which each beginning is spread over all of them: steps of the golden section.
inline void spread_order(std::vector<Point>& points)
{
  const std::size_t n = points.size();
  constexpr double golden_section = 0.6180339887498949; // (sqrt(5) - 1) / 2
  std::size_t step = std::size_t(golden_section * double(n)) + 1;
  while (std::gcd(step, n) > 1) ++step; // so that all are met
  std::vector<Point> spread;
  spread.reserve(n);
  for (std::size_t i = 0, at = 0; i < n; ++i, at = (at + step) % n) spread.push_back(points[at]);
  points = std::move(spread);
}

// The points that are shown of scans that have bytes for `poses` poses: of each scan evenly from the first to the last.
inline void thin_out(std::vector<Report_scan>& scans, std::size_t poses)
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
    spread_order(s.points);
  }
}

inline std::string to_base64(const std::string& bytes)
{
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text(4 * ((bytes.size() + 2) / 3), '=');
  const auto byte = [&](std::size_t i) { return std::uint32_t(std::uint8_t(bytes[i])); };
  std::size_t i = 0, j = 0;
  for (; i + 3 <= bytes.size(); i += 3, j += 4) {
    const std::uint32_t three = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    text[j] = digits[three >> 18];
    text[j + 1] = digits[three >> 12 & 63];
    text[j + 2] = digits[three >> 6 & 63];
    text[j + 3] = digits[three & 63];
  }
  if (i < bytes.size()) { // one or two bytes are left: two or three characters
    const bool are_two = i + 1 < bytes.size();
    const std::uint32_t three = byte(i) << 16 | (are_two ? byte(i + 1) << 8 : 0);
    text[j] = digits[three >> 18];
    text[j + 1] = digits[three >> 12 & 63];
    if (are_two) text[j + 2] = digits[three >> 6 & 63];
  }
  return text;
}

// The box of points: its least corner, and its edges.
struct Report_box
{
  std::array<double, 3> low{}, size{};
};

inline Report_box box_of(const std::vector<Point>& points)
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
inline std::string packed_places(const std::vector<Point>& points, const Report_box& box)
{
  std::string bytes;
  bytes.reserve(bytes_of_place * points.size());
  constexpr double most = 65535;
  for (const Point& p : points)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto x = std::uint16_t(box.size[k] > 0 ? std::lround(most * (p[int(k)] - box.low[k]) / box.size[k]) : 0);
      bytes += char(x & 255);
      bytes += char(x >> 8);
    }
  return bytes;
}

// The normals, two bytes each: the octahedron |x| + |y| + |z| = 1 folded out on a square. (0, 0): none is known.
inline std::string packed_normals(const std::vector<CR::Compared_point<Kernel>>& met)
{
  std::string bytes;
  bytes.reserve(bytes_of_normal * met.size());
  for (const auto& m : met) {
    const double sum = std::abs(m.normal.x()) + std::abs(m.normal.y()) + std::abs(m.normal.z());
    std::array<int, 2> coded = {0, 0};
    if (sum > 0) {
      std::array<double, 2> p = {m.normal.x() / sum, m.normal.y() / sum};
      if (m.normal.z() < 0) p = {std::copysign(1 - std::abs(p[1]), p[0]), std::copysign(1 - std::abs(p[0]), p[1])};
      for (std::size_t k = 0; k < 2; ++k) coded[k] = int(std::lround((p[k] + 1) * 127.5));
      if (coded[0] == 0 && coded[1] == 0) coded = {255, 255}; // all corners are one direction
    }
    for (const int c : coded) bytes += char(c);
  }
  return bytes;
}

// What points meet, a byte each: the distance in steps, from 1 for `reach` behind the other surface or more over 64 on
// it to 127 for `reach` in front of it; 0 where none is near; 128 more in free space.
constexpr int steps_of_reach = 63;
inline std::string packed_meetings(const std::vector<CR::Compared_point<Kernel>>& met, double reach)
{
  std::string bytes;
  bytes.reserve(met.size());
  for (const auto& m : met) {
    int code = 0;
    if (std::isfinite(m.distance))
      code =
          1 + steps_of_reach + int(std::lround(steps_of_reach * (std::min)((std::max)(m.distance / reach, -1.), 1.)));
    bytes += char(code + (m.is_in_free_space ? 128 : 0));
  }
  return bytes;
}

// What the points of one scan meet in all of the others, which lie as the motions to their frames say: the nearest
// surface, and any free space.
struct Other_scan
{
  const CR::Scan<Kernel>* scan;
  Transformation motion; // to its frame from that of the points
};

inline std::vector<CR::Compared_point<Kernel>> meetings_of(const Report_scan& scan,
                                                           const std::vector<Other_scan>& others)
{
  std::vector<CR::Compared_point<Kernel>> nearest(scan.points.size());
  if (scan.scan == nullptr) return nearest;
  for (const Other_scan& other : others) {
    if (other.scan == nullptr) continue;
    const auto met = CR::compare_points(scan.points, *scan.scan, *other.scan, other.motion);
    for (std::size_t i = 0; i < met.size(); ++i) {
      if (std::abs(met[i].distance) < std::abs(nearest[i].distance)) {
        nearest[i].distance = met[i].distance;
        nearest[i].normal = met[i].normal;
      }
      nearest[i].is_in_free_space = nearest[i].is_in_free_space || met[i].is_in_free_space;
    }
  }
  return nearest;
}

// Blocks of base64 of a page, by the identifiers that they have there.
class Report_bytes
{
public:
  // `bytes()` is called by write(), which runs all of them, on several threads.
  void add(const std::string& id, std::function<std::string()> bytes)
  {
    m_blocks.push_back({id, std::move(bytes), {}});
  }

  std::string html()
  {
    CGAL::for_each<CGAL::Parallel_if_available_tag>(m_blocks, [](Block& block) {
      block.text = to_base64(block.bytes());
      return true;
    });
    std::string text;
    for (const Block& block : m_blocks) {
      text += "<script type=\"text/plain\" id=\"" + block.id + "\">";
      text += block.text;
      text += "</script>\n";
    }
    return text;
  }

private:
  struct Block
  {
    std::string id;
    std::function<std::string()> bytes;
    std::string text;
  };
  std::vector<Block> m_blocks;
};

// Adds the places and normals of a scan.
inline Json add_scan(const Report_scan& scan, std::size_t index, Report_bytes& bytes)
{
  const Report_box box = box_of(scan.points);
  const std::string number = std::to_string(index);
  bytes.add("places_" + number, [&scan, box] { return packed_places(scan.points, box); });
  bytes.add("normals_" + number, [&scan] {
    return packed_normals(meetings_of(scan, {{scan.scan, Transformation(CGAL::IDENTITY)}}));
  });
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

#endif // CRUDE_REGISTER_REPORT_SCANS_H
