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

#ifndef CGAL_CRUDE_REGISTRATION_ASSEMBLY_RESULT_H
#define CGAL_CRUDE_REGISTRATION_ASSEMBLY_RESULT_H

// The answer of an assembly of many scans.

#include <CGAL/Crude_registration/Assembly_status.h>
#include <CGAL/Crude_registration/Registration_status.h>

#include <CGAL/Aff_transformation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {

/*!
\ingroup PkgCrudeRegistrationRef

The answer of `assemble_scans()`: a value, which refers to no scan. Scans are called by their places in the input.

The scans lie in *components*: what could not be connected with certainty stays apart. The frame of a component is that
of the first of its scans in the input, unless a known pose or a reference scan gives another one.

\tparam Kernel_ the kernel of the transformations
*/
template <class Kernel_ = Exact_predicates_inexact_constructions_kernel>
class Assembly_result
{
public:
  /// The kernel.
  using Kernel = Kernel_;

  /// The type of the poses.
  using Transformation = Aff_transformation_3<Kernel>;

  /// The type of the covariance of a pose: six rows of six numbers.
  using Covariance = std::array<std::array<double, 6>, 6>;

  /// A scan.
  struct Placed_scan
  {
    /// The component it is in.
    std::size_t component = 0;

    /// Maps the scan into the frame of its component.
    Transformation pose = Transformation(IDENTITY);

    /// Why it is alone in its component; empty if it is not.
    std::string reason;

    /// The RMS distance, along the normals, between it and the scans that it overlaps, in sampling distances.
    double residual = 0;

    /// The covariance of the small motion \f$ x \rightarrow x + \omega \times x + v \f$ that follows the pose, in the
    /// order \f$ (\omega_x, \omega_y, \omega_z, v_x, v_y, v_z) \f$: radians about the axes through the origin of the
    /// component's frame, and the displacement in the unit of the coordinates. It is relative to the scan whose frame
    /// it is, and tells the scatter that independent noise of the samples makes.
    Covariance covariance{};

    /// Why its known pose was dropped where that was no more than a hint; empty if it was not.
    std::string lost_hint;
  };

  /// A pair of scans that was registered.
  struct Edge
  {
    std::size_t source = 0;
    std::size_t target = 0;

    /// What came of it.
    Assembly_edge_status status = WITHOUT_OVERLAP;

    /// Why it was not used, or what is to be known of it.
    std::string reason;

    /// What the registration of the two scans alone has said.
    Registration_status registration = NOT_REGISTERED;

    /// Its confidence in its best motion.
    double confidence = 0;

    /// The share of the source's surface that has the target close by, and the RMS distance in sampling distances, as
    /// the registration has them.
    double overlap = 0;
    double residual = 0;
  };

  /// Two scans that overlap as they lie in the model.
  struct Overlap
  {
    std::size_t source = 0;
    std::size_t target = 0;

    /// The share of the source's surface that lies on the target's.
    double overlap = 0;

    /// The RMS distance along the normals, in sampling distances.
    double residual = 0;
  };

  /// What a step did, and how long it took.
  struct Stage
  {
    std::string name;
    std::size_t count;
    double seconds;
  };

  /// The parts a result is made of; each is explained at the member function of its name.
  struct Parts
  {
    std::vector<Placed_scan> scans;
    std::size_t number_of_components = 0;
    std::vector<Edge> edges;
    std::vector<Overlap> overlaps;
    std::vector<Stage> statistics;
    bool is_interrupted = false;
  };

  /// A result of no scans.
  Assembly_result() = default;

  /// A result made of its parts.
  explicit Assembly_result(Parts parts) : m_parts(std::move(parts)) {}

  /// The number of scans.
  std::size_t number_of_scans() const { return m_parts.scans.size(); }

  /// The number of components, those of one scan with them. Components are numbered by their size, the largest first;
  /// those of one size by the first of their scans.
  std::size_t number_of_components() const { return m_parts.number_of_components; }

  /// The scans, in the order of the input.
  const std::vector<Placed_scan>& scans() const { return m_parts.scans; }

  /// The pose of a scan: maps it into the frame of its component.
  const Transformation& pose(std::size_t scan) const { return m_parts.scans[scan].pose; }

  /// The component of a scan.
  std::size_t component(std::size_t scan) const { return m_parts.scans[scan].component; }

  /// The pairs that were registered, by source and target; source < target.
  const std::vector<Edge>& edges() const { return m_parts.edges; }

  /// The pairs of scans that overlap as they lie, both ways, by source and target.
  const std::vector<Overlap>& overlaps() const { return m_parts.overlaps; }

  /// What each stage did: `reduce` (scans), `predict` (pairs), `register` (pairs), `join` (times that all was joined),
  /// `fuse` (parts registered with fused surfaces), `relax` (iterations).
  const std::vector<Stage>& statistics() const { return m_parts.statistics; }

  /// Whether a time budget or a visitor has ended the run; what had been found by then is the answer.
  bool is_interrupted() const { return m_parts.is_interrupted; }

private:
  Parts m_parts;
};

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_ASSEMBLY_RESULT_H
