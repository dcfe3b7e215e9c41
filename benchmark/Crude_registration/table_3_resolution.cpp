// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// Table 3 and Figure 12 of the paper: the resolution of the two meshes against the time of the search, bunny 0-90.

#include "bunny_pairs.h"
#include "command_line.h"
#include "plot_script.h"

#include <CGAL/Crude_registration/IO/write_file.h>

#include <boost/program_options.hpp>

#include <array>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

namespace CR = CGAL::Crude_registration;
namespace po = boost::program_options;
using benchmark_tools::quoted;

namespace {

struct Paper_level
{
  std::size_t s_vertices, d_vertices;
  double turn, x, y, z, turn_error, translation_error, seconds;
};
const std::array<Paper_level, 6> paper = {{{3314, 4152, 89.8519, -.0019, .0004, -.0019, .15, .00, 67992},
                                           {1487, 1829, 90.0639, -.0006, .0003, .0000, .06, .00, 13612},
                                           {959, 1135, 91.1277, -.0035, -.0000, -.0049, 1.13, .01, 1628},
                                           {688, 855, 90.0834, -.0015, .0000, -.0025, .08, .00, 831},
                                           {426, 553, 91.5342, -.0007, .0016, -.0019, 1.53, .00, 138},
                                           {299, 395, 90.2239, -.0001, .0002, -.0001, .22, .00, 45}}};

void print(std::size_t level, const bunny::Registration& r)
{
  const Paper_level& p = paper[level];
  std::ostringstream out;
  const auto line = [&](const char* whose, std::size_t s, std::size_t d, double turn, double x, double y, double z) {
    out << std::setw(5) << (whose[0] == 'o' ? std::to_string(level + 1) : "") << "  " << std::left << std::setw(6)
        << whose << std::right << std::setw(6) << s << std::setw(6) << d << std::fixed << std::setprecision(3)
        << std::setw(9) << turn << std::setprecision(4) << std::setw(9) << x << std::setw(9) << y << std::setw(9) << z;
  };
  const bunny::Transformation& m = r.crude();
  line("ours", r.s_vertices, r.d_vertices, bunny::turn_about_y(m), m.m(0, 3), m.m(1, 3), m.m(2, 3));
  out << std::setprecision(3) << std::setw(9) << r.crude_error.rotation << std::setprecision(4) << std::setw(9)
      << r.crude_error.translation << std::setprecision(3) << std::setw(11) << r.search_seconds() << std::setw(9)
      << r.seconds << std::setw(8) << r.passes() << std::setw(10) << r.trihedra() << std::setw(11) << r.candidates()
      << std::setw(9) << r.refined_error.rotation << std::setw(6) << r.iterations << "  " << r.result.status() << '\n';
  line("paper", p.s_vertices, p.d_vertices, p.turn, p.x, p.y, p.z);
  out << std::setprecision(2) << std::setw(9) << p.turn_error << std::setw(9) << p.translation_error
      << std::setprecision(0) << std::setw(11) << p.seconds << '\n';
  std::cout << out.str() << std::flush;
}

void write_csv(const std::string& file, const std::vector<bunny::Registration>& rows)
{
  CR::write_file(file, [&](std::ostream& out) {
    out << "level,s_vertices,d_vertices,seconds,turn,x,y,z,degrees,length,icp_degrees,icp_length,icp_iterations,passes,"
           "trihedra,candidates,score,paper_s_vertices,paper_d_vertices,paper_seconds,whole_seconds,status\n";
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const bunny::Registration& r = rows[i];
      const bunny::Transformation& m = r.crude();
      out << i + 1 << ',' << r.s_vertices << ',' << r.d_vertices << ',' << r.search_seconds() << ','
          << bunny::turn_about_y(m) << ',' << m.m(0, 3) << ',' << m.m(1, 3) << ',' << m.m(2, 3) << ','
          << r.crude_error.rotation << ',' << r.crude_error.translation << ',' << r.refined_error.rotation << ','
          << r.refined_error.translation << ',' << r.iterations << ',' << r.passes() << ',' << r.trihedra() << ','
          << r.candidates() << ',' << r.result.score() << ',' << paper[i].s_vertices << ',' << paper[i].d_vertices
          << ',' << paper[i].seconds << ',' << r.seconds << ',' << r.result.status() << '\n';
    }
  });
}

// Figure 12 with both curves, on a logarithmic axis as they are four orders of magnitude apart.
void write_plot(const std::string& file, const std::string& csv)
{
  CR::write_file(file, [&](std::ostream& out) {
    out << "set terminal pngcairo size 800,500\n"
        << "set output " << quoted(file + ".png") << '\n'
        << "set datafile separator ','\n"
        << "set title 'Resolution level vs. processing time, bunny 0-90'\n"
        << "set xlabel 'resolution level'\nset ylabel 'time of the search [s]'\n"
        << "set logscale y\nset format y '10^{%T}'\nset xrange [0.5:6.5]\nset xtics 1\nset grid ytics\n"
        << "plot " << quoted(csv) << " using 1:20 skip 1 with linespoints title 'paper', \\\n"
        << "     " << quoted(csv) << " using 1:4 skip 1 with linespoints title 'this package'\n";
  });
}

struct Output
{
  std::string csv, plot;
};

int run(const std::string& folder, const Output& output, const bunny::Options& options)
{
  const bunny::Dense_scan source = bunny::read_scan(folder, "bun000.ply"),
                          target = bunny::read_scan(folder, "bun090.ply");
  std::cout
      << "              vertices                 crude                   error             seconds                 "
         "             after ICP\n"
      << "level              S     D     turn        x        y        z  degrees   length     search    whole  passes "
         " trihedra candidates  degrees steps  status\n";
  std::vector<bunny::Registration> rows;
  // From the coarse level to the fine one, so that something is seen soon.
  for (std::size_t level = paper.size(); level-- > 0;) {
    const auto s = bunny::prepare(source, CR::parameters::number_of_vertices(paper[level].s_vertices));
    const auto d = bunny::prepare(target, CR::parameters::number_of_vertices(paper[level].d_vertices));
    rows.insert(rows.begin(), bunny::register_pair(source, s, target, d, folder, options));
    print(level, rows.front());
  }
  std::cout << "\ndegrees: angle of the whole rotation that is left over (paper: of the turn about y alone)\n"
               "search, whole: seconds of the search for motions, and of register_scans() as a whole\n";
  if (!output.csv.empty()) write_csv(output.csv, rows);
  if (!output.plot.empty()) {
    write_plot(output.plot, output.csv);
    std::cout << "Figure 12: gnuplot " << output.plot << " makes " << output.plot << ".png\n";
  }
  return EXIT_SUCCESS;
}

} // namespace

int main(int argc, char* argv[])
{
  try {
    std::string folder = ".";
    Output output;
    bunny::Options options;
    po::options_description description(
        "Usage: table_3_resolution [OPTION...]\n\n"
        "Registers bunny 0-90 at the six resolutions of the paper's Table 3 and prints\n"
        "the crude motions and the time of the search beside the paper's.\n\n"
        "Options");
    description.add_options()("help,h", "print this");
    description.add_options()("scans", po::value(&folder),
                              "folder of bun000.ply, bun090.ply and bun.conf; default: this one");
    description.add_options()("f1", po::value(&options.minimum_extent), "least length of an arm, in shares of M; 0");
    description.add_options()("f2", po::value(&options.maximum_extent), "largest length of an arm; default 0.3");
    description.add_options()("curvatures-only", "compare curvatures alone, as the paper does, without normals");
    description.add_options()("threads", po::value(&options.threads), "number of threads; default 1");
    description.add_options()("csv", po::value(&output.csv), "file to write the table to, as CSV");
    description.add_options()("plot", po::value(&output.plot), "gnuplot script of Figure 12 to write; needs --csv");
    po::variables_map values;
    if (!benchmark_tools::read_options(argc, argv, description, values)) return EXIT_SUCCESS;
    if (!output.plot.empty() && output.csv.empty()) throw std::invalid_argument("--plot needs --csv");
    options.use_normals = values.count("curvatures-only") == 0;
    return run(folder, output, options);
  } catch (const std::exception& e) {
    std::cerr << "table_3_resolution: " << e.what() << '\n';
    return EXIT_FAILURE;
  }
}
