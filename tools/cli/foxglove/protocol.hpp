// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "rt/error.hpp"
#include "tools/cli/view/player_command.hpp"

/// Foxglove's WebSocket protocol for a server of ROS 2 messages: texts in JSON, and data in binary
/// messages. Both sub-protocols use the same form of messages.
namespace terracut::cli {

/// Channel ids are indices of ros_messages::kTopics plus this number.
inline constexpr std::uint32_t kFirstChannelId = 1;

/// Returns the sub-protocol to answer with, among those that a client offers in the header
/// Sec-WebSocket-Protocol; empty if none is supported.
[[nodiscard]] std::string_view foxglove_sub_protocol(std::string_view offered);

/// Returns the greeting for a client. `name` is for people. `capture` is the state of the capture
/// that clients may play (playback.hpp); null if there is none.
[[nodiscard]] std::string server_info_text(const std::string& name, const PlayerState* capture);
/// Returns an announcement of the topics of ros_messages::kTopics for which `wanted` is true.
[[nodiscard]] std::string advertise_text(const std::vector<bool>& wanted);
/// Returns a message that makes the client show a warning.
[[nodiscard]] std::string warning_text(std::string_view message);

/// A client's request, parsed from its text.
struct FoxgloveRequest {
  struct Subscription {
    std::uint32_t id = 0, channel_id = 0;
  };
  std::vector<Subscription> subscribe;
  std::vector<std::uint32_t> unsubscribe;  ///< Ids of the subscriptions to end.
};
/// Parses a text, which may have any bytes. Fails with kMalformed if the text is no JSON object or
/// breaks the protocol, kUnsupported if it asks for an operation not offered here.
[[nodiscard]] Expected<FoxgloveRequest> parse_foxglove_request(std::string_view text);

/// Returns the header that precedes the bytes of a message.
[[nodiscard]] std::array<std::byte, 13> message_data_header(std::uint32_t subscription_id,
                                                            std::uint64_t log_time_ns) noexcept;

/// True if a browser's page of this origin may connect: there is no origin, it is this machine's
/// own, or it equals one of `allowed`. A page from elsewhere could read the sensor's data through
/// its viewer's browser. "file://" is the origin both of a desktop program's own pages and of any
/// downloaded page in a browser; `user_agent`, which pages cannot change, tells the two apart.
[[nodiscard]] bool is_allowed_origin(std::string_view origin, std::string_view user_agent,
                                     std::string_view own_name,
                                     const std::vector<std::string>& allowed);

}  // namespace terracut::cli
