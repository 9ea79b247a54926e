// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "rt/error.hpp"

namespace terracut::cli {

inline constexpr double kLeastRate = 0.05, kMostRate = 20, kLongestSeek_s = 1e9;

/// What whoever looks at a capture wants of its player; what is not given stays.
struct PlayerCommand {
  std::optional<bool> playing;
  bool step = false;             ///< One frame more, then stand.
  std::optional<double> seek_s;  ///< Since the capture's beginning, [0, kLongestSeek_s].
  std::optional<bool> loop;      ///< At the end: begin anew, or stand.
  std::optional<double> rate;    ///< Times as fast as it was recorded, [kLeastRate, kMostRate].
};

/// From JSON: {"playing": false, "seek_s": 12.5}. kInvalidArgument, with what was expected.
[[nodiscard]] Expected<PlayerCommand> parse_player_command(std::string_view json);

/// Where a capture stands.
struct PlayerState {
  bool playing = true;
  bool loop = true;
  bool at_end = false;  ///< It stands there, and goes on from the beginning.
  double rate = 1;
  double position_s = 0;
  double duration_s = 0;      ///< As far as it is known.
  double frame_s = 0.1;       ///< From frame to frame.
  std::int64_t begin_ns = 0;  ///< Stamp of its first datagram; 0: not known yet.
};

}  // namespace terracut::cli
