// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// The command line: registers scans, says what is in one, and simulates some.

#include <CGAL/Crude_registration/IO/read_scan.h>
#include <CGAL/Crude_registration/IO/write_range_image.h>
#include <CGAL/Crude_registration/Scan.h>
#include <CGAL/Crude_registration/reduction/approximation_error.h>
#include <CGAL/Crude_registration/sampling/estimate_sensor.h>
#include <CGAL/Crude_registration/IO/internal/atomic_file.h>
#include <CGAL/Crude_registration/IO/internal/result_json.h>
#include <CGAL/Crude_registration/internal/reduction/scan_frame.h>
#include <CGAL/Crude_registration/simulation/make_statue.h>
#include <CGAL/Crude_registration/named_parameters.h>
#include <CGAL/Crude_registration/register_scans.h>
#include <CGAL/Crude_registration/reduction/simplify_scan.h>
#include <CGAL/Crude_registration/simulation/simulate_range_image.h>
#include <CGAL/Crude_registration/reduction/surface_types.h>
#include <CGAL/Crude_registration/sampling/triangulate_points.h>
#include <CGAL/Crude_registration/sampling/triangulate_range_image.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/transform.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/for_each.h>

#include <boost/program_options.hpp>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#endif

#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <limits>
#include <locale>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace CR = CGAL::Crude_registration;
namespace PMP = CGAL::Polygon_mesh_processing;
namespace po = boost::program_options;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Transformation = CGAL::Aff_transformation_3<Kernel>;
using Mesh = CGAL::Surface_mesh<Point>;
using Scan_file = CR::Scan_file<Kernel>;
using Scan = CR::Scan<Kernel>;
using Result = CR::Registration_result<Kernel>;
using CR::internal::Json_writer;
using CR::internal::Rigid_motion;

namespace {

enum Exit_code
{
  EXIT_REGISTERED = 0,
  EXIT_ERROR = 1,
  EXIT_AMBIGUOUS = 2,
  EXIT_NOT_REGISTERED = 3
};

const char* const usage =
    R"(usage: crude_register register SOURCE TARGET [OPTION...]   find the motion that maps SOURCE onto TARGET
       crude_register info SCAN [OPTION...]                say what is in a scan, and what the method makes of it
       crude_register simulate --output DIR [OPTION...]    write range scans of a generated body, with their poses
       crude_register COMMAND --help                       the options of a command

SOURCE, TARGET and SCAN are range images (PLY with a range_grid, PTX), meshes (PLY, OFF, OBJ, STL) or points (PLY, text).
)";

// Wrong arguments on the command line.
struct Usage_error : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

double seconds_since(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// The arguments of a command, or nothing if they asked for help, which is written.
std::optional<po::variables_map> parse(const std::string& synopsis, const std::string& about,
                                       const po::options_description& options,
                                       const std::vector<std::string>& positional,
                                       const std::vector<std::string>& arguments)
{
  po::options_description all;
  all.add(options).add_options()("help,h", "");
  po::positional_options_description places;
  for (const std::string& name : positional) {
    all.add_options()(name.c_str(), po::value<std::string>());
    places.add(name.c_str(), 1);
  }
  po::variables_map map;
  try {
    po::store(po::command_line_parser(arguments).options(all).positional(places).run(), map);
    if (map.count("help") > 0) {
      std::cout << "usage: crude_register " << synopsis << "\n\n" << about << '\n' << options;
      return std::nullopt;
    }
    po::notify(map);
  } catch (const po::error& e) {
    throw Usage_error(e.what());
  }
  for (const std::string& name : positional)
    if (map.count(name) == 0) throw Usage_error("no " + name + " is given");
  return map;
}

Point parse_point(const std::string& text, const std::string& option)
{
  std::istringstream in(text);
  in.imbue(std::locale::classic());
  std::array<double, 3> c{};
  for (std::size_t i = 0; i < 3; ++i) {
    char comma = ',';
    if (i > 0) in >> comma;
    if (comma != ',' || !(in >> c[i]) || !std::isfinite(c[i]))
      throw Usage_error("--" + option + " takes three numbers x,y,z, not '" + text + "'");
  }
  if (in >> std::ws; !in.eof()) throw Usage_error("--" + option + " takes three numbers x,y,z, not '" + text + "'");
  return Point(c[0], c[1], c[2]);
}

std::optional<Point> viewpoint_of(const po::variables_map& map)
{
  if (map.count("viewpoint") == 0) return std::nullopt;
  return parse_point(map["viewpoint"].as<std::string>(), "viewpoint");
}

// Calls f with the named parameters that say where the sensor was, if it is known.
template <class Function>
auto with_viewpoint(const std::optional<Point>& viewpoint, const Function& f)
{
  return viewpoint ? f(CR::parameters::viewpoint(*viewpoint)) : f(CR::parameters::default_values());
}

// The surface of a scan.
Mesh mesh_of(const Scan_file& file, const std::optional<Point>& viewpoint)
{
  Mesh mesh;
  switch (file.kind) {
  case Scan_file::RANGE_IMAGE:
    CR::triangulate_range_image(file.image, mesh);
    break;
  case Scan_file::MESH:
    mesh = file.mesh;
    break;
  case Scan_file::POINTS:
    with_viewpoint(viewpoint, [&](const auto& np) { CR::triangulate_points(file.points, mesh, np); });
    break;
  }
  return mesh;
}

std::size_t number_of_samples(const Scan_file& file)
{
  switch (file.kind) {
  case Scan_file::RANGE_IMAGE:
    return file.image.points().size();
  case Scan_file::MESH:
    return file.mesh.number_of_vertices();
  case Scan_file::POINTS:
    break;
  }
  return file.points.size();
}

std::string base_name(const std::string& file)
{
  return std::filesystem::path(file).filename().string();
}

void make_folder(const std::string& folder)
{
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw CR::IO_error(folder, "the folder cannot be made: " + error.message());
}

std::string in_folder(const std::string& folder, const std::string& name)
{
  return (std::filesystem::path(folder) / name).string();
}

void write_mesh(const std::string& file, const Mesh& mesh)
{
  CR::internal::write_atomically(file, [&](std::ostream& out) {
    CGAL::IO::set_binary_mode(out);
    CGAL::IO::write_PLY(out, mesh);
  });
}

void write_rows(std::ostream& out, const Transformation& motion, const char* indent, const char* end)
{
  for (int i = 0; i < 3; ++i) {
    out << indent;
    for (int j = 0; j < 4; ++j) out << motion.m(i, j) << (j < 3 ? " " : end);
  }
}

// Poses of scans in a common frame: a line each, the name of the file and the rows of the 3 x 4 matrix.
std::map<std::string, Rigid_motion> read_poses(const std::string& file)
{
  std::ifstream in(file);
  if (!in) throw CR::IO_error(file, "the file cannot be opened");
  std::map<std::string, Rigid_motion> poses;
  std::string line;
  for (std::size_t number = 1; std::getline(in, line); ++number) {
    std::istringstream words(line);
    words.imbue(std::locale::classic());
    std::string name;
    if (!(words >> name) || name[0] == '#') continue;
    Rigid_motion pose;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 4; ++j)
        if (double& x = j < 3 ? pose.rotation(i, j) : pose.translation(i); !(words >> x))
          throw CR::IO_error(file, number, "the name of a file and 12 numbers are expected");
    poses[name] = pose;
  }
  return poses;
}

// What the truth says about an answer.
struct Error
{
  double degrees;      // of rotation
  double displacement; // RMS of the source's vertices
};

Error error_of(const Transformation& answer, const Rigid_motion& truth, const Mesh& source)
{
  const Rigid_motion motion = CR::internal::to_rigid_motion(answer);
  double sum = 0;
  for (auto v : source.vertices()) {
    const Point& p = source.point(v);
    const CR::internal::Vector x(p.x(), p.y(), p.z());
    sum += (motion(x) - truth(x)).squaredNorm() / double(source.number_of_vertices());
  }
  const Eigen::AngleAxisd turn(CR::internal::Matrix(motion.rotation * truth.rotation.transpose()));
  return {turn.angle() * 180 / CGAL_PI, std::sqrt(sum)};
}

int run_register(const std::vector<std::string>& arguments)
{
  po::options_description options("options");
  auto add = options.add_options();
  add("f1", po::value<double>(), "shortest axes of the trihedra that are matched, as a share of the scan's size M");
  add("f2", po::value<double>(),
      "longest axes of the trihedra; together, f1 and f2 are about the least and the "
      "largest share of the scan that overlaps; explored by the program if not given");
  add("output", po::value<std::string>(),
      "folder for source_moved.ply, target.ply and motion.txt (the 4 x 4 matrix); "
      "made if missing, written unless the scans are not registered");
  add("viewpoint", po::value<std::string>(),
      "x,y,z of the sensor, in each scan's own frame, for scans whose files do "
      "not tell it");
  add("poses", po::value<std::string>(), "file of true poses (FILE and a 3 x 4 matrix a line): print the error, too");
  add("time-budget", po::value<double>(),
      "seconds from the start after which preparation and search end, with the best so far");
  add("threads", po::value<int>(), "largest number of threads; the answer does not depend on it");
  add("json", "print JSON, the same bytes for the same scans");
  add("times", "add the times to the JSON");
  const auto given = parse("register SOURCE TARGET [OPTION...]",
                           "Finds the rigid motion that maps SOURCE onto TARGET, and says whether it can be believed.\n"
                           "Exit code: 0 registered, 2 ambiguous, 3 not registered, 1 error.\n",
                           options, {"SOURCE", "TARGET"}, arguments);
  if (!given) return 0;
  const po::variables_map& map = *given;

  const std::optional<Point> viewpoint = viewpoint_of(map);
#ifdef CGAL_LINKED_WITH_TBB
  std::unique_ptr<tbb::global_control> limit;
#endif
  if (map.count("threads") > 0) {
    const int threads = map["threads"].as<int>();
    if (threads < 1) throw Usage_error("--threads takes a number above zero");
#ifdef CGAL_LINKED_WITH_TBB
    limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, std::size_t(threads));
#endif
  }
  const double f1 = map.count("f1") > 0 ? map["f1"].as<double>() : 0;
  const double f2 = map.count("f2") > 0 ? map["f2"].as<double>() : 1;
  if (!(f1 >= 0 && f1 < f2 && std::isfinite(f2))) throw Usage_error("--f1 has to be zero or above, and less than --f2");
  const double time_budget =
      map.count("time-budget") > 0 ? map["time-budget"].as<double>() : (std::numeric_limits<double>::max)();
  if (!(time_budget > 0 && std::isfinite(time_budget))) throw Usage_error("--time-budget takes seconds, above zero");
  const bool has_poses = map.count("poses") > 0;
  const std::string poses_file = has_poses ? map["poses"].as<std::string>() : std::string();
  const auto poses = has_poses ? read_poses(poses_file) : std::map<std::string, Rigid_motion>();

  struct Side
  {
    std::string file;
    Scan_file contents;
    std::unique_ptr<const Scan> scan;
    double seconds = 0;
    std::string interruption;   // the time budget's end, before there was a scan
    std::exception_ptr failure; // of both sides', the first is reported
  };
  std::array<Side, 2> sides;
  sides[0].file = map["SOURCE"].as<std::string>();
  sides[1].file = map["TARGET"].as<std::string>();
  const auto left = [&, begin = std::chrono::steady_clock::now()] { // of the time budget
    constexpr double shortest = 1e-9;
    return (std::max)(shortest, time_budget - seconds_since(begin));
  };
  CGAL::for_each<CGAL::Parallel_if_available_tag>(sides, [&](Side& side) {
    try {
      side.contents = CR::read_scan<Kernel>(side.file);
      const auto start = std::chrono::steady_clock::now();
      const auto within = CR::parameters::time_budget(left());
      side.scan = viewpoint ? std::make_unique<const Scan>(side.contents, within.viewpoint(*viewpoint), side.file)
                            : std::make_unique<const Scan>(side.contents, within, side.file);
      side.seconds = seconds_since(start);
    } catch (const CR::Preparation_interrupted& interrupted) {
      side.interruption = interrupted.what();
    } catch (...) {
      side.failure = std::current_exception();
    }
    return true;
  });
  for (const Side& side : sides)
    if (side.failure) std::rethrow_exception(side.failure);
  const Side &source = sides[0], &target = sides[1];

  const auto start = std::chrono::steady_clock::now();
  const auto answer = [&] {
    Result::Parts parts;
    parts.reason = source.scan ? target.interruption : source.interruption;
    if (!source.scan || !target.scan) return Result(std::move(parts));
    return CR::register_scans<CGAL::Parallel_if_available_tag>(
        *source.scan, *target.scan, CR::parameters::minimum_extent(f1).maximum_extent(f2).time_budget(left()));
  };
  const Result result = answer();
  const double search_seconds = seconds_since(start);
  const bool has_motion = result.status() != CR::NOT_REGISTERED;

  std::optional<Error> error;
  const bool writes = map.count("output") > 0 && has_motion;
  Mesh source_mesh;
  if (writes || has_poses) source_mesh = mesh_of(source.contents, viewpoint);
  if (has_poses && has_motion) {
    const auto s = poses.find(base_name(source.file)), t = poses.find(base_name(target.file));
    if (s == poses.end() || t == poses.end()) throw CR::IO_error(poses_file, "a pose of the two scans is missing");
    error = error_of(result.transformation(), t->second.inverse() * s->second, source_mesh);
  }
  std::vector<std::string> written;
  if (writes) {
    const std::string folder = map["output"].as<std::string>();
    make_folder(folder);
    PMP::transform(result.transformation(), source_mesh);
    written = {in_folder(folder, "source_moved.ply"), in_folder(folder, "target.ply"), in_folder(folder, "motion.txt")};
    write_mesh(written[0], source_mesh);
    write_mesh(written[1], mesh_of(target.contents, viewpoint));
    CR::internal::write_atomically(written[2], [&](std::ostream& out) {
      write_rows(out, result.transformation(), "", "\n");
      out << "0 0 0 1\n";
    });
  }

  if (map.count("json") > 0) {
    Json_writer json;
    json.begin_object().member("source", source.file).member("target", target.file);
    CR::internal::write_json(json, result, map.count("times") > 0);
    if (error) {
      json.key("error").begin_object();
      json.member("rotation_in_degrees", error->degrees).member("rms_displacement", error->displacement).end_object();
    }
    if (map.count("times") > 0)
      json.member("preparation_seconds", source.seconds + target.seconds).member("search_seconds", search_seconds);
    json.key("written").begin_array();
    for (const std::string& file : written) json.value(file);
    json.end_array().end_object();
    std::cout << json.text() << '\n';
  } else {
    std::cout << "source:     " << source.file << ", " << number_of_samples(source.contents) << " samples\n"
              << "target:     " << target.file << ", " << number_of_samples(target.contents) << " samples\n"
              << "status:     " << result.status() << '\n';
    if (!result.reason().empty()) std::cout << "reason:     " << result.reason() << '\n';
    std::cout << std::setprecision(4) << "confidence: " << result.confidence() << '\n';
    for (const std::string& name : result.free_motions()) std::cout << "free:       " << name << '\n';
    if (has_motion) {
      std::cout << "overlap:    " << 100 * result.overlap() << " % of the source\n"
                << "residual:   " << result.residual() << " sampling distances\n";
      if (error)
        std::cout << "error:      " << error->degrees << " degrees, " << error->displacement
                  << " RMS displacement of the source\n";
      std::cout << "motion, from the frame of the source to that of the target:\n" << std::setprecision(12);
      write_rows(std::cout, result.transformation(), "  ", "\n");
      std::cout << "  0 0 0 1\n";
    }
    std::cout << std::setprecision(3) << "seconds:    " << source.seconds + target.seconds << " preparation, "
              << search_seconds << " search\n";
    for (const std::string& file : written) std::cout << "written:    " << file << '\n';
  }
  switch (result.status()) {
  case CR::REGISTERED:
    return EXIT_REGISTERED;
  case CR::AMBIGUOUS:
    return EXIT_AMBIGUOUS;
  case CR::NOT_REGISTERED:
    break;
  }
  return EXIT_NOT_REGISTERED;
}

std::string name_of(const CR::Sensor<Kernel>& sensor)
{
  return sensor.is_perspective() ? "perspective" : sensor.is_orthographic() ? "orthographic" : "unknown";
}

int run_info(const std::vector<std::string>& arguments)
{
  po::options_description options("options");
  auto add = options.add_options();
  add("viewpoint", po::value<std::string>(), "x,y,z of the sensor, for scans whose files do not tell it");
  add("json", "print JSON");
  const auto given = parse("info SCAN [OPTION...]",
                           "Says what is in a scan, and what sections 4 and 5 of the method make of it: the sampling "
                           "distance s,\nthe extent A in the image plane and the mean extent M, the share of smooth "
                           "vertices, the approximation\nerror epsilon, and the vertices that the simplification "
                           "leaves.\n",
                           options, {"SCAN"}, arguments);
  if (!given) return 0;
  const po::variables_map& map = *given;
  const std::string name = map["SCAN"].as<std::string>();
  const std::optional<Point> viewpoint = viewpoint_of(map);
  const Scan_file file = CR::read_scan<Kernel>(name);
  Mesh mesh = mesh_of(file, viewpoint);
  if (mesh.number_of_faces() == 0) throw std::invalid_argument(name + ": the scan has no surface: no face is left");

  const bool is_image = file.kind == Scan_file::RANGE_IMAGE;
  CR::Sensor<Kernel> sensor;
  CR::Scan_extent extent;
  double s = 0, epsilon = 0;
  if (is_image) {
    sensor = file.image.sensor().is_known() ? file.image.sensor() : CR::estimate_sensor(file.image);
    s = CR::sampling_distance(file.image);
    extent = CR::scan_extent(file.image);
    epsilon = CR::approximation_error(file.image);
  } else {
    if (viewpoint) sensor = CR::Sensor<Kernel>::perspective(*viewpoint);
    s = CR::internal::median_edge_length(
        CR::internal::to_flat_mesh(mesh, CGAL::parameters::default_values(), "info", "mesh"));
    with_viewpoint(viewpoint, [&](const auto& np) {
      extent = CR::scan_extent(mesh, np);
      epsilon = CR::approximation_error(mesh, np);
    });
  }
  const auto types = mesh.add_property_map<Mesh::Vertex_index, CR::Surface_type>("v:type").first;
  const CR::Surface_type_counts counts = CR::surface_types(mesh, types);
  const std::size_t faces = mesh.number_of_faces();
  const std::size_t simplified = CR::simplify_scan(mesh, CR::parameters::approximation_error(epsilon));
  const char* const kind = is_image ? "range image" : file.kind == Scan_file::MESH ? "mesh" : "points";

  if (map.count("json") > 0) {
    Json_writer json;
    json.begin_object().member("scan", name).member("kind", kind).member("samples", number_of_samples(file));
    if (is_image) json.member("columns", file.image.columns()).member("rows", file.image.rows());
    json.member("sensor", name_of(sensor)).member("faces", faces).member("sampling_distance", s);
    json.key("extent").row(std::array<double, 3>{extent.horizontal, extent.vertical, extent.depth});
    json.member("image_size", extent.image_size()).member("mean_extent", extent.mean());
    json.key("vertices").begin_object();
    json.member("planar", counts.planar).member("parabolic", counts.parabolic).member("elliptic", counts.elliptic);
    json.member("hyperbolic", counts.hyperbolic).end_object();
    json.member("percent_smooth", counts.percent_smooth()).member("approximation_error", epsilon);
    json.member("simplified_vertices", simplified).end_object();
    std::cout << json.text() << '\n';
    return 0;
  }
  std::cout << "scan:       " << name << ", " << kind << '\n' << "samples:    " << number_of_samples(file);
  if (is_image) std::cout << " in a grid of " << file.image.columns() << " x " << file.image.rows();
  std::cout << "\nsensor:     " << name_of(sensor) << "\nfaces:      " << faces << std::setprecision(6)
            << "\ns:          " << s << "\nextent:     " << extent.horizontal << " x " << extent.vertical << " x "
            << extent.depth << ", A = " << extent.image_size() << ", M = " << extent.mean()
            << "\nvertices:   " << counts.planar << " planar, " << counts.parabolic << " parabolic, " << counts.elliptic
            << " elliptic, " << counts.hyperbolic << " hyperbolic\nsmooth:     " << counts.percent_smooth()
            << " %\nepsilon:    " << epsilon << " (mean squared distance)\nsimplified: " << simplified << " vertices\n";
  return 0;
}

int run_simulate(const std::vector<std::string>& arguments)
{
  po::options_description options("options");
  auto add = options.add_options();
  add("output", po::value<std::string>()->required(),
      "folder for scan_0.ply, scan_1.ply, ... and poses.txt; made if "
      "missing");
  add("scans", po::value<int>()->default_value(2), "number of scans");
  add("angle", po::value<double>()->default_value(45), "degrees from one viewpoint to the next, around the body");
  add("samples", po::value<int>()->default_value(400), "columns, and rows, of the grid");
  add("noise", po::value<double>()->default_value(0.1), "standard deviation of the depths, in distances of samples");
  add("quantization", po::value<double>()->default_value(0), "step of the depths, in distances of samples");
  add("drop-out", po::value<double>()->default_value(0.01), "share of samples lost where the surface faces the sensor");
  add("grazing-drop-out", po::value<double>()->default_value(0.8), "share of samples lost at grazing angles");
  add("perspective", "lines of sight from one point, instead of parallel ones");
  add("resolution", po::value<int>()->default_value(96), "cells along the body");
  add("seed", po::value<unsigned>()->default_value(0), "which body, and which noise");
  const auto given = parse("simulate --output DIR [OPTION...]",
                           "Writes range scans of a generated body, each in the frame of its sensor, and their true "
                           "poses.\n",
                           options, {}, arguments);
  if (!given) return 0;
  const po::variables_map& map = *given;
  const std::string folder = map["output"].as<std::string>();
  const int scans = map["scans"].as<int>(), samples = map["samples"].as<int>();
  const double angle = map["angle"].as<double>() * CGAL_PI / 180;
  const unsigned seed = map["seed"].as<unsigned>();
  if (scans < 1) throw Usage_error("--scans takes a number above zero");
  if (samples < 2 || samples > 20000) throw Usage_error("--samples takes a number from 2 to 20000");
  if (!std::isfinite(angle)) throw Usage_error("--angle takes a finite number");

  Mesh body;
  CR::make_statue(body, map["resolution"].as<int>(), CR::parameters::random_seed(seed));
  const CR::Simulated_scene scene(body);
  make_folder(folder);
  std::ostringstream poses;
  poses.imbue(std::locale::classic());
  poses.precision(std::numeric_limits<double>::max_digits10);
  for (int i = 0; i < scans; ++i) {
    // From above, a little.
    const Kernel::Vector_3 direction(-std::cos(i * angle), -std::sin(i * angle), -0.25);
    auto camera = CR::Range_camera<Kernel>::framing(PMP::bbox(body), direction, std::size_t(samples),
                                                    map.count("perspective") > 0);
    camera.noise = map["noise"].as<double>();
    camera.quantization = map["quantization"].as<double>();
    camera.drop_out = map["drop-out"].as<double>();
    camera.grazing_drop_out = map["grazing-drop-out"].as<double>();
    camera.seed = std::uint64_t(seed) * 1000003u + std::uint64_t(i);
    const auto scan = scene.range_image(camera);
    const std::string name = "scan_" + std::to_string(i) + ".ply";
    CR::write_range_image(in_folder(folder, name), scan.image);
    poses << name;
    write_rows(poses, scan.scene_from_scan, " ", "");
    poses << '\n';
    std::cout << in_folder(folder, name) << ", " << scan.image.points().size() << " samples\n";
  }
  const std::string poses_file = in_folder(folder, "poses.txt");
  CR::internal::write_atomically(poses_file, [&](std::ostream& out) { out << poses.str(); });
  std::cout << poses_file << '\n';
  return 0;
}

int run(const std::vector<std::string>& arguments)
{
  if (arguments.empty()) throw Usage_error("no command is given");
  const std::string& command = arguments.front();
  const std::vector<std::string> rest(arguments.begin() + 1, arguments.end());
  if (command == "register") return run_register(rest);
  if (command == "info") return run_info(rest);
  if (command == "simulate") return run_simulate(rest);
  if (command == "--help" || command == "-h" || command == "help") {
    std::cout << usage;
    return 0;
  }
  throw Usage_error("there is no command '" + command + "'");
}

} // namespace

int main(int argc, char** argv)
{
  try {
    const int code = run(std::vector<std::string>(argv + 1, argv + argc));
    std::cout.flush();
    if (!std::cout) throw std::runtime_error("the output cannot be written");
    return code;
  } catch (const Usage_error& e) {
    std::cerr << "crude_register: " << e.what() << "; see crude_register --help\n";
  } catch (const std::bad_alloc&) {
    std::cerr << "crude_register: out of memory\n";
  } catch (const std::exception& e) {
    std::cerr << "crude_register: " << e.what() << '\n';
  }
  return EXIT_ERROR;
}
