// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "calib/hdl64e_calibration.hpp"
#include "calib/mount.hpp"
#include "calib/ring_profile.hpp"
#include "calib/ruby128_calibration.hpp"

namespace terracut::calib {

/// The calibration of one unit of any sensor that terracut decodes.
using SensorCalibration = std::variant<Hdl64eCalibration, Ruby128Calibration>;

/// fingerprint(), `origin` and ring_profile() of whichever it is.
[[nodiscard]] inline std::uint64_t fingerprint(const SensorCalibration& calibration) {
  return std::visit([](const auto& unit) { return fingerprint(unit); }, calibration);
}
[[nodiscard]] inline const std::string& origin_of(const SensorCalibration& calibration) {
  return std::visit([](const auto& unit) -> const std::string& { return unit.origin; },
                    calibration);
}
[[nodiscard]] inline RingProfile ring_profile(const SensorCalibration& calibration,
                                              const Mount& mount) {
  return std::visit([&](const auto& unit) { return ring_profile(unit, mount); }, calibration);
}

}  // namespace terracut::calib
