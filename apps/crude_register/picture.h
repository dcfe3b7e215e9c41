// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CRUDE_REGISTER_PICTURE_H
#define CRUDE_REGISTER_PICTURE_H

// Pictures of surfaces, drawn without a graphics card: parallel projection, a depth buffer and shading.

#include "surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#ifdef CGAL_CRUDE_REGISTRATION_USE_PNG
#include <png.h>
#endif

// From where surfaces are looked at.
struct View
{
  Direction towards_viewer, up, right; // of unit length
};

// The side of the surfaces that their normals show, upright: the axis z is up where that can be seen, else y.
inline View view_of(const std::vector<Surface>& surfaces)
{
  Direction sum = CGAL::NULL_VECTOR;
  double number = 0;
  for (const Surface& s : surfaces) {
    for (const Direction& n : s.normals) sum = sum + n;
    number += double(s.normals.size());
    for (const auto& t : s.triangles) {
      const Direction n = CGAL::cross_product(s.points[t[1]] - s.points[t[0]], s.points[t[2]] - s.points[t[0]]);
      const double length = std::sqrt(n.squared_length());
      if (!(length > 0)) continue;
      sum = sum + n / length;
      ++number;
    }
  }
  const auto unit = [](const Direction& d) { return d / std::sqrt(d.squared_length()); };
  View view;
  constexpr double one_sided = 0.1; // mean of unit vectors: of a closed surface it is nought
  const bool is_one_sided = number > 0 && sum.squared_length() > one_sided * one_sided * number * number;
  view.towards_viewer = is_one_sided ? unit(sum) : unit(Direction(1, -2, 1));
  const Direction upright = std::abs(view.towards_viewer.z()) < 0.75 ? Direction(0, 0, 1) : Direction(0, 1, 0);
  view.right = unit(CGAL::cross_product(upright, view.towards_viewer));
  view.up = CGAL::cross_product(view.towards_viewer, view.right);
  return view;
}

// A picture of so many pixels, three bytes each, row by row from the top.
class Picture
{
public:
  Picture(int width, int height) : m_width(width), m_height(height) {}

  // Draws the surfaces as large as they fit.
  void draw(const std::vector<Surface>& surfaces, const View& view)
  {
    m_colours.assign(samples(), {255, 255, 255});
    m_depths.assign(samples(), -(std::numeric_limits<float>::max)());
    frame(surfaces, view);
    for (const Surface& s : surfaces) {
      if (s.triangles.empty()) draw_points(s);
      else draw_triangles(s);
    }
  }

  std::vector<std::uint8_t> pixels() const
  {
    std::vector<std::uint8_t> bytes;
    for (int y = 0; y < m_height; ++y)
      for (int x = 0; x < m_width; ++x)
        for (std::size_t c = 0; c < 3; ++c) {
          constexpr int number = fineness * fineness;
          int sum = number / 2; // rounded
          for (int k = 0; k < number; ++k)
            sum += m_colours[at(fineness * x + k % fineness, fineness * y + k / fineness)][c];
          bytes.push_back(std::uint8_t(sum / number));
        }
    return bytes;
  }

  // The bytes of a PNG file; none where the program was built without libpng.
  std::string png() const
  {
    std::string file;
#ifdef CGAL_CRUDE_REGISTRATION_USE_PNG
    const std::vector<std::uint8_t> bytes = pixels();
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = png_uint_32(m_width);
    image.height = png_uint_32(m_height);
    image.format = PNG_FORMAT_RGB;
    image.flags = PNG_IMAGE_FLAG_FAST; // for a file a little larger
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    file.resize(size);
    if (png_image_write_to_memory(&image, file.data(), &size, 0, bytes.data(), 0, nullptr) == 0) size = 0;
    file.resize(size);
#endif
    return file;
  }

private:
  static constexpr int fineness = 2; // so many samples a pixel, each way

  using Rgb = std::array<std::uint8_t, 3>;
  struct Place
  {
    double x, y, depth; // in samples from the left and from the top; towards the viewer
  };

  std::size_t samples() const
  {
    return std::size_t(m_width) * std::size_t(m_height) * fineness * fineness;
  }
  std::size_t at(int x, int y) const
  {
    return std::size_t(y) * std::size_t(m_width) * fineness + std::size_t(x);
  }

  void frame(const std::vector<Surface>& surfaces, const View& view)
  {
    m_view = view;
    constexpr double infinity = (std::numeric_limits<double>::max)();
    double low_x = infinity, low_y = infinity, high_x = -infinity, high_y = -infinity;
    for (const Surface& s : surfaces)
      for (const Point& p : s.points) {
        const Direction d = p - CGAL::ORIGIN;
        low_x = (std::min)(low_x, d * view.right);
        high_x = (std::max)(high_x, d * view.right);
        low_y = (std::min)(low_y, d * view.up);
        high_y = (std::max)(high_y, d * view.up);
      }
    const double width = fineness * m_width, height = fineness * m_height;
    constexpr double filled = 0.94;
    const double x = high_x - low_x, y = high_y - low_y;
    m_scale =
        x > 0 || y > 0 ? filled * (std::min)(width / (std::max)(x, 1e-9 * y), height / (std::max)(y, 1e-9 * x)) : 1;
    m_x = width / 2 - m_scale * (low_x + high_x) / 2;
    m_y = height / 2 + m_scale * (low_y + high_y) / 2;
  }

  Place place(const Point& p) const
  {
    const Direction d = p - CGAL::ORIGIN;
    return {m_x + m_scale * (d * m_view.right), m_y - m_scale * (d * m_view.up), m_scale * (d * m_view.towards_viewer)};
  }

  void put(int x, int y, double depth, const Rgb& colour)
  {
    if (x < 0 || y < 0 || x >= fineness * m_width || y >= fineness * m_height) return;
    const std::size_t i = at(x, y);
    if (float(depth) <= m_depths[i]) return;
    m_depths[i] = float(depth);
    m_colours[i] = colour;
  }

  // Lit from above the viewer's left shoulder; the back of a surface is darker.
  Rgb shaded(const Surface& s, const Direction& normal) const
  {
    const double length = std::sqrt(normal.squared_length());
    double light = 0.8;
    if (length > 0) {
      const double front = normal * m_view.towards_viewer / length;
      const Direction lamp = (m_view.towards_viewer * 2 + m_view.up - m_view.right) / std::sqrt(6.);
      const double cosine = normal * lamp / length;
      light = front >= 0 ? 0.3 + 0.75 * (std::max)(cosine, 0.) : 0.2 + 0.35 * (std::max)(-cosine, 0.);
    }
    const auto part = [light](int c) { return std::uint8_t(std::lround((std::min)(light * c, 255.))); };
    return {part(s.colour.red), part(s.colour.green), part(s.colour.blue)};
  }

  void draw_points(const Surface& s)
  {
    const double radius = (std::min)((std::max)(0.6 * s.spacing * m_scale, 1.), 40.);
    const int r = int(std::ceil(radius));
    for (std::size_t i = 0; i < s.points.size(); ++i) {
      const Place q = place(s.points[i]);
      const Rgb colour = shaded(s, i < s.normals.size() ? s.normals[i] : Direction(CGAL::NULL_VECTOR));
      for (int y = -r; y <= r; ++y)
        for (int x = -r; x <= r; ++x)
          if (x * x + y * y <= radius * radius)
            put(int(std::floor(q.x)) + x, int(std::floor(q.y)) + y, q.depth, colour);
    }
  }

  void draw_triangles(const Surface& s)
  {
    std::vector<Direction> normals(s.points.size(), CGAL::NULL_VECTOR);
    for (const auto& t : s.triangles) {
      const Direction n = CGAL::cross_product(s.points[t[1]] - s.points[t[0]], s.points[t[2]] - s.points[t[0]]);
      for (const std::size_t v : t) normals[v] = normals[v] + n;
    }
    std::vector<Place> places;
    for (const Point& p : s.points) places.push_back(place(p));
    for (const auto& t : s.triangles) {
      const Place &a = places[t[0]], &b = places[t[1]], &c = places[t[2]];
      const Rgb colour = shaded(s, normals[t[0]] + normals[t[1]] + normals[t[2]]);
      const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
      // Smaller than the distance of samples: one of them stands for it.
      put(int(std::floor(a.x)), int(std::floor(a.y)), a.depth, colour);
      if (!(std::abs(area) > 0)) continue;
      const double inverse = 1 / area;
      const int width = fineness * m_width, height = fineness * m_height;
      const int x0 = (std::max)(0, int(std::floor((std::min)({a.x, b.x, c.x})))),
                x1 = (std::min)(width - 1, int(std::ceil((std::max)({a.x, b.x, c.x})))),
                y0 = (std::max)(0, int(std::floor((std::min)({a.y, b.y, c.y})))),
                y1 = (std::min)(height - 1, int(std::ceil((std::max)({a.y, b.y, c.y}))));
      for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x) {
          const double px = x + 0.5, py = y + 0.5;
          const double u = ((px - a.x) * (c.y - a.y) - (c.x - a.x) * (py - a.y)) * inverse,
                       v = ((b.x - a.x) * (py - a.y) - (px - a.x) * (b.y - a.y)) * inverse;
          if (u < 0 || v < 0 || u + v > 1) continue;
          put(x, y, a.depth + u * (b.depth - a.depth) + v * (c.depth - a.depth), colour);
        }
    }
  }

  int m_width, m_height;
  View m_view;
  double m_scale = 1, m_x = 0, m_y = 0;
  std::vector<Rgb> m_colours;
  std::vector<float> m_depths;
};

// Side by side, where no common frame is known: moves each behind the one before it, to the right.
inline void set_apart(std::vector<Surface>& surfaces, const View& view)
{
  double end = 0;
  bool is_first = true;
  for (Surface& s : surfaces) {
    if (s.points.empty()) continue;
    double low = (std::numeric_limits<double>::max)(), high = -low;
    Direction middle = CGAL::NULL_VECTOR;
    for (const Point& p : s.points) {
      low = (std::min)(low, (p - CGAL::ORIGIN) * view.right);
      high = (std::max)(high, (p - CGAL::ORIGIN) * view.right);
      middle = middle + (p - CGAL::ORIGIN) / double(s.points.size());
    }
    constexpr double gap = 0.1;
    const double start = is_first ? low : end + gap * (high - low);
    const Direction shift = view.right * (start - low) - view.up * (middle * view.up);
    for (Point& p : s.points) p = p + shift;
    end = start + high - low;
    is_first = false;
  }
}

constexpr bool can_write_pictures()
{
#ifdef CGAL_CRUDE_REGISTRATION_USE_PNG
  return true;
#else
  return false;
#endif
}

// Told before the work: that there is no libpng, or no folder to write to.
inline void check_picture(const std::optional<std::string>& file)
{
  if (!file) return;
  if (!can_write_pictures()) throw Usage_error("--picture needs libpng, without which the program was built");
  check_output(*file);
}

// The surfaces, which lie in a common frame or, where there is none, are set apart, as the bytes of a PNG file.
inline std::string picture_of(std::vector<Surface> surfaces, bool have_common_frame)
{
  for (std::size_t i = 0; i < surfaces.size(); ++i) surfaces[i].colour = colour_of_scan(i);
  const View view = view_of(surfaces);
  if (!have_common_frame) set_apart(surfaces, view);
  constexpr int width = 1000, height = 800;
  Picture picture(width, height);
  picture.draw(surfaces, view);
  return picture.png();
}

inline void write_picture(const std::string& file, std::vector<Surface> surfaces, bool have_common_frame)
{
  const std::string png = picture_of(std::move(surfaces), have_common_frame);
  CR::write_file(file, [&](std::ostream& out) { out << png; });
}

#endif // CRUDE_REGISTER_PICTURE_H
