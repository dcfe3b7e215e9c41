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

#include <CGAL/Crude_registration/IO/internal/move_file_impl.h>
#include <CGAL/Crude_registration/IO/internal/read_flat_scan_impl.h>
#include <CGAL/Crude_registration/IO/internal/scan_bytes_impl.h>
#include <CGAL/Crude_registration/IO/read_scan.h>
#include <CGAL/Crude_registration/IO/triangulate_scan.h>

namespace CGAL {
namespace Crude_registration {

template Scan_file<Exact_predicates_inexact_constructions_kernel>
read_scan<Exact_predicates_inexact_constructions_kernel>(const std::string&, const Depth_camera&);
template CGAL::Surface_mesh<Exact_predicates_inexact_constructions_kernel::Point_3>
triangulate_scan(const Scan_file<Exact_predicates_inexact_constructions_kernel>&,
                 const parameters::Default_named_parameters&);

} // namespace Crude_registration
} // namespace CGAL
