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

#ifndef CGAL_CRUDE_REGISTRATION_NAMED_PARAMETERS_H
#define CGAL_CRUDE_REGISTRATION_NAMED_PARAMETERS_H

// The named parameters of this package, which chain with those of CGAL.

#include <CGAL/Named_function_parameters.h>
#include <CGAL/number_utils.h>

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <type_traits>

// The names of this package: ADD(name).
#define CGAL_CRUDE_REGISTRATION_OWN_PARAMETERS(ADD)                                                                    \
  ADD(approximation_error)                                                                                             \
  ADD(candidates)                                                                                                      \
  ADD(cell_size)                                                                                                       \
  ADD(curvature_map)                                                                                                   \
  ADD(known_groups)                                                                                                    \
  ADD(known_poses)                                                                                                     \
  ADD(known_poses_are_fixed)                                                                                           \
  ADD(maximum_distance)                                                                                                \
  ADD(maximum_edge_ratio)                                                                                              \
  ADD(maximum_extent)                                                                                                  \
  ADD(minimum_extent)                                                                                                  \
  ADD(number_of_vertices)                                                                                              \
  ADD(reference_scan)                                                                                                  \
  ADD(sampling_distance)                                                                                               \
  ADD(store)                                                                                                           \
  ADD(time_budget)                                                                                                     \
  ADD(tolerance)                                                                                                       \
  ADD(use_normals)                                                                                                     \
  ADD(viewing_direction)                                                                                               \
  ADD(viewpoint)

// The names of CGAL that functions of this package understand: ADD(CGAL's tag, name).
#define CGAL_CRUDE_REGISTRATION_CGAL_PARAMETERS(ADD)                                                                   \
  ADD(geom_traits_t, geom_traits)                                                                                      \
  ADD(neighbor_radius_t, neighbor_radius)                                                                              \
  ADD(number_of_iterations_t, number_of_iterations)                                                                    \
  ADD(point_t, point_map)                                                                                              \
  ADD(random_seed_t, random_seed)                                                                                      \
  ADD(vertex_normal_map_t, vertex_normal_map)                                                                          \
  ADD(vertex_point_t, vertex_point_map)                                                                                \
  ADD(visitor_t, visitor)

namespace CGAL {
namespace Crude_registration {

// The tags of this package; those of CGAL are found here too.
namespace internal_np {

using namespace CGAL::internal_np;

#define CGAL_CRUDE_REGISTRATION_ADD(NAME) enum NAME##_t{NAME};
CGAL_CRUDE_REGISTRATION_OWN_PARAMETERS(CGAL_CRUDE_REGISTRATION_ADD)
#undef CGAL_CRUDE_REGISTRATION_ADD

} // namespace internal_np

/*!
\ingroup PkgCrudeRegistrationRef

A pack of named parameters in which the names of this package and those of CGAL chain in any order.

It is a `CGAL::Named_function_parameters` whose members return packs of its own kind; everything CGAL's look-up reads
lies in that base. Not written by hand: it is what the functions of `CGAL::Crude_registration::parameters` return.
*/
template <class T, class Tag, class Base = CGAL::internal_np::No_property>
struct Named_parameters : CGAL::Named_function_parameters<T, Tag, Base>
{
  // The part of the pack that a CGAL function is given. Packs are built on the CGAL part of each other, so that a pack
  // never has two bases of this package's kind.
  using Cgal_parameters = CGAL::Named_function_parameters<T, Tag, Base>;

  using Cgal_parameters::Cgal_parameters;

#define CGAL_CRUDE_REGISTRATION_ADD(NAME)                                                                              \
  template <class Value>                                                                                               \
  Named_parameters<Value, internal_np::NAME##_t, Cgal_parameters> NAME(const Value& value) const                       \
  {                                                                                                                    \
    return {value, *this};                                                                                             \
  }
  CGAL_CRUDE_REGISTRATION_OWN_PARAMETERS(CGAL_CRUDE_REGISTRATION_ADD)
#undef CGAL_CRUDE_REGISTRATION_ADD

#define CGAL_CRUDE_REGISTRATION_ADD(TAG, NAME)                                                                         \
  template <class Value>                                                                                               \
  Named_parameters<Value, CGAL::internal_np::TAG, Cgal_parameters> NAME(const Value& value) const                      \
  {                                                                                                                    \
    return {value, *this};                                                                                             \
  }
  CGAL_CRUDE_REGISTRATION_CGAL_PARAMETERS(CGAL_CRUDE_REGISTRATION_ADD)
#undef CGAL_CRUDE_REGISTRATION_ADD
};

/*!
\ingroup PkgCrudeRegistrationRef

Starts of packs of named parameters: `parameters::minimum_extent(0.1).vertex_point_map(vpm).viewpoint(p)`.

A name starts a pack here and continues any pack that started here, whether it is of this package or one of the CGAL
names its functions understand; packs of `CGAL::parameters` are accepted by the functions of this package, too. Each
function documents which names it reads; others are ignored, as in CGAL. A name given twice counts as last given.
*/
namespace parameters {

using CGAL::parameters::choose_parameter;
using CGAL::parameters::Default_named_parameters;
using CGAL::parameters::default_values;
using CGAL::parameters::get_parameter;
using CGAL::parameters::is_default_parameter;

#define CGAL_CRUDE_REGISTRATION_ADD(NAME)                                                                              \
  template <class Value>                                                                                               \
  Named_parameters<Value, internal_np::NAME##_t> NAME(const Value& value)                                              \
  {                                                                                                                    \
    return {value};                                                                                                    \
  }
CGAL_CRUDE_REGISTRATION_OWN_PARAMETERS(CGAL_CRUDE_REGISTRATION_ADD)
#undef CGAL_CRUDE_REGISTRATION_ADD

#define CGAL_CRUDE_REGISTRATION_ADD(TAG, NAME)                                                                         \
  template <class Value>                                                                                               \
  Named_parameters<Value, CGAL::internal_np::TAG> NAME(const Value& value)                                             \
  {                                                                                                                    \
    return {value};                                                                                                    \
  }
CGAL_CRUDE_REGISTRATION_CGAL_PARAMETERS(CGAL_CRUDE_REGISTRATION_ADD)
#undef CGAL_CRUDE_REGISTRATION_ADD

} // namespace parameters

namespace internal {

// A pack as CGAL's own type, to be handed to a CGAL function. The two overloads keep template deduction from having to
// choose among the bases of a pack.
template <class T, class Tag, class Base>
const CGAL::Named_function_parameters<T, Tag, Base>&
cgal_parameters(const CGAL::Named_function_parameters<T, Tag, Base>& np)
{
  return np;
}

template <class T, class Tag, class Base>
const CGAL::Named_function_parameters<T, Tag, Base>& cgal_parameters(const Named_parameters<T, Tag, Base>& np)
{
  return np;
}

// Whether a pack holds the parameter of a tag type, such as internal_np::viewpoint_t.
template <class NamedParameters, class Tag>
constexpr bool is_given = !CGAL::parameters::is_default_parameter<NamedParameters, Tag>::value;

// The value of a parameter (a copy, or a std::reference_wrapper where the pack holds one), or the default.
template <class NamedParameters, class Tag, class Default>
auto parameter([[maybe_unused]] const NamedParameters& np, [[maybe_unused]] Tag tag, const Default& default_value)
{
  if constexpr (is_given<NamedParameters, Tag>) return CGAL::parameters::get_parameter(cgal_parameters(np), tag);
  else return default_value;
}

// A parameter that is a finite number, zero or above; the error names the calling function and the parameter.
template <class NamedParameters, class Tag>
double non_negative_parameter(const NamedParameters& np, Tag tag, double default_value, const char* function,
                              const char* name)
{
  const double value = CGAL::to_double(parameter(np, tag, default_value));
  if (!std::isfinite(value) || value < 0)
    throw std::invalid_argument(std::string(function) + ": " + name + " has to be a finite number, zero or above");
  return value;
}

// A parameter that is a finite number above zero.
template <class NamedParameters, class Tag>
double positive_parameter(const NamedParameters& np, Tag tag, double default_value, const char* function,
                          const char* name)
{
  const double value = CGAL::to_double(parameter(np, tag, default_value));
  if (!std::isfinite(value) || value <= 0)
    throw std::invalid_argument(std::string(function) + ": " + name + " has to be a finite number above zero");
  return value;
}

// A parameter that counts something, at least `lowest`.
template <class NamedParameters, class Tag>
std::size_t count_parameter(const NamedParameters& np, Tag tag, std::size_t default_value, std::size_t lowest,
                            const char* function, const char* name)
{
  const auto value = parameter(np, tag, default_value);
  using Value = std::remove_const_t<decltype(value)>;
  static_assert(std::is_integral<Value>::value, "a count is an integer");
  bool is_valid = true;
  if constexpr (std::is_signed<Value>::value) is_valid = value >= 0;
  const std::size_t count = static_cast<std::size_t>(value);
  if (!is_valid || count < lowest)
    throw std::invalid_argument(std::string(function) + ": " + name + " has to be at least " + std::to_string(lowest));
  return count;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_NAMED_PARAMETERS_H
