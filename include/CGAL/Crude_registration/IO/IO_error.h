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

#ifndef CGAL_CRUDE_REGISTRATION_IO_IO_ERROR_H
#define CGAL_CRUDE_REGISTRATION_IO_IO_ERROR_H

// The error of reading and writing files, which says where.

#include <cstddef>
#include <stdexcept>
#include <string>

namespace CGAL {
namespace Crude_registration {

/*!
\ingroup PkgCrudeRegistrationRef

\brief thrown by the readers and writers of this package when a file cannot be opened, does not parse or cannot be
written.

`what()` reads `FILE:LINE: what is wrong`, or `FILE: what is wrong` where the error has no line: in the binary part of a
file (the text then names the byte) and where the file as a whole is wrong.
*/
class IO_error : public std::runtime_error
{
public:
  /// an error in a line; lines are counted from 1.
  IO_error(const std::string& file, std::size_t line, const std::string& what)
      : std::runtime_error(file + ":" + std::to_string(line) + ": " + what), m_file(file), m_line(line)
  {}

  /// an error of the whole file, or in its binary part.
  IO_error(const std::string& file, const std::string& what) : std::runtime_error(file + ": " + what), m_file(file) {}

  /// the name of the file as it was given.
  const std::string& file() const { return m_file; }

  /// the line, counted from 1; 0 where the error has none.
  std::size_t line() const { return m_line; }

private:
  std::string m_file;
  std::size_t m_line = 0;
};

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_IO_ERROR_H
