// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// Measures what an assembly has to know of pairs: the values of internal/assembly/Assembly_coefficients.h.
//
// Bodies, bodies on pedestals, parts and rooms, each seen from several sides by one of the sensors, every pair of a
// scene registered; the true motions are known. Printed is how often motions that are wrong agree with each other or
// close loops, and how often a pair is wrong that is certain; then how many scans lie rightly and wrongly where each
// scene is put together, with each coefficient multiplied by some factors: the range in which it does not matter.

#include "../benchmark/Crude_registration/command_line.h"
#include "simulated_set.h"

#include <CGAL/Crude_registration/assemble_scans.h>
#include <CGAL/Crude_registration/internal/assembly/Parts.h>
#include <CGAL/Crude_registration/internal/assembly/Placed_scans.h>
#include <CGAL/Crude_registration/internal/assembly/loop_evidence.h>

#include <boost/program_options.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <deque>
#include <exception>
#include <iomanip>
#include <iostream>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace CR = CGAL::Crude_registration;
namespace CRI = CGAL::Crude_registration::internal;
namespace po = boost::program_options;
using Kernel = benchmark_tools::Simulated_set::Kernel;
using Scan = CR::Scan<Kernel>;
using CRI::Ranked_motion;
using CRI::Rigid_motion;
using CRI::Scan_pair;

namespace {

// A share that is counted by weights.
struct Share
{
  double part = 0, all = 0;

  void add(double weight, bool is_part)
  {
    all += weight;
    part += is_part ? weight : 0;
  }
  double value() const { return all > 0 ? part / all : 0; }
};

struct Measured
{
  Share agreeing, closing;
  std::size_t certain = 0, wrong = 0;
};

class Scene
{
public:
  Scene(const std::string& kind, unsigned seed, std::size_t views, const benchmark_tools::Sensor_model& sensor)
      : m_set(kind, seed, views, 45, sensor), m_scans(scans_of(m_set)), m_placed(reduced(m_scans))
  {
    for (std::size_t i = 0; i < views; ++i)
      for (std::size_t j = i + 1; j < views; ++j) {
        CRI::Pair_answer answer =
            CRI::to_pair_answer(CR::register_scans<CGAL::Parallel_if_available_tag>(m_scans[i], m_scans[j]));
        for (Ranked_motion& m : answer.motions) m.motion = own(j) * m.motion * own(i).inverse();
        m_answers[{i, j}] = std::move(answer);
      }
  }

  void measure(Measured& measured) const
  {
    for (const auto& [pair, answer] : m_answers) {
      if (answer.status == CR::REGISTERED) {
        ++measured.certain;
        measured.wrong += !is_right(pair, answer.motions.front());
      }
      for (const Ranked_motion& m : answer.motions) {
        if (is_right(pair, m)) continue;
        measure_agreement(pair, m, measured);
        measure_loops(pair, m, measured);
      }
    }
  }

  // How many scans lie as they should to others of their part, and how many do not, by pairs that are certain first and
  // then by all: `right` and `wrong` are added to.
  void put_together(const CRI::Assembly_coefficients& coefficients, std::size_t& right, std::size_t& wrong) const
  {
    std::vector<CRI::Tried_pair> pairs;
    for (const auto& [pair, answer] : m_answers) {
      pairs.push_back({pair, answer});
      if (answer.status == CR::REGISTERED) pairs.back().answer.motions.front().is_registered = true;
    }
    const CRI::Known_poses known;
    for (const CRI::Trust trust : {CRI::Trust::CERTAIN_PAIRS, CRI::Trust::ALL_PAIRS}) {
      const CRI::Parts parts(m_placed, CRI::with_loop_evidence(m_placed, pairs, coefficients), trust, known,
                             coefficients);
      for (const CRI::Part& part : parts.parts()) {
        // By the scan that most agree with.
        std::size_t most = 0;
        for (const std::size_t i : part.scans) {
          std::size_t agreeing = 0;
          for (const std::size_t j : part.scans)
            agreeing +=
                CRI::Parts::agrees(m_placed, {j, i}, parts.poses()[i].inverse() * parts.poses()[j], truth(j, i));
          most = (std::max)(most, agreeing);
        }
        right += most - 1;
        wrong += part.scans.size() - most;
      }
    }
  }

private:
  static std::vector<Scan> scans_of(const benchmark_tools::Simulated_set& set)
  {
    std::vector<Scan> scans;
    for (const auto& view : set.views()) scans.push_back(benchmark_tools::scan_of(view.image, true));
    return scans;
  }

  static std::vector<const CRI::Reduced_scan*> reduced(const std::vector<Scan>& scans)
  {
    std::vector<const CRI::Reduced_scan*> result;
    for (const Scan& s : scans) result.push_back(&s.reduced());
    return result;
  }

  const Rigid_motion& own(std::size_t i) const { return m_scans[i].reduced().own_from_input; }

  // j from i, of their own frames.
  Rigid_motion truth(std::size_t i, std::size_t j) const { return own(j) * m_set.motion(i, j) * own(i).inverse(); }

  bool is_right(const Scan_pair& pair, const Ranked_motion& m) const
  {
    return CRI::Parts::agrees(m_placed, pair, m.motion, truth(pair.first, pair.second));
  }

  // A motion of a pair as the pair says it that is asked for either way round.
  std::vector<Ranked_motion> motions(std::size_t i, std::size_t j) const
  {
    std::vector<Ranked_motion> result = m_answers.at({(std::min)(i, j), (std::max)(i, j)}).motions;
    if (i > j)
      for (Ranked_motion& m : result) m.motion = m.motion.inverse();
    return result;
  }

  // What pairs of two parts say, by their motions that are wrong: the scans of each part lie as they do in truth.
  void measure_agreement(const Scan_pair& pair, const Ranked_motion& m, Measured& measured) const
  {
    const std::size_t n = m_scans.size();
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t l = 0; l < n; ++l) {
        if (k == l || k == pair.second || l == pair.first || (k == pair.first && l == pair.second)) continue;
        for (const Ranked_motion& other : motions(k, l)) {
          const Rigid_motion said = truth(l, pair.second) * other.motion * truth(pair.first, k);
          if (CRI::Parts::agrees(m_placed, {k, l}, other.motion, truth(k, l))) continue;
          measured.agreeing.add(m.probability * other.probability, CRI::Parts::agrees(m_placed, pair, m.motion, said));
        }
      }
  }

  void measure_loops(const Scan_pair& pair, const Ranked_motion& m, Measured& measured) const
  {
    for (std::size_t k = 0; k < m_scans.size(); ++k) {
      if (k == pair.first || k == pair.second) continue;
      for (const Ranked_motion& a : motions(pair.first, k))
        for (const Ranked_motion& b : motions(k, pair.second))
          measured.closing.add(m.probability * a.probability * b.probability,
                               CRI::Parts::agrees(m_placed, pair, m.motion, b.motion * a.motion));
    }
  }

  const benchmark_tools::Simulated_set m_set;
  const std::vector<Scan> m_scans;
  const CRI::Placed_scans m_placed;
  std::map<Scan_pair, CRI::Pair_answer> m_answers;
};

} // namespace

int main(int argc, char** argv)
{
  try {
    std::size_t seeds, views;
    unsigned first_seed;
    po::options_description options("fit_assembly: measures what an assembly has to know of pairs");
    options.add_options()("help,h", "this text")("seeds", po::value(&seeds)->default_value(2), "of each kind of body")(
        "first-seed", po::value(&first_seed)->default_value(201),
        "of the bodies")("views", po::value(&views)->default_value(6), "of a body");
    po::variables_map values;
    if (!benchmark_tools::read_options(argc, argv, options, values)) return EXIT_SUCCESS;
    const auto sensors = benchmark_tools::all_sensors();
    std::deque<Scene> scenes; // which stay where they are
    Measured measured;
    for (unsigned seed = first_seed; seed < first_seed + seeds; ++seed)
      for (const char* kind : {"statue", "pedestal", "plinth", "part", "room"})
        for (const std::size_t sensor : {0u, 2u, 3u, 5u}) {
          scenes.emplace_back(kind, seed, views, sensors[sensor]);
          scenes.back().measure(measured);
        }
    // At 95 %, of a Poisson number.
    const auto w = double(measured.wrong);
    const double bound = (w > 0 ? w + 1.645 * std::sqrt(w) + 2 : 3) / double(measured.certain);
    std::cout << std::setprecision(3) << scenes.size() << " scenes of " << views << " scans, seeds " << first_seed
              << " to " << first_seed + seeds - 1 << "\nagreeing " << measured.agreeing.value() << "\nclosing "
              << measured.closing.value() << "\nwrong " << bound << " (" << measured.wrong << " of " << measured.certain
              << ")\n";
    using Coefficients = CRI::Assembly_coefficients;
    const std::vector<std::pair<const char*, double Coefficients::*>> members = {
        {"agreeing", &Coefficients::agreeing},
        {"closing", &Coefficients::closing},
        {"wrong", &Coefficients::wrong},
        {"free_space", &Coefficients::free_space},
        {"at_the_rims", &Coefficients::at_the_rims}};
    for (const auto& [name, member] : members)
      for (const double factor : {0.125, 0.25, 0.5, 1., 2., 4., 8.}) {
        Coefficients coefficients;
        coefficients.*member *= factor;
        std::size_t right = 0, wrong = 0;
        for (const Scene& scene : scenes) scene.put_together(coefficients, right, wrong);
        std::cout << name << ' ' << coefficients.*member << ": " << right << " right, " << wrong << " wrong\n";
      }
    return EXIT_SUCCESS;
  } catch (const std::exception& e) {
    std::cerr << "fit_assembly: " << e.what() << '\n';
    return EXIT_FAILURE;
  }
}
