// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "assembly_files.h"

#include "surfaces.h"

#include <CGAL/Crude_registration/assemble_scans.h>

#include <CGAL/IO/Color.h>
#include <CGAL/IO/write_ply_points.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iomanip>
#include <iterator>
#include <locale>
#include <set>
#include <sstream>
#include <tuple>
#include <utility>

namespace {

// A line a scan, its name and the rows of its 3 x 4 matrix; a comment before each component.
void write_lines(std::ostream& out, const Assembly& result, const std::vector<std::string>& names)
{
  for (std::size_t c = 0; c < result.number_of_components(); ++c) {
    out << "# component " << c << '\n';
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (result.component(i) != c) continue;
      out << names[i];
      write_rows(out, result.pose(i), " ", "");
      out << '\n';
    }
  }
}

// Of the Stanford 3D scanning repository: `bmesh NAME t q` maps p to R(q)^T p + t, with q = (x, y, z, w).
void write_conf(std::ostream& out, const Assembly& result, const std::vector<std::string>& names)
{
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (result.component(i) != 0) continue;
    Eigen::Matrix3d rotation;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) rotation(r, c) = result.pose(i).m(r, c);
    const Eigen::Quaterniond q(Eigen::Matrix3d(rotation.transpose()));
    out << "bmesh " << names[i];
    for (int r = 0; r < 3; ++r) out << ' ' << result.pose(i).m(r, 3);
    out << ' ' << q.x() << ' ' << q.y() << ' ' << q.z() << ' ' << q.w() << '\n';
  }
}

// Of MeshLab: the number of scans; of each its name, a line '#', and the rows of its 4 x 4 matrix; 0.
void write_aln(std::ostream& out, const Assembly& result, const std::vector<std::string>& names)
{
  std::size_t n = 0;
  for (std::size_t i = 0; i < names.size(); ++i) n += result.component(i) == 0;
  out << n << '\n';
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (result.component(i) != 0) continue;
    out << names[i] << "\n#\n";
    write_rows(out, result.pose(i), "", "\n");
    out << "0 0 0 1\n";
  }
  out << "0\n";
}

} // namespace

std::vector<std::string> names_of(const std::vector<std::string>& files)
{
  std::vector<std::string> names;
  for (const std::string& file : files) names.push_back(base_name(file));
  const std::set<std::string> distinct(names.begin(), names.end());
  return distinct.size() == names.size() ? names : files;
}

Json rows_of_edges(const Assembly& result)
{
  const auto word_of = [](const auto& value) {
    std::ostringstream out;
    out << value;
    return out.str();
  };
  Json rows = Json::array();
  for (const auto& e : result.edges())
    rows.push_back({{"source", e.source},
                    {"target", e.target},
                    {"status", word_of(e.status)},
                    {"reason", e.reason},
                    {"registration", word_of(e.registration)},
                    {"confidence", e.confidence},
                    {"overlap", e.overlap},
                    {"residual", e.residual}});
  return rows;
}

Json rows_of_overlaps(const Assembly& result)
{
  Json rows = Json::array();
  for (const auto& o : result.overlaps())
    rows.push_back({{"source", o.source}, {"target", o.target}, {"overlap", o.overlap}, {"residual", o.residual}});
  return rows;
}

void write_poses(const std::string& file, const Assembly& result, const std::vector<std::string>& names)
{
  const auto ends_in = [&](const std::string& end) {
    return file.size() >= end.size() && file.compare(file.size() - end.size(), end.size(), end) == 0;
  };
  CR::write_file(file, [&](std::ostream& out) {
    if (ends_in(".conf")) write_conf(out, result, names);
    else if (ends_in(".aln")) write_aln(out, result, names);
    else write_lines(out, result, names);
  });
}

void write_graph(std::ostream& out, const Assembly& result, const std::vector<std::string>& names)
{
  const auto quoted = [](const std::string& name) {
    std::string text = "\"";
    for (const char c : name) {
      if (c == '"' || c == '\\') text += '\\';
      text += c;
    }
    return text + '"';
  };
  out << "graph assembly {\n";
  for (std::size_t c = 0; c < result.number_of_components(); ++c) {
    out << "  subgraph cluster_" << c << " {\n";
    for (std::size_t i = 0; i < names.size(); ++i)
      if (result.component(i) == c) out << "    " << quoted(names[i]) << ";\n";
    out << "  }\n";
  }
  for (const auto& e : result.edges()) {
    if (e.status == CR::WITHOUT_OVERLAP) continue;
    std::ostringstream label;
    label.imbue(std::locale::classic());
    label << std::setprecision(2) << e.overlap;
    out << "  " << quoted(names[e.source]) << " -- " << quoted(names[e.target]) << " [label=\"" << label.str() << '"';
    if (e.status != CR::USED) out << ", style=dashed, color=" << (e.status == CR::DROPPED ? "red" : "gray");
    out << "];\n";
  }
  out << "}\n";
}

void write_tables(std::ostream& out, const Assembly& result, const std::vector<std::string>& names)
{
  const std::size_t n = names.size();
  std::vector<double> overlaps(n * n, 0), residuals(n * n, 0);
  for (const auto& o : result.overlaps()) {
    overlaps[o.source * n + o.target] = o.overlap;
    residuals[o.source * n + o.target] = o.residual;
  }
  const auto write = [&](const std::string& head, const std::vector<double>& values, double unit, int digits) {
    out << head << '\n' << std::fixed << std::setprecision(digits);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        if (values[i * n + j] > 0) out << std::setw(6) << unit * values[i * n + j];
        else out << "     -";
      }
      out << "  " << names[i] << '\n';
    }
    out << '\n';
  };
  write("overlap: per cent of the scan of the row that lie on that of the column", overlaps, 100, 0);
  write("residual: RMS distance along the normals, in sampling distances", residuals, 1, 2);
  constexpr double bands[] = {0, 0.125, 0.25, 0.5, 1, 2};
  out << "pairs by residual, in sampling distances\n" << std::setprecision(3);
  for (std::size_t b = 0; b + 1 < std::size(bands); ++b)
    out << std::setw(6) << bands[b] << " to " << std::setw(6) << bands[b + 1] << ": "
        << std::count_if(residuals.begin(), residuals.end(),
                         [&](double r) { return r > bands[b] && r <= bands[b + 1]; })
        << '\n';
}

void write_points(const std::string& name, const po::variables_map& map, const Assembly& result,
                  const std::vector<CR::Scan<Kernel>>& scans, const std::vector<std::string>& files)
{
  using Part = unsigned char; // of a colour
  using Sample = std::tuple<Point, int, double, Part, Part, Part>;
  std::vector<Sample> samples;
  bool have_colours = false;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (result.component(i) != 0) continue;
    const Scan_file contents = read_scan(map, files[i]);
    const std::vector<Point> points = points_of(contents);
    have_colours = have_colours || !contents.colors.empty();
    const std::vector<double> distances = CR::distances_to_other_scans(scans, result, i, points);
    for (std::size_t k = 0; k < points.size(); ++k) {
      const CGAL::IO::Color colour = contents.colors.empty() ? CGAL::IO::white() : contents.colors[k];
      samples.emplace_back(result.pose(i).transform(points[k]), int(i), std::isfinite(distances[k]) ? distances[k] : -1,
                           colour.red(), colour.green(), colour.blue());
    }
  }
  CR::write_file(name, [&](std::ostream& out) {
    CGAL::IO::set_binary_mode(out);
    const auto point = [] { return CGAL::make_ply_point_writer(CGAL::Nth_of_tuple_property_map<0, Sample>()); };
    const auto scan = [] {
      return std::make_pair(CGAL::Nth_of_tuple_property_map<1, Sample>(), CGAL::PLY_property<int>("scan"));
    };
    const auto distance = [] {
      return std::make_pair(CGAL::Nth_of_tuple_property_map<2, Sample>(), CGAL::PLY_property<double>("distance"));
    };
    if (have_colours)
      CGAL::IO::write_PLY_with_properties(
          out, samples, point(), scan(), distance(),
          std::make_pair(CGAL::Nth_of_tuple_property_map<3, Sample>(), CGAL::PLY_property<Part>("red")),
          std::make_pair(CGAL::Nth_of_tuple_property_map<4, Sample>(), CGAL::PLY_property<Part>("green")),
          std::make_pair(CGAL::Nth_of_tuple_property_map<5, Sample>(), CGAL::PLY_property<Part>("blue")));
    else CGAL::IO::write_PLY_with_properties(out, samples, point(), scan(), distance());
  });
}
