// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "rt/error.hpp"

namespace terracut::cli {

inline constexpr double kLeastRate = 0.05, kMostRate = 20, kLongestSeek_s = 1e9;

/// A viewer's command to the player of a capture; fields not given change nothing.
struct PlayerCommand {
  std::optional<bool> playing;
  bool step = false;             ///< Shows one more frame, then pauses.
  std::optional<double> seek_s;  ///< Since the capture's beginning, [0, kLongestSeek_s].
  std::optional<bool> loop;      ///< What happens at the end: true starts over, false pauses.
  std::optional<double> rate;    ///< Speed relative to the recording, [kLeastRate, kMostRate].
};

/// Parses JSON: {"playing": false, "seek_s": 12.5}. Fails with kInvalidArgument, with what was
/// expected.
[[nodiscard]] Expected<PlayerCommand> parse_player_command(std::string_view json);

/// The state of a capture's player.
struct PlayerState {
  bool playing = true;
  bool loop = true;
  bool at_end = false;  ///< Paused at the end; continues from the beginning.
  double rate = 1;
  bool seeking = false;       ///< A frame that was sought, or stepped to, is still to come.
  std::uint32_t frame = 0;    ///< Number of the frame shown last.
  double position_s = 0;      ///< Where it begins.
  double duration_s = 0;      ///< As far as known.
  double frame_s = 0.1;       ///< Interval between frames.
  std::int64_t begin_ns = 0;  ///< Stamp of its first datagram; 0 while unknown.
};

}  // namespace terracut::cli
