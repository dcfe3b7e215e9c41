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

#ifndef CGAL_CRUDE_REGISTRATION_JUDGE_MOTION_H
#define CGAL_CRUDE_REGISTRATION_JUDGE_MOTION_H

// Says of a motion that somebody found whether it brings two scans together.

#include <CGAL/Crude_registration/Judgement_limits.h>
#include <CGAL/Crude_registration/Registration_result.h>
#include <CGAL/Crude_registration/Scan.h>
#include <CGAL/Crude_registration/register_scans.h>

#include <CGAL/Aff_transformation_3.h>
#include <CGAL/tags.h>

#include <cmath>
#include <ostream>
#include <stdexcept>
#include <utility>

namespace CGAL {
namespace Crude_registration {

/*!
\ingroup PkgCrudeRegistrationRef

What is to be said of a motion that somebody found.
*/
enum Motion_status
{
  /// it brings the scans together, to within `Judgement_limits::right_motion` sampling distances.
  RIGHT_MOTION,
  /// it does not, but what refinement makes of it does: see `Motion_judgement::displacement()`.
  REFINABLE_MOTION,
  /// neither it nor what refinement makes of it can be told from chance.
  WRONG_MOTION
};

/// \relates Motion_status
/// writes `right`, `refinable` or `wrong`.
inline std::ostream& operator<<(std::ostream& out, Motion_status status)
{
  return out << (status == RIGHT_MOTION ? "right" : status == REFINABLE_MOTION ? "refinable" : "wrong");
}

/*!
\ingroup PkgCrudeRegistrationRef

What `judge_motion()` says of a motion: a value, which refers to none of its arguments.
*/
template <class Kernel_ = Exact_predicates_inexact_constructions_kernel>
class Motion_judgement
{
public:
  /// The kernel.
  using Kernel = Kernel_;

  Motion_judgement() = default;

  Motion_judgement(Registration_result<Kernel> refined, double displacement)
      : m_refined(std::move(refined)), m_displacement(displacement)
  {}

  /// Whether the motion is right, could be made right by refinement, or is wrong.
  Motion_status status() const
  {
    if (m_refined.status() == NOT_REGISTERED) return WRONG_MOTION;
    return m_displacement <= Judgement_limits::right_motion ? RIGHT_MOTION : REFINABLE_MOTION;
  }

  /// The probability, in [0,1], that what refinement makes of the motion is right.
  double confidence() const { return m_refined.confidence(); }

  /// How far the motion is from what refinement makes of it: the root mean square over the part of the source that
  /// overlaps, in sampling distances. Samples of one surface are a sampling distance apart: no motion is told from
  /// another one better than that by them alone.
  double displacement() const { return m_displacement; }

  /// What refinement makes of the motion, as if it had been found by a registration: with its overlap, its residual,
  /// its free space violations, its free motions, and its rivals, which the search found, as runners-up.
  const Registration_result<Kernel>& refined() const { return m_refined; }

private:
  Registration_result<Kernel> m_refined;
  double m_displacement = 0;
};

/*!
\ingroup PkgCrudeRegistrationRef

\brief judges a motion that somebody found: whether it maps the source to where it belongs in the frame of the target,
whether refinement would take it there, or whether it is wrong.

The motion is refined, and what comes of it is weighed as a registration weighs what it finds: by its evidence against
that of other motions, which the search proposes. Where nothing tells from which side a scan was seen, both sides are
tried.

\tparam ConcurrencyTag `CGAL::Sequential_tag` (default), `CGAL::Parallel_tag` or `CGAL::Parallel_if_available_tag`; the
        answer is the same, bit by bit, with any number of threads
\tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"

\param source, target the scans; their sensors, where known, are part of them
\param motion the motion, from the frame of the source to that of the target
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below

\cgalNamedParamsBegin
  \cgalParamNBegin{candidates}
    \cgalParamDescription{the way to propose the other motions}
    \cgalParamType{a model of `CandidateGenerator`}
    \cgalParamDefault{`Oriented_pair_candidates()`}
    \cgalParamExtra{The parameters of its constructor are read, too.}
  \cgalParamNEnd
  \cgalParamNBegin{time_budget}
    \cgalParamDescription{seconds after which the run ends}
    \cgalParamType{`double`, above zero}
    \cgalParamDefault{none}
  \cgalParamNEnd
  \cgalParamNBegin{visitor}
    \cgalParamDescription{is told how far the run is, and may end it}
    \cgalParamType{a model of `RegistrationVisitor`, or a `std::reference_wrapper` of one}
    \cgalParamDefault{none}
  \cgalParamNEnd
\cgalNamedParamsEnd

\throws std::invalid_argument if `motion` is not rigid to within a thousandth, or a parameter is out of its range

Complexity: that of `register_scans()`.
*/
template <class ConcurrencyTag = CGAL::Sequential_tag, class Kernel,
          class NamedParameters = parameters::Default_named_parameters>
Motion_judgement<Kernel> judge_motion(const Scan<Kernel>& source, const Scan<Kernel>& target,
                                      const Aff_transformation_3<Kernel>& motion,
                                      const NamedParameters& np = parameters::default_values())
{
  const internal::Rigid_motion given = internal::to_rigid_motion(motion);
  constexpr double tolerance = 1e-3; // of what is written with four digits
  if (!((given.rotation * given.rotation.transpose() - internal::Matrix::Identity()).cwiseAbs().maxCoeff() <=
        tolerance) ||
      !(given.rotation.determinant() > 0) || !given.translation.allFinite())
    throw std::invalid_argument("judge_motion: the motion is not rigid");
  const auto generator = internal::candidate_generator(np, "judge_motion");
  internal::Run_control control(internal::visitor_parameter(np), internal::time_budget_parameter(np, "judge_motion"));
  const internal::Judgement_outcome outcome =
      internal::best_of_sides(source, target, control, [&](const Scan<Kernel>& a, const Scan<Kernel>& b) {
        return internal::judge_reduced_motion(a.reduced(), b.reduced(), given,
                                              internal::candidate_factory<ConcurrencyTag>(generator, a, b),
                                              internal::execution<ConcurrencyTag>(), control);
      });
  return {internal::to_result<Kernel>(outcome), outcome.displacement};
}

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_JUDGE_MOTION_H
