// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// The paper's method from two scans to the motion, by the public calls.

#define BOOST_TEST_MODULE trihedron_candidates
#include <boost/test/unit_test.hpp>

#include "range_images.h"
#include "statue_views.h"
#include "wrong_use.h"

#include <CGAL/Crude_registration/IO/read_range_image.h>
#include <CGAL/Crude_registration/matching/Trihedron_candidates.h>
#include <CGAL/Crude_registration/reduction/approximation_error.h>
#include <CGAL/Crude_registration/reduction/simplify_scan.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using generated::Random;

namespace {

const CR::Trihedron_candidates trihedra;

// A view without holes.
const View& whole(int degrees, unsigned seed = 0)
{
  return view(seed, degrees, 0.1, 220, false);
}

// The same, prepared for trihedra. Made once.
const Scan& prepared(int degrees, unsigned seed = 0)
{
  static std::map<std::pair<unsigned, int>, Scan> scans;
  const auto key = std::pair(seed, degrees);
  const auto found = scans.find(key);
  if (found != scans.end()) return found->second;
  return scans.emplace(key, Scan(whole(degrees, seed).image, p::candidates(trihedra))).first->second;
}

// A trihedron, whose vertices may be off by 0.8 spacings of the target at most. The pipeline may have exchanged the
// two.
void check_trihedron(const Result& result, int source, int target)
{
  const double spacing =
      (std::max)(prepared(source).reduced().simplified->spacing, prepared(target).reduced().simplified->spacing);
  check_correspondence(result, whole(source), whole(target), 4, spacing, 0.8 * spacing);
  std::array<CGAL::Orientation, 2> sides;
  const auto& points = result.correspondence();
  BOOST_TEST_REQUIRE(points.size() == 4u);
  sides[0] = CGAL::orientation(points[0].first, points[1].first, points[2].first, points[3].first);
  sides[1] = CGAL::orientation(points[0].second, points[1].second, points[2].second, points[3].second);
  BOOST_TEST(sides[0] != CGAL::COPLANAR);
  BOOST_TEST(sides[0] == sides[1]);
}

std::size_t simplified_size(const Scan& scan)
{
  return scan.reduced().simplified->vertices.points.size();
}

std::size_t count(const std::vector<Result::Stage>& stages, const std::string& name)
{
  for (const auto& s : stages)
    if (s.name == name) return s.count;
  BOOST_ERROR("no stage " + name);
  return 0;
}

// What the first round of a generator did.
std::size_t count_of_first_round(const CR::Trihedron_candidates& generator, const Scan& source, const Scan& target,
                                 const std::string& name)
{
  const auto candidates = generator.candidates(source.reduced(), target.reduced(), CR::internal::Execution::SEQUENTIAL);
  CR::internal::Run_control to_the_end;
  BOOST_TEST(candidates->next(to_the_end).has_value());
  for (const auto& s : candidates->stages())
    if (s.name == name) return s.count;
  BOOST_ERROR("no stage " + name);
  return 0;
}

Scan flat_scan(std::size_t size)
{
  Image image(size, size);
  for (std::size_t row = 0; row < size; ++row)
    for (std::size_t column = 0; column < size; ++column)
      image.set_sample(column, row, Point(0.1 * double(column), 0.1 * double(row), 0));
  image.set_sensor(Sensor::orthographic(Kernel::Vector_3(0, 0, -1)));
  return Scan(image, p::candidates(trihedra));
}

} // namespace

// Simplified by CGAL to the approximation error of each mesh.
BOOST_AUTO_TEST_CASE(meshes_by_epsilon)
{
  const View &source = whole(0), &target = whole(45);
  const Mesh a = mesh_of(source.image), b = mesh_of(target.image);
  const Result result = CR::register_meshes(a, b, p::candidates(trihedra).viewpoint(origin), p::viewpoint(origin));
  check_right(result, source, target);
  BOOST_TEST(count(result.statistics(), "propose: trihedra") > 0u);
  BOOST_TEST(count(result.statistics(), "propose: matches") > 0u);
  // The crude motion is what the correspondences of the simplified meshes gave.
  const Rigid_motion crude = to_rigid_motion(result.crude_transformation()), truth = true_motion(source, target);
  BOOST_TEST_MESSAGE("crude: " << angle_between(crude, truth) << " degrees");
  BOOST_TEST(angle_between(crude, truth) < 3);
  BOOST_TEST((crude(source.centre) - truth(source.centre)).norm() < 6 * source.scan.spacing());
  BOOST_TEST((crude.rotation != to_rigid_motion(result.transformation()).rotation));
}

BOOST_AUTO_TEST_CASE(scans_that_are_prepared_once_from_either_side)
{
  for (const auto& [a, b] : {std::pair(0, 45), std::pair(45, 90)}) {
    const Result there = CR::register_scans(prepared(a), prepared(b), p::candidates(trihedra)),
                 back = CR::register_scans(prepared(b), prepared(a), p::candidates(trihedra));
    check_right(there, whole(a), whole(b));
    check_right(back, whole(b), whole(a));
    check_trihedron(there, a, b);
    check_trihedron(back, b, a);
    check_swapped_correspondence(there, back);
    BOOST_TEST(there.confidence() == back.confidence());
    BOOST_TEST(there.score() == back.score());
    for (const auto& [m, n] : {std::pair(there.transformation(), back.inverse_transformation()),
                               std::pair(there.inverse_transformation(), back.transformation())}) {
      const Rigid_motion motion = to_rigid_motion(m), inverse = to_rigid_motion(n);
      BOOST_TEST((motion.rotation - inverse.rotation).norm() < 1e-14);
      BOOST_TEST((motion.translation - inverse.translation).norm() < 1e-13);
    }
    const Rigid_motion product =
        to_rigid_motion(there.crude_transformation()) * to_rigid_motion(back.crude_transformation());
    BOOST_TEST(difference(product, Rigid_motion(), Vector::Zero()) < 1e-12);
  }
}

// Each sample that is lost leaves a hole, which no collapse of an edge closes.
BOOST_AUTO_TEST_CASE(scans_with_lost_samples)
{
  const View &source = view(0, 0), &target = view(0, 45);
  check_right(CR::register_scans(Scan(source.image, p::candidates(trihedra)),
                                 Scan(target.image, p::candidates(trihedra)), p::candidates(trihedra)),
              source, target);
}

BOOST_AUTO_TEST_CASE(scans_that_are_not_prepared_are_refused)
{
  const Scan &plain = whole(0).scan, &simplified = prepared(45);
  for (const auto& [a, b] : {std::pair(&plain, &simplified), std::pair(&simplified, &plain), std::pair(&plain, &plain)})
    BOOST_CHECK_EXCEPTION(CR::register_scans(*a, *b, p::candidates(trihedra)), std::invalid_argument,
                          names("Trihedron_candidates", "made with the parameter candidates"));
  // What is prepared for trihedra can be registered by pairs.
  check_right(CR::register_scans(prepared(0), whole(45).scan), whole(0), whole(45));
}

BOOST_AUTO_TEST_CASE(the_same_bits_by_several_threads)
{
#ifdef CGAL_LINKED_WITH_TBB
  for (const int b : {45, 180}) {
    const Result alone = CR::register_scans(prepared(0), prepared(b), p::candidates(trihedra));
    check_same_bits(alone, CR::register_scans<CGAL::Parallel_tag>(prepared(0), prepared(b), p::candidates(trihedra)));
  }
  const Mesh a = mesh_of(whole(0).image), b = mesh_of(whole(45).image);
  check_same_bits(CR::register_meshes(a, b, p::candidates(trihedra)),
                  CR::register_meshes<CGAL::Parallel_tag>(a, b, p::candidates(trihedra)));
#else
  std::cout << "TBB: not tested, it was not found\n";
#endif
}

BOOST_AUTO_TEST_CASE(frame_and_unit_do_not_matter)
{
  const View &source = whole(0), &target = whole(45);
  Random random(3);
  for (const double unit : {1e-3, 1e3}) {
    const Rigid_motion f = random.motion(unit), g = random.motion(unit);
    const Result result =
        CR::register_scans(Scan(moved(source.image, f, unit), p::candidates(trihedra)),
                           Scan(moved(target.image, g, unit), p::candidates(trihedra)), p::candidates(trihedra));
    check_proper(result);
    BOOST_TEST(result.status() == CR::REGISTERED);
    Rigid_motion back = g.inverse() * to_rigid_motion(result.transformation()) * f;
    back.translation /= unit;
    const Rigid_motion truth = true_motion(source, target);
    BOOST_TEST(angle_between(back, truth) < 1);
    BOOST_TEST((back(source.centre) - truth(source.centre)).norm() < 2 * source.scan.spacing());
  }
}

BOOST_AUTO_TEST_CASE(what_does_not_belong_together_is_not_registered)
{
  check_not_registered(CR::register_scans(prepared(0), prepared(90, 1), p::candidates(trihedra)));
  check_not_registered(CR::register_scans(prepared(0), prepared(180), p::candidates(trihedra)));
}

BOOST_AUTO_TEST_CASE(scans_without_a_trihedron)
{
  // A plane has no trihedron, and a scan of a few samples no vertex inside.
  for (const std::size_t size : {2u, 3u, 30u}) {
    const Scan flat = flat_scan(size);
    for (const Result& result : {CR::register_scans(flat, prepared(0), p::candidates(trihedra)),
                                 CR::register_scans(prepared(0), flat, p::candidates(trihedra))}) {
      check_not_registered(result);
      BOOST_TEST(result.status() == CR::NOT_REGISTERED);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_run_can_be_ended)
{
  // Without overlap: the longest search there is.
  const Scan &source = prepared(0), &target = prepared(180);
  const Result complete = CR::register_scans(source, target, p::candidates(trihedra));
  Impatient patient(1);
  check_same_bits(complete, CR::register_scans(source, target, p::candidates(trihedra).visitor(std::ref(patient))));
  BOOST_TEST(patient.asked > 5);
  BOOST_TEST(patient.is_monotone);
  BOOST_TEST(patient.is_share);
  for (const int looks : {0, 1, 3}) {
    Impatient impatient(1, looks);
    const Result result = CR::register_scans<CGAL::Parallel_if_available_tag>(
        source, target, p::visitor(std::ref(impatient)).candidates(trihedra));
    check_not_registered(result);
    BOOST_TEST(result.confidence() <= 0.5);
    BOOST_TEST(result.reason().find("interrupted") == 0u);
    BOOST_TEST(impatient.refused == 1);
  }
  check_not_registered(CR::register_scans(source, target, p::candidates(trihedra).time_budget(1e-3)));
  // In the midst of the preparation.
  const Mesh mesh = mesh_of(whole(0).image);
  for (const int looks : {0, 2}) {
    Impatient impatient(1, looks);
    const Result result = CR::register_meshes(mesh, mesh, p::visitor(std::ref(impatient)).candidates(trihedra));
    BOOST_TEST(result.status() == CR::NOT_REGISTERED);
    BOOST_TEST(result.reason() == "interrupted: the preparation of the scans");
    BOOST_TEST(impatient.refused == 1);
  }
  BOOST_CHECK_THROW(Scan(mesh, p::candidates(trihedra).time_budget(1e-9)), CR::Preparation_interrupted);
}

// The simplified meshes are those of the public functions.
BOOST_AUTO_TEST_CASE(simplification_is_that_of_its_parameters)
{
  const Image& image = whole(0).image;
  const Mesh dense = mesh_of(image);
  const auto simplified = [&](const auto& np) {
    Mesh mesh = dense;
    CR::simplify_scan(mesh, np);
    return mesh.number_of_vertices();
  };
  const double epsilon = CR::approximation_error(image);
  BOOST_TEST(simplified_size(prepared(0)) == simplified(p::approximation_error(epsilon)));
  std::size_t last = dense.number_of_vertices();
  for (const double factor : {0.25, 4.}) {
    const double error = factor * epsilon;
    const Scan scan(image, p::candidates(trihedra).approximation_error(error));
    BOOST_TEST(simplified_size(scan) == simplified(p::approximation_error(error)));
    BOOST_TEST(simplified_size(scan) < last);
    last = simplified_size(scan);
  }
  for (const std::size_t number : {300u, 450u}) {
    const Scan scan(image, p::candidates(trihedra).number_of_vertices(number));
    BOOST_TEST(simplified_size(scan) == number);
  }
  // What is reached first ends the simplification.
  BOOST_TEST(simplified_size(Scan(image, p::candidates(trihedra).number_of_vertices(10).approximation_error(
                                             epsilon))) == simplified_size(prepared(0)));
  // Each mesh has its own.
  const View &source = whole(0), &target = whole(45);
  check_right(CR::register_meshes(mesh_of(source.image), mesh_of(target.image),
                                  p::candidates(trihedra).number_of_vertices(450), p::approximation_error(epsilon)),
              source, target);
}

BOOST_AUTO_TEST_CASE(parameters_of_the_search)
{
  const Scan &source = prepared(0), &target = prepared(45);
  const auto in_first_round = [&](const auto& np, const std::string& name) {
    return count_of_first_round(CR::Trihedron_candidates(np), source, target, name);
  };
  // Curvatures alone let more through.
  BOOST_TEST(in_first_round(p::use_normals(false), "propose: matches") >
             2 * in_first_round(p::use_normals(true), "propose: matches"));
  BOOST_TEST(in_first_round(p::default_values(), "propose: matches") ==
             in_first_round(p::use_normals(true), "propose: matches"));
  // And so do larger tolerances.
  const double edge = target.reduced().simplified->spacing;
  std::size_t last = 0;
  for (const double share : {1e-4, 0.7, 1.}) {
    const std::size_t n = in_first_round(p::tolerance(share * edge).use_normals(false), "propose: matches");
    BOOST_TEST((share == 1e-4 ? n == 0 : n > last), "tolerance " << share << " edges: " << n << " after " << last);
    last = n;
  }
  // No axis is as short, or as long.
  BOOST_TEST(in_first_round(p::maximum_extent(1e-6), "propose: trihedra") == 0u);
  BOOST_TEST(in_first_round(p::minimum_extent(5.).maximum_extent(6.), "propose: trihedra") == 0u);
  // What the call says counts, not what the constructor was told.
  const Result nothing = CR::register_scans(source, target, p::candidates(trihedra).maximum_extent(1e-6));
  BOOST_TEST(nothing.status() == CR::NOT_REGISTERED);
  BOOST_TEST(count(nothing.statistics(), "propose: trihedra") == 0u);
  const CR::Trihedron_candidates none(p::maximum_extent(1e-6));
  BOOST_TEST(CR::register_scans(source, target, p::candidates(none)).status() == CR::NOT_REGISTERED);
  check_right(CR::register_scans(source, target, p::candidates(none).maximum_extent(0.3)), whole(0), whole(45));
  const Result strict = CR::register_scans(source, target, p::candidates(trihedra).tolerance(1e-4 * edge));
  BOOST_TEST(strict.status() == CR::NOT_REGISTERED);
}

BOOST_AUTO_TEST_CASE(wrong_values_are_refused_by_name)
{
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  const Scan& scan = prepared(0);
  const auto refuses = [&](const auto& np, const std::string& argument) {
    BOOST_CHECK_EXCEPTION(CR::Trihedron_candidates{np}, std::invalid_argument, names("Trihedron_candidates", argument));
    BOOST_CHECK_EXCEPTION(CR::register_scans(scan, scan, np.candidates(trihedra)), std::invalid_argument,
                          names("register_scans", argument));
  };
  refuses(p::tolerance(0.), "tolerance");
  refuses(p::tolerance(-1.), "tolerance");
  refuses(p::tolerance(nan), "tolerance");
  refuses(p::tolerance(infinity), "tolerance");
  refuses(p::minimum_extent(0.3), "minimum_extent");
  refuses(p::minimum_extent(-0.1), "minimum_extent");
  refuses(p::maximum_extent(infinity), "maximum_extent");
  const Mesh mesh = mesh_of(whole(0).image);
  const auto refuses_mesh = [&](const auto& np, const std::string& argument) {
    BOOST_CHECK_EXCEPTION(Scan(mesh, np.candidates(trihedra)), std::invalid_argument, names("Scan", argument));
    BOOST_CHECK_EXCEPTION(CR::register_meshes(mesh, mesh, np.candidates(trihedra)), std::invalid_argument,
                          names("register_meshes: source", argument));
    BOOST_CHECK_EXCEPTION(CR::register_meshes(mesh, mesh, p::candidates(trihedra), np), std::invalid_argument,
                          names("register_meshes: target", argument));
  };
  refuses_mesh(p::approximation_error(-1.), "approximation_error");
  refuses_mesh(p::approximation_error(nan), "approximation_error");
  refuses_mesh(p::number_of_vertices(-1), "number_of_vertices");
}

// Bunny 0-90 of the paper's Table 2: its error there is 1.4 degrees and 0.002 on average.
BOOST_AUTO_TEST_CASE(the_papers_bunny_pair, *boost::unit_test::label("real_scans") *
                                                boost::unit_test::precondition(generated::real_scans_are_there))
{
  const std::filesystem::path folder = generated::real_scans("bunny");
  if (folder.empty()) return;
  const auto read = [&](const char* name) {
    Image image;
    CR::read_range_image((folder / name).string(), image);
    return Scan(image, p::candidates(trihedra).number_of_vertices(450));
  };
  const Scan a = read("bun000.ply"), b = read("bun090.ply");
  Rigid_motion wanted;
  std::ifstream in(folder / "pairs.csv");
  bool is_known = false;
  for (std::string line; !is_known && std::getline(in, line);) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    std::string source, target;
    double overlap = 0;
    words >> source >> target >> overlap;
    if (source != "bun000.ply" || target != "bun090.ply") continue;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) words >> wanted.rotation(i, j);
      words >> wanted.translation(i);
    }
    is_known = bool(words);
  }
  BOOST_TEST_REQUIRE(is_known);
  const Result result = CR::register_scans(a, b, p::candidates(trihedra));
  check_proper(result);
  BOOST_TEST(result.status() == CR::REGISTERED);
  const Rigid_motion crude = to_rigid_motion(result.crude_transformation()),
                     refined = to_rigid_motion(result.transformation());
  BOOST_TEST_MESSAGE("crude: " << angle_between(crude, wanted)
                               << " degrees, refined: " << angle_between(refined, wanted));
  BOOST_TEST(angle_between(crude, wanted) < 1.4);
  BOOST_TEST((crude.translation - wanted.translation).norm() < 0.002);
  BOOST_TEST(angle_between(refined, wanted) < 0.5);
}
