// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_TEST_WRONG_USE_H
#define CGAL_CRUDE_REGISTRATION_TEST_WRONG_USE_H

// That wrong use is refused by an exception that names the function and the argument.

#include <boost/test/unit_test.hpp>

#include <stdexcept>
#include <string>

// For BOOST_CHECK_EXCEPTION: whether what is said begins with `start` and has `word` in it.
inline auto names(const std::string& start, const std::string& word = "")
{
  return [=](const std::invalid_argument& e) {
    const std::string what = e.what();
    const bool is_named = what.rfind(start, 0) == 0 && what.find(word) != std::string::npos;
    if (!is_named) BOOST_TEST_MESSAGE("said: " << what);
    return is_named;
  };
}

// Whether a call throws such an exception.
template <class Call>
bool is_refused(const Call& call, const std::string& start, const std::string& word = "")
{
  try {
    call();
  } catch (const std::invalid_argument& e) {
    return names(start, word)(e);
  }
  return false;
}

#endif // CGAL_CRUDE_REGISTRATION_TEST_WRONG_USE_H
