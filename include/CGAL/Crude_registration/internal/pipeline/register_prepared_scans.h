// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_PIPELINE_REGISTER_PREPARED_SCANS_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_PIPELINE_REGISTER_PREPARED_SCANS_H

#include <CGAL/Crude_registration/Registration_result.h>
#include <CGAL/Crude_registration/internal/matching/Pose_search.h>
#include <CGAL/Crude_registration/internal/judgement/free_motions.h>
#include <CGAL/Crude_registration/internal/motion/point_to_plane.h>
#include <CGAL/Crude_registration/internal/base/symmetric_eigen.h>

#include <chrono>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// A target of refine(): the fine surfels' planes.
class Surfel_target
{
public:
  explicit Surfel_target(const Surfel_level& level) : m_level(level) {}

  bool closest(const Vector& query, double reach, Surface_point& answer) const
  {
    const int i = m_level.field.nearest(query.cast<float>());
    if (i < 0) return false;
    const Surfel& s = m_level.surfels[std::size_t(i)];
    const Vector n = s.normal.cast<double>(), d = query - s.position.cast<double>();
    const double height = n.dot(d);
    const double aside = (d - height * n).norm();
    if (std::abs(height) > reach || aside > 1.2 * double(m_level.spacing)) return false;
    answer = {query - height * n, n, false};
    return true;
  }

private:
  const Surfel_level& m_level;
};

// What is to be believed of the poses that were found.
struct Verdict
{
  Registration_status status = NOT_REGISTERED;
  std::string reason;
  double confidence = 0;
  std::vector<std::string> free_motions;
};

// How the scans fit in the best pose once it is refined.
struct Fit
{
  double surfels = 0;           // fine ones of the smaller scan
  double residual = 0;          // in sampling distances
  double misfit = 0;            // in units of the scans' own noise
  std::size_t weak_motions = 0; // that the correspondences hardly determine, as matches by chance are of smooth pieces
};

struct Registration_outcome
{
  std::vector<Judged_pose> poses;          // distinct, best first; in own frames, see to_input()
  bool is_swapped = false;                 // the poses map the target to the source
  Rigid_motion source_frame, target_frame; // own from input, of what the poses call source and target
  Rigid_motion crude, motion;              // target from source, in the frames of the input
  Refinement refinement;                   // in own frames
  double overlap = 0, residual = 0;
  bool source_has_free_space = false, target_has_free_space = false;
  Fit fit;
  Matrix_6 covariance = Matrix_6::Zero(); // in the frames of the input
  Free_motions free_motions;              // in the frame of the input of what the poses call target
  Verdict verdict;
  Search_counts counts;
  double search_seconds = 0, refine_seconds = 0;

  Rigid_motion to_input(const Rigid_motion& own) const
  {
    const Rigid_motion in_input = target_frame.inverse() * own * source_frame;
    return is_swapped ? in_input.inverse() : in_input;
  }
};

inline Rigid_motion to_rigid_motion(const Pose& pose)
{
  Rigid_motion m;
  // A float's rotation is orthogonal to seven digits only.
  m.rotation = Eigen::Quaterniond(Matrix(pose.rotation.cast<double>())).normalized().toRotationMatrix();
  m.translation = pose.translation.cast<double>();
  return m;
}

inline Pose to_pose(const Rigid_motion& motion)
{
  return {motion.rotation.cast<float>(), motion.translation.cast<float>()};
}

// The scan with fewer surfels is looked for in the other one; equal ones are told apart by size, so that swapping the
// arguments gives the inverse.
inline bool are_swapped(const Prepared_scan& source, const Prepared_scan& target)
{
  if (source.coarse.surfels.size() != target.coarse.surfels.size())
    return source.coarse.surfels.size() > target.coarse.surfels.size();
  return source.extent > target.extent;
}

// The confidence from which on a motion is worth an answer.
constexpr double plausible = 0.5;

// The share of the best score from which on a distinct pose is as good as the best one.
constexpr double as_good = 0.85;

// How many distinct poses explain the scans as well as the best one, with it.
// \pre There is a pose.
inline std::size_t number_of_equals(const std::vector<Judged_pose>& poses)
{
  return std::size_t(1 + std::count_if(poses.begin() + 1, poses.end(), [&](const Judged_pose& p) {
                       return double(p.score()) >= as_good * double(poses.front().score());
                     }));
}

// The confidence in the best pose if it has no equals: a logistic function of the number of surfels that agree, not
// their share, as two small smooth pieces fit each other by chance; the surfels in free space for each of them; the
// lead over the next distinct pose; and the residuals. Wrong poses fill the reach of the refinement evenly, whatever
// the noise; right ones have misfits to about 2, whatever the overlap. The coefficients are those that separate right
// from wrong answers, in pairs of real and generated scans of a thousand to some hundred thousand samples, with free
// space and without.
inline double confidence_without_equals(const std::vector<Judged_pose>& poses, const Fit& fit)
{
  if (poses.empty() || !(poses.front().score() > 0)) return 0;
  const double score = double(poses.front().score());
  const double lag = poses.size() > 1 ? (std::max)(0., double(poses[1].score())) / score : 0;
  const double in_free_space = double(poses.front().violations) / double(poses.front().tight);
  const double evidence = 4 * std::log(fit.surfels * score) - 45 * (std::min)(in_free_space, 0.4) - 3.5 * lag -
                          4.2 * (std::min)(fit.misfit, 4.) - 6 * fit.residual - double(fit.weak_motions) - 13;
  return 1 / (1 + std::exp(-evidence));
}

inline Verdict judge_poses(const std::vector<Judged_pose>& poses, const Fit& fit, const Free_motions& free)
{
  Verdict verdict;
  if (poses.empty()) {
    verdict.reason = "no overlap found: no motion brings any part of the scans together";
    return verdict;
  }
  constexpr double believed = 0.9;
  const double confidence = confidence_without_equals(poses, fit);
  const std::size_t equals = number_of_equals(poses);
  verdict.confidence = confidence / double(equals);
  if (confidence < plausible) {
    verdict.reason = "no overlap found that cannot be by chance";
  } else if (!free.motions.empty()) {
    verdict.status = AMBIGUOUS;
    verdict.confidence = (std::min)(verdict.confidence, 0.5); // any other pose along the free motions is as good
    verdict.free_motions = free.motions;
    verdict.reason = free.surface.empty() ? "the overlap leaves motions free" : "the overlap is " + free.surface;
  } else if (verdict.confidence >= believed) {
    verdict.status = REGISTERED;
  } else {
    verdict.status = AMBIGUOUS;
    verdict.reason = equals > 1 ? "several distinct motions bring the scans together equally well"
                                : "the best motion may be by chance";
  }
  return verdict;
}

// What is to be believed of poses whose rivals have not all been looked for.
inline Verdict interrupted(const std::vector<Judged_pose>& poses, const Fit& fit)
{
  Verdict verdict;
  const double confidence = confidence_without_equals(poses, fit);
  const bool is_plausible = confidence >= plausible;
  verdict.confidence = (std::min)(0.5, confidence); // a rival may be as good
  verdict.status = is_plausible ? AMBIGUOUS : NOT_REGISTERED;
  verdict.reason = is_plausible ? "interrupted: the best motion so far" : "interrupted: no overlap found so far";
  return verdict;
}

// The noise of a level, in the unit of length; what sampling alone makes up is at least a fiftieth of the spacing.
inline double noise(const Surfel_level& level)
{
  return double(level.spacing) * (std::max)(double(level.height_noise), 0.02);
}

// How the small motion x -> x + w x x + v reads in the frame that `motion` maps to: of (w, v), in this order.
inline Matrix_6 adjoint(const Rigid_motion& motion)
{
  const Vector& t = motion.translation;
  Matrix cross;
  cross << 0, -t.z(), t.y(), t.z(), 0, -t.x(), -t.y(), t.x(), 0;
  Matrix_6 a = Matrix_6::Zero();
  a.topLeftCorner<3, 3>() = a.bottomRightCorner<3, 3>() = motion.rotation;
  a.bottomLeftCorner<3, 3>() = cross * motion.rotation;
  return a;
}

// The share of a scan's surface that has the other one close by, facing the same way. `pose`: target from source.
inline double overlap(const Prepared_scan& source, const Prepared_scan& target, const Pose& pose)
{
  std::vector<std::int32_t> some = shuffled(source.fine.surfels.size(), 3);
  if (some.size() > 3000) some.resize(3000);
  const float spacing = (std::max)(source.fine.spacing, target.fine.spacing);
  return double(agreement(source, source.fine, some, target, target.fine, std::vector<std::int32_t>(), pose, spacing,
                          0.7f, spacing)
                    .overlap);
}

// The motion along `twist` = (w, v), x -> x + w x x + v, for the time `t`.
inline Rigid_motion exponential(const Vector_6& twist, double t)
{
  const Vector w = t * twist.head<3>(), v = t * twist.tail<3>();
  const double angle = w.norm();
  Rigid_motion m;
  m.translation = v;
  if (angle < 1e-12) return m;
  const Vector axis = w / angle;
  m.rotation = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  m.translation = std::sin(angle) / angle * v + (1 - std::cos(angle)) / angle * axis.cross(v) +
                  (1 - std::sin(angle) / angle) * axis.dot(v) * axis;
  return m;
}

// The small motions (w, v) that leave the scans in agreement, most uncertain first: those along which they agree as
// well two spacings of the simplified surface further on, either way. What the information matrix says is uncertain is
// where to look; whether it is free, the surfaces themselves say.
template <class Search>
std::vector<Vector_6> free_motions(const Search& search, const Rigid_motion& motion, const Matrix_6& covariance,
                                   const Vector& centre, double radius, double spacing)
{
  // In units of length, about the centre.
  Matrix cross;
  cross << 0, -centre.z(), centre.y(), centre.z(), 0, -centre.x(), -centre.y(), centre.x(), 0;
  Matrix_6 to_centre = Matrix_6::Identity(), from_centre = Matrix_6::Identity();
  to_centre.topLeftCorner<3, 3>() *= radius;
  to_centre.bottomLeftCorner<3, 3>() = -cross; // v + w x c
  from_centre.topLeftCorner<3, 3>() /= radius;
  from_centre.bottomLeftCorner<3, 3>() = cross / radius;
  const Symmetric_eigen<Matrix_6> eigen = symmetric_eigen(to_centre * covariance * to_centre.transpose());
  constexpr float as_well = 0.75f;
  const float there = search.assess(to_pose(motion)).score();
  std::vector<Vector_6> free;
  for (int k = 5; k >= 0; --k) {
    const Vector_6 twist = from_centre * eigen.vectors.col(k);
    const auto score = [&](double distance) {
      return search.assess(to_pose(exponential(twist, distance) * motion)).score();
    };
    if (!((std::max)(score(2 * spacing), score(-2 * spacing)) > as_well * there)) break;
    free.push_back(twist);
  }
  return free;
}

// a and b are source and target.
template <class ConcurrencyTag = CGAL::Sequential_tag>
Registration_outcome register_prepared_scans(const Prepared_scan& a, const Prepared_scan& b,
                                             const Search_parameters& parameters, Run_control& control)
{
  Registration_outcome outcome;
  outcome.source_has_free_space = a.depths.is_known();
  outcome.target_has_free_space = b.depths.is_known();
  outcome.is_swapped = are_swapped(a, b);
  const Prepared_scan &source = outcome.is_swapped ? b : a, &target = outcome.is_swapped ? a : b;
  outcome.source_frame = source.own_from_input;
  outcome.target_frame = target.own_from_input;
  constexpr std::size_t fewest_surfels = 4;
  if (source.coarse.surfels.size() < fewest_surfels) {
    outcome.verdict.reason = std::string("too few vertices: the surface of the ") +
                             (outcome.is_swapped ? "target" : "source") + " is too small for its samples";
    return outcome;
  }
  const auto start = std::chrono::steady_clock::now();
  Pose_search<ConcurrencyTag> search(source, target, parameters, control);
  outcome.poses = search();
  outcome.counts = search.counts();
  const auto middle = std::chrono::steady_clock::now();
  outcome.search_seconds = std::chrono::duration<double>(middle - start).count();
  if (!outcome.poses.empty()) {
    std::vector<Vector> points, normals;
    for (const std::int32_t i : source.fine.probes) {
      const Surfel& s = source.fine.surfels[std::size_t(i)];
      points.push_back(s.position.cast<double>());
      normals.push_back(s.normal.cast<double>());
    }
    const Surfel_target surface(target.fine);
    Refinement_options options{};
    options.sampling_distance = (std::max)(source.spacing, target.spacing);
    options.reach = 2 * options.sampling_distance;
    options.tolerance = 1e-2; // of a sampling distance: far below the noise
    Point_to_plane<ConcurrencyTag, Surfel_target> refine(points, normals, surface, options);
    const Rigid_motion crude = to_rigid_motion(outcome.poses.front().pose);
    outcome.refinement = refine(crude);
    outcome.crude = outcome.to_input(crude);
    outcome.motion = outcome.to_input(outcome.refinement.motion);
    outcome.residual = outcome.refinement.residual / options.sampling_distance;
    const Rigid_motion& own = outcome.refinement.motion;
    outcome.overlap =
        outcome.is_swapped ? overlap(target, source, to_pose(own.inverse())) : overlap(source, target, to_pose(own));
    const Matrix_6 target_to_input = adjoint(outcome.target_frame.inverse());
    const double radius = 0.25 * source.extent;
    std::vector<Vector_6> free = free_motions(search, own, outcome.refinement.covariance, own.translation, radius,
                                              double(source.coarse.spacing));
    for (Vector_6& m : free) m = target_to_input * m;
    outcome.free_motions = name_free_motions(free, outcome.target_frame.inverse()(own.translation), radius);
    // The deviation follows the motion; seen from the other side it goes through the inverse.
    const Matrix_6 to_input =
        outcome.is_swapped ? Matrix_6(adjoint(outcome.motion) * target_to_input) : target_to_input;
    const Matrix_6 covariance = to_input * outcome.refinement.covariance * to_input.transpose();
    outcome.covariance = 0.5 * (covariance + covariance.transpose()); // to the last bit
    outcome.fit = {double((std::min)(source.fine.surfels.size(), target.fine.surfels.size())), outcome.residual,
                   outcome.refinement.residual / (std::max)(noise(source.fine), noise(target.fine)),
                   outcome.refinement.free_motions.size()};
  }
  outcome.verdict = control.is_stopped() ? interrupted(outcome.poses, outcome.fit)
                                         : judge_poses(outcome.poses, outcome.fit, outcome.free_motions);
  outcome.refine_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - middle).count();
  return outcome;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_PIPELINE_REGISTER_PREPARED_SCANS_H
