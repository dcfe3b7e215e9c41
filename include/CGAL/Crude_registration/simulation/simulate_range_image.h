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

#ifndef CGAL_CRUDE_REGISTRATION_SIMULATION_SIMULATE_RANGE_IMAGE_H
#define CGAL_CRUDE_REGISTRATION_SIMULATION_SIMULATE_RANGE_IMAGE_H

// Takes a range image of a mesh, as a scanner would.

#include <CGAL/Crude_registration/Range_image.h>
#include <CGAL/Crude_registration/internal/base/Counter_random.h>
#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/internal/simulation/Ray_caster.h>
#include <CGAL/Crude_registration/internal/mesh/to_flat_mesh.h>
#include <CGAL/Crude_registration/named_parameters.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/assertions.h>
#include <CGAL/squared_distance_3.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace CGAL {
namespace Crude_registration {

/*!
\ingroup PkgCrudeRegistrationRef

\brief the camera of a simulated range scan: where it stands, its grid of lines of sight, and how it errs.

The sensor's own frame has its origin at the viewpoint, x to the right along the columns, y up along the rows, and looks
along -z. As constructed, the camera makes no errors.
*/
template <class Kernel>
struct Range_camera
{
  /// \name Pose
  /// In the frame of the scene, and in its unit.
  /// @{

  /// the origin of the sensor's frame.
  typename Kernel::Point_3 viewpoint = typename Kernel::Point_3(0, 0, 1);
  /// the point in the center of the image.
  typename Kernel::Point_3 target = typename Kernel::Point_3(0, 0, 0);
  /// the direction that is up in the image; not parallel to the viewing direction, otherwise free.
  typename Kernel::Vector_3 up = typename Kernel::Vector_3(0, 1, 0);
  /// @}

  /// \name Grid
  /// @{

  /// `true`: all lines of sight start at the viewpoint. `false`: they are parallel and start in the plane through the
  /// viewpoint, at right angles to it.
  bool is_perspective = false;
  std::size_t columns = 256;
  std::size_t rows = 256;
  /// the distance between adjacent lines of sight, in the plane through the target at right angles to the viewing
  /// direction.
  double spacing = 1. / 256;
  /// @}

  /// \name Errors
  /// @{

  /// the standard deviation of the Gaussian noise along the line of sight, in units of `spacing`.
  double noise = 0;
  /// distances along the line of sight are rounded to multiples of this step, in units of `spacing`; 0 for no rounding.
  double quantization = 0;
  /// the probability that a sample is lost on a surface at right angles to the line of sight.
  double drop_out = 0;
  /// the probability that a sample is lost on a surface along the line of sight. In between, with \f$c\f$ the cosine
  /// between normal and line of sight, it is \f$d + (g - d) (1 - c)^4\f$, where \f$d\f$ is `drop_out` and \f$g\f$ this.
  double grazing_drop_out = 0;
  /// the seed of noise and drop-outs. Each line of sight has random numbers of its own.
  std::uint64_t seed = 0;
  /// @}

  /// a camera with `samples` columns and rows that looks along `viewing_direction` and sees all of `box`, from a
  /// distance of one and a half diagonals of the box. The z-axis is up in the image unless the camera looks along it.
  /// \pre `viewing_direction` is not null, and `box` is not a point.
  static Range_camera framing(const Bbox_3& box, const typename Kernel::Vector_3& viewing_direction,
                              std::size_t samples, bool is_perspective = false)
  {
    const internal::Vector direction = internal::unit_or_zero(vector(viewing_direction));
    const internal::Vector low((box.min)(0), (box.min)(1), (box.min)(2)),
        high((box.max)(0), (box.max)(1), (box.max)(2));
    const double radius = (high - low).norm() / 2;
    CGAL_precondition(!direction.isZero(0));
    CGAL_precondition(radius > 0);
    const internal::Vector center = low + (high - low) / 2, from = center - 3 * radius * direction;
    Range_camera camera;
    camera.viewpoint = typename Kernel::Point_3(from.x(), from.y(), from.z());
    camera.target = typename Kernel::Point_3(center.x(), center.y(), center.z());
    if (std::abs(direction.z()) < 0.9) camera.up = typename Kernel::Vector_3(0, 0, 1);
    camera.is_perspective = is_perspective;
    camera.columns = camera.rows = samples;
    // A sphere at a distance of three radii reaches out to radius / sqrt(1 - 1/9) in the plane through its center.
    camera.spacing = 2 * radius / static_cast<double>(samples) * (is_perspective ? std::sqrt(9. / 8.) : 1.);
    return camera;
  }

  /// the motion that maps the sensor's frame to the frame of the scene.
  /// \throws std::invalid_argument if a value of the camera is out of range.
  typename Kernel::Aff_transformation_3 scene_from_sensor() const
  {
    return internal::to_aff_transformation<Kernel>(pose());
  }

  /// \cond SKIP_IN_MANUAL
  internal::Rigid_motion pose() const
  {
    auto check = [](bool condition, const char* text) {
      if (!condition) throw std::invalid_argument(std::string("Range_camera: ") + text);
    };
    auto is_probability = [](double p) { return p >= 0 && p <= 1; };
    const internal::Vector eye = vector(viewpoint - CGAL::ORIGIN), forward = vector(target - viewpoint);
    check(eye.allFinite(), "viewpoint is not finite");
    check(forward.allFinite() && internal::unit_or_zero(forward).norm() > 0, "target is the viewpoint or not finite");
    check(vector(up).allFinite(), "up is not finite");
    check(columns > 0 && rows > 0, "columns and rows have to be at least 1");
    check(std::isfinite(spacing) && spacing > 0, "spacing has to be finite and above zero");
    check(std::isfinite(noise) && noise >= 0, "noise has to be finite, zero or above");
    check(std::isfinite(quantization) && quantization >= 0, "quantization has to be finite, zero or above");
    check(is_probability(drop_out), "drop_out has to be from 0 to 1");
    check(is_probability(grazing_drop_out), "grazing_drop_out has to be from 0 to 1");

    const internal::Vector back = -internal::unit_or_zero(forward);
    const internal::Vector right = internal::unit_or_zero(vector(up)).cross(back);
    check(right.norm() > 1e-9, "up is null or parallel to the viewing direction");
    internal::Rigid_motion pose;
    pose.rotation.col(0) = right / right.norm();
    pose.rotation.col(1) = back.cross(pose.rotation.col(0));
    pose.rotation.col(2) = back;
    pose.translation = eye;
    return pose;
  }

private:
  static internal::Vector vector(const typename Kernel::Vector_3& v)
  {
    return internal::Vector(CGAL::to_double(v.x()), CGAL::to_double(v.y()), CGAL::to_double(v.z()));
  }
  /// \endcond
};

/*!
\ingroup PkgCrudeRegistrationRef

\brief a range image made by `simulate_range_image()`, and the truth about it.
*/
template <class Kernel>
struct Simulated_range_image
{
  /// the samples in the sensor's own frame, with the sensor set.
  Range_image<Kernel> image;
  /// the motion that maps the points of `image` to the scene. The true motion from a scan `a` to a scan `b` of the same
  /// scene is `b.scene_from_scan.inverse() * a.scene_from_scan`.
  typename Kernel::Aff_transformation_3 scene_from_scan;
};

/*!
\ingroup PkgCrudeRegistrationRef

\brief a scene prepared to be seen by many cameras; `simulate_range_image()` is this for one camera.

Memory is linear in the number of faces, construction \f$O(n \log n)\f$.
*/
class Simulated_scene
{
public:
  /*!
  prepares a triangle mesh; both sides of its faces are seen.

  \tparam FaceGraph a model of `FaceListGraph`
  \tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"

  \param mesh the scene
  \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below

  \cgalNamedParamsBegin
    \cgalParamNBegin{vertex_point_map}
      \cgalParamDescription{a property map associating points to the vertices of `mesh`}
      \cgalParamType{a class model of `ReadablePropertyMap` with `boost::graph_traits<FaceGraph>::%vertex_descriptor`
                     as key type and a `Point_3` as value type}
      \cgalParamDefault{`boost::get(CGAL::vertex_point, mesh)`}
    \cgalParamNEnd
  \cgalNamedParamsEnd

  \throws std::invalid_argument if `mesh` has no face of positive area, a face that is not a triangle, or a coordinate
  that is not finite.
  */
  template <class FaceGraph, class NamedParameters = parameters::Default_named_parameters>
  explicit Simulated_scene(const FaceGraph& mesh, const NamedParameters& np = parameters::default_values())
      : m_rays(internal::to_flat_mesh(mesh, internal::cgal_parameters(np), "simulate_range_image", "mesh"))
  {}

  /// the scene as seen by `camera`.
  /// \throws std::invalid_argument if a value of `camera` is out of range.
  template <class Kernel>
  Simulated_range_image<Kernel> range_image(const Range_camera<Kernel>& camera) const
  {
    const internal::Rigid_motion scene_from_sensor = camera.pose();
    Simulated_range_image<Kernel> result{Range_image<Kernel>(camera.columns, camera.rows), camera.scene_from_sensor()};
    using Vector_3 = typename Kernel::Vector_3;
    using Point_3 = typename Kernel::Point_3;
    result.image.set_sensor(camera.is_perspective ? Sensor<Kernel>::perspective(Point_3(0, 0, 0))
                                                  : Sensor<Kernel>::orthographic(Vector_3(0, 0, -1)));

    const double focus = std::sqrt(CGAL::to_double(CGAL::squared_distance(camera.viewpoint, camera.target)));
    const internal::Counter_random random(camera.seed);
    for (std::size_t row = 0; row < camera.rows; ++row)
      for (std::size_t column = 0; column < camera.columns; ++column) {
        // The line of sight in the sensor's frame.
        const internal::Vector pixel(
            camera.spacing * (static_cast<double>(column) - static_cast<double>(camera.columns - 1) / 2),
            camera.spacing * (static_cast<double>(row) - static_cast<double>(camera.rows - 1) / 2), 0);
        const internal::Vector depth_axis(0, 0, -1);
        const internal::Vector origin = camera.is_perspective ? internal::Vector::Zero() : pixel;
        const internal::Vector direction =
            camera.is_perspective ? (pixel + focus * depth_axis).normalized() : depth_axis;

        const internal::Ray_caster::Hit hit =
            m_rays.first_hit(scene_from_sensor(origin), scene_from_sensor.rotation * direction);
        if (!(hit.distance > 0)) continue;
        const internal::Counter_random line = random.stream(row * camera.columns + column);
        const double grazing = 1 - hit.cosine;
        const double lost =
            camera.drop_out + (camera.grazing_drop_out - camera.drop_out) * grazing * grazing * grazing * grazing;
        if (line.uniform(0) < lost) continue;
        double distance = hit.distance + camera.noise * camera.spacing * line.normal(1);
        if (const double step = camera.quantization * camera.spacing; step > 0)
          distance = step * std::round(distance / step);
        if (!(distance > 0)) continue;
        const internal::Vector p = origin + distance * direction;
        result.image.set_sample(column, row, Point_3(p.x(), p.y(), p.z()));
      }
    return result;
  }

private:
  internal::Ray_caster m_rays;
};

/*!
\ingroup PkgCrudeRegistrationRef

\brief makes the range image that a scanner would take of a mesh.

Each line of sight of the camera's grid is followed to the first face it meets. The sample found there is lost with the
probability the camera says, or moved along the line of sight by the camera's noise and rounding. The result is the
same, bit by bit, for the same input.

The time is one ray query a cell, \f$O(\log n)\f$ each on usual meshes of \f$n\f$ faces, after the construction of a
`Simulated_scene`, which is better kept where several cameras look at the same mesh.

\tparam FaceGraph a model of `FaceListGraph`
\tparam Kernel a model of `Kernel`
\tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"

\param mesh the scene, a triangle mesh; both sides of its faces are seen
\param camera the camera
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below

\cgalNamedParamsBegin
  \cgalParamNBegin{vertex_point_map}
    \cgalParamDescription{a property map associating points to the vertices of `mesh`}
    \cgalParamType{a class model of `ReadablePropertyMap` with `boost::graph_traits<FaceGraph>::%vertex_descriptor`
                   as key type and a `Point_3` as value type}
    \cgalParamDefault{`boost::get(CGAL::vertex_point, mesh)`}
  \cgalParamNEnd
\cgalNamedParamsEnd

\return the range image in the sensor's own frame, and the motion from there to the frame of `mesh`. It has no sample
where the camera sees nothing.

\throws std::invalid_argument if `mesh` has no face of positive area, a face that is not a triangle, or a coordinate
that is not finite, or a value of `camera` is out of range.
*/
template <class FaceGraph, class Kernel, class NamedParameters = parameters::Default_named_parameters>
Simulated_range_image<Kernel> simulate_range_image(const FaceGraph& mesh, const Range_camera<Kernel>& camera,
                                                   const NamedParameters& np = parameters::default_values())
{
  return Simulated_scene(mesh, np).range_image(camera);
}

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_SIMULATION_SIMULATE_RANGE_IMAGE_H
