// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

namespace terracut::status {

/// The mount of a run, and what the near ground says of it. A plain value, part of MonitorSnapshot.
struct MountFigures {
  std::uint64_t frames = 0;       ///< Looked at, in which there was a ground.
  std::uint8_t contradicted = 0;  ///< 1: the ground shows another mount, the one below.
  std::uint8_t guessed = 0;       ///< 1: the ground did not show what of the mount was not stated.
  double height_m = 0, roll_deg = 0, pitch_deg = 0;  ///< The one in use.
  /// At the start, for what of it was not stated; 0: all was, or it was guessed.
  std::uint64_t found_in_frames = 0;
  /// Half widths of the intervals that hold them in 95 of 100 cases; 0 for those stated.
  double uncertain_height_m = 0, uncertain_roll_deg = 0, uncertain_pitch_deg = 0;
  /// As the ground shows it: that of the frames that contradict, or else the mean of all so far; a
  /// height of 0 where none has shown it yet.
  double seen_height_m = 0, seen_roll_deg = 0, seen_pitch_deg = 0;
};

}  // namespace terracut::status
