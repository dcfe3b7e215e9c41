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

#include <CGAL/for_each.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
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

// A picture of so many pixels, three bytes each, row by row from the top. It is drawn in bands, on several threads,
// each by itself: what is drawn does not depend on how many there are.
class Picture
{
public:
  Picture(int width, int height)
      : m_width(width), m_height(height), m_pixels(3 * std::size_t(width) * std::size_t(height))
  {}

  // Draws the surfaces as large as they fit.
  void draw(const std::vector<Surface>& surfaces, const View& view)
  {
    frame(surfaces, view);
    for (const Surface& s : surfaces) add(s);
    std::vector<Band> bands;
    for (int y = 0; y < m_height; y += rows_of_band) bands.push_back({fineness * y, {}, {}});
    const auto add_to_bands = [&](float top, float bottom, std::size_t index, std::vector<std::size_t> Band::*list) {
      const auto band_at = [&](float y) {
        return std::size_t((std::min)((std::max)(int(y) / (fineness * rows_of_band), 0), int(bands.size()) - 1));
      };
      for (std::size_t b = band_at(top); b <= band_at(bottom); ++b) (bands[b].*list).push_back(index);
    };
    for (std::size_t i = 0; i < m_triangles.size(); ++i) {
      const float ys[3] = {m_places[m_triangles[i][0]].y, m_places[m_triangles[i][1]].y, m_places[m_triangles[i][2]].y};
      add_to_bands((std::min)({ys[0], ys[1], ys[2]}), (std::max)({ys[0], ys[1], ys[2]}), i, &Band::triangles);
    }
    for (std::size_t i = 0; i < m_discs.size(); ++i) {
      const float y = m_places[m_discs[i].place].y, r = m_discs[i].radius + 1;
      add_to_bands(y - r, y + r, i, &Band::discs);
    }
    CGAL::for_each<CGAL::Parallel_if_available_tag>(bands, [this](const Band& band) {
      draw_band(band);
      return true;
    });
  }

  // The bytes of a PNG file; none where the program was built without libpng.
  std::string png() const
  {
    std::string file;
#ifdef CGAL_CRUDE_REGISTRATION_USE_PNG
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
    if (info == nullptr) throw std::bad_alloc();
    if (setjmp(png_jmpbuf(png)) != 0) { // there was no memory for the encoder
      png_destroy_write_struct(&png, &info);
      throw std::bad_alloc();
    }
    const auto append = [](png_structp p, png_bytep bytes, std::size_t size) {
      static_cast<std::string*>(png_get_io_ptr(p))->append(reinterpret_cast<const char*>(bytes), size);
    };
    png_set_write_fn(png, &file, append, nullptr);
    png_set_IHDR(png, info, png_uint_32(m_width), png_uint_32(m_height), 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    // The fastest that makes no larger file than the default does, measured on pictures of scans.
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_UP);
    png_set_compression_level(png, 1);
    png_set_compression_strategy(png, 3); // Z_RLE of zlib
    png_set_compression_buffer_size(png, m_pixels.size() / 4);
    png_write_info(png, info);
    for (int y = 0; y < m_height; ++y) png_write_row(png, m_pixels.data() + 3 * std::size_t(m_width) * std::size_t(y));
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
#endif
    return file;
  }

private:
  static constexpr int fineness = 2; // so many samples a pixel, each way
  static constexpr int rows_of_band = 40;

  struct Place // in samples from the left and from the top; towards the viewer
  {
    float x, y, depth;
    std::uint32_t colour = 0;
  };
  struct Disc
  {
    std::size_t place;
    float radius;
  };
  struct Band // of rows of samples from `top` on, with what may be seen in it
  {
    int top;
    std::vector<std::size_t> triangles, discs;
  };
  // The samples of a band.
  struct Samples
  {
    int width, top, bottom;
    std::vector<float> depths;
    std::vector<std::uint32_t> colours;

    void put(int x, int y, float depth, std::uint32_t colour)
    {
      const std::size_t i = std::size_t(y - top) * std::size_t(width) + std::size_t(x);
      if (depth <= depths[i]) return;
      depths[i] = depth;
      colours[i] = colour;
    }
  };

  void frame(const std::vector<Surface>& surfaces, const View& view)
  {
    m_view = view;
    constexpr double infinity = (std::numeric_limits<double>::max)();
    double low_x = infinity, low_y = infinity, high_x = -infinity, high_y = -infinity;
    for (const Surface& s : surfaces)
      for (const Point& p : s.points) {
        const Direction d = p - CGAL::ORIGIN;
        const double along_x = d * view.right, along_y = d * view.up;
        low_x = (std::min)(low_x, along_x);
        high_x = (std::max)(high_x, along_x);
        low_y = (std::min)(low_y, along_y);
        high_y = (std::max)(high_y, along_y);
      }
    const double width = fineness * m_width, height = fineness * m_height;
    constexpr double filled = 0.94;
    const double x = high_x - low_x, y = high_y - low_y;
    m_scale =
        x > 0 || y > 0 ? filled * (std::min)(width / (std::max)(x, 1e-9 * y), height / (std::max)(y, 1e-9 * x)) : 1;
    m_x = width / 2 - m_scale * (low_x + high_x) / 2;
    m_y = height / 2 + m_scale * (low_y + high_y) / 2;
    m_depth = 0;
    for (const Surface& s : surfaces) // floats tell depths near nought apart
      if (!s.points.empty()) m_depth = -m_scale * ((s.points.front() - CGAL::ORIGIN) * view.towards_viewer);
  }

  Place place(const Point& p) const
  {
    const Direction d = p - CGAL::ORIGIN;
    return {float(m_x + m_scale * (d * m_view.right)), float(m_y - m_scale * (d * m_view.up)),
            float(m_depth + m_scale * (d * m_view.towards_viewer))};
  }

  // A colour under a normal, whose coordinates are along the view: right, up and towards the viewer. Lit from above the
  // viewer's left shoulder; the back of a surface is darker.
  static std::uint32_t shaded(const Colour& colour, const std::array<float, 3>& n)
  {
    const float length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    float light = 0.8F;
    if (length > 0) {
      constexpr float root_of_six = 2.4494897F;
      const float cosine = (2 * n[2] + n[1] - n[0]) / (root_of_six * length);
      light = n[2] >= 0 ? 0.3F + 0.75F * (std::max)(cosine, 0.F) : 0.2F + 0.35F * (std::max)(-cosine, 0.F);
    }
    const auto part = [light](int c) { return std::uint32_t((std::min)(light * float(c) + 0.5F, 255.F)); };
    return part(colour.red) | part(colour.green) << 8 | part(colour.blue) << 16;
  }

  void add(const Surface& s)
  {
    const std::size_t first = m_places.size();
    m_places.reserve(first + s.points.size());
    for (const Point& p : s.points) m_places.push_back(place(p));
    std::vector<std::array<float, 3>> normals(s.points.size(), {0, 0, 0});
    if (s.triangles.empty()) {
      const double radius = (std::min)((std::max)(0.6 * s.spacing * m_scale, 1.), 40.);
      for (std::size_t i = 0; i < s.points.size(); ++i) m_discs.push_back({first + i, float(radius)});
      for (std::size_t i = 0; i < s.normals.size(); ++i)
        normals[i] = {float(s.normals[i] * m_view.right), float(s.normals[i] * m_view.up),
                      float(s.normals[i] * m_view.towards_viewer)};
    }
    m_triangles.reserve(m_triangles.size() + s.triangles.size());
    for (const auto& t : s.triangles) {
      m_triangles.push_back({first + t[0], first + t[1], first + t[2]});
      const Place &a = m_places[first + t[0]], &b = m_places[first + t[1]], &c = m_places[first + t[2]];
      const float u[3] = {b.x - a.x, a.y - b.y, b.depth - a.depth}, v[3] = {c.x - a.x, a.y - c.y, c.depth - a.depth};
      const float n[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
      for (const std::size_t corner : t)
        for (std::size_t k = 0; k < 3; ++k) normals[corner][k] += n[k];
    }
    for (std::size_t i = 0; i < normals.size(); ++i) m_places[first + i].colour = shaded(s.colour, normals[i]);
  }

  void draw_band(const Band& band)
  {
    const int width = fineness * m_width;
    Samples samples{width, band.top, (std::min)(band.top + fineness * rows_of_band, fineness * m_height), {}, {}};
    const std::size_t number = std::size_t(width) * std::size_t(samples.bottom - samples.top);
    constexpr std::uint32_t white = 0xffffff;
    samples.depths.assign(number, -(std::numeric_limits<float>::max)());
    samples.colours.assign(number, white);
    for (const std::size_t i : band.triangles) draw_triangle(m_triangles[i], samples);
    for (const std::size_t i : band.discs) draw_disc(m_discs[i], samples);

    // The mean of the samples of a pixel, red and blue at once.
    static_assert(fineness == 2, "four samples are a pixel");
    std::uint8_t* pixel = m_pixels.data() + 3 * std::size_t(m_width) * std::size_t(band.top / fineness);
    for (int y = samples.top; y < samples.bottom; y += fineness) {
      const std::uint32_t* row = samples.colours.data() + std::size_t(y - samples.top) * std::size_t(width);
      for (int x = 0; x < m_width; ++x, row += fineness) {
        constexpr std::uint32_t red_and_blue = 0xff00ff, green = 0x00ff00;
        const std::uint32_t c[4] = {row[0], row[1], row[width], row[width + 1]};
        const std::uint32_t rb =
            (c[0] & red_and_blue) + (c[1] & red_and_blue) + (c[2] & red_and_blue) + (c[3] & red_and_blue) + 0x020002;
        const std::uint32_t g = (c[0] & green) + (c[1] & green) + (c[2] & green) + (c[3] & green) + 0x000200;
        *pixel++ = std::uint8_t(rb >> 2);
        *pixel++ = std::uint8_t(g >> 10);
        *pixel++ = std::uint8_t(rb >> 18);
      }
    }
  }

  void draw_disc(const Disc& disc, Samples& samples) const
  {
    const Place& p = m_places[disc.place];
    const int r = int(std::ceil(disc.radius)), cx = int(std::floor(p.x)), cy = int(std::floor(p.y));
    for (int y = (std::max)(cy - r, samples.top); y <= (std::min)(cy + r, samples.bottom - 1); ++y)
      for (int x = (std::max)(cx - r, 0); x <= (std::min)(cx + r, samples.width - 1); ++x) {
        const int dx = x - cx, dy = y - cy;
        if (float(dx * dx + dy * dy) <= disc.radius * disc.radius) samples.put(x, y, p.depth, p.colour);
      }
  }

  // The first sample of a row, or row, whose middle is not before x: without a call of a rounding function.
  static int first_middle(float x)
  {
    return int((std::max)(x, 0.F) + 0.5F);
  }

  // The samples whose middles are in the triangle: from where one edge crosses a row to where another one does. Both
  // triangles at an edge compute the same crossing, so that there is no gap between them.
  void draw_triangle(const std::array<std::size_t, 3>& corners, Samples& samples) const
  {
    const Place *a = &m_places[corners[0]], *b = &m_places[corners[1]], *c = &m_places[corners[2]];
    const auto mean = [&](int shift) {
      const std::uint32_t sum = (a->colour >> shift & 255) + (b->colour >> shift & 255) + (c->colour >> shift & 255);
      return (2 * sum + 3) / 6 << shift; // rounded
    };
    const std::uint32_t colour = mean(0) | mean(8) | mean(16);
    // Of a triangle smaller than the distance of samples one of them stands for it.
    const int ax = int(a->x), ay = int(a->y);
    if (ay >= samples.top && ay < samples.bottom && ax >= 0 && ax < samples.width)
      samples.put(ax, ay, a->depth, colour);
    const float area = (b->x - a->x) * (c->y - a->y) - (c->x - a->x) * (b->y - a->y);
    if (!(std::abs(area) > 0)) return;
    const float along_x = ((b->depth - a->depth) * (c->y - a->y) - (c->depth - a->depth) * (b->y - a->y)) / area;
    const float along_y = ((c->depth - a->depth) * (b->x - a->x) - (b->depth - a->depth) * (c->x - a->x)) / area;

    if (b->y < a->y) std::swap(a, b); // from the top down
    if (c->y < b->y) std::swap(b, c);
    if (b->y < a->y) std::swap(a, b);
    const auto slope = [](const Place& p, const Place& q) { return q.y > p.y ? (q.x - p.x) / (q.y - p.y) : 0.F; };
    const float whole = slope(*a, *c);
    const float corner_depth = a->depth - a->x * along_x - a->y * along_y;
    int y = (std::max)(first_middle(a->y), samples.top);
    for (const auto& [p, q] : {std::make_pair(a, b), std::make_pair(b, c)}) {
      const float part = slope(*p, *q);
      const int end = (std::min)(first_middle(q->y), samples.bottom);
      for (; y < end; ++y) {
        const float middle = float(y) + 0.5F;
        const float x1 = a->x + (middle - a->y) * whole, x2 = p->x + (middle - p->y) * part;
        const int x_end = (std::min)(first_middle((std::max)(x1, x2)), samples.width);
        const float row_depth = corner_depth + middle * along_y;
        for (int x = first_middle((std::min)(x1, x2)); x < x_end; ++x)
          samples.put(x, y, row_depth + (float(x) + 0.5F) * along_x, colour);
      }
    }
  }

  int m_width, m_height;
  std::vector<std::uint8_t> m_pixels;
  View m_view;
  double m_scale = 1, m_x = 0, m_y = 0, m_depth = 0;
  std::vector<Place> m_places;
  std::vector<std::array<std::size_t, 3>> m_triangles;
  std::vector<Disc> m_discs;
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
  constexpr int width = 800, height = 640;
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
