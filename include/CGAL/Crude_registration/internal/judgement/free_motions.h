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

#ifndef CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_FREE_MOTIONS_H
#define CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_FREE_MOTIONS_H

// The motions that an overlap leaves free: found, and put in words.

#include <CGAL/Crude_registration/internal/base/Rigid_motion.h>
#include <CGAL/Crude_registration/internal/base/symmetric_eigen.h>
#include <CGAL/Crude_registration/internal/judgement/Pose_judge.h>
#include <CGAL/Crude_registration/internal/judgement/Verdict.h>
#include <CGAL/Crude_registration/internal/motion/twist.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>
#include <string>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// The motions that an overlap leaves free, in words, and the kind of surface that leaves just these.
struct Free_motions
{
  std::string surface; // empty where no one kind does
  std::vector<std::string> motions;
};

// `free`: small motions (w, v), x -> x + w x x + v, that span all that is free. `centre`, `radius`: of the overlap, in
// the same frame; a motion is a translation where its turn moves the overlap by less than a seventh of what its shift
// does.
inline Free_motions name_free_motions(const std::vector<Vector_6>& free, const Vector& centre, double radius)
{
  Free_motions names;
  if (free.empty() || !(radius > 0)) return names;
  // In units of length, about the centre, orthonormal.
  const Eigen::Index n = Eigen::Index(free.size());
  Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 6> basis(6, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Vector w = free[std::size_t(k)].head<3>(), v = free[std::size_t(k)].tail<3>();
    basis.col(k) << radius * w, v + w.cross(centre);
    for (Eigen::Index i = 0; i < k; ++i) basis.col(k) -= basis.col(i).dot(basis.col(k)) * basis.col(i);
    basis.col(k).normalize();
  }
  // Its turns from the largest to none.
  const auto turns = symmetric_eigen(basis.topRows<3>().transpose() * basis.topRows<3>());
  basis = basis * turns.vectors.rowwise().reverse();

  const auto text = [](const Vector& v) {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out.precision(4);
    out << '(' << v.x() << ' ' << v.y() << ' ' << v.z() << ')';
    return out.str();
  };
  int translations = 0, rotations = 0;
  for (Eigen::Index k = 0; k < n; ++k) {
    const Vector w = basis.col(k).head<3>() / radius, v = basis.col(k).tail<3>();
    if (radius * w.norm() < 0.15) {
      ++translations;
      names.motions.push_back("translation along " + text(v.normalized()));
    } else {
      ++rotations;
      names.motions.push_back("rotation about " + text(w.normalized()) + " through " +
                              text(centre + w.cross(v) / w.squaredNorm()));
    }
  }
  if (translations == 2 && rotations == 1) names.surface = "a plane";
  else if (translations == 0 && rotations == 3) names.surface = "a sphere";
  else if (translations == 1 && rotations == 1) names.surface = "a cylinder";
  else if (translations == 0 && rotations == 1) names.surface = "a surface of revolution";
  else if (translations == 1 && rotations == 0) names.surface = "a surface of extrusion";
  return names;
}

// The small motions (w, v) that the scans leave free, most uncertain first: those two spacings of the simplified
// surface further along which, either way, the pose is so probable that were it a rival the first would not be
// believed. What the information matrix says is uncertain is where to look; whether it is free, the evidence says.
// `by`: what the pose was judged by.
inline std::vector<Vector_6> find_free_motions(const Pose_judge& judge, Judged_by by, const Rigid_motion& motion,
                                               const Matrix_6& covariance, const Vector& centre, double radius,
                                               double spacing)
{
  // In units of length, about the centre.
  const Matrix cross = cross_matrix(centre);
  Matrix_6 to_centre = Matrix_6::Identity(), from_centre = Matrix_6::Identity();
  to_centre.topLeftCorner<3, 3>() *= radius;
  to_centre.bottomLeftCorner<3, 3>() = -cross; // v + w x c
  from_centre.topLeftCorner<3, 3>() /= radius;
  from_centre.bottomLeftCorner<3, 3>() = cross / radius;
  const Symmetric_eigen<Matrix_6> eigen = symmetric_eigen(to_centre * covariance * to_centre.transpose());
  const Pose here = to_pose(motion);
  const auto weight_of = [&](const Pose& pose) { return judge.weight_along_motion(pose, by); };
  const double rival = weight_of(here) - std::log(believed / (1 - believed));
  // Whether a pose is still as far away as half of what it was moved by.
  const auto is_away = [&](const Pose& p) {
    const double turn = radius * double((p.rotation - here.rotation).norm()) / std::sqrt(2.);
    return std::hypot(turn, double((p.translation - here.translation).norm())) > spacing;
  };
  std::vector<Vector_6> free;
  for (int k = 5; k >= 0; --k) {
    const Vector_6 twist = from_centre * eigen.vectors.col(k);
    const auto moved = [&](double distance) {
      const Pose there = to_pose(exponential(twist, distance) * motion);
      const double weight = weight_of(there);
      if (weight >= rival) return weight;
      // The motion is known to some digits only; what is free stays where refinement finds it.
      const Pose refined = judge.refined(there);
      return is_away(refined) ? (std::max)(weight, weight_of(refined)) : weight;
    };
    if ((std::max)(moved(2 * spacing), moved(-2 * spacing)) < rival) break;
    free.push_back(twist);
  }
  return free;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_INTERNAL_JUDGEMENT_FREE_MOTIONS_H
