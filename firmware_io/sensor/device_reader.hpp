// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>

#include "calib/sensor_calibration.hpp"
#include "firmware_io/ruby128/difop.hpp"
#include "rt/error.hpp"

namespace terracut::sensor {

struct DeviceCounters {
  std::uint64_t packets = 0;  ///< DIFOP packets read.
  /// Packets whose serial number or angles differ from those of the packet before. A unit always
  /// sends the same values, so a change means that two sensors share a port, or that a sensor was
  /// replaced.
  std::uint64_t serial_changes = 0;
  std::uint64_t angle_changes = 0;
};

/// Follows the DIFOP packets of one RoboSense: keeps the newest packet, and the first plausible
/// angles, as each model sends them, for the packets do not state the model. Later angles are
/// counted but not used: a calibration must not change under a running decoder.
///
/// One thread at a time. For start and reports: add() may allocate.
class DeviceReader {
 public:
  /// Adds a payload; false if it is no DIFOP packet.
  bool add(std::span<const std::uint8_t> payload);

  [[nodiscard]] const DeviceCounters& counters() const noexcept { return counters_; }

  /// Returns the newest packet; nothing before the first.
  [[nodiscard]] const std::optional<ruby128::ruby128_wire::Difop>& newest() const noexcept {
    return newest_;
  }

  [[nodiscard]] bool has_calibration(SensorModel model) const {
    return calibration(model).has_value();
  }
  /// Returns the first plausible angles of a model for which is_robosense() holds. Fails with
  /// kNoCalibration if no packet has come. If no packet had plausible angles, fails with the error
  /// for the newest packet.
  [[nodiscard]] const Expected<calib::SensorCalibration>& calibration(SensorModel model) const;

 private:
  DeviceCounters counters_;
  std::optional<ruby128::ruby128_wire::Difop> newest_;
  std::map<SensorModel, Expected<calib::SensorCalibration>> calibrations_;
};

}  // namespace terracut::sensor
