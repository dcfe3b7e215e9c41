// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// What an answer says of its own certainty, against the truth: covariance, free motions, overlap, noise.

#define BOOST_TEST_MODULE certainty
#include <boost/test/unit_test.hpp>

#include "statue_views.h"

#include <CGAL/Crude_registration/internal/motion/twist.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

using generated::Random;
using Vector_6 = CR::internal::Vector_6;

namespace {

// Views of one statue with a noise of their own each time, and that are of different sizes, so that the pipeline turns
// round one of the orders.
struct Noisy_views
{
  Noisy_views()
  {
    Mesh statue;
    CR::make_statue(statue, 72, p::random_seed(0));
    const CR::Simulated_scene scene(statue);
    for (int i = 0; i < trials; ++i) {
      sources.push_back(taken(scene, 0, 150, std::uint64_t(2 * i + 1)));
      targets.push_back(taken(scene, 40, 180, std::uint64_t(2 * i + 2)));
    }
  }

  View taken(const CR::Simulated_scene& scene, int degrees, std::size_t samples, std::uint64_t seed) const
  {
    const double angle = degrees * pi / 180;
    auto camera =
        CR::Range_camera<Kernel>::framing(CGAL::Bbox_3(-0.85, -0.85, -1, 0.85, 0.85, 1),
                                          Kernel::Vector_3(-std::cos(angle), -std::sin(angle), -0.2), samples, true);
    camera.noise = 0.2;
    camera.seed = seed;
    const auto simulated = scene.range_image(camera);
    const Rigid_motion scene_from_scan = to_rigid_motion(simulated.scene_from_scan);
    return {simulated.image, scene_from_scan, Scan(simulated.image), scene_from_scan.inverse()(Vector::Zero())};
  }

  static constexpr int trials = 24;
  std::vector<View> sources, targets;
};

// The small motion (w, v), x -> x + w x x + v, that a motion near the identity is.
Vector_6 twist_of(const Rigid_motion& m)
{
  const Eigen::AngleAxisd turn(m.rotation);
  Vector_6 t;
  t << turn.angle() * turn.axis(), m.translation;
  return t;
}

struct Scatter
{
  double of_errors;  // the mean of chi square about the truth, per degree of freedom
  double about_mean; // that about the mean error, which the noise alone makes
  double by_axis[6]; // the ratio of variances along the axes of the mean covariance
};

Scatter scatter(const std::vector<View>& sources, const std::vector<View>& targets)
{
  std::vector<Vector_6> errors;
  std::vector<Matrix_6> covariances;
  Matrix_6 mean_covariance = Matrix_6::Zero();
  Vector_6 mean = Vector_6::Zero();
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const Result result = CR::register_scans(sources[i].scan, targets[i].scan);
    check_right(result, sources[i], targets[i]);
    errors.push_back(
        twist_of(to_rigid_motion(result.transformation()) * true_motion(sources[i], targets[i]).inverse()));
    covariances.push_back(covariance_of(result));
    mean += errors.back() / double(sources.size());
    mean_covariance += covariances.back() / double(sources.size());
  }
  Scatter s{};
  const double n = double(errors.size());
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const Eigen::LDLT<Matrix_6> solver(covariances[i]);
    const Vector_6 e = errors[i], d = e - mean;
    s.of_errors += e.dot(solver.solve(e)) / (6 * n);
    s.about_mean += d.dot(solver.solve(d)) / (6 * (n - 1));
  }
  const Eigen::LLT<Matrix_6> root(mean_covariance);
  for (int k = 0; k < 6; ++k)
    for (const Vector_6& e : errors) {
      const Vector_6 white = root.matrixL().solve(Vector_6(e - mean));
      s.by_axis[k] += white[k] * white[k] / (n - 1);
    }
  return s;
}

// The numbers in brackets after a word: of `free_motions`.
Vector numbers_after(const std::string& text, const std::string& word)
{
  const std::size_t at = text.find(word + " (");
  BOOST_TEST_REQUIRE((at != std::string::npos), text);
  std::istringstream in(text.substr(at + word.size() + 2));
  Vector v;
  in >> v.x() >> v.y() >> v.z();
  BOOST_TEST_REQUIRE(bool(in), text);
  return v;
}

double angle_of_lines(const Vector& a, const Vector& b)
{
  return std::atan2(a.cross(b).norm(), std::abs(a.dot(b))) * 180 / pi;
}

// A cylinder of radius 1 about the z axis, and its extent along it.
Flat_mesh cylinder(int around, int rows, double height, unsigned seed)
{
  return generated::grid(
      around, rows, [&](double u, double v) { return Vector(std::cos(2 * pi * u), std::sin(2 * pi * u), height * v); },
      0.25, true, false, seed);
}

} // namespace

// Were the errors of correspondences independent, the errors of motions would have the covariance told, and chi square
// its distribution: with n runs, its mean per degree of freedom is 1 with a standard deviation of sqrt(2 / 6 n).
BOOST_AUTO_TEST_CASE(the_covariance_is_that_of_repeated_scans_in_either_order)
{
  const Noisy_views views;
  BOOST_TEST(views.sources[0].scan.reduced().coarse.surfels.size() !=
             views.targets[0].scan.reduced().coarse.surfels.size());
  for (const auto& [sources, targets] :
       {std::pair(&views.sources, &views.targets), std::pair(&views.targets, &views.sources)}) {
    const Scatter s = scatter(*sources, *targets);
    BOOST_TEST_MESSAGE("chi square per degree of freedom: "
                       << s.of_errors << " about the truth, " << s.about_mean << " about the mean; along the axes "
                       << s.by_axis[0] << ' ' << s.by_axis[1] << ' ' << s.by_axis[2] << ' ' << s.by_axis[3] << ' '
                       << s.by_axis[4] << ' ' << s.by_axis[5]);
  }
}

// The covariance in the frame of the target, wherever that is, and for the inverse of the motion.
BOOST_AUTO_TEST_CASE(the_covariance_goes_with_the_frames)
{
  const View &a = view(0, 0), &b = view(0, 45, 0.2, 250);
  const Result there = CR::register_scans(a.scan, b.scan), back = CR::register_scans(b.scan, a.scan);
  // exp(x) there = there exp(Ad(there^-1) x), whose inverse has the deviation of `back` but for its sign.
  const Matrix_6 adjoint = CR::internal::adjoint(to_rigid_motion(back.transformation()));
  const Matrix_6 expected = adjoint * covariance_of(there) * adjoint.transpose();
  BOOST_TEST((covariance_of(back) - expected).norm() < 1e-9 * expected.norm());
  // The positive eigenvalues of a covariance.
  BOOST_TEST(Eigen::SelfAdjointEigenSolver<Matrix_6>(covariance_of(there)).eigenvalues()[0] > 0);

  Random random(5);
  const Rigid_motion f = random.motion(3), g = random.motion(3);
  const Result moved_result = CR::register_scans(Scan(moved(a.image, f)), Scan(moved(b.image, g)));
  const Matrix_6 frame = CR::internal::adjoint(g), moved_expected = frame * covariance_of(there) * frame.transpose();
  // Rounding takes some samples to other cells.
  BOOST_TEST((covariance_of(moved_result) - moved_expected).norm() < 0.1 * moved_expected.norm());
}

// A cylinder turns about its axis and slides along it: in the frame of the target, in either order.
BOOST_AUTO_TEST_CASE(free_axes_by_direction)
{
  Random random(11);
  for (const bool source_is_larger : {false, true}) {
    const Rigid_motion f = random.motion(2), g = random.motion(2);
    const Flat_mesh small = cylinder(120, 60, 2.2, 1), large = cylinder(200, 90, 3, 2);
    const Scan source(mesh_of(generated::moved(source_is_larger ? large : small, f))),
        target(mesh_of(generated::moved(source_is_larger ? small : large, g)));
    const Result result = CR::register_scans(source, target);
    check_sound(result);
    BOOST_TEST(result.status() == CR::AMBIGUOUS);
    BOOST_TEST_REQUIRE(result.free_motions().size() == 2u);
    const Vector axis = g.rotation.col(2);
    bool turns = false, slides = false;
    for (const std::string& name : result.free_motions()) {
      if (name.find("rotation about") == 0) {
        turns = true;
        BOOST_TEST(angle_of_lines(numbers_after(name, "about"), axis) < 3, name);
        const Vector away = numbers_after(name, "through") - g.translation;
        BOOST_TEST((away - away.dot(axis) * axis).norm() < 0.05, name);
      } else if (name.find("translation along") == 0) {
        slides = true;
        BOOST_TEST(angle_of_lines(numbers_after(name, "along"), axis) < 3, name);
      }
    }
    BOOST_TEST(turns);
    BOOST_TEST(slides);
    // The covariance knows, too: its most uncertain motions keep the axis.
    const Eigen::SelfAdjointEigenSolver<Matrix_6> eigen(covariance_of(result));
    const Vector_6 most = eigen.eigenvectors().col(5);
    const Vector of_centre = most.tail<3>() + most.head<3>().cross(g.translation);
    if (most.head<3>().norm() > 0.1) BOOST_TEST(angle_of_lines(most.head<3>(), axis) < 3);
    if (of_centre.norm() > 0.1) BOOST_TEST(angle_of_lines(of_centre, axis) < 3);
  }
}

namespace {

struct Piece
{
  Vector centre, normal;
  double area;
};

std::vector<Piece> pieces(const Mesh& mesh, const Rigid_motion& motion)
{
  std::vector<Piece> result;
  for (const auto f : mesh.faces()) {
    Vector v[3];
    int i = 0;
    for (const auto w : CGAL::vertices_around_face(mesh.halfedge(f), mesh)) v[i++] = motion(to_vector(mesh.point(w)));
    const Vector cross = (v[1] - v[0]).cross(v[2] - v[0]);
    if (!(cross.norm() > 0)) continue;
    result.push_back({(v[0] + v[1] + v[2]) / 3, cross.normalized(), cross.norm() / 2});
  }
  return result;
}

// The share of the source's area that has a piece of the target within a distance, facing the same way: by all pairs.
double true_overlap(const std::vector<Piece>& source, const std::vector<Piece>& target, double distance)
{
  double near = 0, all = 0;
  for (const Piece& s : source) {
    all += s.area;
    double least = distance * distance;
    const Piece* nearest = nullptr;
    for (const Piece& t : target)
      if (const double d = (s.centre - t.centre).squaredNorm(); d < least) {
        least = d;
        nearest = &t;
      }
    if (nearest != nullptr && s.normal.dot(nearest->normal) > 0.7) near += s.area;
  }
  return near / all;
}

} // namespace

BOOST_AUTO_TEST_CASE(overlap_is_that_of_the_surfaces)
{
  for (const int b : {45, 90, 320}) {
    // Without noise under the true motion, and as it was found in scans with noise.
    const View &source = view(0, 0, 0, 200), &target = view(0, b, 0, 200);
    const auto s = pieces(mesh_of(source.image), true_motion(source, target)),
               t = pieces(mesh_of(target.image), Rigid_motion());
    const double distance = double((std::max)(source.scan.reduced().fine.spacing, target.scan.reduced().fine.spacing));
    const double forth = true_overlap(s, t, distance), back = true_overlap(t, s, distance);
    BOOST_TEST_CONTEXT("0 to " << b << ": " << forth << ", " << back)
    {
      for (const double noise : {0., 0.2}) {
        const View &a = view(0, 0, noise, 200), &c = view(0, b, noise, 200);
        const Result there = CR::register_scans(a.scan, c.scan), again = CR::register_scans(c.scan, a.scan);
        BOOST_TEST(there.status() == CR::REGISTERED);
        BOOST_TEST(std::abs(there.overlap() - forth) < 0.03, there.overlap());
        BOOST_TEST(std::abs(again.overlap() - back) < 0.03, again.overlap());
      }
    }
  }
}

// A plane of known noise, seen at right angles by parallel lines of sight.
BOOST_AUTO_TEST_CASE(noise_of_a_plane)
{
  Mesh square;
  const auto a = square.add_vertex(Point(-2, -2, 0)), b = square.add_vertex(Point(2, -2, 0)),
             c = square.add_vertex(Point(2, 2, 0)), d = square.add_vertex(Point(-2, 2, 0));
  square.add_face(a, b, c);
  square.add_face(a, c, d);
  std::vector<double> ratios;
  for (const double noise : {0.1, 0.2, 0.4}) {
    auto camera = CR::Range_camera<Kernel>::framing(CGAL::Bbox_3(-1, -1, -1, 1, 1, 1), Kernel::Vector_3(0, 0, -1), 250);
    camera.noise = noise;
    camera.seed = 3;
    const Scan scan(CR::simulate_range_image(square, camera).image);
    const CR::internal::Reduced_scan& reduced = scan.reduced();
    const double sigma = noise * camera.spacing, distance = 3 * std::sqrt(3.);
    for (const CR::internal::Surfel_level* level : {&reduced.coarse, &reduced.fine}) {
      // A surfel is the mean of its samples, each of them with the noise of the camera.
      const Rigid_motion input_from_own = reduced.own_from_input.inverse();
      double sum = 0, samples = 0, inside = 0, mean_height = 0;
      for (std::size_t i = 0; i < level->surfels.size(); ++i) {
        if (level->borders[i]) continue;
        const double height = input_from_own(level->surfels[i].position.cast<double>()).z() + distance;
        sum += double(level->weights[i]) * height * height / (sigma * sigma);
        samples += double(level->weights[i]);
        mean_height += height;
        ++inside;
      }
      BOOST_TEST_CONTEXT("noise " << noise << ", " << inside << " surfels of " << samples / inside << " samples, mean "
                                  << mean_height / inside / sigma << " sigma, variance " << sum / inside
                                  << ", height noise " << level->height_noise * level->spacing / sigma << " sigma")
      {
        BOOST_TEST(std::abs(sum / inside - 1) < 5 * std::sqrt(2 / inside));
        // Three quarters of normal deviates are below 1.15 standard deviations. Of the heights of two surfels over a
        // plane the variance is twice that of one; where the plane is that of the one, its tilt over a distance of the
        // spacing adds at most the variance of the difference of two rows of samples at its ends.
        const double n = samples / inside, of_one = sigma / std::sqrt(n);
        const double measured = double(level->height_noise) * double(level->spacing);
        BOOST_TEST(measured > 0.9 * 1.15 * of_one);
        BOOST_TEST(measured < 1.1 * 1.15 * of_one * std::sqrt(2 + (std::max)(12., 2 * std::sqrt(n))));
        if (level == &reduced.fine) ratios.push_back(measured / sigma);
      }
    }
  }
  for (const double ratio : ratios) BOOST_TEST(std::abs(ratio / ratios.front() - 1) < 0.1);
}
