// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "calib/sensor/sensor_model.hpp"
#include "calib/sensor_calibration.hpp"
#include "firmware_io/capture/capture_source.hpp"
#include "rt/error.hpp"

namespace terracut::sensor {

/// Sources of a unit's calibration besides its own packets.
struct CalibrationChoice {
  /// A calibration known already; must be of the model.
  std::optional<calib::SensorCalibration> unit{};
  /// File of an HDL-64E (xml or yaml), a RoboSense or a Hesai (csv), or an Ouster (json); empty:
  /// none.
  std::filesystem::path file{};
  bool allows_nominal = false;  ///< Allows the nominal table of an RS-Ruby128 as the last resort.

  [[nodiscard]] bool is_given() const noexcept { return unit.has_value() || !file.empty(); }
};

/// Returns the calibration from the unit's packets, or why there is none and what to do.
using FromPackets = std::function<Expected<calib::SensorCalibration>()>;

/// Returns the unit's calibration: the first of choice.unit, the model's factory table, the file,
/// a Hesai's nominal table, the packets, and the nominal table if allowed. `from_packets` is called
/// only if the first four are missing; its error is returned if nothing is found.
[[nodiscard]] Expected<calib::SensorCalibration> unit_calibration(const CalibrationChoice& choice,
                                                                  SensorModel model,
                                                                  const FromPackets& from_packets);

/// Returns what to do for a RoboSense whose packets do not hold its angles: "Give ...".
[[nodiscard]] std::string what_to_give(SensorModel model);
/// Fails with kNoCalibration for an HDL-64E S1 heard at `place`: its packets never contain one.
[[nodiscard]] tl::unexpected<Error> fail_for_s1(const std::string& place);
/// The same for an Ouster without metadata.
[[nodiscard]] tl::unexpected<Error> fail_for_ouster(const std::string& place);

/// Returns the calibration of a capture's unit. Its packets may hold it, in an HDL-64E's status
/// stream or in DIFOP packets. If they do not, fails with kNoCalibration; the message says what was
/// found instead. Leaves `source` at any position.
[[nodiscard]] Expected<calib::SensorCalibration> unit_calibration(const CalibrationChoice& choice,
                                                                  SensorModel model,
                                                                  capture::CaptureSource& source);

}  // namespace terracut::sensor
