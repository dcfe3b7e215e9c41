// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_MOTION_REFINE_MOTION_H
#define CGAL_CRUDE_REGISTRATION_MOTION_REFINE_MOTION_H

#include <CGAL/Crude_registration/internal/mesh/mesh_geometry.h>
#include <CGAL/Crude_registration/internal/motion/point_to_plane.h>
#include <CGAL/Crude_registration/internal/reduction/scan_frame.h>
#include <CGAL/Crude_registration/named_parameters.h>

#include <CGAL/Kd_tree.h>
#include <CGAL/Kernel_traits.h>
#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/Search_traits_adapter.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/tags.h>

#include <Eigen/LU>
#include <Eigen/SVD>

#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Crude_registration {

/*!
\ingroup PkgCrudeRegistrationRef

What refine_motion() returns.
*/
template <class Kernel>
struct Refined_motion
{
  /// The rigid motion that maps the source into the frame of the target.
  Aff_transformation_3<Kernel> motion;
  /// Number of iterations: searches for correspondences followed by a step.
  std::size_t iterations;
  /// Whether the last step was shorter than the tolerance; `false` where the iterations ran out or fewer than six
  /// correspondences were left.
  bool is_converged;
  /// The sampling distance \f$ s \f$ used, in the unit of the coordinates.
  double sampling_distance;
  /// RMS distance of the corresponding points along their normals, in sampling distances.
  double residual;
  /// Share of the source's vertices that have the target within two sampling distances and its normal within 45
  /// degrees.
  double overlap;
  /// Number of independent small motions that the correspondences leave free: 3 on a plane or a sphere, 2 on a
  /// cylinder, 1 on a surface of revolution, 0 where the motion is determined.
  int number_of_free_motions;
  /// Covariance of the small motion \f$ x \rightarrow x + \omega \times x + v \f$ that follows `motion`, in the order
  /// \f$ (\omega, v) \f$: radians about the axes through the target's origin, and its displacement. It takes the errors
  /// of the correspondences as independent; systematic errors of the scanner are not in it. Along a free motion the
  /// standard deviation is the RMS radius of the matched points; infinite on the diagonal where there are none.
  Eigen::Matrix<double, 6, 6> covariance;
};

namespace internal {

// The vertices of a mesh in a Kd tree of CGAL, as a target of Point_to_plane.
class Vertex_tree
{
  using Kernel = Simple_cartesian<double>;
  using Point = Kernel::Point_3;

  struct Point_map
  {
    using key_type = std::int32_t;
    using value_type = Point;
    using reference = const Point&;
    using category = boost::lvalue_property_map_tag;
    const std::vector<Point>* points;

    const Point& operator[](key_type i) const { return (*points)[std::size_t(i)]; }
    friend const Point& get(const Point_map& map, key_type i) { return map[i]; }
  };

  using Traits_3 = Search_traits_3<Kernel>;
  using Traits = Search_traits_adapter<std::int32_t, Point_map, Traits_3>;
  using Search = Orthogonal_k_neighbor_search<Traits>;

public:
  explicit Vertex_tree(const Flat_mesh& mesh)
      : m_normals(vertex_normals(mesh)), m_is_border(border_flags(mesh)), m_points(to_points(mesh.points)),
        m_distance(Point_map{&m_points}), m_tree(Search::Splitter(), Traits(Point_map{&m_points}))
  {
    for (std::size_t i = 0; i < m_points.size(); ++i)
      if (!m_normals[i].isZero()) m_tree.insert(std::int32_t(i));
    if (!m_tree.empty()) m_tree.build();
  }

  Vertex_tree(const Vertex_tree&) = delete;
  Vertex_tree& operator=(const Vertex_tree&) = delete;

  bool empty() const { return m_tree.empty(); }

  bool closest(const Vector& query, double reach, Surface_point& answer) const
  {
    const Search search(m_tree, Point(query.x(), query.y(), query.z()), 1, 0, true, m_distance);
    if (search.begin() == search.end() || !(search.begin()->second <= reach * reach)) return false;
    const std::size_t i = std::size_t(search.begin()->first);
    answer = {Vector(m_points[i].x(), m_points[i].y(), m_points[i].z()), m_normals[i], m_is_border[i] != 0};
    return true;
  }

private:
  static std::vector<Point> to_points(const std::vector<Vector>& vectors)
  {
    std::vector<Point> points;
    points.reserve(vectors.size());
    for (const Vector& v : vectors) points.emplace_back(v.x(), v.y(), v.z());
    return points;
  }

  std::vector<Vector> m_normals;
  std::vector<std::uint8_t> m_is_border;
  std::vector<Point> m_points;
  typename Search::Distance m_distance;
  typename Search::Tree m_tree;
};

// RMS distance of points from their mean.
inline double rms_radius(const std::vector<Vector>& points)
{
  if (points.empty()) return 0;
  Vector mean = Vector::Zero();
  for (const Vector& p : points) mean += (p - points.front()) / double(points.size());
  mean += points.front();
  double sum = 0;
  for (const Vector& p : points) sum += (p - mean).squaredNorm() / double(points.size());
  return std::sqrt(sum);
}

// The rigid motion next to an affine transformation that was written with three digits or more.
template <class Kernel>
Rigid_motion rigid_argument(const Aff_transformation_3<Kernel>& transformation, const char* function,
                            const char* argument)
{
  Rigid_motion motion = to_rigid_motion(transformation);
  const Matrix& r = motion.rotation;
  const bool is_rigid = motion.translation.allFinite() && r.allFinite() &&
                        (r.transpose() * r - Matrix::Identity()).cwiseAbs().maxCoeff() < 1e-3 && r.determinant() > 0;
  if (!is_rigid) throw std::invalid_argument(std::string(function) + ": " + argument + " is not a rigid motion");
  const Eigen::JacobiSVD<Matrix> svd(r, Eigen::ComputeFullU | Eigen::ComputeFullV);
  motion.rotation = svd.matrixU() * svd.matrixV().transpose();
  return motion;
}

} // namespace internal

/*!
\ingroup PkgCrudeRegistrationRef

Refines a rigid motion that already maps `source` close to `target`, by robust point-to-plane registration.

Each iteration pairs every vertex of the source with the closest vertex of the target (in a Kd tree), leaves out
pairs that are too far apart, whose normals differ by more than 45 degrees or whose target vertex lies on the border
(Rusinkiewicz and Levoy 2001), weighs the rest by Tukey's biweight at the scale of the median residual, and takes one
Gauss-Newton step on the distances of the pairs along their common normals: Chen and Medioni's point-to-plane
distance in the symmetric form of Rusinkiewicz 2019, which needs fewer iterations on curved surfaces. The reach of
the correspondences shrinks with their median distance from `maximum_distance` down to two sampling distances.

The iteration stops as soon as a step displaces the corresponding points by no more than `tolerance` sampling
distances (RMS). Motions about which the correspondences say nothing, such as sliding along a plane, are left as they
are in `initial_motion`.

\tparam ConcurrencyTag `CGAL::Sequential_tag` (default), `CGAL::Parallel_tag` or `CGAL::Parallel_if_available_tag`;
the result is the same, bit for bit
\tparam SourceGraph, TargetGraph models of `FaceListGraph` with triangle faces
\tparam NamedParameters1, NamedParameters2 sequences of \ref bgl_namedparameters "Named Parameters"

\param source the mesh to be moved
\param target the mesh that stays; faces of both are oriented alike, outwards or towards the sensor
\param initial_motion maps `source` into the frame of `target`
\param np_source, np_target optional sequences of \ref bgl_namedparameters "Named Parameters" among the ones listed
below

\cgalNamedParamsBegin
  \cgalParamNBegin{vertex_point_map}
    \cgalParamDescription{a property map associating points to the vertices of the mesh; read from both sequences}
    \cgalParamType{a class model of `ReadablePropertyMap` with `boost::graph_traits<Graph>::%vertex_descriptor` as key
                   type and a `Point_3` as value type}
    \cgalParamDefault{`boost::get(CGAL::vertex_point, graph)`}
  \cgalParamNEnd
  \cgalParamNBegin{maximum_distance}
    \cgalParamDescription{how far apart corresponding points may lie under `initial_motion`, in the unit of the
                          coordinates; not below two sampling distances; read from `np_source`}
    \cgalParamType{double}
    \cgalParamDefault{a fifth of the RMS radius of the target}
  \cgalParamNEnd
  \cgalParamNBegin{sampling_distance}
    \cgalParamDescription{the sampling distance of the coarser mesh, in the unit of the coordinates; read from
                          `np_source`}
    \cgalParamType{double}
    \cgalParamDefault{the larger one of the median edge lengths}
  \cgalParamNEnd
  \cgalParamNBegin{tolerance}
    \cgalParamDescription{the step, in sampling distances, that ends the iteration; read from `np_source`}
    \cgalParamType{double}
    \cgalParamDefault{0.05, a fraction of what range scanners resolve}
  \cgalParamNEnd
  \cgalParamNBegin{number_of_iterations}
    \cgalParamDescription{the largest number of iterations; read from `np_source`}
    \cgalParamType{unsigned int}
    \cgalParamDefault{50}
  \cgalParamNEnd
\cgalNamedParamsEnd

\return the refined motion, which maps `source` into the frame of `target`, with what tells how good it is

\throws std::invalid_argument if a mesh has no face with an area, a face that is not a triangle or a coordinate that
is not finite, if `initial_motion` is not rigid, or if a parameter is not a positive number

For \f$ n \f$ vertices, \f$ O(n \log n) \f$ an iteration.
*/
template <class ConcurrencyTag = Sequential_tag, class SourceGraph, class TargetGraph, class Kernel,
          class NamedParameters1 = parameters::Default_named_parameters,
          class NamedParameters2 = parameters::Default_named_parameters>
Refined_motion<Kernel> refine_motion(const SourceGraph& source, const TargetGraph& target,
                                     const Aff_transformation_3<Kernel>& initial_motion,
                                     const NamedParameters1& np_source = parameters::default_values(),
                                     const NamedParameters2& np_target = parameters::default_values())
{
#ifndef CGAL_LINKED_WITH_TBB
  static_assert(!std::is_convertible<ConcurrencyTag, Parallel_tag>::value,
                "Parallel_tag is enabled but TBB is unavailable.");
#endif
  const char* const function = "refine_motion";
  const internal::Flat_mesh source_mesh =
      internal::to_flat_mesh(source, internal::cgal_parameters(np_source), function, "source");
  const internal::Flat_mesh target_mesh =
      internal::to_flat_mesh(target, internal::cgal_parameters(np_target), function, "target");
  const internal::Rigid_motion initial = internal::rigid_argument(initial_motion, function, "initial_motion");

  const std::vector<internal::Vector> normals = internal::vertex_normals(source_mesh);
  const internal::Vertex_tree tree(target_mesh);
  const auto has_area = [](const internal::Vector& normal) { return !normal.isZero(); };
  if (std::none_of(normals.begin(), normals.end(), has_area))
    throw std::invalid_argument("refine_motion: source has no face with an area");
  if (tree.empty()) throw std::invalid_argument("refine_motion: target has no face with an area");

  internal::Refinement_options options;
  options.sampling_distance = internal::positive_parameter(
      np_source, internal_np::sampling_distance,
      (std::max)(internal::median_edge_length(source_mesh), internal::median_edge_length(target_mesh)), function,
      "sampling_distance");
  options.reach =
      internal::positive_parameter(np_source, internal_np::maximum_distance,
                                   internal::rms_radius(target_mesh.points) / 5, function, "maximum_distance");
  options.tolerance =
      internal::positive_parameter(np_source, internal_np::tolerance, options.tolerance, function, "tolerance");
  options.maximum_number_of_iterations =
      internal::count_parameter(np_source, internal_np::number_of_iterations, options.maximum_number_of_iterations, 1,
                                function, "number_of_iterations");

  internal::Point_to_plane<ConcurrencyTag, internal::Vertex_tree> refine(source_mesh.points, normals, tree, options);
  const internal::Refinement r = refine(initial);
  return {internal::to_aff_transformation<Kernel>(r.motion),
          r.iterations,
          r.is_converged,
          options.sampling_distance,
          r.residual / options.sampling_distance,
          r.overlap,
          int(r.free_motions.size()),
          r.covariance};
}

} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_MOTION_REFINE_MOTION_H
