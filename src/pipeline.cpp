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

// The part pipeline of the compiled core.

#include <CGAL/Crude_registration/internal/judgement/compare_points_impl.h>
#include <CGAL/Crude_registration/internal/pipeline/Scaled_outcome_impl.h>
#include <CGAL/Crude_registration/internal/pipeline/register_reduced_scans_impl.h>
#include <CGAL/Crude_registration/register_scans.h>

namespace CGAL {
namespace Crude_registration {

template void Scan<>::prepare_image(const Range_image<Scan<>::Kernel>&, const parameters::Default_named_parameters&,
                                    const std::string&, internal::Run_control&);
template void Scan<>::prepare_points(const std::vector<Scan<>::Point_3>&, const std::vector<Scan<>::Vector_3>&,
                                     const Sensor<Scan<>::Kernel>&, const parameters::Default_named_parameters&,
                                     const std::string&, internal::Run_control&);
template void Scan<>::prepare(const internal::Flat_mesh&, const internal::Flat_sensor&,
                              const internal::Flat_range_image*, const parameters::Default_named_parameters&,
                              const int&, const std::string&, internal::Run_control&);

namespace internal {

template Registration_result<Scan<>::Kernel>
register_scans<CGAL::Sequential_tag>(const Scan<>&, const Scan<>&, const Oriented_pair_candidates&, Run_control&);
#ifdef CGAL_LINKED_WITH_TBB
template Registration_result<Scan<>::Kernel>
register_scans<CGAL::Parallel_tag>(const Scan<>&, const Scan<>&, const Oriented_pair_candidates&, Run_control&);
#endif

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL
