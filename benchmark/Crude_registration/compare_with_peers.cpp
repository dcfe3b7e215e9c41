// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// This package beside what else one would take, on the same pairs of scans, moved in the same way, in the same run, by
// turns, with one thread each: how many answers are right, and what they cost from samples in memory.
//
// A run of a method on a pair is a process of its own: its memory is known, and no method finds what another one left.
// An answer is right if its rotation is within 5 degrees and the centroid of the source within 5 % of the source's
// diagonal of where it should be.

#include "child_process.h"
#include "command_line.h"
#include "reference_time.h"
#include "registration_trials.h"
#include "peers/Peer.h"
#include "peers/open3d.h"
#include "peers/pcl.h"

#include <CGAL/Crude_registration/IO/write_file.h>
#include <CGAL/Crude_registration/register_scans.h>

#include <boost/program_options.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <functional>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <unistd.h>

namespace CR = CGAL::Crude_registration;
namespace po = boost::program_options;
using benchmark_tools::cpu_seconds;
using benchmark_tools::Kernel;
using benchmark_tools::Peer_answer;
using benchmark_tools::Peer_scan;
using benchmark_tools::Peer_setting;
using benchmark_tools::Trial_scan;

namespace {

struct Options
{
  benchmark_tools::Trial_options trials;
  std::string output, reference;
  std::size_t runs = 1;
  bool tune = false;
};

CR::Scan<Kernel> prepare(const Trial_scan& scan)
{
  if (scan.viewpoint) return CR::Scan<Kernel>(scan.moved.file, CR::parameters::viewpoint(*scan.viewpoint));
  return CR::Scan<Kernel>(scan.moved.file);
}

Peer_answer register_by_this_package(const Trial_scan& source, const Trial_scan& target)
{
  Peer_answer answer;
  const double start = cpu_seconds();
  const auto result = CR::register_scans(prepare(source), prepare(target));
  answer.seconds = cpu_seconds() - start;
  answer.is_found = result.status() == CR::REGISTERED;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j) answer.matrix[i][j] = result.transformation().m(i, j);
  return answer;
}

struct Method
{
  std::string name;
  std::function<Peer_answer(const Trial_scan&, const Trial_scan&)> run;
};

using Peer = Peer_answer (*)(const Peer_scan& source, const Peer_scan& target, const Peer_setting& setting);

// A method of a peer, which sees the samples alone.
[[maybe_unused]] Method of_peer(const std::string& name, Peer peer, const Peer_setting& setting)
{
  return {name, [peer, setting](const Trial_scan& source, const Trial_scan& target) {
            return peer(source.samples, target.samples, setting);
          }};
}

std::vector<Method> methods()
{
  std::vector<Method> result = {{"this package", register_by_this_package}};
#ifdef CRUDE_REGISTRATION_HAS_OPEN3D
  using benchmark_tools::register_by_open3d_fgr;
  using benchmark_tools::register_by_open3d_ransac;
  result.push_back(of_peer("Open3D FGR tuned", register_by_open3d_fgr, benchmark_tools::open3d_fgr_tuned()));
  result.push_back(
      of_peer("Open3D FGR tuned for speed", register_by_open3d_fgr, benchmark_tools::open3d_fgr_tuned_for_speed()));
  result.push_back(of_peer("Open3D FGR documented", register_by_open3d_fgr, benchmark_tools::open3d_fgr_documented()));
  result.push_back(of_peer("Open3D RANSAC tuned", register_by_open3d_ransac, benchmark_tools::open3d_ransac_tuned()));
  result.push_back(
      of_peer("Open3D RANSAC documented", register_by_open3d_ransac, benchmark_tools::open3d_ransac_documented()));
#endif
#ifdef CRUDE_REGISTRATION_HAS_PCL
  using benchmark_tools::register_by_pcl;
  result.push_back(of_peer("PCL prerejective tuned", register_by_pcl, benchmark_tools::pcl_tuned()));
  result.push_back(of_peer("PCL prerejective documented", register_by_pcl, benchmark_tools::pcl_documented()));
#endif
  return result;
}

// The settings that the tuned ones were chosen from, on every third pair of the bunny's scans with an overlap of 0.1 or
// more (--tune --minimum-overlap 0.1 --every 3), with normals oriented towards the known sensor. FGR's distance and
// RANSAC's number of iterations change next to nothing: those documented stay.
std::vector<Method> methods_to_choose_from()
{
  std::vector<Method> result;
  [[maybe_unused]] const auto add = [&](const char* method, Peer peer, Peer_setting s, double voxel,
                                        double feature_radius) {
    s.orients_normals = true;
    s.voxel = voxel;
    s.feature_radius = feature_radius;
    std::ostringstream name;
    name << method << ' ' << 100 * voxel << " %, " << feature_radius << " voxels";
    if (s.edge_similarity > 0) name << ", " << s.edge_similarity;
    result.push_back(of_peer(name.str(), peer, s));
  };
#ifdef CRUDE_REGISTRATION_HAS_OPEN3D
  for (double voxel : {0.01, 0.015, 0.02})
    for (double radius : {5., 8.}) {
      add("FGR", benchmark_tools::register_by_open3d_fgr, benchmark_tools::open3d_fgr_documented(), voxel, radius);
      add("RANSAC", benchmark_tools::register_by_open3d_ransac, benchmark_tools::open3d_ransac_documented(), voxel,
          radius);
    }
#endif
#ifdef CRUDE_REGISTRATION_HAS_PCL
  for (double voxel : {0.015, 0.02})
    for (double similarity : {0.9, 0.95}) {
      Peer_setting s = benchmark_tools::pcl_documented();
      s.edge_similarity = similarity;
      add("PCL", benchmark_tools::register_by_pcl, s, voxel, 5);
    }
#endif
  return result;
}

// Pairs with less are shown, but do not count.
constexpr double enough_overlap = 0.3;

struct Row
{
  std::string source, target;
  std::size_t method = 0;
  double overlap = 0;
  bool is_found = false, is_right = false;
  double degrees = 0, centroid_error = 0; // the latter in diagonals of the source
  double seconds = 0;                     // median of the runs
  double peak_bytes = 0, own_bytes = 0;   // the most of the runs; the latter: beyond what held the samples
};

struct Run
{
  Peer_answer answer;
  double bytes_before;
};

Row run_method(const Method& method, const Trial_scan& source, const Trial_scan& target,
               const benchmark_tools::Motion& truth, std::size_t runs)
{
  Row row;
  std::vector<double> seconds;
  for (std::size_t i = 0; i < runs; ++i) {
    const auto child = benchmark_tools::in_child_process([&] {
      const double before = benchmark_tools::resident_bytes();
      return Run{method.run(source, target), before};
    });
    seconds.push_back(child.value.answer.seconds);
    row.peak_bytes = (std::max)(row.peak_bytes, child.peak_bytes);
    row.own_bytes = (std::max)(row.own_bytes, child.peak_bytes - child.value.bytes_before);
    const Peer_answer& answer = child.value.answer;
    const benchmark_tools::Trial_error error(answer.matrix, truth, source, target);
    row.is_found = answer.is_found;
    row.degrees = error.degrees;
    row.centroid_error = error.centroid;
    row.is_right = row.is_found && error.is_small();
  }
  row.seconds = benchmark_tools::median(seconds);
  return row;
}

double percentile(std::vector<double> values, double share)
{
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[(std::min)(values.size() - 1, std::size_t(share * double(values.size())))];
}

// What a table's row says of one method.
struct Summary
{
  std::size_t pairs = 0, right = 0, wrong = 0; // of all
  std::size_t pairs_that_count = 0, right_that_count = 0;
  std::vector<double> seconds; // of the pairs that count
  double own_bytes = 0;
};

Summary summary(const std::vector<Row>& rows, std::size_t method)
{
  Summary s;
  for (const Row& row : rows) {
    if (row.method != method) continue;
    ++s.pairs;
    s.right += row.is_right;
    s.wrong += row.is_found && !row.is_right;
    s.own_bytes = (std::max)(s.own_bytes, row.own_bytes);
    if (row.overlap < enough_overlap) continue;
    ++s.pairs_that_count;
    s.right_that_count += row.is_right;
    s.seconds.push_back(row.seconds);
  }
  return s;
}

void print(const std::vector<Row>& rows, const std::vector<Method>& methods, double reference)
{
  std::ostringstream out;
  out << "                                 overlap >= " << enough_overlap
      << "                                            all pairs\n"
      << "method                          right  pairs  recall   CPU s: median    95 %  median, R   to ours   right  "
         "pairs  wrong   own MB\n"
      << std::fixed;
  const double ours = percentile(summary(rows, 0).seconds, 0.5);
  for (std::size_t m = 0; m < methods.size(); ++m) {
    const Summary s = summary(rows, m);
    const double median = percentile(s.seconds, 0.5);
    const double recall = s.pairs_that_count > 0 ? double(s.right_that_count) / double(s.pairs_that_count) : 0;
    out << std::left << std::setw(31) << methods[m].name << std::right << std::setw(6) << s.right_that_count
        << std::setw(7) << s.pairs_that_count << std::setprecision(1) << std::setw(7) << 100 * recall << '%'
        << std::setprecision(3) << std::setw(16) << median << std::setw(8) << percentile(s.seconds, 0.95)
        << std::setw(11) << median / reference << std::setprecision(2) << std::setw(10)
        << (ours > 0 ? median / ours : 0) << std::setw(8) << s.right << std::setw(7) << s.pairs << std::setw(7)
        << s.wrong << std::setprecision(1) << std::setw(9) << s.own_bytes / 1e6 << '\n';
  }
  out << "\nright: rotation within 5 degrees and centroid within 5 % of the diagonal; wrong: other answers that were "
         "given\nas found; own MB: the most memory beyond the process that held the samples. R = "
      << std::setprecision(3) << reference << " s\n";
  std::cout << out.str();
}

void write_csv(const std::string& file, const std::vector<Row>& rows, const std::vector<Method>& methods,
               double reference)
{
  CR::write_file(file, [&](std::ostream& out) {
    out << "source,target,overlap,method,found,right,degrees,centroid_error,seconds,reference_seconds,peak_bytes,"
           "own_bytes\n";
    for (const Row& r : rows)
      out << r.source << ',' << r.target << ',' << r.overlap << ',' << methods[r.method].name << ',' << r.is_found
          << ',' << r.is_right << ',' << r.degrees << ',' << r.centroid_error << ',' << r.seconds << ',' << reference
          << ',' << r.peak_bytes << ',' << r.own_bytes << '\n';
  });
}

int run(const Options& options)
{
  const benchmark_tools::Trials trials(options.trials);
  const std::vector<benchmark_tools::Trial_pair>& pairs = trials.pairs();

  const std::vector<Method> compared = options.tune ? methods_to_choose_from() : methods();
  if (compared.size() < 2)
    std::cout << "no peer is built in: configure with -D CRUDE_REGISTRATION_WITH_PEERS=ON where libopen3d-dev or "
                 "libpcl-dev is installed\n";
  std::string reference_scan = options.reference;
  if (reference_scan.empty() && options.trials.generated == 0)
    reference_scan = options.trials.scans + "/" + pairs.front().source;
  std::vector<double> reference;
  std::vector<Row> rows;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    // The machine may change its speed on the way.
    if (i % 8 == 0)
      reference.push_back(
          benchmark_tools::in_child_process([&] { return benchmark_tools::reference_seconds(reference_scan); }).value);
    const benchmark_tools::Trial_pair& pair = pairs[i];
    for (std::size_t m = 0; m < compared.size(); ++m) {
      const std::size_t method = (i + m) % compared.size();
      Row row =
          run_method(compared[method], trials.scan(pair.source), trials.scan(pair.target), pair.truth, options.runs);
      row.source = pair.source;
      row.target = pair.target;
      row.overlap = pair.overlap;
      row.method = method;
      rows.push_back(row);
    }
    std::cerr << '\r' << i + 1 << " of " << pairs.size() << " pairs" << std::flush;
  }
  std::cerr << '\n';
  const double r = benchmark_tools::median(reference);
  print(rows, compared, r);
  if (!options.output.empty()) write_csv(options.output, rows, compared, r);
  return EXIT_SUCCESS;
}

// The libraries read how many threads they may use when they are loaded: the program starts itself anew where they
// were told otherwise.
void use_one_thread(char** argv)
{
  bool is_changed = false;
  for (const char* variable : {"OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"}) {
    const char* value = std::getenv(variable);
    if (value != nullptr && std::strcmp(value, "1") == 0) continue;
    is_changed = ::setenv(variable, "1", 1) == 0;
  }
  if (is_changed) ::execv("/proc/self/exe", argv);
}

} // namespace

int main(int argc, char* argv[])
{
  use_one_thread(argv);
  try {
    Options options;
    po::options_description description(
        "Usage: compare_with_peers (--pairs PAIRS.csv --scans DIR | --generated N) [OPTION...]\n\n"
        "Registers pairs of scans by this package and by the other libraries that it was built\n"
        "with, and prints how many answers are right and what they cost, with one thread.\n\n"
        "Options");
    description.add_options()("help,h", "print this");
    benchmark_tools::add_options(description, options.trials);
    description.add_options()("output", po::value(&options.output), "CSV file to write, one row a pair and method");
    description.add_options()("runs", po::value(&options.runs)->default_value(1),
                              "runs, of whose times the median counts");
    description.add_options()("reference", po::value(&options.reference),
                              "scan whose simplification is the unit of time, R; default: the first source, or a "
                              "generated scan");
    description.add_options()("tune", po::bool_switch(&options.tune),
                              "compare the peers' settings that the tuned ones were chosen from");
    po::variables_map values;
    if (!benchmark_tools::read_options(argc, argv, description, values)) return EXIT_SUCCESS;
    if (options.runs == 0) throw std::invalid_argument("--runs has to be at least 1");
    return run(options);
  } catch (const std::exception& e) {
    std::cerr << "compare_with_peers: " << e.what() << '\n';
    return EXIT_FAILURE;
  }
}
