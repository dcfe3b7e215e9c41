// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_BENCHMARK_WRITE_FILE_H
#define CGAL_CRUDE_REGISTRATION_BENCHMARK_WRITE_FILE_H

#include <fstream>
#include <limits>
#include <locale>
#include <stdexcept>
#include <string>

namespace benchmark_tools {

// Writes a file by `write(std::ostream&)`: in the "C" locale, numbers so that they are read back the same.
template <class Write>
void write_file(const std::string& path, const Write& write)
{
  std::ofstream out(path, std::ios::binary);
  if (!out) throw std::runtime_error(path + ": the file cannot be opened for writing");
  out.imbue(std::locale::classic());
  out.precision(std::numeric_limits<double>::max_digits10);
  write(out);
  out.close();
  if (!out) throw std::runtime_error(path + ": the file cannot be written");
}

} // namespace benchmark_tools

#endif // CGAL_CRUDE_REGISTRATION_BENCHMARK_WRITE_FILE_H
