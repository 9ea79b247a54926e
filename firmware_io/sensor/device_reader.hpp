// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "firmware_io/ruby128/device_info.hpp"
#include "firmware_io/ruby128/difop.hpp"
#include "firmware_io/ruby128/difop_angles.hpp"

namespace terracut::sensor {

struct Ruby128DeviceCounters {
  std::uint64_t packets = 0;       ///< DIFOP packets read.
  std::uint64_t not_difop = 0;     ///< Payloads of another length or beginning: left alone.
  std::uint64_t unset_angles = 0;  ///< Of `packets`, by what judge_angles() says.
  std::uint64_t implausible_angles = 0;
  /// Packets whose serial number, or angles, differ from those of the packet before. Units send the
  /// same all their life: any change means that two sensors share a port, or that one was replaced.
  std::uint64_t serial_changes = 0;
  std::uint64_t angle_changes = 0;
};

/// Follows the DIFOP packets of one stream: keeps the newest packet, and the first whose angles are
/// plausible. Later angles are counted, never taken: a calibration must not change under a running
/// decoder.
///
/// One thread at a time. add() is real-time safe: no allocation, lock or exception; well below a
/// microsecond, and a few tens in a packet whose angles differ from the one before. The others are
/// for start and reports; they allocate.
class Ruby128DeviceReader {
 public:
  /// False for what is no DIFOP.
  bool add(std::span<const std::uint8_t> payload) noexcept;

  /// Resets everything, the calibration included.
  void reset() noexcept { *this = {}; }

  [[nodiscard]] const Ruby128DeviceCounters& counters() const noexcept { return counters_; }

  /// The newest packet's facts; nothing before the first.
  [[nodiscard]] std::optional<ruby128::Ruby128DeviceInfo> newest() const;

  [[nodiscard]] bool has_calibration() const noexcept { return calibrated_.has_value(); }
  /// The first plausible angles. While there are none: kNoCalibration when no packet has come, else
  /// what calibration_of() says of the newest.
  [[nodiscard]] Expected<ruby128::Ruby128Calibration> calibration() const;
  /// The facts of the packet that calibration() is from.
  [[nodiscard]] std::optional<ruby128::Ruby128DeviceInfo> calibrated_unit() const;

 private:
  Ruby128DeviceCounters counters_;
  ruby128::DifopAngles newest_angles_ = ruby128::DifopAngles::kUnset;
  std::optional<ruby128::ruby128_wire::Difop> newest_, calibrated_;
};

}  // namespace terracut::sensor
