// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// How long a run goes on after its end was asked for: the longest time between two looks at its visitor.

#include "command_line.h"
#include "generated_scan.h"

#include <CGAL/Crude_registration/register_scans.h>
#include <CGAL/Crude_registration/sampling/triangulate_range_image.h>

#include <boost/program_options.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <functional>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

namespace CR = CGAL::Crude_registration;
namespace p = CGAL::Crude_registration::parameters;
namespace po = boost::program_options;
using benchmark_tools::Generated_scene;
using Kernel = Generated_scene::Kernel;
using Mesh = Generated_scene::Mesh;

namespace {

using Clock = std::chrono::steady_clock;

double seconds_between(Clock::time_point a, Clock::time_point b)
{
  return std::chrono::duration<double>(b - a).count();
}

// The visitor of a run, from its beginning to its end.
class Stop_watch
{
public:
  void progress(double) {}
  bool go_further()
  {
    look();
    return true;
  }
  void look()
  {
    const Clock::time_point now = Clock::now();
    m_longest = (std::max)(m_longest, seconds_between(m_last, now));
    m_last = now;
  }
  double longest() const { return m_longest; }
  double whole() const { return seconds_between(m_start, m_last); }

private:
  Clock::time_point m_start = Clock::now(), m_last = m_start;
  double m_longest = 0;
};

template <class Function>
void measure(const std::string& what, std::size_t samples, const Function& run)
{
  Stop_watch watch;
  run(p::visitor(std::ref(watch)));
  watch.look();
  std::ostringstream line;
  line << std::left << std::setw(34) << what << std::right << std::setw(9) << samples << std::fixed
       << std::setprecision(3) << std::setw(10) << watch.whole() << std::setw(10) << watch.longest();
  std::cout << line.str() << std::endl;
}

void measure_size(const Generated_scene& scene, std::size_t size)
{
  const auto image = scene.scan(size, 0, 1).image, behind = scene.scan(size, CGAL_PI, 2).image;
  const auto& points = image.points();
  const auto preparation = [&](const char* what, const auto& input, const auto& add_sensor) {
    measure(what, points.size(), [&](const auto& np) { CR::Scan<Kernel>(input, add_sensor(np)); });
  };
  const auto nothing = [](const auto& np) { return np; };
  const auto direction = [](const auto& np) { return np.viewing_direction(Kernel::Vector_3(0, 0, -1)); };
  CR::Range_image<Kernel> plain = image;
  plain.set_sensor(CR::Sensor<Kernel>());
  preparation("range image", image, nothing);
  preparation("range image, sensor unknown", plain, nothing);
  Mesh mesh;
  CR::triangulate_range_image(image, mesh);
  preparation("mesh", mesh, nothing);
  preparation("points, sensor known", points, direction);
  preparation("points, sensor unknown", points, nothing);
  const CR::Scan<Kernel> source(image), target(behind);
  measure("registration, hardly any overlap", points.size(),
          [&](const auto& np) { CR::register_scans(source, target, np); });
}

} // namespace

int main(int argc, char* argv[])
{
  try {
    std::vector<std::size_t> sizes = {100000, 1000000, 5000000};
    po::options_description description("Usage: interruption [OPTION...]\n\n"
                                        "How long a run goes on after its end was asked for: the longest time between\n"
                                        "two looks at its visitor, in generated scans.\n\n"
                                        "Options");
    description.add_options()("help,h", "print this");
    description.add_options()("samples", po::value(&sizes)->multitoken(), "numbers of samples; default: up to 5000000");
    po::variables_map values;
    if (!benchmark_tools::read_options(argc, argv, description, values)) return EXIT_SUCCESS;
    std::cout << "seconds (of the clock): of the whole run, and the longest between two looks at the visitor\n"
              << "what                                samples     whole   longest\n";
    const Generated_scene scene(200);
    for (const std::size_t size : sizes) measure_size(scene, size);
    return EXIT_SUCCESS;
  } catch (const std::exception& e) {
    std::cerr << "interruption: " << e.what() << '\n';
    return EXIT_FAILURE;
  }
}
