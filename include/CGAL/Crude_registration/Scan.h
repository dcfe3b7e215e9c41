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

#ifndef CGAL_CRUDE_REGISTRATION_SCAN_H
#define CGAL_CRUDE_REGISTRATION_SCAN_H

// A scan prepared for registration.

#include <CGAL/Crude_registration/Preparation_interrupted.h>
#include <CGAL/Crude_registration/Range_image.h>
#include <CGAL/Crude_registration/Sensor.h>
#include <CGAL/Crude_registration/internal/base/Flat_sensor.h>
#include <CGAL/Crude_registration/internal/base/Run_control.h>
#include <CGAL/Crude_registration/internal/mesh/faces_of_scan.h>
#include <CGAL/Crude_registration/internal/mesh/to_flat_points.h>
#include <CGAL/Crude_registration/internal/reduction/prepare_for.h>
#include <CGAL/Crude_registration/internal/reduction/reduce_scan.h>
#include <CGAL/Crude_registration/internal/sampling/Flat_range_image.h>
#include <CGAL/Crude_registration/internal/sampling/estimate_flat_sensor.h>
#include <CGAL/Crude_registration/internal/sampling/flat_image_triangulation.h>
#include <CGAL/Crude_registration/internal/sampling/orient_points.h>
#include <CGAL/Crude_registration/named_parameters.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/property_map.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {

template <class Kernel>
struct Scan_file; // IO/read_scan.h

/*!
\ingroup PkgCrudeRegistrationRef

\brief A scan prepared for registration: what is computed once and used by every pair the scan takes part in.

The scan's surface at two resolutions, with normals and curvatures, and, where the sensor is known, the free space in
front of it. Nothing of the input is referred to. All lengths that the class returns are in the unit of the input, all
motions are between frames of inputs.

\tparam Kernel_ a model of `Kernel`

All constructors read these named parameters:

\cgalNamedParamsBegin
  \cgalParamNBegin{viewpoint}
    \cgalParamDescription{where the sensor stood, in the frame of the input}
    \cgalParamType{a `Point_3`}
    \cgalParamDefault{of a range image its own sensor, or what `estimate_sensor()` finds; else not known, and with it
                      what is free space}
    \cgalParamExtra{excludes `viewing_direction`}
  \cgalParamNEnd
  \cgalParamNBegin{viewing_direction}
    \cgalParamDescription{the direction of parallel lines of sight, from the sensor into the scene, in the frame of the
                          input, of any length}
    \cgalParamType{a `Vector_3`, not null}
    \cgalParamDefault{as of `viewpoint`}
    \cgalParamExtra{excludes `viewpoint`}
  \cgalParamNEnd
  \cgalParamNBegin{candidates}
    \cgalParamDescription{the generator that the scan will be registered with, for what it needs of the scan:
                          `Trihedron_candidates` needs the simplified mesh}
    \cgalParamType{a model of `CandidateGenerator`}
    \cgalParamDefault{none: the scan can be registered with `Oriented_pair_candidates` and with generators of your own}
  \cgalParamNEnd
  \cgalParamNBegin{approximation_error}
    \cgalParamDescription{how far `Trihedron_candidates` simplifies the scan, a squared length, see `simplify_scan()`}
    \cgalParamType{`double`, zero or above}
    \cgalParamDefault{`approximation_error()` of the scan if `number_of_vertices` is not given either, else no limit}
  \cgalParamNEnd
  \cgalParamNBegin{number_of_vertices}
    \cgalParamDescription{the number of vertices at which `Trihedron_candidates` stops to simplify}
    \cgalParamType{an integer}
    \cgalParamDefault{`0`}
  \cgalParamNEnd
  \cgalParamNBegin{time_budget}
    \cgalParamDescription{seconds after which the preparation ends}
    \cgalParamType{`double`, above zero}
    \cgalParamDefault{none}
  \cgalParamNEnd
  \cgalParamNBegin{visitor}
    \cgalParamDescription{may end the preparation}
    \cgalParamType{a model of `RegistrationVisitor`, or a `std::reference_wrapper` of one}
    \cgalParamDefault{none}
    \cgalParamExtra{It is called by the calling thread, about once a millisecond.}
  \cgalParamNEnd
\cgalNamedParamsEnd

A parameter that is out of its range is refused by `std::invalid_argument`, as is a scan whose size is not between 1e-12
and 1e12. Where the budget or the visitor ends the preparation, `Preparation_interrupted` is thrown: within a tenth of a
second for scans of up to five million samples. What is thrown by the visitor is passed on.

Complexity: linear in the size of the input; the size of the result is bounded (some megabytes).
*/
template <class Kernel_ = CGAL::Exact_predicates_inexact_constructions_kernel>
class Scan
{
public:
  typedef Kernel_ Kernel;
  typedef typename Kernel::Point_3 Point_3;
  typedef typename Kernel::Vector_3 Vector_3;

  /*!
  prepares a triangle mesh.

  \tparam FaceGraph a model of `FaceListGraph`
  \tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"

  \param mesh the surface, faces counterclockwise seen from outside (from the sensor)
  \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among those of the class and the one
         listed below
  \param name what the mesh is called in the text of exceptions

  \cgalNamedParamsBegin
    \cgalParamNBegin{vertex_point_map}
      \cgalParamDescription{a property map associating points to the vertices of `mesh`}
      \cgalParamType{a class model of `ReadablePropertyMap` with `boost::graph_traits<FaceGraph>::%vertex_descriptor`
                     as key type and a `Point_3` as value type}
      \cgalParamDefault{`boost::get(CGAL::vertex_point, mesh)`}
    \cgalParamNEnd
  \cgalNamedParamsEnd

  \throws std::invalid_argument if the mesh has no face of positive area, a face that is not a triangle, or a coordinate
         that is not finite
  */
  template <class FaceGraph, class NamedParameters = parameters::Default_named_parameters>
  explicit Scan(const FaceGraph& mesh, const NamedParameters& np = parameters::default_values(),
                const std::string& name = "Scan: mesh")
  {
    within_limits(np, name, [&](internal::Run_control& control) {
      prepare(internal::faces_of_scan(mesh, np, name, control), internal::sensor_parameter(np, name), nullptr, np,
              generator_of(np), name, control);
    });
  }

  /*!
  prepares a range image: triangulates it (see `triangulate_range_image()`), with the sensor of the image, of the named
  parameters `viewpoint` or `viewing_direction`, or the one that the grid tells (see `estimate_sensor()`), in this
  order.

  \tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"

  \param image the range image
  \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among those of the class
  \param name what the image is called in the text of exceptions

  \throws std::invalid_argument if no face is left
  */
  template <class NamedParameters = parameters::Default_named_parameters>
  explicit Scan(const Range_image<Kernel>& image, const NamedParameters& np = parameters::default_values(),
                const std::string& name = "Scan: image")
  {
    within_limits(np, name, [&](internal::Run_control& control) { prepare_image(image, np, name, control); });
  }

  /*!
  prepares triangles, as `triangulate_range_image()` gives them.
  \param points the points
  \param triangles the indices of their points, counterclockwise seen from outside (from the sensor)
  \param sensor that saw them, where no named parameter gives it; may be unknown
  \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among those of the class
  \param name what the triangles are called in the text of exceptions
  \throws std::invalid_argument if there is no triangle of positive area, an index without a point, or a coordinate that
         is not finite
  */
  template <class NamedParameters = parameters::Default_named_parameters>
  Scan(const std::vector<Point_3>& points, const std::vector<std::array<std::size_t, 3>>& triangles,
       const Sensor<Kernel>& sensor, const NamedParameters& np = parameters::default_values(),
       const std::string& name = "Scan: triangles")
  {
    within_limits(np, name, [&](internal::Run_control& control) {
      prepare(internal::faces_of_scan(points, triangles, name, control), internal::sensor_parameter(np, name, sensor),
              nullptr, np, generator_of(np), name, control);
    });
  }

  /*!
  prepares points without faces: each gets the normal of the plane that fits its neighbourhood. Copies of points are
  one, and the density is evened. Where neither the sensor is known nor the surface closed, `register_scans()` tries
  both sides of the surface.

  \tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"

  \param points the samples
  \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among those of the class
  \param name what the points are called in the text of exceptions

  \throws std::invalid_argument if a coordinate is not finite or the points are no samples of a surface
  */
  template <class NamedParameters = parameters::Default_named_parameters>
  explicit Scan(const std::vector<Point_3>& points, const NamedParameters& np = parameters::default_values(),
                const std::string& name = "Scan: points")
      : Scan(points, std::vector<Vector_3>(), np, name)
  {}

  /*!
  prepares points with normals, which tell the side from where the surface was seen, unless the sensor is given. The
  directions of the normals are taken from the points as above.

  \tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"

  \param points the samples
  \param normals of the points, in their order, of any length; null where there is none. Empty if there are none.
  \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among those of the class
  \param name what the points are called in the text of exceptions

  \throws std::invalid_argument if a coordinate is not finite, the points are no samples of a surface, or there are
         not as many normals as points
  */
  template <class NamedParameters = parameters::Default_named_parameters>
  Scan(const std::vector<Point_3>& points, const std::vector<Vector_3>& normals,
       const NamedParameters& np = parameters::default_values(), const std::string& name = "Scan: points")
  {
    within_limits(np, name,
                  [&](internal::Run_control& control) { prepare_points(points, normals, {}, np, name, control); });
  }

  /*!
  prepares what `read_scan()` found in a file: a range image, a mesh or points, as above. Where no named parameter gives
  the sensor, it is the one that the file names, `Scan_file::sensor` or that of the range image.

  \tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"

  \param file the contents of the file
  \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among those of the class
  \param name what the file is called in the text of exceptions

  \throws std::invalid_argument if the file holds nothing that has a surface
  */
  template <class NamedParameters = parameters::Default_named_parameters>
  explicit Scan(const Scan_file<Kernel>& file, const NamedParameters& np = parameters::default_values(),
                const std::string& name = "Scan: file")
  {
    within_limits(np, name, [&](internal::Run_control& control) {
      switch (file.kind) {
      case Scan_file<Kernel>::RANGE_IMAGE:
        prepare_image(file.image, np, name, control);
        break;
      case Scan_file<Kernel>::MESH:
        prepare(internal::faces_of_scan(file.mesh, parameters::default_values(), name, control),
                internal::sensor_parameter(np, name, file.sensor), nullptr, np, generator_of(np), name, control);
        break;
      case Scan_file<Kernel>::POINTS:
        prepare_points(file.points, file.normals, file.sensor, np, name, control);
      }
    });
  }

  /// the number of samples that take part.
  std::size_t number_of_samples() const { return m_reduced.number_of_samples; }

  /// the root of the area per sample.
  double spacing() const { return m_reduced.spacing; }

  /// the mean edge length \f$ M \f$ of the scan's box in a frame of the scan's own.
  double extent() const { return m_reduced.extent; }

  /// some thousand points that stand for the surface, in the frame of the input: what candidates are found with.
  std::vector<Point_3> points() const
  {
    std::vector<Point_3> points;
    const internal::Rigid_motion input_from_own = m_reduced.own_from_input.inverse();
    for (const internal::Surfel& s : m_reduced.coarse.surfels) {
      const internal::Vector p = input_from_own(s.position.template cast<double>());
      points.emplace_back(p.x(), p.y(), p.z());
    }
    return points;
  }

  /// the unit normals at points(), outwards or towards the sensor.
  std::vector<Vector_3> normals() const
  {
    std::vector<Vector_3> normals;
    const internal::Matrix input_from_own = m_reduced.own_from_input.rotation.transpose();
    for (const internal::Surfel& s : m_reduced.coarse.surfels) {
      const internal::Vector n = input_from_own * s.normal.template cast<double>().normalized();
      normals.emplace_back(n.x(), n.y(), n.z());
    }
    return normals;
  }

  /// whether free space is known, as it is where the sensor is.
  bool has_free_space() const { return m_reduced.depths.is_known(); }

  /// \cond SKIP_IN_MANUAL
  const internal::Reduced_scan& reduced() const { return m_reduced; }
  explicit Scan(internal::Reduced_scan reduced, std::shared_ptr<const Scan> other_side = nullptr)
      : m_reduced(std::move(reduced)), m_other_side(std::move(other_side))
  {}
  // The surface seen from its other side, where nothing tells from which it was seen; or null.
  const Scan* other_side() const { return m_other_side.get(); }

  // As a part of a longer run. \throws internal::Run_control::Stopped
  template <class FaceGraph, class NamedParameters, class Generator>
  Scan(const FaceGraph& mesh, const NamedParameters& np, const Generator& generator, const std::string& name,
       internal::Run_control& control)
  {
    prepare(internal::faces_of_scan(mesh, np, name, control), internal::sensor_parameter(np, name), nullptr, np,
            generator, name, control);
  }
  /// \endcond

private:
  template <class NamedParameters, class Function>
  static void within_limits(const NamedParameters& np, const std::string& name, const Function& f)
  {
    internal::Run_control control(internal::visitor_parameter(np), internal::time_budget_parameter(np, name.c_str()));
    try {
      f(control);
    } catch (const internal::Run_control::Stopped&) {
      throw Preparation_interrupted(name);
    }
  }

  template <class NamedParameters>
  void prepare_image(const Range_image<Kernel>& image, const NamedParameters& np, const std::string& name,
                     internal::Run_control& control)
  {
    internal::Flat_range_image flat(image);
    if (flat.sensor.kind == internal::Flat_sensor::UNKNOWN) flat.sensor = internal::sensor_parameter(np, name);
    if (flat.sensor.kind == internal::Flat_sensor::UNKNOWN) flat.sensor = internal::estimated_sensor(flat, control);
    prepare(internal::flat_triangulation(flat, internal::sampling(flat, control), internal::default_maximum_edge_ratio,
                                         control),
            flat.sensor, &flat, np, generator_of(np), name, control);
  }

  template <class NamedParameters>
  void prepare_points(const std::vector<Point_3>& points, const std::vector<Vector_3>& normals,
                      const Sensor<Kernel>& of_file, const NamedParameters& np, const std::string& name,
                      internal::Run_control& control)
  {
    const std::vector<internal::Vector> flat =
        internal::to_flat_points(points, CGAL::Identity_property_map<Point_3>(), name, "it", control);
    const std::vector<internal::Vector> flat_normals =
        internal::to_flat_normals(normals, points.size(), name, "it", control);
    const internal::Flat_sensor sensor = internal::sensor_parameter(np, name, of_file);
    const auto start = std::chrono::steady_clock::now();
    control.check();
    internal::check_scan_size(flat, name);
    internal::Oriented_points samples = internal::orient_points(flat, flat_normals, sensor, control);
    m_reduced = internal::reduce_scan(samples, sensor, {}, control);
    if (m_reduced.number_of_samples == 0)
      throw std::invalid_argument(name + " has no surface: the points are no samples of one that the sensor can see");
    internal::prepare_for(generator_of(np), 0, flat, sensor, np, name, control, m_reduced);
    if (!samples.is_side_known && !m_reduced.simplified) { // a simplified mesh is of this side alone
      internal::turn_over(samples);
      m_other_side = std::make_shared<const Scan>(internal::reduce_scan(samples, sensor, {}, control));
    }
    m_reduced.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  // The generator that the scan is prepared for, or any type that needs nothing.
  template <class NamedParameters>
  static decltype(auto) generator_of(const NamedParameters& np)
  {
    return internal::parameter(np, internal_np::candidates, 0);
  }

  // `image`: what `mesh` is the triangulation of, or null.
  template <class NamedParameters, class Generator>
  void prepare(const internal::Flat_mesh& mesh, const internal::Flat_sensor& sensor,
               const internal::Flat_range_image* image, const NamedParameters& np, const Generator& generator,
               const std::string& name, internal::Run_control& control)
  {
    const auto start = std::chrono::steady_clock::now();
    control.check();
    internal::check_scan_size(mesh.points, name);
    m_reduced = internal::reduce_scan(mesh, sensor, {}, control, image != nullptr ? &image->points : nullptr);
    if (m_reduced.number_of_samples == 0)
      throw std::invalid_argument(name + " has no surface: there is no face of positive area that the sensor can see");
    internal::prepare_for(generator, 0, mesh, sensor, image, np, name, control, m_reduced);
    m_reduced.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  internal::Reduced_scan m_reduced;
  std::shared_ptr<const Scan> m_other_side;
};

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_SCAN_H
