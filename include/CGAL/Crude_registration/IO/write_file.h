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

#ifndef CGAL_CRUDE_REGISTRATION_IO_WRITE_FILE_H
#define CGAL_CRUDE_REGISTRATION_IO_WRITE_FILE_H

// Writes a file whole or not at all.

#include <CGAL/Crude_registration/IO/IO_error.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <ios>
#include <limits>
#include <locale>
#include <ostream>
#include <string>
#include <system_error>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// A new file beside `target`, which this creates empty: no other process can have it.
inline std::filesystem::path new_file_beside(const std::filesystem::path& target, const std::string& filename)
{
  for (int i = 0; i < 1000; ++i) {
    std::filesystem::path path = target;
    path += ".part" + std::to_string(i);
    if (std::FILE* file = std::fopen(path.string().c_str(), "wbx")) {
      std::fclose(file);
      return path;
    }
    if (!std::filesystem::exists(path)) break;
  }
  throw IO_error(filename, "the file cannot be written: no new file can be made beside it");
}

} // namespace internal

/*!
\ingroup PkgCrudeRegistrationRef

\brief writes a file whole or not at all: an error leaves a file of that name as it was.

What is written goes to a temporary file in the same folder, which then takes the place of the file, with its
permissions; a symbolic link stays one. What is no regular file (a pipe, a terminal) is written directly. The stream is
binary, in the "C" locale, and writes doubles so that they are read back the same.

\tparam Write a function object that is called as `write(std::ostream&)`

\param filename the name of the file
\param write writes the contents; what it throws is passed on

\throws IO_error if the file cannot be written, or `write` leaves the stream in a failed state.
*/
template <class Write>
void write_file(const std::string& filename, Write write)
{
  namespace fs = std::filesystem;
  const auto write_to = [&](const fs::path& path) {
    std::ofstream out(path, std::ios::binary);
    if (!out) throw IO_error(filename, "the file cannot be opened for writing");
    out.imbue(std::locale::classic());
    out.precision(std::numeric_limits<double>::max_digits10);
    write(out);
    out.close();
    if (!out) throw IO_error(filename, "the file cannot be written");
  };

  std::error_code error;
  fs::path target = fs::canonical(filename, error); // through symbolic links, which stay
  if (error) target = filename;
  const fs::file_status status = fs::status(target, error);
  if (fs::is_directory(status)) throw IO_error(filename, "the file cannot be written: it is a folder");
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    write_to(target);
    return;
  }

  const fs::path temporary = internal::new_file_beside(target, filename);
  try {
    write_to(temporary);
    if (fs::exists(status)) fs::permissions(temporary, status.permissions(), error);
    fs::rename(temporary, target, error);
    if (error) throw IO_error(filename, "the file cannot be written: " + error.message());
  } catch (...) {
    fs::remove(temporary, error);
    throw;
  }
}

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_WRITE_FILE_H
