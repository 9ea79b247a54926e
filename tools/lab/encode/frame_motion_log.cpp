// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "frame_motion_log.hpp"

#include <algorithm>
#include <cstddef>

#include "calib/beams/angle.hpp"

namespace terracut::encode {

void FrameMotionLog::note_firing(std::int64_t stamp_ns, std::int64_t unwrapped_azimuth_cdeg) {
  const std::int64_t frame = unwrapped_azimuth_cdeg / beams::kRevolution_cdeg;
  if (frame > frame_) seams_ns_.push_back(stamp_ns);
  frame_ = frame;
  last_ns_ = stamp_ns;
}

std::vector<vehicle::MotionSample> FrameMotionLog::samples() const {
  constexpr std::int64_t kPeriod_ns = 10'000'000, kBeforeSeam_ns = 1'000'000;
  std::vector<vehicle::MotionSample> samples;
  // Seam 0 begins the run-up, seam i + 1 begins frame i, and the last seam begins the run-out.
  const std::size_t frames = std::min(twists_.size(), seams_ns_.size() - 2);
  for (std::size_t frame = 0; frame < frames; ++frame) {
    const std::int64_t begin_ns = seams_ns_[frame + 1], end_ns = seams_ns_[frame + 2];
    const SensorTwist& twist = twists_[frame];
    const double pace = twist.frame_duration_s / (static_cast<double>(end_ns - begin_ns) * 1e-9);
    const auto add = [&](std::int64_t stamp_ns) {
      samples.push_back(
          {stamp_ns, twist.velocity_m_s[0] * pace, twist.angular_velocity_rad_s[2] * pace});
    };
    const std::int64_t from_ns = frame == 0 ? seams_ns_[0] : begin_ns;
    const std::int64_t to_ns = frame + 1 == frames ? last_ns_ : end_ns - kBeforeSeam_ns;
    for (std::int64_t stamp_ns = from_ns; stamp_ns < to_ns; stamp_ns += kPeriod_ns) add(stamp_ns);
    add(to_ns);
  }
  return samples;
}

}  // namespace terracut::encode
