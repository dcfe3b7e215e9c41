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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_CHANCE_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_CHANCE_H

// How outcomes of probes come about by chance between two scans, and what they are evidence of.

#include <CGAL/Crude_registration/internal/judgement/evidence_coefficients.h>
#include <CGAL/Crude_registration/internal/judgement/probe_outcomes.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// What each outcome is evidence of as chance is between any two scans: log( P(o | right) / P(o | chance) ).
inline std::array<double, Outcome::SIZE> usual_log_ratios(const Evidence_coefficients& c)
{
  std::array<double, Outcome::SIZE> result{};
  for (int o = 1; o < Outcome::SIZE; ++o) {
    const int kind = Outcome::kind(std::uint8_t(o));
    const double log_ratio = std::log(c.right[kind] / c.wrong[kind]);
    result[std::size_t(o)] =
        o <= Outcome::fits ? log_ratio + std::log(c.right_fit[o - 1] / c.wrong_fit[o - 1]) : (std::min)(log_ratio, 0.);
  }
  return result;
}

// The evidence of `n` outcomes by these ratios, in nats.
inline double usual_evidence(const std::uint8_t* outcomes, std::size_t n,
                             const std::array<double, Outcome::SIZE>& log_ratios)
{
  double result = 0;
  for (std::size_t i = 0; i < n; ++i) result += log_ratios[outcomes[i]];
  return result;
}

// How often each outcome comes about by chance at each probe of a scan: what the probes meet under the candidates of
// the pair, nearly all of which are wrong. Evidence for a pose is
//   E = sum_i log( P(o_i | right) / P_i(o_i | chance) )
// over the probes that have an outcome. Its kind has a probability of its own at each probe, as a flat side agrees by
// chance often and an ear seldom; how well a probe agrees has one for the pair. What does not agree is no evidence for
// a pose, however seldom it is met: its summands are at most 0. Where few candidates are known, each probability is
// drawn to the mean of the pair, and that to what is usual.
class Chance
{
public:
  // `table`: the outcomes under distinct candidates; kept by reference, not to be changed. `rows`: those that count.
  Chance(const Outcome_table& table, const std::vector<std::size_t>& rows,
         const Evidence_coefficients& coefficients = {})
      : m_table(table), m_coefficients(coefficients), m_rows(rows.size()), m_counts(table.probes())
  {
    for (const std::size_t k : rows) {
      for (std::size_t i = 0; i < table.probes(); ++i) {
        const std::uint8_t o = table[k][i];
        if (o == Outcome::UNKNOWN) continue;
        ++m_counts[i][std::size_t(Outcome::kind(o))];
        if (o <= Outcome::fits) ++m_fits[o];
      }
    }
    for (const auto& c : m_counts)
      for (std::size_t kind = 0; kind < Outcome::kinds; ++kind) m_kinds[kind] += double(c[kind]);
  }

  // Evidence for a pose under which the probes have those outcomes, in nats, the candidates `near` it left out, which
  // are of those that count.
  double evidence(const std::uint8_t* outcomes, const std::vector<std::size_t>& near) const
  {
    std::array<double, Outcome::kinds> kinds = m_kinds;
    std::array<double, Outcome::SIZE> fits = m_fits;
    for (const std::size_t k : near) {
      for (std::size_t i = 0; i < m_table.probes(); ++i) {
        const std::uint8_t o = m_table[k][i];
        if (o == Outcome::UNKNOWN) continue;
        --kinds[std::size_t(Outcome::kind(o))];
        if (o <= Outcome::fits) --fits[o];
      }
    }
    // One count for each kind, and for none of them, as Laplace's rule has it, in the proportions of the pair's mean,
    // that has one candidate's worth of what is usual in it.
    constexpr double pseudo = Outcome::kinds + 1;
    const double candidates = double(m_rows - near.size()), probes = double(m_table.probes());
    std::array<double, Outcome::kinds> prior, log_right;
    for (std::size_t kind = 0; kind < Outcome::kinds; ++kind) {
      prior[kind] = pseudo * (kinds[kind] / probes + m_coefficients.wrong[kind]) / (candidates + 1);
      log_right[kind] = std::log(m_coefficients.right[kind]);
    }
    const std::array<double, Outcome::SIZE> fit = log_ratios_of_fits(fits);
    // By how often what came of a probe did so under the candidates, which are few.
    const std::size_t counts = m_rows - near.size() + 1;
    std::vector<double> log_ratios(Outcome::kinds * counts);
    for (std::size_t kind = 0; kind < Outcome::kinds; ++kind)
      for (std::size_t n = 0; n < counts; ++n) {
        const double r = log_right[kind] - std::log((double(n) + prior[kind]) / (candidates + pseudo));
        log_ratios[kind * counts + n] = kind == 0 ? r : (std::min)(r, 0.);
      }
    double result = 0;
    for (std::size_t i = 0; i < m_table.probes(); ++i) {
      const std::uint8_t o = outcomes[i];
      if (o == Outcome::UNKNOWN) continue;
      const auto kind = std::size_t(Outcome::kind(o));
      std::int32_t here = m_counts[i][kind];
      for (const std::size_t k : near) {
        const std::uint8_t other = m_table[k][i];
        here -= std::int32_t(other != Outcome::UNKNOWN && Outcome::kind(other) == int(kind));
      }
      result += log_ratios[kind * counts + std::size_t(here)] + fit[o]; // which is 0 of what does not agree
    }
    return result;
  }

private:
  // log( P(o | agrees, right) / P(o | agrees, chance) ) for each outcome o; `counts`: of the candidates', to which each
  // adds what is usual of as many as there are.
  std::array<double, Outcome::SIZE> log_ratios_of_fits(const std::array<double, Outcome::SIZE>& counts) const
  {
    std::array<double, Outcome::SIZE> result{};
    double sum = Outcome::fits;
    for (int o = 1; o <= Outcome::fits; ++o) sum += counts[std::size_t(o)];
    for (int o = 1; o <= Outcome::fits; ++o)
      result[std::size_t(o)] = std::log(m_coefficients.right_fit[o - 1] * sum /
                                        (counts[std::size_t(o)] + Outcome::fits * m_coefficients.wrong_fit[o - 1]));
    return result;
  }

  const Outcome_table& m_table;
  const Evidence_coefficients m_coefficients;
  const std::size_t m_rows;
  std::vector<std::array<std::int32_t, Outcome::kinds>> m_counts; // by probe
  std::array<double, Outcome::kinds> m_kinds{};
  std::array<double, Outcome::SIZE> m_fits{};
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_CHANCE_H
