// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

namespace terracut::vehicle {

/// How the vehicle moves at one instant, as its own sensors say.
struct MotionSample {
  std::int64_t stamp_ns = 0;  ///< On the clock of the LiDAR's datagram stamps.
  double speed_mps = 0;       ///< Along the vehicle, of its rear axle; backwards is negative.
  double yaw_rate_radps = 0;  ///< To the left is positive.
};

/// A stamp that is farther than this before the one that came before it is of a clock that was set
/// back; nearer, it is disorder on the way.
inline constexpr std::int64_t kMotionDisorder_ns = 20'000'000;

}  // namespace terracut::vehicle
