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

#ifndef CGAL_CRUDE_REGISTRATION_ASSEMBLY_STATUS_H
#define CGAL_CRUDE_REGISTRATION_ASSEMBLY_STATUS_H

// What came of a pair of scans in an assembly, in a word.

#include <ostream>

namespace CGAL {
namespace Crude_registration {

/*!
\ingroup PkgCrudeRegistrationRef

What came of a pair of scans that `assemble_scans()` registered.
*/
enum Assembly_edge_status
{
  USED,           ///< a motion of the pair is that of the model
  DROPPED,        ///< its motions contradict the model
  NOT_CONNECTING, ///< its motions would join two components, and are not believed
  WITHOUT_OVERLAP ///< no motion was found
};

/*!
\ingroup PkgCrudeRegistrationRef

Writes `used`, `dropped`, `not_connecting` or `without_overlap`.
*/
inline std::ostream& operator<<(std::ostream& out, Assembly_edge_status status)
{
  switch (status) {
  case USED:
    return out << "used";
  case DROPPED:
    return out << "dropped";
  case NOT_CONNECTING:
    return out << "not_connecting";
  case WITHOUT_OVERLAP:
    break;
  }
  return out << "without_overlap";
}

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_ASSEMBLY_STATUS_H
