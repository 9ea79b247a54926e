// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <vector>

#include "firmware_io/vehicle/motion_sample.hpp"
#include "tools/lab/encode/sensor_motion.hpp"

namespace terracut::encode {

/// The motion that an encoded drive's vehicle reports, constant during each frame. Its times are
/// those of the packets, whose frames last as long as their firings: speeds are scaled so that the
/// vehicle moves as far per frame as it did. One thread; allocates.
class FrameMotionLog {
 public:
  explicit FrameMotionLog(std::int64_t first_stamp_ns) { seams_ns_.push_back(first_stamp_ns); }

  /// Notes a firing. Call this for every firing, in order.
  void note_firing(std::int64_t stamp_ns, std::int64_t unwrapped_azimuth_cdeg);
  /// Adds the next frame's motion, before or after its first firing is noted.
  void add_frame(const SensorTwist& twist) { twists_.push_back(twist); }

  /// Returns samples every 10 ms and at both ends of every frame. Call this after all firings.
  [[nodiscard]] std::vector<vehicle::MotionSample> samples() const;

 private:
  /// The times at which the run-up and then each frame begin.
  std::vector<std::int64_t> seams_ns_;
  std::int64_t frame_ = 0;  ///< Number of the frame, by azimuth.
  std::int64_t last_ns_ = 0;
  std::vector<SensorTwist> twists_;
};

}  // namespace terracut::encode
