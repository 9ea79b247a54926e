// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

namespace terracut::status {

/// What the near ground says of the mount that a run was given. A plain value, part of
/// MonitorSnapshot.
struct MountFigures {
  std::uint64_t frames = 0;       ///< Looked at, in which there was a ground.
  std::uint8_t contradicted = 0;  ///< 1: the ground shows another mount, the one below.
  double height_m = 0, roll_deg = 0, pitch_deg = 0;  ///< The given one.
  double seen_height_m = 0, seen_roll_deg = 0, seen_pitch_deg = 0;
};

}  // namespace terracut::status
