// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

namespace terracut::status {

/// The mount of a run and what the near ground shows of it. A plain value, part of MonitorSnapshot.
struct MountFigures {
  std::uint64_t frames = 0;       ///< Frames with a ground.
  std::uint8_t contradicted = 0;  ///< 1: the ground shows another mount, the one seen.
  std::uint8_t guessed = 0;       ///< 1: the ground did not show the figures that were not stated.
  double height_m = 0, roll_deg = 0, pitch_deg = 0;  ///< The mount in use.
  /// Frames that gave the figures not stated; 0: all were stated or guessed.
  std::uint64_t found_in_frames = 0;
  /// Half widths of the 95 % intervals; 0 for those stated.
  double uncertain_height_m = 0, uncertain_roll_deg = 0, uncertain_pitch_deg = 0;
  /// The mount that the ground shows: that of the contradicting frames, or else the mean of all
  /// frames; height 0 if none has shown it yet.
  double seen_height_m = 0, seen_roll_deg = 0, seen_pitch_deg = 0;
};

}  // namespace terracut::status
