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

#ifndef CGAL_CRUDE_REGISTRATION_ALL_HEADERS_H
#define CGAL_CRUDE_REGISTRATION_ALL_HEADERS_H

// The public headers of the package, for CGAL/Crude_registration.h.

#include <CGAL/Crude_registration/IO/Depth_camera.h>
#include <CGAL/Crude_registration/Assembly_result.h>
#include <CGAL/Crude_registration/Assembly_status.h>
#include <CGAL/Crude_registration/IO/IO_error.h>
#include <CGAL/Crude_registration/IO/apply_motion.h>
#include <CGAL/Crude_registration/IO/read_range_image.h>
#include <CGAL/Crude_registration/IO/read_scan.h>
#include <CGAL/Crude_registration/IO/save_scan.h>
#include <CGAL/Crude_registration/IO/triangulate_scan.h>
#include <CGAL/Crude_registration/IO/write_file.h>
#include <CGAL/Crude_registration/IO/write_range_image.h>
#include <CGAL/Crude_registration/Preparation_interrupted.h>
#include <CGAL/Crude_registration/Range_image.h>
#include <CGAL/Crude_registration/Registration_result.h>
#include <CGAL/Crude_registration/Judgement_limits.h>
#include <CGAL/Crude_registration/Registration_status.h>
#include <CGAL/Crude_registration/Scan.h>
#include <CGAL/Crude_registration/Sensor.h>
#include <CGAL/Crude_registration/judge_motion.h>
#include <CGAL/Crude_registration/assemble_by_processes.h>
#include <CGAL/Crude_registration/assemble_scans.h>
#include <CGAL/Crude_registration/compare_points.h>
#include <CGAL/Crude_registration/fused_points.h>
#include <CGAL/Crude_registration/matching/Oriented_pair_candidates.h>
#include <CGAL/Crude_registration/matching/Spatial_trihedron.h>
#include <CGAL/Crude_registration/matching/Trihedron_candidates.h>
#include <CGAL/Crude_registration/matching/match_trihedra.h>
#include <CGAL/Crude_registration/matching/spatial_trihedra.h>
#include <CGAL/Crude_registration/motion/refine_motion.h>
#include <CGAL/Crude_registration/motion/rigid_motion.h>
#include <CGAL/Crude_registration/named_parameters.h>
#include <CGAL/Crude_registration/reduction/Surface_type.h>
#include <CGAL/Crude_registration/reduction/approximation_error.h>
#include <CGAL/Crude_registration/reduction/principal_curvatures.h>
#include <CGAL/Crude_registration/reduction/scan_extent.h>
#include <CGAL/Crude_registration/reduction/simplify_scan.h>
#include <CGAL/Crude_registration/reduction/surface_types.h>
#include <CGAL/Crude_registration/register_meshes.h>
#include <CGAL/Crude_registration/register_scans.h>
#include <CGAL/Crude_registration/register_scans_with_scale.h>
#include <CGAL/Crude_registration/sampling/estimate_sensor.h>
#include <CGAL/Crude_registration/sampling/join_points.h>
#include <CGAL/Crude_registration/sampling/sampling_distance.h>
#include <CGAL/Crude_registration/sampling/triangulate_points.h>
#include <CGAL/Crude_registration/sampling/triangulate_range_image.h>
#include <CGAL/Crude_registration/simulation/make_statue.h>
#include <CGAL/Crude_registration/simulation/simulate_range_image.h>

#endif // CGAL_CRUDE_REGISTRATION_ALL_HEADERS_H
