// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// Generators of candidates of a user's own, what becomes of the motions they propose, and the bounds of the default.

#define BOOST_TEST_MODULE candidate_generators
#include <boost/test/unit_test.hpp>

#include "statue_views.h"

#include <CGAL/Crude_registration/internal/matching/Oriented_pair_search.h>
#include <CGAL/Crude_registration/matching/Trihedron_candidates.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

using generated::Random;
using Motion = CGAL::Aff_transformation_3<Kernel>;
using Motions = std::vector<Motion>;

namespace {

// A model of CandidateGenerator: motions that are known beforehand, of the scan with `samples` samples to another one.
class Known_motions
{
public:
  struct Log
  {
    std::size_t asked = 0;
    bool is_told_to_stop = false;
  };

  Known_motions(const Scan& source, std::vector<Motions> rounds)
      : m_samples(source.number_of_samples()), m_rounds(std::move(rounds))
  {}

  class Rounds
  {
  public:
    Rounds(const Known_motions& parent, bool is_turned)
        : m_rounds(parent.m_rounds), m_log(parent.m_log), m_is_turned(is_turned)
    {}

    template <class Go_on>
    Motions operator()(const Go_on& go_on)
    {
      ++m_log->asked;
      m_log->is_told_to_stop = !go_on();
      if (m_next == m_rounds.size()) {
        m_is_done = true;
        return {};
      }
      Motions motions = m_rounds[m_next++];
      if (m_is_turned)
        for (Motion& m : motions) m = m.inverse();
      return motions;
    }
    bool is_done() const { return m_is_done; }

  private:
    std::vector<Motions> m_rounds;
    std::shared_ptr<Log> m_log;
    bool m_is_turned;
    std::size_t m_next = 0;
    bool m_is_done = false;
  };

  template <class ConcurrencyTag = CGAL::Sequential_tag>
  Rounds rounds(const Scan& source, const Scan&) const
  {
    return {*this, source.number_of_samples() != m_samples};
  }

  const Log& log() const { return *m_log; }

private:
  std::size_t m_samples;
  std::vector<Motions> m_rounds;
  std::shared_ptr<Log> m_log = std::make_shared<Log>(); // of all copies
};

// Of the default, as users of the concept see it.
struct Borrowed_candidates
{
  template <class ConcurrencyTag = CGAL::Sequential_tag, class Any_scan>
  auto rounds(const Any_scan& source, const Any_scan& target) const
  {
    return CR::Oriented_pair_candidates().rounds<ConcurrencyTag>(source, target);
  }
};

Motion aff(const Rigid_motion& m)
{
  return CR::internal::to_aff_transformation<Kernel>(m);
}

// Turned about the middle of the target, and shifted.
Rigid_motion off(const Rigid_motion& truth, const Vector& source_centre, double degrees, const Vector& shift)
{
  const Vector centre = truth(source_centre);
  Rigid_motion by;
  by.rotation = Eigen::AngleAxisd(degrees * pi / 180, Vector(1, -2, 2).normalized()).toRotationMatrix();
  by.translation = centre - by.rotation * centre + shift;
  return by * truth;
}

// Motions that are all wrong, by much.
Motions wrong_motions(const Rigid_motion& truth, const Vector& centre)
{
  Motions motions;
  for (const double degrees : {60., 120., 180.}) motions.push_back(aff(off(truth, centre, degrees, Vector(0, 0, 0.1))));
  return motions;
}

const Result::Stage& stage(const Result& result, const std::string& name)
{
  const auto found = std::find_if(result.statistics().begin(), result.statistics().end(),
                                  [&](const Result::Stage& s) { return s.name == name; });
  BOOST_TEST_REQUIRE((found != result.statistics().end()), "no stage " << name);
  return *found;
}

std::size_t count(const CR::internal::Candidate_source& candidates, const std::string& name)
{
  for (const auto& s : candidates.stages())
    if (s.name == name) return s.count;
  BOOST_ERROR("no stage " + name);
  return 0;
}

} // namespace

BOOST_AUTO_TEST_CASE(a_known_motion_among_wrong_ones_in_either_order)
{
  // One of the two orders is turned round by the pipeline, as it looks for the smaller scan in the larger one.
  const View &a = view(0, 0), &b = view(0, 45, 0.2, 250);
  BOOST_TEST(a.scan.reduced().coarse.surfels.size() != b.scan.reduced().coarse.surfels.size());
  const Rigid_motion truth = true_motion(a, b);
  Motions motions = wrong_motions(truth, a.centre);
  motions.insert(motions.begin() + 1, aff(off(truth, a.centre, 2, Vector(0, 0, a.scan.spacing()))));
  const Known_motions generator(a.scan, {motions});
  const Result there = CR::register_scans(a.scan, b.scan, p::candidates(generator));
  check_right(there, a, b);
  const Result back = CR::register_scans(b.scan, a.scan, p::candidates(generator));
  check_right(back, b, a);
  const Rigid_motion product = to_rigid_motion(there.transformation()) * to_rigid_motion(back.transformation());
  BOOST_TEST((product.rotation - Matrix::Identity()).norm() < 1e-13);
  BOOST_TEST(product.translation.norm() < 1e-12);
#ifdef CGAL_LINKED_WITH_TBB
  check_same_bits(there, CR::register_scans<CGAL::Parallel_tag>(a.scan, b.scan, p::candidates(generator)));
#endif
  // And of meshes.
  const Mesh source = mesh_of(a.image), target = mesh_of(b.image);
  check_right(CR::register_meshes(source, target, p::candidates(Known_motions(Scan(source), {motions}))), a, b);
  check_right(CR::register_meshes(target, source, p::candidates(Known_motions(Scan(source), {motions}))), b, a);
}

// What users see of a built-in generator is a generator, too.
BOOST_AUTO_TEST_CASE(a_generator_that_borrows_from_the_default)
{
  const View &a = view(0, 0), &b = view(0, 45);
  check_right(CR::register_scans(a.scan, b.scan, p::candidates(Borrowed_candidates())), a, b);
  check_right(CR::register_scans(b.scan, a.scan, p::candidates(Borrowed_candidates())), b, a);
  // One after the other: rounds of the default end.
  auto rounds = CR::Oriented_pair_candidates().rounds(a.scan, b.scan);
  bool is_among = false;
  int n = 0;
  for (;; ++n) {
    const Motions motions = rounds([] { return true; });
    if (rounds.is_done()) break;
    BOOST_TEST_REQUIRE(n < 10);
    for (const Motion& m : motions) {
      BOOST_TEST(is_rigid(m));
      is_among = is_among || angle_between(to_rigid_motion(m), true_motion(a, b)) < 5;
    }
  }
  BOOST_TEST(n > 1);
  BOOST_TEST(is_among);
}

BOOST_AUTO_TEST_CASE(rounds_are_asked_for_until_a_motion_is_certain)
{
  const View &a = view(0, 0), &b = view(0, 45);
  const Rigid_motion truth = true_motion(a, b);
  const Motions wrong = wrong_motions(truth, a.centre), right{aff(off(truth, a.centre, 1, Vector::Zero()))};
  // An empty round is not the end.
  const Known_motions late(a.scan, {{}, wrong, {}, right, wrong});
  const Result result = CR::register_scans(a.scan, b.scan, p::candidates(late));
  check_right(result, a, b);
  BOOST_TEST(late.log().asked == 4u);
  BOOST_TEST(!late.log().is_told_to_stop);
  BOOST_TEST(stage(result, "propose").count == 4u);
  BOOST_TEST(stage(result, "judge").count >= 1u);
  BOOST_TEST(stage(result, "judge").count <= wrong.size() + right.size());

  for (const std::vector<Motions>& rounds : {std::vector<Motions>(), {{}}, {{}, {}, {}}}) {
    const Result nothing = CR::register_scans(a.scan, b.scan, p::candidates(Known_motions(a.scan, rounds)));
    check_not_registered(nothing);
    BOOST_TEST(nothing.status() == CR::NOT_REGISTERED);
    BOOST_TEST(nothing.reason().find("no overlap found") == 0u);
    BOOST_TEST(stage(nothing, "propose").count == rounds.size());
    BOOST_TEST(stage(nothing, "judge").count == 0u);
    BOOST_TEST(stage(nothing, "refine").count == 0u);
  }
  check_not_registered(CR::register_scans(a.scan, b.scan, p::candidates(Known_motions(a.scan, {wrong, wrong}))));
}

BOOST_AUTO_TEST_CASE(the_end_of_a_run_reaches_the_generator)
{
  const View &a = view(0, 0), &b = view(0, 45);
  const Rigid_motion truth = true_motion(a, b);
  Impatient impatient(1, 0);
  const Known_motions generator(a.scan, {{aff(truth)}});
  const Result result = CR::register_scans(a.scan, b.scan, p::candidates(generator).visitor(std::ref(impatient)));
  BOOST_TEST(generator.log().is_told_to_stop);
  check_not_registered(result);
  BOOST_TEST(result.reason().find("interrupted") == 0u);
}

// For either order of the scans, of which the pipeline exchanges one.
BOOST_AUTO_TEST_CASE(the_crude_motion_is_as_it_was_proposed)
{
  const View &a = view(0, 0), &b = view(0, 45, 0.2, 250);
  for (const auto& [source, target] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    const Rigid_motion truth = true_motion(*source, *target),
                       proposed = off(truth, source->centre, 1.5, source->scan.spacing() * Vector(1, 1, 1));
    const Result result =
        CR::register_scans(source->scan, target->scan, p::candidates(Known_motions(source->scan, {{aff(proposed)}})));
    check_right(result, *source, *target);
    BOOST_TEST(result.correspondence().empty()); // nobody knows what it was proposed by
    const Rigid_motion crude = to_rigid_motion(result.crude_transformation()),
                       refined = to_rigid_motion(result.transformation());
    // The pipeline computes in float, in frames in the middle of the scans.
    constexpr double precision = 16 * 1.2e-7;
    BOOST_TEST((crude.rotation - proposed.rotation).norm() < precision);
    BOOST_TEST((crude(source->centre) - proposed(source->centre)).norm() < precision * source->scan.extent());
    BOOST_TEST(difference(refined, truth, source->centre) < 0.2 * difference(crude, truth, source->centre));
  }
}

// Bounds that follow from what the numbers are, whatever is proposed.
BOOST_AUTO_TEST_CASE(score_and_violations_are_those_of_the_answer)
{
  const View &a = view(0, 0), &b = view(0, 45);
  const Rigid_motion truth = true_motion(a, b);
  const auto registered = [&](const Scan& source, const Scan& target, const Rigid_motion& motion) {
    return CR::register_scans(source, target, p::candidates(Known_motions(source, {{aff(motion)}})));
  };
  const Result right = registered(a.scan, b.scan, truth);
  BOOST_TEST(right.free_space_violations() < 0.02);
  BOOST_TEST(right.score() > 0); // rather right than not
  const Result wrong = registered(a.scan, b.scan, off(truth, a.centre, 60, Vector(0, 0, 0)));
  BOOST_TEST(wrong.score() < right.score());
  // Two proposals that refinement makes one have one answer.
  const Result near = registered(a.scan, b.scan, off(truth, a.centre, 1, a.scan.spacing() * Vector(0, 1, 0)));
  BOOST_TEST(std::abs(near.score() - right.score()) < 0.05 * right.score());
  BOOST_TEST(std::abs(near.free_space_violations() - right.free_space_violations()) < 0.01);

  // Nothing is known of what is empty around closed bodies.
  Mesh statue;
  CR::make_statue(statue, 48);
  const Scan closed(statue);
  for (const double degrees : {0., 90.}) {
    const Result result = registered(closed, closed, off(Rigid_motion(), Vector::Zero(), degrees, Vector(0.1, 0, 0)));
    check_proper(result);
    BOOST_TEST(!result.source_has_free_space());
    BOOST_TEST(result.free_space_violations() == 0);
  }
  // Of two scans with their sensors one may lie wholly in front of the other, but neither counts more than once.
  for (const double degrees : {40., 90., 180.})
    for (const double shift : {-1., -0.5, 0.5, 1.})
      check_proper(registered(a.scan, b.scan, off(truth, a.centre, degrees, Vector(0, 0, shift))));
}

// As they are documented, in their order; a stage that worked on something took some time.
BOOST_AUTO_TEST_CASE(statistics)
{
  using Clock = std::chrono::steady_clock;
  const View &a = view(0, 0), &b = view(0, 45);
  const CR::Trihedron_candidates trihedra;
  const Scan c(view(0, 0, 0.1, 220, false).image, p::candidates(trihedra)),
      d(view(0, 45, 0.1, 220, false).image, p::candidates(trihedra));
  const auto check = [](const Result& result, const Scan& source, const Scan& target,
                        const std::vector<std::string>& parts, double seconds) {
    std::vector<std::string> names{"reduce", "propose"}, found;
    for (const std::string& part : parts) names.push_back("propose: " + part);
    names.insert(names.end(), {"judge", "refine", "conclude"});
    double sum = 0, sum_of_parts = 0;
    for (const Result::Stage& s : result.statistics()) {
      found.push_back(s.name);
      BOOST_TEST((s.count == 0 || s.seconds > 0), s.name);
      BOOST_TEST(s.count > 0u, s.name);
      BOOST_TEST(s.seconds < 100);
      if (s.name.find(':') != std::string::npos) sum_of_parts += s.seconds;
      else if (s.name != "reduce") sum += s.seconds;
    }
    BOOST_TEST(found == names, boost::test_tools::per_element());
    BOOST_TEST(stage(result, "reduce").count == source.number_of_samples() + target.number_of_samples());
    BOOST_TEST(stage(result, "conclude").count == result.runners_up().size() + 1);
    BOOST_TEST(sum_of_parts <= stage(result, "propose").seconds);
    BOOST_TEST(sum <= seconds);
  };
  const auto timed = [](const auto& call) {
    const auto start = Clock::now();
    const Result result = call();
    return std::pair(result, std::chrono::duration<double>(Clock::now() - start).count());
  };
  const auto by_pairs = timed([&] { return CR::register_scans(a.scan, b.scan); });
  check(by_pairs.first, a.scan, b.scan, {"pairs", "looks", "scores"}, by_pairs.second);
  const auto by_trihedra = timed([&] { return CR::register_scans(c, d, p::candidates(trihedra)); });
  check(by_trihedra.first, c, d, {"trihedra", "matches", "estimates"}, by_trihedra.second);
  const auto by_user = timed([&] {
    return CR::register_scans(a.scan, b.scan, p::candidates(Known_motions(a.scan, {{aff(true_motion(a, b))}})));
  });
  check(by_user.first, a.scan, b.scan, {}, by_user.second);
  // The simplification is a part of the reduction.
  const Result plain = CR::register_scans(Scan(view(0, 0, 0.1, 220, false).image), d);
  BOOST_TEST(stage(by_trihedra.first, "reduce").seconds > stage(plain, "reduce").seconds);
}

namespace {

struct Pair_search
{
  std::size_t pairs, candidates;
};

// All rounds of the default with these bounds, of a scan in itself.
Pair_search search_by_pairs(const Scan& scan, double f1, double f2)
{
  CR::internal::Oriented_pair_parameters parameters;
  parameters.minimum_extent = f1;
  parameters.maximum_extent = f2;
  CR::internal::Oriented_pair_search search(scan.reduced(), scan.reduced(), parameters,
                                            CR::internal::Execution::SEQUENTIAL);
  CR::internal::Run_control to_the_end;
  std::size_t candidates = 0;
  while (const auto proposals = search.next(to_the_end)) candidates += proposals->poses.size();
  return {count(search, "propose: pairs"), candidates};
}

// Two pieces of a bumpy surface of size 0.3, `apart` apart.
Mesh two_pieces(double apart)
{
  Flat_mesh mesh = generated::bumps(45, 0.3);
  Rigid_motion shift;
  shift.translation = Vector(apart, 0, 0);
  const Flat_mesh other = generated::moved(generated::bumps(45, 0.3), shift);
  const auto first = std::int32_t(mesh.points.size());
  mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
  for (const auto& f : other.faces) mesh.faces.push_back({f[0] + first, f[1] + first, f[2] + first});
  return mesh_of(mesh);
}

} // namespace

// Pairs are within a piece, up to its diagonal, or from one to the other: there is none in between.
BOOST_AUTO_TEST_CASE(bounds_of_the_lengths_of_pairs)
{
  const Scan scan(two_pieces(3));
  const double M = scan.extent(), within = 0.3 * std::sqrt(2.2) / M, between = 2.7 / M;
  BOOST_TEST_REQUIRE(within < 0.45);
  BOOST_TEST_REQUIRE(between > 2);
  BOOST_TEST(search_by_pairs(scan, 0, 0.3).pairs > 0u);
  BOOST_TEST(search_by_pairs(scan, 0.05, 0.2).pairs > 0u);
  for (const auto& [f1, f2] : {std::pair(0.5, 0.6), std::pair(0.5, 2.), std::pair(1.2, 1.5), std::pair(0.45, 1.)}) {
    const Pair_search found = search_by_pairs(scan, f1, f2);
    BOOST_TEST(found.pairs == 0u);
    BOOST_TEST(found.candidates == 0u);
    // The public call, too.
    const Result result = CR::register_scans(scan, scan, p::minimum_extent(f1).maximum_extent(f2));
    BOOST_TEST(result.status() == CR::NOT_REGISTERED);
    BOOST_TEST(stage(result, "propose: pairs").count == 0u);
  }
  BOOST_TEST(search_by_pairs(scan, 2.1, 2.4).pairs > 0u);
}

// A body whose longest diameter is 1.1 M, and of which f1 = 1.2, f2 = 1.5 find nothing.
BOOST_AUTO_TEST_CASE(bounds_above_the_size_of_a_scan)
{
  Flat_mesh body = generated::sphere(30, 1);
  for (Vector& q : body.points) {
    const Vector d = q.normalized();
    q *= 1 + 0.12 * d.x() * d.y() * d.z() * 5 + 0.04 * std::sin(5 * d.x() + 2 * d.y());
  }
  const Scan scan(mesh_of(body));
  double longest = 0; // by all pairs
  for (const Vector& q : body.points)
    for (const Vector& r : body.points) longest = (std::max)(longest, (q - r).squaredNorm());
  longest = std::sqrt(longest) / scan.extent();
  BOOST_TEST_MESSAGE("longest diameter: " << longest << " M");
  BOOST_TEST_REQUIRE(longest < 1.19);
  BOOST_TEST_REQUIRE(longest > 1.02);
  BOOST_TEST(search_by_pairs(scan, 0.8, 1.1).pairs > 0u);
  for (const auto& [f1, f2] : {std::pair(1.2, 1.5), std::pair(5., 6.)}) {
    BOOST_TEST(search_by_pairs(scan, f1, f2).pairs == 0u);
    const Result result = CR::register_scans(scan, scan, p::minimum_extent(f1).maximum_extent(f2));
    BOOST_TEST(result.status() == CR::NOT_REGISTERED);
  }
}
