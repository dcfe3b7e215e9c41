// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_PREPARED_SCAN_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_PREPARED_SCAN_H

#include <CGAL/Crude_registration/internal/base/Counter_random.h>
#include <CGAL/Crude_registration/internal/lookup/Depth_buffer.h>
#include <CGAL/Crude_registration/internal/mesh/Flat_mesh.h>
#include <CGAL/Crude_registration/internal/sampling/Flat_range_image.h>
#include <CGAL/Crude_registration/internal/lookup/Point_grid.h>
#include <CGAL/Crude_registration/internal/base/Run_control.h>
#include <CGAL/Crude_registration/internal/lookup/cell_items.h>
#include <CGAL/Crude_registration/internal/mesh/mesh_geometry.h>
#include <CGAL/Crude_registration/internal/reduction/scan_frame.h>
#include <CGAL/Crude_registration/internal/lookup/Surfel_field.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The surface at one resolution.
struct Surfel_level
{
  float spacing = 0;
  std::vector<Surfel> surfels;
  std::vector<std::uint8_t> borders; // 1 where the surfels around do not surround it
  std::vector<float> weights;        // number of samples
  std::vector<std::int32_t> probes;  // surfels that stand for all, in an order such that each beginning does
  Surfel_field field;
  // How well the plane of one surfel tells the next one: three quarters of the neighbours are off by less. What noise
  // and curvature leave of a comparison of two scans at this resolution.
  float height_noise = 0; // in spacings
  float normal_noise = 0; // radians
};

// What is computed once per scan and used by every pair it takes part in, in a frame of the scan's own, so that nothing
// depends on the frame of the input or the order of its vertices but rounding.
struct Prepared_scan
{
  Rigid_motion own_from_input;
  std::size_t number_of_samples = 0;
  double spacing = 0;  // root of the area per sample
  double extent = 0;   // M = (Dx + Dy + Dz) / 3 in the own frame
  Surfel_level coarse; // a few thousand surfels: search
  Surfel_level fine;   // at most some ten thousand: judgement
  Depth_buffer depths;
};

// The samples (weight 1 each, or `weights`) of each cell of a grid whose cells meet at the origin, as surfels: means of
// positions and normals. Samples of one cell that face away from their mean normal are another sheet and make a
// surfel of their own. In the order of the cells; that of the samples does not matter but for rounding.
inline Surfel_level group_samples(const std::vector<Vector_f>& points, const std::vector<Vector_f>& normals,
                                  const std::vector<float>& weights, float cell, Run_control& control)
{
  std::vector<Cell_item> items(points.size());
  const float scale = 1 / cell;
  constexpr float limit = float(1 << 20) - 1;
  const auto coordinate = [&](float x) {
    return std::uint64_t(std::int64_t(std::floor((std::min)((std::max)(x * scale, -limit), limit))) + (1 << 20));
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    control.check(i);
    items[i] = {(coordinate(points[i][0]) << 42) | (coordinate(points[i][1]) << 21) | coordinate(points[i][2]),
                std::uint32_t(i)};
  }
  sort_cell_items(items, control);

  Surfel_level level;
  level.spacing = cell;
  struct Sum
  {
    Vector position = Vector::Zero(), normal = Vector::Zero();
    double weight = 0;
  };
  const auto emit = [&](const Sum& s) {
    const double length = s.normal.norm();
    if (!(length > 0.4 * s.weight)) return; // no surface with a side
    Surfel surfel;
    surfel.position = (s.position / s.weight).cast<float>();
    surfel.normal = (s.normal / length).cast<float>();
    level.surfels.push_back(surfel);
    level.weights.push_back(float(s.weight));
  };
  const auto is_less = [&](const Cell_item& a, const Cell_item& b) {
    const Vector_f &p = points[a.index], &q = points[b.index];
    return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3);
  };
  std::size_t cells = 0;
  for (std::size_t from = 0; from < items.size();) {
    control.check(++cells);
    Sum front, back;
    std::size_t to = from, least = from;
    Vector all = Vector::Zero();
    for (; to < items.size() && items[to].key == items[from].key; ++to) {
      all += normals[items[to].index].cast<double>();
      if (is_less(items[to], items[least])) least = to;
    }
    // Two sheets of the same size leave no mean normal.
    const Vector_f reference =
        all.norm() > 0.01 * double(to - from) ? Vector_f(all.cast<float>()) : normals[items[least].index];
    for (std::size_t k = from; k < to; ++k) {
      const std::size_t i = items[k].index;
      const double w = weights.empty() ? 1. : double(weights[i]);
      Sum& sum = normals[i].dot(reference) >= 0 ? front : back;
      sum.position += w * points[i].cast<double>();
      sum.normal += w * normals[i].cast<double>();
      sum.weight += w;
    }
    if (front.weight > 0) emit(front);
    if (back.weight > 0) emit(back);
    from = to;
  }
  return level;
}

// Borders and curvatures of the surfels of a level, from the surfels within 2.6 spacings: the second fundamental form
// that best explains how the normal changes, d n = W (d x), as Rusinkiewicz does on one face, here in the least squares
// sense over the neighbourhood (which is cut off at borders, not dropped).
inline void describe_surfels(Surfel_level& level)
{
  const float radius = 2.6f * level.spacing;
  std::vector<Vector> points;
  points.reserve(level.surfels.size());
  for (const Surfel& s : level.surfels) points.push_back(s.position.cast<double>());
  const Point_grid grid(points, double(radius));
  level.borders.assign(level.surfels.size(), 0);
  for (std::size_t i = 0; i < level.surfels.size(); ++i) {
    Surfel& s = level.surfels[i];
    const Vector_f u = s.normal.unitOrthogonal(), v = s.normal.cross(u);
    Vector_f mean = Vector_f::Zero();
    int count = 0;
    float xx = 0, xy = 0, yy = 0;
    Vector_f right = Vector_f::Zero();
    grid.for_each_within(points[i], double(radius), [&](std::int32_t j, double) {
      const Surfel& t = level.surfels[std::size_t(j)];
      if (std::size_t(j) == i || t.normal.dot(s.normal) < 0.3f) return;
      const Vector_f d = t.position - s.position, dn = t.normal - s.normal;
      mean += d;
      ++count;
      const float x = d.dot(u), y = d.dot(v), a = dn.dot(u), b = dn.dot(v);
      xx += x * x;
      xy += x * y;
      yy += y * y;
      right += Vector_f(x * a, y * a + x * b, y * b);
    });
    level.borders[i] = count < 5 || mean.norm() > 0.8f * level.spacing * float(count);
    Matrix_f left;
    left << xx, xy, 0, xy, xx + yy, xy, 0, xy, yy;
    left.diagonal().array() += 1e-6f * level.spacing * level.spacing;
    const Vector_f w = left.ldlt().solve(right); // W = [w0 w1; w1 w2]
    const float middle = 0.5f * (w[0] + w[2]), half = std::sqrt(0.25f * (w[0] - w[2]) * (w[0] - w[2]) + w[1] * w[1]);
    s.minimal_curvature = (middle - half) * level.spacing;
    s.maximal_curvature = (middle + half) * level.spacing;
  }
}

// Surfels that stand for the whole scan, in an order such that each beginning does: by turns from each direction of the
// normal (Rusinkiewicz and Levoy 2001, normal-space sampling), so that a wall or a floor, whatever its size, does not
// outvote all else.
inline std::vector<std::int32_t> choose_probes(const std::vector<Surfel>& surfels, std::size_t n)
{
  constexpr std::size_t side = 5; // cells along the edge of a cube's face
  std::vector<std::vector<std::int32_t>> bins(6 * side * side);
  for (const std::int32_t i : shuffled(surfels.size(), 2)) {
    const Vector_f& normal = surfels[std::size_t(i)].normal;
    int axis;
    const float largest = normal.cwiseAbs().maxCoeff(&axis);
    const auto cell = [&](float x) {
      return (std::min)(std::size_t((x / largest + 1) * 0.5f * float(side)), side - 1);
    };
    const std::size_t face = 2 * std::size_t(axis) + (normal[axis] < 0);
    bins[(face * side + cell(normal[(axis + 1) % 3])) * side + cell(normal[(axis + 2) % 3])].push_back(i);
  }
  std::vector<std::int32_t> order;
  n = (std::min)(n, surfels.size());
  for (std::size_t turn = 0; order.size() < n; ++turn)
    for (const auto& bin : bins)
      if (turn < bin.size() && order.size() < n) order.push_back(bin[turn]);
  return order;
}

// Measures the noise of a level on some hundred surfels and their neighbours, which the field finds.
inline void measure_noise(Surfel_level& level)
{
  std::vector<float> heights, turns;
  const std::size_t step = level.surfels.size() / 1000 + 1;
  for (std::size_t i = 0; i < level.surfels.size(); i += step) {
    const Surfel& s = level.surfels[i];
    const Vector_f u = s.normal.unitOrthogonal(), v = s.normal.cross(u);
    for (const Vector_f& d : {u, v, Vector_f(-u), Vector_f(-v)}) {
      const int j = level.field.nearest(s.position + level.spacing * d);
      if (j < 0 || std::size_t(j) == i) continue;
      const Surfel& t = level.surfels[std::size_t(j)];
      const float cosine = s.normal.dot(t.normal);
      if (cosine < 0.7f) continue; // an edge
      heights.push_back(std::abs(s.normal.dot(t.position - s.position)) / level.spacing);
      turns.push_back(std::acos((std::min)(1.f, cosine)));
    }
  }
  const auto third_quartile = [](std::vector<float>& values) {
    if (values.empty()) return 0.f;
    const auto q = values.begin() + std::ptrdiff_t(values.size() * 3 / 4);
    std::nth_element(values.begin(), q, values.end());
    return *q;
  };
  level.height_noise = third_quartile(heights);
  level.normal_noise = third_quartile(turns);
}

struct Preparation_parameters
{
  double fine_surfels = 15000;
  double coarse_surfels = 1800;
};

// The surface as samples with unit normals, in the frame of the scan's own.
struct Oriented_samples
{
  std::vector<Vector_f> points;
  std::vector<Vector_f> normals;
};

// Points about `distance` apart in rows along the longest edge of a face, at least one.
inline void sample_face(const Flat_mesh& mesh, std::array<std::int32_t, 3> face, const Rigid_motion& own,
                        double distance, Oriented_samples& samples)
{
  const auto squared_length = [&](int i) {
    return (mesh.points[std::size_t(face[std::size_t((i + 1) % 3)])] - mesh.points[std::size_t(face[std::size_t(i)])])
        .squaredNorm();
  };
  const int longest = squared_length(0) >= squared_length(1) ? (squared_length(0) >= squared_length(2) ? 0 : 2)
                                                             : (squared_length(1) >= squared_length(2) ? 1 : 2);
  std::rotate(face.begin(), face.begin() + longest, face.end());
  const Vector &a = mesh.points[std::size_t(face[0])], &b = mesh.points[std::size_t(face[1])],
               &c = mesh.points[std::size_t(face[2])];
  const Vector twice_area = area_vector(a, b, c), normal = unit_or_zero(twice_area);
  const double length = (b - a).norm();
  if (normal.isZero() || !(length > 0)) return;
  constexpr double most = 2000; // points in a row, rows
  const auto count = [&](double l) { return int(std::ceil((std::min)((std::max)(l / distance, 1.), most))); };
  const int rows = count(twice_area.norm() / length);
  for (int i = 0; i < rows; ++i) {
    const double up = (i + 0.5) / rows;
    const int points = count((1 - up) * length);
    for (int j = 0; j < points; ++j) {
      const double along = (1 - up) * (j + 0.5) / points;
      samples.points.push_back(own(Vector(a + along * (b - a) + up * (c - a))).cast<float>());
      samples.normals.push_back((own.rotation * normal).cast<float>());
    }
  }
}

// The vertices of the faces, as a scan's samples are; where the faces are so large that their vertices do not tell the
// surface (a CAD model), points spread evenly over the faces, about `distance` from each other. Samples that are seen
// at a grazing angle lie on the faces that bridge a depth edge: they are left out.
inline Oriented_samples samples_of_faces(const Flat_mesh& mesh, const std::vector<double>& areas,
                                         const Rigid_motion& own, const Flat_sensor& sensor, double distance,
                                         Run_control& control)
{
  Oriented_samples samples;
  const Matrix_f rotation = own.rotation.cast<float>();
  const double area = std::accumulate(areas.begin(), areas.end(), 0.);
  double area_of_large_faces = 0;
  for (const double a : areas)
    if (a > area / 1000) area_of_large_faces += a;
  if (sensor.kind == Flat_sensor::UNKNOWN && area_of_large_faces > 0.2 * area) {
    for (const auto& f : mesh.faces) {
      control.check();
      sample_face(mesh, f, own, distance, samples);
    }
    return samples;
  }
  constexpr double grazing = 0.12;
  const std::vector<Vector> normals = vertex_normals(mesh, control);
  samples.points.reserve(mesh.points.size());
  samples.normals.reserve(mesh.points.size());
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    control.check(i);
    if (normals[i].isZero()) continue;
    if (sensor.kind != Flat_sensor::UNKNOWN) {
      const Vector sight = sensor.towards(mesh.points[i]);
      if (-sight.dot(normals[i]) < grazing * sight.norm()) continue;
    }
    samples.points.push_back(own(mesh.points[i]).cast<float>());
    samples.normals.push_back(rotation * normals[i].cast<float>());
  }
  return samples;
}

// The direction in which a surface without a known sensor may have been seen: against the mean normal, if nearly all of
// it faces that way; null otherwise (closed meshes, several views).
inline Vector_f likely_viewing_direction(const Oriented_samples& samples)
{
  Vector_f mean = Vector_f::Zero();
  for (const Vector_f& n : samples.normals) mean += n;
  const float length = mean.norm();
  if (!(length > 0.5f * float(samples.normals.size()))) return Vector_f::Zero();
  mean /= length;
  std::size_t facing = 0;
  for (const Vector_f& n : samples.normals) facing += n.dot(mean) > 0;
  return double(facing) >= 0.97 * double(samples.normals.size()) ? Vector_f(-mean) : Vector_f(Vector_f::Zero());
}

// The share of the points that are further than `depth` behind what was seen in front of them. A scan's own points were
// all seen.
inline double hidden_share(const Depth_buffer& depths, const std::vector<Vector_f>& points, float depth)
{
  std::size_t known = 0, hidden = 0;
  for (const Vector_f& p : points) {
    const float d = depths.in_front(p);
    if (!(d > -0.5f * (std::numeric_limits<float>::max)())) continue;
    ++known;
    hidden += d < -depth;
  }
  return known == 0 ? 0 : double(hidden) / double(known);
}

// Prepares a scan for search. The sensor is in the frame of the mesh.
// A scan of fewer than four surfels cannot be registered; what it holds is prepared all the same.
// \throws Run_control::Stopped
inline Prepared_scan prepare_scan(const Flat_mesh& mesh, const Flat_sensor& sensor,
                                  const Preparation_parameters& parameters = {}, Run_control& control = to_the_end())
{
  Prepared_scan scan;
  Vector direction = Vector::Zero();
  if (sensor.kind == Flat_sensor::ORTHOGRAPHIC) direction = sensor.vector;
  if (sensor.kind == Flat_sensor::PERSPECTIVE) {
    for (const Vector& p : mesh.points) direction += unit_or_zero(p - sensor.vector);
    direction = unit_or_zero(direction);
  }
  control.check();
  const std::vector<double> areas = face_areas(mesh, control);
  scan.own_from_input = scan_frame(mesh, areas, direction, control);
  const Rigid_motion& own = scan.own_from_input;
  const Vector size = extent_in_frame(mesh, own, control);
  scan.extent = size.sum() / 3;
  const double area = std::accumulate(areas.begin(), areas.end(), 0.);
  if (!(area > 0)) return scan;

  // What is not a surface but dust takes larger cells, until the surfels can be numbered.
  const auto grouped = [&](const std::vector<Vector_f>& p, const std::vector<Vector_f>& n, const std::vector<float>& w,
                           float cell) {
    Surfel_level level = group_samples(p, n, w, cell, control);
    while (level.surfels.size() > Surfel_field::maximum_size) level = group_samples(p, n, w, cell *= 1.5f, control);
    return level;
  };
  // A surface cuts about 1.5 cells of a cubic grid for each area of the square of their edge length.
  const double finest = std::sqrt(1.5 * area / parameters.fine_surfels);
  const Oriented_samples samples = samples_of_faces(mesh, areas, own, sensor, 0.5 * finest, control);
  scan.number_of_samples = samples.points.size();
  if (samples.points.empty()) return scan;
  scan.spacing = std::sqrt(area / double(samples.points.size()));
  const double fine = (std::max)(2 * scan.spacing, finest);
  const double coarse = (std::max)(3.5 * scan.spacing, std::sqrt(1.5 * area / parameters.coarse_surfels));

  scan.fine = grouped(samples.points, samples.normals, {}, float(fine));
  std::vector<Vector_f> points, normals;
  points.reserve(scan.fine.surfels.size());
  normals.reserve(scan.fine.surfels.size());
  for (const Surfel& s : scan.fine.surfels) {
    points.push_back(s.position);
    normals.push_back(s.normal);
  }
  scan.coarse = grouped(points, normals, scan.fine.weights, float(coarse));
  control.check();
  describe_surfels(scan.coarse);
  scan.fine.field = Surfel_field(scan.fine.surfels, scan.fine.spacing, 1.6f * scan.fine.spacing);
  scan.coarse.field = Surfel_field(scan.coarse.surfels, 0.7f * scan.coarse.spacing, 2.f * scan.coarse.spacing);
  scan.fine.probes = choose_probes(scan.fine.surfels, 4000);
  scan.coarse.probes = choose_probes(scan.coarse.surfels, 600);
  measure_noise(scan.fine);
  measure_noise(scan.coarse);
  control.check();

  const float cell = float(2.2 * scan.spacing);
  const Matrix_f rotation = own.rotation.cast<float>();
  if (sensor.kind != Flat_sensor::UNKNOWN) {
    scan.depths = Depth_buffer(sensor.kind, own(sensor.vector).cast<float>(), rotation * direction.cast<float>(),
                               samples.points, cell, control);
  } else {
    const Vector_f likely = likely_viewing_direction(samples);
    if (!likely.isZero()) {
      Depth_buffer depths(Flat_sensor::ORTHOGRAPHIC, Vector_f::Zero(), likely, samples.points, cell, control);
      if (hidden_share(depths, samples.points, float(0.1 * scan.extent)) < 0.02) scan.depths = std::move(depths);
    }
  }
  return scan;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_REDUCTION_PREPARED_SCAN_H
