// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// Parallel projection, a depth buffer and shading.

#include "picture.h"

#include "files.h"

#include <CGAL/Crude_registration/IO/write_file.h>

#include <CGAL/for_each.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <ostream>
#include <utility>

namespace {

// From where surfaces are looked at.
struct View
{
  Direction towards_viewer, up, right; // of unit length
};

// The side of the surfaces that their normals show, upright: the axis z is up where that can be seen, else y.
View view_of(const std::vector<Placed_surface>& surfaces)
{
  Direction sum = CGAL::NULL_VECTOR;
  double number = 0;
  for (const Placed_surface& placed : surfaces) {
    const Surface& s = *placed.surface;
    constexpr std::size_t enough = 4096; // of each, evenly spread: the direction is a mean
    Direction sum_of_surface = CGAL::NULL_VECTOR;
    const auto step = [](std::size_t n) { return n / enough + 1; };
    for (std::size_t i = 0; i < s.normals.size(); i += step(s.normals.size()), ++number)
      sum_of_surface = sum_of_surface + s.normals[i];
    for (std::size_t i = 0; i < s.triangles.size(); i += step(s.triangles.size())) {
      const auto& t = s.triangles[i];
      const Direction n = CGAL::cross_product(s.points[t[1]] - s.points[t[0]], s.points[t[2]] - s.points[t[0]]);
      const double length = std::sqrt(n.squared_length());
      if (!(length > 0)) continue;
      sum_of_surface = sum_of_surface + n / length;
      ++number;
    }
    sum = sum + sum_of_surface.transform(placed.motion);
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

// Of a vertex: along the view (right, up, towards the viewer), then in samples from the left, from the top, and towards
// the viewer.
struct Place
{
  float x = 0, y = 0, depth = 0;
  float light = 0;
};

// A surface on its way into the picture.
struct Layer
{
  const Surface* surface;
  Colour colour;
  std::vector<Place> places;
  float radius = 0; // of a point, where there are no triangles
  float low_x, high_x, low_y, high_y;
  std::vector<std::vector<std::uint32_t>> bands; // in each of the picture the triangles, or points, that may be seen

  bool has_triangles() const { return !surface->triangles.empty(); }
};

// The samples of a band.
struct Samples
{
  int width, top, bottom;
  std::vector<float> depths;
  std::vector<std::uint32_t> colours;

  Samples(int w, int t, int b) : width(w), top(t), bottom(b)
  {
    const std::size_t number = std::size_t(width) * std::size_t(bottom - top);
    constexpr std::uint32_t white = 0xffffff;
    depths.assign(number, -(std::numeric_limits<float>::max)());
    colours.assign(number, white);
  }

  std::size_t row(int y) const { return std::size_t(y - top) * std::size_t(width); }

  void put(int x, int y, float depth, std::uint32_t colour)
  {
    const std::size_t i = row(y) + std::size_t(x);
    if (depth > depths[i]) {
      depths[i] = depth;
      colours[i] = colour;
    }
  }

  // A row of a plane from begin to end, of which the depth at x = 0 is given. Without a branch: which samples are
  // hidden cannot be foretold.
  void put_row(int begin, int end, int y, float depth_at_0, float along_x, std::uint32_t colour)
  {
    float* const d = depths.data() + row(y);
    std::uint32_t* const c = colours.data() + row(y);
    for (int x = begin; x < end; ++x) {
      const float depth = depth_at_0 + (float(x) + 0.5F) * along_x;
      const bool is_seen = depth > d[x];
      c[x] = is_seen ? colour : c[x];
      d[x] = is_seen ? depth : d[x];
    }
  }
};

// A picture of so many pixels. It is drawn in bands, on several threads, each by itself: what is drawn does not depend
// on how many there are.
class Picture
{
public:
  Picture(const std::vector<Placed_surface>& surfaces, bool have_common_frame, int width, int height)
      : m_width(width), m_height(height), m_view(view_of(surfaces))
  {
    for (std::size_t i = 0; i < surfaces.size(); ++i)
      m_layers.push_back({surfaces[i].surface, colour_of_scan(i), {}, 0, 0, 0, 0, 0, {}});
    if (surfaces.empty()) return;
    const Point origin = first_point(surfaces);
    for_each_layer([&](std::size_t i) { look_at(surfaces[i].motion, origin, m_layers[i]); });
    if (!have_common_frame) set_apart();
    frame();
    for_each_layer([&](std::size_t i) { shade(m_layers[i]); });
  }

  // The bytes of a PNG file.
  std::string png() const
  {
    std::vector<Png_band> bands(number_of_bands());
    for_each_index(bands.size(), [&](std::size_t b) { bands[b] = band(b); });
    return png_file(m_width, m_height, bands);
  }

private:
  static constexpr int fineness = 2; // so many samples a pixel, each way
  static constexpr int rows_of_band = 40;

  std::size_t number_of_bands() const { return std::size_t((m_height + rows_of_band - 1) / rows_of_band); }

  template <class Function>
  static void for_each_index(std::size_t n, const Function& f)
  {
    std::vector<std::size_t> indices(n);
    for (std::size_t i = 0; i < n; ++i) indices[i] = i;
    CGAL::for_each<CGAL::Parallel_if_available_tag>(indices, [&f](std::size_t i) {
      f(i);
      return true;
    });
  }

  template <class Function>
  void for_each_layer(const Function& f)
  {
    for_each_index(m_layers.size(), f);
  }

  // Floats tell places near it apart.
  static Point first_point(const std::vector<Placed_surface>& surfaces)
  {
    for (const Placed_surface& s : surfaces)
      if (!s.surface->points.empty()) return s.surface->points.front().transform(s.motion);
    return CGAL::ORIGIN;
  }

  // The places of a layer along the view, and the box of them.
  void look_at(const Transformation& motion, const Point& origin, Layer& layer) const
  {
    const Direction axes[3] = {m_view.right, m_view.up, m_view.towards_viewer};
    std::array<std::array<double, 4>, 3> m{};
    for (std::size_t i = 0; i < 3; ++i) {
      for (int k = 0; k < 4; ++k)
        for (int l = 0; l < 3; ++l) m[i][std::size_t(k)] += axes[i][l] * motion.m(l, k);
      m[i][3] -= axes[i] * (origin - CGAL::ORIGIN);
    }
    const auto along = [&m](std::size_t i, const Point& p) {
      return float(m[i][0] * p.x() + m[i][1] * p.y() + m[i][2] * p.z() + m[i][3]);
    };
    layer.low_x = layer.low_y = (std::numeric_limits<float>::max)();
    layer.high_x = layer.high_y = -layer.low_x;
    layer.places.reserve(layer.surface->points.size());
    for (const Point& p : layer.surface->points) {
      const Place place = {along(0, p), along(1, p), along(2, p)};
      layer.low_x = (std::min)(layer.low_x, place.x);
      layer.high_x = (std::max)(layer.high_x, place.x);
      layer.low_y = (std::min)(layer.low_y, place.y);
      layer.high_y = (std::max)(layer.high_y, place.y);
      layer.places.push_back(place);
    }
    for (std::size_t i = 0; i < layer.surface->normals.size(); ++i) {
      const Direction& d = layer.surface->normals[i];
      std::array<float, 3> n{};
      for (std::size_t k = 0; k < 3; ++k) n[k] = float(m[k][0] * d.x() + m[k][1] * d.y() + m[k][2] * d.z());
      layer.places[i].light = light_on(n);
    }
  }

  // Side by side, where no common frame is known: moves each behind the one before it, to the right.
  void set_apart()
  {
    float end = 0;
    bool is_first = true;
    for (Layer& layer : m_layers) {
      if (layer.places.empty()) continue;
      constexpr float gap = 0.1F;
      const float width = layer.high_x - layer.low_x;
      double middle = 0;
      for (const Place& p : layer.places) middle += double(p.y) / double(layer.places.size());
      const float x = is_first ? 0 : end + gap * width - layer.low_x, y = float(-middle);
      for (Place& p : layer.places) {
        p.x += x;
        p.y += y;
      }
      layer.low_x += x;
      layer.high_x += x;
      layer.low_y += y;
      layer.high_y += y;
      end = layer.high_x;
      is_first = false;
    }
  }

  // As large as all fit.
  void frame()
  {
    float low_x = (std::numeric_limits<float>::max)(), low_y = low_x, high_x = -low_x, high_y = -low_x;
    for (const Layer& layer : m_layers) {
      low_x = (std::min)(low_x, layer.low_x);
      high_x = (std::max)(high_x, layer.high_x);
      low_y = (std::min)(low_y, layer.low_y);
      high_y = (std::max)(high_y, layer.high_y);
    }
    const float width = float(fineness * m_width), height = float(fineness * m_height);
    constexpr float filled = 0.94F, thin = 1e-6F;
    const float x = high_x - low_x, y = high_y - low_y;
    m_scale =
        x > 0 || y > 0 ? filled * (std::min)(width / (std::max)(x, thin * y), height / (std::max)(y, thin * x)) : 1;
    m_x = width / 2 - m_scale * (low_x + high_x) / 2;
    m_y = height / 2 + m_scale * (low_y + high_y) / 2;
  }

  // Of a normal, whose coordinates are along the view: right, up and towards the viewer. Lit from above the viewer's
  // left shoulder; the back of a surface is darker.
  static float light_on(const std::array<float, 3>& n)
  {
    const float length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    if (!(length > 0)) return 0.8F;
    constexpr float root_of_six = 2.4494897F;
    const float cosine = (2 * n[2] + n[1] - n[0]) / (root_of_six * length);
    return n[2] >= 0 ? 0.3F + 0.75F * (std::max)(cosine, 0.F) : 0.2F + 0.35F * (std::max)(-cosine, 0.F);
  }

  static std::uint32_t shaded(const Colour& colour, float light)
  {
    const auto part = [light](int c) { return std::uint32_t((std::min)(light * float(c) + 0.5F, 255.F)); };
    return part(colour.red) | part(colour.green) << 8 | part(colour.blue) << 16;
  }

  // The places in samples, with their light, and the bands that they are seen in.
  void shade(Layer& layer) const
  {
    const Surface& s = *layer.surface;
    for (Place& p : layer.places) {
      p.x = m_x + m_scale * p.x;
      p.y = m_y - m_scale * p.y;
      p.depth *= m_scale;
    }
    layer.bands.resize(number_of_bands());
    const auto add_to_bands = [&layer](float top, float bottom, std::size_t index) {
      const auto band_at = [&](float y) {
        return std::size_t((std::min)((std::max)(int(y) / (fineness * rows_of_band), 0), int(layer.bands.size()) - 1));
      };
      const std::size_t last = band_at(bottom);
      for (std::size_t b = band_at(top); b <= last; ++b) layer.bands[b].push_back(std::uint32_t(index));
    };
    if (layer.has_triangles()) {
      std::vector<std::array<float, 3>> normals(s.points.size(), {0, 0, 0});
      for (std::size_t i = 0; i < s.triangles.size(); ++i) {
        const auto& t = s.triangles[i];
        const Place &a = layer.places[t[0]], &b = layer.places[t[1]], &c = layer.places[t[2]];
        const float u[3] = {b.x - a.x, a.y - b.y, b.depth - a.depth}, v[3] = {c.x - a.x, a.y - c.y, c.depth - a.depth};
        const float n[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
        for (const std::size_t corner : t)
          for (std::size_t k = 0; k < 3; ++k) normals[corner][k] += n[k];
        add_to_bands((std::min)((std::min)(a.y, b.y), c.y), (std::max)((std::max)(a.y, b.y), c.y), i);
      }
      for (std::size_t i = 0; i < normals.size(); ++i) layer.places[i].light = light_on(normals[i]);
    } else {
      const float most = 40, radius = float(0.6 * s.spacing) * m_scale;
      layer.radius = (std::min)((std::max)(radius, 1.F), most);
      for (std::size_t i = 0; i < s.points.size(); ++i)
        add_to_bands(layer.places[i].y - layer.radius - 1, layer.places[i].y + layer.radius + 1, i);
    }
  }

  Png_band band(std::size_t index) const
  {
    const int first = int(index) * rows_of_band, rows = (std::min)(rows_of_band, m_height - first);
    Samples samples(fineness * m_width, fineness * first, fineness * (first + rows));
    for (const Layer& layer : m_layers)
      for (const std::uint32_t i : layer.bands[index]) {
        if (layer.has_triangles()) draw_triangle(layer, layer.surface->triangles[i], samples);
        else draw_disc(layer, layer.places[i], samples);
      }

    // The mean of the samples of a pixel, red and blue at once.
    static_assert(fineness == 2, "four samples are a pixel");
    std::vector<std::uint8_t> pixels(3 * std::size_t(m_width) * std::size_t(rows));
    std::uint8_t* pixel = pixels.data();
    for (int y = samples.top; y < samples.bottom; y += fineness) {
      const std::uint32_t *upper = samples.colours.data() + samples.row(y), *lower = upper + samples.width;
      for (int x = 0; x < m_width; ++x, upper += fineness, lower += fineness) {
        constexpr std::uint32_t red_and_blue = 0xff00ff, green = 0x00ff00;
        const std::uint32_t c[4] = {upper[0], upper[1], lower[0], lower[1]};
        const std::uint32_t rb =
            (c[0] & red_and_blue) + (c[1] & red_and_blue) + (c[2] & red_and_blue) + (c[3] & red_and_blue) + 0x020002;
        const std::uint32_t g = (c[0] & green) + (c[1] & green) + (c[2] & green) + (c[3] & green) + 0x000200;
        *pixel++ = std::uint8_t(rb >> 2);
        *pixel++ = std::uint8_t(g >> 10);
        *pixel++ = std::uint8_t(rb >> 18);
      }
    }
    return png_band(pixels.data(), m_width, rows, index + 1 == number_of_bands());
  }

  static void draw_disc(const Layer& layer, const Place& p, Samples& samples)
  {
    const int r = int(std::ceil(layer.radius)), cx = int(std::floor(p.x)), cy = int(std::floor(p.y));
    const std::uint32_t colour = shaded(layer.colour, p.light);
    for (int y = (std::max)(cy - r, samples.top); y <= (std::min)(cy + r, samples.bottom - 1); ++y)
      for (int x = (std::max)(cx - r, 0); x <= (std::min)(cx + r, samples.width - 1); ++x) {
        const int dx = x - cx, dy = y - cy;
        if (float(dx * dx + dy * dy) <= layer.radius * layer.radius) samples.put(x, y, p.depth, colour);
      }
  }

  // The first sample of a row, or row, whose middle is not before x: without a call of a rounding function.
  static int first_middle(float x) { return int((std::max)(x, 0.F) + 0.5F); }

  // The samples whose middles are in the triangle: from where one edge crosses a row to where another one does. Both
  // triangles at an edge compute the same crossing, so that there is no gap between them.
  static void draw_triangle(const Layer& layer, const std::array<std::size_t, 3>& corners, Samples& samples)
  {
    const Place *a = &layer.places[corners[0]], *b = &layer.places[corners[1]], *c = &layer.places[corners[2]];
    const std::uint32_t colour = shaded(layer.colour, (a->light + b->light + c->light) * (1.F / 3));
    // Of a triangle smaller than the distance of samples one of them stands for it.
    const int ax = int(a->x), ay = int(a->y);
    if (ay >= samples.top && ay < samples.bottom && ax >= 0 && ax < samples.width)
      samples.put(ax, ay, a->depth, colour);
    const float area = (b->x - a->x) * (c->y - a->y) - (c->x - a->x) * (b->y - a->y);
    if (!(std::abs(area) > 0)) return;
    const float share = 1 / area; // the depth is a plane over x and y
    const float along_x = ((b->depth - a->depth) * (c->y - a->y) - (c->depth - a->depth) * (b->y - a->y)) * share;
    const float along_y = ((c->depth - a->depth) * (b->x - a->x) - (b->depth - a->depth) * (c->x - a->x)) * share;

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
        samples.put_row(first_middle((std::min)(x1, x2)), (std::min)(first_middle((std::max)(x1, x2)), samples.width),
                        y, corner_depth + middle * along_y, along_x, colour);
      }
    }
  }

  int m_width, m_height;
  View m_view;
  float m_scale = 1, m_x = 0, m_y = 0; // to samples, from what is along the view
  std::vector<Layer> m_layers;
};

} // namespace

void check_picture(const std::optional<std::string>& file)
{
  if (!file) return;
  if (!can_write_png()) throw Usage_error("--picture needs libpng, without which the program was built");
  check_output(*file);
}

std::string picture_of(const std::vector<Placed_surface>& surfaces, bool have_common_frame)
{
  constexpr int width = 800, height = 640;
  return Picture(surfaces, have_common_frame, width, height).png();
}

void write_picture(const std::string& file, const std::vector<Placed_surface>& surfaces, bool have_common_frame)
{
  const std::string png = picture_of(surfaces, have_common_frame);
  CR::write_file(file, [&](std::ostream& out) { out << png; });
}
