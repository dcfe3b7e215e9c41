// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CRUDE_REGISTER_PROGRESS_H
#define CRUDE_REGISTER_PROGRESS_H

// What a run shows of itself on a terminal, and how Ctrl-C ends it.

#include "run_limits.h"

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <locale>
#include <mutex>
#include <sstream>
#include <string>

#include <signal.h>
#include <unistd.h>

namespace interruption {

// What a handler of signals may write.
inline std::atomic<bool> has_come{false};
static_assert(std::atomic<bool>::is_always_lock_free);

extern "C" inline void handle_interruption(int)
{
  has_come = true;
}

} // namespace interruption

// Whether the user has pressed Ctrl-C.
inline bool is_interrupted()
{
  return interruption::has_come;
}

// From here on the first Ctrl-C asks the run to end; a second one ends the program at once.
inline void watch_for_interruption()
{
  struct sigaction action = {};
  sigaction(SIGINT, nullptr, &action);
  if (action.sa_handler == SIG_IGN) return; // as of a shell's job in the background
  action = {};
  action.sa_handler = &interruption::handle_interruption;
  sigemptyset(&action.sa_mask);
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
}

// A line on the terminal that says the stage and the time left; nothing where the errors do not go to a terminal.
class Progress
{
public:
  Progress()
  {
    const char* const terminal = std::getenv("TERM");
    m_is_shown = isatty(STDERR_FILENO) == 1 && terminal != nullptr && std::string(terminal) != "dumb";
  }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress() { clear(); }

  void begin_stage(const std::string& name)
  {
    if (!m_is_shown) return;
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_stage = name;
    m_start = Clock::now();
    m_share = 0;
    show();
  }

  // Of the stage, what is done at most; zero if that is not known. Any thread may call it.
  void set_share(double share)
  {
    if (!m_is_shown) return;
    constexpr double shortest_time = 0.1; // between two lines, in seconds
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_share = share;
    if (seconds_since(m_shown) >= shortest_time) show();
  }

  // Before anything else is written.
  void clear()
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    if (m_is_shown && !m_line.empty()) std::cerr << start_of_line << std::flush;
    m_line.clear();
  }

private:
  static constexpr const char* start_of_line = "\r\x1b[K"; // and the line erased

  void show()
  {
    const double elapsed = seconds_since(m_start);
    std::ostringstream line;
    line.imbue(std::locale::classic());
    line << m_stage;
    if (m_share > 0) line << ", " << std::lround(100 * m_share) << " %";
    if (elapsed >= 1) line << ", " << std::lround(elapsed) << " s";
    if (elapsed >= 1 && m_share > 0 && m_share < 1)
      line << ", at most " << std::lround(std::ceil(elapsed * (1 - m_share) / m_share)) << " s left";
    if (is_interrupted()) line << "; ending with what there is (Ctrl-C again: at once)";
    m_shown = Clock::now();
    if (line.str() == m_line) return;
    m_line = line.str();
    std::cerr << start_of_line << m_line << std::flush;
  }

  bool m_is_shown = false;
  std::mutex m_mutex;
  std::string m_stage, m_line;
  Clock::time_point m_start, m_shown;
  double m_share = 0;
};

// A model of RegistrationVisitor: ends the run at Ctrl-C.
struct Interruption_visitor
{
  void progress(double) {}
  bool go_further() { return !is_interrupted(); }
};

// A model of RegistrationVisitor: shows how far the run is, and ends it at Ctrl-C.
class Terminal_visitor
{
public:
  explicit Terminal_visitor(Progress& progress) : m_progress(&progress) {}

  void progress(double share) { m_progress->set_share(share); }
  bool go_further() { return !is_interrupted(); }

private:
  Progress* m_progress;
};

#endif // CRUDE_REGISTER_PROGRESS_H
