// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// What the outputs of `crude_register register` cost, beside the same command without them.

#include "command_line.h"

#include <boost/program_options.hpp>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace fs = std::filesystem;
namespace po = boost::program_options;

namespace {

using Words = std::vector<std::string>;

struct Seconds
{
  double of_clock, of_processors;
};

double seconds_of(const timeval& time)
{
  return double(time.tv_sec) + 1e-6 * double(time.tv_usec);
}

// A run of a program, of which nothing is printed. \throws std::runtime_error where it does not do what it is to
Seconds run(const Words& command)
{
  std::vector<char*> words;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  const auto start = std::chrono::steady_clock::now();
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error(std::string("fork: ") + std::strerror(errno));
  if (child == 0) {
    const int nowhere = ::open("/dev/null", O_WRONLY);
    if (nowhere >= 0) ::dup2(nowhere, STDOUT_FILENO);
    ::execvp(words[0], words.data());
    ::_exit(127);
  }
  int status = 0;
  rusage usage = {};
  if (::wait4(child, &status, 0, &usage) != child) throw std::runtime_error("wait4 finds no such process");
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw std::runtime_error(command[0] + " " + command[1] + " does not end with 0");
  return {seconds, seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime)};
}

double median(std::vector<double> values)
{
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

struct Variant
{
  std::string name;
  Words options;
  std::vector<double> of_clock = {}, of_processors = {};
};

void measure(const Words& command, std::vector<Variant>& variants, std::size_t runs)
{
  for (std::size_t i = 0; i < runs; ++i) {
    std::vector<Variant*> order; // and back, so that what changes by and by is in all of them
    for (Variant& v : variants) order.push_back(&v);
    if (i % 2 == 1) std::reverse(order.begin(), order.end());
    for (Variant* const v : order) {
      Words words = command;
      words.insert(words.end(), v->options.begin(), v->options.end());
      const Seconds seconds = run(words);
      v->of_clock.push_back(seconds.of_clock);
      v->of_processors.push_back(seconds.of_processors);
    }
  }
}

void print(const std::vector<Variant>& variants)
{
  std::cout << "medians: milliseconds of the clock, of the processors, and how many times those without outputs\n"
            << "outputs         clock  processors    clock  processors\n";
  const double clock = median(variants.front().of_clock), processors = median(variants.front().of_processors);
  for (const Variant& v : variants) {
    std::ostringstream line;
    const double c = median(v.of_clock), p = median(v.of_processors);
    line << std::left << std::setw(12) << v.name << std::right << std::fixed << std::setprecision(1) << std::setw(9)
         << 1e3 * c << std::setw(12) << 1e3 * p << std::setprecision(2) << std::setw(9) << c / clock << std::setw(12)
         << p / processors;
    std::cout << line.str() << '\n';
  }
}

} // namespace

int main(int argc, char* argv[])
{
  try {
    std::size_t runs = 20;
    Words scans;
    po::options_description description("Usage: command_outputs [SOURCE TARGET] [OPTION...]\n\n"
                                        "What the outputs of `crude_register register` cost, beside the same command\n"
                                        "without them, alternating; of two simulated scans if none are given.\n\n"
                                        "Options");
    description.add_options()("help,h", "print this");
    std::string program = (fs::path(argv[0]).parent_path() / "crude_register").string();
    description.add_options()("program", po::value(&program), "the program; default: crude_register beside this one");
    description.add_options()("runs", po::value(&runs), "of each; default: 20");
    po::options_description hidden;
    hidden.add_options()("scans", po::value(&scans));
    po::variables_map values;
    if (!benchmark_tools::read_options(argc, argv, description, values, hidden, "scans", 2)) return EXIT_SUCCESS;
    if (runs == 0 || scans.size() == 1) throw std::invalid_argument("two scans are needed, and a run");
    std::string name = (fs::temp_directory_path() / "command_outputs_XXXXXX").string();
    if (::mkdtemp(&name[0]) == nullptr) throw std::runtime_error(std::string("mkdtemp: ") + std::strerror(errno));
    const fs::path folder = name;
    if (scans.empty()) {
      run({program, "simulate", "--output", (folder / "scans").string()});
      for (const char* file : {"scan_0.ply", "scan_1.ply"}) scans.push_back((folder / "scans" / file).string());
    }
    const Words output = {"--output", (folder / "output").string()},
                report = {"--report", (folder / "report.html").string()},
                picture = {"--picture", (folder / "picture.png").string()};
    Words all = output;
    all.insert(all.end(), report.begin(), report.end());
    all.insert(all.end(), picture.begin(), picture.end());
    std::vector<Variant> variants = {
        {"none", {}}, {"--output", output}, {"--report", report}, {"--picture", picture}, {"all", all}};
    measure({program, "register", scans[0], scans[1]}, variants, runs);
    print(variants);
    fs::remove_all(folder);
  } catch (const std::exception& e) {
    std::cerr << "command_outputs: " << e.what() << '\n';
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
