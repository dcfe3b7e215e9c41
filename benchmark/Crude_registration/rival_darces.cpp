// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// A rival of the paper's, DARCES (C.-S. Chen, Y.-P. Hung, J.-B. Cheng: RANSAC-based DARCES, IEEE Transactions on
// Pattern Analysis and Machine Intelligence 21, 1999), on its four pairs of bunny scans, beside the paper's method.
//
// It describes nothing: a triangle of random points of the source is looked for among all points of the target by the
// lengths of its sides alone. The first point may be anywhere; the second one lies on a sphere around it, the third one
// on a circle about the line of the two. Every triangle that fits gives a motion, which counts by how many points of
// the source it takes to the target; those whose first points are not taken there are left early. A point is taken to
// the target if one of its points is within the tolerance.
//
// Both scans are thinned to one point a cell; lengths are in cells.

#include "bunny_pairs.h"
#include "cpu_time.h"
#include "rival_trials.h"

#include <CGAL/Crude_registration/reduction/scan_extent.h>

#include <boost/program_options.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace CR = CGAL::Crude_registration;
namespace po = boost::program_options;
using benchmark_tools::Rival_answer;
using Eigen::Vector3d;

namespace {

using Points = std::vector<Vector3d>;
using Motion = Eigen::Isometry3d;

struct Options
{
  double points = 1000;                  // about, of a scan that is thinned
  double tolerance = 0.7;                // in cells
  double shortest = 0.15, longest = 0.3; // sides of a triangle, in shares of the mean extent M
  std::size_t triangles = 50, runs = 3;
};

// The mean of the samples in each cell of a grid, in the order of the cells.
Points thinned(const bunny::Mesh& mesh, double cell)
{
  std::map<std::array<std::int64_t, 3>, std::pair<Vector3d, double>> cells;
  for (const auto& p : mesh.points()) {
    const auto index = [&](double x) { return std::int64_t(std::floor(x / cell)); };
    auto& sum = cells.try_emplace({index(p.x()), index(p.y()), index(p.z())}, Vector3d::Zero(), 0.).first->second;
    sum.first += Vector3d(p.x(), p.y(), p.z());
    sum.second += 1;
  }
  Points points;
  for (const auto& c : cells) points.push_back(c.second.first / c.second.second);
  return points;
}

// Whether there is a point within a distance of a place, for places rounded to an eighth of the distance.
class Neighborhood
{
public:
  Neighborhood(const Points& points, double distance) : m_cell(distance / 4)
  {
    m_low = m_high = points.front();
    for (const Vector3d& p : points) {
      m_low = m_low.cwiseMin(p);
      m_high = m_high.cwiseMax(p);
    }
    m_low -= Vector3d::Constant(distance + m_cell);
    const Vector3d size = (m_high - m_low) / m_cell + Vector3d::Constant(distance / m_cell + 2);
    for (std::size_t i = 0; i < 3; ++i) m_size[i] = std::int64_t(size[Eigen::Index(i)]) + 1;
    m_is_near.resize(std::size_t(m_size[0] * m_size[1] * m_size[2]));
    const auto reach = std::int64_t(std::ceil(distance / m_cell));
    for (const Vector3d& p : points) {
      const Vector3d q = (p - m_low) / m_cell;
      const std::array<std::int64_t, 3> c = {std::int64_t(q.x()), std::int64_t(q.y()), std::int64_t(q.z())};
      for (std::int64_t x = c[0] - reach; x <= c[0] + reach; ++x)
        for (std::int64_t y = c[1] - reach; y <= c[1] + reach; ++y)
          for (std::int64_t z = c[2] - reach; z <= c[2] + reach; ++z)
            if ((Vector3d(double(x), double(y), double(z)) + Vector3d::Constant(0.5) - q).norm() * m_cell <= distance)
              m_is_near[index(x, y, z)] = true;
    }
  }

  bool has(const Vector3d& p) const
  {
    const Vector3d q = (p - m_low) / m_cell;
    if (q.minCoeff() < 0) return false;
    const auto x = std::int64_t(q.x()), y = std::int64_t(q.y()), z = std::int64_t(q.z());
    return x < m_size[0] && y < m_size[1] && z < m_size[2] && m_is_near[index(x, y, z)];
  }

private:
  std::size_t index(std::int64_t x, std::int64_t y, std::int64_t z) const
  {
    return std::size_t((x * m_size[1] + y) * m_size[2] + z);
  }

  double m_cell;
  Vector3d m_low, m_high;
  std::array<std::int64_t, 3> m_size;
  std::vector<bool> m_is_near;
};

using Triangle = std::array<Vector3d, 3>;

// A frame in the plane of a triangle: the first side is its x axis.
Motion frame(const Triangle& t)
{
  Eigen::Matrix3d axes;
  axes.col(0) = (t[1] - t[0]).normalized();
  axes.col(2) = axes.col(0).cross(t[2] - t[0]).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  Motion m = Motion::Identity();
  m.linear() = axes;
  m.translation() = t[0];
  return m;
}

// std::shuffle and the distributions differ from library to library.
std::size_t below(std::mt19937_64& random, std::size_t n)
{
  return std::size_t(random() % n);
}

struct Found
{
  Motion motion = Motion::Identity();
  std::size_t overlap = 0, motions = 0; // points taken to the target; motions tried
};

class Darces
{
public:
  Darces(Points source, Points target, double cell, double shortest, double longest, double tolerance,
         std::mt19937_64& random)
      : m_source(std::move(source)), m_target(std::move(target)), m_near(m_target, tolerance * cell),
        m_tolerance(tolerance * cell), m_shortest(shortest), m_longest(longest), m_random(random)
  {
    for (std::size_t i = m_source.size(); i > 1; --i) std::swap(m_source[i - 1], m_source[below(m_random, i)]);
  }

  Found run(std::size_t triangles)
  {
    for (std::size_t i = 0; i < triangles; ++i) look_for(random_triangle());
    return m_found;
  }

private:
  bool is_side(double length) const { return length >= m_shortest && length <= m_longest; }

  Triangle random_triangle()
  {
    constexpr std::size_t most_attempts = 1000000;
    for (std::size_t i = 0; i < most_attempts; ++i) {
      const auto point = [&] { return m_source[below(m_random, m_source.size())]; };
      const Triangle t = {point(), point(), point()};
      const Vector3d a = t[1] - t[0], b = t[2] - t[0];
      if (!is_side(a.norm()) || !is_side(b.norm()) || !is_side((t[2] - t[1]).norm())) continue;
      // The third point far enough from the line for the circle to mean something.
      if (a.cross(b).norm() > 0.5 * m_shortest * a.norm()) return t;
    }
    throw std::runtime_error("the source has no triangle with sides of these lengths");
  }

  void look_for(const Triangle& t)
  {
    const Vector3d side = t[1] - t[0];
    const double length = side.norm(), foot = side.dot(t[2] - t[0]) / length;
    const double height = (t[2] - t[0] - foot / length * side).norm(), reach = std::hypot(foot, height) + m_tolerance;
    const Motion source_frame_inverse = frame(t).inverse();
    std::vector<std::size_t> second, third;
    for (const Vector3d& p : m_target) {
      second.clear();
      third.clear();
      for (std::size_t i = 0; i < m_target.size(); ++i) {
        const double distance = (m_target[i] - p).norm();
        if (std::abs(distance - length) <= m_tolerance) second.push_back(i);
        if (distance <= reach) third.push_back(i);
      }
      for (std::size_t s : second) {
        const Vector3d line = (m_target[s] - p).normalized();
        for (std::size_t a : third) {
          const Vector3d to = m_target[a] - p;
          const double x = line.dot(to), y = (to - x * line).norm();
          if (std::hypot(x - foot, y - height) > m_tolerance) continue;
          verify(frame({p, m_target[s], m_target[a]}) * source_frame_inverse);
        }
      }
    }
  }

  // As long as the motion can still be the best one: after the first points their share has to be half of the best.
  void verify(const Motion& motion)
  {
    ++m_found.motions;
    constexpr std::size_t first_points = 40;
    std::size_t overlap = 0;
    for (std::size_t i = 0; i < m_source.size(); ++i) {
      overlap += m_near.has(motion * m_source[i]);
      if (overlap + (m_source.size() - i - 1) <= m_found.overlap) return;
      if (i == first_points && 2 * overlap * m_source.size() < first_points * m_found.overlap) return;
    }
    m_found.overlap = overlap;
    m_found.motion = motion;
  }

  Points m_source, m_target;
  Neighborhood m_near;
  double m_tolerance, m_shortest, m_longest;
  std::mt19937_64& m_random;
  Found m_found;
};

// The size of the cells that leave about so many points of a surface: their number goes with one over the square of it.
double cell_size(const bunny::Dense_scan& scan, double points)
{
  double cell = CR::scan_extent(scan.image).mean() / 30;
  for (int i = 0; i < 3; ++i) cell *= std::sqrt(double(thinned(scan.mesh, cell).size()) / points);
  return cell;
}

Rival_answer register_by_darces(const bunny::Dense_scan& source, const bunny::Dense_scan& target,
                                const bunny::Transformation& truth, const Options& options, std::mt19937_64& random)
{
  Rival_answer answer;
  const double start = benchmark_tools::cpu_seconds();
  const double cell = cell_size(source, options.points), m = CR::scan_extent(source.image).mean();
  Points points = thinned(source.mesh, cell);
  const auto number = double(points.size());
  Darces darces(std::move(points), thinned(target.mesh, cell), cell, options.shortest * m, options.longest * m,
                options.tolerance, random);
  const Found found = darces.run(options.triangles);
  answer.seconds = benchmark_tools::cpu_seconds() - start;
  answer.motions = found.motions;
  answer.overlap = double(found.overlap) / number;
  const Motion& motion = found.motion;
  const auto crude = benchmark_tools::to_motion<bunny::Kernel>(motion.linear(), Vector3d(motion.translation()));
  answer.judge(source, target, crude, truth);
  return answer;
}

void run(const std::string& folder, const Options& options)
{
  if (!(options.points >= 10 && options.tolerance > 0 && options.shortest > 0 && options.shortest < options.longest))
    throw std::invalid_argument("--points has to be 10 or more, the others above zero, --shortest below --longest");
  std::size_t right = 0;
  const double reference = benchmark_tools::for_each_of_the_papers_pairs(
      folder,
      [&](const bunny::Dense_scan& source, const bunny::Dense_scan& target, const auto& truth, const auto& print) {
        for (std::size_t k = 0; k < options.runs; ++k) {
          std::mt19937_64 random(k + 1);
          const Rival_answer answer = register_by_darces(source, target, truth, options, random);
          right += answer.is_right;
          print("DARCES, seed " + std::to_string(k + 1), answer);
        }
      });
  benchmark_tools::print_summary("DARCES is right in ", right, std::to_string(4 * options.runs) + " runs", reference);
}

} // namespace

int main(int argc, char* argv[])
{
  Options options;
  const auto add_options = [&](po::options_description& description) {
    description.add_options()("points", po::value(&options.points)->default_value(options.points),
                              "points that the source is thinned to, about; the target is as dense");
    description.add_options()("triangles", po::value(&options.triangles)->default_value(options.triangles),
                              "random triangles of a run");
    description.add_options()("runs", po::value(&options.runs)->default_value(options.runs), "runs, a seed each");
    description.add_options()("tolerance", po::value(&options.tolerance)->default_value(options.tolerance),
                              "of lengths and of points that correspond, in cells of the thinning");
    description.add_options()("shortest", po::value(&options.shortest)->default_value(options.shortest),
                              "shortest side of a triangle, in shares of M");
    description.add_options()("longest", po::value(&options.longest)->default_value(options.longest),
                              "longest side of a triangle");
  };
  return benchmark_tools::rival_program(
      argc, argv, "rival_darces", "DARCES, whose triangles are\nof points without description, and by this package.",
      add_options, [&](const std::string& folder) { run(folder, options); });
}
