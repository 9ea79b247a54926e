// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "rt/error.hpp"
#include "tools/cli/view/player_command.hpp"

/// How a viewer plays a capture by Foxglove's protocol: its capability "playbackControl", in binary
/// messages (foxglove-sdk 0.25; the sub-protocol foxglove.sdk.v1).
namespace terracut::cli {

struct PlaybackRequest {
  PlayerCommand command;
  std::string id;  ///< Goes into the answer.
};

/// Of a client's binary message. Places before the capture are its beginning, speeds go into a
/// player's range. kUnsupported: a message of another kind; kMalformed. Any bytes may come.
[[nodiscard]] Expected<PlaybackRequest> parse_playback_request(std::string_view bytes,
                                                               std::int64_t begin_ns);

/// Where the capture stands. `did_seek`: a viewer is to forget what it has shown; `request_id`:
/// what is answered, or empty.
[[nodiscard]] std::string playback_state_message(const PlayerState& state, bool did_seek,
                                                 std::string_view request_id);

}  // namespace terracut::cli
