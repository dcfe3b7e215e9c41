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

#ifndef CGAL_CRUDE_REGISTRATION_REGISTRATION_RESULT_H
#define CGAL_CRUDE_REGISTRATION_REGISTRATION_RESULT_H

// The answer of a registration.

#include <CGAL/Crude_registration/Registration_status.h>
#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Point_3.h>
#include <CGAL/assertions.h>

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {

/*!
\ingroup PkgCrudeRegistrationRef

The answer of a registration of a *source* and a *target*: a value, which refers to neither.

Every transformation in it is rigid and maps the source into the frame of the target: with `t = transformation()`,
the point `t.transform(p)` of the moved source lies on the target where the scans overlap. A registration that fails
says so in status(), with the reason in reason(); it does not throw.

\tparam Kernel_ the kernel of the transformations
*/
template <class Kernel_ = Exact_predicates_inexact_constructions_kernel>
class Registration_result
{
public:
  /// The kernel.
  using Kernel = Kernel_;

  /// The type of the transformations.
  using Transformation = Aff_transformation_3<Kernel>;

  /// The type of points of the source, each with the point of the target that it was matched with.
  using Correspondence = std::vector<std::pair<Point_3<Kernel>, Point_3<Kernel>>>;

  /// The type of the covariance of a motion: six rows of six numbers.
  using Covariance = std::array<std::array<double, 6>, 6>;

  /// A motion that was considered, with its score as of score(), and the probability that it is right: those of all
  /// motions that were considered and of none of them being right add up to one.
  struct Scored_motion
  {
    Transformation transformation;
    double score;
    double probability;
  };

  /// What a stage of the registration did: how many items it worked on, and how long it took.
  struct Stage
  {
    std::string name;
    std::size_t count;
    double seconds;
  };

  /// The parts a result is made of; each is explained at the member function of its name.
  struct Parts
  {
    Registration_status status = NOT_REGISTERED;
    std::string reason;
    Transformation transformation = Transformation(IDENTITY);
    Transformation crude_transformation = Transformation(IDENTITY);
    Correspondence correspondence;
    double confidence = 0;
    double score = 0;
    double overlap = 0;
    double residual = 0;
    double free_space_violations = 0;
    bool source_has_free_space = false;
    bool target_has_free_space = false;
    Covariance covariance{};
    std::vector<std::string> free_motions;
    std::vector<Scored_motion> runners_up;
    std::vector<Stage> statistics;
  };

  /// A result of nothing: not registered.
  Registration_result() = default;

  /// A result made of its parts.
  /// \pre `parts.confidence` is in [0,1]
  explicit Registration_result(Parts parts) : m_parts(std::move(parts))
  {
    CGAL_precondition(m_parts.confidence >= 0 && m_parts.confidence <= 1);
  }

  /// Whether the scans are registered.
  Registration_status status() const { return m_parts.status; }

  /// Why the status is not `REGISTERED`, as a sentence; empty if it is.
  const std::string& reason() const { return m_parts.reason; }

  /// The motion that maps the source into the frame of the target; the best of several if `AMBIGUOUS`, the identity if
  /// `NOT_REGISTERED`.
  const Transformation& transformation() const { return m_parts.transformation; }

  /// The motion that maps the target into the frame of the source.
  Transformation inverse_transformation() const
  {
    return internal::to_aff_transformation<Kernel>(internal::to_rigid_motion(m_parts.transformation).inverse());
  }

  /// transformation() as the candidate generator proposed it, before the judge and the refinement moved it: by
  /// `Oriented_pair_candidates` the motion of a pair of oriented points, estimated again from all points of the reduced
  /// surfaces that agree under it, by `Trihedron_candidates` that of a trihedron, estimated again from all vertices of
  /// the simplified meshes that do.
  const Transformation& crude_transformation() const { return m_parts.crude_transformation; }

  /// The points that gave crude_transformation(), each of the source with the one of the target that it was matched
  /// with: by `Oriented_pair_candidates` the two of a pair, which are points of the reduced surfaces; by
  /// `Trihedron_candidates` the vertices \f$ V, v_1, v_2, v_3 \f$ of a spatial trihedron and those that correspond to
  /// them, which are vertices of the simplified meshes. Each point is in the frame of its scan. The distances within
  /// either side are the same as far as the matching tolerates; crude_transformation(), which is estimated again from
  /// far more, need not take the ones onto the others. Empty if `NOT_REGISTERED`, if the motion was proposed by
  /// a generator of your own, and of a motion that was judged.
  const Correspondence& correspondence() const { return m_parts.correspondence; }

  /// The probability, in [0,1], that transformation() is right; at most 1/n where n distinct motions are equally good,
  /// at most 1/2 where the overlap leaves motions free. At least 0.9 if and only if `REGISTERED`.
  double confidence() const { return m_parts.confidence; }

  /// The natural logarithm of the odds that transformation() is right, against none of the distinct motions being
  /// right; the larger, the better. 0 if there is no motion at all.
  double score() const { return m_parts.score; }

  /// The share of the source's surface that has the target close by, with its normal, under transformation().
  double overlap() const { return m_parts.overlap; }

  /// The RMS distance between the scans where they overlap, along the normals, in sampling distances.
  double residual() const { return m_parts.residual; }

  /// The share of the source's surface that lies, under transformation(), where the target's sensor saw that there is
  /// nothing, plus that of the target's surface: from 0 to 2.
  double free_space_violations() const { return m_parts.free_space_violations; }

  /// Whether what the source's sensor saw to be empty was judged: not where its sensor is unknown and its surface is
  /// closed or seen from several sides.
  bool source_has_free_space() const { return m_parts.source_has_free_space; }

  /// The same of the target.
  bool target_has_free_space() const { return m_parts.target_has_free_space; }

  /// The covariance of the small motion \f$ x \rightarrow x + \omega \times x + v \f$ that follows transformation(), in
  /// the order \f$ (\omega_x, \omega_y, \omega_z, v_x, v_y, v_z) \f$: radians about the axes through the origin of the
  /// target's frame, and the displacement in the unit of its coordinates. It tells the scatter that independent noise
  /// of the samples makes, not errors that all scans of a scanner have in common.
  const Covariance& covariance() const { return m_parts.covariance; }

  /// The names of the motions that the overlap leaves free, such as a turn about an axis; places and directions are in
  /// the frame of the target.
  const std::vector<std::string>& free_motions() const { return m_parts.free_motions; }

  /// The best motions that are distinct from transformation() and from each other, best first.
  const std::vector<Scored_motion>& runners_up() const { return m_parts.runners_up; }

  /// What each stage did, in their order: `reduce` (samples of both scans), `propose` (rounds), its parts, whose names
  /// start with `propose:`, `judge` (motions looked at closely), `refine` (iterations), `conclude` (distinct motions).
  const std::vector<Stage>& statistics() const { return m_parts.statistics; }

private:
  Parts m_parts;
};

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_REGISTRATION_RESULT_H
