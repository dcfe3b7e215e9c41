// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// The command line: registers scans, puts many together, says what is in one, and simulates some.

#include "commands.h"
#include "options.h"
#include "progress.h"

#include <exception>
#include <iostream>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

const char* const usage =
    R"(usage: crude_register register SOURCE TARGET [OPTION...]   find the motion that maps SOURCE onto TARGET
       crude_register judge SOURCE TARGET --motion FILE    say of a motion that somebody found whether it is right
       crude_register assemble SCAN... [OPTION...]         put many scans together: a pose for each
       crude_register info SCAN [OPTION...]                say what is in a scan, and what the method makes of it
       crude_register simulate --output DIR [OPTION...]    write range scans of a generated body, with their poses
       crude_register COMMAND --help                       the options of a command

SOURCE, TARGET and SCAN are range images (PLY with a range_grid, PTX, organised PCD, depth images in PNG), meshes (PLY, OFF,
OBJ, STL) or points (text, PLY, PCD, NPY, LAS). FILE.ptx#2 is the second scan of a PTX file.
)";

int run(const std::vector<std::string>& arguments)
{
  if (arguments.empty()) throw Usage_error("no command is given");
  const std::string& command = arguments.front();
  const std::vector<std::string> rest(arguments.begin() + 1, arguments.end());
  if (command == "register") return run_register(rest);
  if (command == "judge") return run_judge(rest);
  if (command == "assemble") return run_assemble(rest);
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
    return is_interrupted() ? int(EXIT_INTERRUPTED) : code;
  } catch (const Usage_error& e) {
    std::cerr << "crude_register: " << e.what() << "; see crude_register --help\n";
  } catch (const std::bad_alloc&) {
    std::cerr << "crude_register: out of memory\n";
  } catch (const std::exception& e) {
    std::cerr << "crude_register: " << e.what() << '\n';
  }
  return is_interrupted() ? EXIT_INTERRUPTED : EXIT_ERROR;
}
