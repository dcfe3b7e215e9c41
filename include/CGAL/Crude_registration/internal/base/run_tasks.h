// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Author(s)     : The Crude_registration authors

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_RUN_TASKS_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_RUN_TASKS_H

// Tasks that are independent of each other, may fail, and end when the run ends.

#include <CGAL/Crude_registration/internal/base/Run_control.h>
#include <CGAL/Crude_registration/internal/base/for_each_index.h>

#include <cstddef>
#include <exception>
#include <limits>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// f(k, control) for the tasks 0 .. n-1; of several failures the first is thrown. False where the run was stopped.
template <class Function>
bool run_tasks(std::size_t n, Execution execution, Run_control& control, const Function& f)
{
  std::vector<std::exception_ptr> failures(n);
  for_each_index(execution, n, control, [&](std::size_t k) {
    try {
      // A task's own control: it is asked by the thread that made it.
      Run_control own([&control](double) { return control.go_on(); }, (std::numeric_limits<double>::infinity)());
      f(k, own);
    } catch (...) {
      failures[k] = std::current_exception();
    }
  });
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
  return !control.is_stopped();
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_BASE_RUN_TASKS_H
