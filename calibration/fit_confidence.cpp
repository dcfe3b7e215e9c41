// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// Measures what the judgement of poses needs to know, on generated scans, and writes the header that holds it.
//
// Bodies, bodies on pedestals, machined parts and rooms are seen by sensors from fine to coarse, with and without their
// sensor; right, disjoint, mirrored and foreign pairs are searched, of one sensor and of two. How probes come out under
// right poses and under the candidates gives the tables; evidence and truth of the distinct poses, after each round of
// the search, the coefficients of the confidence, by conditional logistic regression (McFadden 1974). Each setting, a
// sensor and a kind of scene, is judged by coefficients fitted to the others: Brier score and reliability are of these.
//
// With --check nothing is fitted: the coefficients of the header are judged, and what is returned says whether they are
// calibrated.

#include "../benchmark/Crude_registration/command_line.h"
#include "conditional_logit.h"
#include "simulated_set.h"

#include <CGAL/Crude_registration/IO/write_file.h>
#include <CGAL/Crude_registration/internal/judgement/Pose_judge.h>
#include <CGAL/Crude_registration/internal/matching/Oriented_pair_search.h>
#include <CGAL/Crude_registration/register_scans.h>

#include <boost/program_options.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <functional>
#include <iomanip>
#include <iostream>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace CR = CGAL::Crude_registration;
namespace CRI = CR::internal;
namespace po = boost::program_options;
using benchmark_tools::mirrored;
using benchmark_tools::scan_of;
using benchmark_tools::Sensor_model;
using benchmark_tools::Simulated_set;
using Kernel = Simulated_set::Kernel;
using Scan = CR::Scan<Kernel>;
using Coefficients = CRI::Evidence_coefficients;

namespace {

// The criterion of the comparison: 5 degrees, and 5 % of the diagonal of the source.
bool is_right(const CRI::Pose& pose, const CRI::Rigid_motion& truth, const CRI::Reduced_scan& source)
{
  const CRI::Pose t = CRI::to_pose(truth);
  const Eigen::AngleAxisf turn(CRI::Matrix_f(pose.rotation * t.rotation.transpose()));
  if (turn.angle() >= 5 * float(CGAL_PI) / 180) return false;
  double squared = 0;
  CRI::Vector_f low = source.fine.surfels.front().position, high = low;
  for (const CRI::Surfel& s : source.fine.surfels) {
    squared += double((pose(s.position) - t(s.position)).squaredNorm());
    low = low.cwiseMin(s.position);
    high = high.cwiseMax(s.position);
  }
  return std::sqrt(squared / double(source.fine.surfels.size())) < 0.05 * double((high - low).norm());
}

// A pair of scans that is searched, in the frames and the order of the search.
struct Pair
{
  const CRI::Reduced_scan* source;
  const CRI::Reduced_scan* target;
  std::optional<CRI::Rigid_motion> truth; // none where there is no right pose
  std::size_t setting;
};

using Round_function = std::function<void(const Pair&, const CRI::Pose_judge&, int round)>;

// Searches a pair to the end, and calls the function after each round. `truth`: of the input, or null.
void search(std::size_t setting, const Scan& a, const Scan& b, const CRI::Rigid_motion* truth,
            const Coefficients& coefficients, const Round_function& function)
{
  const bool is_swapped = a.reduced().coarse.surfels.size() > b.reduced().coarse.surfels.size();
  const CRI::Reduced_scan &source = is_swapped ? b.reduced() : a.reduced(),
                          &target = is_swapped ? a.reduced() : b.reduced();
  if (source.coarse.surfels.size() < 4) return;
  Pair pair{&source, &target, std::nullopt, setting};
  if (truth)
    pair.truth = target.own_from_input * (is_swapped ? truth->inverse() : *truth) * source.own_from_input.inverse();
  CRI::Oriented_pair_search candidates(source, target, CRI::Oriented_pair_parameters(), CRI::Execution::SEQUENTIAL);
  CRI::Pose_judge judge(source, target, CRI::Execution::SEQUENTIAL, CRI::to_the_end(), coefficients);
  for (int round = 0;; ++round) {
    std::optional<CRI::Proposals> proposals = candidates.next(CRI::to_the_end());
    if (!proposals) return;
    judge.add_round(std::move(*proposals));
    function(pair, judge, round);
  }
}

struct Generation
{
  std::vector<Sensor_model> sensors;
  unsigned first_seed;
  std::size_t seeds, views;
};

// All pairs of the views of all scenes, and every other view with the next one in a mirror and with that of another
// scene.
// Returns the number of settings and of pairs.
std::pair<std::size_t, std::size_t> for_each_pair(const Generation& generation, const Coefficients& coefficients,
                                                  const Round_function& function)
{
  std::size_t setting = 0, pairs = 0;
  for (std::size_t k = 0; k < generation.sensors.size(); ++k) {
    // Views by turns from this one and from one that is unlike it.
    constexpr std::size_t further = 5;
    const Sensor_model &sensor = generation.sensors[k],
                       &other = generation.sensors[(k + further) % generation.sensors.size()];
    for (const std::string kind : {"statue", "pedestal", "plinth", "part", "room"}) {
      std::vector<Scan> foreign;
      for (std::size_t s = 0; s < generation.seeds; ++s) {
        const Simulated_set set(kind, generation.first_seed + unsigned(s), generation.views,
                                360. / double(generation.views), std::vector<Sensor_model>{sensor, other});
        std::vector<Scan> scans;
        for (std::size_t i = 0; i < generation.views; ++i)
          scans.push_back(scan_of(set.views()[i].image, (i + s) % 3 != 2));
        const auto pair = [&](const Scan& a, const Scan& b, const CRI::Rigid_motion* truth) {
          search(setting, a, b, truth, coefficients, function);
          ++pairs;
        };
        for (std::size_t i = 0; i < generation.views; ++i)
          for (std::size_t j = i + 1; j < generation.views; ++j) {
            const CRI::Rigid_motion truth = set.motion(i, j);
            pair(scans[i], scans[j], set.overlap(i, j) > 0 ? &truth : nullptr);
          }
        for (std::size_t i = 0; i < generation.views; i += 2) {
          const auto& next = set.views()[(i + 1) % generation.views].image;
          pair(scans[i], scan_of(mirrored(next), (i + s) % 3 != 1), nullptr);
          if (!foreign.empty()) pair(foreign[i], scans[i], nullptr);
        }
        foreign = std::move(scans);
      }
      std::cerr << kind << ", " << sensor.samples << " and " << other.samples << " samples: " << pairs
                << " pairs so far\n";
      ++setting;
    }
  }
  return {setting, pairs};
}

// Shares of outcomes, every pair of scans counting the same.
struct Tally
{
  std::array<double, CRI::Outcome::SIZE> shares{}; // sums over the pairs
  double pairs = 0;

  // UNKNOWN counts where `all` are asked for.
  void add(const std::array<double, CRI::Outcome::SIZE>& counts, bool all)
  {
    double sum = 0;
    for (std::size_t o = all ? 0 : 1; o < counts.size(); ++o) sum += counts[o];
    if (!(sum > 0)) return;
    for (std::size_t o = 0; o < counts.size(); ++o) shares[o] += counts[o] / sum;
    ++pairs;
  }
};

// The tables of the coefficients: what probes meet where the pose is right and overlaps by at least a tenth, and under
// the candidates. One more pair, in which all outcomes are the same share, keeps each above zero.
Coefficients measured_tables(const Generation& generation)
{
  Tally right, wrong;
  for_each_pair(generation, {}, [&](const Pair& pair, const CRI::Pose_judge& judge, int round) {
    if (round == 0) {
      if (pair.truth) {
        const CRI::Pose refined = judge.refined(CRI::to_pose(*pair.truth));
        if (is_right(refined, *pair.truth, *pair.source)) {
          std::array<double, CRI::Outcome::SIZE> counts{};
          double agreeing = 0;
          const auto outcomes = judge.outcomes(refined);
          for (const std::uint8_t o : outcomes) {
            ++counts[o];
            agreeing += o != CRI::Outcome::UNKNOWN && o <= CRI::Outcome::fits;
          }
          constexpr double enough = 0.1;
          if (agreeing >= enough * double(outcomes.size())) right.add(counts, false);
        }
      }
      std::array<double, CRI::Outcome::SIZE> counts{};
      for (const CRI::Outcome_table* table : {&judge.source_outcomes(), &judge.target_outcomes()})
        for (const std::size_t k : judge.tried_candidates())
          for (std::size_t i = 0; i < table->probes(); ++i) ++counts[(*table)[k][i]];
      wrong.add(counts, true);
    }
  });
  Coefficients c;
  const auto fits = [](const Tally& tally, double(&result)[CRI::Outcome::fits]) {
    double agreeing = 1;
    for (int o = 1; o <= CRI::Outcome::fits; ++o) agreeing += tally.shares[std::size_t(o)];
    for (int o = 1; o <= CRI::Outcome::fits; ++o)
      result[o - 1] = (tally.shares[std::size_t(o)] + 1. / CRI::Outcome::fits) / agreeing;
  };
  const auto kinds = [](const Tally& tally, double(&result)[CRI::Outcome::kinds]) {
    for (int kind = 0; kind < CRI::Outcome::kinds; ++kind) {
      double sum = 1. / CRI::Outcome::kinds;
      for (int o = 1; o < CRI::Outcome::SIZE; ++o)
        if (CRI::Outcome::kind(std::uint8_t(o)) == kind) sum += tally.shares[std::size_t(o)];
      result[kind] = sum / (tally.pairs + 1);
    }
  };
  kinds(right, c.right);
  kinds(wrong, c.wrong);
  fits(right, c.right_fit);
  fits(wrong, c.wrong_fit);
  return c;
}

// What a round says: of each distinct pose the evidence, and which one is right; -1: none.
struct Choice
{
  std::vector<CRI::Pose_evidence> poses;
  int right;
  std::size_t setting, search; // the number of the search, rounds of which follow each other
  bool is_last = false;        // of them
};

std::vector<Choice> choices_of(const Generation& generation, const Coefficients& coefficients)
{
  std::vector<Choice> choices;
  std::size_t searches = 0;
  for_each_pair(generation, coefficients, [&](const Pair& pair, const CRI::Pose_judge& judge, int round) {
    Choice choice;
    searches += std::size_t(round == 0);
    choice.search = searches;
    choice.right = -1;
    choice.setting = pair.setting;
    for (CRI::Judged_pose& p : judge.distinct_poses()) {
      if (choice.right < 0 && pair.truth && is_right(p.pose, *pair.truth, *pair.source))
        choice.right = int(choice.poses.size());
      judge.add_variety_and_spread(p); // by other coefficients another one may lead
      choice.poses.push_back(p.evidence);
    }
    if (!choice.poses.empty()) choices.push_back(choice);
  });
  for (std::size_t i = 0; i < choices.size(); ++i)
    choices[i].is_last = i + 1 == choices.size() || choices[i + 1].search != choices[i].search;
  return choices;
}

std::vector<CRI::Judged_pose> judged(const Choice& choice, const Coefficients& c)
{
  std::vector<CRI::Judged_pose> poses(choice.poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    poses[i].evidence = choice.poses[i];
    poses[i].log_weight = CRI::log_weight(choice.poses[i], choice.poses[i].tried, c);
  }
  return poses;
}

constexpr std::size_t no_setting = (std::numeric_limits<std::size_t>::max)();

// The law of which pose is right, if one is: without what says whether one is.
struct Law_of_shares
{
  using Logit = benchmark_tools::Conditional_logit<3, false>;
  static void set(const Logit::Estimate& e, Coefficients& c)
  {
    c.share = {};
    c.share.slope = e.coefficients[0];
    c.share.residual = e.coefficients[1];
    c.share.violations = e.coefficients[2];
    c.share.lapse = e.lapse;
  }
  static Logit logit(const std::vector<Choice>& choices, const Coefficients& c)
  {
    Logit result;
    for (const Choice& choice : choices) {
      if (choice.right < 0) continue;
      std::vector<Logit::Features> poses;
      for (const CRI::Pose_evidence& e : choice.poses)
        poses.emplace_back(CRI::root_of_evidence(e, e.tried, c), e.residual, std::sqrt(e.violations));
      result.add_choice(poses, choice.right, choice.setting);
    }
    return result;
  }
};

// Of each choice whether any of the poses is right, by `features`, a function of the leading one and of the choice.
template <class Logit, class Features>
Logit logit_of_any(const std::vector<Choice>& choices, const Coefficients& c, bool is_usual, const Features& features)
{
  Logit result;
  for (const Choice& choice : choices) {
    const std::vector<CRI::Judged_pose> poses = judged(choice, c);
    result.add_choice({features(CRI::leading_pose(poses, is_usual, c), choice)}, choice.right < 0 ? -1 : 0,
                      choice.setting);
  }
  return result;
}

// The law of whether any of the poses is right.
struct Law_of_any
{
  using Logit = benchmark_tools::Conditional_logit<7>;
  static void set(const Logit::Estimate& e, Coefficients& c)
  {
    const auto& b = e.coefficients;
    c.any = {b[0], b[1], b[2], b[3], b[4], b[5], b[6], e.lapse};
  }
  static Logit logit(const std::vector<Choice>& choices, const Coefficients& c)
  {
    return logit_of_any<Logit>(choices, c, false, [](const CRI::Leading_pose& leading, const Choice& choice) {
      const CRI::Lead_features of(leading, choice.is_last);
      Logit::Features f;
      f << of.fit, of.violations, of.lead, of.distinction, of.spread, of.tried_all, 1;
      return f;
    });
  }
};

// The same as chance is between any two scans, whatever the other poses are.
struct Law_of_usual_any
{
  using Logit = benchmark_tools::Conditional_logit<5>;
  static void set(const Logit::Estimate& e, Coefficients& c)
  {
    const auto& b = e.coefficients;
    c.usual_any = {b[0], b[1], b[2], b[3], b[4], e.lapse};
  }
  static Logit logit(const std::vector<Choice>& choices, const Coefficients& c)
  {
    return logit_of_any<Logit>(choices, c, true, [](const CRI::Leading_pose& leading, const Choice&) {
      const CRI::Pose_evidence& e = leading.pose->evidence;
      Logit::Features f;
      f << leading.root, e.residual, std::sqrt(e.violations), e.variety, 1;
      return f;
    });
  }
};

// Sets a law, fitted to all choices but those of a setting; returns the log-likelihood. `held`: a lapse that is not to
// be fitted.
template <class Law>
double fit_law(const std::vector<Choice>& choices, std::size_t without, std::optional<double> held, Coefficients& c)
{
  typename Law::Logit::Estimate start;
  start.lapse = held.value_or(0.01);
  const typename Law::Logit::Estimate e = Law::logit(choices, c).fit(without, start, held.has_value());
  Law::set(e, c);
  return e.log_likelihood;
}

// The most likely coefficients, of the number of surfels to within a factor of two.
Coefficients fit(const std::vector<Choice>& choices, Coefficients c)
{
  Coefficients best;
  double greatest = -(std::numeric_limits<double>::max)();
  for (const double surfels : {25., 50., 100., 200., 400., 800.}) {
    c.surfels = surfels;
    double log_likelihood = fit_law<Law_of_shares>(choices, no_setting, std::nullopt, c);
    log_likelihood += fit_law<Law_of_any>(choices, no_setting, std::nullopt, c);
    if (log_likelihood <= greatest) continue;
    greatest = log_likelihood;
    best = c;
  }
  fit_law<Law_of_usual_any>(choices, no_setting, std::nullopt, best);
  return best;
}

// The same without a setting, of which `c` is of all. The lapses and the number of surfels stay: they are too seldom
// seen in one.
Coefficients fit_without(std::size_t setting, const std::vector<Choice>& choices, Coefficients c)
{
  fit_law<Law_of_shares>(choices, setting, c.share.lapse, c);
  fit_law<Law_of_any>(choices, setting, c.any.lapse, c);
  return c;
}

// The most probable pose of a choice: its probability, and whether it is the right one.
struct Answer
{
  double probability;
  bool is_right;
};

Answer answer(const Choice& choice, const Coefficients& c)
{
  std::vector<CRI::Judged_pose> poses = judged(choice, c);
  CRI::share_probability(poses, false, choice.is_last, c);
  const auto best =
      std::max_element(poses.begin(), poses.end(), [](const CRI::Judged_pose& a, const CRI::Judged_pose& b) {
        return a.probability < b.probability;
      });
  return {best->probability, best - poses.begin() == choice.right};
}

// Of the answers to the choices, those that are given: a search ends as soon as a pose is certain, or after its last
// round.
std::vector<Answer> given(const std::vector<Choice>& choices, const std::vector<Answer>& answers)
{
  std::vector<Answer> result;
  for (std::size_t i = 0; i < choices.size();) {
    std::size_t end = i;
    while (end < choices.size() && choices[end].search == choices[i].search) ++end;
    std::size_t last = i;
    while (last + 1 < end && answers[last].probability < CRI::certain) ++last;
    result.push_back(answers[last]);
    i = end;
  }
  return result;
}

struct Calibration
{
  double brier = 0, error = 0; // expected calibration error
  std::size_t believed = 0, believed_and_wrong = 0;
};

// Prints how often answers are right by their probability.
Calibration print_reliability(const std::vector<Answer>& answers)
{
  Calibration result;
  const std::array<double, 8> edges = {0, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 1.0001};
  std::cout << "probability  answers   right  share right  mean probability\n" << std::fixed << std::setprecision(4);
  const auto n = double(answers.size());
  for (std::size_t e = 0; e + 1 < edges.size(); ++e) {
    double count = 0, right = 0, sum = 0;
    for (const Answer& a : answers)
      if (a.probability >= edges[e] && a.probability < edges[e + 1]) {
        ++count;
        right += double(a.is_right);
        sum += a.probability;
      }
    if (count > 0) result.error += std::abs(right - sum) / n;
    std::cout << std::setprecision(2) << edges[e] << " - " << (std::min)(edges[e + 1], 1.) << std::setw(9) << int(count)
              << std::setw(8) << int(right) << std::setprecision(4) << std::setw(12) << (count > 0 ? right / count : 0)
              << std::setw(14) << (count > 0 ? sum / count : 0) << '\n';
  }
  for (const Answer& a : answers) {
    result.brier += std::pow(a.probability - double(a.is_right), 2) / n;
    result.believed += a.probability >= CRI::believed;
    result.believed_and_wrong += a.probability >= CRI::believed && !a.is_right;
  }
  std::cout << answers.size() << " answers, Brier score " << result.brier << ", expected calibration error "
            << result.error << "; believed " << result.believed << ", of these wrong " << result.believed_and_wrong
            << '\n';
  return result;
}

void write_header(std::ostream& out, const Coefficients& c, const Calibration& calibration, const std::string& how)
{
  out << "// Copyright (c) 2026 The Crude_registration authors.\n// All rights reserved.\n//\n"
         "// This file is part of the CGAL package Crude_registration.\n//\n// $"
         "URL$\n// $"
         "Id$\n// SPDX-License-Identifier: GPL-3.0-or-later\n//\n"
         "// Author(s)     : The Crude_registration authors\n\n"
         "#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_EVIDENCE_COEFFICIENTS_H\n"
         "#define CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_EVIDENCE_COEFFICIENTS_H\n\n"
         "// What was measured of right and wrong poses of generated scans, by which evidence is weighed: written by\n"
         "// calibration/fit_confidence, and not by hand.\n"
      << how
      << "\nnamespace CGAL {\nnamespace Crude_registration {\nnamespace internal {\n\n"
         "// A linear law: slope root(evidence) + residual (RMS of the probes that agree, in tolerances) + violations "
         "sqrt(probes in\n// free space a probe that agrees) + variety (logarithm of the number of planes that agree) "
         "+ offset; lapse: the share of\n// answers that obey no such law.\n"
         "struct Evidence_law\n{\n  double slope = 0, residual = 0, violations = 0, variety = 0, offset = 0, lapse = "
         "0;\n};\n\n"
         "// The same of Lead_features.\n"
         "struct Lead_law\n{\n"
         "  double fit = 0, violations = 0, lead = 0, distinction = 0, spread = 0, tried_all = 0, offset = 0, lapse = "
         "0;\n"
         "};\n\n"
         "struct Evidence_coefficients\n{\n"
      << std::setprecision(5);
  const auto list = [&](const char* name, const double* values, std::size_t n) {
    out << "  double " << name << '[' << n << "] = {";
    for (std::size_t i = 0; i < n; ++i) out << (i > 0 ? ", " : "") << values[i];
    out << "};\n";
  };
  out << "  // The shares of the outcomes, of the probes that have one, where the pose is right: agrees, disagrees, "
         "in\n"
         "  // free space, missing.\n";
  list("right", c.right, 4);
  out << "  // Their shares of all probes under the candidates of a pair.\n";
  list("wrong", c.wrong, 4);
  out << "  // Of the probes that agree where the pose is right, by residual (up to 1/8, 1/4, 1/2, 1 of the "
         "tolerance),\n"
         "  // and for each of these by the angle between the normals (up to 1/3, 2/3, 1 of the tolerance).\n";
  list("right_fit", c.right_fit, 12);
  out << "  // The same under the candidates of a pair.\n";
  list("wrong_fit", c.wrong_fit, 12);
  const auto law = [&](const char* name, const CRI::Evidence_law& l) {
    out << "  Evidence_law " << name << " = {" << l.slope << ", " << l.residual << ", " << l.violations << ", "
        << l.variety << ", " << l.offset << ", " << l.lapse << "};\n";
  };
  out << "  // The root is of n / (n + surfels) evidence a probe; n: of the scan with fewer.\n  double surfels = "
      << c.surfels << ";\n  // The logarithms of the weights of distinct poses, if one is right.\n";
  law("share", c.share);
  out << "  // The log-odds that one of them is right, and the same as chance is between any two scans.\n";
  out << "  Lead_law any = {" << c.any.fit << ", " << c.any.violations << ", " << c.any.lead << ", "
      << c.any.distinction << ", " << c.any.spread << ", " << c.any.tried_all << ", " << c.any.offset << ", "
      << c.any.lapse << "};\n";
  law("usual_any", c.usual_any);
  out << std::setprecision(3)
      << "  // By how much the probabilities are off: the expected calibration error, in cross-validation.\n"
         "  double calibration_error = "
      << calibration.error << ";\n";
  out << "};\n\n} // namespace internal\n} // namespace Crude_registration\n} // namespace CGAL\n\n"
         "#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_EVIDENCE_COEFFICIENTS_H\n";
}

} // namespace

int main(int argc, char** argv)
{
  try {
    Generation generation;
    std::string output;
    std::vector<std::size_t> chosen;
    po::options_description options("fit_confidence: measures what the judgement of poses needs to know");
    options.add_options()("help,h", "this text")("seeds", po::value(&generation.seeds)->default_value(3),
                                                 "scenes of each kind")(
        "first-seed", po::value(&generation.first_seed)->default_value(101),
        "of the scenes")("views", po::value(&generation.views)->default_value(6), "of each scene")(
        "sensors", po::value(&chosen)->multitoken(), "numbers of the sensors, from 0; default: all")(
        "check",
        "judge the coefficients that there are, on these scenes; the exit code says whether they are calibrated")(
        "output", po::value(&output), "the header to write");
    po::variables_map values;
    if (!benchmark_tools::read_options(argc, argv, options, values)) return EXIT_SUCCESS;
    generation.sensors = benchmark_tools::all_sensors();
    if (!chosen.empty()) {
      std::vector<Sensor_model> some;
      for (const std::size_t i : chosen) some.push_back(generation.sensors.at(i));
      generation.sensors = some;
    }

    std::vector<Answer> answers;
    if (values.count("check") != 0) {
      const std::vector<Choice> choices = choices_of(generation, {});
      for (const Choice& choice : choices) answers.push_back(answer(choice, {}));
      const Calibration calibration = print_reliability(given(choices, answers));
      // As many as may be wrong by the probabilities themselves, and twice their standard deviation.
      const double expected = (1 - CRI::believed) * double(calibration.believed);
      const bool is_calibrated =
          double(calibration.believed_and_wrong) <= expected + 2 * std::sqrt(expected) && calibration.error <= 0.05;
      return is_calibrated ? EXIT_SUCCESS : EXIT_FAILURE;
    }

    // Tables by other scenes than those that the coefficients are fitted to.
    Generation for_tables = generation;
    for_tables.first_seed += 1000;
    for_tables.seeds = 1;
    const Coefficients tables = measured_tables(for_tables);
    const std::vector<Choice> choices = choices_of(generation, tables);
    const std::size_t settings = choices.empty() ? 0 : choices.back().setting + 1;
    const Coefficients c = fit(choices, tables);
    answers.resize(choices.size());
    for (std::size_t without = 0; without < settings; ++without) {
      const Coefficients others = fit_without(without, choices, c);
      for (std::size_t i = 0; i < choices.size(); ++i)
        if (choices[i].setting == without) answers[i] = answer(choices[i], others);
    }
    std::cout << "After each round:\n";
    print_reliability(answers);
    answers = given(choices, answers);
    std::cout << "At the end of each search:\n";
    const Calibration calibration = print_reliability(answers);
    if (!output.empty()) {
      std::ostringstream how;
      how << "// " << settings << " settings, seeds " << generation.first_seed << " to "
          << generation.first_seed + generation.seeds - 1 << ", " << choices.size() << " rounds of " << answers.size()
          << " searches. In cross-validation by setting\n// the answers at the end of the searches have the Brier "
             "score "
          << std::setprecision(3) << calibration.brier << " and the expected calibration error " << calibration.error
          << ", and\n// of " << calibration.believed << " that were believed " << calibration.believed_and_wrong
          << " were wrong.\n";
      CR::write_file(output, [&](std::ostream& out) { write_header(out, c, calibration, how.str()); });
    }
  } catch (const std::exception& e) {
    std::cerr << "fit_confidence: " << e.what() << '\n';
    return EXIT_FAILURE;
  }
}
