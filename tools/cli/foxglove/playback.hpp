// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "rt/error.hpp"
#include "tools/cli/view/player_command.hpp"

/// Lets viewers play a capture by Foxglove's protocol: its capability "playbackControl", in binary
/// messages (foxglove-sdk 0.25; the sub-protocol foxglove.sdk.v1).
namespace terracut::cli {

struct PlaybackRequest {
  PlayerCommand command;
  std::string id;  ///< Id that the answer must repeat.
};

/// Parses a client's binary message, which may have any bytes. Times before the capture become its
/// beginning, speeds are limited to a player's range. Fails with kUnsupported or kMalformed.
[[nodiscard]] Expected<PlaybackRequest> parse_playback_request(std::string_view bytes,
                                                               std::int64_t begin_ns);

/// Returns a message with the state of the player. `did_seek` makes viewers forget what they have
/// shown; `request_id` is the id of the request being answered, or empty.
[[nodiscard]] std::string playback_state_message(const PlayerState& state, bool did_seek,
                                                 std::string_view request_id);

}  // namespace terracut::cli
