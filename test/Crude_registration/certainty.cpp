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

#include <CGAL/Crude_registration/internal/base/symmetric_eigen.h>
#include <CGAL/Crude_registration/internal/judgement/evidence_coefficients.h>
#include <CGAL/Crude_registration/internal/mesh/to_flat_mesh.h>
#include <CGAL/Crude_registration/internal/motion/twist.h>
#include <CGAL/Crude_registration/internal/pipeline/register_reduced_scans.h>
#include <CGAL/Crude_registration/internal/reduction/reduce_scan.h>
#include <CGAL/Crude_registration/Judgement_limits.h>
#include <CGAL/Crude_registration/judge_motion.h>

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/subdivision_method_3.h>

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

using generated::Random;

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
  double about_mean;     // the mean of chi square per degree of freedom: of what the noise alone makes
  double by_axis[6];     // the ratio of variances along the axes of the mean covariance
  double shift, degrees; // the mean error, in sampling distances in the middle of the scan and as an angle
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
    s.about_mean += whitened(covariances[i], errors[i] - mean).squaredNorm() / (6 * (n - 1));
  }
  const Vector middle = true_motion(sources[0], targets[0])(sources[0].centre);
  s.shift = (mean.tail<3>() + mean.head<3>().cross(middle)).norm() / sources[0].scan.spacing();
  s.degrees = mean.head<3>().norm() * 180 / pi;
  for (const Vector_6& e : errors) {
    const Vector_6 white = whitened(mean_covariance, e - mean);
    for (int k = 0; k < 6; ++k) s.by_axis[k] += white[k] * white[k] / (n - 1);
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

// The covariance is that of the noise: the mean of chi square per degree of freedom about the mean of n runs is 1 with
// a standard deviation of sqrt(2 / (6 (n - 1))), and the ratio of variances along one axis 1 with sqrt(2 / (n - 1)).
// What all runs have in common, as they see the same surface by the same lines of sight, is a part of a sampling
// distance.
BOOST_AUTO_TEST_CASE(the_covariance_is_that_of_repeated_scans_in_either_order)
{
  const Noisy_views views;
  BOOST_TEST(views.sources[0].scan.reduced().coarse.surfels.size() !=
             views.targets[0].scan.reduced().coarse.surfels.size());
  for (const auto& [sources, targets] :
       {std::pair(&views.sources, &views.targets), std::pair(&views.targets, &views.sources)}) {
    const Scatter s = scatter(*sources, *targets);
    std::ostringstream axes;
    for (const double ratio : s.by_axis) axes << ' ' << ratio;
    BOOST_TEST_MESSAGE("chi square per degree of freedom: " << s.about_mean << "; along the axes:" << axes.str()
                                                            << "; mean error: " << s.shift << " sampling distances, "
                                                            << s.degrees << " degrees");
    constexpr double deviations = 4, runs = Noisy_views::trials - 1;
    BOOST_TEST(std::abs(s.about_mean - 1) < deviations * std::sqrt(2 / (6 * runs)));
    for (const double ratio : s.by_axis) BOOST_TEST(std::abs(ratio - 1) < deviations * std::sqrt(2 / runs));
    BOOST_TEST(s.shift < 0.25);
    BOOST_TEST(s.degrees < 0.25);
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
  // Positive definite, as a covariance is.
  BOOST_TEST(whitened(covariance_of(there), Vector_6::Ones()).allFinite());

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
    BOOST_TEST(whitened(covariance_of(result), Vector_6::Ones()).allFinite());
    const Vector_6 most = CR::internal::symmetric_eigen(covariance_of(result)).vectors.col(5);
    const Vector of_centre = most.tail<3>() + most.head<3>().cross(g.translation);
    if (most.head<3>().norm() > 0.1) BOOST_TEST(angle_of_lines(most.head<3>(), axis) < 3);
    if (of_centre.norm() > 0.1) BOOST_TEST(angle_of_lines(of_centre, axis) < 3);
  }
}

namespace {

// Each face in four that lie in it.
struct Midpoints
{
  template <class Halfedge, class Point>
  void edge_node(Halfedge h, Point& point) const
  {
    point = CGAL::midpoint(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)));
  }
  template <class Vertex, class Point>
  void vertex_node(Vertex v, Point& point) const
  {
    point = mesh.point(v);
  }
  template <class Halfedge, class Point>
  void border_node(Halfedge h, Point& edge, Point& vertex) const
  {
    edge_node(h, edge);
    vertex = mesh.point(mesh.target(h));
  }

  const Mesh& mesh;
};

Mesh subdivided(Mesh mesh)
{
  // What is done twice makes ten vertices and more of one.
  for (int i = 0; i < 2; ++i) {
    const Mesh before = mesh;
    CGAL::Subdivision_method_3::PTQ(mesh, Midpoints{before}, CGAL::parameters::number_of_iterations(1));
  }
  return mesh;
}

} // namespace

// More vertices on the same surface are no more evidence: what is said of two scans changes, in the mean, by less than
// what is said is off, in the mean, too: the expected calibration error that fit_confidence has measured of such
// answers.
BOOST_AUTO_TEST_CASE(subdivision_is_no_evidence)
{
  double change = 0;
  std::size_t pairs = 0, believed = 0, missed = 0;
  constexpr std::array<int, 6> directions = {0, 40, 75, 105, 150, 220};
  for (const unsigned seed : {3u, 4u, 5u}) {
    std::vector<Scan> plain, fine;
    std::size_t vertices = 0, more = 0;
    for (const int degrees : directions) {
      Mesh mesh;
      CR::triangulate_range_image(view(seed, degrees).image, mesh);
      const Mesh many = subdivided(mesh);
      vertices += mesh.number_of_vertices();
      more += many.number_of_vertices();
      plain.emplace_back(mesh);
      fine.emplace_back(many);
    }
    BOOST_TEST(more > 10 * vertices);
    for (std::size_t i = 0; i < plain.size(); ++i)
      for (std::size_t j = i + 1; j < plain.size(); ++j, ++pairs) {
        const auto of_plain = CR::register_scans(plain[i], plain[j]), of_fine = CR::register_scans(fine[i], fine[j]);
        double confidence = of_plain.confidence(), subdivided = of_fine.confidence();
        const bool is_believed = of_plain.status() == CR::REGISTERED;
        // Views a quarter turn apart have hardly anything in common: one search may find it and the other not. That
        // judges what it has missed.
        if (is_believed != (of_fine.status() == CR::REGISTERED)) {
          ++missed;
          BOOST_TEST(directions[j] - directions[i] >= 90);
          if (is_believed) subdivided = CR::judge_motion(fine[i], fine[j], of_plain.transformation()).confidence();
          else confidence = CR::judge_motion(plain[i], plain[j], of_fine.transformation()).confidence();
        }
        BOOST_TEST_MESSAGE("statue " << seed << ", views " << i << " and " << j << ": " << confidence << ", subdivided "
                                     << subdivided);
        BOOST_TEST((confidence >= CR::Judgement_limits::believed) == (subdivided >= CR::Judgement_limits::believed));
        change += std::abs(confidence - subdivided);
        believed += is_believed;
      }
  }
  BOOST_TEST(believed >= pairs / 3);
  BOOST_TEST(believed < pairs);
  BOOST_TEST(missed <= pairs / 20);
  BOOST_TEST(change / double(pairs) < CR::internal::Evidence_coefficients().calibration_error);
}

// What is said of two scans does not depend on how many fine surfels they are reduced to: of half and of twice as many
// it changes, in the mean, by less than what is said is off.
BOOST_AUTO_TEST_CASE(the_number_of_fine_surfels_is_no_evidence)
{
  using namespace CR::internal;
  constexpr std::array<int, 6> directions = {0, 40, 75, 105, 150, 220};
  constexpr std::array<double, 3> shares = {1, 0.5, 2};
  std::array<std::vector<Reduced_scan>, shares.size()> scans;
  for (std::size_t s = 0; s < shares.size(); ++s)
    for (const int degrees : directions) {
      // Of 70,000 samples, so that the number of surfels is what is asked for, and not a share of the samples.
      const Image& image = view(3, degrees, 0.2, 1000).image;
      Mesh mesh;
      CR::triangulate_range_image(image, mesh);
      Reduction_parameters parameters;
      parameters.fine_surfels *= shares[s] / 2;
      scans[s].push_back(reduce_scan(to_flat_mesh(mesh, p::default_values(), "", ""), Flat_sensor(), parameters));
      const double surfels = double(scans[s].back().fine.surfels.size()),
                   usual = double(scans[0][scans[s].size() - 1].fine.surfels.size());
      BOOST_TEST(std::abs(surfels / usual / shares[s] - 1) < 0.1, surfels << " surfels, " << usual);
    }
  const auto candidates = [](const Reduced_scan& source, const Reduced_scan& target) {
    return CR::Oriented_pair_candidates().candidates(source, target, Execution::SEQUENTIAL);
  };
  double change = 0;
  std::size_t pairs = 0, believed = 0;
  for (std::size_t i = 0; i < directions.size(); ++i)
    for (std::size_t j = i + 1; j < directions.size(); ++j) {
      std::vector<Result> results;
      for (const auto& of_share : scans)
        results.push_back(to_result<Kernel>(
            register_reduced_scans(of_share[i], of_share[j], candidates, Execution::SEQUENTIAL, to_the_end())));
      const Result& usual = results.front();
      believed += usual.status() == CR::REGISTERED;
      for (std::size_t s = 1; s < shares.size(); ++s, ++pairs) {
        BOOST_TEST((results[s].status() == CR::REGISTERED) == (usual.status() == CR::REGISTERED));
        change += std::abs(results[s].confidence() - usual.confidence());
        BOOST_TEST_MESSAGE("views " << i << " and " << j << ", " << shares[s]
                                    << " of the surfels: " << results[s].confidence() << ", " << usual.confidence());
      }
    }
  BOOST_TEST(believed >= 3u);
  BOOST_TEST(change / double(pairs) < Evidence_coefficients().calibration_error);
}

namespace {

// The share of the source's area that has the surface of the target within a distance, facing the same way: face by
// face, with the search tree of CGAL.
double true_overlap(const Mesh& source, const Rigid_motion& motion, const Mesh& target, double distance)
{
  using Primitive = CGAL::AABB_face_graph_triangle_primitive<Mesh>;
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree(faces(target).begin(), faces(target).end(), target);
  const auto cross = [](const Mesh& mesh, Mesh::Face_index f, Vector& middle) -> Vector {
    Vector v[3];
    int i = 0;
    for (const auto w : CGAL::vertices_around_face(mesh.halfedge(f), mesh)) v[i++] = to_vector(mesh.point(w));
    middle = (v[0] + v[1] + v[2]) / 3;
    return (v[1] - v[0]).cross(v[2] - v[0]);
  };
  double near = 0, all = 0;
  for (const auto f : source.faces()) {
    Vector middle, ignored;
    const Vector normal = cross(source, f, middle);
    all += normal.norm();
    const Vector q = motion(middle);
    const auto closest = tree.closest_point_and_primitive(Point(q.x(), q.y(), q.z()));
    const Vector there = cross(target, closest.second, ignored);
    if ((to_vector(closest.first) - q).norm() < distance &&
        (motion.rotation * normal).dot(there) > 0.7 * normal.norm() * there.norm())
      near += normal.norm();
  }
  return near / all;
}

} // namespace

// Under the true motion, of the surfaces without noise: single faces of noisy ones do not face anywhere in particular.
BOOST_AUTO_TEST_CASE(overlap_is_that_of_the_surfaces)
{
  for (const int b : {45, 90, 320})
    for (const double noise : {0., 0.2}) {
      const View &source = view(0, 0, noise, 200), &target = view(0, b, noise, 200);
      const Mesh s = mesh_of(view(0, 0, 0, 200).image), t = mesh_of(view(0, b, 0, 200).image);
      const Rigid_motion truth = true_motion(source, target);
      // Close by is within half the diagonal of a surfel's cell from a surfel's middle. At a border the last cell is
      // half full in the mean, and its middle a quarter of the spacing inside: so far less does it reach from the
      // surface.
      const double spacing = double((std::max)(source.scan.reduced().fine.spacing, target.scan.reduced().fine.spacing)),
                   distance = (std::sqrt(3.) / 2 - 0.25) * spacing;
      const double forth = true_overlap(s, truth, t, distance), back = true_overlap(t, truth.inverse(), s, distance);
      const Result there = CR::register_scans(source.scan, target.scan),
                   again = CR::register_scans(target.scan, source.scan);
      BOOST_TEST_MESSAGE("0 to " << b << ", noise " << noise << ": " << there.overlap() << " of " << forth << ", "
                                 << again.overlap() << " of " << back);
      BOOST_TEST(there.status() == CR::REGISTERED);
      BOOST_TEST(std::abs(there.overlap() - forth) < 0.03);
      BOOST_TEST(std::abs(again.overlap() - back) < 0.03);
    }
}

namespace {

// Of the heights, over the plane of each surfel, of those that are nearest to the ends of a cross of its spacing.
double third_quartile_of_heights(const CR::internal::Surfel_level& level)
{
  std::vector<double> heights;
  for (std::size_t i = 0; i < level.surfels.size(); i += 3) {
    const Vector p = level.surfels[i].position.cast<double>(), n = level.surfels[i].normal.cast<double>();
    const Vector u = n.cross(std::abs(n.x()) < 0.5 ? Vector(Vector::UnitX()) : Vector(Vector::UnitY())).normalized();
    for (const Vector& d : {u, Vector(-u), Vector(n.cross(u)), Vector(u.cross(n))}) {
      const Vector q = p + double(level.spacing) * d;
      double least = 0.5 * double(level.spacing * level.spacing), height = -1;
      for (const CR::internal::Surfel& s : level.surfels) {
        const Vector r = s.position.cast<double>();
        if (!((r - q).squaredNorm() < least)) continue;
        least = (r - q).squaredNorm();
        height = std::abs(n.dot(r - p));
      }
      if (height >= 0) heights.push_back(height);
    }
  }
  std::sort(heights.begin(), heights.end());
  return heights[heights.size() * 3 / 4];
}

} // namespace

// A roof of known noise, seen from above by parallel lines of sight.
BOOST_AUTO_TEST_CASE(noise_of_a_roof)
{
  Mesh roof;
  const auto ridge_1 = roof.add_vertex(Point(0, -2, 0)), ridge_2 = roof.add_vertex(Point(0, 2, 0)),
             a = roof.add_vertex(Point(-2, -2, -1)), b = roof.add_vertex(Point(-2, 2, -1)),
             c = roof.add_vertex(Point(2, -2, -1)), d = roof.add_vertex(Point(2, 2, -1));
  roof.add_face(a, ridge_1, ridge_2);
  roof.add_face(a, ridge_2, b);
  roof.add_face(ridge_1, c, d);
  roof.add_face(ridge_1, d, ridge_2);
  const double cosine = 1 / std::sqrt(1.25); // of the normals and the lines of sight
  std::vector<double> measured;
  for (const double noise : {0.1, 0.2, 0.4}) {
    auto camera = CR::Range_camera<Kernel>::framing(CGAL::Bbox_3(-1, -1, -1, 1, 1, 1), Kernel::Vector_3(0, 0, -1), 250);
    camera.noise = noise;
    camera.seed = 3;
    const auto simulated = CR::simulate_range_image(roof, camera);
    const Scan scan(simulated.image);
    const CR::internal::Reduced_scan& reduced = scan.reduced();
    const Rigid_motion scene_from_own = to_rigid_motion(simulated.scene_from_scan) * reduced.own_from_input.inverse();
    const double sigma = noise * camera.spacing * cosine;
    for (const CR::internal::Surfel_level* level : {&reduced.coarse, &reduced.fine}) {
      // A surfel is the mean of its samples, each of them with the noise of the camera: (w h)^2 has the mean w sigma^2.
      double squares = 0, samples = 0, squared_weights = 0, number = 0;
      for (std::size_t i = 0; i < level->surfels.size(); ++i) {
        const Vector p = scene_from_own(level->surfels[i].position.cast<double>());
        if (std::abs(p.x()) < 2 * double(level->spacing)) continue; // at the ridge
        const double w = double(level->weights[i]), height = cosine * (p.z() + std::abs(p.x()) / 2);
        squares += w * w * height * height;
        samples += w;
        squared_weights += w * w;
        ++number;
      }
      const double variance = squares / samples / (sigma * sigma), n = samples / number;
      const double height_noise = double(level->height_noise) * double(level->spacing) / sigma;
      BOOST_TEST_MESSAGE("noise " << noise << ", " << number << " surfels of " << n << " samples, variance " << variance
                                  << ", height noise " << height_noise << " sigma");
      // Noise that is large beside a cell takes samples to other cells: not where cells are large.
      if (level == &reduced.coarse || noise < 0.15)
        BOOST_TEST(std::abs(variance - 1) < 5 * std::sqrt(2 * squared_weights) / samples);
      // Three quarters of normal deviates are below 1.15 standard deviations; what one surfel's plane tells of the next
      // one has at least the noise of one, and what it is, is told by all pairs.
      BOOST_TEST(height_noise > 0.9 * 1.15 / std::sqrt(n));
      if (level == &reduced.coarse) {
        const double expected = third_quartile_of_heights(*level) / sigma;
        // The field knows the nearest surfel to about a voxel.
        BOOST_TEST(std::abs(height_noise / expected - 1) < 0.25, height_noise << ' ' << expected);
        measured.push_back(height_noise * sigma);
      }
    }
  }
  // More noise is more.
  for (std::size_t i = 1; i < measured.size(); ++i) BOOST_TEST(measured[i] > 1.5 * measured[i - 1]);
}
