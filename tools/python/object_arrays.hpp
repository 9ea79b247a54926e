// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <pybind11/numpy.h>

#include <span>

#include "terracut/frame.hpp"

namespace terracut::python {

/// Returns an array of one record per object: returns first_return last_return bottom_m top_m
/// ground_z_m x_m y_m along_x along_y length_m width_m corner_count corners, the last (16, 2). With
/// a `base`, which must keep the objects, it is a view of them, else a copy.
[[nodiscard]] pybind11::array array_of_objects(std::span<const Object> objects,
                                               const pybind11::object& base);
/// The same of objects found while the sensor turns, each with its frame and last_packet_ns.
[[nodiscard]] pybind11::array array_of_objects(std::span<const CompleteObject> objects,
                                               const pybind11::object& base);

}  // namespace terracut::python
