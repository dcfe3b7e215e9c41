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

#ifndef CGAL_CRUDE_REGISTRATION_IO_INTERNAL_UNPACK_GZIP_H
#define CGAL_CRUDE_REGISTRATION_IO_INTERNAL_UNPACK_GZIP_H

// Unpacks what gzip has packed, and packs it.

#include <CGAL/Crude_registration/IO/IO_error.h>

#ifdef CGAL_CRUDE_REGISTRATION_USE_GZIP
#include <boost/iostreams/close.hpp>
#include <boost/iostreams/copy.hpp>
#include <boost/iostreams/device/array.hpp>
#include <boost/iostreams/device/back_inserter.hpp>
#include <boost/iostreams/filter/gzip.hpp>
#include <boost/iostreams/filtering_stream.hpp>
#include <boost/iostreams/filtering_streambuf.hpp>

#include <ios>
#endif

#include <string>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Deflate unpacks to 1032 times the size at most: the memory that is asked for is in proportion to the file.
inline std::string unpack_gzip([[maybe_unused]] const std::string& data, const std::string& file)
{
#ifdef CGAL_CRUDE_REGISTRATION_USE_GZIP
  try {
    boost::iostreams::filtering_istreambuf in;
    in.push(boost::iostreams::gzip_decompressor());
    in.push(boost::iostreams::array_source(data.data(), data.size()));
    std::string unpacked;
    boost::iostreams::copy(in, boost::iostreams::back_inserter(unpacked));
    return unpacked;
  } catch (const std::ios_base::failure&) { // of which the errors of gzip and zlib are
    throw IO_error(file, "what gzip has packed is damaged or cut short");
  }
#else
  throw IO_error(file, "gzip is unpacked only where the program was built with Boost.Iostreams");
#endif
}

// Packs as gzip does, without a time: the same data gives the same bytes.
inline std::string pack_gzip([[maybe_unused]] const std::string& data, [[maybe_unused]] const std::string& file)
{
#ifdef CGAL_CRUDE_REGISTRATION_USE_GZIP
  std::string packed;
  boost::iostreams::filtering_ostream out;
  out.push(boost::iostreams::gzip_compressor());
  out.push(boost::iostreams::back_inserter(packed));
  out.write(data.data(), static_cast<std::streamsize>(data.size()));
  boost::iostreams::close(out);
  return packed;
#else
  throw IO_error(file, "gzip packs only where the program was built with Boost.Iostreams");
#endif
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_INTERNAL_UNPACK_GZIP_H
