// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <optional>
#include <string_view>

#include "rt/error.hpp"

namespace terracut::cli {

/// What whoever looks at a capture wants of its player; what is not given stays.
struct PlayerCommand {
  std::optional<bool> playing;
  bool step = false;             ///< One frame more, then stand.
  std::optional<double> seek_s;  ///< Since the capture's beginning, >= 0.
  std::optional<double> rate;    ///< Times as fast as it was recorded, [0.05, 20].
};

/// From JSON: {"playing": false, "seek_s": 12.5}. kInvalidArgument, with what was expected.
[[nodiscard]] Expected<PlayerCommand> parse_player_command(std::string_view json);

/// Where a capture stands.
struct PlayerState {
  bool playing = true;
  double rate = 1;
  double position_s = 0;
  double duration_s = 0;  ///< As far as it is known.
  double frame_s = 0.1;   ///< From frame to frame.
};

}  // namespace terracut::cli
