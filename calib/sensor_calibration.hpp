// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "calib/hdl64e/hdl64e_calibration.hpp"
#include "calib/mount/mount.hpp"
#include "calib/mount/ring_profile.hpp"
#include "calib/ruby128/ruby128_calibration.hpp"
#include "calib/sensor/sensor_model.hpp"
#include "calib/velodyne/velodyne_calibration.hpp"

namespace terracut::calib {

/// The calibration of one unit of any sensor that terracut decodes.
using SensorCalibration = std::variant<hdl64e::Hdl64eCalibration, ruby128::Ruby128Calibration,
                                       velodyne::VelodyneCalibration>;

/// A model's table where the unit's own is not at hand: the only one of those that
/// sensor::has_factory_table(), an RS-Ruby128's, and for every other model an HDL-64E's.
[[nodiscard]] SensorCalibration nominal(sensor::SensorModel model);

/// The model whose calibration it is; of an HDL-64E the S2 and S3, which stand for all.
[[nodiscard]] sensor::SensorModel model_of(const SensorCalibration& calibration) noexcept;

/// fingerprint(), `origin` and ring_profile() of whichever it is.
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
