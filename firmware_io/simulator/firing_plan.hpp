// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

#include "calib/hdl64e_calibration.hpp"
#include "firmware_io/hdl64e/wire.hpp"

namespace terracut::firmware_io {

/// One firing of all lasers.
struct Firing {
  std::int64_t index = 0;
  std::int64_t azimuth_cdeg = 0;  ///< Of the head as the wire has it, unwrapped.
  std::int32_t step_ticks = 0;    ///< column_step_ticks() of its packet.
  double time_s = 0;              ///< 0 when the head passes straight ahead for the first time.
};

/// When and where the head fires during a drive of whole turns, with the run-up and run-out that
/// let every laser see them whole. Single return, 48 us a column, whole packets.
class FiringPlan {
 public:
  static constexpr FiringTimes kTimes = kFiringTimesSingle48;

  FiringPlan(const calib::Hdl64eCalibration& calibration, double spin_hz, std::int64_t turns);

  [[nodiscard]] std::int64_t turns() const noexcept { return turns_; }
  [[nodiscard]] std::int64_t firings() const noexcept { return firings_; }
  [[nodiscard]] Firing firing(std::int64_t index) const noexcept;
  /// Turns that are not wanted lie before the first seam or after the last one.
  [[nodiscard]] bool wants(std::int64_t turn) const noexcept { return turn >= 0 && turn < turns_; }

 private:
  [[nodiscard]] std::int64_t azimuth_cdeg(std::int64_t index) const noexcept;

  std::int64_t turns_;
  double start_cdeg_;  ///< < 0
  double cdeg_per_s_;
  double column_s_;
  std::int64_t firings_;
};

}  // namespace terracut::firmware_io
