// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// How many pairs, how much time and how much memory an assembly takes, by the number of scans, of one body and of three
// bodies mixed, each seen from all around. The true poses are known: scans that lie wrongly are counted.

#include "child_process.h"
#include "command_line.h"
#include "plot_script.h"

#include <CGAL/Crude_registration/assemble_scans.h>
#include <CGAL/Crude_registration/simulation/make_statue.h>
#include <CGAL/Crude_registration/simulation/simulate_range_image.h>

#include <CGAL/Aff_transformation_3.h>
#include <CGAL/Dimension.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/centroid.h>
#include <CGAL/squared_distance_3.h>

#include <boost/program_options.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace CR = CGAL::Crude_registration;
namespace po = boost::program_options;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Scan = CR::Scan<Kernel>;
using Transformation = CGAL::Aff_transformation_3<Kernel>;
using Clock = std::chrono::steady_clock;

namespace {

struct Row
{
  std::size_t bodies, scans, samples, pairs, components, largest, wrong;
  double degrees, distances;                // the worst pose that is right
  double preparation, assembly, relaxation; // seconds
  double scans_bytes;                       // of all prepared scans
};

double seconds_since(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// A view of a body: the direction from a spiral on the sphere, without the poles.
CR::Simulated_range_image<Kernel> view(const CR::Simulated_scene& scene, const CGAL::Bbox_3& box, std::size_t k,
                                       std::size_t n, std::size_t samples, std::uint64_t seed)
{
  const double golden_angle = CGAL_PI * (3 - std::sqrt(5.));
  constexpr double highest = 0.9; // sine of the elevation
  const double z = highest * (2 * (double(k) + 0.5) / double(n) - 1), r = std::sqrt(1 - z * z);
  const double angle = golden_angle * double(k);
  constexpr std::size_t few = 100;
  auto camera =
      CR::Range_camera<Kernel>::framing(box, Kernel::Vector_3(r * std::cos(angle), r * std::sin(angle), -z), few);
  const double scale = std::sqrt(double(scene.range_image(camera).image.points().size()) / double(samples));
  camera.spacing *= scale;
  camera.columns = camera.rows = std::size_t(std::ceil(double(few) / scale));
  camera.noise = 0.2;
  camera.drop_out = 0.01;
  camera.seed = seed;
  return scene.range_image(camera);
}

Row measure(std::size_t bodies, std::size_t n, std::size_t samples)
{
  Row row = {};
  row.bodies = bodies;
  row.scans = n;
  std::vector<Scan> scans;
  std::vector<Transformation> poses;
  std::vector<Kernel::Point_3> centres; // of the samples, in the frames of the scans
  for (std::size_t b = 0; b < bodies; ++b) {
    Mesh mesh;
    CR::make_statue(mesh, 96, CR::parameters::random_seed(unsigned(b + 1)));
    const CR::Simulated_scene scene(mesh);
    const CGAL::Bbox_3 box = CGAL::Polygon_mesh_processing::bbox(mesh);
    const std::size_t views = n / bodies + (b < n % bodies);
    for (std::size_t k = 0; k < views; ++k) {
      const auto simulated = view(scene, box, k, views, samples, 1000 * (b + 1) + k);
      poses.push_back(simulated.scene_from_scan);
      const auto& points = simulated.image.points();
      centres.push_back(CGAL::centroid(points.begin(), points.end(), CGAL::Dimension_tag<0>()));
      row.samples += simulated.image.points().size();
      const auto start = Clock::now();
      scans.emplace_back(simulated.image);
      row.preparation += seconds_since(start);
      row.scans_bytes = benchmark_tools::resident_bytes();
    }
  }
  row.samples /= n;
  const auto start = Clock::now();
  const auto result = CR::assemble_scans<CGAL::Parallel_if_available_tag>(scans);
  row.assembly = seconds_since(start);
  for (const auto& stage : result.statistics())
    if (stage.name == "relax") row.relaxation = stage.seconds;
  row.pairs = result.edges().size();
  row.components = result.number_of_components();
  // Each component by its first scan; of what body a scan is follows from its place.
  std::vector<std::optional<std::size_t>> first(row.components);
  std::vector<std::size_t> sizes(row.components, 0);
  const auto body = [&](std::size_t i) {
    std::size_t b = 0, end = n / bodies + (0 < n % bodies);
    while (i >= end) end += n / bodies + (++b < n % bodies);
    return b;
  };
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t c = result.component(i);
    ++sizes[c];
    if (!first[c]) first[c] = i;
    const std::size_t f = *first[c];
    const Transformation found = result.pose(i), truth = poses[f].inverse() * poses[i];
    double squares = 0;
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) squares += CGAL::square(found.m(j, k) - truth.m(j, k));
    const double angle = std::sqrt(squares / 2);
    const double distance =
        std::sqrt(CGAL::squared_distance(found(centres[i]), truth(centres[i]))) / scans[i].spacing();
    constexpr double right_degrees = 2, right_distances = 5;
    const double degrees = angle * 180 / CGAL_PI;
    if (body(i) != body(f) || degrees > right_degrees || distance > right_distances) ++row.wrong;
    else {
      row.degrees = (std::max)(row.degrees, degrees);
      row.distances = (std::max)(row.distances, distance);
    }
  }
  row.largest = *std::max_element(sizes.begin(), sizes.end());
  return row;
}

// Of the table `csv`, one curve for each of `bodies`.
void write_plot(const std::string& file, const std::string& csv, const std::vector<std::size_t>& bodies)
{
  CR::write_file(file, [&](std::ostream& out) {
    const auto curves = [&](const char* column) {
      out << "plot ";
      for (std::size_t k = 0; k < bodies.size(); ++k)
        out << (k == 0 ? "" : ", \\\n     ") << benchmark_tools::quoted(csv) << " using ($1 == " << bodies[k]
            << " ? $2 : NaN):" << column << " skip 1 with linespoints title '" << bodies[k]
            << (bodies[k] == 1 ? " body'" : " bodies'");
      out << '\n';
    };
    out << "set terminal pngcairo size 800,900\n"
        << "set output " << benchmark_tools::quoted(file + ".png") << '\n'
        << "set datafile separator ','\nset datafile missing NaN\n"
        << "set multiplot layout 2,1\n"
        << "set logscale xy\nset grid\nset key left top\nset xlabel 'scans'\n"
        << "set ylabel 'preparation and assembly [s]'\n";
    curves("($11 + $12)");
    out << "set ylabel 'peak memory [MB]'\n";
    curves("15");
    out << "unset multiplot\n";
  });
}

} // namespace

int main(int argc, char** argv)
{
  try {
    std::vector<std::size_t> sizes, bodies;
    std::size_t samples;
    std::string csv, plot;
    po::options_description options("assembly_scaling: assembles more and more generated scans");
    options.add_options()("help,h", "this text")(
        "sizes", po::value(&sizes)->multitoken()->default_value({30, 100, 300}, "30 100 300"), "numbers of scans")(
        "bodies", po::value(&bodies)->multitoken()->default_value({1, 3}, "1 3"),
        "numbers of bodies")("samples", po::value(&samples)->default_value(40000),
                             "of a scan, about")("csv", po::value(&csv), "a file for the table as CSV")(
        "plot", po::value(&plot), "a file for a script of gnuplot that draws the file of --csv");
    po::variables_map values;
    if (!benchmark_tools::read_options(argc, argv, options, values)) return EXIT_SUCCESS;
    if (!plot.empty() && csv.empty()) throw std::invalid_argument("--plot draws the file of --csv, which is missing");
    std::ostringstream table;
    table << "bodies,scans,samples,pairs,pairs_a_scan,components,largest,wrong,degrees,distances,prepare_seconds,"
             "assemble_seconds,relax_seconds,scans_megabytes,peak_megabytes\n";
    std::cout
        << "bodies scans samples pairs pairs/scan components largest wrong degrees distances prepare/s assemble/s "
           "(relax/s) scans/MB peak/MB\n";
    for (const std::size_t b : bodies)
      for (const std::size_t n : sizes) {
        const auto measured = benchmark_tools::in_child_process([&] { return measure(b, n, samples); });
        const Row& r = measured.value;
        constexpr double megabyte = 1e6;
        std::ostringstream line;
        line << r.bodies << ',' << r.scans << ',' << r.samples << ',' << r.pairs << ',' << std::setprecision(3)
             << double(r.pairs) / double(r.scans) << ',' << r.components << ',' << r.largest << ',' << r.wrong << ','
             << r.degrees << ',' << r.distances << ',' << r.preparation << ',' << r.assembly << ',' << r.relaxation
             << ',' << std::setprecision(5) << r.scans_bytes / megabyte << ',' << measured.peak_bytes / megabyte;
        table << line.str() << '\n';
        std::string text = line.str();
        std::replace(text.begin(), text.end(), ',', ' ');
        std::cout << text << std::endl;
      }
    if (!csv.empty()) CR::write_file(csv, [&](std::ostream& out) { out << table.str(); });
    if (!plot.empty()) write_plot(plot, csv, bodies);
    return EXIT_SUCCESS;
  } catch (const std::exception& e) {
    std::cerr << "assembly_scaling: " << e.what() << '\n';
    return EXIT_FAILURE;
  }
}
