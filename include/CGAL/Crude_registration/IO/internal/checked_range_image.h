// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CRUDE_REGISTRATION_IO_INTERNAL_CHECKED_RANGE_IMAGE_H
#define CGAL_CRUDE_REGISTRATION_IO_INTERNAL_CHECKED_RANGE_IMAGE_H

// A range image made of what a file holds, its faults told as those of the file.

#include <CGAL/Crude_registration/IO/IO_error.h>
#include <CGAL/Crude_registration/Range_image.h>

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// What an image refuses is an error of the file.
template <class Kernel>
Range_image<Kernel> checked_range_image(std::size_t columns, std::size_t rows,
                                        std::vector<typename Kernel::Point_3>&& points,
                                        std::vector<std::int32_t>&& grid, const std::string& file)
{
  try {
    return Range_image<Kernel>(columns, rows, std::move(points), std::move(grid));
  } catch (const std::invalid_argument& e) {
    throw IO_error(file, e.what());
  }
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_INTERNAL_CHECKED_RANGE_IMAGE_H
