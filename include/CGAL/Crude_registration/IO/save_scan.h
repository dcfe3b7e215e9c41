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

#ifndef CGAL_CRUDE_REGISTRATION_IO_SAVE_SCAN_H
#define CGAL_CRUDE_REGISTRATION_IO_SAVE_SCAN_H

// Keeps prepared scans in files.

#include <CGAL/Crude_registration/IO/IO_error.h>
#include <CGAL/Crude_registration/IO/internal/read_flat_scan.h>
#include <CGAL/Crude_registration/IO/internal/scan_bytes.h>
#include <CGAL/Crude_registration/IO/write_file.h>
#include <CGAL/Crude_registration/Scan.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <ios>
#include <memory>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {

/*!
\ingroup PkgCrudeRegistrationRef

\brief returns a prepared scan as bytes, from which `scan_from_bytes()` makes the same scan, bit by bit, on any machine.
The same scan gives the same bytes.

The bytes are those that `save_scan()` writes.
*/
template <class Kernel>
std::string scan_to_bytes(const Scan<Kernel>& scan)
{
  const Scan<Kernel>* const other_side = scan.other_side();
  return internal::scan_bytes(scan.reduced(), other_side ? &other_side->reduced() : nullptr);
}

/*!
\ingroup PkgCrudeRegistrationRef

\brief makes a prepared scan of the bytes that `scan_to_bytes()` returned, or that are in a file that `save_scan()`
wrote.

\tparam Kernel a model of `Kernel`; not necessarily that of the scan that was written
\param bytes the bytes
\param name stands for them in errors

\throws IO_error if the bytes are cut off or altered, or of another version of the format
*/
template <class Kernel = CGAL::Exact_predicates_inexact_constructions_kernel>
Scan<Kernel> scan_from_bytes(const std::string& bytes, const std::string& name = "scan_from_bytes: bytes")
{
  std::vector<internal::Reduced_scan> sides = internal::scan_of_bytes(bytes, name);
  if (sides.size() == 1) return Scan<Kernel>(std::move(sides[0]));
  return Scan<Kernel>(std::move(sides[0]), std::make_shared<const Scan<Kernel>>(std::move(sides[1])));
}

/*!
\ingroup PkgCrudeRegistrationRef

\brief writes a prepared scan to a file, whole or not at all: some megabytes, with which the scan takes part in pairs
without the samples it was made of.

The file is
- the 8 bytes `CRScan`, carriage return, line feed;
- the version of the format, an integer of 4 bytes, which is another one where another version of this package makes
  another scan of the same samples;
- the number of bytes of the body, an integer of 8 bytes;
- the body: the number of sides, and the motion to the frame of the scan's own, the number of samples, the sampling
distance, the extent, the two levels of surface elements with their look-up tables, the image of depths, and, where the
scan was made for `Trihedron_candidates`, the vertices of its simplified mesh; the same once more, seen from the other
side, where nothing told from which side the surface was seen;
- the CRC-32 of all before, 4 bytes.

Numbers are little-endian, integers and IEEE 754 floats of 4 or 8 bytes; lists begin with their length, in 8 bytes. The
checksum finds damage, not malice.

\param filename the name of the file
\param scan the scan

\throws IO_error if the file cannot be written

\sa `load_scan()`
*/
template <class Kernel>
void save_scan(const std::string& filename, const Scan<Kernel>& scan)
{
  const std::string bytes = scan_to_bytes(scan);
  write_file(filename, [&](std::ostream& out) { out.write(bytes.data(), static_cast<std::streamsize>(bytes.size())); });
}

/*!
\ingroup PkgCrudeRegistrationRef

\brief reads a prepared scan from a file that `save_scan()` wrote.

\tparam Kernel a model of `Kernel`; not necessarily that of the scan that was written
\param filename the name of the file

\throws IO_error if the file cannot be opened, is cut off or altered, or is of another version of the format
*/
template <class Kernel = CGAL::Exact_predicates_inexact_constructions_kernel>
Scan<Kernel> load_scan(const std::string& filename)
{
  return scan_from_bytes<Kernel>(internal::read_file(filename), filename);
}

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_SAVE_SCAN_H
