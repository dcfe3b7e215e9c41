// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_BENCHMARK_RIVAL_MOTIONS_H
#define CGAL_CRUDE_REGISTRATION_BENCHMARK_RIVAL_MOTIONS_H

// Whether a view of a known surface determines its pose: by descents from starts all over the space of motions, which
// share no code with the registration.

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/compute_normal.h>
#include <CGAL/Polygon_mesh_processing/distance.h>
#include <CGAL/Surface_mesh.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <random>
#include <vector>

namespace benchmark_tools {

struct Pose_of_view
{
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  Eigen::Vector3d operator()(const Eigen::Vector3d& p) const { return rotation * p + translation; }
  Pose_of_view operator*(const Pose_of_view& other) const
  {
    return {rotation * other.rotation, (*this)(other.translation)};
  }
};

class Known_surface
{
public:
  using Mesh = CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3>;

  explicit Known_surface(const Mesh& mesh) : m_mesh(mesh), m_tree(m_mesh.faces_begin(), m_mesh.faces_end(), m_mesh)
  {
    m_tree.accelerate_distance_queries();
    for (const auto f : m_mesh.faces()) {
      const auto n = CGAL::Polygon_mesh_processing::compute_face_normal(f, m_mesh);
      m_normals.emplace_back(n.x(), n.y(), n.z());
    }
    const CGAL::Bbox_3 box = m_tree.bbox();
    const Eigen::Vector3d low(box.xmin(), box.ymin(), box.zmin()), high(box.xmax(), box.ymax(), box.zmax());
    m_centre = (low + high) / 2;
    m_size = high - low;
    // A third of the size around it: what is farther away comes near at once, or does not matter.
    m_cell = 1.7 * m_size.maxCoeff() / side;
    m_field.resize(std::size_t(side) * side * side);
    for (int x = 0; x < side; ++x)
      for (int y = 0; y < side; ++y)
        for (int z = 0; z < side; ++z)
          m_field[index(x, y, z)] =
              nearest(m_centre + m_cell * (Eigen::Vector3d(x, y, z).array() + 0.5 - side / 2.).matrix());
    using Point = Mesh::Point;
    std::vector<Point> samples;
    namespace PMP = CGAL::Polygon_mesh_processing;
    PMP::sample_triangle_mesh(mesh, std::back_inserter(samples),
                              PMP::parameters::use_grid_sampling(true).grid_spacing(m_size.maxCoeff() / 40));
    for (const Point& p : samples) m_samples.emplace_back(p.x(), p.y(), p.z());
    find_symmetries();
  }

  struct Nearest
  {
    Eigen::Vector3d point, normal;
  };

  Nearest nearest(const Eigen::Vector3d& p) const
  {
    const auto [q, face] = m_tree.closest_point_and_primitive({p.x(), p.y(), p.z()});
    return {Eigen::Vector3d(q.x(), q.y(), q.z()), m_normals[std::size_t(face)]};
  }

  double diagonal() const { return m_size.norm(); }

  // The rigid motions that map the surface onto itself, as far as they are turns about the axes through the middle of
  // its box, by multiples of 7.5 degrees, and half turns about an axis at right angles to these: such are the parts'.
  const std::vector<Pose_of_view>& symmetries() const { return m_symmetries; }

  // The largest share of the points, of which few stand for all, that a motion other than `truth`, or than what its
  // symmetries make of that, brings as near as `tolerance`; with normals: facing the same way.
  struct Rivals
  {
    double share = 0, share_with_normals = 0, share_of_truth = 0;
  };

  Rivals rivals(const std::vector<Eigen::Vector3d>& points, const Pose_of_view& truth, double tolerance) const
  {
    Rivals result;
    Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& p : points) centroid += p / double(points.size());
    std::vector<Eigen::Vector3d> normals; // as they truly are
    for (const Eigen::Vector3d& p : points) normals.push_back(truth.rotation.transpose() * nearest(truth(p)).normal);
    result.share_of_truth = share(points, normals, truth, tolerance).first;
    std::mt19937_64 random(1);
    const auto between = [&](std::size_t n) { return std::size_t(random() % n); };
    std::vector<Eigen::Vector3d> few;
    for (int i = 0; i < 60; ++i) few.push_back(points[between(points.size())] - centroid);
    struct End
    {
      double near;
      Pose_of_view pose;
    };
    std::vector<End> ends;
    for (const Eigen::Matrix3d& turn : turns())
      for (int k = 0; k < 27; ++k) {
        Pose_of_view pose = {turn, m_centre +
                                       (Eigen::Vector3d(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1) / 3).cwiseProduct(m_size)};
        for (double scale = 0.2 * m_size.maxCoeff(); scale > tolerance; scale *= 0.75) step(few, scale, pose);
        std::size_t near = 0;
        for (const Eigen::Vector3d& p : few) {
          const Eigen::Vector3d q = pose(p);
          const Nearest& n = in_field(q);
          near += std::abs(n.normal.dot(q - n.point)) < 2 * tolerance;
        }
        const Pose_of_view whole = {pose.rotation, pose.translation - pose.rotation * centroid};
        if (near > 48 && !is_right(whole, truth, centroid)) ends.push_back({double(near), pose});
      }
    std::stable_sort(ends.begin(), ends.end(), [](const End& a, const End& b) { return a.near > b.near; });
    if (ends.size() > 400) ends.resize(400);
    for (const End& end : ends) {
      Pose_of_view pose = {end.pose.rotation, end.pose.translation - end.pose.rotation * centroid};
      if (share(points, normals, pose, 3 * tolerance).first < 0.8) continue;
      std::vector<Eigen::Vector3d> many;
      for (std::size_t i = 0; i < points.size(); i += points.size() / 500 + 1) many.push_back(points[i] - centroid);
      Pose_of_view refined = end.pose;
      for (int i = 0; i < 20; ++i) exact_step(many, tolerance, refined);
      // A start may be better than its end, where it is not nearness that draws.
      for (const Pose_of_view& p : {end.pose, refined}) {
        pose = {p.rotation, p.translation - p.rotation * centroid};
        if (is_right(pose, truth, centroid)) continue;
        const auto [all, facing] = share(points, normals, pose, tolerance);
        result.share = (std::max)(result.share, all);
        result.share_with_normals = (std::max)(result.share_with_normals, facing);
      }
    }
    return result;
  }

  // Of the points, of which few stand for all, those that a motion brings as near as `tolerance`.
  double share_near(const std::vector<Eigen::Vector3d>& points, const Pose_of_view& pose, double tolerance) const
  {
    return share(points, points, pose, tolerance).first;
  }

  // By 5 degrees, and 5 % of the diagonal at the view's centroid, up to symmetry.
  bool is_right(const Pose_of_view& pose, const Pose_of_view& truth, const Eigen::Vector3d& centroid) const
  {
    return std::any_of(m_symmetries.begin(), m_symmetries.end(), [&](const Pose_of_view& s) {
      const Pose_of_view wanted = s * truth;
      const double angle = Eigen::AngleAxisd(Eigen::Matrix3d(pose.rotation * wanted.rotation.transpose())).angle();
      return angle < 5 * CGAL_PI / 180 && (pose(centroid) - wanted(centroid)).norm() < 0.05 * diagonal();
    });
  }

private:
  using Primitive = CGAL::AABB_face_graph_triangle_primitive<Mesh>;
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits<CGAL::Exact_predicates_inexact_constructions_kernel, Primitive>>;

  static constexpr int side = 56;

  static std::size_t index(int x, int y, int z)
  {
    return (std::size_t(z) * side + std::size_t(y)) * side + std::size_t(x);
  }

  const Nearest& in_field(const Eigen::Vector3d& p) const
  {
    const Eigen::Vector3d q = ((p - m_centre) / m_cell).array() + side / 2.;
    const auto cell = [](double x) { return (std::min)((std::max)(int(x), 0), side - 1); };
    return m_field[index(cell(q[0]), cell(q[1]), cell(q[2]))];
  }

  // Gauss and Newton, point to plane, with Cauchy's weights: the few points of a rival that have no counterpart would
  // draw it away from those that have one.
  template <class Lookup>
  static void step(const std::vector<Eigen::Vector3d>& points, double scale, Pose_of_view& pose, const Lookup& lookup)
  {
    Eigen::Matrix<double, 6, 6> a = Eigen::Matrix<double, 6, 6>::Identity() * 1e-6;
    Eigen::Matrix<double, 6, 1> b = Eigen::Matrix<double, 6, 1>::Zero();
    for (const Eigen::Vector3d& p : points) {
      const Eigen::Vector3d turned = pose.rotation * p, q = turned + pose.translation;
      const Nearest n = lookup(q);
      Eigen::Matrix<double, 6, 1> row;
      row << turned.cross(n.normal), n.normal;
      const double weight = 1 / (1 + (q - n.point).squaredNorm() / (scale * scale));
      a.noalias() += weight * row * row.transpose();
      b -= weight * n.normal.dot(q - n.point) * row;
    }
    const Eigen::Matrix<double, 6, 1> x = a.llt().solve(b);
    const Eigen::Vector3d w = x.head<3>();
    const double angle = (std::min)(w.norm(), 0.5);
    if (angle > 0) pose.rotation = Eigen::AngleAxisd(angle, w.normalized()).toRotationMatrix() * pose.rotation;
    pose.translation += x.tail<3>();
  }

  void step(const std::vector<Eigen::Vector3d>& points, double scale, Pose_of_view& pose) const
  {
    step(points, scale, pose, [&](const Eigen::Vector3d& q) -> const Nearest& { return in_field(q); });
  }

  void exact_step(const std::vector<Eigen::Vector3d>& points, double scale, Pose_of_view& pose) const
  {
    step(points, scale, pose, [&](const Eigen::Vector3d& q) { return nearest(q); });
  }

  // Of the points near, and of the points near and facing the same way.
  std::pair<double, double> share(const std::vector<Eigen::Vector3d>& points,
                                  const std::vector<Eigen::Vector3d>& normals, const Pose_of_view& pose,
                                  double tolerance) const
  {
    std::size_t near = 0, facing = 0, n = 0;
    for (std::size_t i = 0; i < points.size(); i += points.size() / 1000 + 1, ++n) {
      const Eigen::Vector3d q = pose(points[i]);
      const Nearest s = nearest(q);
      if ((q - s.point).norm() > tolerance) continue;
      ++near;
      facing += s.normal.dot(pose.rotation * normals[i]) > 0;
    }
    return {double(near) / double(n), double(facing) / double(n)};
  }

  // Turns drawn evenly from all: no other is farther than some 20 degrees from the nearest.
  static std::vector<Eigen::Matrix3d> turns()
  {
    std::mt19937_64 random(2);
    std::vector<Eigen::Matrix3d> result;
    const auto next = [&random] { return 2 * (double(random() >> 11) * 0x1p-53) - 1; };
    while (result.size() < 1000) {
      const double w = next(), x = next(), y = next(), z = next();
      const Eigen::Quaterniond q(w, x, y, z);
      if (q.norm() <= 1 && q.norm() > 0.1) result.push_back(q.normalized().toRotationMatrix());
    }
    return result;
  }

  void find_symmetries()
  {
    for (int axis = 0; axis < 3; ++axis)
      for (int flip = 0; flip < 2; ++flip)
        for (int k = 0; k < 48; ++k) {
          const Eigen::Vector3d u = Eigen::Vector3d::Unit(axis), v = Eigen::Vector3d::Unit((axis + 1) % 3);
          Eigen::Matrix3d turn = Eigen::AngleAxisd(k * CGAL_PI / 24, u).toRotationMatrix();
          if (flip) turn = turn * Eigen::AngleAxisd(CGAL_PI, v).toRotationMatrix();
          const Pose_of_view pose = {turn, m_centre - turn * m_centre};
          const double exact = 1e-6 * diagonal();
          const bool is_one = std::all_of(m_samples.begin(), m_samples.end(), [&](const Eigen::Vector3d& p) {
            const Eigen::Vector3d q = pose(p);
            return (nearest(q).point - q).norm() < exact;
          });
          const bool is_known = std::any_of(m_symmetries.begin(), m_symmetries.end(),
                                            [&](const Pose_of_view& s) { return (s.rotation - turn).norm() < 1e-6; });
          if (is_one && !is_known) m_symmetries.push_back(pose);
        }
  }

  const Mesh m_mesh;
  Tree m_tree;
  std::vector<Eigen::Vector3d> m_normals; // by the numbers of the faces
  Eigen::Vector3d m_centre, m_size;
  double m_cell;
  std::vector<Nearest> m_field;
  std::vector<Eigen::Vector3d> m_samples;
  std::vector<Pose_of_view> m_symmetries;
};

} // namespace benchmark_tools

#endif // CGAL_CRUDE_REGISTRATION_BENCHMARK_RIVAL_MOTIONS_H
