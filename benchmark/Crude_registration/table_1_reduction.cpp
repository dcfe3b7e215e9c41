// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// Table 1 of the paper: what simplification to the approximation error leaves of the scans.

#include "command_line.h"

#include <CGAL/Crude_registration/IO/read_scan.h>
#include <CGAL/Crude_registration/IO/write_file.h>
#include <CGAL/Crude_registration/reduction/approximation_error.h>
#include <CGAL/Crude_registration/reduction/scan_extent.h>
#include <CGAL/Crude_registration/reduction/simplify_scan.h>
#include <CGAL/Crude_registration/reduction/surface_types.h>
#include <CGAL/Crude_registration/sampling/sampling_distance.h>
#include <CGAL/Crude_registration/sampling/triangulate_range_image.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <boost/program_options.hpp>

#include <cstddef>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace CR = CGAL::Crude_registration;
namespace po = boost::program_options;

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

namespace {

// The row of the paper's table for the four bunny scans.
const std::vector<std::string> bunny_scans = {"bun000.ply", "bun090.ply", "bun180.ply", "bun270.ply"};
constexpr double paper_samples = 35647, paper_vertices = 400, paper_reduction = 98.88;

struct Row
{
  std::string scan;
  double samples = 0;
  double sampling_distance = 0, image_size = 0, percent_smooth = 0, approximation_error = 0;
  double vertices = 0;         // of the plain path on CGAL
  double grouped_vertices = 0; // of grouping before the collapse

  double reduction() const { return samples > 0 ? 100 * (1 - vertices / samples) : 0; }
};

Row reduce(const std::string& file)
{
  Row row;
  row.scan = std::filesystem::path(file).filename().string();
  CR::Scan_file<Kernel> scan = CR::read_scan<Kernel>(file);
  Mesh mesh;
  if (scan.kind == CR::Scan_file<Kernel>::RANGE_IMAGE) {
    CR::triangulate_range_image(scan.image, mesh);
    row.samples = double(scan.image.points().size());
    row.sampling_distance = CR::sampling_distance(scan.image);
    row.image_size = CR::scan_extent(scan.image).image_size();
    row.approximation_error = CR::approximation_error(scan.image);
  } else if (scan.kind == CR::Scan_file<Kernel>::MESH) {
    mesh = std::move(scan.mesh);
    row.samples = double(mesh.number_of_vertices());
    row.image_size = CR::scan_extent(mesh).image_size();
    row.approximation_error = CR::approximation_error(mesh);
  } else {
    throw std::runtime_error(file + ": points without a grid or faces have no mesh to simplify");
  }
  auto types = mesh.add_property_map<Mesh::Vertex_index, CR::Surface_type>("v:type").first;
  row.percent_smooth = CR::surface_types(mesh, types).percent_smooth();

  // Of a mesh without a grid the sampling distance is that which its approximation error is made of, 0.15 s A /
  // %smooth.
  if (row.sampling_distance == 0)
    row.sampling_distance = row.approximation_error * row.percent_smooth / (0.15 * row.image_size);
  Mesh copy = mesh;
  const auto error = CR::parameters::approximation_error(row.approximation_error);
  row.grouped_vertices = double(CR::simplify_scan(copy, error.cell_size(3.5 * row.sampling_distance)));

  row.vertices = double(CR::simplify_scan(mesh, error));
  return row;
}

Row average(const std::vector<Row>& rows)
{
  Row sum;
  sum.scan = "average";
  const double n = double(rows.size());
  for (const Row& row : rows) {
    sum.samples += row.samples / n;
    sum.sampling_distance += row.sampling_distance / n;
    sum.image_size += row.image_size / n;
    sum.percent_smooth += row.percent_smooth / n;
    sum.approximation_error += row.approximation_error / n;
    sum.vertices += row.vertices / n;
    sum.grouped_vertices += row.grouped_vertices / n;
  }
  return sum;
}

void print(const Row& row)
{
  std::ostringstream line;
  line << std::fixed << std::left << std::setw(14) << row.scan << std::right << std::setprecision(0) << std::setw(9)
       << row.samples << std::setprecision(2) << std::setw(9) << row.percent_smooth << std::scientific
       << std::setprecision(3) << std::setw(12) << row.sampling_distance << std::setw(12) << row.image_size
       << std::setw(12) << row.approximation_error << std::fixed << std::setprecision(0) << std::setw(10)
       << row.vertices << std::setprecision(2) << std::setw(12) << row.reduction() << std::setprecision(0)
       << std::setw(10) << row.grouped_vertices;
  std::cout << line.str() << '\n';
}

void write_csv(const std::vector<Row>& rows, const std::string& file, bool with_paper)
{
  CR::write_file(file, [&](std::ostream& out) {
    out << std::setprecision(10)
        << "scan,samples,percent_smooth,sampling_distance,image_size,approximation_error,vertices,reduction,"
           "grouped_vertices\n";
    for (const Row& r : rows)
      out << r.scan << ',' << r.samples << ',' << r.percent_smooth << ',' << r.sampling_distance << ',' << r.image_size
          << ',' << r.approximation_error << ',' << r.vertices << ',' << r.reduction() << ',' << r.grouped_vertices
          << '\n';
    if (with_paper) out << "paper," << paper_samples << ",,,,," << paper_vertices << ',' << paper_reduction << ",\n";
  });
}

struct Options
{
  std::string folder, csv;
  std::vector<std::string> files;
};

int run(const Options& options)
{
  std::vector<std::string> files = options.files;
  const bool is_bunny = files.empty();
  if (is_bunny) files = bunny_scans;
  std::vector<Row> rows;
  std::cout << "scan            samples  %smooth           s           A     epsilon  vertices  %reduction   grouped\n";
  for (const std::string& file : files) {
    rows.push_back(reduce((std::filesystem::path(options.folder) / file).string()));
    print(rows.back());
  }
  rows.push_back(average(rows));
  print(rows.back());
  if (is_bunny)
    std::cout << std::fixed << std::left << std::setw(14) << "paper" << std::right << std::setprecision(0)
              << std::setw(9) << paper_samples << std::setw(45) << "" << std::setw(10) << paper_vertices
              << std::setprecision(2) << std::setw(12) << paper_reduction << '\n';
  std::cout
      << "\ns, A: sampling distance and extent in the image plane; epsilon: approximation error, a squared length;\n"
         "vertices: left by CGAL's edge collapse; grouped: left with grouping in cells of 3.5 s before it\n";
  if (!options.csv.empty()) write_csv(rows, options.csv, is_bunny);
  return EXIT_SUCCESS;
}

} // namespace

int main(int argc, char* argv[])
{
  try {
    Options options;
    po::options_description description("Usage: table_1_reduction [OPTION...] [SCAN...]\n\n"
                                        "Prints how many vertices the paper's approximation error leaves of each\n"
                                        "scan: of the four bunny scans of the paper's Table 1 if no scan is named.\n\n"
                                        "Options");
    po::options_description hidden;
    description.add_options()("help,h", "print this");
    description.add_options()("scans", po::value(&options.folder), "folder of the scans; default: this one");
    description.add_options()("csv", po::value(&options.csv), "file to write the table to, as CSV");
    hidden.add_options()("files", po::value(&options.files));
    po::variables_map values;
    if (!benchmark_tools::read_options(argc, argv, description, values, hidden, "files")) return EXIT_SUCCESS;
    return run(options);
  } catch (const std::exception& e) {
    std::cerr << "table_1_reduction: " << e.what() << '\n';
    return EXIT_FAILURE;
  }
}
