// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_CALIBRATION_CONDITIONAL_LOGIT_H
#define CGAL_CRUDE_REGISTRATION_CALIBRATION_CONDITIONAL_LOGIT_H

// Conditional logistic regression (McFadden 1974) that some choices may disobey: what makes one of several, or none,
// right.

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace benchmark_tools {

// Of the n alternatives of a choice, with features f_k, at most one is right. With probability 1 - lapse it is drawn by
//   P_k = exp(b f_k) / (1 + sum_j exp(b f_j)),
// the one being for none of them, else evenly from the n + 1: so that a few choices that no features explain do not
// flatten the law for all. Without `has_none`, one of them is right, and there is neither the one nor the n + 1.
template <int n_features, bool has_none = true>
class Conditional_logit
{
public:
  using Features = Eigen::Matrix<double, n_features, 1>;

  struct Estimate
  {
    Features coefficients = Features::Zero();
    double lapse = 0;
    double log_likelihood = 0;
  };

  // `right`: -1 for none of them, where that can be. `group`: see fit().
  void add_choice(const std::vector<Features>& alternatives, int right, std::size_t group)
  {
    m_choices.push_back({m_features.size(), alternatives.size(), right, group});
    m_features.insert(m_features.end(), alternatives.begin(), alternatives.end());
  }

  // The most likely coefficients for all choices but those of a group, and, unless it is held as it is in `start`, the
  // most likely lapse, by expectation and maximisation (Dempster, Laird and Rubin 1977).
  Estimate fit(std::size_t without, Estimate start, bool hold_lapse) const
  {
    Estimate e = start;
    std::vector<double> weights(m_choices.size(), 1);
    constexpr int most_steps = 200;
    double before = 0;
    for (int i = 0; i < most_steps; ++i) {
      e.log_likelihood = expect(without, e, weights);
      if (i > 0 && e.log_likelihood - before < 1e-9 * std::abs(e.log_likelihood)) break;
      before = e.log_likelihood;
      if (!hold_lapse) {
        double lapsed = 0, n = 0;
        for (std::size_t c = 0; c < m_choices.size(); ++c) {
          if (m_choices[c].group == without) continue;
          lapsed += 1 - weights[c];
          ++n;
        }
        e.lapse = (lapsed + 1) / (n + 2); // Laplace's rule: never none
      }
      maximize(without, weights, e.coefficients);
    }
    return e;
  }

private:
  using Information = Eigen::Matrix<double, n_features, n_features>;

  struct Choice
  {
    std::size_t begin, size;
    int right;
    std::size_t group;
  };

  // What is taken off all exponents, so that none overflows, and what is left of none of the alternatives.
  double greatest_of(const Choice& choice, const Features& b) const
  {
    double greatest = has_none ? 0 : -(std::numeric_limits<double>::max)();
    for (std::size_t k = 0; k < choice.size; ++k) greatest = (std::max)(greatest, b.dot(m_features[choice.begin + k]));
    return greatest;
  }
  static double of_none(double greatest) { return has_none ? std::exp(-greatest) : 0; }

  // The weights of the choices, each the probability that it obeys the law; the likelihood of all.
  double expect(std::size_t without, const Estimate& e, std::vector<double>& weights) const
  {
    double sum = 0;
    for (std::size_t c = 0; c < m_choices.size(); ++c) {
      const Choice& choice = m_choices[c];
      if (choice.group == without) continue;
      const double greatest = greatest_of(choice, e.coefficients);
      double total = of_none(greatest);
      for (std::size_t k = 0; k < choice.size; ++k)
        total += std::exp(e.coefficients.dot(m_features[choice.begin + k]) - greatest);
      const double of_right =
          choice.right < 0 ? 0 : e.coefficients.dot(m_features[choice.begin + std::size_t(choice.right)]);
      const double lawful = (1 - e.lapse) * std::exp(of_right - greatest) / total,
                   all = lawful + e.lapse / double(choice.size + std::size_t(has_none));
      weights[c] = lawful / all;
      sum += std::log(all);
    }
    return sum;
  }

  // The weighted likelihood, with a weak prior of standard deviation a hundred, which keeps what maximises it finite
  // where right and wrong do not overlap.
  double log_likelihood(std::size_t without, const std::vector<double>& weights, const Features& b, Features* gradient,
                        Information* information) const
  {
    constexpr double precision = 1e-4;
    double sum = -precision / 2 * b.squaredNorm();
    if (gradient) {
      *gradient = -precision * b;
      *information = precision * Information::Identity();
    }
    for (std::size_t c = 0; c < m_choices.size(); ++c) {
      const Choice& choice = m_choices[c];
      if (choice.group == without) continue;
      const double greatest = greatest_of(choice, b);
      double total = of_none(greatest);
      Features mean = Features::Zero();
      Information square = Information::Zero();
      for (std::size_t k = 0; k < choice.size; ++k) {
        const Features& f = m_features[choice.begin + k];
        const double e = std::exp(b.dot(f) - greatest);
        total += e;
        if (!gradient) continue;
        mean += e * f;
        square += e * f * f.transpose();
      }
      const Features right =
          choice.right < 0 ? Features(Features::Zero()) : m_features[choice.begin + std::size_t(choice.right)];
      sum += weights[c] * (b.dot(right) - greatest - std::log(total));
      if (!gradient) continue;
      mean /= total;
      *gradient += weights[c] * (right - mean);
      *information += weights[c] * (square / total - mean * mean.transpose());
    }
    return sum;
  }

  // Newton's method, damped.
  void maximize(std::size_t without, const std::vector<double>& weights, Features& b) const
  {
    constexpr int most_steps = 100;
    for (int i = 0; i < most_steps; ++i) {
      Features gradient;
      Information information;
      const double value = log_likelihood(without, weights, b, &gradient, &information);
      Features step = information.ldlt().solve(gradient);
      double next = log_likelihood(without, weights, b + step, nullptr, nullptr);
      while (next < value && step.norm() > 1e-9) {
        step /= 2;
        next = log_likelihood(without, weights, b + step, nullptr, nullptr);
      }
      b += step;
      if (next - value < 1e-9 * std::abs(value)) break;
    }
  }

  std::vector<Features> m_features;
  std::vector<Choice> m_choices;
};

} // namespace benchmark_tools

#endif // CGAL_CRUDE_REGISTRATION_CALIBRATION_CONDITIONAL_LOGIT_H
