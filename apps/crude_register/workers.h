// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CRUDE_REGISTER_WORKERS_H
#define CRUDE_REGISTER_WORKERS_H

// The processes of a run that do the tasks of an assembly, as the command assemble sees them.

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

// What a process does of an assembly, each a function of numbers and bytes.
struct Assembly_tasks
{
  std::function<std::string(std::size_t scan)> prepare;                             // the bytes of a prepared scan
  std::function<void(const std::string& bytes)> take;                               // the scans, in their order
  std::function<std::string(std::size_t source, std::size_t target)> register_pair; // the bytes of an answer
};

// One process plans; the others do what it gives them, until it ends.
class Workers
{
public:
  Workers() = default;
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;
  virtual ~Workers() = default;

  virtual bool is_planner() const = 0;

  // Of a process that does not plan: returns when there is nothing more to do.
  virtual void serve(const Assembly_tasks& tasks) = 0;

  // The answers of tasks, in their order, whichever process does them; of several failures the first is thrown. Fewer
  // answers where the run was stopped: `go_on()`, which is asked now and then, says no from then on. `tasks`: the words
  // that serve() understands.
  virtual std::vector<std::string> answers(const std::vector<std::string>& tasks,
                                           const std::function<bool()>& go_on) = 0;

  // All others take the scans.
  virtual void give(const std::vector<std::string>& scans) = 0;
};

// The command assemble by the processes of a run.
int run_assemble_by(Workers& workers, const std::vector<std::string>& arguments);

#endif // CRUDE_REGISTER_WORKERS_H
