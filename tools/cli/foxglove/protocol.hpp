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

/// Foxglove's WebSocket protocol, as a server of ROS 2 messages speaks it: texts in JSON, and data
/// in binary messages. Both sub-protocols frame them alike.
namespace terracut::cli {

/// Channels go by index of ros_messages::kTopics; on the wire they are numbered from 1.
inline constexpr std::uint32_t kFirstChannelId = 1;

/// The sub-protocol to answer with, of those that a client offers (the header
/// Sec-WebSocket-Protocol); empty: it speaks none that is known here.
[[nodiscard]] std::string_view foxglove_sub_protocol(std::string_view offered);

/// What a client is greeted with. `name`: for people. `capture`: where the capture stands that
/// clients may play (playback.hpp); null: there is none.
[[nodiscard]] std::string server_info_text(const std::string& name, const PlayerState* capture);
/// The topics of ros_messages::kTopics, as many as `wanted` says.
[[nodiscard]] std::string advertise_text(const std::vector<bool>& wanted);
/// A complaint that the client shows.
[[nodiscard]] std::string warning_text(std::string_view message);

/// A text of a client that was understood.
struct FoxgloveRequest {
  struct Subscription {
    std::uint32_t id = 0, channel_id = 0;
  };
  std::vector<Subscription> subscribe;
  std::vector<std::uint32_t> unsubscribe;  ///< Ids of subscriptions.
};
/// kMalformed: no JSON object, or not as the protocol has it. kUnsupported: an operation that is
/// not offered here. Any bytes may come.
[[nodiscard]] Expected<FoxgloveRequest> parse_foxglove_request(std::string_view text);

/// What stands before a message's bytes.
[[nodiscard]] std::array<std::byte, 13> message_data_header(std::uint32_t subscription_id,
                                                            std::uint64_t log_time_ns) noexcept;

/// Whether a browser's page of this origin may connect: none is told, or this machine's own, or
/// one of `allowed` as it stands. A page anywhere else could read the sensor through the browser
/// of whoever looks at it. "file://" is the origin of a desktop program's own pages and of every
/// downloaded page that a browser opens: which of them it is, `user_agent` says, out of the page's
/// reach.
[[nodiscard]] bool is_allowed_origin(std::string_view origin, std::string_view user_agent,
                                     std::string_view own_name,
                                     const std::vector<std::string>& allowed);

}  // namespace terracut::cli
