// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <pybind11/numpy.h>

#include <span>

#include "terracut/free_way.hpp"

namespace terracut::python {

/// Returns an array of one record per sector of a free way: azimuth_rad obstacle_m seen_m seen_end,
/// the last a number of SeenEnd. With a `base`, which must keep the sectors, it is a view of them,
/// else a copy.
[[nodiscard]] pybind11::array array_of_sectors(std::span<const FreeWaySector> sectors,
                                               const pybind11::object& base);

}  // namespace terracut::python
