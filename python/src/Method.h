// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CRUDE_REGISTRATION_PYTHON_METHOD_H
#define CRUDE_REGISTRATION_PYTHON_METHOD_H

// The way to propose motions, and its parameters, chosen at run time.

#include "types.h"

#include <CGAL/Crude_registration/matching/Oriented_pair_candidates.h>
#include <CGAL/Crude_registration/matching/Trihedron_candidates.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

// How far a mesh is simplified, as simplify_scan() reads it.
struct Simplification
{
  std::optional<double> approximation_error;
  std::optional<long long> number_of_vertices;
  double cell_size = 0;

  // Calls f with the named parameters that say so.
  template <class Function>
  auto apply(const Function& f) const
  {
    const auto np = p::cell_size(cell_size);
    if (approximation_error && number_of_vertices)
      return f(np.approximation_error(*approximation_error).number_of_vertices(*number_of_vertices));
    if (approximation_error) return f(np.approximation_error(*approximation_error));
    if (number_of_vertices) return f(np.number_of_vertices(*number_of_vertices));
    return f(np);
  }
};

struct Method_parameters
{
  std::string method = "pairs";
  double minimum_extent = 0;
  double maximum_extent = CR::internal::default_maximum_extent;
  std::optional<double> tolerance; // of trihedra, as is what follows
  bool use_normals = true;
  Simplification simplification;
};

// A generator of candidates that is one of the package's.
class Method
{
public:
  // \throws py::value_error, std::invalid_argument
  Method(const Method_parameters& parameters, const std::string& function) : m_simplification(parameters.simplification)
  {
    const auto np = p::minimum_extent(parameters.minimum_extent)
                        .maximum_extent(parameters.maximum_extent)
                        .use_normals(parameters.use_normals);
    if (parameters.method == "pairs") m_generator = CR::Oriented_pair_candidates(np);
    else if (parameters.method == "trihedra")
      m_generator = parameters.tolerance ? CR::Trihedron_candidates(np.tolerance(*parameters.tolerance))
                                         : CR::Trihedron_candidates(np);
    else throw py::value_error(function + ": method is pairs or trihedra, not '" + parameters.method + "'");
  }

  std::unique_ptr<CR::internal::Candidate_source> candidates(const CR::internal::Reduced_scan& source,
                                                             const CR::internal::Reduced_scan& target,
                                                             CR::internal::Execution execution) const
  {
    return std::visit([&](const auto& g) { return g.candidates(source, target, execution); }, m_generator);
  }

  // What a Scan calls: of the trihedra alone, and with their parameters.
  template <class NamedParameters>
  void prepare(const CR::internal::Flat_mesh& dense, const CR::internal::Flat_sensor& sensor,
               const CR::internal::Flat_range_image* image, const NamedParameters&, const std::string& name,
               CR::internal::Run_control& control, CR::internal::Reduced_scan& scan) const
  {
    if (const auto* trihedra = std::get_if<CR::Trihedron_candidates>(&m_generator))
      m_simplification.apply([&](const auto& np) { trihedra->prepare(dense, sensor, image, np, name, control, scan); });
  }

  // The same of points without faces.
  template <class NamedParameters>
  void prepare(const std::vector<CR::internal::Vector>& points, const CR::internal::Flat_sensor& sensor,
               const NamedParameters&, const std::string& name, CR::internal::Run_control& control,
               CR::internal::Reduced_scan& scan) const
  {
    if (const auto* trihedra = std::get_if<CR::Trihedron_candidates>(&m_generator))
      m_simplification.apply([&](const auto& np) { trihedra->prepare(points, sensor, np, name, control, scan); });
  }

private:
  std::variant<CR::Oriented_pair_candidates, CR::Trihedron_candidates> m_generator;
  Simplification m_simplification;
};

#endif // CRUDE_REGISTRATION_PYTHON_METHOD_H
