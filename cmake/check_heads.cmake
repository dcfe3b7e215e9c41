# Fails where a header or a source of the library does not begin with the head of CGAL's files:
# cmake -D source_dir=DIR [-D write=ON] -P check_heads.cmake. With `write` the head takes the place of the comment that
# a file begins with.
cmake_minimum_required(VERSION 3.22)
set(head "// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// \$URL\$
// \$Id\$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Author(s)     : The Crude_registration authors

")
file(GLOB_RECURSE files ${source_dir}/include/*.h ${source_dir}/src/*.cpp)
if(NOT files)
  message(FATAL_ERROR "there are no headers in ${source_dir}")
endif()
foreach(file IN LISTS files)
  file(READ ${file} text)
  string(FIND "${text}" "${head}" position)
  if(position EQUAL 0)
    continue()
  endif()
  if(write AND text MATCHES "^// Copyright ")
    string(FIND "${text}" "\n\n" end)
    math(EXPR end "${end} + 2")
    string(SUBSTRING "${text}" ${end} -1 text)
    file(WRITE ${file} "${head}${text}")
  else()
    message(SEND_ERROR "${file} does not begin with the head of CGAL's files")
  endif()
endforeach()
