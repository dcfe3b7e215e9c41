// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_BENCHMARK_CHILD_PROCESS_H
#define CGAL_CRUDE_REGISTRATION_BENCHMARK_CHILD_PROCESS_H

// Functions run in a process of their own, so that the most memory each has is known (POSIX, with Linux' /proc).

#include "reference_time.h"

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>
#include <type_traits>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace benchmark_tools {

// The memory that this process has now, in bytes.
inline double resident_bytes()
{
  std::ifstream statm("/proc/self/statm");
  double size = 0, resident = 0;
  statm >> size >> resident;
  return resident * double(sysconf(_SC_PAGESIZE));
}

// A file descriptor that is closed in the end.
class Descriptor
{
public:
  explicit Descriptor(int number) : m_number(number) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  void close()
  {
    if (m_number >= 0) ::close(m_number);
    m_number = -1;
  }

  void write(const char* data, std::size_t size) const
  {
    while (size > 0) {
      const ssize_t n = ::write(m_number, data, size);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) return;
      data += n;
      size -= std::size_t(n);
    }
  }

  // up to the end
  std::string read() const
  {
    std::string text;
    char buffer[4096];
    for (;;) {
      const ssize_t n = ::read(m_number, buffer, sizeof buffer);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) return text;
      text.append(buffer, std::size_t(n));
    }
  }

private:
  int m_number;
};

template <class Value>
struct From_child
{
  Value value;
  double peak_bytes; // the most memory that the process had, with what it took over from this one
};

// f() in a child process, which has all that this process has in its memory. Throws std::runtime_error with the text of
// what f throws, or if the child does not come to its end. \pre This process has one thread.
template <class Function>
auto in_child_process(Function f) -> From_child<decltype(f())>
{
  using Value = decltype(f());
  static_assert(std::is_trivially_copyable<Value>::value, "it is handed over as bytes");
  int ends[2];
  if (::pipe(ends) != 0) throw std::runtime_error(std::string("pipe: ") + std::strerror(errno));
  Descriptor reading(ends[0]), writing(ends[1]);
  std::fflush(nullptr); // or the child writes it once more
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error(std::string("fork: ") + std::strerror(errno));
  if (child == 0) {
    std::string answer(1, 'E');
    try {
      const Value value = f();
      answer[0] = 'V';
      answer.append(reinterpret_cast<const char*>(&value), sizeof value);
    } catch (const std::exception& e) {
      answer += e.what();
    } catch (...) {
      answer += "an exception without a text";
    }
    writing.write(answer.data(), answer.size());
    std::fflush(nullptr);
    ::_exit(0);
  }
  writing.close();
  const std::string answer = reading.read();
  int status = 0;
  struct rusage usage = {};
  while (::wait4(child, &status, 0, &usage) < 0)
    if (errno != EINTR) throw std::runtime_error(std::string("wait4: ") + std::strerror(errno));
  if (WIFSIGNALED(status))
    throw std::runtime_error("a child process was ended by signal " + std::to_string(WTERMSIG(status)));
  if (!answer.empty() && answer[0] == 'E') throw std::runtime_error(answer.substr(1));
  if (answer.size() != 1 + sizeof(Value)) throw std::runtime_error("a child process ended without an answer");
  From_child<Value> result;
  std::memcpy(&result.value, answer.data() + 1, sizeof(Value));
  result.peak_bytes = double(usage.ru_maxrss) * 1024;
  return result;
}

} // namespace benchmark_tools

#endif // CGAL_CRUDE_REGISTRATION_BENCHMARK_CHILD_PROCESS_H
