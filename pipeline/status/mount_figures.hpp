// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

namespace terracut::status {

/// The mount of a run and the mount that near ground shows. A plain value, part of MonitorSnapshot.
struct MountFigures {
  std::uint64_t frames = 0;       ///< Frames in which ground was seen.
  std::uint8_t contradicted = 0;  ///< 1: the ground shows another mount, the `seen` one.
  std::uint8_t guessed = 0;       ///< 1: some figures were neither stated nor found.
  double height_m = 0, roll_deg = 0, pitch_deg = 0;  ///< The mount in use.
  /// Number of frames that gave the figures not stated; 0 if all were stated or guessed.
  std::uint64_t found_in_frames = 0;
  /// Half widths of the 95 % intervals; 0 for figures that were stated.
  double uncertain_height_m = 0, uncertain_roll_deg = 0, uncertain_pitch_deg = 0;
  /// The mount that the ground shows: from the contradicting frames, or else the mean of all
  /// frames; the height is 0 if no frame has shown the mount yet.
  double seen_height_m = 0, seen_roll_deg = 0, seen_pitch_deg = 0;
};

}  // namespace terracut::status
