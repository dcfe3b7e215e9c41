// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CRUDE_REGISTER_COMMANDS_H
#define CRUDE_REGISTER_COMMANDS_H

// The commands, one a file: each is given the arguments after its name, and returns the exit code.

#include <string>
#include <vector>

enum Exit_code
{
  EXIT_REGISTERED = 0,
  EXIT_ERROR = 1,
  EXIT_AMBIGUOUS = 2,
  EXIT_NOT_REGISTERED = 3,
  EXIT_INTERRUPTED = 130 // as of shells: 128 and the number of SIGINT
};

int run_register(const std::vector<std::string>& arguments);
int run_judge(const std::vector<std::string>& arguments);
int run_assemble(const std::vector<std::string>& arguments);
int run_info(const std::vector<std::string>& arguments);
int run_convert(const std::vector<std::string>& arguments);
int run_simulate(const std::vector<std::string>& arguments);

#endif // CRUDE_REGISTER_COMMANDS_H
