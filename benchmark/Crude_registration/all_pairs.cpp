// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// Registers pairs of scans and writes one row a pair.
//
// Every scan is moved by a rigid motion of its own before anything else, and the motion is undone in the written
// answer, so that no start and no axis helps. Each scan is prepared once. `seconds` is what a pair costs from samples
// in memory: both preparations and the search; `prepare_seconds` and `pair_seconds` are its parts.
//
// Where the file of the pairs has their overlaps and true motions, the answers are counted by overlap.

#include "command_line.h"
#include "csv_table.h"
#include "moved_scan.h"
#include "registration_trials.h"
#include "result_tools.h"

#include <CGAL/Crude_registration/IO/write_file.h>
#include <CGAL/Crude_registration/matching/Trihedron_candidates.h>
#include <CGAL/Crude_registration/register_scans.h>

#include <boost/program_options.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <iomanip>
#include <iostream>
#include <map>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace CR = CGAL::Crude_registration;
namespace po = boost::program_options;
using benchmark_tools::Kernel;
using benchmark_tools::Pair;
using benchmark_tools::Transformation;

namespace {

struct Method
{
  bool is_trihedra = false;
  double f1 = 0, f2 = 0.3;
  std::optional<Kernel::Point_3> viewpoint;
};

struct Moved_scan
{
  std::optional<CR::Scan<Kernel>> scan;
  Transformation moved_from_file = Transformation(CGAL::IDENTITY);
  benchmark_tools::Trial_scan measures; // without its samples
  double seconds = 0;
};

struct Answer
{
  CR::Registration_result<Kernel> result;
  double seconds = 0;
};

double seconds_since(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

auto trihedra(const Method& method)
{
  return CR::parameters::candidates(CR::Trihedron_candidates()).minimum_extent(method.f1).maximum_extent(method.f2);
}

Moved_scan read_and_prepare(const std::string& path, const std::string& name, const Method& method)
{
  const benchmark_tools::Moved_file read = benchmark_tools::read_and_move(path, name);
  const CR::Scan_file<Kernel>& file = read.file;
  Moved_scan moved;
  moved.moved_from_file = read.moved_from_file;

  const auto start = std::chrono::steady_clock::now();
  const auto prepare = [&](const auto& np) { moved.scan.emplace(file, np, path); };
  const bool has_viewpoint = method.viewpoint && file.kind != CR::Scan_file<Kernel>::RANGE_IMAGE;
  if (method.is_trihedra && has_viewpoint) prepare(trihedra(method).viewpoint(read.moved(*method.viewpoint)));
  else if (method.is_trihedra) prepare(trihedra(method));
  else if (has_viewpoint) prepare(CR::parameters::viewpoint(read.moved(*method.viewpoint)));
  else prepare(CR::parameters::default_values());
  moved.seconds = seconds_since(start);
  moved.measures = benchmark_tools::to_trial_scan(read, std::nullopt, path);
  moved.measures.moved.file = {};
  moved.measures.samples.points = {};
  return moved;
}

CR::Registration_result<Kernel> register_pair(const Moved_scan& source, const Moved_scan& target, const Method& method)
{
  if (method.is_trihedra) return CR::register_scans(*source.scan, *target.scan, trihedra(method));
  return CR::register_scans(*source.scan, *target.scan,
                            CR::parameters::minimum_extent(method.f1).maximum_extent(method.f2));
}

// f(0) .. f(n - 1), by some threads; each writes what is its own. The first exception is thrown again.
template <class Function>
void for_each_index(std::size_t n, unsigned threads, Function f)
{
  std::atomic<std::size_t> next(0);
  std::vector<std::exception_ptr> errors(threads);
  const auto work = [&](unsigned t) {
    try {
      for (std::size_t i = next++; i < n; i = next++) f(i);
    } catch (...) {
      errors[t] = std::current_exception();
    }
  };
  std::vector<std::thread> workers;
  for (unsigned t = 1; t < threads; ++t) workers.emplace_back(work, t);
  work(0);
  for (std::thread& w : workers) w.join();
  for (const std::exception_ptr& e : errors)
    if (e) std::rethrow_exception(e);
}

void write(std::ostream& out, const std::vector<Pair>& pairs, const std::vector<Answer>& answers,
           const std::map<std::string, std::size_t>& index, const std::vector<Moved_scan>& scans)
{
  out << std::setprecision(12);
  out << "source,target,status,confidence,seconds,prepare_seconds,pair_seconds,overlap,residual,violations,"
         "score,runner_up,crude_degrees,icp_iterations";
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j) out << ",m" << i << j;
  out << '\n';
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const Moved_scan &source = scans[index.at(pairs[k].source)], &target = scans[index.at(pairs[k].target)];
    const auto& r = answers[k].result;
    const double prepare = source.seconds + target.seconds;
    const double crude_degrees = benchmark_tools::degrees_between(r.transformation(), r.crude_transformation());
    out << pairs[k].source << ',' << pairs[k].target << ',' << r.status() << ',' << r.confidence() << ','
        << prepare + answers[k].seconds << ',' << prepare << ',' << answers[k].seconds << ',' << r.overlap() << ','
        << r.residual() << ',' << r.free_space_violations() << ',' << r.score() << ','
        << (r.runners_up().empty() ? 0 : r.runners_up().front().score) << ',' << crude_degrees << ','
        << benchmark_tools::stage(r, "refine").count;
    const Transformation in_files = target.moved_from_file.inverse() * r.transformation() * source.moved_from_file;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 4; ++j) {
        out << ',';
        if (r.status() != CR::NOT_REGISTERED) out << in_files.m(i, j);
      }
    }
    out << '\n';
  }
}

// The answers by the overlap of the pairs.
void count(const std::string& pairs_file, const std::vector<Pair>& pairs, const std::vector<Answer>& answers,
           const std::map<std::string, std::size_t>& index, const std::vector<Moved_scan>& scans)
{
  const std::vector<benchmark_tools::Row> rows = benchmark_tools::read_table(pairs_file);
  if (rows.size() != pairs.size() || rows.front().count("overlap") == 0 || rows.front().count("m23") == 0) return;
  struct Bin
  {
    double end;
    std::size_t pairs = 0, right = 0, wrong = 0, ambiguous = 0;
  };
  std::array<Bin, 7> bins = {{{0.1}, {0.2}, {0.3}, {0.5}, {0.7}, {2}, {2}}}; // the last one: all
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto& r = answers[k].result;
    double m[3][4];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 4; ++j) m[i][j] = r.transformation().m(i, j);
    const benchmark_tools::Trial_error error(m, benchmark_tools::motion(rows[k]),
                                             scans[index.at(pairs[k].source)].measures,
                                             scans[index.at(pairs[k].target)].measures);
    const auto bin = std::find_if(bins.begin(), bins.end() - 1,
                                  [&](const Bin& b) { return benchmark_tools::number(rows[k], "overlap") < b.end; });
    for (Bin* b : {&*bin, &bins.back()}) {
      ++b->pairs;
      b->right += r.status() == CR::REGISTERED && error.is_small();
      b->wrong += r.status() == CR::REGISTERED && !error.is_small();
      b->ambiguous += r.status() == CR::AMBIGUOUS;
    }
  }
  std::cout << "overlap below  pairs  right  wrong  ambiguous\n";
  for (std::size_t i = 0; i < bins.size(); ++i) {
    const Bin& b = bins[i];
    if (i + 1 == bins.size()) std::cout << std::setw(13) << "all pairs";
    else std::cout << std::setw(13) << (std::min)(b.end, 1.);
    std::cout << std::setw(7) << b.pairs << std::setw(7) << b.right << std::setw(7) << b.wrong << std::setw(11)
              << b.ambiguous << '\n';
  }
  std::cout << "right, wrong: of the registered ones, by 5 degrees, and 5 % of the diagonal at the centroid\n";
}

} // namespace

int main(int argc, char** argv)
{
  try {
    std::string pairs_file, scans_folder, output, viewpoint_text, method_name;
    Method method;
    unsigned threads;
    po::options_description options("all_pairs: registers pairs of scans and writes one row a pair");
    options.add_options()("help,h", "this text")("pairs", po::value(&pairs_file)->required(),
                                                 "CSV file whose first two columns are source,target")(
        "scans", po::value(&scans_folder)->required(), "folder the file names in the pairs are relative to")(
        "output", po::value(&output)->required(), "CSV file to write")(
        "method", po::value(&method_name)->default_value("pairs"),
        "pairs (of oriented points) or trihedra (the paper)")("f1", po::value(&method.f1)->default_value(method.f1),
                                                              "least length of a pair, or of an arm of a trihedron")(
        "f2", po::value(&method.f2)->default_value(method.f2),
        "greatest length")("threads", po::value(&threads)->default_value(1), "pairs worked on at a time")(
        "viewpoint", po::value(&viewpoint_text),
        "x,y,z: where scans without a grid were seen from, in their own frame");
    po::variables_map values;
    if (!benchmark_tools::read_options(argc, argv, options, values)) return EXIT_SUCCESS;
    threads = (std::max)(threads, 1u);
    method.viewpoint = benchmark_tools::read_point(viewpoint_text);
    if (method_name != "pairs" && method_name != "trihedra")
      throw std::runtime_error("--method has to be pairs or trihedra, not " + method_name);
    method.is_trihedra = method_name == "trihedra";

    const std::vector<Pair> pairs = benchmark_tools::read_pairs(pairs_file);
    std::map<std::string, std::size_t> index;
    std::vector<std::string> names;
    for (const Pair& p : pairs)
      for (const std::string& name : {p.source, p.target})
        if (index.emplace(name, names.size()).second) names.push_back(name);
    std::vector<Moved_scan> scans(names.size());
    for_each_index(names.size(), threads, [&](std::size_t i) {
      scans[i] = read_and_prepare(scans_folder + "/" + names[i], names[i], method);
    });
    std::vector<Answer> answers(pairs.size());
    const auto start = std::chrono::steady_clock::now();
    for_each_index(pairs.size(), threads, [&](std::size_t k) {
      const auto begin = std::chrono::steady_clock::now();
      answers[k].result = register_pair(scans[index.at(pairs[k].source)], scans[index.at(pairs[k].target)], method);
      answers[k].seconds = seconds_since(begin);
    });
    const double elapsed = seconds_since(start);
    CR::write_file(output, [&](std::ostream& out) { write(out, pairs, answers, index, scans); });

    const auto registered = std::count_if(answers.begin(), answers.end(),
                                          [](const Answer& a) { return a.result.status() == CR::REGISTERED; });
    std::cout << pairs.size() << " pairs, " << registered << " registered, " << elapsed << " s with " << threads
              << (threads == 1 ? " thread" : " threads") << ", written to " << output << '\n';
    count(pairs_file, pairs, answers, index, scans);
  } catch (const std::exception& e) {
    std::cerr << "all_pairs: " << e.what() << '\n';
    return EXIT_FAILURE;
  }
}
