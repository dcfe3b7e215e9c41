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

#ifndef CGAL_CRUDE_REGISTRATION_REGISTRATION_STATUS_H
#define CGAL_CRUDE_REGISTRATION_REGISTRATION_STATUS_H

// What comes out of a registration, in a word.

#include <ostream>

namespace CGAL {
namespace Crude_registration {

/*!
\ingroup PkgCrudeRegistrationRef

What came out of a registration.
*/
enum Registration_status
{
  REGISTERED,    ///< one motion explains the scans, and it is certain
  AMBIGUOUS,     ///< several distinct motions, or a family of motions, explain the scans about as well
  NOT_REGISTERED ///< no motion found that can be believed
};

/*!
\ingroup PkgCrudeRegistrationRef

Writes `registered`, `ambiguous` or `not_registered`.
*/
inline std::ostream& operator<<(std::ostream& out, Registration_status status)
{
  switch (status) {
  case REGISTERED:
    return out << "registered";
  case AMBIGUOUS:
    return out << "ambiguous";
  case NOT_REGISTERED:
    break;
  }
  return out << "not_registered";
}

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_REGISTRATION_STATUS_H
