// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

namespace terracut::vehicle {

/// The vehicle's motion at one instant, from its own sensors.
struct MotionSample {
  std::int64_t stamp_ns = 0;  ///< Time on the clock of the LiDAR's datagram stamps.
  double speed_mps = 0;       ///< Speed of the rear axle along the vehicle; negative backwards.
  double yaw_rate_radps = 0;  ///< Positive to the left.
};

/// A stamp farther than this before the last one means that the clock was set back; a nearer one
/// means that samples came out of order.
inline constexpr std::int64_t kMotionDisorder_ns = 20'000'000;

}  // namespace terracut::vehicle
