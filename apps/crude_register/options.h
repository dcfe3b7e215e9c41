// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CRUDE_REGISTER_OPTIONS_H
#define CRUDE_REGISTER_OPTIONS_H

// The arguments of a command.

#include "descriptions.h"

#include <CGAL/Crude_registration/named_parameters.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <boost/program_options.hpp>

#include <cmath>
#include <cstddef>
#include <iostream>
#include <locale>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace CR = CGAL::Crude_registration;
namespace po = boost::program_options;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;

// Wrong arguments on the command line.
struct Usage_error : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

// The arguments of a command, or nothing if they asked for help or for another text about the command, which is
// written. `rest`: the name of what may be given any number of times, at least once, after the others.
inline std::optional<po::variables_map> parse(const Command& command, const po::options_description& options,
                                              const std::vector<std::string>& positional,
                                              const std::vector<std::string>& arguments, const std::string& rest = "")
{
  if (arguments.size() == 1 && write_description(std::cout, arguments[0], command, options)) return std::nullopt;
  po::options_description all;
  all.add(options).add_options()("help,h", "");
  po::positional_options_description places;
  for (const std::string& name : positional) {
    all.add_options()(name.c_str(), po::value<std::string>());
    places.add(name.c_str(), 1);
  }
  if (!rest.empty()) {
    all.add_options()(rest.c_str(), po::value<std::vector<std::string>>());
    places.add(rest.c_str(), -1);
  }
  po::variables_map map;
  try {
    po::store(po::command_line_parser(arguments).options(all).positional(places).run(), map);
    if (map.count("help") > 0) {
      write_help(std::cout, command, options);
      return std::nullopt;
    }
    po::notify(map);
  } catch (const po::error& e) {
    throw Usage_error(e.what());
  }
  for (const std::string& name : positional)
    if (map.count(name) == 0) throw Usage_error("no " + name + " is given");
  if (!rest.empty() && map.count(rest) == 0) throw Usage_error("no " + rest + " is given");
  return map;
}

// The value of an option, if it is given.
template <class T>
std::optional<T> value_of(const po::variables_map& map, const char* option)
{
  if (map.count(option) == 0) return std::nullopt;
  return map[option].as<T>();
}

// The numbers between commas in the value of an option; `form` says what it takes.
inline std::vector<double> numbers_of(const std::string& option, const std::string& text, std::size_t count,
                                      const std::string& form)
{
  const Usage_error error("--" + option + " takes " + form + ", not '" + text + "'");
  std::istringstream in(text);
  in.imbue(std::locale::classic());
  std::vector<double> numbers(count);
  for (std::size_t i = 0; i < count; ++i) {
    char comma = ',';
    if (i > 0) in >> comma;
    if (comma != ',' || !(in >> numbers[i]) || !std::isfinite(numbers[i])) throw error;
  }
  if (in >> std::ws; !in.eof()) throw error;
  return numbers;
}

inline std::optional<Point> point_of(const po::variables_map& map, const std::string& option)
{
  const std::optional<std::string> text = value_of<std::string>(map, option.c_str());
  if (!text) return std::nullopt;
  const std::vector<double> c = numbers_of(option, *text, 3, "three numbers x,y,z");
  return Point(c[0], c[1], c[2]);
}

// Calls f with the named parameters that say where the sensor was, if it is known.
template <class Function>
auto with_viewpoint(const std::optional<Point>& viewpoint, const Function& f)
{
  return viewpoint ? f(CR::parameters::viewpoint(*viewpoint)) : f(CR::parameters::default_values());
}

#endif // CRUDE_REGISTER_OPTIONS_H
