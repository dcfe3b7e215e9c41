// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_CALIBRATION_SIMULATED_SET_H
#define CGAL_CRUDE_REGISTRATION_CALIBRATION_SIMULATED_SET_H

// Sets of simulated range scans with their true poses: bodies, bodies on a pedestal, machined parts and rooms.

#include "package_random.h"

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/Range_image.h>
#include <CGAL/Crude_registration/Scan.h>
#include <CGAL/Crude_registration/internal/lookup/Point_grid.h>
#include <CGAL/Crude_registration/sampling/triangulate_range_image.h>
#include <CGAL/Crude_registration/simulation/make_statue.h>
#include <CGAL/Crude_registration/simulation/simulate_range_image.h>

#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/transform.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/boost/graph/generators.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace benchmark_tools {

// Lengths are in sampling distances.
struct Sensor_model
{
  std::size_t samples = 30000; // about, of the body
  double noise = 0.2;          // independent from sample to sample
  double waves = 0;            // noise that some samples side by side have in common
  double quantization = 0;
  double drop_out = 0.01, grazing_drop_out = 0.5;
  // Share of the samples that are lost in patches, as dark or shining places are, and what is overexposed.
  double lost = 0;
  bool is_perspective = false;
  double warp = 0; // noise that a third of the image has in common, as of a camera that drifts or is badly calibrated
};

// From fine to coarse, clean to noisy, straight to warped: samples, noise, waves, quantization, drop-out, grazing
// drop-out, lost, perspective, warp.
inline std::vector<Sensor_model> all_sensors()
{
  return {{30000, 0.05, 0, 0, 0, 0.3, 0, false},
          {30000, 0.3, 0, 0, 0.02, 0.7, 0.15, true},
          {10000, 0.5, 1.5, 0.5, 0.02, 0.7, 0.1, true},
          {15000, 1, 1, 0, 0.05, 0.8, 0.2, true},
          {7000, 2, 0, 0, 0.2, 0.8, 0.05, true},
          {2000, 0.2, 0, 0, 0.01, 0.5, 0.05, false},
          {500, 0.1, 0, 0, 0, 0.3, 0, false},
          {150000, 0.5, 0.5, 1, 0.01, 0.7, 0.1, true},
          {30000, 0.2, 0, 2, 0.1, 0.9, 0.3, false},
          {30000, 0.2, 0.2, 0, 0.01, 0.5, 0.1, true, 1.5},
          {150000, 0.3, 1, 0.5, 0.01, 0.7, 0.1, true, 5},
          {12000, 0.5, 1, 0, 0.02, 0.7, 0.1, true, 2.5}};
}

class Simulated_set
{
public:
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
  using View = CGAL::Crude_registration::Simulated_range_image<Kernel>;
  using Vector = CGAL::Crude_registration::internal::Vector;
  using Rigid_motion = CGAL::Crude_registration::internal::Rigid_motion;

  // `kind`: statue, pedestal, plinth (a large pedestal), part or room. Views of bodies go around the upright axis in
  // steps of `degrees`.
  Simulated_set(const std::string& kind, unsigned seed, std::size_t views, double degrees, const Sensor_model& sensor)
      : Simulated_set(kind, seed, views, degrees, std::vector<Sensor_model>{sensor})
  {}

  // The same by several sensors, which take turns.
  Simulated_set(const std::string& kind, unsigned seed, std::size_t views, double degrees,
                const std::vector<Sensor_model>& sensors)
  {
    const Random random(seed * 7919u + 17u);
    Mesh& mesh = m_mesh;
    if (kind == "room") add_room(mesh, seed);
    else if (kind == "part") add_part(mesh, seed);
    else CGAL::Crude_registration::make_statue(mesh, 96, CGAL::Crude_registration::parameters::random_seed(seed));
    if (kind == "pedestal" || kind == "plinth") {
      const CGAL::Bbox_3 b = CGAL::Polygon_mesh_processing::bbox(mesh);
      const double side = kind == "plinth" ? 1.7 : 1.3, height = kind == "plinth" ? 1.3 : 0.7;
      CGAL::Crude_registration::make_pedestal(mesh, side, b.zmin() + 0.15 - height, b.zmin() + 0.15);
    }
    const CGAL::Crude_registration::Simulated_scene scene(mesh);
    const CGAL::Bbox_3 box = CGAL::Polygon_mesh_processing::bbox(mesh);
    for (std::size_t i = 0; i < views; ++i) {
      const Sensor_model& sensor = sensors[i % sensors.size()];
      const double angle = double(i) * degrees * CGAL_PI / 180 + 0.3;
      Camera camera;
      if (kind == "room") {
        const auto u = [&](std::uint64_t k) { return random.uniform(8 * i + k); };
        camera.viewpoint = Kernel::Point_3(1 + 1.6 * u(0), 0.6 + 1.2 * u(1), 1 + 0.7 * u(2));
        const Kernel::Vector_3 d(std::cos(angle), std::sin(angle), -0.35 + 0.4 * u(3));
        camera.target = camera.viewpoint + 2 * d;
        camera.up = Kernel::Vector_3(0, 0, 1);
        camera.is_perspective = true;
        camera.columns = std::size_t(std::ceil(std::sqrt(double(sensor.samples) * 4 / 3)));
        camera.rows = camera.columns * 3 / 4;
        camera.spacing =
            std::sqrt(CGAL::squared_distance(camera.viewpoint, camera.target)) * 1.15 / double(camera.columns);
      } else {
        camera =
            Camera::framing(box, Kernel::Vector_3(std::cos(angle), std::sin(angle), -0.25), 200, sensor.is_perspective);
        const View sketch = scene.range_image(camera);
        const double scale = std::sqrt(double(sketch.image.points().size()) / double(sensor.samples));
        camera.spacing *= scale;
        camera.columns = camera.rows = std::size_t(std::ceil(200 / scale));
      }
      camera.noise = sensor.noise;
      camera.quantization = sensor.quantization;
      camera.drop_out = sensor.drop_out;
      camera.grazing_drop_out = sensor.grazing_drop_out;
      camera.seed = std::uint64_t(seed) * 1000003u + i;
      View view = scene.range_image(camera);
      view.image = spoiled(view.image, sensor, camera);
      m_views.push_back(view);
      m_spacings.push_back(camera.spacing);
    }
    for (const View& v : m_views) {
      std::vector<Vector> points;
      for (const auto& p : v.image.points()) points.push_back(Vector(p.x(), p.y(), p.z()));
      m_points.push_back(points);
    }
  }

  const Mesh& mesh() const { return m_mesh; } // in the frame of the scene
  const std::vector<View>& views() const { return m_views; }
  const std::vector<Vector>& points(std::size_t i) const { return m_points[i]; }
  double spacing(std::size_t i) const { return m_spacings[i]; }

  Rigid_motion motion(std::size_t source, std::size_t target) const { return pose(target).inverse() * pose(source); }

  // The share of the source's points with one of the target within two sampling distances.
  double overlap(std::size_t source, std::size_t target) const
  {
    const double reach = 2 * m_spacings[target];
    const CGAL::Crude_registration::internal::Point_grid grid(m_points[target], reach);
    const Rigid_motion m = motion(source, target);
    std::size_t near = 0;
    for (const Vector& p : m_points[source]) {
      bool found = false;
      grid.for_each_within(m(p), reach, [&](std::int32_t, double) { found = true; });
      near += found;
    }
    return m_points[source].empty() ? 0 : double(near) / double(m_points[source].size());
  }

private:
  Rigid_motion pose(std::size_t i) const
  {
    return CGAL::Crude_registration::internal::to_rigid_motion(m_views[i].scene_from_scan);
  }

  using Image = CGAL::Crude_registration::Range_image<Kernel>;
  using Camera = CGAL::Crude_registration::Range_camera<Kernel>;
  using Random = Package_random;

  // With the noise of the sensor that is correlated, and without what it loses in patches.
  static Image spoiled(const Image& image, const Sensor_model& sensor, const Camera& camera)
  {
    const Random random(camera.seed * 2654435761u + 11u);
    const std::size_t columns = image.columns(), rows = image.rows();
    // Discs around samples, until that many are lost.
    std::vector<bool> is_lost(image.points().size(), false);
    std::vector<std::pair<std::size_t, std::size_t>> cells; // of the samples
    for (std::size_t r = 0; r < rows; ++r)
      for (std::size_t c = 0; c < columns; ++c)
        if (image.grid()[r * columns + c] >= 0) cells.push_back({c, r});
    std::size_t lost = 0;
    constexpr std::uint64_t most_discs = 50;
    for (std::uint64_t k = 0; k < most_discs && double(lost) < sensor.lost * double(cells.size()); ++k) {
      const auto centre = cells[std::size_t(random.uniform(2 * k) * double(cells.size()))];
      const double radius = (0.1 + 0.2 * random.uniform(2 * k + 1)) * std::sqrt(double(cells.size()));
      for (const auto& [c, r] : cells) {
        const double x = double(c) - double(centre.first), y = double(r) - double(centre.second);
        const auto i = std::size_t(image.grid()[r * columns + c]);
        if (is_lost[i] || x * x + y * y > radius * radius) continue;
        is_lost[i] = true;
        ++lost;
      }
    }
    // Between normal random numbers at every `period`-th sample.
    const auto wave = [&](std::size_t c, std::size_t r, std::size_t period, std::uint64_t stream) {
      const double x = double(c % period) / double(period), y = double(r % period) / double(period);
      const auto at = [&](std::size_t i, std::size_t j) {
        return random.normal(stream << 32 | (std::uint64_t(c / period + i) << 16 | (r / period + j)));
      };
      return (1 - x) * ((1 - y) * at(0, 0) + y * at(0, 1)) + x * ((1 - y) * at(1, 0) + y * at(1, 1));
    };
    Image result(columns, rows);
    result.set_sensor(image.sensor());
    for (const auto& [c, r] : cells) {
      const auto i = std::size_t(image.grid()[r * columns + c]);
      if (is_lost[i]) continue;
      const auto& p = image.points()[i];
      double shift = 0; // in sampling distances
      if (sensor.waves > 0) shift += sensor.waves * wave(c, r, 8, 1);
      if (sensor.warp > 0) shift += sensor.warp * wave(c, r, (columns + 2) / 3, 2);
      const Kernel::Vector_3 sight = sensor.is_perspective ? p - CGAL::ORIGIN : Kernel::Vector_3(0, 0, -1);
      result.set_sample(c, r, p + (shift * camera.spacing / std::sqrt(sight.squared_length())) * sight);
    }
    return result;
  }

  // Its faces are convex.
  static void add_in_triangles(Mesh& body, Mesh& mesh)
  {
    const std::vector<Mesh::Face_index> faces(body.faces().begin(), body.faces().end());
    for (const auto f : faces)
      for (auto h = body.halfedge(f); body.degree(body.face(h)) > 3;)
        h = CGAL::Euler::split_face(h, body.next(body.next(h)), body);
    CGAL::copy_face_graph(body, mesh);
  }

  static void add_box(Mesh& mesh, double x, double y, double z, double dx, double dy, double dz)
  {
    const auto p = [&](int i, int j, int k) { return Kernel::Point_3(x + i * dx, y + j * dy, z + k * dz); };
    Mesh box;
    CGAL::make_hexahedron(p(0, 0, 0), p(1, 0, 0), p(1, 1, 0), p(0, 1, 0), p(0, 1, 1), p(0, 0, 1), p(1, 0, 1),
                          p(1, 1, 1), box);
    add_in_triangles(box, mesh);
  }

  static void add_cylinder(Mesh& mesh, const Kernel::Point_3& base, double radius, double height)
  {
    Mesh prism;
    CGAL::make_regular_prism(64, prism, base, height, radius, true);
    add_in_triangles(prism, mesh);
  }

  // Boxes and cylinders that stand on a plate and in each other.
  static void add_part(Mesh& mesh, unsigned seed)
  {
    const Random random(seed * 104729u + 3u);
    std::uint64_t n = 0;
    const auto between = [&](double a, double b) { return a + (b - a) * random.uniform(n++); };
    add_box(mesh, -0.8, -0.6, 0, 1.6, 1.2, 0.15);
    for (int k = 0; k < 9; ++k) {
      const double x = between(-0.7, 0.5), y = between(-0.5, 0.3), z = 0.15;
      const double a = between(0.1, 0.4), b = between(0.1, 0.4), c = between(0.15, 0.9);
      if (k % 3 == 2) add_cylinder(mesh, Kernel::Point_3(x, z, -y), a / 2, c);
      else add_box(mesh, x, y, z, a, b, c);
    }
  }

  // 4 x 3 x 2.5 units, from the origin: walls and furniture.
  static void add_room(Mesh& mesh, unsigned seed)
  {
    const Random random(seed * 1299709u + 5u);
    std::uint64_t n = 0;
    const auto between = [&](double a, double b) { return a + (b - a) * random.uniform(n++); };
    add_box(mesh, 0, 0, 0, 4, 3, 2.5);
    for (int k = 0; k < 12; ++k) {
      // Along a wall.
      const double a = between(0.2, 0.9), b = between(0.2, 0.6), c = between(0.3, 1.6), t = between(0, 1);
      const double lift = k % 3 == 0 ? between(0.3, 1.2) : 0;
      switch (k % 4) {
      case 0:
        add_box(mesh, t * (4 - a), 0.003, lift, a, b, c);
        break;
      case 1:
        add_box(mesh, t * (4 - a), 2.997 - b, lift, a, b, c);
        break;
      case 2:
        add_box(mesh, 0.003, t * (3 - a), lift, b, a, c);
        break;
      default:
        add_box(mesh, 3.997 - b, t * (3 - a), lift, b, a, c);
      }
    }
    for (unsigned k = 0; k < 2; ++k) {
      Mesh statue;
      CGAL::Crude_registration::make_statue(statue, 40, CGAL::Crude_registration::parameters::random_seed(seed + k));
      using Affine = CGAL::Aff_transformation_3<Kernel>;
      const double x = between(0.8, 3.2), y = between(0.6, 2.4);
      CGAL::Polygon_mesh_processing::transform(
          Affine(CGAL::TRANSLATION, Kernel::Vector_3(x, y, 0.45)) * Affine(CGAL::SCALING, 0.45), statue);
      CGAL::copy_face_graph(statue, mesh);
    }
  }

  Mesh m_mesh;
  std::vector<View> m_views;
  std::vector<std::vector<Vector>> m_points;
  std::vector<double> m_spacings;
};

// A scan of an image, or of the mesh of its samples alone, without its sensor.
inline CGAL::Crude_registration::Scan<Simulated_set::Kernel>
scan_of(const CGAL::Crude_registration::Range_image<Simulated_set::Kernel>& image, bool with_sensor)
{
  if (with_sensor) return CGAL::Crude_registration::Scan<Simulated_set::Kernel>(image);
  Simulated_set::Mesh mesh;
  CGAL::Crude_registration::triangulate_range_image(image, mesh);
  return CGAL::Crude_registration::Scan<Simulated_set::Kernel>(mesh);
}

// As seen in a mirror; the columns the other way round, so that faces keep their side.
inline CGAL::Crude_registration::Range_image<Simulated_set::Kernel>
mirrored(const CGAL::Crude_registration::Range_image<Simulated_set::Kernel>& image)
{
  CGAL::Crude_registration::Range_image<Simulated_set::Kernel> result(image.columns(), image.rows());
  result.set_sensor(image.sensor());
  for (std::size_t r = 0; r < image.rows(); ++r)
    for (std::size_t c = 0; c < image.columns(); ++c) {
      const auto i = image.grid()[r * image.columns() + c];
      if (i < 0) continue;
      const auto& p = image.points()[std::size_t(i)];
      result.set_sample(image.columns() - 1 - c, r, Simulated_set::Kernel::Point_3(-p.x(), p.y(), p.z()));
    }
  return result;
}

} // namespace benchmark_tools

#endif // CGAL_CRUDE_REGISTRATION_CALIBRATION_SIMULATED_SET_H
