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
#include "calib/velodyne/velodyne_calibration.hpp"

namespace terracut::calib {

/// The calibration of one unit of any sensor that terracut decodes.
using SensorCalibration = std::variant<hdl64e::Hdl64eCalibration, ruby128::Ruby128Calibration,
                                       velodyne::VelodyneCalibration>;

/// The next three return fingerprint(), `origin` and ring_profile() of the calibration held.
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
