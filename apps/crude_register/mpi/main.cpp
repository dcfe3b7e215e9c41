// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// crude_register_mpi: the command assemble by the processes of an MPI run. The first one plans; the others pull tasks.

#include "../commands.h"
#include "../options.h"
#include "../workers.h"

#include <boost/mpi/communicator.hpp>
#include <boost/mpi/environment.hpp>

#include <chrono>
#include <cstddef>
#include <exception>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace {

namespace mpi = boost::mpi;

class Mpi_workers : public Workers
{
public:
  explicit Mpi_workers(const mpi::communicator& world) : m_world(world)
  {
    if (is_planner())
      for (int rank = 1; rank < world.size(); ++rank) m_idle.insert(rank);
  }

  // Lets the others end, whatever became of the run.
  ~Mpi_workers() override
  {
    if (!is_planner()) return;
    try {
      while (!m_busy.empty()) receive(wait([] { return true; }));
      for (const int rank : m_idle) m_world.send(rank, STOP);
    } catch (...) {
      mpi::environment::abort(EXIT_ERROR);
    }
  }

  bool is_planner() const override { return m_world.rank() == 0; }

  void serve(const Assembly_tasks& tasks) override
  {
    for (;;) {
      const mpi::status message = *wait([] { return true; });
      if (message.tag() == STOP) {
        m_world.recv(0, STOP);
        return;
      }
      std::string text;
      m_world.recv(0, message.tag(), text);
      if (message.tag() == SCAN) {
        tasks.take(text);
        continue;
      }
      try {
        m_world.send(0, DONE, done(tasks, text));
      } catch (const mpi::exception&) {
        throw;
      } catch (const std::exception& e) {
        m_world.send(0, FAILED, std::string(e.what()));
      }
    }
  }

  std::vector<std::string> answers(const std::vector<std::string>& tasks, const std::function<bool()>& go_on) override
  {
    std::vector<std::string> answers(tasks.size());
    std::optional<std::size_t> failed;
    std::string failure;
    std::size_t next = 0;
    while (next < tasks.size() || !m_busy.empty()) {
      // In their order: those before the first that fails are all begun before it is known.
      while (next < tasks.size() && !m_idle.empty() && !failed && go_on()) {
        const int rank = *m_idle.begin();
        m_idle.erase(m_idle.begin());
        m_busy[rank] = next;
        m_world.send(rank, TASK, tasks[next++]);
      }
      if (m_busy.empty()) break;
      const auto message = wait([&] {
        go_on();
        return true; // what was begun is waited for
      });
      const std::size_t task = m_busy.at(message->source());
      const bool is_done = message->tag() == DONE;
      std::string text = receive(message);
      if (is_done) answers[task] = std::move(text);
      else if (!failed || task < *failed) {
        failed = task;
        failure = text;
      }
    }
    if (failed) throw std::runtime_error(failure);
    return answers;
  }

  void give(const std::vector<std::string>& scans) override
  {
    for (const int rank : m_idle)
      for (const std::string& bytes : scans) m_world.send(rank, SCAN, bytes);
  }

private:
  enum Tag
  {
    TASK,
    SCAN,
    DONE,
    FAILED,
    STOP
  };

  // The next message, once it is there. (MPI's own wait takes all of a processor, which a worker may have use for.)
  template <class Look>
  std::optional<mpi::status> wait(const Look& look) const
  {
    constexpr auto pause = std::chrono::microseconds(200);
    while (look()) {
      if (const auto message = m_world.iprobe(mpi::any_source, mpi::any_tag)) return *message;
      std::this_thread::sleep_for(pause);
    }
    return std::nullopt;
  }

  // The text of an answer; who has sent it is idle then.
  std::string receive(const std::optional<mpi::status>& message)
  {
    std::string text;
    m_world.recv(message->source(), message->tag(), text);
    m_busy.erase(message->source());
    m_idle.insert(message->source());
    return text;
  }

  static std::string done(const Assembly_tasks& tasks, const std::string& task)
  {
    std::istringstream words(task);
    std::string what;
    std::size_t first = 0, second = 0;
    words >> what >> first;
    if (what == "prepare") return tasks.prepare(first);
    words >> second;
    return tasks.register_pair(first, second);
  }

  mpi::communicator m_world;
  std::set<int> m_idle;
  std::map<int, std::size_t> m_busy; // with which task
};

} // namespace

int main(int argc, char** argv)
{
  mpi::environment environment(argc, argv, mpi::threading::funneled); // the first process has other threads
  const mpi::communicator world;
  const bool is_first = world.rank() == 0;
  if (!is_first) std::cout.rdbuf(nullptr); // what is to be said is said once
  try {
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    if (arguments.empty() || arguments.front() != "assemble")
      throw Usage_error("the only command is assemble: mpirun -n N crude_register_mpi assemble SCAN...");
    Mpi_workers workers(world);
    const std::vector<std::string> rest(arguments.begin() + 1, arguments.end());
    const int code = world.size() > 1 ? run_assemble_by(workers, rest) : run_assemble(rest);
    std::cout.flush();
    if (is_first && !std::cout) throw std::runtime_error("the output cannot be written");
    return is_first ? code : 0;
  } catch (const std::bad_alloc&) {
    std::cerr << "crude_register_mpi: out of memory\n";
    environment.abort(EXIT_ERROR); // the others may wait for an answer
  } catch (const mpi::exception& e) {
    std::cerr << "crude_register_mpi: process " << world.rank() << ": " << e.what() << '\n';
    environment.abort(EXIT_ERROR);
  } catch (const std::exception& e) {
    if (is_first) std::cerr << "crude_register_mpi: " << e.what() << '\n';
  }
  return EXIT_ERROR;
}
