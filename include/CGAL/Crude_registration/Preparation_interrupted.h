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

#ifndef CGAL_CRUDE_REGISTRATION_PREPARATION_INTERRUPTED_H
#define CGAL_CRUDE_REGISTRATION_PREPARATION_INTERRUPTED_H

// What is thrown where the preparation of a scan ends early.

#include <stdexcept>
#include <string>

namespace CGAL {
namespace Crude_registration {

/*!
\ingroup PkgCrudeRegistrationRef

\brief Thrown where a time budget or a visitor ends the preparation of a scan, of which no part is of use.
*/
struct Preparation_interrupted : std::runtime_error
{
  /// `name`: of the scan
  explicit Preparation_interrupted(const std::string& name)
      : std::runtime_error("interrupted: the preparation of " + name)
  {}
};

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_PREPARATION_INTERRUPTED_H
