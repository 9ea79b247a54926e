// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

#include "calib/ouster/ouster_calibration.hpp"
#include "calib/sensor/sensor_model.hpp"

namespace terracut::ouster {

/// The lines of products, which differ in the elevations of their beams: 90, 45 and 22.5 degrees
/// from the highest to the lowest.
enum class Product : std::uint8_t { kOs0, kOs1, kOs2 };

/// Returns a table for use without a unit: evenly spaced beams, whose offsets and lengths are
/// those of a unit of the product. `model` is one of Ouster's.
[[nodiscard]] OusterCalibration nominal_product(Product product, sensor::SensorModel model);

}  // namespace terracut::ouster
