// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// The regression by which the confidence is fitted finds the law that choices were drawn by.

#define BOOST_TEST_MODULE conditional_logit
#include <boost/test/unit_test.hpp>

#include "../../calibration/conditional_logit.h"

#include <CGAL/Crude_registration/internal/base/Counter_random.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace {

using Logit = benchmark_tools::Conditional_logit<3>;
constexpr std::size_t all = (std::numeric_limits<std::size_t>::max)();

// Choices among 1 to 6 alternatives by a law, some of them drawn evenly; of group 1 those whose number is odd.
template <class Law = Logit>
Law drawn(std::size_t n, const Logit::Features& law, double lapse, bool odd_ones_are_reversed, bool has_none = true)
{
  const CGAL::Crude_registration::internal::Counter_random random(5);
  std::uint64_t at = 0;
  Law logit;
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<Logit::Features> alternatives(1 + std::size_t(6 * random.uniform(at++)));
    std::vector<double> share = {has_none ? 1. : 0.}; // of none, and of each
    const double sign = odd_ones_are_reversed && i % 2 == 1 ? -1 : 1;
    double sum = share.front();
    for (Logit::Features& f : alternatives) {
      f << random.normal(at), random.normal(at + 1), 1;
      at += 2;
      share.push_back(std::exp(sign * law.dot(f)));
      sum += share.back();
    }
    if (random.uniform(at++) < lapse) {
      share.assign(share.size(), 1);
      share.front() = has_none ? 1 : 0;
      sum = double(share.size() - 1) + share.front();
    }
    double left = sum * random.uniform(at++);
    int right = -1;
    for (std::size_t k = 0; k + 1 < share.size() && left >= share[k]; ++k) {
      left -= share[k];
      ++right;
    }
    logit.add_choice(alternatives, right, i % 2);
  }
  return logit;
}

} // namespace

BOOST_AUTO_TEST_CASE(the_law_is_found)
{
  const Logit::Features law(4, -2, -1);
  const Logit logit = drawn(20000, law, 0, false);
  Logit::Estimate start;
  const Logit::Estimate e = logit.fit(all, start, true);
  BOOST_TEST((e.coefficients - law).norm() < 0.2);
  BOOST_TEST(e.lapse == 0);
  BOOST_TEST(e.log_likelihood < 0);
}

BOOST_AUTO_TEST_CASE(the_law_of_shares_is_found)
{
  using Shares = benchmark_tools::Conditional_logit<3, false>;
  // What all alternatives have says nothing.
  const Shares::Features law(4, -2, 0);
  Shares::Estimate start;
  start.lapse = 0.01;
  for (const double lapse : {0., 0.05}) {
    const Shares::Estimate e = drawn<Shares>(20000, law, lapse, false, false).fit(all, start, false);
    BOOST_TEST((e.coefficients - law).norm() < 0.3);
    BOOST_TEST(std::abs(e.lapse - lapse) < 0.01);
    BOOST_TEST(e.log_likelihood < 0);
  }
}

BOOST_AUTO_TEST_CASE(lapses_do_not_flatten_the_law)
{
  const Logit::Features law(4, -2, -1);
  const Logit logit = drawn(20000, law, 0.05, false);
  Logit::Estimate start;
  start.lapse = 0.01;
  const Logit::Estimate e = logit.fit(all, start, false), without = logit.fit(all, {}, true);
  BOOST_TEST((e.coefficients - law).norm() < 0.3);
  BOOST_TEST(std::abs(e.lapse - 0.05) < 0.01);
  BOOST_TEST(without.coefficients.norm() < 0.8 * law.norm());
  BOOST_TEST(e.log_likelihood > without.log_likelihood);
}

BOOST_AUTO_TEST_CASE(a_group_is_left_out)
{
  const Logit::Features law(3, 1, 0.5);
  const Logit logit = drawn(20000, law, 0, true);
  BOOST_TEST((logit.fit(1, {}, true).coefficients - law).norm() < 0.3);
  BOOST_TEST((logit.fit(0, {}, true).coefficients + law).norm() < 0.3);
}
