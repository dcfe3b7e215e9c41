// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_IO_INTERNAL_READ_FILE_H
#define CGAL_CRUDE_REGISTRATION_IO_INTERNAL_READ_FILE_H

// The bytes of a file.

#include <CGAL/Crude_registration/IO/IO_error.h>

#include <cstdio>
#include <memory>
#include <string>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// All bytes of a file.
inline std::string read_file(const std::string& filename)
{
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(filename.c_str(), "rb"), &std::fclose);
  if (!file) throw IO_error(filename, "the file cannot be opened");
  std::string data;
  const std::size_t chunk = std::size_t(1) << 20;
  for (;;) {
    const std::size_t size = data.size();
    data.resize(size + (size < chunk ? chunk : size));
    const std::size_t got = std::fread(&data[size], 1, data.size() - size, file.get());
    const bool at_end = size + got < data.size();
    data.resize(size + got);
    if (std::ferror(file.get())) throw IO_error(filename, "the file cannot be read");
    if (at_end) return data;
  }
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_INTERNAL_READ_FILE_H
