// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <vector>

#include "firmware_io/scan/sensor_motion.hpp"
#include "firmware_io/vehicle/motion_sample.hpp"

namespace terracut::encode {

/// What the vehicle of an encoded drive says of its motion, a frame's own all along that frame. Its
/// clock is that of the packets, whose frames last as long as their firings do: speeds are such
/// that a share of a frame moves the vehicle as far as in life. One thread; allocates.
class FrameMotionLog {
 public:
  explicit FrameMotionLog(std::int64_t first_stamp_ns) { seams_ns_.push_back(first_stamp_ns); }

  /// Every firing, in order.
  void note_firing(std::int64_t stamp_ns, std::int64_t unwrapped_azimuth_cdeg);
  /// The next frame's, before its first firing is noted or after.
  void add_frame(const scan::SensorTwist& twist) { twists_.push_back(twist); }

  /// Every 10 ms and at both ends of every frame, once all firings are noted.
  [[nodiscard]] std::vector<vehicle::MotionSample> samples() const;

 private:
  /// Of the run-up, then of each frame's begin.
  std::vector<std::int64_t> seams_ns_;
  std::int64_t frame_ = 0;  ///< By azimuth.
  std::int64_t last_ns_ = 0;
  std::vector<scan::SensorTwist> twists_;
};

}  // namespace terracut::encode
