// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "firmware_io/ruby128/difop.hpp"
#include "firmware_io/ruby128/difop_angles.hpp"

namespace terracut::sensor {

struct Ruby128DeviceCounters {
  std::uint64_t packets = 0;  ///< DIFOP packets read.
  /// Packets whose serial number or angles differ from those of the packet before. A unit always
  /// sends the same values, so a change means that two sensors share a port, or that a sensor was
  /// replaced.
  std::uint64_t serial_changes = 0;
  std::uint64_t angle_changes = 0;
};

/// Follows the DIFOP packets of one stream: keeps the newest packet, and the first one with
/// plausible angles. Later angles are counted but not used: a calibration must not change under a
/// running decoder.
///
/// One thread at a time. For start and reports: add() may allocate.
class Ruby128DeviceReader {
 public:
  /// Adds a payload; false if it is no DIFOP packet.
  bool add(std::span<const std::uint8_t> payload);

  [[nodiscard]] const Ruby128DeviceCounters& counters() const noexcept { return counters_; }

  /// Returns the newest packet; nothing before the first.
  [[nodiscard]] const std::optional<ruby128::ruby128_wire::Difop>& newest() const noexcept {
    return newest_;
  }

  [[nodiscard]] bool has_calibration() const noexcept { return calibration_.has_value(); }
  /// Returns the first plausible angles. Fails with kNoCalibration if no packet has come. If no
  /// packet had plausible angles, fails with the error of calibration_of() for the newest packet.
  [[nodiscard]] const Expected<ruby128::Ruby128Calibration>& calibration() const noexcept {
    return calibration_;
  }

 private:
  Ruby128DeviceCounters counters_;
  std::optional<ruby128::ruby128_wire::Difop> newest_;
  Expected<ruby128::Ruby128Calibration> calibration_ =
      fail(ErrorCode::kNoCalibration,
           "no DIFOP packet has come; they come about once a second, by factory setting to UDP "
           "port 7788");
};

}  // namespace terracut::sensor
