// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "turn_motion_log.hpp"

#include <algorithm>
#include <cstddef>

#include "calib/beams/angle.hpp"

namespace terracut::encode {

void TurnMotionLog::note_firing(std::int64_t stamp_ns, std::int64_t unwrapped_azimuth_cdeg) {
  const std::int64_t turn = unwrapped_azimuth_cdeg / beams::kTurn_cdeg;
  if (turn > turn_) seams_ns_.push_back(stamp_ns);
  turn_ = turn;
  last_ns_ = stamp_ns;
}

std::vector<vehicle::MotionSample> TurnMotionLog::samples() const {
  constexpr std::int64_t kPeriod_ns = 10'000'000, kBeforeSeam_ns = 1'000'000;
  std::vector<vehicle::MotionSample> samples;
  // Seam 0 is the run-up's begin, seam i + 1 that of turn i; the last one begins the run-out.
  const std::size_t turns = std::min(twists_.size(), seams_ns_.size() - 2);
  for (std::size_t turn = 0; turn < turns; ++turn) {
    const std::int64_t begin_ns = seams_ns_[turn + 1], end_ns = seams_ns_[turn + 2];
    const scan::SensorTwist& twist = twists_[turn];
    const double pace = twist.turn_duration_s / (static_cast<double>(end_ns - begin_ns) * 1e-9);
    const auto add = [&](std::int64_t stamp_ns) {
      samples.push_back({stamp_ns, twist.velocity_m_s[0] * pace, twist.turning_rad_s[2] * pace});
    };
    const std::int64_t from_ns = turn == 0 ? seams_ns_[0] : begin_ns;
    const std::int64_t to_ns = turn + 1 == turns ? last_ns_ : end_ns - kBeforeSeam_ns;
    for (std::int64_t stamp_ns = from_ns; stamp_ns < to_ns; stamp_ns += kPeriod_ns) add(stamp_ns);
    add(to_ns);
  }
  return samples;
}

}  // namespace terracut::encode
