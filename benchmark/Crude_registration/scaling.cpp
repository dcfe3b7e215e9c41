// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// Time and memory of preparing a scan, and the time of registering two, as they grow with the number of samples: of
// range images, meshes, points alone, points that are there six times, and rings of a scanner that spins.

#include "child_process.h"
#include "command_line.h"
#include "generated_scan.h"
#include "plot_script.h"
#include "reference_time.h"
#include "result_tools.h"
#include "ring_scans.h"

#include <CGAL/Crude_registration/IO/write_file.h>
#include <CGAL/Crude_registration/register_scans.h>
#include <CGAL/Crude_registration/sampling/triangulate_range_image.h>

#include <boost/program_options.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace CR = CGAL::Crude_registration;
namespace po = boost::program_options;
using benchmark_tools::cpu_seconds;
using benchmark_tools::Generated_scene;
using benchmark_tools::quoted;
using benchmark_tools::reference_seconds;
using benchmark_tools::scene_resolution;
using Kernel = Generated_scene::Kernel;
using Mesh = Generated_scene::Mesh;
using Image = CR::Range_image<Kernel>;

namespace {

struct Options
{
  std::vector<std::size_t> sizes = {10000, 30000, 100000, 300000, 1000000, 3000000, 5000000};
  std::vector<std::string> kinds = {"range_image", "mesh", "points", "copies", "rings"};
  std::size_t runs = 3;
  std::string reference, csv, plot;
};

struct Preparation
{
  std::size_t vertices;
  double seconds; // median
  double input_bytes;
};

struct Registration
{
  double seconds;
  CR::Registration_status status;
  double degrees; // off the truth
};

struct Row
{
  std::string kind;
  double reference = 0; // R
  Preparation preparation = {};
  double peak_bytes = 0;
  Registration registration = {};
};

// A temporary file that child processes fill and read, so that none of them holds what it does not measure.
class Shared_file
{
public:
  Shared_file() : m_file(std::tmpfile())
  {
    if (m_file == nullptr) throw std::runtime_error("no temporary file can be made");
  }
  ~Shared_file() { std::fclose(m_file); }
  Shared_file(const Shared_file&) = delete;
  Shared_file& operator=(const Shared_file&) = delete;

  void begin() const { std::rewind(m_file); }

  template <class T>
  void write(const T& value) const
  {
    if (std::fwrite(&value, sizeof value, 1, m_file) != 1)
      throw std::runtime_error("the temporary file cannot be written");
  }

  template <class T>
  T read() const
  {
    T value;
    if (std::fread(&value, sizeof value, 1, m_file) != 1) throw std::runtime_error("the temporary file cannot be read");
    return value;
  }

private:
  std::FILE* m_file;
};

using Coordinates = std::array<double, 3>;

Kernel::Point_3 to_point(const Coordinates& p)
{
  return {p[0], p[1], p[2]};
}

using Points = std::vector<Kernel::Point_3>;

void write_points(const Shared_file& file, const Points& points)
{
  file.begin();
  file.write(points.size());
  for (const auto& p : points) file.write(Coordinates{p.x(), p.y(), p.z()});
}

// All of them `copies` times, one time after the other.
Points read_points(const Shared_file& file, std::size_t copies = 1)
{
  file.begin();
  const auto n = file.read<std::size_t>();
  Points points;
  points.reserve(copies * n);
  for (std::size_t i = 0; i < n; ++i) points.push_back(to_point(file.read<Coordinates>()));
  for (std::size_t i = n; i < copies * n; ++i) points.push_back(points[i - n]);
  return points;
}

// A scan as a range image and as a mesh, as points alone, and points of others, in files.
struct Stored_scan
{
  Shared_file image_file, mesh_file, points_file, rings_file, few_points_file;

  void write(const Image& image) const
  {
    image_file.begin();
    image_file.write(image.columns());
    image_file.write(image.rows());
    image_file.write(image.points().size());
    for (const auto& p : image.points()) image_file.write(Coordinates{p.x(), p.y(), p.z()});
    for (const Image::Index i : image.grid()) image_file.write(i);

    write_points(points_file, image.points());

    Mesh mesh;
    CR::triangulate_range_image(image, mesh);
    mesh_file.begin();
    mesh_file.write(mesh.number_of_vertices());
    mesh_file.write(mesh.number_of_edges());
    mesh_file.write(mesh.number_of_faces());
    for (const auto v : mesh.vertices()) {
      const auto& p = mesh.point(v);
      mesh_file.write(Coordinates{p.x(), p.y(), p.z()});
    }
    for (const auto f : mesh.faces())
      for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) mesh_file.write(v);
  }

  Image image() const
  {
    image_file.begin();
    const auto columns = image_file.read<std::size_t>(), rows = image_file.read<std::size_t>();
    std::vector<Kernel::Point_3> points(image_file.read<std::size_t>());
    for (auto& p : points) p = to_point(image_file.read<Coordinates>());
    std::vector<Image::Index> grid(columns * rows);
    for (auto& i : grid) i = image_file.read<Image::Index>();
    Image result(columns, rows, std::move(points), std::move(grid));
    result.set_sensor(CR::Sensor<Kernel>::orthographic(Kernel::Vector_3(0, 0, -1)));
    return result;
  }

  Mesh mesh() const
  {
    mesh_file.begin();
    const auto vertices = mesh_file.read<Mesh::size_type>(), edges = mesh_file.read<Mesh::size_type>(),
               faces = mesh_file.read<Mesh::size_type>();
    Mesh result;
    result.reserve(vertices, edges, faces);
    for (Mesh::size_type i = 0; i < vertices; ++i) result.add_vertex(to_point(mesh_file.read<Coordinates>()));
    for (Mesh::size_type i = 0; i < faces; ++i) {
      const auto a = mesh_file.read<Mesh::Vertex_index>(), b = mesh_file.read<Mesh::Vertex_index>(),
                 c = mesh_file.read<Mesh::Vertex_index>();
      result.add_face(a, b, c);
    }
    return result;
  }
};

struct Motion
{
  double matrix[3][4];
};

// As triangles have their corners that share none, each point several times.
constexpr std::size_t number_of_copies = 6;

// Writes two views of the scene and returns the motion of the first to the second.
Motion generate(std::size_t size, const Stored_scan& source, const Stored_scan& target)
{
  constexpr double turn = 0.6; // radians
  const Generated_scene scene(scene_resolution);
  const auto samples = std::size_t(1.04 * double(size)); // some do not become vertices: isolated or grazing ones
  const auto a = scene.scan(samples, 0, 1), b = scene.scan(samples, turn, 2);
  source.write(a.image);
  target.write(b.image);
  write_points(source.few_points_file, scene.scan(size / number_of_copies, 0, 1).image.points());
  write_points(target.few_points_file, scene.scan(size / number_of_copies, turn, 2).image.points());
  const auto truth = b.scene_from_scan.inverse() * a.scene_from_scan;
  Motion motion;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j) motion.matrix[i][j] = truth.m(i, j);
  return motion;
}

// Writes two scans of a room by a scanner that spins, from two places in it, in the room's own frame: 64 rings of 2,000
// samples where there are 128,000, and the like.
Motion generate_rings(std::size_t size, const Stored_scan& source, const Stored_scan& target)
{
  const benchmark_tools::Ring_scene scene;
  const double along_to_across = 2000. / 64;
  const auto rings = std::size_t(std::round(std::sqrt(double(size) / along_to_across)));
  write_points(source.rings_file, scene.scan(3.5, 3, rings, size / rings, 1));
  write_points(target.rings_file, scene.scan(5, 4, rings, size / rings, 2));
  return {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
}

template <class Input>
Preparation prepare(const Input& input, std::size_t runs)
{
  Preparation result = {};
  result.input_bytes = benchmark_tools::resident_bytes();
  std::vector<double> seconds;
  for (std::size_t i = 0; i < runs; ++i) {
    const double start = cpu_seconds();
    const CR::Scan<Kernel> scan(input);
    seconds.push_back(cpu_seconds() - start);
    // Of points alone fewer are left once their density is evened.
    if constexpr (std::is_same_v<Input, Points>) result.vertices = input.size();
    else result.vertices = scan.number_of_samples();
  }
  result.seconds = benchmark_tools::median(seconds);
  return result;
}

Registration register_two(const CR::Scan<Kernel>& source, const CR::Scan<Kernel>& target, const Motion& truth)
{
  const double start = cpu_seconds();
  const auto found = CR::register_scans(source, target);
  Registration result = {};
  result.seconds = cpu_seconds() - start;
  result.status = found.status();
  Eigen::Matrix3d wanted;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) wanted(i, j) = truth.matrix[i][j];
  result.degrees = benchmark_tools::degrees_between(benchmark_tools::rotation(found.transformation()), wanted);
  return result;
}

void print(const Row& row)
{
  constexpr double megabyte = 1e6;
  const Preparation& p = row.preparation;
  std::ostringstream out;
  out << std::left << std::setw(12) << row.kind << std::right << std::setw(9) << p.vertices << std::fixed
      << std::setprecision(3) << std::setw(8) << row.reference << std::setw(10) << p.seconds << std::setw(9)
      << p.seconds / row.reference << std::setw(9) << 1e6 * p.seconds / double(p.vertices) << std::setprecision(0)
      << std::setw(9) << p.input_bytes / megabyte << std::setw(9) << row.peak_bytes / megabyte << std::setw(9)
      << (row.peak_bytes - p.input_bytes) / double(p.vertices) << std::setprecision(3) << std::setw(10)
      << row.registration.seconds << std::setw(9) << row.registration.seconds / row.reference << "  "
      << row.registration.status;
  if (row.registration.status != CR::NOT_REGISTERED) out << ", " << row.registration.degrees << " degrees off";
  std::cout << out.str() << std::endl;
}

void write_csv(const std::string& file, const std::vector<Row>& rows)
{
  CR::write_file(file, [&](std::ostream& out) {
    out << "input,vertices,reference_seconds,prepare_seconds,prepare_r,input_bytes,peak_bytes,register_seconds,"
           "register_r,status,degrees\n";
    for (const Row& r : rows)
      out << r.kind << ',' << r.preparation.vertices << ',' << r.reference << ',' << r.preparation.seconds << ','
          << r.preparation.seconds / r.reference << ',' << r.preparation.input_bytes << ',' << r.peak_bytes << ','
          << r.registration.seconds << ',' << r.registration.seconds / r.reference << ',' << r.registration.status
          << ',' << r.registration.degrees << '\n';
  });
}

void write_plot(const std::string& file, const std::string& csv)
{
  CR::write_file(file, [&](std::ostream& out) {
    const auto curve = [&](const char* kind, const char* column, const char* title) {
      out << quoted(csv) << " using (strcol(1) eq '" << kind << "' ? $2 : NaN):" << column
          << " skip 1 with linespoints title '" << title << "'";
    };
    out << "set terminal pngcairo size 800,900\n"
        << "set output " << quoted(file + ".png") << '\n'
        << "set datafile separator ','\nset datafile missing NaN\n"
        << "set multiplot layout 2,1\n"
        << "set logscale xy\nset format x '10^{%T}'\nset grid\nset key left top\nset xlabel 'vertices'\n"
        << "set ylabel 'CPU time, one thread [R]'\nplot ";
    curve("range_image", "5", "preparing a range image");
    out << ", \\\n     ";
    curve("mesh", "5", "preparing a mesh");
    out << ", \\\n     ";
    curve("range_image", "9", "registering two prepared scans");
    out << "\nset ylabel 'peak memory [MB]'\nplot ";
    curve("range_image", "($7/1e6)", "range image");
    out << ", \\\n     ";
    curve("mesh", "($7/1e6)", "mesh");
    out << ", \\\n     ";
    curve("range_image", "($6/1e6)", "range image: before the preparation");
    out << ", \\\n     ";
    curve("mesh", "($6/1e6)", "mesh: before the preparation");
    out << "\nunset multiplot\n";
  });
}

// R: of the scan that is named, or of a generated one of about as many vertices as the scans of the bunny.
int run(const Options& options)
{
  using benchmark_tools::in_child_process;
  const auto reference = [&] { return in_child_process([&] { return reference_seconds(options.reference); }).value; };
  if (options.reference.empty()) std::cout << "R is that of a generated scan: --reference SCAN takes another\n";
  std::cout << "                               prepare          per vertex  memory: before   peak      own  register\n"
            << "input        vertices   R [s]       [s]      [R]     [us]     [MB]     [MB] [B/vert]       [s]      "
               "[R]\n";
  std::vector<Row> rows;
  double before = reference();
  for (const std::size_t size : options.sizes) {
    const Stored_scan source, target;
    const auto is_wanted = [&](const std::string& kind) {
      return std::find(options.kinds.begin(), options.kinds.end(), kind) != options.kinds.end();
    };
    const std::size_t done = rows.size();
    const auto measure = [&](const char* kind, const Motion& truth, const auto& read) {
      if (!is_wanted(kind)) return;
      Row row;
      row.kind = kind;
      const auto prepared = in_child_process([&] { return prepare(read(source), options.runs); });
      row.preparation = prepared.value;
      row.peak_bytes = prepared.peak_bytes;
      row.registration = in_child_process([&] {
                           return register_two(CR::Scan<Kernel>(read(source)), CR::Scan<Kernel>(read(target)), truth);
                         }).value;
      rows.push_back(row);
    };
    const Motion truth = in_child_process([&] { return generate(size, source, target); }).value;
    measure("range_image", truth, [](const Stored_scan& scan) { return scan.image(); });
    measure("mesh", truth, [](const Stored_scan& scan) { return scan.mesh(); });
    measure("points", truth, [](const Stored_scan& scan) { return read_points(scan.points_file); });
    measure("copies", truth,
            [](const Stored_scan& scan) { return read_points(scan.few_points_file, number_of_copies); });
    if (is_wanted("rings")) {
      const Motion motion = in_child_process([&] { return generate_rings(size, source, target); }).value;
      measure("rings", motion, [](const Stored_scan& scan) { return read_points(scan.rings_file); });
    }
    // The machine may change its speed: R is measured before and after.
    const double after = reference();
    for (std::size_t i = done; i < rows.size(); ++i) {
      rows[i].reference = 0.5 * (before + after);
      print(rows[i]);
    }
    before = after;
  }
  if (!options.csv.empty()) write_csv(options.csv, rows);
  if (!options.plot.empty()) {
    write_plot(options.plot, options.csv);
    std::cout << "gnuplot " << options.plot << " makes " << options.plot << ".png\n";
  }
  return EXIT_SUCCESS;
}

std::vector<std::size_t> read_sizes(const std::string& text)
{
  std::vector<std::size_t> sizes;
  std::istringstream in(text);
  for (std::string field; std::getline(in, field, ',');) {
    std::size_t size = 0;
    std::istringstream number(field);
    if (!(number >> size) || !number.eof() || size < 1000)
      throw std::runtime_error("--sizes has to be numbers of at least 1000 with commas between, not " + text);
    sizes.push_back(size);
  }
  return sizes;
}

std::vector<std::string> read_kinds(const std::string& text)
{
  const std::vector<std::string> known = Options().kinds;
  std::vector<std::string> kinds;
  std::istringstream in(text);
  for (std::string field; std::getline(in, field, ',');) {
    if (std::find(known.begin(), known.end(), field) == known.end())
      throw std::runtime_error("--kinds has to be some of range_image,mesh,points,copies,rings, not " + text);
    kinds.push_back(field);
  }
  return kinds;
}

} // namespace

int main(int argc, char* argv[])
{
  try {
    Options options;
    std::string sizes, kinds;
    po::options_description description("Usage: scaling [OPTION...]\n\n"
                                        "Prepares and registers generated scans of growing size, each in a process\n"
                                        "of its own: CPU time of one thread, and the most memory the process had.\n\n"
                                        "Options");
    description.add_options()("help,h", "print this");
    description.add_options()("reference", po::value(&options.reference),
                              "scan whose simplification is the unit of time, R (see reference_time)");
    description.add_options()("sizes", po::value(&sizes),
                              "numbers of vertices, with commas between; default: from 10000 to 5000000");
    description.add_options()("kinds", po::value(&kinds),
                              "of input, with commas between; default: range_image,mesh,points,copies,rings");
    description.add_options()("runs", po::value(&options.runs)->default_value(options.runs),
                              "preparations of each scan, of which the median counts");
    description.add_options()("output", po::value(&options.csv), "file to write the table to, as CSV");
    description.add_options()("plot", po::value(&options.plot), "gnuplot script to write; needs --output");
    po::variables_map values;
    if (!benchmark_tools::read_options(argc, argv, description, values)) return EXIT_SUCCESS;
    if (values.count("sizes") != 0) options.sizes = read_sizes(sizes);
    if (values.count("kinds") != 0) options.kinds = read_kinds(kinds);
    if (options.runs == 0) throw std::invalid_argument("--runs has to be at least 1");
    if (!options.plot.empty() && options.csv.empty()) throw std::invalid_argument("--plot needs --output");
    return run(options);
  } catch (const std::exception& e) {
    std::cerr << "scaling: " << e.what() << '\n';
    return EXIT_FAILURE;
  }
}
