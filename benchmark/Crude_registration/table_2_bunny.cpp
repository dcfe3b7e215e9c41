// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// Table 2 of the paper: the four neighbouring pairs of bunny scans, crude and refined, beside the published poses.

#include "bunny_pairs.h"
#include "command_line.h"

#include <CGAL/Crude_registration/IO/write_file.h>

#include <boost/program_options.hpp>

#include <array>
#include <cstdlib>
#include <exception>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

namespace CR = CGAL::Crude_registration;
namespace po = boost::program_options;

namespace {

// Turn about y in degrees, x, y, z: of the published pose, crude, refined. The paper rounds the first to 90 degrees.
struct Paper_row
{
  const char* images;
  std::array<double, 4> truth, crude, refined;
};
const std::array<Paper_row, 4> paper = {
    {{"0-90", {90, -.0001, .0002, -.0001}, {89.9975, -.0001, .0004, -.0007}, {90.2239, -.0001, .0002, -.0001}},
     {"90-180", {90, -.0001, .0001, -.0001}, {91.3913, -.0007, .0008, -.0022}, {90.1095, -.0001, .0001, -.0001}},
     {"180-270", {90, 0, .0003, 0}, {90.1022, -.0004, .0001, .0009}, {90.0138, 0, .0003, 0}},
     {"270-0", {90, -.0001, 0, .0004}, {93.696, .0009, .0035, .0001}, {90.0944, -.0001, 0, .0004}}}};
constexpr double paper_crude_rotation = 1.4, paper_crude_translation = 0.002, paper_refined_rotation = 0.11;

void print_motion(std::ostream& out, double turn, double x, double y, double z)
{
  out << std::fixed << std::setprecision(3) << std::setw(9) << turn << std::setprecision(4);
  for (double c : {x, y, z}) out << std::setw(9) << c;
}

void print_motion(std::ostream& out, const bunny::Transformation& m)
{
  print_motion(out, bunny::turn_about_y(m), m.m(0, 3), m.m(1, 3), m.m(2, 3));
}

void print(const Paper_row& p, const bunny::Registration& r)
{
  std::ostringstream out;
  out << std::left << std::setw(9) << p.images << std::setw(7) << "ours" << std::right;
  print_motion(out, r.truth);
  print_motion(out, r.crude());
  print_motion(out, r.refined);
  out << '\n' << std::left << std::setw(9) << "" << std::setw(7) << "paper" << std::right;
  for (const auto& m : {p.truth, p.crude, p.refined}) print_motion(out, m[0], m[1], m[2], m[3]);
  std::cout << out.str() << '\n';
}

void print_errors(const std::vector<bunny::Registration>& rows)
{
  std::ostringstream out;
  out << "\n              vertices            crude               answer             after ICP                       "
         "seconds\n"
      << "images       S      D  passes    degrees   length   degrees   length   degrees   length  iterations   search "
         "   whole  status\n";
  bunny::Error crude, answer, refined;
  std::size_t most_iterations = 0;
  const auto print_error = [&](const bunny::Error& e) {
    out << std::fixed << std::setprecision(3) << std::setw(11) << e.rotation << std::setprecision(5) << std::setw(9)
        << e.translation;
  };
  const auto add = [&](bunny::Error& sum, const bunny::Error& e) {
    sum.rotation += e.rotation / double(rows.size());
    sum.turn += e.turn / double(rows.size());
    sum.translation += e.translation / double(rows.size());
  };
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bunny::Registration& r = rows[i];
    out << std::left << std::setw(9) << paper[i].images << std::right << std::setw(5) << r.s_vertices << std::setw(7)
        << r.d_vertices << std::setw(8) << r.passes();
    print_error(r.crude_error);
    print_error(r.result_error);
    print_error(r.refined_error);
    out << std::setw(12) << r.iterations << std::setprecision(3) << std::setw(9) << r.search_seconds() << std::setw(9)
        << r.seconds << "  " << r.result.status() << '\n';
    add(crude, r.crude_error);
    add(answer, r.result_error);
    add(refined, r.refined_error);
    most_iterations = (std::max)(most_iterations, r.iterations);
  }
  out << std::left << std::setw(29) << "mean (iterations: most)" << std::right;
  print_error(crude);
  print_error(answer);
  print_error(refined);
  out << std::setw(12) << most_iterations << '\n' << std::left << std::setw(29) << "  turn about y alone" << std::right;
  out << std::setprecision(3) << std::setw(11) << crude.turn << std::setw(20) << answer.turn << std::setw(20)
      << refined.turn << '\n';
  out << std::left << std::setw(29) << "paper (turn about y)" << std::right << std::setw(11) << paper_crude_rotation
      << std::setprecision(5) << std::setw(9) << paper_crude_translation << std::setprecision(3) << std::setw(31)
      << paper_refined_rotation << std::setw(21) << "4-8" << '\n';
  out << "\ncrude: as the search proposed it, estimated from all vertices of the two simplified meshes that agree;\n"
         "answer: that of register_scans(), refined on the reduced scans; after ICP: crude, refined on the dense\n"
         "meshes; degrees: angle of the whole rotation that is left over; seconds: of the search, and of\n"
         "register_scans() as a whole\n";
  std::cout << out.str();
}

void write_csv(const std::string& file, const std::vector<bunny::Registration>& rows)
{
  CR::write_file(file, [&](std::ostream& out) {
    out << "images,s_vertices,d_vertices,status,passes,trihedra,candidates,search_seconds,seconds,score,iterations";
    for (const char* motion : {"true", "crude", "answer", "icp"})
      for (const char* column : {"turn", "x", "y", "z"}) out << ',' << motion << '_' << column;
    for (const char* motion : {"crude", "answer", "icp"}) out << ',' << motion << "_degrees," << motion << "_length";
    out << '\n';
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const bunny::Registration& r = rows[i];
      out << paper[i].images << ',' << r.s_vertices << ',' << r.d_vertices << ',' << r.result.status() << ','
          << r.passes() << ',' << r.trihedra() << ',' << r.candidates() << ',' << r.search_seconds() << ',' << r.seconds
          << ',' << r.result.score() << ',' << r.iterations;
      for (const auto& m : {r.truth, r.crude(), r.result.transformation(), r.refined})
        out << ',' << bunny::turn_about_y(m) << ',' << m.m(0, 3) << ',' << m.m(1, 3) << ',' << m.m(2, 3);
      for (const auto& e : {r.crude_error, r.result_error, r.refined_error})
        out << ',' << e.rotation << ',' << e.translation;
      out << '\n';
    }
  });
}

int run(const std::string& folder, const std::string& csv, const bunny::Options& options)
{
  std::vector<bunny::Dense_scan> scans;
  std::vector<bunny::Prepared_scan> prepared;
  for (const char* name : {"bun000.ply", "bun090.ply", "bun180.ply", "bun270.ply"}) {
    scans.push_back(bunny::read_scan(folder, name));
    prepared.push_back(
        bunny::prepare(scans.back(), CR::parameters::approximation_error(CR::approximation_error(scans.back().image))));
  }
  std::cout << "                                true                                crude                             "
               "after ICP\n"
            << "images             turn        x        y        z     turn        x        y        z     turn        "
               "x        y        z\n";
  std::vector<bunny::Registration> rows;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const std::size_t j = (i + 1) % scans.size();
    rows.push_back(bunny::register_pair(scans[i], prepared[i], scans[j], prepared[j], folder, options));
    print(paper[i], rows.back());
  }
  print_errors(rows);
  if (!csv.empty()) write_csv(csv, rows);
  return EXIT_SUCCESS;
}

} // namespace

int main(int argc, char* argv[])
{
  try {
    std::string folder = ".", csv;
    bunny::Options options;
    po::options_description description("Usage: table_2_bunny [OPTION...]\n\n"
                                        "Registers the four neighbouring pairs of bunny scans of the paper's Table 2\n"
                                        "by its method and prints the motions beside the published ones.\n\n"
                                        "Options");
    description.add_options()("help,h", "print this");
    description.add_options()("scans", po::value(&folder), "folder of bun000.ply, ... and bun.conf; default: this one");
    description.add_options()("f1", po::value(&options.minimum_extent), "least length of an arm, in shares of M; 0");
    description.add_options()("f2", po::value(&options.maximum_extent), "largest length of an arm; default 0.3");
    description.add_options()("curvatures-only", "compare curvatures alone, as the paper does, without normals");
    description.add_options()("threads", po::value(&options.threads), "number of threads; default 1");
    description.add_options()("csv", po::value(&csv), "file to write the table to, as CSV");
    po::variables_map values;
    if (!benchmark_tools::read_options(argc, argv, description, values)) return EXIT_SUCCESS;
    options.use_normals = values.count("curvatures-only") == 0;
    return run(folder, csv, options);
  } catch (const std::exception& e) {
    std::cerr << "table_2_bunny: " << e.what() << '\n';
    return EXIT_FAILURE;
  }
}
