// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "calib/beams/beam_table.hpp"
#include "calib/hdl64e/hdl64e_calibration.hpp"
#include "calib/mount/mount.hpp"
#include "calib/mount/ring_profile.hpp"
#include "calib/ruby128/ruby128_calibration.hpp"
#include "calib/sensor/sensor_model.hpp"

namespace terracut::calib {

/// The calibration of one unit, of any sensor that terracut decodes.
using SensorCalibration =
    std::variant<hdl64e::Hdl64eCalibration, ruby128::Ruby128Calibration, beams::BeamTable>;

/// Returns a model's table for use without the unit's own: the built-in one if
/// sensor::has_built_in_table(), the nominal one for an RS-Ruby128, and an HDL-64E's for every
/// other model.
[[nodiscard]] SensorCalibration nominal(sensor::SensorModel model);

/// Returns the model that `calibration` belongs to; kHdl64e for an HDL-64E of any generation.
[[nodiscard]] sensor::SensorModel model_of(const SensorCalibration& calibration) noexcept;

/// Each of these functions asks the table in the variant: for its fingerprint(), its `origin` or
/// its ring_profile().
[[nodiscard]] inline std::uint64_t fingerprint(const SensorCalibration& calibration) {
  return std::visit([](const auto& unit) { return fingerprint(unit); }, calibration);
}
[[nodiscard]] inline const std::string& origin_of(const SensorCalibration& calibration) {
  return std::visit([](const auto& unit) -> const std::string& { return unit.origin; },
                    calibration);
}
[[nodiscard]] inline mount::RingProfile ring_profile(const SensorCalibration& calibration,
                                                     const mount::Mount& mount) {
  return std::visit([&](const auto& unit) { return ring_profile(unit, mount); }, calibration);
}

}  // namespace terracut::calib
