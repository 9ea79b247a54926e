// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "calib/beams/beam_table.hpp"
#include "calib/hdl64e/hdl64e_calibration.hpp"
#include "calib/mount/mount.hpp"
#include "calib/mount/ring_profile.hpp"
#include "calib/ouster/ouster_calibration.hpp"
#include "calib/ruby128/ruby128_calibration.hpp"
#include "calib/sensor/sensor_model.hpp"

namespace terracut::calib {

/// The calibration of one unit, of any sensor that terracut decodes.
using SensorCalibration = std::variant<hdl64e::Hdl64eCalibration, ruby128::Ruby128Calibration,
                                       beams::BeamTable, ouster::OusterCalibration>;

/// Returns a model's table for use without the unit's own: the built-in one if
/// sensor::has_built_in_table(), the nominal one for an RS-Ruby128 or an Ouster, and an HDL-64E's
/// for every other model.
[[nodiscard]] SensorCalibration nominal(sensor::SensorModel model);

/// Returns the model that `calibration` belongs to; kHdl64e for an HDL-64E of any generation.
[[nodiscard]] sensor::SensorModel model_of(const SensorCalibration& calibration) noexcept;

/// How a sensor rotates whose calibration says so.
struct Rotation {
  int columns = 0;     ///< Firings of a laser in a frame.
  double spin_hz = 0;  ///< Frames a second.
  /// The columns [from, to) for which nothing is sent; `to` may count on past the frame's end.
  int blind_from = 0, blind_to = 0;
};
/// Returns how an Ouster rotates; nothing for other sensors, whose packets show it.
[[nodiscard]] std::optional<Rotation> rotation_of(const SensorCalibration& calibration) noexcept;

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
